// Changes that the hash of a state must show, and changes that it must not.
#include "core/model/state_hash.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

#include "core/step.hpp"
#include "core/testing/models.hpp"
#include "core/testing/probe/models.hpp"

namespace voussoir::state_hash_test {
namespace {

// a block that slides on its plate, and a candidate that touches nothing
template <int Dim>
struct Sliding {
  Model<Dim> model = shapes::block_on_plate<Dim>(40 * degree, 10 * degree);
  State<Dim> state = initial_state(model);

  Sliding() {
    for (int i = 0; i < 1000 && !slides(); ++i)
      step(model, {}, state);
    EXPECT_TRUE(slides());
    state.contacts.list.emplace_back();
  }
  bool slides() const {
    return !state.contacts.list.empty() && state.contacts.list[0].touching() &&
           state.contacts.list[0].history.plastic_slip > 0;
  }
  std::string hash() const { return state_hash(model, state); }
};

void one_ulp(double& x) {
  x = std::nextafter(x, 1e300);
}

void one_ulp(Rotation<2>& r) {
  one_ulp(r.angle);
}
void one_ulp(Rotation<3>& r) {
  one_ulp(r.quaternion.y());
}

template <int Dim>
void expect_that_one_ulp_shows() {
  const Sliding<Dim> original;
  const std::function<void(Sliding<Dim>&)> changes[] = {
      [](Sliding<Dim>& s) { one_ulp(s.state.bodies.motions[1].displacement[0]); },
      [](Sliding<Dim>& s) { one_ulp(s.state.bodies.motions[1].rotation); },
      [](Sliding<Dim>& s) { one_ulp(s.state.bodies.motions[1].velocity[Dim - 1]); },
      [](Sliding<Dim>& s) { one_ulp(s.state.bodies.motions[1].angular_momentum[0]); },
      [](Sliding<Dim>& s) { ++s.state.contacts.list[0].part_a; },
      [](Sliding<Dim>& s) { ++s.state.contacts.list[0].part_b; },
      [](Sliding<Dim>& s) { ++s.state.contacts.list[0].cells; },
      [](Sliding<Dim>& s) { one_ulp(s.state.contacts.list[0].history.shear_force[0]); },
      [](Sliding<Dim>& s) { one_ulp(s.state.contacts.list[0].history.normal[Dim - 1]); },
      [](Sliding<Dim>& s) { one_ulp(s.state.contacts.list[0].history.plastic_slip); },
      [](Sliding<Dim>& s) { s.state.contacts.list[0].status = ContactStatus::separated; },
      [](Sliding<Dim>& s) { s.state.contacts.list[1].status = ContactStatus::touching; },
      [](Sliding<Dim>& s) { s.model.bodies[1].present = false; },
      [](Sliding<Dim>& s) { std::swap(s.state.bodies.motions[0], s.state.bodies.motions[1]); }};
  for (std::size_t i = 0; i < std::size(changes); ++i) {
    Sliding<Dim> changed = original;
    changes[i](changed);
    EXPECT_NE(changed.hash(), original.hash()) << "change " << i;
  }
}

TEST(StateHash, OneUlpShows) {
  expect_that_one_ulp_shows<3>();
  expect_that_one_ulp_shows<2>();
}

template <int Dim>
void expect_that_bookkeeping_does_not_show() {
  const Sliding<Dim> original;
  Sliding<Dim> changed = original;
  changed.model.bodies[1].name = "renamed";
  changed.state.contacts.list.pop_back();
  changed.state.contacts.list[0].joint = 7;
  changed.state.contacts.list[0].properties = 3;
  changed.state.contacts.list[0].proof = {};
  changed.state.contacts.list[0].area_rated = 1;
  changed.state.bodies.listed_at.clear();
  changed.state.counters = {};
  EXPECT_EQ(changed.hash(), original.hash());
  EXPECT_EQ(original.hash().size(), std::string("fnv1a64:").size() + 16);
}

TEST(StateHash, CountersDoNotShow) {
  expect_that_bookkeeping_does_not_show<3>();
  expect_that_bookkeeping_does_not_show<2>();
}

// The skin determines which pairs are candidates, never the result.
template <int Dim>
void expect_no_skin(const probe::Scene<Dim>& scene) {
  std::set<std::string> hashes;
  for (const double skin : {0.01, 0.1, 0.5, 2.0}) {
    Settings settings = scene.settings;
    settings.contact.skin = skin;
    State<Dim> state = scene.state;
    for (int i = 0; i < 300; ++i)
      step(scene.model, settings, state);
    hashes.insert(state_hash(scene.model, state));
  }
  EXPECT_EQ(hashes.size(), 1u) << scene.name;
}

TEST(StateHash, AnySkinGivesTheSame) {
  expect_no_skin(probe::collapse());
  expect_no_skin(probe::wall());
  expect_no_skin(probe::tumble());
  expect_no_skin(probe::smooth_tumble());
  expect_no_skin(probe::flooded_tumble());
  expect_no_skin(probe::flooded_wall());
}

}  // namespace
}  // namespace voussoir::state_hash_test
