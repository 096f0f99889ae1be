#include "app/check/assess.hpp"

#include <utility>

#include "app/check/judge_blocks.hpp"
#include "app/check/judge_brittle.hpp"
#include "app/check/judge_contacts.hpp"
#include "app/check/judge_loads.hpp"
#include "app/check/judge_stages.hpp"
#include "app/check/judge_supports.hpp"
#include "core/stage/install_linings.hpp"
#include "core/step/contacts.hpp"
#include "core/step/loads.hpp"
#include "core/step/neighbours.hpp"

namespace voussoir {
namespace {

template <int Dim>
void judge(const Prepared<Dim>& prepared, const Model<Dim>& model, const State<Dim>& state, const Forecast& forecast,
           std::vector<std::string>& warnings) {
  const Settings& settings = prepared.settings;
  judge_bodies(prepared, model, state, warnings);
  judge_ties(model, state, warnings);
  judge_first_contacts(settings.contact, model, state, warnings);
  judge_last_block(prepared, warnings);
  judge_bolts(model, state, warnings);
  judge_linings(model, state, warnings);
  judge_loads(prepared, warnings);
  for (const StagePlan& stage : prepared.stages)
    judge_stage(stage, settings_of(stage, settings), forecast.overlap, smallest_size(model), warnings);
  judge_velocities(prepared, model, warnings);
  judge_overlaps(settings.contact, forecast, warnings);
  judge_multipliers(settings.contact, model, warnings);
  judge_stated_step(settings.time, forecast.step_limit, warnings);
  judge_intervals(prepared.stages, prepared.output, warnings);
  judge_durations(prepared, model, forecast, warnings);
  judge_brittle_bonds(prepared, warnings);
}

template <int Dim>
Assessment assess_prepared(const Prepared<Dim>& prepared, std::vector<std::string> warnings) {
  // as the first stage begins
  Model<Dim> model = prepared.model;
  State<Dim> state = prepared.state;
  if (!prepared.stages.empty()) {
    model = apply(std::move(model), prepared.stages.front().change);
    add_bodies(model, state.bodies, state.contacts, state.loads, state.time_step);
    install_linings(model, prepared.stages.front().change.install, state);
  }
  find_neighbours(model, prepared.settings, state.bodies, state.contacts, state.counters);
  find_contacts(model, prepared.settings, 0, state.bodies, state.contacts, state.counters);
  sum_loads(model, prepared.settings, state.schedule, state.bodies, state.contacts, state.supports,
            state.loads);  // water and forces determine the step, too
  Assessment result{forecast(prepared, model, state), std::move(warnings)};
  judge(prepared, model, state, result.forecast, result.warnings);
  return result;
}

}  // namespace

Assessment assess(const LoadedScene& scene) {
  return std::visit([&](const auto& prepared) { return assess_prepared(prepared, scene.warnings); }, scene.prepared);
}

}  // namespace voussoir
