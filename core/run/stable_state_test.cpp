// Bonds at the last stable state: columns that are pulled off their floors, or not, in one scene, compared with areas
// by hand.
#include "core/run/stable_state.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "core/run/simulate.hpp"
#include "core/scene/scene.hpp"
#include "core/testing/whole_runs.hpp"

namespace voussoir::stable_state_test {
namespace {

constexpr double tension = 20e3, weight = 2600 * 9.81;  // Pa; N/m³, of columns 1 m high

struct Column {
  double width;
  std::string set;  // of the joint below it
  bool pulled_off;
};

struct Columns {
  int dimension, points;  // points: sub-contacts along a face
  std::vector<Column> columns;

  std::string at(double x, double z) const {
    return dimension == 2 ? fmt::format("[{}, {}]", x, z) : fmt::format("[{}, 0.5, {}]", x, z);
  }
  std::string box(double from, double to, double low, double high) const {
    return dimension == 2 ? fmt::format("{{ min = [{}, {}], max = [{}, {}] }}", from, low, to, high)
                          : fmt::format("{{ min = [{}, 0, {}], max = [{}, 1, {}] }}", from, low, to, high);
  }
  std::string force(double f) const {
    return dimension == 2 ? fmt::format("[0, {}]", f) : fmt::format("[0, 0, {}]", f);
  }

  // A pull of a third of the capacity of a bond and its block's weight does not break it, even with the block's
  // oscillation (at most twice); one of three times does.
  std::string text() const {
    const double all = 3.0 * static_cast<double>(columns.size());
    std::string text = fmt::format("dimension = {}\ngravity = {}\ndensity = 2600\ndomain = {{ box = {} }}\n", dimension,
                                   force(-9.81), box(0, all, -1, 1));
    text += fmt::format(
        "[[joint_properties]]\nname = \"rock\"\nnormal_stiffness = 1e9\nshear_stiffness = 1e8\nfriction_deg = 30\n"
        "tension = {}\ncohesion = 50e3\nsub_contacts = {}\n",
        tension, points);
    // cut in the given order: the sides of the columns, then the floor of each
    text += "[slicing]\norder = \"given\"\n";
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const double from = 3.0 * static_cast<double>(k) + columns[k].width, to = 3.0 * static_cast<double>(k + 1);
      const auto cut = [&](const char* name, double side) {
        text += fmt::format("[[joints]]\nname = \"{} {}\"\ndip = 90\ndip_direction = 90\npoint = {}\n", name, k,
                            at(side, 0));
      };
      cut("right", from);
      if (to < all) cut("gap", to);
      text += fmt::format("[[excavations]]\nname = \"gap{}\"\nbox = {}\n", k, box(from, to, -1, 1));
    }
    std::string forces;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const auto& [width, set, off] = columns[k];
      const double x = 3.0 * static_cast<double>(k), strength = (tension + weight) * width;
      text += fmt::format("[[joints]]\nname = \"floor{}\"\ndip = 0\npoint = {}\nwithin = {{ box = {} }}\n", k,
                          at(x + 0.5 * width, 0), box(x + 0.1 * width, x + 0.9 * width, -1, 1));
      if (!set.empty()) text += fmt::format("set = \"{}\"\n", set);
      text += fmt::format("[[fix]]\ninside = {}\n", at(x + 0.5 * width, -0.5));
      forces += fmt::format(
          "[[stage.force]]\nname = \"pull{}\"\ninside = {}\nforce = {}\ntimes_s = [0, 0.01, 0.02]\nfactors = [0, 1, "
          "0]\n",
          k, at(x + 0.5 * width, 0.5), force((off ? 3 : 1.0 / 3) * strength));
    }
    text += "[[restrain]]\nall = true\nrotation = true\n";
    text += "[[stage]]\nname = \"settle\"\nkind = \"settle\"\ngravity_ramp_s = 0.1\nbond = true\n";
    text += "[[stage]]\nname = \"pull\"\nkind = \"run\"\nduration_s = 0.02\n" + forces;
    text += "[[stage]]\nname = \"rest\"\nkind = \"settle\"\nstatics = \"local\"\n";
    return text + "[output]\nframes = false\n";
  }
};

