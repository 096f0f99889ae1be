#include "core/output/results_json.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/version.hpp"
#include "core/output/atomic_file.hpp"
#include "core/output/json_parts.hpp"
#include "core/output/support_summary.hpp"

namespace voussoir {
namespace {

using Json = nlohmann::ordered_json;

// converts numbers to JSON and records the names of those that JSON cannot represent
struct NumberWriter {
  std::vector<std::string> not_finite;

  Json operator()(double number, const std::string& name) {
    if (std::isfinite(number)) return number;
    not_finite.push_back(name);
    return nullptr;
  }
};

// the key of a line's part of the bar beside "bracket" and "criterion"
std::string key_of(const BudgetLine& line) {
  if (line.varied.find(',') != std::string::npos) return "others";
  std::string key = line.varied;
  std::ranges::replace(key, ' ', '_');
  return key;
}

Json values_json(const Results& results, NumberWriter& number) {
  Json values = Json::object();
  for (const auto& [name, value] : results.values) {
    Json& entry = values[name];
    entry["value"] = number(value.value, name);
    entry["unit"] = value.unit;
    if (value.error_bar) {
      entry["error_bar"] = number(*value.error_bar, name + ".error_bar");
      entry["covers"] = value.covers;
      entry["error_bar_excludes"] = {"strengths", "geometry", "water"};
    }
    if (value.bracket) entry["bracket"] = number(*value.bracket, name + ".bracket");
    if (value.bracket_middle) entry["bracket_middle"] = number(*value.bracket_middle, name + ".bracket_middle");
    if (value.criterion) entry["criterion"] = number(*value.criterion, name + ".criterion");
    for (const BudgetLine& line : value.budget) {
      if (!line.sensitivity) entry[key_of(line)] = number(line.part, name + "." + key_of(line));
      entry["budget"].push_back({{"varied", line.varied},
                                 {"change", line.change},
                                 {"shift", number(line.shift, name + ".shift")},
                                 {"left", number(line.left, name + ".left")},
                                 {"part", number(line.part, name + ".part")},
                                 {"sensitivity", line.sensitivity}});
    }
    if (!value.not_varied.empty()) entry["not_varied"] = value.not_varied;
    if (!value.found_by.empty()) entry["found_by"] = value.found_by;
    if (value.turned) entry["turned"] = true;
    if (!value.rule.empty()) entry["rule"] = value.rule;
    if (!value.divides.empty()) entry["divides"] = value.divides;
  }
  return values;
}

// a number, or the reason for its absence: neither of the two reasons is a failure
void add_unbalanced(Json& entry, double unbalanced, NumberWriter& number, const std::string& name) {
  const bool no_contact = std::isinf(unbalanced), not_sought = unbalanced < 0;
  entry["unbalanced"] = no_contact || not_sought ? Json() : number(unbalanced, name);
  if (no_contact) entry["unbalanced_note"] = "no contact has a force";
  if (not_sought) entry["unbalanced_note"] = "equilibrium was not sought";
}

Json counters_json(const Counters& counters) {
  Json json;
  for (const CounterRow& row : counter_table)
    json[row.name] = counters.*row.value;
  return json;
}

Json bonds_json(const BondCount& bonds) {
  return {{"made", bonds.made},
          {"whole", bonds.whole},
          {"slipped", bonds.slipped},
          {"broken", bonds.broken},
          {"removed_with_blocks", bonds.removed},
          {"joints_not_pressed_yet", bonds.due}};
}

Json bonds_json(const WholeBonds& bonds, NumberWriter& number) {
  Json json = {{"whole", bonds.whole}, {"slipped", bonds.slipped}, {"made", bonds.made}, {"by_joint", Json::array()}};
  for (const BondsOfJoint& joint : bonds.by_joint)
    json["by_joint"].push_back({{"joint", joint.joint.empty() ? Json() : Json(joint.joint)},
                                {"whole", joint.whole},
                                {"slipped", joint.slipped},
                                {"made", joint.made},
                                {"area_share", number(joint.area_share, "area_share of joint " + joint.joint)}});
  return json;
}

void add_number(Json& entry, const char* key, const std::optional<double>& value, NumberWriter& number) {
  if (value) entry[key] = number(*value, key);
}

Json joint_json(const MovingJoint& joint, NumberWriter& number) {
  return {{"joint", joint.joint.empty() ? Json() : Json(joint.joint)},
          {"slip_m", number(joint.slip, "slip_m of a joint")},
          {"opening_m", number(joint.opening, "opening_m of a joint")},
          {"normal_force_N", number(joint.force, "normal_force_N of a joint")},
          {"slips", joint.slips},
          {"opens", joint.opens},
          {"carries", joint.carries}};
}

Json cluster_json(const MovingCluster& cluster, NumberWriter& number) {
  Json entry = {{"blocks", cluster.bodies},
                {"volume_m3", number(cluster.volume, "volume_m3 of a cluster")},
                {"weight_N", number(cluster.weight, "weight_N of a cluster")},
                {"free_mass_share", number(cluster.free_share, "free_mass_share of a cluster")},
                {"motion", word_of(cluster.motion)},
                {"displacement_m", number(cluster.displacement, "displacement_m of a cluster")},
                {"farthest_m", number(cluster.farthest, "farthest_m of a cluster")},
                {"plunge_deg", number(cluster.plunge, "plunge_deg of a cluster")},
                {"trend_deg", number(cluster.trend, "trend_deg of a cluster")},
                {"turn_deg", number(cluster.turn, "turn_deg of a cluster")}};
  for (const double coordinate : cluster.about)
    entry["about_m"].push_back(number(coordinate, "about_m of a cluster"));
  if (!cluster.about.empty()) entry["about_edge"] = cluster.at_edge;
  for (const double component : cluster.axis)
    entry["axis"].push_back(number(component, "axis of a cluster"));
  entry["joints"] = Json::array();
  for (const MovingJoint& joint : cluster.joints)
    entry["joints"].push_back(joint_json(joint, number));
  return entry;
}

Json mechanism_json(const FailureMechanism& mechanism, NumberWriter& number) {
  Json entry = {{"sentence", sentence_of(mechanism)},
                {"free_mass_share", number(mechanism.free_share, "free_mass_share of a mechanism")}};
  if (const auto& bonds = mechanism.bonds)
    entry["bonds"] = {{"broken", bonds->broken}, {"slipped", bonds->slipped}, {"whole", bonds->whole}};
  entry["clusters"] = Json::array();
  for (const MovingCluster& cluster : mechanism.clusters)
    entry["clusters"].push_back(cluster_json(cluster, number));
  return entry;
}

// what supports carry at the end of a stage
void add_supports(Json& entry, const SupportsCarry& carry, const std::string& prefix, NumberWriter& number) {
  for (const BoltsCarry& b : carry.bolts) {
    const std::string name = prefix + "bolts." + b.name + ".";
    Json row = {{"bolts", b.name}, {"count", b.bolts}, {"force_N", number(b.force, name + "force_N")},
                {"bolt", b.bolt},  {"joint", b.joint}, {"shear_N", number(b.shear, name + "shear_N")}};
    if (b.use) row["use"] = number(*b.use, name + "use");
    row.update({{"yielded", b.yielded}, {"broken", b.broken}, {"slipped", b.slipped}});
    entry["bolts"].push_back(row);
  }
  for (const LiningCarries& l : carry.linings) {
    const std::string name = prefix + "linings." + l.name + ".";
    Json row = {{"lining", l.name},
                {"thrust_N_per_m", number(l.thrust, name + "thrust_N_per_m")},
                {"thrust_node", l.thrust_node},
                {"moment_Nm_per_m", number(l.moment, name + "moment_Nm_per_m")},
                {"moment_node", l.moment_node},
                {"pressure_Pa", number(l.pressure, name + "pressure_Pa")}};
    if (l.use) row["use"] = number(*l.use, name + "use");
    entry["linings"].push_back(row);
  }
}

Json half_error_json(const HalfErrorResult& half, const std::string& prefix, NumberWriter& number) {
  return {{"body", half.body},
          {"name", half.name},
          {"displacement_m", number(half.displacement, prefix + "displacement_m")},
          {"change_m", number(half.change, prefix + "change_m")}};
}

Json stages_json(const Results& results, NumberWriter& number) {
  Json stages = Json::array();
  for (const StageResult& stage : results.stages) {
    const std::string prefix = "stage " + stage.name + ".";
    Json& entry = stages.emplace_back();
    entry = {{"name", stage.name},
             {"kind", stage.kind},
             {"ended", stage.ended},
             {"relaxed", stage.relaxed},
             {"steps", stage.steps},
             {"time_s", number(stage.time, prefix + "time_s")},
             {"time_step_s", number(stage.time_step, prefix + "time_step_s")}};
    if (stage.shortest_step > 0) entry["shortest_step_s"] = number(stage.shortest_step, prefix + "shortest_step_s");
    add_unbalanced(entry, stage.unbalanced, number, prefix + "unbalanced");
    if (stage.half_error) entry["half_error"] = half_error_json(*stage.half_error, prefix + "half_error.", number);
    if (stage.mechanism.known()) entry["mechanism"] = mechanism_json(stage.mechanism, number);
    add_supports(entry, supports_carry(results, static_cast<int>(stages.size())), prefix, number);
  }
  return stages;
}

Json trial_json(const TrialRow& trial, NumberWriter& number) {
  Json entry = {{"trial", trial.trial}, {"level", number(trial.level, "level of a trial")}};
  entry["body"] = trial.body < 0 ? Json() : Json(trial.body);
  entry["name"] = trial.name;
  entry["displacement_m"] = number(trial.displacement, "displacement_m of a trial");
  add_number(entry, "elastic_displacements", trial.elastic_displacements, number);
  add_number(entry, "required", trial.required, number);
  add_number(entry, "bolts_turned_deg", trial.bolts_turned, number);
  add_number(entry, "bolts_use", trial.bolts_use, number);
  add_number(entry, "water_lost", trial.water_lost, number);
  if (trial.mechanism.known()) entry["mechanism"] = mechanism_json(trial.mechanism, number);
  return entry;
}

Json block_theory_json(const BlockTheory& theory, NumberWriter& number) {
  Json entry = {{"verdict", theory.kind}};
  add_number(entry, "critical", theory.critical, number);
  add_number(entry, "friction_only", theory.friction_only, number);
  add_number(entry, "brittle", theory.brittle, number);
  entry["joints"] = theory.joints;
  if (theory.force)
    entry["force"] = {{"required", theory.required},
                      {"force_N", number(*theory.force, "block_theory.force_N")},
                      {"plunge_deg", number(theory.force_plunge, "block_theory.plunge_deg")},
                      {"trend_deg", number(theory.force_trend, "block_theory.trend_deg")}};
  if (theory.lower_block >= 0)
    entry["lower"] = {{"block", theory.lower_block}, {"critical", number(theory.lower, "block_theory.lower")}};
  entry["differs"] = theory.differs;
  entry["reasons"] = theory.reasons;
  return entry;
}

// an entry for each stage, with a row for each kind of strength
Json stable_states_json(const Results& results, NumberWriter& number) {
  Json states = Json::array();
  for (const StableState& at : results.at_last_stable_state) {
    Json& entry = states.emplace_back();
    entry = {{"stage", at.stage}, {"kind", at.kind}};
    if (at.level) entry["level"] = number(*at.level, "level of stage " + at.stage);
    if (at.level) entry["unit"] = at.unit;
    if (at.bonds) entry["bonds"] = bonds_json(*at.bonds, number);
    if (at.trial) entry["last_stable_trial"] = trial_json(*at.trial, number);
    if (at.failed) entry["last_failed_trial"] = trial_json(*at.failed, number);
    add_number(entry, "taken_out", at.taken_out, number);
    if (!at.bracket_because.empty()) entry["bracket_because"] = at.bracket_because;
    if (at.followed)
      entry["followed"] = {{"rests", at.followed->rests},
                           {"displacement_m", number(at.followed->displacement, "followed.displacement_m")},
                           {"steps", at.followed->steps},
                           {"ended", at.followed->ended}};
    if (at.block_theory) entry["block_theory"] = block_theory_json(*at.block_theory, number);
  }
  return states;
}

Json moved_json(const std::vector<MovedBody>& moved, NumberWriter& number) {
  Json list = Json::array();
  for (const MovedBody& m : moved) {
    Json& entry = list.emplace_back();
    entry = {{"stage", m.stage},
             {"body", m.body},
             {"name", m.name},
             {"distance_m", number(m.distance, "moved.distance_m")},
             {"inscribed_radius_m", m.inscribed_radius},
             {"against_body", m.against < 0 ? Json() : Json(m.against)},
             {"left_every_contact", m.left_all}};
    for (const double coordinate : m.place)
      entry["rests_at_m"].push_back(number(coordinate, "moved.rests_at_m"));
  }
  return list;
}

Json energy_json(const EnergyBalance& energy, NumberWriter& number) {
  const std::pair<const char*, double> entries[] = {
      {"kinetic", energy.kinetic},
      {"elastic", energy.elastic},
      {"potential", energy.potential()},
      {"friction", energy.flows[Source::friction]},
      {"damping", energy.damping()},
      {"external", energy.external()},
      {"lost_area", energy.flows[Source::lost_area]},
      {"stiffening", energy.flows[Source::stiffening]},
      {"unexplained", energy.unexplained()},
      {"relative_energy_error", energy.relative_error()},
  };
  Json json = {{"unit", "J"}};
  for (const auto& [name, value] : entries)
    json[name] = number(value, std::string("energy.") + name);
  for (const SourceRow& row : source_table)
    json["sources"][std::string(row.name)] =
        number(energy.flows[row.source], "energy.sources." + std::string(row.name));
  return json;
}

Json program_json(const RunRecord& record) {
  Json features = Json::object();
  for (const auto& [name, built_in] : record.features)
    features[name] = built_in;
  return {{"version", version()},
          {"commit", commit()},
          {"compiler", compiler()},
          {"features", features},
          {"origins", origins_json(record.origins)}};
}

std::string complete_message(const Results& results, const NumberWriter& number) {
  std::string message = results.message;
  for (const std::string& name : number.not_finite)
    message += (message.empty() ? "" : "; ") + name + " is not a finite number";
  return message;
}

}  // namespace

std::string outcome_name(Outcome outcome) {
  switch (outcome) {
    case Outcome::done:
      return "done";
    case Outcome::incomplete:
      return "incomplete";
    case Outcome::failed:
      return "failed";
  }
  return "failed";
}

std::string results_json(const Results& results, const RunRecord& record) {
  NumberWriter number;
  const Json values = values_json(results, number), stages = stages_json(results, number),
             energy = energy_json(results.energy, number), stable_states = stable_states_json(results, number),
             moved = moved_json(results.moved, number);

  Json json;
  json["schema"] = "voussoir.results";
  json["schema_version"] = results_schema_version;
  json["title"] = record.title;
  json["dimension"] = record.dimension;
  json["input_hash"] = record.input_hash;
  json["warnings"] = record.warnings;
  for (const std::string& warning : results.warnings)
    json["warnings"].push_back(warning);
  json["program"] = program_json(record);
  json["status"] = outcome_name(results.outcome);
  json["message"] = complete_message(results, number);
  json["values"] = values;
  json["stages"] = stages;
  if (!stable_states.empty()) json["at_last_stable_state"] = stable_states;
  json["energy"] = energy;
  json["counters"] = counters_json(results.counters);
  if (results.budget_evaluations > 0) json["budget"] = {{"contact_evaluations", results.budget_evaluations}};
  if (!record.rounds.empty()) json["accuracy"] = rounds_json(record.rounds);
  if (!record.records.empty()) json["records"] = records_json(record.records);
  if (results.bonds) json["bonds"] = bonds_json(*results.bonds);
  if (!results.cohesion.empty()) json["cohesion"] = results.cohesion;
  if (!results.moved.empty()) json["moved"] = moved;
  if (results.forces_remaining > 0) json["excavation_forces"] = {{"remaining", results.forces_remaining}};
  json["state_hash"] = results.state_hash;
  json["timing"] = {{"seconds", std::isfinite(results.seconds) ? Json(results.seconds) : Json()},
                    {"threads", record.threads}};
  // a scene's title may contain bytes that are not UTF-8: replace them, because a lost result would be worse
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json rounds_json(const std::vector<AccuracyRound>& rounds) {
  Json json = Json::array();
  for (const AccuracyRound& round : rounds)
    json.push_back({{"settings", round.settings},
                    {"told", round.told},
                    {"contact_evaluations", round.contact_evaluations},
                    {"parts", round.parts}});
  return json;
}

void write_results_json(const std::filesystem::path& path, const Results& results, const RunRecord& record) {
  write_file(path, results_json(results, record));
}

}  // namespace voussoir
