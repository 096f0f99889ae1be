// Candidate pairs against an oracle that checks all pairs: none that may come near is missed, few others are listed.
#include "core/step/neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "core/contact/broad_phase.hpp"
#include "core/contact/nearness.hpp"
#include "core/model/state.hpp"
#include "core/testing/models.hpp"

namespace voussoir {
namespace {

using shapes::Random;

using Pairs = std::vector<std::pair<int, int>>;

// slabs of equal thickness that dip to the east, in a box; all free but the first
template <int Dim>
Model<Dim> slabs(int count, double dip) {
  const double half = 0.5 * count;  // m
  Vector<Dim> normal = Vector<Dim>::Zero();
  normal[0] = std::sin(dip);
  normal[Dim - 1] = std::cos(dip);
  const double across = 2 * half * (std::sin(dip) + std::cos(dip)), spacing = across / count;
  std::vector<Cut<Dim>> cuts;
  for (int i = 1; i < count; ++i)
    cuts.push_back({{normal, i * spacing - 0.5 * across}, 0});
  SlicingCounters counters;
  std::vector<Body<Dim>> bodies;
  for (const Polytope<Dim>& part : slice<Dim>(shapes::block<Dim>(shapes::cube<Dim>(half)), cuts, {}, counters))
    bodies.push_back(make_body<Dim>({part}, shapes::density));
  Model<Dim> model = shapes::model_of<Dim>(bodies);
  model.bodies.front().fixed = true;
  return model;
}

template <int Dim>
Pairs pairs_of(const State<Dim>& state) {
  Pairs pairs;
  for (const Contact<Dim>& c : state.contacts.list)
    pairs.push_back({c.part_a, c.part_b});
  return pairs;
}

template <int Dim>
State<Dim> listed(const Model<Dim>& model, const Settings& settings = {}) {
  State<Dim> state = initial_state(model);
  find_neighbours(model, settings, state.bodies, state.contacts, state.counters);
  return state;
}

// ---- slabs ----------------------------------------------------------------------------------------------------------

template <int Dim>
int most_pairs_of_a_slab(int count, double dip) {
  const Model<Dim> model = slabs<Dim>(count, dip);
  EXPECT_EQ(model.bodies.size(), static_cast<std::size_t>(count));
  std::vector<int> of_part(model.parts.size());
  for (const auto& [a, b] : pairs_of(listed(model))) {
    ++of_part[a];
    ++of_part[b];
  }
  return *std::max_element(of_part.begin(), of_part.end());
}

TEST(Neighbours, OfASlabAreFewAtAnyDip) {
  for (const double dip : {0.0, 1.0, 30.0, 45.0, 60.0, 89.0, 90.0}) {
    EXPECT_LE(most_pairs_of_a_slab<3>(300, dip * degree), 12) << dip;
    EXPECT_LE(most_pairs_of_a_slab<2>(300, dip * degree), 12) << dip;
  }
}

// ---- packs ----------------------------------------------------------------------------------------------------------

// polyhedra with sizes over a decade, densely packed; with `clumps` some bodies have two parts
template <int Dim>
Model<Dim> pack(Random& random, int count, bool clumps) {
  std::vector<Body<Dim>> bodies;
  for (int i = 0; i < count; ++i) {
    const auto part = [&] {
      const double size = shapes::power_of_ten(random, -0.7, 0);
      Vector<Dim> stretch;
      for (int k = 0; k < Dim; ++k)
        stretch[k] = shapes::power_of_ten(random, -0.5, 0);
      HalfSpaces<Dim> planes = shapes::random_planes<Dim>(random, shapes::integer(random, 0, 6), size);
      for (HalfSpace<Dim>& p : planes) {
        const Vector<Dim> scaled = p.normal.cwiseQuotient(stretch);
        p = {scaled.normalized(), p.offset / scaled.norm()};
      }
      return shapes::placed<Dim>(planes, matrix(shapes::orientation<Dim>(random)), Vector<Dim>::Zero());
    };
    std::vector<Polytope<Dim>> parts{shapes::block<Dim>(part())};
    if (clumps && i % 3 == 0)
      parts.push_back(moved_origin(shapes::block<Dim>(part()), Vector<Dim>(-0.4 * shapes::direction<Dim>(random))));
    Body<Dim> body = make_body<Dim>(parts, shapes::density);
    for (int k = 0; k < Dim; ++k)
      body.reference[k] += shapes::uniform(random, 0, 0.55 * std::pow(count, 1.0 / Dim));
    body.fixed = i % 9 == 0;
    bodies.push_back(body);
  }
  return shapes::model_of<Dim>(bodies);
}

template <int Dim>
bool may_touch(const Model<Dim>& model, int part_a, int part_b) {
  const int a = model.parts[part_a].body, b = model.parts[part_b].body;
  return a != b && !(model.bodies[a].fixed && model.bodies[b].fixed);
}

// all pairs, by the narrow phase only
template <int Dim>
Pairs touching_pairs(const Model<Dim>& model, State<Dim> state) {
  cache_poses(model, 1, state.bodies);
  Pairs touching;
  for (int a = 0; a < static_cast<int>(model.parts.size()); ++a)
    for (int b = a + 1; b < static_cast<int>(model.parts.size()); ++b) {
      if (!may_touch(model, a, b)) continue;
      const Pair<Dim> pair = pair_of(model, state.bodies, a, b, QueryLevel::decision);
      Contact<Dim> contact;
      Contact<Dim>* const place = &contact;
      KernelCounters counters;
      narrow_phase<Dim>({&pair, 1}, {}, model.solvers, {&place, 1}, counters);
      if (contact.touching()) touching.push_back({a, b});
    }
  return touching;
}

template <int Dim>
Box<Dim> box_around(const Model<Dim>& model, const State<Dim>& state, int part, double margin) {
  const int body = model.parts[part].body;
  Box<Dim> box{Vector<Dim>::Constant(1e300), Vector<Dim>::Constant(-1e300), body, false};
  for (const Vector<Dim>& v : model.polytope(part).vertices) {
    const Vector<Dim> x = model.bodies[body].reference + matrix(state.bodies.motions[body].rotation) * v;
    box.low = box.low.cwiseMin(Vector<Dim>(x.array() - margin));
    box.high = box.high.cwiseMax(Vector<Dim>(x.array() + margin));
  }
  return box;
}

// the pairs that boxes only would list
template <int Dim>
int count_boxes_that_meet(const Model<Dim>& model, const State<Dim>& state, double margin) {
  int count = 0;
  for (int a = 0; a < static_cast<int>(model.parts.size()); ++a)
    for (int b = a + 1; b < static_cast<int>(model.parts.size()); ++b)
      count += may_touch(model, a, b) && meet(box_around(model, state, a, margin), box_around(model, state, b, margin));
  return count;
}

template <int Dim>
double skin_of(const Model<Dim>& model, const Settings& settings) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Body<Dim>& b : model.bodies)
    if (!b.fixed) smallest = std::min(smallest, b.size);
  return settings.contact.skin * smallest;
}

