// A step that keeps its neighbours allocates no memory, even while blocks move, meet and part.
#include <gtest/gtest.h>

#include "core/scene/scene.hpp"
#include "core/stage/install_bolts.hpp"
#include "core/step.hpp"
#include "core/step/relaxation.hpp"
#include "core/testing/counted_allocations.hpp"
#include "core/testing/lined_opening.hpp"
#include "core/testing/models.hpp"

namespace voussoir::step_memory_test {
namespace {

// 200 steps with constant neighbours
template <int Dim>
void expect_no_memory_asked(const Model<Dim>& model, const Settings& settings, State<Dim>& state) {
  const long long builds = state.counters.neighbour_builds, made = allocations;
  for (int i = 0; i < 200; ++i)
    step(model, settings, state);
  const long long asked = allocations - made;
  if (!allocations_are_counted) GTEST_SKIP() << "this build counts no allocations";
  EXPECT_EQ(asked, 0);
  EXPECT_EQ(state.counters.neighbour_builds, builds);
}

// blocks of a jointed box, at speeds that open and close its joints
TEST(Step, AMovingPileAllocatesNoMemory) {
  const Model<3> model = shapes::model_of<3>(shapes::jointed_box());
  Settings settings;
  settings.contact.skin = 3;  // of the smallest inscribed radius: neighbours stay for as long as this test lasts
  State<3> state = initial_state(model);
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.bodies[b].fixed) state.bodies.motions[b].velocity = {2, 1.0 * static_cast<double>(b % 3), 3};  // m/s
  for (int i = 0; i < 100; ++i)
    step(model, settings, state);

  const std::vector<double> frequency = state.time_step.frequency;
  expect_no_memory_asked(model, settings, state);

  // the contacts must have changed: the time step was estimated again, as it is when a pair meets or a contact grows
  EXPECT_NE(state.time_step.frequency, frequency);
}

// long enough for the inertia to be chosen again
TEST(Step, ARelaxingPileAllocatesNoMemory) {
  const Model<3> model = shapes::model_of<3>(shapes::jointed_box());
  Settings settings;
  settings.contact.skin = 3;
  State<3> state = initial_state(model);
  begin_relaxation(state);
  for (int i = 0; i < 200; ++i)  // the kernel's lists have reached their size
    step(model, settings, state);
  expect_no_memory_asked(model, settings, state);
}

// bars whose bond slips under a slab that hangs from them
TEST(Step, GroutedBoltsAllocateNoMemory) {
  const Prepared<3> scene = prepare<3>(parse_scene(R"(
dimension = 3
gravity = [0, 0, -10]
density = 2500
domain = { box = { min = [0, 0, 0], max = [4, 2, 3] } }
joint_properties = [{ name = "bed", normal_stiffness = 1e9, shear_stiffness = 5e8, friction_deg = 40 }]
joints = [{ name = "bed", dip = 0, point = [0, 0, 1] }]
fix = [{ above = ["bed"] }]
[[bolts]]
name = "roof"
kind = "grouted"
axial_stiffness = 1e8
bond_stiffness = 1e9
bond_strength = 1e4
from = [1, 0.5, 0]
to = [1, 0.5, 2]
repeat = [{ step = [2, 0, 0], count = 2 }, { step = [0, 1, 0], count = 2 }]
[[stage]]
name = "fall"
kind = "run"
duration_s = 1
install = ["roof"]
)",
                                                   "scene.toml", {}));
  State<3> state = scene.state;
  install_bolts<3>(scene.model, {"roof"}, state);
  for (int i = 0; i < 100; ++i)
    step(scene.model, scene.settings, state);
  const double slip = state.supports.grouted[0].state.slip.back();
  expect_no_memory_asked(scene.model, scene.settings, state);
  EXPECT_NE(state.supports.grouted[0].state.slip.back(), slip) << "the bond slips";
}

TEST(Step, ALiningAllocatesNoMemory) {
  lined_opening::Cast cast;
  for (int i = 0; i < 300; ++i)
    step(cast.model, cast.scene.settings, cast.state);
  expect_no_memory_asked(cast.model, cast.scene.settings, cast.state);
}

}  // namespace
}  // namespace voussoir::step_memory_test
