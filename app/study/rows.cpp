#include "app/study/rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "app/base/digest.hpp"
#include "app/base/run_scene.hpp"
#include "app/check/assess.hpp"
#include "core/base/bad_input.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/shared_stages.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

// the input and recorded output that a run shares with all runs that are the same up to the end of a stage
std::string shared_text(const StudyPlan& plan, const Sweep& sweep, const Scene& scene) {
  std::vector<std::string> names;
  for (const StageSpec& stage : scene.stages)
    names.push_back(stage.plan.name);
  const auto found = std::find(names.begin(), names.end(), plan.begin);
  if (found == names.end())
    throw BadInput(fmt::format("begin = \"{}\": no stage of '{}' has this name; {}", one_line(plan.begin, 60),
                               sweep.scene.string(), suggestion(plan.begin, names)));
  std::string text = canonical_text(shared_part(scene, static_cast<int>(found - names.begin()) + 1));
  for (const char* key : {"monitors", "output"})
    if (const Node* part = scene.tree->find(key)) text += canonical_text(*part);
  return text;
}

double expected_cost(const LoadedScene& scene, bool steps_are_taken) {
  if (!steps_are_taken)
    return std::visit([](const auto& prepared) { return static_cast<double>(prepared.model.bodies.size()); },
                      scene.prepared);
  const Forecast forecast = assess(scene).forecast;
  double steps = 0;
  for (const StageForecast& stage : forecast.stages)
    steps += stage.steps;
  return steps * forecast.candidates;
}

}  // namespace

PlannedRow row_of(const StudyPlan& plan, const Sweep& sweep, const std::vector<std::string>& overrides,
                  const std::string& program) {
  PlannedRow row{.run = {sweep.scene, overrides, sweep.other, {}, ""}};
  const bool blocks = sweep.other && sweep.other->name == "blocks";
  const LoadedScene scene =
      (blocks ? load_blocks(row.run.scene, row.run.overrides) : load_scene(row.run.scene, row.run.overrides));
  row.run.files = scene.files;
  row.cost = expected_cost(scene, !sweep.other);
  std::string what = canonical_text(*scene.stated) + program;
  if (sweep.other) what += fmt::format(" {} {}", fmt::join(sweep.other->options, " "), sweep.other->name);
  row.run.name = digest(what);
  if (!plan.begin.empty() && !sweep.other)
    row.run.begin = digest("until " + shared_text(plan, sweep, *scene.stated) + program);
  return row;
}

std::vector<PlannedRow> rows_of_plan(const StudyPlan& plan, const std::string& program_digest) {
  std::vector<PlannedRow> rows;
  for (const Sweep& sweep : plan.sweeps)
    for (std::size_t k = 0; k < sweep.values.size(); ++k) {
      rows.push_back(row_of(plan, sweep, overrides_of(sweep, k), program_digest));
      rows.back().row = static_cast<int>(rows.size());
    }
  return rows;
}

std::vector<StudyRun> generations_of(const std::vector<PlannedRow>& rows, const std::string& until) {
  std::vector<const PlannedRow*> ordered;
  for (const PlannedRow& row : rows)
    ordered.push_back(&row);
  std::sort(ordered.begin(), ordered.end(), [](const PlannedRow* a, const PlannedRow* b) { return a->row < b->row; });
  std::vector<StudyRun> generations;
  std::set<fs::path> listed;
  for (const PlannedRow* row : ordered)
    if (!row->run.begin.empty() && listed.insert(row->run.begin).second)
      generations.push_back({row->run.scene, row->run.overrides, {}, row->run.files, row->run.begin.string(), until});
  return generations;
}

}  // namespace voussoir
