// Oedometer tests of the rock mass, as Boon (2013), table 5.3.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "cases/tunnel/oedometer.hpp"

namespace voussoir::cases::oedometer_test {
namespace {

using verification::Bound;
using verification::CaseReport;
using verification::Kind;

const Overrides coarse{"slicing.smallest_inscribed_radius=0.5"};
const std::string thesis = "Boon (2013), table 5.3, Eqs 5.12 and 5.13",
                  network = "independent network of the same kind of blocks, reference/tunnel";
const std::string of_draws =
    "seven draws of 0.25 m differ by a standard deviation of 5 %, by how long their longest blocks are (NOTES.md)";

void report_both(CaseReport& report, const std::string& which, const Moduli& found, const std::string& note) {
  report.report("shear modulus, " + which, "Pa", found.shear, note, found.cost);
  report.report("Poisson's ratio, " + which, "1", found.poisson, note, found.cost);
}

TEST(Oedometer, TheRockMassIsAsStiffAsPublished) {
  CaseReport report("tunnel", {"shear modulus", "Poisson's ratio"});
  const Moduli found = pressed_down({});
  report.record({"shear modulus", "Pa", Kind::published, thesis, 0.527e9, {0, 0.05}, of_draws}, found.shear,
                found.cost);
  report.record(
      {"Poisson's ratio", "1", Kind::published, thesis, 0.37, {0.02, 0}, "rounded to 0.01; draws differ by 0.004"},
      found.poisson, found.cost);
  report.record({"shear modulus, by a network",
                 "Pa",
                 Kind::published,
                 network,
                 0.517e9,
                 {0, 0.1},
                 of_draws + "; a network of other draws, two standard deviations"},
                found.shear, found.cost);
  const Moduli rough = pressed_down({"joint_properties.rock.friction_deg=89"});
  report.record({"shear modulus at 89° over that at 35°",
                 "1",
                 Kind::published,
                 thesis + ": 0.529 over 0.527",
                 1,
                 {0.01, 0},
                 "few joints slip; the thesis finds 0.4 %, and its rounding is half a per cent"},
                rough.shear / found.shear, rough.cost);
}

TEST(Oedometer, TheRockMassIsAnisotropic) {
  CaseReport report("tunnel");
  const Moduli found = pressed_across({});
  report.record({"shear modulus, pressed horizontally",
                 "Pa",
                 Kind::published,
                 network,
                 0.64e9,
                 {0, 0.1},
                 of_draws + "; two standard deviations"},
                found.shear, found.cost);
  report.record(
      {"Poisson's ratio, pressed horizontally", "1", Kind::published, network, 0.347, {0.02, 0}, "as vertically"},
      found.poisson, found.cost);
}

TEST(Oedometer, SmallerSpecimensAndLargerBlocks) {
  CaseReport report("tunnel");
  report_both(report, "20 m", pressed_down({}, 20), "thesis: 0.542 GPa, 0.36");
  report_both(report, "10 m", pressed_down({}, 10), "thesis: 0.536 GPa, 0.36");
  const Moduli large = pressed_down(coarse);
  report.record(
      {"shear modulus, blocks of 0.5 m", "Pa", Kind::published, network, 0.96e9, {0, 0.1}, of_draws + "; two of them"},
      large.shear, large.cost);
  report.record({"Poisson's ratio, blocks of 0.5 m", "1", Kind::published, network, 0.361, {0.02, 0}, "as of 0.25 m"},
                large.poisson, large.cost);
}

// The study's reference: many points along every face.
TEST(Oedometer, PointsAlongFaces) {
  CaseReport report("tunnel");
  Overrides fine = coarse;
  fine.push_back("joint_properties.rock.sub_contacts=16");
  const SceneRun test = run("oedometer.toml", fine);
  report.reference("plate_mean_displacement_y", value(test, "plate_mean_displacement_y"), "m");
}

TEST(OedometerLong, SevenDraws) {
  CaseReport report("tunnel");
  std::vector<double> shear, poisson;
  for (int seed = 0; seed < 7; ++seed) {
    const Moduli found = pressed_down(draw(seed));
    report_both(report, fmt::format("draw {}", seed), found, "thesis: 0.527 GPa, 0.37");
    shear.push_back(found.shear);
    poisson.push_back(found.poisson);
  }
  const auto mean = [](const std::vector<double>& x) { return std::accumulate(x.begin(), x.end(), 0.0) / x.size(); };
  const double middle = mean(shear);
  double variance = 0;
  for (const double g : shear)
    variance += (g - middle) * (g - middle) / (shear.size() - 1);
  report.report("shear modulus, mean of seven draws", "Pa", middle,
                fmt::format("standard deviation {:.3g} Pa", std::sqrt(variance)));
  report.report("Poisson's ratio, mean of seven draws", "1", mean(poisson), "thesis: 0.37");
}

}  // namespace
}  // namespace voussoir::cases::oedometer_test
