// `time.half_error`: what displacements owe to the error of their steps, against a run with half of it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/scene/scene_error.hpp"
#include "core/testing/whole_runs.hpp"

namespace voussoir::half_error_test {
namespace {

// a block that slides on ground shaken across its joint
Prepared<2> sliding(const std::string& time) {
  return scene_of<2>(fmt::format(R"(
dimension = 2
gravity = [-3, -9]
density = 2000
blocks = [{{ name = "ground", box = {{ min = [-5, -1], max = [5, 0] }}, fixed = true }},
          {{ name = "block", box = {{ min = [0, 0], max = [1, 1] }} }}]
joint_properties = [{{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e9, friction_deg = 25 }}]
[[stage]]
name = "settle"
kind = "settle"
gravity_ramp_s = 0.2
[[stage]]
name = "shake"
kind = "run"
duration_s = 0.6
damping = {{ local = 0 }}
time = {{ integration = "implicit", {} }}
[[stage.move]]
bodies = ["ground"]
velocity = [0.3, 0]
frequency_hz = 2
)",
                                 time));
}

TEST(HalfError, IsTheDifferenceFromARunWithHalfOfTheError) {
  const Prepared<2> scene = sliding("error_m = 1e-4, half_error = true");
  const Progress<2> asked = whole_run(scene), plain = whole_run(sliding("error_m = 1e-4")),
                    finer = whole_run(sliding("error_m = 5e-5"));
  EXPECT_EQ(asked.results.state_hash, plain.results.state_hash);
  EXPECT_FALSE(asked.results.stages.front().half_error);
  EXPECT_FALSE(plain.results.stages.back().half_error);
  const std::optional<HalfErrorResult>& half = asked.results.stages.back().half_error;
  ASSERT_TRUE(half);
  EXPECT_EQ(half->name, "block");
  const Vector<2> end = asked.state.bodies.motions[half->body].displacement;
  EXPECT_EQ(half->change, (end - finer.state.bodies.motions[half->body].displacement).norm());
  EXPECT_GT(half->change, 0);
  EXPECT_LT(half->change, 0.02 * half->displacement);
  const Progress<2> resumed = continued(scene, asked.results.stages.front().steps + 20);
  EXPECT_EQ(resumed.results.stages.back().half_error->change, half->change);
}

TEST(HalfError, IsRefusedWithoutAnErrorToHalve) {
  EXPECT_THROW(sliding("step_s = 1e-3, half_error = true"), SceneError);
}

}  // namespace
}  // namespace voussoir::half_error_test