// Every pair that touches, before and after a motion within the skin, is listed; the list is the same for any threads.
template <int Dim>
void expect_none_missed(std::uint64_t seed, bool clumps) {
  Random random(seed);
  std::size_t touching = 0, listed_pairs = 0, boxes = 0;
  for (int trial = 0; trial < 6; ++trial) {
    const Model<Dim> model = pack<Dim>(random, 120, clumps);
    Settings settings;
    settings.contact.skin = shapes::power_of_ten(random, -2, 0);
    State<Dim> state = initial_state(model), again = state;
    for (Motion<Dim>& m : state.bodies.motions)
      m.rotation = shapes::orientation<Dim>(random);
    again.bodies.motions = state.bodies.motions;
    find_neighbours(model, settings, state.bodies, state.contacts, state.counters);
    const Pairs pairs = pairs_of(state);
    settings.threads = 3;
    find_neighbours(model, settings, again.bodies, again.contacts, again.counters);
    EXPECT_TRUE(pairs_of(again) == pairs);

    const std::set<std::pair<int, int>> known(pairs.begin(), pairs.end());
    for (const double fraction : {0.0, 0.499, 0.499}) {
      State<Dim> moved = state;
      for (std::size_t b = 0; b < model.bodies.size(); ++b)
        if (!model.bodies[b].fixed)
          moved.bodies.motions[b].displacement = fraction * skin_of(model, settings) * shapes::direction<Dim>(random);
      for (const std::pair<int, int>& pair : touching_pairs(model, moved)) {
        ++touching;
        EXPECT_TRUE(known.contains(pair)) << pair.first << ' ' << pair.second;
      }
    }
    listed_pairs += pairs.size();
    boxes += count_boxes_that_meet(model, state, 0.5 * skin_of(model, settings));
  }
  EXPECT_GT(touching, 300u);
  EXPECT_LT(listed_pairs, boxes);
}

// boxes from Eq. C.1
TEST(Neighbours, NoneThatMayTouchIsMissed3D) {
  expect_none_missed<3>(401, false);
}
TEST(Neighbours, NoneThatMayTouchIsMissed2D) {
  expect_none_missed<2>(402, false);
}
TEST(Neighbours, NoneOfAClumpsPartsIsMissed) {
  expect_none_missed<3>(403, true);
  expect_none_missed<2>(404, true);
}

// ---- how near -------------------------------------------------------------------------------------------------------

