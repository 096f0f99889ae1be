// Up to which rounding is the shape acceptable? Four problems with known sharp results, over r/size and k: the effect
// of rounding, the cost of a contact, and the rounding at which the effect passes 5, 1 and 0.1 %.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

#include "cases/potential_particles/pack.hpp"
#include "cases/potential_particles/problems.hpp"
#include "reference/potential_particles/rounded_blocks.hpp"
#include "reference/wedge/wedge.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::study_test {
namespace {

using verification::Bound;
using verification::CaseReport;
using verification::Kind;

struct Grid {
  std::vector<double> radii, sphericities;  // r of the size; k
};
const Grid fine{{1e-4, 1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.3, 0.5}, {0, 1e-3, 1e-2, 0.1, 0.3, 0.6, 0.9}};
const Grid of_packs{{1e-4, 1e-3, 1e-2, 3e-2, 0.1, 0.3}, {1e-3, 1e-2, 0.1, 0.3, 0.6}};  // minutes each
const Grid coarse{{1e-3, 1e-2, 0.1, 0.5}, {0, 0.1, 0.6}};
constexpr std::array levels{0.05, 0.01, 0.001};

double sharp_angle() {
  reference::Wedge wedge;
  wedge.a = {40 * degree, 130 * degree};
  wedge.b = {60 * degree, 220 * degree};
  return *reference::critical_friction(wedge) / degree;
}

constexpr double beam_stiffness = 100e6, inscribed = 0.023;  // as problems.cpp states them

// --- k = 0, in closed form

TEST(PotentialParticles, RoundedBlocksMatchTheirClosedForms) {
  CaseReport report("potential_particles");
  const Trial wedge = sliding_wedge({0.1, 0.1});
  report.record({"wedge, r/size 0.1, k 0.1: critical friction",
                 "deg",
                 Kind::exact,
                 "Hoek & Bray (1974): faces that bulge alike still touch along the sharp ones",
                 sharp_angle(),
                 {0.05, 0},
                 "bracket 0.005, settlement 0.002; over a face the normal rotates by at most k r/(2 R) = 0.0003 rad, R "
                 "some 20 r, worth 0.02"},
                wedge.value, {wedge.evaluations, wedge.seconds});
  for (const double q : {0.01, 0.1}) {
    const Trial beam = hinged_beam({q, 0});
    const double rotation = beam_rotation({q, 0});
    const double expected = reference::rounded_hinged_beam({{}, beam_stiffness, q * inscribed}, rotation).weight /
                            reference::rounded_hinged_beam({{}, beam_stiffness, 0}, rotation).weight;
    report.record({fmt::format("hinged beam, r/size {}, k 0: weight over that of the sharp hinge", q),
                   "1",
                   Kind::exact,
                   "equilibrium: arcs of r, forces through their centres",
                   expected,
                   {0, 0.005},
                   "the push leaves an oscillation of at most 0.4 % of the weight (case hingedbeam)"},
                  beam.value, {beam.evaluations, beam.seconds});
  }
  const Trial peak = hinged_beam_peak({0.1, 0});
  report.record({"hinged beam, r/size 0.1, k 0: peak weight",
                 "N",
                 Kind::exact,
                 "equilibrium: arcs of r, forces through their centres",
                 reference::rounded_hinged_beam_peak({{}, beam_stiffness, 0.1 * inscribed}).weight,
                 {0, 0.005},
                 "as above"},
                peak.value, {peak.evaluations, peak.seconds});
  const Trial sharp = hinged_beam({0, 0});
  report.report("hinged beam, half-space blocks: weight over that of the sharp hinge", "1", sharp.value,
                "4/9 at first: the resultant is at a third of the overlap, whose depth there is two thirds of the "
                "corner's",
                {sharp.evaluations, sharp.seconds});
  const Trial column = settled_column({0.1, 0});
  const double half = 0.5, r = 0.1 * half;
  report.record({"column, r/size 0.1, k 0: settlement over that of the sharp blocks",
                 "1",
                 Kind::exact,
                 "equilibrium: the weight that remains after rounding: 1 - (4 - pi) r2 of a square of 1 m",
                 1 - (4 - std::numbers::pi) * r * r,
                 {1.4e-4, 0},
                 "equilibrium leaves 4e-5 (case column), the mass is right to 1e-4"},
                column.value, {column.evaluations, column.seconds});
}

// The k at which a column of eight is no longer stable in the closed form, at one r/size.
double critical_sphericity(double radius) {
  const double least = reference::least_joint_radius(8);
  double stands = 1e-6, falls = 0.99;
  for (int i = 0; i < 60; ++i) {
    const double k = (stands + falls) / 2;
    double joint = 0;  // a body that is too small for this rounding is not stable
    try {
      joint = joint_radius({radius, k});
    } catch (const std::domain_error&) {
    }
    (joint > least ? stands : falls) = k;
  }
  return stands;
}

TEST(PotentialParticles, AColumnIsStableIfItsFacesAreFlatEnough) {
  CaseReport report("potential_particles");
  for (const double radius : {0.1, 0.3}) {
    const double critical = critical_sphericity(radius);
    const Trial stands = leaning_column({radius, critical / 1.5}), falls = leaning_column({radius, critical * 1.5});
    const std::string at = fmt::format(" of its critical k = {:.3f}, r/size {}", critical, radius);
    const std::string source =
        "equilibrium: tilts of blocks that roll on each other: least joint radius 12.59 heights for eight";
    report.record({"column, two thirds" + at + ": top sideways",
                   "m",
                   Kind::limit,
                   source,
                   0,
                   {0.01, 0, Bound::at_most},
                   "a push of 1 mm/s makes it oscillate by some mm, without growth"},
                  std::abs(stands.value), {stands.evaluations, stands.seconds});
    report.record({"column, three halves" + at + ": top sideways",
                   "m",
                   Kind::limit,
                   source,
                   0.5,
                   {0.25, 0, Bound::at_least},
                   "a growing lean continues: a quarter of an edge is far beyond any oscillation"},
                  std::abs(falls.value), {falls.evaluations, falls.seconds});
  }
}

// --- the study

struct Point {
  double radius, sphericity, error, nanoseconds, load;  // error: NaN without a result
};

// the r at which the error passes a level: the largest r up to which all smaller ones stay below, between points on the
// logarithmic line; none if the smallest is already above
std::optional<double> boundary(const std::vector<Point>& points, double sphericity, double level) {
  std::optional<double> last;
  double last_error = 0;
  for (const Point& p : points) {
    if (p.sphericity != sphericity || !std::isfinite(p.error)) continue;
    if (p.error > level) {
      if (!last) return {};
      const double low = std::log(std::max(last_error, 1e-3 * level)), high = std::log(p.error);
      const double fraction = (std::log(level) - low) / (high - low);
      return std::exp(std::log(*last) + fraction * (std::log(p.radius) - std::log(*last)));
    }
    last = p.radius;
    last_error = p.error;
  }
  return last;
}

void write(const std::string& problem, const Grid& grid, const std::vector<Point>& points) {
  std::vector<std::vector<double>> columns(5), lines(1 + levels.size());
  for (const Point& p : points) {
    const std::array row{p.radius, p.sphericity, p.error, p.nanoseconds, p.load};
    for (std::size_t k = 0; k < row.size(); ++k)
      columns[k].push_back(row[k]);
  }
  write_csv("potential_particles", "study_" + problem + ".csv",
            {"radius", "sphericity", "error", "nanoseconds", "load_seconds"}, columns);
  for (const double k : grid.sphericities) {
    lines[0].push_back(k);
    for (std::size_t l = 0; l < levels.size(); ++l)
      lines[l + 1].push_back(boundary(points, k, levels[l]).value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  write_csv("potential_particles", "boundary_" + problem + ".csv",
            {"sphericity", "five_percent", "one_percent", "tenth_percent"}, lines);
}

struct Problem {
  std::string name;
  std::function<Trial(const RelativeRounding&)> solve;
  std::function<double(double)> error;  // of a trial's value
};

Problem wedge_problem() {
  return {"wedge", sliding_wedge, [exact = sharp_angle()](double angle) { return std::abs(angle / exact - 1); }};
}
Problem beam_problem() {
  return {"beam", hinged_beam, [](double ratio) { return std::abs(ratio - 1); }};
}
Problem column_problem() {
  return {"column", settled_column, [](double ratio) { return std::abs(ratio - 1); }};
}

struct Findings {
  std::vector<Point> points;
  std::string unanswered;  // which points
};

// If there is no such body, there is no point.
Findings vary(const Problem& problem, const Grid& grid) {
  Findings found;
  for (const double k : grid.sphericities)
    for (const double radius : grid.radii) {
      try {
        const Trial trial = problem.solve({radius, k});
        const double error = trial.answered ? problem.error(trial.value) : std::numeric_limits<double>::quiet_NaN();
        found.points.push_back({radius, k, error, trial.nanoseconds(), trial.load_seconds});
        if (!trial.answered) {
          found.unanswered += fmt::format("{}r/size {:g}, k {:g}", found.unanswered.empty() ? "" : "; ", radius, k);
          fmt::print("{}, r/size {:g}, k {:g}: {}\n", problem.name, radius, k, trial.why);
        }
        write(problem.name, grid, found.points);
      } catch (const std::domain_error&) {
      }
    }
  return found;
}

void write_standing_columns(const Grid& grid) {
  std::vector<double> sphericity;
  for (const double r : grid.radii)
    sphericity.push_back(critical_sphericity(r));
  write_csv("potential_particles", "column_stands.csv", {"radius", "sphericity"}, {grid.radii, sphericity});
}

// the short sibling: a coarse grid, without the pack
TEST(PotentialParticles, EffectOfRoundingIsWithinItsBoundaries) {
  CaseReport report("potential_particles");
  for (const Problem& problem : {wedge_problem(), beam_problem(), column_problem()}) {
    const Findings found = vary(problem, coarse);
    report.record({"coarse study, " + problem.name + ": error at r/size 0.001, k 0",
                   "1",
                   Kind::limit,
                   "comparison: a sharp shape's",
                   0,
                   {0.005, 0, Bound::at_most},
                   "twice r/size, and the error of its own test: wedge 0.0015, beam 0.004, column 0.0001"},
                  found.points.front().error);
    report.report("coarse study, " + problem.name + ": error at r/size 0.1, k 0", "1", found.points[2].error,
                  "the study's long sibling has the whole grid");
  }
  write_standing_columns(coarse);
}

void study(CaseReport& report, const Problem& problem, const Grid& grid) {
  const Trial sharp = problem.solve({});
  const Findings found = vary(problem, grid);
  double most = 0, least = INFINITY;
  for (const Point& p : found.points)
    if (std::isfinite(p.error)) {
      most = std::max(most, p.nanoseconds);
      least = std::min(least, p.nanoseconds);
    }
  report.report("study, " + problem.name + ": points without an answer", "1",
                static_cast<double>(std::count_if(found.points.begin(), found.points.end(),
                                                  [](const Point& p) { return !std::isfinite(p.error); })),
                found.unanswered.empty() ? "none" : found.unanswered);
  const std::string note = "processor time of this run";
  report.report("study, " + problem.name + ": a contact of half-spaces", "ns", sharp.nanoseconds(), note);
  report.report("study, " + problem.name + ": the cheapest contact of particles", "ns", least, note);
  report.report("study, " + problem.name + ": the dearest contact of particles", "ns", most, note);
  for (const double k : {0.0, 0.01, 0.1})
    for (const double level : levels) {
      const auto limit = boundary(found.points, k, level);
      report.report(fmt::format("study, {}, k {}: largest r/size for an error of {} %", problem.name, k, 100 * level),
                    "1", limit.value_or(0),
                    limit ? "between points of the study" : "larger already at the least r with a result");
    }
}

TEST(PotentialParticlesLong, WhichRoundingIsAcceptableForAWedge) {
  CaseReport report("potential_particles");
  study(report, wedge_problem(), fine);
}

TEST(PotentialParticlesLong, WhichRoundingIsAcceptableForAHingedBeam) {
  CaseReport report("potential_particles");
  study(report, beam_problem(), fine);
}

TEST(PotentialParticlesLong, WhichRoundingIsAcceptableForAColumn) {
  CaseReport report("potential_particles");
  study(report, column_problem(), fine);
  write_standing_columns(fine);
}

TEST(PotentialParticlesLong, WhichRoundingIsAcceptableForASettlingPack) {
  CaseReport report("potential_particles");
  const Pack pack = settle_pack();
  const Trial sharp = settled_pack(pack, {});
  ASSERT_TRUE(sharp.answered);
  report.report("study, pack: half-space blocks that settle on, of the height", "1", sharp.value,
                "resolution of the study");
  study(report,
        {"pack", [&](const RelativeRounding& rounding) { return settled_pack(pack, rounding); },
         [&](double drop) { return std::abs(drop - sharp.value); }},
        of_packs);
}

}  // namespace
}  // namespace voussoir::cases::study_test
