#include "app/run_folder/search_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "app/base/svg_figure.hpp"
#include "core/output/atomic_file.hpp"
#include "core/output/search_csv.hpp"

namespace voussoir {
namespace {

// of the farthest displacement: smaller ones are rounding, and would only widen a logarithmic axis
constexpr double least_drawn = 1e-6;

std::string strength_label(const std::set<std::string>& units) {
  if (units.size() > 1) return "friction angle (deg) or factor";
  return units.contains("deg") ? "friction angle (deg)" : "factor";
}

}  // namespace

std::string search_svg(const std::vector<TrialRow>& trials) {
  double farthest = 0;
  std::set<int> stages;
  std::set<std::string> units;
  for (const TrialRow& t : trials) {
    farthest = std::max(farthest, t.displacement);
    stages.insert(t.stage);
    units.insert(t.unit);
  }
  if (!(farthest > 0)) return {};
  Diagram diagram;
  diagram.title = "Trials of the search";
  diagram.x_label = "largest displacement since the search began (m)";
  diagram.y_label = strength_label(units);
  diagram.logarithmic_x = true;
  diagram.from_zero = false;
  for (const int stage : stages)
    for (const char* outcome : {"stable", "failed", "undecided"}) {
      Curve curve{Curve::Kind::points, stages.size() > 1 ? fmt::format("stage {}: {}", stage, outcome) : outcome, {}};
      for (const TrialRow& t : trials)
        if (t.stage == stage && t.outcome == outcome && t.displacement >= least_drawn * farthest)
          curve.points.emplace_back(t.displacement, t.level);
      if (!curve.points.empty()) diagram.curves.push_back(std::move(curve));
    }
  return svg(diagram);
}

void write_search(const std::filesystem::path& folder, const Results& results) {
  if (const std::string table = search_csv(results.trials); !table.empty()) write_file(folder / search_table, table);
  if (const std::string picture = search_svg(results.trials); !picture.empty())
    write_file(folder / search_picture, picture);
}

}  // namespace voussoir
