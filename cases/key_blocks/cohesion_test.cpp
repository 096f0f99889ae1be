// Hoek & Bray's wedge by distinct elements: two joints share a cohesion that slip keeps, softens or takes. The closed
// form by which `check` and the sentence of a search tell what brittle bonds give, against the reference's.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numeric>

#include "cases/judged_scene.hpp"
#include "core/run/brittle_factor.hpp"
#include "reference/key_blocks/shared_cohesion.hpp"
#include "reference/key_blocks/slope_wedge.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::cohesion_test {
namespace {

using verification::CaseReport;
using verification::Kind;

constexpr double normal_stiffness = 1e11, bracket = 2e-4;  // Pa/m and width, as hoek_and_bray.toml states them

reference::ElasticWedge elastic_wedge() {
  const auto plane = [](double dip, double direction) {
    return reference::PlaneAngles{dip * degree, direction * degree};
  };
  constexpr double foot = 0.3048;
  const reference::SlopeWedgeSolid solid = solid_of(reference::SlopeWedge{
      plane(45, 105), plane(70, 235), plane(65, 185), plane(12, 195), 100 * foot, plane(70, 165), 40 * foot});
  reference::ElasticWedge block;
  block.area_a = solid.area_a;
  block.area_b = solid.area_b;
  block.wedge.weight = 2562.078921 * 9.81 * solid.volume;
  block.wedge.a = {45 * degree, 105 * degree, 20 * degree, 23940.12949 * solid.area_a, 0};
  block.wedge.b = {70 * degree, 235 * degree, 30 * degree, 47880.25898 * solid.area_b, 0};
  return block;
}

struct Law {
  std::string name;
  double slip = 0;  // m, of softening
};

std::vector<std::string> overrides_of(double ratio, const Law& law) {
  // the crack has a hundred thousandth of the joints' stiffnesses
  std::vector<std::string> sets{
      fmt::format("joint_properties.crack.shear_stiffness={:g}", 1e-5 * ratio * normal_stiffness)};
  for (const char* joint : {"A", "B"}) {
    const std::string table = fmt::format("joint_properties.{}.", joint);
    sets.push_back(table + fmt::format("shear_stiffness={:g}", ratio * normal_stiffness));
    sets.push_back(table + fmt::format("cohesion_law=\"{}\"", law.name));
    if (law.slip > 0) sets.push_back(table + fmt::format("cohesion_slip_m={:g}", law.slip));
  }
  // what softens is left to relaxation, and its failure is a displacement
  if (law.slip > 0) sets.push_back("stage.safety.failure_displacement=0.02");
  return sets;
}

SceneRun run_wedge(double ratio, const Law& law) {
  return run("hoek_and_bray.toml", overrides_of(ratio, law));
}

double judge(CaseReport& report, double ratio, const Law& law, double expected, double tolerance,
             const std::string& because) {
  const SceneRun done = run_wedge(ratio, law);
  const std::string of = law.slip > 0 ? fmt::format(" over {:g} mm", 1e3 * law.slip) : "";
  report.record({fmt::format("factor, {} cohesion{}, ks/kn = {:g}", law.name, of, ratio),
                 "1",
                 Kind::exact,
                 "closed form, reference/key_blocks/shared_cohesion",
                 expected,
                 {tolerance, 0},
                 because},
                value(done, "factor_of_safety"), cost(done));
  if (law.slip > 0)
    report.record({fmt::format("relative energy error{}", of),
                   "1",
                   Kind::limit,
                   "conservation",
                   0,
                   {1e-6, 0, verification::Bound::at_most},
                   "demanded of the law (core/joint_laws)"},
                  done.results.energy.relative_error());
  return value(done, "factor_of_safety");
}

const std::string by_bracket = "the bracket";

double judge_plastic(CaseReport& report, double ratio) {
  return judge(report, ratio, {"plastic"}, solve_wedge(elastic_wedge().wedge).factor_of_safety, bracket, by_bracket);
}

void judge_softening(CaseReport& report, double slip) {
  const reference::ElasticWedge block = elastic_wedge();
  constexpr double ratio = 1e-3;
  // shear across the line of sliding takes of the closed form for ks/kn -> 0 what it takes of the first slip
  const double across = first_slip_factor(block, ratio) / first_slip_factor(block, 0);
  judge(report, ratio, {"softening", slip}, across * softening_factor(block, 0, slip, ratio * normal_stiffness),
        2 * bracket, "the bracket, and as much for the correction of 0.0019 by shear across the line");
}

TEST(SharedCohesion, PlasticCohesionGivesLimitEquilibriumAtAnyStiffness) {
  CaseReport report("key_blocks", {"factor, plastic cohesion, ks/kn = 1"});
  std::vector<double> ratios{1, 0.1}, found;
  for (const double ratio : ratios)
    found.push_back(judge_plastic(report, ratio));
  write_csv("key_blocks", "plastic.csv", {"ratio", "factor"}, {ratios, found});
}

TEST(SharedCohesion, BrittleCohesionDependsOnStiffness) {
  CaseReport report("key_blocks", {"factor, brittle cohesion, ks/kn = 0.01"});
  const reference::ElasticWedge block = elastic_wedge();
  std::vector<double> ratios{1, 0.1, 0.01}, found;
  for (const double ratio : ratios)
    found.push_back(judge(report, ratio, {"brittle"}, brittle_factor(block, ratio), bracket, by_bracket));
  write_csv("key_blocks", "brittle.csv", {"ratio", "factor"}, {ratios, found});
  ratios.clear();
  std::vector<double> brittle, plastic;
  for (double exponent = -4; exponent <= 0.301; exponent += 0.05) {
    ratios.push_back(std::pow(10, exponent));
    brittle.push_back(brittle_factor(block, ratios.back()));
    plastic.push_back(solve_wedge(block.wedge).factor_of_safety);
  }
  write_csv("key_blocks", "cohesion_form.csv", {"ratio", "brittle", "plastic"}, {ratios, brittle, plastic});
}

// Of the program, which judges the wedge's faces as it sliced them; at ks/kn = 1 elastic shear would close the crack,
// and it gives none.
TEST(SharedCohesion, TheProgramsClosedFormIsTheReferences) {
  CaseReport report("key_blocks");
  for (const double ratio : {0.1, 0.01, 1e-4}) {
    const Survey<3> survey = judged("hoek_and_bray.toml", overrides_of(ratio, {"brittle"}));
    const SurveyRow<3>& row = only_block(survey);
    Block<3> block;
    gather<3>(survey.assembly, row.bodies, {}, block);
    std::vector<int> all(survey.assembly.model.properties.size());
    std::iota(all.begin(), all.end(), 0);
    report.record({fmt::format("closed form of brittle bonds by the program, ks/kn = {:g}", ratio),
                   "1",
                   Kind::exact,
                   "closed form, reference/key_blocks/shared_cohesion",
                   brittle_factor(elastic_wedge(), ratio),
                   {0, 1e-9},
                   "rounding: 1e-16 of coordinates up to 200 m, which areas of a few m2 magnify"},
                  brittle_factor(survey.assembly, block, row.bolted, all).value_or(0));
  }
}

TEST(SharedCohesion, SofteningCohesionHasItsPeak) {
  CaseReport report("key_blocks");
  for (const double slip : {1e-3, 3e-4})
    judge_softening(report, slip);
}

TEST(SharedCohesionLong, OnJointsSoftInShear) {
  CaseReport report("key_blocks");
  judge_plastic(report, 0.01);
  judge(report, 1e-3, {"brittle"}, brittle_factor(elastic_wedge(), 1e-3), bracket, by_bracket);
  judge_softening(report, 1e-2);
}

}  // namespace
}  // namespace voussoir::cases::cohesion_test
