// Vaiont slide, western section: the critical friction of its slide, by rigid-block limit analysis of few and of many
// blocks against the closed form of blocks behind vertical cross joints.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "app/limit/limit_analysis.hpp"
#include "cases/case_tools.hpp"
#include "reference/vaiont/section.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::vaiont_test {
namespace {

using reference::SectionBlock;
using reference::SectionLoads;
using verification::Bound;
using verification::CaseReport;
using verification::Check;
using verification::Kind;

constexpr double vertical = 90 * degree, rock = 40 * degree;
constexpr double unit_weight = 2395.5 * 9.81;  // N/m3, as scene.toml states it; with water it matters

struct Cut {
  std::string scene, name;
};
const std::vector<Cut> cuts{
    {"scene.toml", "3 blocks"}, {"beds_80.toml", "33 blocks, 80 m"}, {"beds_40.toml", "114 blocks, 40 m"}};
const std::vector<Cut> wet_cuts{
    {"wet.toml", "3 blocks"}, {"wet_80.toml", "33 blocks, 80 m"}, {"wet_40.toml", "114 blocks, 40 m"}};

LimitAnalysis<2> analyse(const std::string& scene, const std::vector<std::string>& overrides,
                         const LimitRequest& request = {.properties = {"slide"}, .with_dilation = true}) {
  LimitAnalysis<2> found =
      analyse_limit<2>(load_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / scene, overrides), request);
  if (found.status != LimitStatus::found) throw std::runtime_error(scene + ": " + found.message);
  return found;
}

double answer(const LimitAnalysis<2>& analysis) {
  return analysis.values.front().second.value;
}

const std::string source = "blocks that translate behind mobilised cross joints, reference/vaiont";

// By each of the three cuts; the closed form has only the bends' cross joints.
void judge_angle(CaseReport& report, const std::string& of, double expected, const std::vector<std::string>& overrides,
                 const std::vector<Cut>& scenes = cuts) {
  for (const Cut& cut : scenes)
    report.record({"critical friction, " + of + ", " + cut.name,
                   "deg",
                   Kind::exact,
                   source,
                   expected / degree,
                   {1e-5, 0},
                   "the bracket is 1e-6 wide; the planes' dips are stated to more digits"},
                  answer(analyse(cut.scene, overrides)));
}

double closed_form(const SectionLoads& loads, double cross = rock, double cross_dip = vertical, double seat_dip = 0) {
  return critical_slide_friction(section_blocks(reference::vaiont_section(seat_dip), loads, cross_dip), cross,
                                 cross_dip);
}

TEST(Vaiont, DryHasTheFrictionOfBlocksBehindMobilisedJoints) {
  CaseReport report("vaiont", {"critical friction, dry, 3 blocks", "critical friction, seat 1.8°, 3 blocks"});
  judge_angle(report, "dry", closed_form({}), {});
  judge_angle(report, "rock joints 30°", closed_form({}, 30 * degree), {"joint_properties.rock.friction_deg=30"});
  judge_angle(report, "seat 1.8°", closed_form({}, rock, vertical, 1.8 * degree), {"joints.seat.dip=1.8"});
}

SectionLoads water(double above_the_seat) {
  SectionLoads loads;
  loads.unit_weight = unit_weight;
  loads.table = {{0, 620 + above_the_seat}};
  return loads;
}

TEST(Vaiont, WetNeedsMore) {
  CaseReport report("vaiont", {"critical friction, water 90 m, 3 blocks", "critical friction, drawn down, 3 blocks"});
  judge_angle(report, "water 90 m", closed_form(water(90)), {}, wet_cuts);
  SectionLoads drawn_down = water(90);
  drawn_down.table = {{900, 710}, {1137.590, 680}};
  judge_angle(report, "drawn down", closed_form(drawn_down), {"water.reservoir.table=[[900, 710], [1137.590, 680]]"},
              wet_cuts);
  std::vector<double> levels, found, form_levels, form;
  for (double level = 0; level < 231; level += 30) {
    levels.push_back(level);
    found.push_back(
        answer(analyse("wet.toml", {fmt::format("water.reservoir.table=[[900, {0}], [1137.590, {0}]]", 620 + level)})));
  }
  for (double level = 0; level < 231; level += 2) {
    form_levels.push_back(level);
    form.push_back(closed_form(water(level)) / degree);
  }
  write_csv("vaiont", "levels.csv", {"water_m", "limit_deg"}, {levels, found});
  write_csv("vaiont", "levels_form.csv", {"water_m", "closed_form_deg"}, {form_levels, form});
}

