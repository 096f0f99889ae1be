// The contact kernel's own trade: the cost of accuracy, setting by setting, and the radius r that the normal needs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cases/case_tools.hpp"
#include "cases/kernel_trade/radius.hpp"
#include "cases/kernel_trade/trade.hpp"

namespace voussoir::cases::kernel_trade_test {
namespace {

using namespace trade;
using verification::CaseReport;
using verification::Kind;

constexpr std::array targets{1e-2, 1e-4, 1e-6, 1e-9};

// 16 roundings of coordinates of 3 m over slacks of half the thinnest overlap, 5e-5 m: the error of double arithmetic
constexpr double rounding_floor = 16 * 1.1e-16 * 3 / 5e-5;

// A decrement λ before the last step leaves at most (λ/(1-λ))² after it, and a point at decrement μ is within μ/(1-μ)
// of the centre (self-concordance: Nesterov & Nemirovskii 1994; Boyd & Vandenberghe 2004, 9.6.4)
double newton_bound(double tolerance) {
  const double left = std::pow(tolerance / (1 - tolerance), 2);
  return left / (1 - left) + rounding_floor;
}

std::vector<Measured> measure_all(const std::vector<TouchingPair>& pairs) {
  std::vector<Measured> all;
  for (int k = 1; k <= 9; ++k) {
    const double tolerance = std::pow(10.0, -k);
    all.push_back(measure_kernel(pairs, Family::cold, tolerance));
    all.push_back(measure_kernel(pairs, Family::warm, tolerance));
    all.push_back(measure_plain<double>(pairs, Family::plain_double, tolerance));
    all.push_back(measure_plain<float>(pairs, Family::plain_float, tolerance));
  }
  for (int k = 1; k <= 15; k += 2)
    all.push_back(measure_lp(pairs, std::pow(10.0, -k)));
  const double usual = ContactSettings{}.newton_tolerance;
  all.push_back(measure_kernel(pairs, Family::centroid, usual));
  all.push_back(measure_kernel(pairs, Family::chebyshev, usual));
  mark_front(all);
  return all;
}

// a file of the settings that `belongs` chooses, one row each
template <class Choice>
void write_settings(const std::string& name, const std::vector<Measured>& all, Choice&& belongs) {
  std::vector<std::string> header{"tolerance", "failed", "visits", "nanoseconds", "worst"};
  header.insert(header.end(), quantity_names.begin(), quantity_names.end());
  std::vector<std::vector<double>> columns(header.size());
  for (const Measured& m : all) {
    if (!belongs(m)) continue;
    std::vector<double> row{m.tolerance, static_cast<double>(m.failed) / m.pairs, m.visits, m.nanoseconds,
                            m.worst_of_all()};
    row.insert(row.end(), m.worst.begin(), m.worst.end());
    for (std::size_t k = 0; k < row.size(); ++k)
      columns[k].push_back(row[k]);
  }
  write_csv("kernel_trade", name + ".csv", header, columns);
}

// one file per family, one per front; and, for horizontal lines, the distance of other definitions of the point
void write_tables(const std::vector<Measured>& all) {
  const std::pair<Family, const char*> files[] = {{Family::cold, "cold"},
                                                  {Family::warm, "warm"},
                                                  {Family::plain_double, "plain_double"},
                                                  {Family::plain_float, "plain_float"}};
  for (const auto& file : files)
    write_settings(file.second, all, [&](const Measured& m) { return m.family == file.first && m.failed < m.pairs; });
  write_settings("lp_tolerance", all,
                 [](const Measured& m) { return m.family == Family::lp_tolerance && m.failed == 0; });
  write_settings("front_warm", all, [](const Measured& m) { return m.on_front && m.family == Family::warm; });
  write_settings("front_new", all, [](const Measured& m) { return m.on_front && m.family != Family::warm; });

  std::vector<std::string> names{"visits"};
  std::vector<std::vector<double>> lines{{30, 3000}};
  for (const Measured& m : all)
    if (m.family == Family::centroid || m.family == Family::chebyshev)
      for (int q = 0; q < quantities; ++q) {
        names.push_back(fmt::format("{} {}", family_names[static_cast<int>(m.family)], quantity_names[q]));
        lines.emplace_back(2, m.median[q]);
      }
  write_csv("kernel_trade", "models.csv", names, lines);
}

// per target the cheapest Newton tolerance, for a new contact and for an existing one
void recommend(CaseReport& report, const std::vector<Measured>& all) {
  std::vector<std::vector<double>> columns(6);
  for (const Family family : {Family::cold, Family::warm})
    for (const double target : targets) {
      const Measured* best = cheapest(all, family, target);
      ASSERT_NE(best, nullptr) << family_names[static_cast<int>(family)] << ", " << target;
      report.report(
          fmt::format("Newton tolerance for {:.0e}, {}", target, family == Family::cold ? "new contact" : "warm"), "1",
          best->tolerance,
          fmt::format("worst error {:.1e}, {:.0f} planes looked at, {:.0f} ns in this run", best->worst_of_all(),
                      best->visits, best->nanoseconds));
      const std::array row{static_cast<double>(family), target, best->tolerance, best->visits, best->nanoseconds,
                           best->worst_of_all()};
      for (std::size_t k = 0; k < row.size(); ++k)
        columns[k].push_back(row[k]);
    }
  write_csv("kernel_trade", "recommended.csv", {"family", "target", "tolerance", "visits", "nanoseconds", "worst"},
            columns);
}

void report_failures(CaseReport& report, const std::vector<Measured>& all) {
  std::string list;
  int settings = 0;
  for (const Measured& m : all) {
    if (m.failed == 0) continue;
    ++settings;
    list += fmt::format("{}{} {:.0e}: {} of {}", list.empty() ? "" : "; ", family_names[static_cast<int>(m.family)],
                        m.tolerance, m.failed, m.pairs);
  }
  report.report("settings that failed", "1", settings, list);
}

// the alternatives: another definition of the point, and single precision
void report_alternatives(CaseReport& report, const std::vector<Measured>& all) {
  const Measured* single = nullptr;
  for (const Measured& m : all) {
    if (m.family == Family::plain_float && m.failed == 0 && (!single || m.worst_of_all() < single->worst_of_all()))
      single = &m;
    if (m.family != Family::centroid && m.family != Family::chebyshev) continue;
    report.report(
        fmt::format("point, {} instead", family_names[static_cast<int>(m.family)]), "1", m.median[0],
        fmt::format("median, fraction of the overlap; normal {:.1e} rad, overlap {:.1e}, area {:.1e}; {:.0f} ns "
                    "in this run",
                    m.median[1], m.median[2], m.median[3], m.nanoseconds));
  }
  ASSERT_NE(single, nullptr);
  report.report("least worst error in single precision", "1", single->worst_of_all(),
                fmt::format("plain kernel, no pair failed, Newton tolerance {:.0e}", single->tolerance));
}

TEST(KernelTrade, AccuracyAgainstWork) {
  CaseReport report("kernel_trade", {"point error over Newton's bound", "worst error at the default tolerance"});
  const std::vector<TouchingPair> pairs = make_pairs();
  const std::vector<Measured> all = measure_all(pairs);
  write_tables(all);
  recommend(report, all);
  report_failures(report, all);
  report_alternatives(report, all);

  const double usual = ContactSettings{}.newton_tolerance;
  double over_bound = 0, at_default = 0;
  for (const Measured& m : all) {
    if (m.family != Family::cold && m.family != Family::warm) continue;
    EXPECT_EQ(m.failed, 0);
    over_bound = std::max(over_bound, m.worst[0] / newton_bound(m.tolerance));
    if (std::abs(m.tolerance / usual - 1) < 0.1) at_default = std::max(at_default, m.worst_of_all());
  }
  report.record({"point error over Newton's bound",
                 "1",
                 Kind::limit,
                 "extended precision: long double; Boyd & Vandenberghe (2004), 9.6.4",
                 0,
                 {1, 0},
                 "the decrement before the last step bounds the distance after it, for every pair and tolerance"},
                over_bound);
  report.record({"worst error at the default tolerance",
                 "1",
                 Kind::limit,
                 "extended precision: long double",
                 0,
                 {1e-9, 0},
                 "the default leaves (1e-5)² of the overlap and the rounding of slacks; settings.hpp promises 1e-9"},
                at_default);
}

TEST(KernelTrade, TheRadiusOfThePotentialParticle) {
  CaseReport report("kernel_trade", {"tilt near an edge", "contacts without a gradient, not reported as deep",
                                     "tilt of face contacts at the ruled radius"});
  std::vector<std::vector<double>> columns(4);
  double off = 0;
  for (const EdgeTilt& t : edge_tilts()) {
    off = std::max(off, std::abs(t.tilt - t.exact));
    const std::array row{t.radius, t.distance, t.tilt, t.exact};
    for (std::size_t k = 0; k < row.size(); ++k)
      columns[k].push_back(row[k]);
  }
  write_csv("kernel_trade", "tilt.csv", {"radius", "distance", "tilt", "exact"}, columns);
  report.record({"tilt near an edge",
                 "rad",
                 Kind::exact,
                 "Eqs 3.31-3.35: atan(<r - e>/(r - u/2)), closed form",
                 0,
                 {3e-9, 0},
                 "largest difference over r and e; the point is found to 1e-9 of the patch 2e, and the tilt grows by "
                 "at most 1/r over e, with e up to 1.5 r"},
                off);

  const double overlap = 1e-2;
  const std::vector<AtRadius> radii = at_radii(overlap);
  std::vector<std::vector<double>> curves(5);
  int unsaid = 0;
  for (const AtRadius& a : radii) {
    unsaid += a.unsaid;
    const std::array row{a.radius, a.tilt, a.change, a.without, a.deep};
    for (std::size_t k = 0; k < row.size(); ++k)
      curves[k].push_back(row[k]);
  }
  write_csv("kernel_trade", "radius.csv", {"radius", "tilt", "change", "without", "deep"}, curves);
  const AtRadius& rule = ruled(radii);
  write_csv("kernel_trade", "rule.csv", {"radius", "share"}, {{rule.radius, rule.radius}, {0, 1}});
  report.record(
      {"contacts without a gradient, not reported as deep",
       "1",
       Kind::exact,
       "Eqs 3.31-3.35: a part has no gradient only if all its faces are r or more away, so the overlap exceeds r",
       0,
       {0.5, 0},
       "a count"},
      unsaid);
  report.record({"tilt of face contacts at the ruled radius",
                 "rad",
                 Kind::exact,
                 "geometry: the face's normal",
                 0,
                 {1e-12, 0},
                 "mean; every point is farther than r from the edges, so only the rounding of normals remains"},
                rule.tilt);
  report.report("ruled radius over overlap", "1", rule.radius,
                "the smallest at which every overlap stays below r and no gradient vanishes");
  report.report("tilt of face contacts at r = 75 overlaps", "rad", radii.back().tilt,
                "mean: r = 0.75 of the size, where the potential sees the faces beside");
  report.report("turn of a corner's normal per 1 % of overlap, ruled radius", "rad", rule.change,
                "mean: the price of a small r, falling as 1/r");
}

}  // namespace
}  // namespace voussoir::cases::kernel_trade_test
