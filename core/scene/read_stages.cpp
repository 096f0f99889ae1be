#include "core/scene/read_stages.hpp"

#include <algorithm>
#include <functional>
#include <map>

#include "core/load/time_factor.hpp"
#include "core/scene/keys.hpp"
#include "core/scene/values.hpp"

namespace voussoir {
namespace {

// the key table has refused every other word
template <class Enum>
void read_choice(const Subject& table, std::string_view key, const std::map<std::string, Enum>& words, Enum& target) {
  if (const Node* node = table.node->find(key)) target = words.at(node->text);
}

bool chooses(const Selector& s) {
  return s.all || !s.names.empty() || !s.above.empty() || !s.below.empty() || s.inside.has_value();
}

Selector selector_of(const Subject& table) {
  Selector selector;
  read(table, "all", selector.all);
  read(table, "bodies", selector.names);
  read(table, "above", selector.above);
  read(table, "below", selector.below);
  read(table, "inside", selector.inside);
  return selector;
}

ReducePlan read_reduction(const Subject& table) {
  ReducePlan plan;
  read_choice(table, "method",
              {{"bisection", ReductionMethod::bisection},
               {"steps", ReductionMethod::steps},
               {"rate", ReductionMethod::rate},
               {"two_rates", ReductionMethod::two_rates}},
              plan.method);
  read(table, "joint_properties", plan.properties);
  read_degrees(table, "from_deg", plan.from);
  read_degrees(table, "to_deg", plan.to);
  read_degrees(table, "tolerance_deg", plan.tolerance);
  read_degrees(table, "step_deg", plan.step);
  read_degrees(table, "rate_deg_per_s", plan.rate);
  read_degrees(table, "slower_rate_deg_per_s", plan.slower_rate);
  read(table, "failure_displacement", plan.failure_displacement);
  read(table, "ramp_steps", plan.ramp_steps);
  read(table, "step_limit", plan.step_limit);
  if (!(plan.from > plan.to))
    refuse(table, "from_deg",
           "must be greater than to_deg (" + value_text(*table.node->find("to_deg")) +
               "): a reduction starts at the stable, higher angle; swap the two");
  if (plan.method == ReductionMethod::two_rates && !(plan.slower_rate < plan.rate))
    refuse(table, "slower_rate_deg_per_s",
           "must be less than rate_deg_per_s (" + value_text(*table.node->find("rate_deg_per_s")) +
               "); a quarter of it is a good choice");
  return plan;
}

GravityPlan read_gravity(const Subject& table) {
  GravityPlan plan;
  read(table, "gravity_ramp_s", plan.ramp);
  read(table, "gravity_to", plan.to);
  return plan;
}

// A ramp to a stated gravity begins at the one the stages before have left, one to full gravity at none.
void chain_gravity(std::vector<StageSpec>& stages) {
  double acting = 0;
  for (StageSpec& stage : stages) {
    auto* settle = std::get_if<SettlePlan>(&stage.plan.plan);
    auto* run = std::get_if<RunPlan>(&stage.plan.plan);
    const bool first = &stage == &stages.front();
    if (!settle && !run) {
      if (first) acting = 1;
      continue;
    }
    GravityPlan& gravity = settle ? settle->gravity : run->gravity;
    if (gravity.ramp > 0) {
      if (gravity.to) gravity.from = acting;
      acting = gravity.to.value_or(1);
    } else if (gravity.to || first) {
      acting = gravity.to.value_or(1);
    }
  }
}

bool states(const Subject& subject, std::string_view table, std::string_view key) {
  const auto found = child(subject, table);
  return found && found->node->find(key);
}

// A stage of kind run shows the true motion: what damps it, and how long its steps are, is otherwise for those to say
// who state it.
void free_runs(const Subject& scene, const DampingSettings& damping, std::vector<StageSpec>& stages) {
  for (StageSpec& stage : stages) {
    if (!std::holds_alternative<RunPlan>(stage.plan.plan)) continue;
    if (!states(scene, "damping", "local") && !states(stage.subject, "damping", "local")) {
      if (!stage.plan.damping) stage.plan.damping = damping;
      stage.plan.damping->local = 0;
    }
    if (!states(scene, "time", "fraction")) stage.plan.time_fraction = TimeSettings::most_undamped;
  }
}

SettlePlan read_settle(const Subject& table) {
  SettlePlan plan;
  plan.gravity = read_gravity(table);
  read(table, "time_limit_s", plan.time_limit);
  read(table, "step_limit", plan.step_limit);
  if (plan.gravity.ramp >= plan.time_limit) {
    const Node* limit = table.node->find("time_limit_s");
    refuse(table, "gravity_ramp_s",
           "must be less than time_limit_s (" + (limit ? value_text(*limit) : "by default 1e9") +
               "): rest needs full gravity; shorten the ramp or raise the limit");
  }
  return plan;
}

RunPlan read_run(const Subject& table) {
  RunPlan plan;
  read(table, "duration_s", plan.duration);
  plan.gravity = read_gravity(table);
  if (plan.gravity.ramp > plan.duration)
    refuse(table, "gravity_ramp_s",
           "must be at most duration_s (" + value_text(*table.node->find("duration_s")) +
               "): the stage would end before gravity has grown; shorten the ramp or lengthen the stage, state "
               "gravity_to = 0 for a stage without gravity");
  return plan;
}

void read_damping(const Subject& table, DampingSettings& damping) {
  read_choice(table, "statics", {{"adaptive", Statics::adaptive}, {"local", Statics::local}}, damping.statics);
  read(table, "local", damping.local);
  read(table, "viscous_ratio", damping.viscous_ratio);
}

void read_factor(const Subject& table, TimeFactor& factor) {
  read(table, "times_s", factor.times);
  read(table, "factors", factor.factors);
  read(table, "frequency_hz", factor.frequency);
  read_degrees(table, "phase_deg", factor.phase);
  if (factor.times.size() != factor.factors.size())
    refuse(table, factor.times.size() < factor.factors.size() ? "times_s" : "factors",
           "stands beside " + std::to_string(std::max(factor.times.size(), factor.factors.size())) +
               " entries of the other; times_s and factors need as many entries as each other");
  if (std::adjacent_find(factor.times.begin(), factor.times.end(), std::greater_equal<>()) != factor.times.end())
    refuse(table, "times_s", "must ascend; put the times in order, each once, with their factors");
  if (factor.phase != 0 && factor.frequency == 0)
    refuse(table, "phase_deg", "stands beside no frequency_hz; state the frequency or remove the phase");
}

// a velocity that is prescribed, where, and in which direction
MovePlan read_move(const Subject& table, const Selector& bodies) {
  MovePlan plan;
  plan.bodies = bodies;
  read(table, "velocity", plan.velocity);
  read(table, "angular_velocity", plan.angular_velocity);
  if (plan.velocity.empty() && plan.angular_velocity.empty())
    refuse(table, "velocity", "nothing moves; state velocity, angular_velocity or both");
  plan.translation.fill(true);
  if (table.node->find("translation")) {
    plan.translation.fill(false);
    read_axes(table, "translation", plan.translation);
    if (plan.velocity.empty())
      refuse(table, "translation", "stands beside no velocity; state the velocity or remove the directions");
  }
  for (std::size_t k = 0; k < plan.velocity.size(); ++k)
    if (plan.velocity[k] != 0 && !plan.translation[k])
      refuse(table, "velocity",
             std::string("has a component along ") + "xyz"[k] +
                 ", which translation does not name; name it there or make the component 0");
  read_factor(table, plan.factor);
  return plan;
}

BoundaryPlan read_boundary(const Subject& table, const Selector& bodies, int dimension) {
  BoundaryPlan plan;
  plan.bodies = bodies;
  read(table, "stress", plan.stress);
  const std::size_t wanted = dimension == 2 ? 3 : 6;
  if (plan.stress.size() != wanted)
    refuse(table, "stress",
           "must have " + std::to_string(wanted) + " entries because dimension = " + std::to_string(dimension) + ": " +
               (dimension == 2 ? "xx, yy, xy" : "xx, yy, zz, yz, zx, xy") + ", compression positive");
  return plan;
}

ForcePlan read_force(const Subject& table, const Selector& bodies, const RunPlan* run) {
  ForcePlan plan;
  plan.bodies = bodies;
  read(table, "name", plan.name);
  read(table, "force", plan.force);
  read(table, "point", plan.point);
  read(table, "turns_with_body", plan.turns_with_body);
  read_factor(table, plan.factor);
  for (const char* key : {"times_s", "frequency_hz"})
    if (!run && table.node->find(key))
      refuse(
          table, key,
          "a factor of time needs a stage of kind run: on the way to rest time means nothing; state the force alone, "
          "or grow it in a stage of kind run before");
  if (run) plan.last_factor = value_at(plan.factor, run->duration);
  return plan;
}

StageSpec read_stage(const Subject& table, const DampingSettings& damping, int dimension) {
  StageSpec stage;
  stage.subject = table;
  read(table, "name", stage.plan.name);
  std::string kind;
  read(table, "kind", kind);
  if (kind == "settle") stage.plan.plan = read_settle(table);
  if (kind == "run") stage.plan.plan = read_run(table);
  if (kind == "reduce") stage.plan.plan = read_reduction(table);
  if (const auto own = child(table, "damping")) {
    stage.plan.damping = damping;
    read_damping(*own, *stage.plan.damping);
  }
  Change& change = stage.plan.change;
  const auto read_chosen = [&](const char* key, const auto& add) {
    for (const SelectorSpec& spec : stage.chosen[key] = read_selectors(table, key))
      add(spec.subject, spec.selector);
  };
  for (const auto& [key, target] :
       {std::pair("fix", &change.fix), {"release", &change.release}, {"remove", &change.remove}})
    read_chosen(key, [&](const Subject&, const Selector& bodies) { target->push_back(bodies); });
  read_chosen("move", [&](const Subject& at, const Selector& bodies) { change.move.push_back(read_move(at, bodies)); });
  read_chosen("boundary", [&](const Subject& at, const Selector& bodies) {
    change.boundary.push_back(read_boundary(at, bodies, dimension));
  });
  read_chosen("force", [&](const Subject& at, const Selector& bodies) {
    change.force.push_back(read_force(at, bodies, std::get_if<RunPlan>(&stage.plan.plan)));
  });
  read(table, "bond", change.bond);
  if (table.node->find("friction_deg")) read_degrees(table, "friction_deg", change.friction.emplace());
  return stage;
}

MonitorSpec read_monitor(const Subject& table) {
  MonitorSpec monitor;
  monitor.body = {table, selector_of(table)};
  read(table, "name", monitor.name);
  read(table, "joint", monitor.joint);
  std::vector<std::string> words;
  read(table, "quantities", words);
  const std::vector<Monitored> all = monitored_quantities();
  for (const std::string& word : words)
    monitor.quantities.push_back(*std::ranges::find(all, word, &Monitored::word));

  const bool of_joint = table.node->find("joint");
  for (const Monitored& followed : monitor.quantities) {
    const bool force = followed.quantity == Quantity::contact_force;
    if (force && !of_joint)
      refuse(table, "joint", "contact_force is followed on a joint; write for example joint = \"A\"");
    if (!force && of_joint)
      refuse(table, "quantities",
             "a monitor of a joint follows contact_force only; follow a block in a monitor of its own");
  }
  if (of_joint && chooses(monitor.body.selector))
    refuse(table, "joint", "stands beside a choice of blocks; a monitor follows either a joint or a block, remove one");
  if (!of_joint && !chooses(monitor.body.selector))
    refuse(table, "above",
           "the monitor must choose one block by bodies, above, below or inside; write for example "
           "above = [\"A\"] or inside = the coordinates of a point in the block");
  return monitor;
}

}  // namespace

SelectorSpec read_selector(const Subject& table) {
  const SelectorSpec spec{table, selector_of(table)};
  if (!chooses(spec.selector))
    refuse(table, "below",
           "no block is chosen; choose by all = true, bodies, above, below or inside, for example below = [\"A\"]");
  return spec;
}

std::vector<SelectorSpec> read_selectors(const Subject& table, std::string_view key) {
  std::vector<SelectorSpec> all;
  for (const Subject& item : children(table, key))
    all.push_back(read_selector(item));
  return all;
}

Settings read_settings(const Subject& scene) {
  Settings settings;
  if (const auto table = child(scene, "contact")) {
    ContactSettings& contact = settings.contact;
    read_choice(*table, "lp", {{"own", LpSolver::own}, {"glpk", LpSolver::glpk}}, contact.lp);
    read_choice(
        *table, "centre",
        {{"own", CentreSolver::own}, {"ipopt", CentreSolver::ipopt}, {"ipopt_scaled", CentreSolver::ipopt_scaled}},
        contact.centre);
    read_choice(*table, "point",
                {{"analytic_centre", ContactPoint::analytic_centre},
                 {"centroid", ContactPoint::centroid},
                 {"chebyshev", ContactPoint::chebyshev},
                 {"central_path", ContactPoint::central_path}},
                contact.point);
    read_choice(*table, "normal",
                {{"potential", ContactNormal::potential}, {"multipliers", ContactNormal::multipliers}}, contact.normal);
    read_choice(*table, "overlap",
                {{"closed_form", OverlapSearch::closed_form}, {"bracketing", OverlapSearch::bracketing}},
                contact.overlap);
    if (contact.normal == ContactNormal::multipliers && contact.overlap == OverlapSearch::bracketing)
      refuse(*table, "overlap",
             "searches along the potential's normal; with normal = \"multipliers\" the overlap is the linear program's "
             "value, leave it out");
    read(*table, "tolerance", contact.tolerance);
    read(*table, "potential_radius", contact.potential_radius);
    read(*table, "smoothing", contact.smoothing);
    read(*table, "newton_tolerance", contact.newton_tolerance);
    read(*table, "newton_limit", contact.newton_limit);
    read(*table, "skin", contact.skin);
  }
  if (const auto table = child(scene, "damping")) read_damping(*table, settings.damping);
  if (const auto table = child(scene, "time")) {
    read(*table, "fraction", settings.time.fraction);
    read(*table, "step_s", settings.time.step);
  }
  if (const auto table = child(scene, "equilibrium")) {
    read(*table, "unbalanced", settings.equilibrium.unbalanced);
    read(*table, "window", settings.equilibrium.window);
  }
  return settings;
}

std::vector<StageSpec> read_stages(const Subject& scene, const DampingSettings& damping) {
  std::vector<StageSpec> stages;
  for (const Subject& item : children(scene, "stage"))
    stages.push_back(read_stage(item, damping, scene_dimension(*scene.node)));
  chain_gravity(stages);
  free_runs(scene, damping, stages);
  if (stages.empty())
    refuse(scene, "stage",
           "nothing would happen; write for example [[stage]] with name = \"settle\" and kind = \"settle\"");
  return stages;
}

std::vector<MonitorSpec> read_monitors(const Subject& scene) {
  std::vector<MonitorSpec> monitors;
  for (const Subject& item : children(scene, "monitors"))
    monitors.push_back(read_monitor(item));
  return monitors;
}

OutputPlan read_output(const Subject& scene) {
  OutputPlan output;
  if (const auto table = child(scene, "output")) {
    read(*table, "history_interval_s", output.history_interval);
    read(*table, "frame_interval_s", output.frame_interval);
    read(*table, "frames", output.frames);
  }
  return output;
}

}  // namespace voussoir
