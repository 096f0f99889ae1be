#include "core/scene/read_stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "core/load/time_factor.hpp"
#include "core/scene/keys.hpp"
#include "core/scene/read_motion.hpp"
#include "core/scene/read_open_side.hpp"
#include "core/scene/read_records.hpp"
#include "core/scene/read_slicing.hpp"

namespace voussoir {
namespace {

bool chooses(const Selector& s) {
  return s.all || !s.names.empty() || !s.above.empty() || !s.below.empty() || s.inside.has_value() ||
         !s.sides.empty() || !s.low.empty();
}

Selector read_choice(const Subject& table) {
  Selector selector;
  read_keys(*table.node, "selector", selector);
  if (const auto item = child(table, "box")) {
    const BoxSpec box = read_box(*item);
    selector.low = box.min;
    selector.high = box.max;
  }
  return selector;
}

void check_factor(const Subject& table, const ReducePlan& plan) {
  if (plan.method == ReductionMethod::rate || plan.method == ReductionMethod::two_rates)
    refuse(table, "method",
           "the delay of failure at a finite rate is known for a friction angle, not for a factor of safety; write "
           "method = "
           "\"bisection\" or \"steps\", or leave out search = \"factor\"");
  if (!(plan.factor.from < plan.factor.to))
    refuse(table, "from_factor",
           "must be less than to_factor (" + value_text(*table.node->find("to_factor")) +
               "): a search for the factor of safety starts at the stable, smaller factor; swap the two");
}

void read_plan(const Subject& table, ReducePlan& plan) {
  read_keys(*table.node, "stage", plan);
  read_keys(*table.node, "stage", plan.factor);
  if (plan.searched == Searched::factor) return check_factor(table, plan);
  if (!(plan.from > plan.to))
    refuse(table, "from_deg",
           "must be greater than to_deg (" + value_text(*table.node->find("to_deg")) +
               "): a reduction starts at the stable, higher angle; swap the two");
  if (plan.method == ReductionMethod::two_rates && !(plan.slower_rate < plan.rate))
    refuse(table, "slower_rate_deg_per_s",
           "must be less than rate_deg_per_s (" + value_text(*table.node->find("rate_deg_per_s")) +
               "); a quarter of it is a good choice");
}

// A ramp to a stated gravity starts from that of the stages before, a ramp to full gravity from zero.
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

// A stage of kind run computes the true motion: without local damping and with the time step of undamped motion, unless
// these are stated.
void free_runs(const Subject& scene, const Settings& settings, std::vector<StageSpec>& stages) {
  for (StageSpec& stage : stages) {
    if (!std::holds_alternative<RunPlan>(stage.plan.plan)) continue;
    if (!states(scene, "damping", "local") && !states(stage.subject, "damping", "local")) {
      if (!stage.plan.damping) stage.plan.damping = settings.damping;
      stage.plan.damping->local = 0;
    }
    if (states(scene, "time", "fraction") || states(stage.subject, "time", "fraction")) continue;
    if (!stage.plan.time) stage.plan.time = settings.time;
    stage.plan.time->fraction = TimeSettings::most_undamped;
  }
}

void read_plan(const Subject& table, SettlePlan& plan) {
  read_keys(*table.node, "stage", plan);
  read_keys(*table.node, "stage", plan.gravity);
  if (plan.gravity.ramp >= plan.time_limit) {
    const Node* limit = table.node->find("time_limit_s");
    refuse(table, "gravity_ramp_s",
           "must be less than time_limit_s (" +
               (limit ? value_text(*limit) : "by default " + find_row({"stage"}, "time_limit_s")->default_value) +
               "): equilibrium needs full gravity; shorten the ramp or raise the limit");
  }
}

void read_plan(const Subject& table, RunPlan& plan) {
  read_keys(*table.node, "stage", plan);
  read_keys(*table.node, "stage", plan.gravity);
  if (plan.gravity.ramp > plan.duration)
    refuse(table, "gravity_ramp_s",
           "must be at most duration_s (" + value_text(*table.node->find("duration_s")) +
               "): the stage would end before gravity has reached its full value; shorten the ramp or lengthen the "
               "stage; for a stage "
               "without gravity state gravity_to = 0");
}

// a prescribed motion that follows records, which are appended to those of the stage
MovePlan read_recorded_move(const Subject& table, const Selector& bodies, int dimension,
                            std::vector<RecordSpec>& records) {
  refuse_beside_records(table);
  MovePlan plan;
  plan.bodies = bodies;
  plan.velocity.assign(dimension, 0);
  read_keys(*table.node, "move", plan);
  for (RecordSpec& record : read_records(table)) {
    plan.records.push_back(recorded_motion(record, dimension));
    for (int k = 0; k < dimension; ++k)
      if (plan.records.back().direction[k] != 0 && !plan.translation[k])
        refuse(record.subject, record.azimuth ? "azimuth_deg" : "direction",
               fmt::format("has a component along {}, which the move's translation does not name; name it there",
                           "xyz"[k]));
    records.push_back(std::move(record));
  }
  return plan;
}

// the velocity of a prescribed motion and its directions
MovePlan read_move(const Subject& table, const Selector& bodies, int dimension, std::vector<RecordSpec>& records) {
  if (table.node->find("factor")) return read_recorded_move(table, bodies, dimension, records);
  const MotionSpec motion = read_motion(table);
  if (!motion.velocity && !motion.angular_velocity)
    refuse(table, "velocity", "nothing moves; state velocity, angular_velocity or both, or a record (factor)");
  MovePlan plan;
  plan.bodies = bodies;
  plan.velocity = motion.velocity.value_or(std::vector<double>());
  plan.angular_velocity = motion.angular_velocity.value_or(std::vector<double>());
  read_keys(*table.node, "move", plan);
  if (table.node->find("translation") && !motion.velocity)
    refuse(table, "translation", "is stated without a velocity; state the velocity or remove the directions");
  for (std::size_t k = 0; k < plan.velocity.size(); ++k)
    if (plan.velocity[k] != 0 && !plan.translation[k])
      refuse(table, "velocity",
             fmt::format(
                 "has a component along {}, which translation does not name; name it there or make the component 0",
                 "xyz"[k]));
  plan.factor = read_factor(table);
  return plan;
}

InSituPlan read_in_situ(const Subject& table, int dimension, double rock_weight) {
  InSituPlan plan;
  read_keys(*table.node, "in_situ", plan);
  if (!plan.unit_weight) plan.unit_weight = rock_weight;
  if (!(*plan.unit_weight > 0))
    refuse(table, "unit_weight",
           "is needed: the scene states no density, or no gravity; write for example 26e3 (N/m³)");
  if (dimension == 2 && plan.k0_y) refuse(table, "k0_y", "needs dimension = 3; in 2-D k0 is the only ratio, remove it");
  return plan;
}

BoundaryPlan read_boundary(const Subject& table, const Selector& bodies, int dimension, double rock_weight,
                           std::vector<RecordSpec>& records) {
  BoundaryPlan plan;
  plan.bodies = bodies;
  read_keys(*table.node, "boundary", plan);
  if (read_open_side(table, dimension, plan, records)) return plan;
  const std::size_t wanted = dimension == 2 ? 3 : 6;
  const char* components = dimension == 2 ? "xx, yy, xy" : "xx, yy, zz, yz, zx, xy";
  if (const auto item = child(table, "in_situ")) {
    plan.in_situ = read_in_situ(*item, dimension, rock_weight);
    if (!table.node->find("stress")) plan.stress.assign(wanted, 0);
  } else if (!table.node->find("stress")) {
    refuse(table, "stress",
           std::string("is needed, or in_situ: ") + components +
               ", compression positive, world axes; write for example stress = " +
               (dimension == 2 ? "[50e3, 50e3, 0]" : "[50e3, 50e3, 50e3, 0, 0, 0]"));
  }
  if (plan.stress.size() != wanted)
    refuse(table, "stress",
           "must have " + std::to_string(wanted) + " entries because dimension = " + std::to_string(dimension) + ": " +
               components + ", compression positive");
  return plan;
}

ForcePlan read_force(const Subject& table, const Selector& bodies, const RunPlan* run) {
  ForcePlan plan;
  plan.bodies = bodies;
  read_keys(*table.node, "force", plan);
  plan.factor = read_factor(table);
  for (const char* key : {"times_s", "frequency_hz"})
    if (!run && table.node->find(key))
      refuse(table, key,
             "a time factor needs a stage of kind run: time has no meaning in the search for equilibrium; state the "
             "force only, or increase "
             "it in a stage of kind run before");
  if (run) plan.last_factor = value_at(plan.factor, run->duration);
  return plan;
}

ExcavationForcesPlan read_excavation_forces(const Subject& table,
                                            const std::variant<SettlePlan, RunPlan, ReducePlan>& stage) {
  ExcavationForcesPlan plan;
  read_keys(*table.node, "excavation_forces", plan);
  if (const auto* run = std::get_if<RunPlan>(&stage)) {
    if (!table.node->find("duration_s")) plan.duration = run->duration;
    if (plan.duration > run->duration)
      refuse(table, "duration_s",
             fmt::format("must be at most the stage's duration_s ({:g}): the stage would end before they have fallen; "
                         "shorten it, or leave it out for the whole stage",
                         run->duration));
  } else if (!table.node->find("duration_s")) {
    refuse(table, "duration_s",
           "is needed in a stage of kind settle, whose time is not known before; write for example duration_s = 1, as "
           "long as gravity_ramp_s");
  } else if (const auto* settle = std::get_if<SettlePlan>(&stage); settle && plan.duration >= settle->time_limit) {
    refuse(table, "duration_s",
           fmt::format(
               "must be less than time_limit_s ({:g}): equilibrium needs them to have fallen; shorten it or raise the "
               "limit",
               settle->time_limit));
  }
  return plan;
}

StageSpec read_stage(const Subject& table, const Settings& settings, int dimension, double rock_weight) {
  StageSpec stage;
  stage.subject = table;
  read_keys(*table.node, "stage", stage.plan);
  read_keys(*table.node, "stage", stage.plan.change);
  std::visit([&](auto& plan) { read_plan(table, plan); }, stage.plan.plan);
  if (const auto own = child(table, "damping")) {
    stage.plan.damping = settings.damping;
    read_keys(*own->node, "damping", *stage.plan.damping);
  }
  if (const auto own = child(table, "time")) {
    stage.plan.time = settings.time;
    read_keys(*own->node, "time", *stage.plan.time);
  }
  const TimeSettings& time = stage.plan.time ? *stage.plan.time : settings.time;
  const double joint_ratio = (stage.plan.damping ? *stage.plan.damping : settings.damping).joint_ratio;
  if (std::holds_alternative<RunPlan>(stage.plan.plan) && joint_ratio > 0 &&
      time.integration == Integration::explicit_steps)
    refuse(table, "damping",
           "joint_ratio is above zero: explicit steps would shrink with such dashpots; write time = { integration = "
           "\"implicit\" } in this stage, or damping = { joint_ratio = 0, viscous_ratio = 0.05 }");
  if (std::holds_alternative<RunPlan>(stage.plan.plan) && time.half_error &&
      (time.integration == Integration::explicit_steps || time.step))
    refuse(table, "time",
           "half_error asks for a second run with half of error_m, which only implicit steps of their own length have; "
           "write time = { integration = \"implicit\", half_error = true } in this stage, without step_s, or leave "
           "half_error out");
  if (table.node->find("statics") || table.node->find("static_increments")) {
    stage.plan.statics = settings.statics;
    read_keys(*table.node, "stage", *stage.plan.statics);
  }
  if (const auto* reduce = std::get_if<ReducePlan>(&stage.plan.plan);
      reduce && stage.plan.statics.value_or(settings.statics).method == Statics::newton &&
      (reduce->method == ReductionMethod::rate || reduce->method == ReductionMethod::two_rates))
    refuse(table, "method",
           "a reduction at a rate is a motion, which Newton's method does not compute; write method = \"bisection\" or "
           "\"steps\", or "
           "statics = \"adaptive\" in this stage");
  if (const auto item = child(table, "excavation_forces"))
    stage.plan.excavation_forces = read_excavation_forces(*item, stage.plan.plan);
  Change& change = stage.plan.change;
  const auto read_chosen = [&](const char* key, const auto& add) {
    for (const SelectorSpec& spec : stage.chosen[key] = read_selectors(table, key))
      add(spec.subject, spec.selector);
  };
  const auto choose = [&](const char* key, std::vector<Selector>& target) {
    read_chosen(key, [&](const Subject&, const Selector& bodies) { target.push_back(bodies); });
  };
  choose("fix", change.fix);
  choose("release", change.release);
  choose("remove", change.remove);
  if (change.friction && change.friction_as_stated)
    refuse(table, "friction_as_stated",
           "is stated together with friction_deg, another friction; remove one of the two");
  for (const Subject& item : children(table, "friction")) {
    FrictionPlan& plan = change.friction_of.emplace_back();
    read_keys(*item.node, "friction", plan);
    const bool angle = item.node->find("friction_deg") != nullptr;
    if (angle && plan.as_stated)
      refuse(item, "as_stated", "is stated together with friction_deg, another friction; remove one of the two");
    if (!angle && !plan.as_stated)
      refuse(item, "friction_deg", "is missing; write for example friction_deg = 30, or as_stated = true");
  }
  read_chosen("move", [&](const Subject& at, const Selector& bodies) {
    change.move.push_back(read_move(at, bodies, dimension, stage.records));
  });
  read_chosen("boundary", [&](const Subject& at, const Selector& bodies) {
    change.boundary.push_back(read_boundary(at, bodies, dimension, rock_weight, stage.records));
  });
  read_chosen("force", [&](const Subject& at, const Selector& bodies) {
    change.force.push_back(read_force(at, bodies, std::get_if<RunPlan>(&stage.plan.plan)));
  });
  return stage;
}

void check_angles_and_since(const Subject& table, const MonitorSpec& monitor) {
  const bool angles = table.node->find("angles_deg") != nullptr;
  if (!monitor.excavation.empty() && monitor.angles.empty())
    refuse(table, "angles_deg", "gives the points of the wall; write for example angles_deg = [90] for the crown");
  if (monitor.excavation.empty() && monitor.lining.empty() && angles)
    refuse(table, "angles_deg",
           "gives points of an opening's wall, or of a lining; write excavation or lining = its name, or remove it");
  if (!monitor.since.empty() && !monitor.since_start.empty())
    refuse(table, "since_start",
           "is stated together with since; a monitor measures from one instant, remove one of the two");
  const char* const since = monitor.since.empty() ? "since_start" : "since";
  for (const Monitored& followed : monitor.quantities)
    if (table.node->find(since) && !counts_from_stage(followed.quantity))
      refuse(table, since,
             fmt::format("{} is not a motion that could be measured from a stage on; state it in a monitor of its own, "
                         "or remove {}",
                         followed.word, since));
}

MonitorSpec read_monitor(const Subject& table) {
  MonitorSpec monitor;
  read_keys(*table.node, "monitors", monitor);
  monitor.body.subject = table;
  monitor.body.selector = read_choice(table);

  // the object of each quantity, and the key that names it
  const auto key_of = [](const Monitored& followed) -> std::string_view {
    const bool of_joint = followed.quantity == Quantity::contact_force || followed.quantity == Quantity::whole_bonds;
    if (followed.quantity == Quantity::bolt_force) return "bolts";
    if (followed.quantity == Quantity::lining_force) return "lining";
    if (followed.quantity == Quantity::convergence) return "excavation";
    return of_joint ? "joint" : followed.quantity == Quantity::level ? "water" : "";
  };
  std::string_view stated;
  for (const std::string_view key : {"joint", "water", "bolts", "lining", "excavation"}) {
    if (!table.node->find(key)) continue;
    if (!stated.empty())
      refuse(table, key, fmt::format("is stated together with {}; a monitor has one of the two, remove one", stated));
    stated = key;
  }
  for (const Monitored& followed : monitor.quantities) {
    const std::string_view wanted = key_of(followed);
    if (wanted == stated) continue;
    if (!wanted.empty())
      refuse(table, wanted,
             fmt::format("{} is a quantity of {}; write for example {} = \"A\"", followed.word,
                         wanted == "bolts"        ? "bolts"
                         : wanted == "excavation" ? "an excavation"
                                                  : fmt::format("a {}", wanted),
                         wanted));
    refuse(table, "quantities",
           stated == "joint"
               ? "a monitor of a joint has contact_force and whole_bonds only; state a block in a monitor of its own"
           : stated == "water"  ? "a monitor of a water has its level only; state a block in a monitor of its own"
           : stated == "lining" ? "a monitor of a lining has lining_force only; state a block in a monitor of its own"
           : stated == "bolts"
               ? "a monitor of bolts has bolt_force only; state a block in a monitor of its own"
               : "a monitor of an excavation has its convergence only; state a block in a monitor of its own");
  }
  if (!stated.empty() && chooses(monitor.body.selector))
    refuse(table, stated,
           fmt::format("is stated together with a choice of blocks; a monitor is of either {} or a block, remove one",
                       stated == "bolts"        ? "bolts"
                       : stated == "excavation" ? "an excavation"
                                                : fmt::format("a {}", stated)));
  check_angles_and_since(table, monitor);
  if (!stated.empty() && stated != "excavation" && monitor.over != Aggregate::one)
    refuse(table, "over", "applies to blocks, and this monitor has none; remove it");
  if (stated.empty() && !chooses(monitor.body.selector))
    refuse(table, "above",
           "the monitor must choose one block by bodies, above, below, inside, side or box; write for example "
           "above = [\"A\"] or inside = the coordinates of a point in the block");
  return monitor;
}

}  // namespace

SelectorSpec read_selector(const Subject& table) {
  SelectorSpec spec{table, read_choice(table)};
  if (!chooses(spec.selector))
    refuse(table, "below",
           "no block is chosen; choose by all = true, bodies, above, below, inside, side or box, for example below = "
           "[\"A\"]");
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
  read_keys(*scene.node, "", settings);
  read_keys(*scene.node, "", settings.statics);
  const ContactSettings& contact = settings.contact;
  if (settings.time.step && states(scene, "time", "fraction"))
    refuse(
        *child(scene, "time"), "fraction",
        "is stated together with step_s, which is the time step whatever the stability limit; remove one of the two");
  if (contact.normal == ContactNormal::multipliers && contact.overlap == OverlapSearch::bracketing)
    refuse(*child(scene, "contact"), "overlap",
           "searches along the potential's normal; with normal = \"multipliers\" the overlap is the value of the "
           "linear program, leave it "
           "out");
  return settings;
}

std::vector<StageSpec> read_stages(const Subject& scene, int dimension, const Settings& settings, double rock_weight) {
  std::vector<StageSpec> stages;
  for (const Subject& item : children(scene, "stage"))
    stages.push_back(read_stage(item, settings, dimension, rock_weight));
  check_open_sides(stages);
  chain_gravity(stages);
  free_runs(scene, settings, stages);
  return stages;
}

void require_stages(const Scene& scene) {
  if (scene.stages.empty())
    refuse({scene.tree.get(), ""}, "stage",
           "nothing would happen; write for example [[stage]] with name = \"settle\" and kind = \"settle\"");
}

std::vector<MonitorSpec> read_monitors(const Subject& scene) {
  std::vector<MonitorSpec> monitors;
  for (const Subject& item : children(scene, "monitors"))
    monitors.push_back(read_monitor(item));
  return monitors;
}

}  // namespace voussoir
