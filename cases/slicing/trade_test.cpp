// Cost and savings of a smallest inscribed radius and a largest aspect ratio: blocks, the smallest of them, the time
// step that they allow, and the work for a second of simulated time.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cases/case_tools.hpp"
#include "core/scene/scene.hpp"
#include "core/step.hpp"

namespace voussoir::cases::trade_test {
namespace {

using verification::Bound;
using verification::CaseReport;
using verification::Kind;

constexpr double any = 0;                                          // no limit
const std::vector<double> radii{any, 0.02, 0.05, 0.1, 0.15, 0.2};  // m
const std::vector<double> aspects{any, 10, 4};

// the work of a step hardly changes while blocks only begin to move
constexpr int measured_steps = 4;

struct Assembly {
  std::size_t blocks = 0;
  double volume = 0;           // m³
  double smallest_radius = 0;  // m
  double smallest_mass = 0;    // kg
  double largest_aspect = 0;
  double step = 0;         // s
  double evaluations = 0;  // of contacts, per step
};

double box_aspect(const Polytope<3>& part) {
  Vector<3> low = part.vertices.front(), high = low;
  for (const Vector<3>& v : part.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  return (high - low).maxCoeff() / (high - low).minCoeff();
}

Prepared<3> prepared(double radius, double aspect, std::vector<std::string> overrides = {}) {
  overrides.push_back(fmt::format("slicing.smallest_inscribed_radius={}", radius));
  overrides.push_back(fmt::format("slicing.largest_aspect_ratio={}", aspect));
  return prepare<3>(read_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / "rock_mass.toml", overrides));
}

Assembly measured(const Prepared<3>& scene) {
  Assembly made;
  made.smallest_radius = made.smallest_mass = 1e300;
  for (const Body<3>& body : scene.model.bodies) {
    if (body.fixed) continue;
    ++made.blocks;
    made.volume += body.parts.front().mass.volume;
    made.smallest_radius = std::min(made.smallest_radius, body.size);
    made.smallest_mass = std::min(made.smallest_mass, body.mass);
    made.largest_aspect = std::max(made.largest_aspect, box_aspect(body.parts.front()));
  }
  State<3> state = scene.state;
  for (int i = 0; i < measured_steps; ++i)
    step(scene.model, scene.settings, state);
  made.step = state.time_step.length;
  made.evaluations = static_cast<double>(state.counters.contact_evaluations) / measured_steps;
  return made;
}

TEST(SlicingTrade, AgainstTheLimits) {
  CaseReport report("slicing", {"trade: volume, largest error of all limits"});
  constexpr double volume = 5 * 4 * 4;  // m³
  double worst_volume = 0, slimmest = 1e300, longest = 0;
  std::vector<Assembly> open_aspect;
  for (const double aspect : aspects) {
    std::vector<std::vector<double>> columns(7);
    for (const double radius : radii) {
      const Assembly made = measured(prepared(radius, aspect));
      worst_volume = std::max(worst_volume, std::abs(made.volume / volume - 1));
      if (radius > 0) slimmest = std::min(slimmest, made.smallest_radius / radius);
      if (aspect > 0) longest = std::max(longest, made.largest_aspect / aspect);
      if (aspect == any) open_aspect.push_back(made);
      const double row[] = {
          radius,           static_cast<double>(made.blocks), made.smallest_radius, made.smallest_mass, made.step,
          made.evaluations, made.evaluations / made.step};
      for (std::size_t k = 0; k < columns.size(); ++k)
        columns[k].push_back(row[k]);
    }
    write_csv("slicing", aspect == any ? "trade_any.csv" : fmt::format("trade_{}.csv", aspect),
              {"limit_m", "blocks", "radius_m", "mass_kg", "step_s", "evaluations_per_step", "evaluations_per_second"},
              columns);
  }

  report.record({"trade: volume, largest error of all limits",
                 "1",
                 Kind::exact,
                 "conservation of volume: cuts lose nothing",
                 0,
                 {1e-12, 0},
                 "each cut rounds the volumes of two children, some 1e-15 of theirs"},
                worst_volume);
  report.record(
      {"trade: smallest inscribed radius over the limit",
       "1",
       Kind::limit,
       "promise: slicing.hpp",
       1,
       {1e-9, 0, Bound::at_least},
       "the box obeys every limit, so every block must, except for the rounding of a finished block's radius"},
      slimmest);
  report.record({"trade: largest aspect ratio over the limit",
                 "1",
                 Kind::limit,
                 "promise: slicing.hpp",
                 1,
                 {1e-9, 0, Bound::at_most},
                 "likewise"},
                longest);

  const Assembly &fine = open_aspect.front(), &coarse = open_aspect.back();
  report.report("trade: blocks without limits", "1", static_cast<double>(fine.blocks), "rock_mass.toml");
  report.report("trade: blocks with a smallest radius of 0.2 m", "1", static_cast<double>(coarse.blocks), "likewise");
  report.report("trade: work for a second without limits, over that with 0.2 m", "1",
                (fine.evaluations / fine.step) / (coarse.evaluations / coarse.step), "contact evaluations");
  report.report("trade: power of the smallest radius with which the time step grows", "1",
                std::log(coarse.step / fine.step) / std::log(coarse.smallest_radius / fine.smallest_radius),
                "1/2 for blocks of one shape");
}

TEST(SlicingTrade, TheTimeStepGrowsWithTheRootOfTheSize) {
  CaseReport report("slicing", {"trade: time step of blocks twice as large, over the root of two"});
  // the same rock mass at twice the scale: blocks, joints, limits
  std::vector<std::string> twice{"domain.box.max=[10, 8, 8]"};
  for (const char* set : {"bedding", "steep", "cross"}) {
    twice.push_back(fmt::format("joint_sets.{}.intensity=0.6", set));
    twice.push_back(fmt::format("joint_sets.{}.size_mean=6", set));
    twice.push_back(fmt::format("joint_sets.{}.size_deviation=1.2", set));
  }
  const char* walls[][2] = {{"floor", "{ min = [-2, -2, -2], max = [12, 10, 0] }"},
                            {"west", "{ min = [-2, -2, 0], max = [0, 10, 8] }"},
                            {"east", "{ min = [10, -2, 0], max = [12, 10, 8] }"},
                            {"south", "{ min = [0, -2, 0], max = [10, 0, 8] }"},
                            {"north", "{ min = [0, 8, 0], max = [10, 10, 8] }"}};
  for (const auto& [name, box] : walls)
    twice.push_back(fmt::format("blocks.{}.box={}", name, box));
  const Assembly small = measured(prepared(0.1, 10)), large = measured(prepared(0.2, 10, twice));
  EXPECT_EQ(small.blocks, large.blocks);
  report.record({"trade: time step of blocks twice as large, over the root of two",
                 "1",
                 Kind::exact,
                 "closed form: stiffness per area times area over mass",
                 1,
                 {1e-9, 0},
                 "similar blocks to the last digits; the first step decides, before any motion"},
                large.step / small.step / std::sqrt(2.0));
}

// A square of 10 m: a joint that cuts off a small corner, one within that corner, three across the diagonal.
Prepared<2> corner(const std::vector<std::string>& overrides) {
  std::string text = R"(
preset = "thesis"
dimension = 2
density = 2600
domain = { box = { min = [0, 0], max = [10, 10] } }
joint_properties = [{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e9, friction_deg = 35 }]
stage = [{ name = "run", kind = "run", duration_s = 1 }]
slicing = { smallest_inscribed_radius = 0, order = "given" }
[[joints]]
name = "corner"
dip = 45
dip_direction = 90
point = [0.5, 0.5]
shape = "trace"
length = 3
[[joints]]
name = "diagonal"
dip = 45
dip_direction = 270
point = [0.2, 0.2]
shape = "trace"
length = 0.3
)";
  for (const int y : {3, 5, 7})
    text += fmt::format(R"(
[[joints]]
name = "level {0}"
dip = 0
point = [{0}, {0}]
shape = "trace"
length = 2
)",
                        y);
  return prepare<2>(parse_scene(text, "corner.toml", overrides));
}

TEST(SlicingTrade, ALargerLimitCanMakeMoreBlocks) {
  CaseReport report("slicing");
  const auto count = [&](const std::string& quantity, double expected, const std::vector<std::string>& overrides) {
    report.record({"trade: blocks of the cornered square" + quantity,
                   "1",
                   Kind::exact,
                   "geometry: by hand",
                   expected,
                   {0.5, 0},
                   "a count"},
                  static_cast<double>(corner(overrides).model.bodies.size()));
  };
  const std::string limit = "slicing.smallest_inscribed_radius=0.5", ignored = "slicing.ends=ignored";
  // the corner, of 0.29 m, confines the diagonal; left uncut, the diagonal divides the whole square, and each of the
  // three joints divides both halves
  count(", joints with an end, no limit", 6, {});
  count(", joints with an end, 0.5 m", 8, {limit});
  // joints without an end: refusing a cut can only merge cells of their arrangement
  count(", joints without an end, no limit", 10, {ignored});
  count(", joints without an end, 0.5 m", 8, {limit, ignored});
}

}  // namespace
}  // namespace voussoir::cases::trade_test
