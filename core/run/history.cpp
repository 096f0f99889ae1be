#include "core/run/history.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/model/water_surfaces.hpp"
#include "core/output/monitor.hpp"
#include "core/run/reduction.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

// the joint properties whose friction some stage changes: each has a column in the history
template <int Dim>
std::vector<int> properties_followed(const Prepared<Dim>& scene) {
  std::set<int> followed;
  for (const StagePlan& stage : scene.stages) {
    const std::vector<int> changed = properties_changed(scene.model, stage.change);
    followed.insert(changed.begin(), changed.end());
    if (const auto* reduction = std::get_if<ReducePlan>(&stage.plan)) {
      const std::vector<int> chosen = chosen_properties(scene.model, *reduction);
      followed.insert(chosen.begin(), chosen.end());
    }
  }
  return {followed.begin(), followed.end()};
}

// monitors of the waters that some stage changes: each has columns in the history
template <int Dim>
std::vector<Monitor> waters_followed(const Prepared<Dim>& scene) {
  std::set<int> changed;
  for (const StagePlan& stage : scene.stages)
    for (const WaterPlan& plan : stage.water)
      changed.insert(plan.water);
  std::vector<Monitor> followed;
  for (const int water : changed) {
    const Water& w = scene.model.waters[water];
    followed.push_back({"water_" + w.name, {"level", Quantity::level}, water, levels_of<Dim>(w)});
  }
  return followed;
}

// whether some stage searches for a factor of safety: then the history has a column for it
template <int Dim>
bool has_factor(const Prepared<Dim>& scene) {
  return std::ranges::any_of(scene.stages, [](const StagePlan& stage) {
    const auto* reduction = std::get_if<ReducePlan>(&stage.plan);
    return reduction && reduction->searched == Searched::factor;
  });
}

// whether some stage searches by trials that are undone: then the history has a column for them
template <int Dim>
bool has_trials(const Prepared<Dim>& scene) {
  return std::any_of(scene.stages.begin(), scene.stages.end(), [](const StagePlan& stage) {
    const auto* reduction = std::get_if<ReducePlan>(&stage.plan);
    return reduction && reduction->method != ReductionMethod::rate;
  });
}

// the factor of the searched joint properties; the others' factor is 1
double strength_factor(const Schedule& schedule) {
  const auto searched = std::ranges::find_if(schedule.strength_factor, [](double factor) { return factor != 1; });
  return searched == schedule.strength_factor.end() ? 1 : *searched;
}

}  // namespace

template <int Dim>
std::vector<int> properties_changed(const Model<Dim>& model, const Change& change) {
  std::vector<int> changed;
  for (std::size_t p = 0; p < model.properties.size(); ++p)
    if (change.friction || change.friction_as_stated ||
        std::ranges::count(change.friction_of, model.properties[p].name, &FrictionPlan::properties))
      changed.push_back(static_cast<int>(p));
  return changed;
}

template <int Dim>
std::vector<std::string> history_columns(const Prepared<Dim>& scene) {
  std::vector<std::string> columns{"time_s", "stage"};
  if (has_trials(scene)) columns.push_back("trial");
  for (const int p : properties_followed(scene))
    columns.push_back("friction_" + scene.model.properties[p].name + "_deg");
  for (const Column& c : monitor_columns<Dim>(waters_followed(scene)))
    columns.push_back(c.header());
  if (has_factor(scene)) columns.push_back("strength_factor");
  for (const Column& c : monitor_columns<Dim>(scene.monitors))
    columns.push_back(c.header());
  return columns;
}

template <int Dim>
std::vector<double> history_row(const Prepared<Dim>& scene, const Model<Dim>& model, const State<Dim>& state, int stage,
                                int trial, const std::vector<StageEnd<Dim>>& ends) {
  std::vector<double> values{state.schedule.time, static_cast<double>(stage)};
  if (has_trials(scene)) values.push_back(trial);
  for (const int p : properties_followed(scene))
    values.push_back(to_degrees(state.schedule.friction[p]));
  const auto append = [&](const std::vector<Monitor>& monitors) {
    const std::vector<double> monitored = monitor_values<Dim>(monitors, model, state, ends);
    values.insert(values.end(), monitored.begin(), monitored.end());
  };
  append(waters_followed(scene));
  if (has_factor(scene)) values.push_back(strength_factor(state.schedule));
  append(scene.monitors);
  return values;
}

template std::vector<int> properties_changed<2>(const Model<2>&, const Change&);
template std::vector<int> properties_changed<3>(const Model<3>&, const Change&);
template std::vector<std::string> history_columns<2>(const Prepared<2>&);
template std::vector<std::string> history_columns<3>(const Prepared<3>&);
template std::vector<double> history_row<2>(const Prepared<2>&, const Model<2>&, const State<2>&, int, int,
                                            const std::vector<StageEnd<2>>&);
template std::vector<double> history_row<3>(const Prepared<3>&, const Model<3>&, const State<3>&, int, int,
                                            const std::vector<StageEnd<3>>&);

}  // namespace voussoir
