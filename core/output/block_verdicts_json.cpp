#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/version.hpp"
#include "core/key_blocks/direction_cone.hpp"
#include "core/key_blocks/mass_values.hpp"
#include "core/output/block_verdicts.hpp"
#include "core/output/json_parts.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

using Json = nlohmann::ordered_json;

template <int Dim>
Json numbers(const Vector<Dim>& v) {
  return std::vector<double>(v.data(), v.data() + Dim);
}

Json number(const std::optional<double>& value) {
  if (!value) return nullptr;
  return std::isinf(*value) ? Json("inf") : Json(*value);
}

template <int Dim>
Json faces_of(const Survey<Dim>& survey, const SurveyRow<Dim>& row) {
  Json faces = Json::array();
  const std::vector<double> forces = normal_forces(row);
  for (std::size_t f = 0; f < row.faces.size(); ++f) {
    const RockFace<Dim>& face = row.faces[f];
    faces.push_back({{"joint", survey.joint_name(face)},
                     {"normal", numbers<Dim>(face.normal)},
                     {"area_m2", face.area},
                     {"tan_friction", face.tan_friction_at(forces[f])},
                     {"cohesion_N", face.cohesion},
                     {"normal_force_N", forces[f]}});
    if (!row.removability.weights.empty()) faces.back()["weight"] = row.removability.weights[f];
  }
  return faces;
}

template <int Dim>
Json entry_of(const Survey<Dim>& survey, const SurveyRow<Dim>& row) {
  const Verdict<Dim>& verdict = row.bolted.verdict;
  Json entry = {{"blocks", row.bodies}};
  if (row.cluster > 0) entry["cluster"] = row.cluster;
  entry["verdict"] = word_of(row.kind());
  entry["volume_m3"] = row.volume;
  entry["weight_N"] = row.weight;
  entry["surface_m2"] = row.surface;
  entry["contact_area_m2"] = row.contact_area;
  if (row.kind() == BlockKind::enclosed) return entry;
  entry["load_N"] = numbers<Dim>(row.bolted.load);
  entry["faces"] = faces_of(survey, row);
  if (row.taper) entry["taper_deg"] = to_degrees(*row.taper);
  if (row.removability.removable && !moves(row.kind())) entry["direction"] = numbers<Dim>(row.removability.direction);
  if (!moves(row.kind())) return entry;
  const bool falls = row.kind() != BlockKind::slides;
  entry["motion_N"] = numbers<Dim>(verdict.motion);
  entry["driving_N"] = verdict.driving();
  entry["friction_N"] = verdict.friction;
  entry["cohesion_N"] = verdict.cohesion;
  if (!row.bolts.empty()) entry["bolts"] = row.bolts;
  if (falls && !row.bolts.empty()) entry["bolts_N"] = *row.bolted.factor * verdict.driving() - verdict.cohesion;
  entry["factor"] = number(row.bolted.factor);
  entry["factor_passive"] = number(row.bolted.factor_passive);
  entry["indeterminate"] = verdict.indeterminate;
  entry["pressure_eccentricity"] = number(row.eccentricity);
  if (row.factor_moments) entry["factor_moments"] = number(row.factor_moments);
  if (row.force) entry["force_N"] = numbers<Dim>(row.force->force);
  return entry;
}

template <int Dim>
Json counts_of(const Survey<Dim>& survey) {
  Json counts = Json::object();
  for (int kind = 0; kind <= static_cast<int>(BlockKind::undecided); ++kind) {
    long blocks = 0;
    double sum = 0;
    for (const SurveyRow<Dim>& row : survey.rows)
      if (static_cast<int>(row.kind()) == kind) {
        ++blocks;
        sum += row.volume;
      }
    counts[word_of(static_cast<BlockKind>(kind))] = {{"blocks", blocks}, {"volume_m3", sum}};
  }
  return counts;
}

Json rounds_of(const SuccessiveFailure& failure) {
  Json rounds = Json::array();
  for (std::size_t r = 0; r < failure.rounds.size(); ++r)
    rounds.push_back({{"blocks", failure.rounds[r]}, {"volume_m3", failure.volumes[r]}});
  return rounds;
}

Json program_json(const std::vector<Origin>& origins) {
  return {{"version", version()}, {"commit", commit()}, {"compiler", compiler()}, {"origins", origins_json(origins)}};
}

}  // namespace

template <int Dim>
std::string blocks_results_json(const Survey<Dim>& survey, const std::string& title, const std::string& input_hash,
                                const std::vector<Origin>& origins) {
  const MassValues<Dim> mass = mass_values(survey);
  Json values = Json::object();
  if (mass.least_factor)
    values["least_factor"] = {{"value", *mass.least_factor}, {"unit", "1"}, {"divides", divided_by_blocks}};
  values["volume_below_1"] = {{"value", mass.volume_below_1}, {"unit", Dim == 3 ? "m3" : "m2"}};
  values["blocks_below_1"] = {{"value", mass.below_1.size()}, {"unit", "1"}};
  if (mass.least_critical_coefficient)
    values["least_critical_coefficient"] = {{"value", *mass.least_critical_coefficient}, {"unit", "1"}};
  const Json json = {
      {"schema", "voussoir.blocks_values"}, {"schema_version", 1}, {"title", title},  {"input_hash", input_hash},
      {"program", program_json(origins)},   {"status", "done"},    {"values", values}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

template <int Dim>
std::string blocks_json(const Survey<Dim>& survey, const std::string& title, const std::string& input_hash,
                        const std::vector<Origin>& origins) {
  Json json;
  json["schema"] = "voussoir.blocks";
  json["schema_version"] = 1;
  json["title"] = title;
  json["input_hash"] = input_hash;
  json["program"] = program_json(origins);
  json["dimension"] = Dim;
  json["closing_tolerance"] = closing_tolerance;
  json["strength_of"] = survey.strength;
  json["loads_of"] = survey.loads;
  json["required"] = survey.request.required;
  json["notes"] = survey.notes;
  Json friction = Json::object();
  for (const JointProperties& joint : survey.assembly.model.properties) {
    friction[joint.name] = {{"friction_deg", to_degrees(joint.friction)}, {"cohesion_Pa", joint.cohesion}};
    if (!joint.follows_barton_bandis()) continue;
    friction[joint.name]["jrc"] = joint.barton_bandis.jrc;
    friction[joint.name]["jcs_Pa"] = joint.barton_bandis.jcs;
  }
  json["joint_properties"] = friction;
  json["fixed"] = survey.fixed;
  json["counts"] = counts_of(survey);
  json["pairs"] = {
      {"judged", survey.pairs}, {"moving", survey.moving_pairs}, {"largest_cluster", survey.largest_cluster}};
  json["rounds_below_1"] = rounds_of(survey.below_one);
  if (survey.request.frictionless) json["rounds_moves"] = rounds_of(survey.frictionless);
  json["verdicts"] = Json::array();
  for (const SurveyRow<Dim>& row : survey.rows)
    json["verdicts"].push_back(entry_of(survey, row));
  json["clusters"] = Json::array();
  for (const SurveyRow<Dim>& row : survey.clusters)
    json["clusters"].push_back(entry_of(survey, row));
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                           \
  template std::string blocks_json<Dim>(const Survey<Dim>&, const std::string&, const std::string&,         \
                                        const std::vector<Origin>&);                                        \
  template std::string blocks_results_json<Dim>(const Survey<Dim>&, const std::string&, const std::string&, \
                                                const std::vector<Origin>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
