// The cone programs of limit analysis against GLPK's simplex method: the same answers in the plane, enclosed ones in
// space.
#ifdef VOUSSOIR_HAS_GLPK
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/testing/corner_scenes.hpp"
#include "core/testing/limit_models.hpp"
#include "core/testing/limit_referee.hpp"
#include "core/testing/linear_program.hpp"
#include "core/testing/shapes.hpp"

namespace voussoir::referee_test {
namespace {

constexpr double rounding = 1e-9;  // of a small program's sums
constexpr double infinity = std::numeric_limits<double>::infinity();

// min -x - 2y with x + y + s = 4, y <= 3, s >= 0: x = 1, y = 3, worth -7
LinearProgram small_program() {
  return {{4}, {{-1, 0, infinity, {{0, 1}}}, {-2, 0, 3, {{0, 1}}}, {0, 0, infinity, {{0, 1}}}}};
}

TEST(LinearPrograms, AreSolvedAndVerified) {
  const LinearProgram program = small_program();
  ProgramSolution solution = solve(program);
  ASSERT_EQ(solution.status, ProgramStatus::optimal);
  Certificate certificate = judge(program, solution);
  EXPECT_NEAR(certificate.primal, -7, rounding);
  EXPECT_NEAR(certificate.dual, -7, rounding);
  EXPECT_LE(certificate.primal_violation, rounding);
  EXPECT_LE(certificate.dual_violation, rounding);

  // a worse point increases the gap; an infeasible one, and wrong multipliers, are reported
  solution.x = {2, 2, 0};
  EXPECT_NEAR(judge(program, solution).primal, -6, rounding);
  solution.x = {1, 3.5, 0};
  EXPECT_NEAR(judge(program, solution).primal_violation, 0.5, rounding);
  solution.y = {-0.75};
  EXPECT_NEAR(judge(program, solution).dual_violation, 0.25, rounding);
}

TEST(LinearPrograms, WithoutASolutionReportIt) {
  LinearProgram program = small_program();
  program.columns[0].cost = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(solve(program).status, ProgramStatus::failed);
  program = small_program();
  program.right_side[0] = -1;
  EXPECT_EQ(solve(program).status, ProgramStatus::infeasible);
  program.columns[2].entries[0].second = -1;
  EXPECT_EQ(solve(program).status, ProgramStatus::unbounded);
}

// ---- the plane -----------------------------------------------------------------------------------------------------

// a wall of bricks of random lengths, courses that lean on each other, pushed to one side
Model<2> random_wall(shapes::Random& random) {
  using shapes::uniform;
  const int courses = shapes::integer(random, 1, 6), bricks = shapes::integer(random, 1, 5);
  std::vector<limit_models::TestBlock> blocks{{"floor", limit_models::box(-10, -1, 20, 0), true}};
  for (int course = 0; course < courses; ++course) {
    double x = uniform(random, -0.2, 0.2);
    for (int brick = 0; brick < bricks; ++brick) {
      const double length = uniform(random, 0.6, 1.4);
      blocks.push_back({"brick " + std::to_string(course) + " " + std::to_string(brick),
                        limit_models::box(x, 0.5 * course, x + length, 0.5 * course + 0.5)});
      x += length;
    }
  }
  return limit_models::model_of(blocks, uniform(random, 15, 60));
}

TEST(Referee, FindsTheSameFactorsInThePlane) {
  shapes::Random random(60);
  int found = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Model<2> model = random_wall(random);
    const CornerAssembly<2> assembly = limit_models::assembly_of(model);
    const Loads<2> dead = loads_of_acceleration(model, model.gravity),
                   live = loads_of_acceleration<2>(model, {trial % 2 == 0 ? 10.0 : -10.0, 0});
    const LoadFactor<2> ours = find_load_factor(assembly, dead, live);
    if (ours.status == LimitStatus::carries_nothing) continue;  // a course overhangs: gravity alone brings it down
    const RefereedFactor theirs = refereed_factor(assembly, dead, live);
    ASSERT_TRUE(theirs.solved && ours.status == LimitStatus::found) << trial;
    ++found;
    EXPECT_LT(theirs.gap, rounding);
    EXPECT_LT(theirs.violation, rounding);
    EXPECT_NEAR(ours.factor, theirs.factor, 1e-8 * theirs.factor) << trial;
  }
  EXPECT_GT(found, 20);
}

// ---- space ---------------------------------------------------------------------------------------------------------

TEST(Referee, EnclosesFactorsInSpace) {
  using namespace corner_scenes;
  const auto steep = symmetric(38, 45);
  const CornerScene scenes[] = {wedge(steep[0], steep[1], Plane{70, 0}.normal(), 35, true),
                                wall(4, 3, 1, 0.5, 0.4, 35, {1, 0, 0}), wall(3, 3, 1, 0.5, 0.4, 35, {0.6, 0.8, 0})};
  for (const CornerScene& scene : scenes) {
    const double factor = scene.factor().factor;
    const RefereedFactor inside = refereed_factor(scene.assembly, scene.dead, scene.live, 32, false),
                         outside = refereed_factor(scene.assembly, scene.dead, scene.live, 32, true);
    ASSERT_TRUE(inside.solved && outside.solved);
    EXPECT_LE(inside.factor, factor + 1e-8);
    EXPECT_GE(outside.factor, factor - 1e-8);
    EXPECT_LT(outside.factor - inside.factor, 0.02);
  }
}

}  // namespace
}  // namespace voussoir::referee_test
#endif