template <int Dim>
Results results_of(const std::string& text) {
  return simulated(scene_of<Dim>(text)).results;
}

const StableState* find(const Results& results, const std::string& stage) {
  for (const StableState& at : results.at_last_stable_state)
    if (at.stage == stage) return &at;
  return nullptr;
}

int lines_with(const std::vector<std::string>& lines, const std::string& words) {
  return static_cast<int>(
      std::ranges::count_if(lines, [&](const std::string& line) { return line.find(words) != std::string::npos; }));
}

void expect_bonds(const Columns& scene, bool pulled, const StableState& at) {
  const int cells = scene.points == 1 ? 1 : scene.dimension == 2 ? scene.points : scene.points * scene.points;
  std::map<std::string, std::pair<double, double>> areas;  // whole, all
  std::map<std::string, std::pair<int, int>> counts;
  int whole = 0;
  for (std::size_t k = 0; k < scene.columns.size(); ++k) {
    const Column& column = scene.columns[k];
    const std::string name = column.set.empty() ? fmt::format("floor{}", k) : column.set;
    const bool is_whole = !(pulled && column.pulled_off);
    areas[name].first += is_whole * column.width;
    areas[name].second += column.width;
    counts[name].first += is_whole * cells;
    counts[name].second += cells;
    whole += is_whole * cells;
  }
  ASSERT_TRUE(at.bonds);
  EXPECT_EQ(at.bonds->whole, whole);
  EXPECT_EQ(at.bonds->made, cells * static_cast<int>(scene.columns.size()));
  ASSERT_EQ(at.bonds->by_joint.size(), areas.size());
  for (const BondsOfJoint& joint : at.bonds->by_joint) {
    ASSERT_TRUE(areas.contains(joint.joint)) << joint.joint;
    EXPECT_EQ(joint.whole, counts[joint.joint].first) << joint.joint;
    EXPECT_EQ(joint.made, counts[joint.joint].second) << joint.joint;
    // areas are intersections of faces: blocks that do not rotate overlap over the full face, to rounding
    EXPECT_NEAR(joint.area_share, areas[joint.joint].first / areas[joint.joint].second, 1e-9) << joint.joint;
  }
}

template <int Dim>
void pull_random_columns(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform;
  Columns scene{.dimension = Dim, .points = uniform(random) < 0.5 ? 1 : 2, .columns = {}};
  for (int k = 0, count = 2 + static_cast<int>(random() % 4); k < count; ++k)
    scene.columns.push_back({0.5 + 1.5 * uniform(random), std::vector<std::string>{"", "left", "right"}[random() % 3],
                             uniform(random) < 0.5});
  const Results results = results_of<Dim>(scene.text());
  ASSERT_EQ(results.outcome, Outcome::done) << results.message << scene.text();
  const StableState *settled = find(results, "settle"), *rested = find(results, "rest");
  ASSERT_TRUE(settled && rested && !find(results, "pull")) << "a stage of kind run does not end in equilibrium";
  expect_bonds(scene, false, *settled);
  expect_bonds(scene, true, *rested);
  const bool all_off = std::ranges::all_of(scene.columns, &Column::pulled_off);
  EXPECT_EQ(lines_with(results.warnings, "stage rest: in equilibrium: none of "), all_off);
  EXPECT_EQ(lines_with(results.warnings, "stage settle: in equilibrium"), 0);
}

TEST(StableState, BondsAreCountedByJointWithTheirArea) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    pull_random_columns<2>(seed);
    pull_random_columns<3>(100 + seed);
  }
}

