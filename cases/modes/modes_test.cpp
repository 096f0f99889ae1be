// Natural frequencies of blocks at rest on elastic joints, against matrices written out by hand.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/base/run_scene.hpp"
#include "cases/case_tools.hpp"
#include "core/modes/modes.hpp"
#include "reference/modes/modes.hpp"

namespace voussoir::cases::modes_test {
namespace {

using verification::CaseReport;
using verification::Kind;

// as the scenes state them
const reference::SwayingBlock tall{1, 2, 2600, 1e10, 5e9, 9.81}, cube{1, 1, 2600, 1e10, 5e9, 0};
const double axial_unit = std::sqrt(1e10 / 2600);  // rad/s, √(k/m)
constexpr double full_turn = 2 * std::numbers::pi;

// Differences of forces leave some 1e-10 of a joint's stiffness on faces.
// Stacks are lowered by their weight as a cantilever by its own: by W L²/(7.84 EI)/2, EI = kn I H, below 3e-7 for the
// gravities chosen.
constexpr double differences = 1e-6;
const std::string because_differences =
    "differences of the joints' forces leave 1e-10 of their stiffness on faces; the weight of a light "
    "stack lowers it by up to 3e-7";

struct ModesRun {
  Modes<2> modes;
  verification::Cost cost;
};

ModesRun modes_of(const std::string& scene, int number, const std::vector<std::string>& overrides, int threads = 1) {
  const SceneRun done = cases::run(scene, overrides, threads);
  const auto& prepared = std::get<Prepared<2>>(done.scene.prepared);
  Progress<2> progress = initial_progress(prepared);
  simulate(prepared, progress, Watcher<2>());
  ModesRun run{find_modes(prepared, progress, 0, number), cost(done)};
  EXPECT_EQ(run.modes.reason, "");
  EXPECT_EQ(run.modes.missing, 0);
  return run;
}

// ω², of modes in which the cubes move sideways
std::vector<double> bending_of(const Modes<2>& modes) {
  std::vector<double> found;
  for (const Mode<2>& mode : modes.list) {
    Vector<2> most = Vector<2>::Zero();
    for (const Vector<2>& way : mode.displacement)
      most = most.cwiseMax(way.cwiseAbs());
    if (most[0] > most[1]) found.push_back(mode.omega_squared);
  }
  return found;
}

void check(CaseReport& report, const std::string& quantity, const std::string& source, double expected, double found,
           const verification::Cost& cost) {
  report.record({quantity, "Hz", Kind::exact, source, expected, {0, differences}, because_differences}, found, cost);
}

// along the normal of points the tangent is a difference over a millionth of the overlap
void check_normal_of_points(CaseReport& report, const std::string& quantity, const std::string& source, double expected,
                            double found, const verification::Cost& cost) {
  report.record(
      {quantity,
       "Hz",
       Kind::exact,
       source,
       expected,
       {0, 2e-4},
       "the kernel finds an overlap to 1e-15 of the block's 2 m; the difference is over a millionth of the overlap, "
       "5e-12 m: 4e-4 of the stiffness at most, half of it of the frequency, mostly a tenth of that"},
      found, cost);
}

void check_axial(CaseReport& report, int blocks) {
  const int number = std::min(blocks, 3);
  const ModesRun run = modes_of("axial.toml", number, {fmt::format("repeat.stack.count={}", blocks)});
  for (int j = 1; j <= number; ++j)
    check(report, fmt::format("axial mode {} of {} blocks", j, blocks),
          "reference/modes: ω_j = 2 √(k/m) sin((2j - 1) π/(2 (2n + 1)))",
          axial_unit * reference::axial_mode(blocks, j) / full_turn, run.modes.list[j - 1].frequency(), run.cost);
}

TEST(Modes, ColumnAlongItsAxis) {
  CaseReport report("modes", {"axial mode 2 of 2 blocks", "axial mode 3 of 10 blocks", "axial mode 3 of 100 blocks"});
  for (const int blocks : {2, 10, 100})
    check_axial(report, blocks);
}

TEST(ModesLong, ColumnOfAThousandBlocks) {
  CaseReport report("modes", {"axial mode 3 of 1000 blocks"});
  check_axial(report, 1000);
}

TEST(Modes, OneBlockOnAJoint) {
  CaseReport report("modes", {"block on a face, vertical", "block on a face, sway 1", "block on two points, sway 2"});
  for (const bool whole : {true, false}) {
    const std::string on = whole ? "block on a face" : "block on two points";
    const ModesRun run =
        modes_of("scene.toml", 3,
                 whole ? std::vector<std::string>{"contact.face=integrated"}
                       : std::vector<std::string>{"contact.face=point", "joint_properties.rock.sub_contacts=2"});
    const reference::SwayModes expected = reference::sway_modes(tall, whole);
    const std::string source = whole ? "reference/modes: matrix of sway and rocking, shear in the middle of the overlap"
                                     : "reference/modes: matrix of sway and rocking";
    check(report, on + ", sway 1", source, std::sqrt(expected.lower) / full_turn, run.modes.list[0].frequency(),
          run.cost);
    (whole ? check : check_normal_of_points)(report, on + ", vertical", "reference/modes: √(kn A/m)",
                                             std::sqrt(expected.vertical) / full_turn, run.modes.list[1].frequency(),
                                             run.cost);
    check(report, on + ", sway 2", source, std::sqrt(expected.upper) / full_turn, run.modes.list[2].frequency(),
          run.cost);
    // all three modes are asked for: their effective masses are all of the mass
    for (int d = 0; d < 2; ++d) {
      double sum = 0;
      for (const Mode<2>& mode : run.modes.list)
        sum += mode.mass_share[d];
      report.record({fmt::format("{}, effective mass along {}", on, d == 0 ? "x" : "y"),
                     "1",
                     Kind::exact,
                     "reference/modes: orthonormal shapes, their sum is the mass",
                     1,
                     {1e-9, 0},
                     "rounding of three modes"},
                    sum, run.cost);
    }
    EXPECT_EQ(run.modes.tangent.asymmetry > 1e-9, !whole) << "an integrated face has a potential, points have none";
    EXPECT_EQ(run.modes.tangent.one_point, 0);
  }
}

// the weight turns over the soft joint
TEST(Modes, ABlockRocksOverOnASoftJoint) {
  const double least = reference::least_normal_stiffness(tall);
  for (const double part : {0.8, 1.2}) {
    const ModesRun run = modes_of("scene.toml", 3,
                                  {"statics=newton", "joint_properties.rock.normal_stiffness=" + text(part * least),
                                   "joint_properties.rock.shear_stiffness=" + text(part * least / 2)});
    EXPECT_EQ(run.modes.list[0].omega_squared < 0, part < 1) << part;
    EXPECT_GT(run.modes.list[1].omega_squared, 0);
  }
}

TEST(Modes, StackThatBends) {
  CaseReport report("modes", {"bending mode 1 of 2 cubes", "bending mode 3 of 20 cubes"});
  // as light as the joints' equilibrium allows: their weight lowers the frequencies by less than 2e-7
  const std::pair<int, const char*> stacks[] = {{2, "1e-2"}, {5, "1e-3"}, {10, "1e-3"}, {20, "1e-4"}};
  for (const auto& [blocks, gravity] : stacks) {
    const ModesRun run = modes_of(
        "stack.toml", 6, {fmt::format("repeat.stack.count={}", blocks), fmt::format("gravity=[0,-{}]", gravity)});
    const std::vector<double> expected = reference::bending_modes(cube, blocks, 3), found = bending_of(run.modes);
    ASSERT_GE(found.size(), 3U);
    for (int k = 0; k < 3; ++k)
      check(report, fmt::format("bending mode {} of {} cubes", k + 1, blocks),
            "reference/modes: matrix of the stack, without weight", expected[k] / full_turn,
            std::sqrt(found[k]) / full_turn, run.cost);
  }
}

// the weight's effect is linear in it: two runs find none
TEST(Modes, TallStackWithoutItsWeight) {
  CaseReport report("modes", {"bending mode 1 of 50 cubes"});
  const auto at = [](const std::string& gravity) {
    return modes_of("stack.toml", 3, {"repeat.stack.count=50", "gravity=[0,-" + gravity + "]"});
  };
  const ModesRun light = at("1e-4"), heavy = at("2e-4");
  const std::vector<double> expected = reference::bending_modes(cube, 50, 3);
  for (int k = 0; k < 3; ++k)
    check(report, fmt::format("bending mode {} of 50 cubes", k + 1),
          "reference/modes: matrix of the stack, without weight", expected[k] / full_turn,
          std::sqrt(2 * light.modes.list[k].omega_squared - heavy.modes.list[k].omega_squared) / full_turn, light.cost);
}

TEST(Modes, SameBitsOnThreads) {
  const ModesRun one = modes_of("stack.toml", 5, {}), three = modes_of("stack.toml", 5, {}, 3);
  ASSERT_EQ(one.modes.list.size(), three.modes.list.size());
  for (std::size_t k = 0; k < one.modes.list.size(); ++k) {
    EXPECT_EQ(one.modes.list[k].omega_squared, three.modes.list[k].omega_squared);
    for (std::size_t b = 0; b < one.modes.list[k].displacement.size(); ++b)
      EXPECT_EQ(one.modes.list[k].displacement[b], three.modes.list[k].displacement[b]);
  }
}

}  // namespace
}  // namespace voussoir::cases::modes_test
