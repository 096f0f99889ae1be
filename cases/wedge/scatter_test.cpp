// The share of wedges that fail if their joints scatter: `voussoir study` with [[sample]] against the closed form.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <stdexcept>

#include "app/study/plan.hpp"
#include "app/study/statistics.hpp"
#include "cases/case_tools.hpp"
#include "cases/wedge/wedge_scene.hpp"

namespace voussoir::cases::scatter_test {
namespace {

using verification::Bound;
using verification::CaseReport;
using verification::Kind;

// stated before any draw: seeds, and how many of their intervals of 95 % must contain the closed form's share
constexpr int seeds = 20, holding = 19;
// the study has 200; a quarter of them is run in every build
constexpr int rows_of_study = 200, few_rows = 50;

constexpr double friction_deg = 35, dip_deviation = 3, direction_deviation = 5;

double critical_deg(const reference::Wedge& w) {
  const std::optional<double> critical = reference::critical_friction(w);
  return critical ? *critical / degree : 90;
}

// by draws independent of the program's
double share_of_closed_form() {
  static const double share = [] {
    std::mt19937_64 random(1974);
    std::normal_distribution<double> normal;
    constexpr int draws = 1'000'000;
    int failed = 0;
    for (int k = 0; k < draws; ++k) {
      const double dip_a = 40 + dip_deviation * normal(random),
                   direction_a = 130 + direction_deviation * normal(random),
                   dip_b = 60 + dip_deviation * normal(random),
                   direction_b = 220 + direction_deviation * normal(random);
      failed += critical_deg(wedge(dip_a, direction_a, dip_b, direction_b)) > friction_deg;
    }
    return static_cast<double>(failed) / draws;
  }();
  return share;
}

std::filesystem::path output() {
  return verification::case_output("wedge");
}

// scatter_study.toml with another seed, its scene by its whole path
std::filesystem::path plan_with_seed(int seed, int rows = rows_of_study) {
  std::ifstream file(std::filesystem::path(VOUSSOIR_CASE_DIR) / "scatter_study.toml");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto replace = [&](const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    if (at == std::string::npos) throw std::runtime_error("scatter_study.toml has no " + from);
    text.replace(at, from.size(), to);
  };
  replace("seed = 1\n", fmt::format("seed = {}\n", seed));
  replace(fmt::format("rows = {}\n", rows_of_study), fmt::format("rows = {}\n", rows));
  replace("\"scene.toml\"", fmt::format("\"{}/scene.toml\"", VOUSSOIR_CASE_DIR));
  const std::filesystem::path path = output() / "scatter_study.toml";
  std::ofstream(path) << text;
  return path;
}

// by the program: every run of the sample with its closed form, and the interval that it reports
struct Sampled {
  double error = 0, error_at_border = 0;  // deg, the largest: of wedges far from a change of mode, and of the others
  double share = 0, low = 0, high = 0;
  int rows = 0;
};

Sampled run_sample(int seed, int rows) {
  const std::filesystem::path out = output() / "scatter";
  const std::string command = fmt::format("'{}' study '{}' --overwrite --quiet --out '{}' >'{}.log'", VOUSSOIR_PROGRAM,
                                          plan_with_seed(seed, rows).string(), out.string(), out.string());
  if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
  Sampled sampled;
  std::ifstream table(out / "sample_1.csv");
  std::string line;
  std::getline(table, line);
  while (std::getline(table, line)) {
    std::istringstream cells(line);
    std::string cell;
    double numbers[6];  // row, dips and dip directions, critical friction
    for (double& number : numbers) {
      std::getline(cells, cell, ',');
      number = std::stod(cell);
    }
    const reference::Wedge w = wedge(numbers[1], numbers[2], numbers[3], numbers[4]);
    double& largest = reference::classify_wedge(w).non_degenerate ? sampled.error : sampled.error_at_border;
    largest = std::max(largest, std::abs(numbers[5] - critical_deg(w)));
    ++sampled.rows;
  }
  std::ifstream file(out / "sample_1.json");
  const nlohmann::json failed = nlohmann::json::parse(file).at("failed");
  sampled.share = failed.at("share");
  sampled.low = failed.at("low");
  sampled.high = failed.at("high");
  return sampled;
}

void check_sample(int rows) {
  CaseReport report("wedge");
  const Sampled sampled = run_sample(1, rows);
  ASSERT_EQ(sampled.rows, rows);
  const auto judge = [&](const std::string& of, double tolerance, const std::string& because, double error) {
    report.record({fmt::format("critical friction, largest error of a sample of {}, {}", rows, of),
                   "deg",
                   Kind::limit,
                   "Hoek & Bray (1974)",
                   0,
                   {tolerance, 0, Bound::at_most},
                   because},
                  error);
  };
  judge("far from a change of mode", 0.1, "bracket 0.025; the remainder as for any such wedge", sampled.error);
  judge("near a change of mode", 0.5, "there the loading path changes the angle by up to 0.5 (elastic-plastic path)",
        sampled.error_at_border);
  report.report(fmt::format("share failed of a sample of {}", rows), "1", sampled.share,
                fmt::format("interval of 95 %: {:.3f} to {:.3f}; closed form, 10^6 draws: {:.4f}", sampled.low,
                            sampled.high, share_of_closed_form()));
}

TEST(Wedge, ASampleOfScatteredJointsFollowsTheClosedForm) {
  check_sample(few_rows);
}

TEST(WedgeLong, ASampleOfScatteredJointsFollowsTheClosedForm) {
  check_sample(rows_of_study);
}

// the rows that the program would run, judged by the closed form: only draws and intervals
TEST(Wedge, IntervalsOfDrawnRowsHoldTheShare) {
  CaseReport report("wedge");
  int holds = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Sweep sample = read_study_plan(plan_with_seed(seed)).sweeps.back();
    int failed = 0;
    for (std::size_t row = 0; row < sample.values.size(); ++row) {
      const auto drawn = [&](std::size_t key) { return std::stod(sample.with[key].values[row]); };
      failed += critical_deg(wedge(drawn(0), drawn(1), drawn(2), drawn(3))) > friction_deg;
    }
    const Share share = share_with_interval(failed, static_cast<int>(sample.values.size()));
    holds += share.low <= share_of_closed_form() && share_of_closed_form() <= share.high;
  }
  report.record({fmt::format("intervals of {} drawn samples that hold the share failed", seeds),
                 "1",
                 Kind::limit,
                 "Hoek & Bray (1974), 10^6 draws",
                 0,
                 {holding, 0, Bound::at_least},
                 "Clopper & Pearson (1934): 95 % at least; seeds 1 to 20, stated beforehand"},
                holds);
}

TEST(WedgeLong, IntervalsOfSamplesHoldTheShare) {
  CaseReport report("wedge");
  int holds = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Sampled sampled = run_sample(seed, rows_of_study);
    holds += sampled.low <= share_of_closed_form() && share_of_closed_form() <= sampled.high;
    fmt::print("seed {}: {:.3f} in {:.3f} to {:.3f}, closed form {:.4f}\n", seed, sampled.share, sampled.low,
               sampled.high, share_of_closed_form());
  }
  report.record({fmt::format("intervals of {} samples that hold the share failed", seeds),
                 "1",
                 Kind::limit,
                 "Hoek & Bray (1974), 10^6 draws",
                 0,
                 {holding, 0, Bound::at_least},
                 "Clopper & Pearson (1934): 95 % at least; seeds 1 to 20, stated beforehand"},
                holds);
}

}  // namespace
}  // namespace voussoir::cases::scatter_test
