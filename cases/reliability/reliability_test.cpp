// Small probabilities of slabs and wedges whose joints scatter: `voussoir study` against integrals and closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <stdexcept>

#include "cases/case_tools.hpp"
#include "reference/reliability/scattered_slab.hpp"
#include "reference/wedge/wedge.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::reliability_test {
namespace {

using nlohmann::json;
using verification::Bound;
using verification::CaseReport;
using verification::Kind;

constexpr double interval_width = 3;  // standard errors
const std::string of_sampling = "three standard errors of importance sampling to 10 %";

std::filesystem::path study(const std::string& name, const std::string& changed_from = "", const std::string& to = "") {
  std::ifstream file(std::filesystem::path(VOUSSOIR_CASE_DIR) / (name + "_study.toml"));
  std::string plan{std::istreambuf_iterator<char>(file), {}};
  const auto replace = [&](const std::string& from, const std::string& by) {
    const std::size_t at = plan.find(from);
    if (at == std::string::npos) throw std::runtime_error(name + "_study.toml has no " + from);
    plan.replace(at, from.size(), by);
  };
  replace(fmt::format("\"{}.toml\"", name), fmt::format("\"{}/{}.toml\"", VOUSSOIR_CASE_DIR, name));
  if (!changed_from.empty()) replace(changed_from, to);
  const std::filesystem::path folder = verification::case_output("reliability");
  const std::filesystem::path path = folder / (name + "_study.toml"), out = folder / name;
  std::ofstream(path) << plan;
  const std::string command = fmt::format("'{}' study '{}' --overwrite --quiet --out '{}' >'{}.log'", VOUSSOIR_PROGRAM,
                                          path.string(), out.string(), out.string());
  if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
  return out;
}

json read(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return json::parse(stream);
}

int answers_of(const json& found) {
  int sum = 0;
  for (const auto& [purpose, count] : found.at("answers").items())
    sum += count.get<int>();
  return sum;
}

void check_probability(CaseReport& report, const std::string& of, const json& found, double expected,
                       const std::string& source, Kind kind = Kind::exact, double error_of_expected = 0) {
  const json& sampled = found.at("sampled");
  const double p = sampled.at("probability"), error = sampled.at("standard_error");
  report.record({of + ", probability of failure",
                 "1",
                 kind,
                 source,
                 expected,
                 {interval_width * std::hypot(error, error_of_expected), 0},
                 of_sampling},
                p);
  report.record(
      {of + ", answers", "1", Kind::limit, "demanded: at most 1,000", 1000, {0.5, 0, Bound::at_most}, "a count"},
      answers_of(found));
}

// ---- one failure in a million -------------------------------------------------------------------------------------

constexpr double weight_per_area = 2650 * 9.81 * 4.5;  // Pa: slab.toml

reference::ScatteredSlab slab() {
  return {10, 10 * weight_per_area, 32 * degree, 22e3, 4.4e3, 38 * degree, 2.9 * degree};
}

TEST(Reliability, OneFailureInAMillionAsItsIntegral) {
  CaseReport report("reliability", {"slab, probability of failure", "slab, reliability index"});
  const json found = read(study("slab") / "reliability_1.json");
  const std::string source = "reference/reliability: one integral";
  check_probability(report, "slab", found, reference::failure_probability(slab()), source);
  const double beta = reference::reliability_index(slab());
  report.record({"slab, reliability index",
                 "1",
                 Kind::exact,
                 "reference/reliability: least distance",
                 beta,
                 {1e-6, 0},
                 "the search ends within 10⁻⁵ of the point; slopes by differences are right to 10⁻⁴"},
                found.at("beta"));
  report.report("slab, probability to first order", "1", found.at("first_order").at("probability"),
                fmt::format("{:.2f} of the exact one", found.at("first_order").at("probability").get<double>() /
                                                           reference::failure_probability(slab())));
  report.report("slab, probability to second order", "1", found.at("second_order").at("hohenbichler"),
                fmt::format("{:.4f} of the exact one", found.at("second_order").at("hohenbichler").get<double>() /
                                                           reference::failure_probability(slab())));
}

// answers that limit analysis gives, which needs a longer step
TEST(Reliability, LimitAnalysisFindsTheSameDesignPoint) {
  CaseReport report("reliability", {"slab by limit analysis, reliability index"});
  const json found =
      read(study("slab", "quantity = \"least_factor\"\nblocks = {}\n\n[[reliability]]",
                 "quantity = \"factor_of_safety\"\nlimit = { factor = true }\n\n[[reliability]]\nmethod = \"form\"") /
           "reliability_1.json");
  report.record({"slab by limit analysis, reliability index",
                 "1",
                 Kind::exact,
                 "reference/reliability: least distance",
                 reference::reliability_index(slab()),
                 {1e-3, 0},
                 "factors within their error bars of 10⁻⁴ over steps of 0.1"},
                found.at("beta"));
}

// ---- two ways to fail ---------------------------------------------------------------------------------------------

TEST(Reliability, BothWaysToFailAreFound) {
  CaseReport report("reliability", {"two slabs, probability of failure", "two slabs, design points"});
  const double beta_a = (42.0 - 30) / 3.3, beta_b = (41.0 - 30) / 3.1;
  const double p_a = reference::probability_of_index(beta_a), p_b = reference::probability_of_index(beta_b);
  const json found = read(study("two_slabs") / "reliability_1.json");
  const std::string source = "closed form: 1 - (1 - p_a)(1 - p_b)";
  check_probability(report, "two slabs", found, 1 - (1 - p_a) * (1 - p_b), source);
  const json& points = found.at("design_points");
  report.record({"two slabs, design points", "1", Kind::exact, source, 2, {0.25, 0}, "a count"},
                static_cast<double>(points.size()));
  ASSERT_EQ(points.size(), 2u);
  const auto judge = [&](const char* of, double beta, const json& point) {
    report.record({fmt::format("two slabs, reliability index of {}", of),
                   "1",
                   Kind::exact,
                   "closed form: (m - 30)/s",
                   beta,
                   {1e-6, 0},
                   "a straight limit in the friction angle; the search ends within 10⁻⁵ of the first g"},
                  point.at("beta"));
  };
  judge("b", beta_b, points[0]);
  judge("a", beta_a, points[1]);
}

// ---- a wedge ------------------------------------------------------------------------------------------------------

reference::Wedge wedge(const std::vector<double>& keys) {
  reference::Wedge w;
  w.a = {keys[0] * degree, keys[1] * degree, keys[4] * degree, 0, 0};
  w.b = {keys[2] * degree, keys[3] * degree, keys[5] * degree, 0, 0};
  return w;
}

TEST(Reliability, AWedgeWhoseJointsScatter) {
  CaseReport report("reliability", {"wedge, probability of failure", "wedge, reliability index"});
  const std::filesystem::path out = study("wedge");
  std::mt19937_64 random(1974);
  std::normal_distribution<double> normal;
  constexpr int draws = 1'000'000;
  const double means[] = {45, 105, 70, 235, 35, 30}, deviations[] = {3, 5, 3, 5, 3, 3};
  int failed = 0;
  std::vector<double> keys(6);
  for (int k = 0; k < draws; ++k) {
    for (std::size_t i = 0; i < 6; ++i)
      keys[i] = means[i] + deviations[i] * normal(random);
    failed += reference::solve_wedge(wedge(keys)).factor_of_safety < 1;
  }
  const double share = static_cast<double>(failed) / draws;
  const std::string source = "reference/wedge: 10⁶ draws of its closed form";
  const json found = read(out / "reliability_1.json");
  check_probability(report, "wedge", found, share, source, Kind::exact, std::sqrt(share / draws));
  report.record({"wedge, reliability index",
                 "1",
                 Kind::published,
                 "comparison: the closed form by OpenTURNS 1.20",
                 2.650165659,
                 {1e-4, 0},
                 "the search ends within 10⁻³ of the point"},
                found.at("beta"));

  // the rows of a sample, one by one
  std::ifstream table(out / "sample_1.csv");
  std::string line;
  std::getline(table, line);
  double largest = 0;
  int rows = 0;
  for (; std::getline(table, line); ++rows) {
    std::istringstream cells(line);
    std::string cell;
    std::getline(cells, cell, ',');
    std::vector<double> numbers;
    for (int k = 0; k < 7 && std::getline(cells, cell, ','); ++k)
      numbers.push_back(std::stod(cell));
    const double factor = reference::solve_wedge(wedge(numbers)).factor_of_safety;
    largest = std::max(largest, std::abs(numbers[6] / factor - 1));
  }
  ASSERT_EQ(rows, 5'000);
  report.record({"wedge, largest relative error of the factors of a sample of 5,000",
                 "1",
                 Kind::limit,
                 "reference/wedge",
                 0,
                 {1e-9, 0, Bound::at_most},
                 "rounding, magnified by the cut"},
                largest);
  const json sample = read(out / "sample_1.json").at("failed");
  report.record({"wedge, share failed of a sample of 5,000",
                 "1",
                 Kind::exact,
                 source,
                 share,
                 {4 * std::sqrt(share * (1.0 / 5'000 + 1.0 / draws)), 0},
                 "four standard errors"},
                sample.at("share"));
}

}  // namespace
}  // namespace voussoir::cases::reliability_test