// a body displaced and rotated so that none of its points moves by more than `way`
template <int Dim>
void move_within(Random& random, const Body<Dim>& body, double way, Motion<Dim>& motion) {
  const double turn = shapes::uniform(random, 0, 1) * way / body.radius;
  motion.displacement += (way - turn * body.radius) * shapes::direction<Dim>(random);
  if constexpr (Dim == 3)
    motion.rotation.quaternion =
        Eigen::Quaterniond(Eigen::AngleAxisd(turn, shapes::direction<3>(random))) * motion.rotation.quaternion;
  else
    motion.rotation.angle += turn;
}

// The result for a pair is valid for the stated distance, and pairs that are not listed do not come near.
template <int Dim>
void expect_that_it_lasts(std::uint64_t seed) {
  Random random(seed);
  int near = 0, apart = 0, left_out = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const Model<Dim> model = pack<Dim>(random, 2, false);
    State<Dim> state = initial_state(model);
    for (Motion<Dim>& m : state.bodies.motions)
      m.rotation = shapes::orientation<Dim>(random);
    const double radius_a = model.bodies[0].radius, radius_b = model.bodies[1].radius;
    state.bodies.motions[1].displacement =
        shapes::uniform(random, 0, 1) * (radius_a + radius_b) * shapes::direction<Dim>(random);
    const auto seen = [&](State<Dim>& at) {
      cache_poses(model, 1, at.bodies);
      return pair_of(model, at.bodies, 0, 1, QueryLevel::decision);
    };
    const auto moved = [&](double way_a, double way_b) {
      State<Dim> later = state;
      move_within(random, model.bodies[0], way_a, later.bodies.motions[0]);
      move_within(random, model.bodies[1], way_b, later.bodies.motions[1]);
      return nearness(seen(later), radius_a, radius_b).near;
    };
    const Nearness now = nearness(seen(state), radius_a, radius_b);
    (now.near ? near : apart) += 1;
    const double fraction = shapes::uniform(random, 0, 1);
    EXPECT_EQ(moved(fraction * 0.999 * now.lasts, (1 - fraction) * 0.999 * now.lasts), now.near) << trial;

    const double way = shapes::power_of_ten(random, -3, -1);
    if (may_come_near(seen(state), radius_a, radius_b, way)) continue;
    ++left_out;
    EXPECT_FALSE(moved(way, way)) << trial;
  }
  EXPECT_GT(near, 300);
  EXPECT_GT(apart, 300);
  EXPECT_GT(left_out, 300);
}

TEST(Neighbours, NearnessIsValidForItsStatedDistance) {
  expect_that_it_lasts<3>(406);
  expect_that_it_lasts<2>(407);
}

// a sliver whose vertices may be anywhere: nothing separates it
TEST(Neighbours, PartsWithUncertainVerticesAreNear) {
  Random random(408);
  Model<3> model = pack<3>(random, 2, false);
  for (Body<3>& body : model.bodies)
    body.parts[0].vertex_error = std::numeric_limits<double>::infinity();
  State<3> state = initial_state(model);
  state.bodies.motions[1].displacement = {100, 0, 0};
  cache_poses(model, 1, state.bodies);
  const Pair<3> pair = pair_of(model, state.bodies, 0, 1, QueryLevel::decision);
  EXPECT_TRUE(nearness(pair, model.bodies[0].radius, model.bodies[1].radius).near);
  EXPECT_TRUE(may_come_near(pair, model.bodies[0].radius, model.bodies[1].radius, 0.1));
}

// ---- too many -------------------------------------------------------------------------------------------------------

// joints in all directions through one point
std::vector<Body<3>> star(int joints, const Vector<3>& centre) {
  Random random(405);
  std::vector<Cut<3>> cuts;
  for (int i = 0; i < joints; ++i)
    cuts.push_back({{shapes::direction<3>(random), 0}, 0});
  SlicingCounters counters;
  std::vector<Body<3>> bodies;
  for (const Polytope<3>& part : slice<3>(shapes::block<3>(shapes::cube<3>(1)), cuts, {}, counters)) {
    bodies.push_back(make_body<3>({part}, shapes::density));
    bodies.back().reference += centre;
  }
  return bodies;
}

TEST(Neighbours, BlocksThatAllMeetInAPointAreListed) {
  const Model<3> model = shapes::model_of<3>(star(8, {0, 0, 0}));
  const std::size_t blocks = model.bodies.size();
  EXPECT_EQ(blocks, 8u * 8u - 8u + 2u);
  EXPECT_EQ(listed(model).contacts.list.size(), blocks * (blocks - 1) / 2);
}

TEST(Neighbours, TooManyAreRefusedWithTheirPosition) {
  const Model<3> model = shapes::model_of<3>(star(46, {7, 8, 9}));
  const std::size_t blocks = model.bodies.size();
  ASSERT_GT(blocks * (blocks - 1) / 2, most_candidates(blocks));
  try {
    listed(model);
    FAIL() << "not refused";
  } catch (const TooManyNeighbours& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("around (7, 8, 9) m"), std::string::npos) << refusal.what();
  }
}

}  // namespace
}  // namespace voussoir
