// Error bars of drawn scenes against the truth, by the program itself.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "cases/budget_trial.hpp"
#include "cases/calibration/drawn_scenes.hpp"

namespace voussoir::cases {

// how a scene is run: every default left alone, or --budget
enum class BarOf { defaults, budget };

// the share of each scene's bar that its error takes; infinite: the search ended without a value
struct Bars {
  std::vector<double> used;

  int count() const { return static_cast<int>(used.size()); }
  // by bars of this factor times the printed ones
  int enclosed(double times = 1) const {
    return static_cast<int>(std::ranges::count_if(used, [&](double u) { return u <= times; }));
  }
  int without_value() const {
    return static_cast<int>(std::ranges::count_if(used, [](double u) { return std::isinf(u); }));
  }
  void add(const Bars& other) { used.insert(used.end(), other.used.begin(), other.used.end()); }
};

// of a search that found a value
inline double median_of_bar_over_error(const Bars& bars) {
  std::vector<double> ratios;
  for (const double u : bars.used)
    if (std::isfinite(u)) ratios.push_back(u > 0 ? 1 / u : 1e12);
  return median(ratios);
}

inline double largest_error_over_bar(const Bars& bars) {
  double most = 0;
  for (const double u : bars.used)
    if (std::isfinite(u)) most = std::max(most, u);
  return most;
}

// the least factor on the bars with which they enclose this share of the truths
inline double factor_that_encloses(double share, Bars bars) {
  std::ranges::sort(bars.used);
  return bars.used[static_cast<std::size_t>(std::ceil(share * bars.count() - 1e-9)) - 1];
}

inline double share_of_bar(const nlohmann::json& results, const DrawnScene& scene, const std::string& label) {
  const nlohmann::json& values = results.at("values");
  const double evaluations = results.at("counters").at("contact_evaluations");
  if (results.at("status") != "done" || !values.contains(scene.value)) {
    fmt::print("{}: truth {:.5f}, no value: {}\n", label, scene.truth, results.at("message").get<std::string>());
    return std::numeric_limits<double>::infinity();
  }
  const nlohmann::json& found = values.at(scene.value);
  const double error = found.at("value").get<double>() - scene.truth, bar = found.at("error_bar");
  std::string parts = found.value("found_by", "");
  for (const char* part : {"bracket", "criterion"})
    if (found.contains(part)) parts += fmt::format(", {} {:.2g}", part, found.at(part).get<double>());
  if (found.contains("budget"))
    for (const nlohmann::json& line : found.at("budget"))
      parts += fmt::format(", {} {:+.2g} ({:.2g})", line.at("varied").get<std::string>(),
                           line.at("shift").get<double>(), line.at("part").get<double>());
  fmt::print("{}: truth {:.5f}, off by {:+.2g}, bar {:.2g}, {:.2f} of it{}; {}, {:.0f} evaluations\n", label,
             scene.truth, error, bar, std::abs(error) / bar, std::abs(error) > bar ? " NOT ENCLOSED" : "", parts,
             evaluations);
  return std::abs(error) / bar;
}

// of the first scenes of a kind that a seed draws
inline Bars run_bars(const SceneKind& kind, unsigned seed, int count, BarOf of) {
  const std::string case_name = "calibration";
  Draws draws(seed);
  Bars bars;
  for (int n = 0; n < count; ++n) {
    const DrawnScene scene = kind.draw(draws);
    std::string name = fmt::format("{}_{}_{}", kind.name, seed, n);
    std::ranges::replace(name, ' ', '_');
    const std::filesystem::path file = verification::case_output(case_name) / (name + ".toml");
    std::ofstream(file) << scene.text;
    const nlohmann::json results =
        results_with({name, file, {}, scene.truth}, of == BarOf::budget ? "--budget" : "", case_name);
    bars.used.push_back(share_of_bar(
        results, scene, fmt::format("{} {}{} ({})", kind.name, n, of == BarOf::budget ? ", budget" : "", scene.label)));
    std::fflush(stdout);
    std::filesystem::remove_all(verification::case_output(case_name) / "budget");
  }
  return bars;
}

}  // namespace voussoir::cases