// Inclined cross joints through both bends: the force from block to block is inclined with them.
TEST(Vaiont, CrossJointsIntoTheSlope) {
  CaseReport report("vaiont", {"critical friction, cross joints 71.25°", "critical friction, cross joints 50°"});
  const auto leaning = [](double dip) {
    return std::vector<std::string>{fmt::format("joints.upper cross.dip={}", dip),
                                    fmt::format("joints.lower cross.dip={}", dip)};
  };
  report.record({"critical friction, cross joints 71.25°",
                 "deg",
                 Kind::exact,
                 source,
                 closed_form({}, rock, 71.25 * degree) / degree,
                 {1e-5, 0},
                 "as for vertical ones"},
                answer(analyse("scene.toml", leaning(71.25))));
  const LimitAnalysis<2> steep = analyse("scene.toml", leaning(50));
  report.record({"critical friction, cross joints 50°",
                 "deg",
                 Kind::limit,
                 source,
                 closed_form({}, rock, 50 * degree) / degree,
                 {0, 0, Bound::at_least},
                 fmt::format("one mechanism is a lower bound of the angle; here two of three blocks also rotate, "
                             "{:.2g} % of the kinetic energy",
                             100 * steep.mechanism.rotation_fraction)},
                answer(steep));
  EXPECT_EQ(steep.mechanism.turning, 2);
}

// for the figure: the blocks of one cut, each part a closed line
void write_blocks(const Model<2>& model, const std::string& file, bool fixed) {
  std::ofstream out(verification::case_output("vaiont") / file);
  out << "x_m,elevation_m\n";
  for (const Body<2>& body : model.bodies) {
    if (!body.present || body.fixed != fixed) continue;
    for (const Polytope<2>& part : body.parts) {
      for (const int corner : closed_ring(part)) {
        const Vector<2> at = model.origin + body.reference + part.vertices[corner];
        out << at[0] << ',' << at[1] << '\n';
      }
      out << '\n';
    }
  }
  if (!out) throw std::runtime_error("cannot write " + file);
}

TEST(VaiontFigure, HasItsBlocks) {
  const LimitAnalysis<2> analysis = analyse("beds_80.toml", {});
  write_blocks(analysis.model, "fixed.csv", true);
  write_blocks(analysis.model, "free.csv", false);
  std::vector<double> x, y;
  for (const reference::SectionPoint& bend : reference::vaiont_section().slide) {
    x.push_back(bend.x);
    y.push_back(bend.y);
  }
  write_csv("vaiont", "slide.csv", {"x_m", "elevation_m"}, {x, y});
}

TEST(Vaiont, HorizontalCoefficient) {
  CaseReport report("vaiont");
  const std::vector<SectionBlock> blocks = section_blocks(reference::vaiont_section(), {});
  const double expected = critical_horizontal_coefficient(blocks, {25 * degree, rock});
  for (const Cut& cut : cuts)
    report.record({"horizontal coefficient, slide 25°, " + cut.name,
                   "1",
                   Kind::exact,
                   source,
                   expected,
                   {0, 1e-5},
                   "corners rounded to 0.1 mm; the solver's tolerance is 1e-7 of a block's weight"},
                  answer(analyse(cut.scene, {"joint_properties.slide.friction_deg=25"},
                                 {.load = limit_load("right"), .with_dilation = true})));
}

TEST(Vaiont, FactorOfSafety) {
  CaseReport report("vaiont");
  const std::vector<SectionBlock> blocks = section_blocks(reference::vaiont_section(), {});
  const double expected = section_factor_of_safety(blocks, {12 * degree, rock});
  LimitRequest request;
  request.factor = request.with_dilation = true;
  for (const Cut& cut : cuts)
    report.record({"factor of safety, slide 12°, rock 40°, " + cut.name,
                   "1",
                   Kind::exact,
                   source,
                   expected,
                   {0, 1e-5},
                   "corners rounded to 0.1 mm; the bracket is less"},
                  answer(analyse(cut.scene, {"joint_properties.slide.friction_deg=12"}, request)));
}

}  // namespace
}  // namespace voussoir::cases::vaiont_test