// A block on a plane of 20 degrees whose friction is 40, and whose cohesion would raise the factor: pulled off before,
// it has only friction, tan 40 / tan 20, and the result states the reason.
std::string slab(bool pulled_off, const std::string& search) {
  std::string text =
      "preset = \"thesis\"\ndimension = 2\ngravity = [0, -9.81]\ndensity = 2600\ndomain = { box = { min = [-2, -2], "
      "max = "
      "[2, 2] } }\n"
      "joints = [{ name = \"plane\", dip = 20, dip_direction = 270, point = [0, 0] }]\n"
      "joint_properties = [{ name = \"rock\", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 40, "
      "cohesion = 8e3, tension = 1e3 }]\n"
      "fix = [{ below = [\"plane\"] }]\nrestrain = [{ above = [\"plane\"], rotation = true }]\n"
      "[[stage]]\nname = \"settle\"\nkind = \"settle\"\ngravity_ramp_s = 0.1\nbond = true\n";
  if (pulled_off)
    text +=
        "[[stage]]\nname = \"pull\"\nkind = \"run\"\nduration_s = 0.02\nforce = [{ name = \"pull\", inside = [0, 1], "
        "force = [0, 2e6], times_s = [0, 0.01, 0.02], factors = [0, 1, 0] }]\n"
        "[[stage]]\nname = \"rest\"\nkind = \"settle\"\nstatics = \"local\"\n";
  return text + "[[stage]]\nname = \"safety\"\nkind = \"reduce\"\nfailure_displacement = 0.002\n" + search +
         "[output]\nframes = false\n";
}

constexpr const char* factor = "search = \"factor\"\nfrom_factor = 0.5\nto_factor = 5\ntolerance_factor = 0.01\n";

TEST(StableState, ASearchReportsTheBondsOfItsLastStableTrial) {
  const double pi = std::acos(-1.0), friction = std::tan(40 * pi / 180) / std::tan(20 * pi / 180);
  const Results bonded = results_of<2>(slab(false, factor)), loose = results_of<2>(slab(true, factor));
  for (const Results* results : {&bonded, &loose}) {
    ASSERT_EQ(results->outcome, Outcome::done) << results->message;
    const Value* value = results->find("factor_of_safety");
    ASSERT_TRUE(value);
    const StableState* at = find(*results, "safety");
    ASSERT_TRUE(at && at->level && at->bonds);
    EXPECT_NEAR(*at->level, value->value - *value->error_bar, 1e-12) << "the stable end of the bracket";
    EXPECT_EQ(at->unit, "1");
    EXPECT_EQ(at->bonds->made, 1);
    EXPECT_EQ(value->divides, divided_by_factor({}));
  }
  EXPECT_EQ(find(bonded, "safety")->bonds->whole, 1);
  EXPECT_GT(bonded.find("factor_of_safety")->value, 1.1 * friction);
  EXPECT_EQ(lines_with(bonded.warnings, "bonds is intact"), 0);
  EXPECT_EQ(find(loose, "safety")->bonds->whole, 0);
  EXPECT_NEAR(loose.find("factor_of_safety")->value, friction, 0.01);
  EXPECT_EQ(lines_with(loose.warnings, "stage safety: at the last stable state, a factor of 2."), 1);
}

// For every search method the reported state is that at the known stable level.
TEST(StableState, IsThatOfTheLastStableTrialOfEveryMethod) {
  for (const char* method : {"bisection", "steps", "rate", "two_rates"}) {
    const Results results = results_of<2>(slab(
        false, fmt::format("from_deg = 40\nto_deg = 0\nmethod = \"{}\"\n{}", method,
                           std::string(method) == "bisection" ? "tolerance_deg = 0.5\n"
                           : std::string(method) == "steps"   ? "step_deg = 2\n"
                           : std::string(method) == "rate"    ? "rate_deg_per_s = 40\n"
                                                              : "rate_deg_per_s = 40\nslower_rate_deg_per_s = 20\n")));
    const StableState* at = find(results, "safety");
    ASSERT_TRUE(at && at->level && at->bonds) << method;
    EXPECT_EQ(at->bonds->whole, 1) << method;
    EXPECT_EQ(at->unit, "deg") << method;
    EXPECT_LE(*at->level, 40) << method;
    const Value* value = results.find("critical_friction");
    if (value) {
      EXPECT_GE(*at->level, value->value - 1e-9) << method;
    }
  }
}

}  // namespace
}  // namespace voussoir::stable_state_test
