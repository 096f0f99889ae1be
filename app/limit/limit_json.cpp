#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/limit/limit_files.hpp"
#include "app/run_folder/origin.hpp"
#include "core/base/version.hpp"
#include "core/output/json_parts.hpp"

namespace voussoir {
namespace {

using Json = nlohmann::ordered_json;

template <class Place>
Json point(const Eigen::MatrixBase<Place>& place) {
  Json numbers = Json::array();
  for (Eigen::Index k = 0; k < place.size(); ++k)
    numbers.push_back(place[k]);
  return numbers;
}

Json values_json(const LimitAnswer& analysis) {
  Json values = Json::object();
  for (const auto& [name, value] : analysis.values) {
    values[name] = {{"value", value.value}, {"unit", value.unit}};
    if (value.error_bar) values[name]["error_bar"] = *value.error_bar;
    if (!value.rule.empty()) values[name]["rule"] = value.rule;
    if (!value.divides.empty()) values[name]["divides"] = value.divides;
  }
  return values;
}

Json spin_json(const Spin<2>& spin) {
  return spin[0];
}

Json spin_json(const Spin<3>& spin) {
  return point(spin);
}

template <int Dim>
Json mechanism_json(const LimitAnalysis<Dim>& analysis) {
  Json blocks = Json::array();
  for (const BlockMotion<Dim>& motion : analysis.mechanism.moving) {
    const Body<Dim>& body = analysis.model.bodies[motion.body];
    const BodyVelocity<Dim>& v = analysis.state.velocities[motion.body];
    Json block = {{"body", motion.body},
                  {"name", body.name},
                  {"centroid_m", point(analysis.model.origin + body.reference)},
                  {"velocity", point(v.velocity)},
                  {"spin_per_m", spin_json(v.spin)},
                  {"rotation_share", motion.rotation_fraction}};
    if (Dim == 2) block["centre_m"] = motion.centre ? point(*motion.centre) : Json();
    blocks.push_back(block);
  }
  return {{"flow", analysis.flow},
          {"rotation_share", analysis.mechanism.rotation_fraction},
          {"turning", analysis.mechanism.turning},
          {"moving", blocks}};
}

template <int Dim>
Json interfaces_json(const LimitAnalysis<Dim>& analysis) {
  Json list = Json::array();
  for (std::size_t i = 0; i < analysis.assembly.faces.size(); ++i) {
    const CornerFace<Dim>& face = analysis.assembly.faces[i];
    Json entry = {{"bodies", {face.body_a, face.body_b}},
                  {"properties", analysis.model.properties[face.properties].name},
                  {"normal", point(face.normal)},
                  {"corners", Json::array()}};
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
      Json corner = {{"point_m", point(analysis.model.origin + face.corners[k])}};
      if (!analysis.state.forces.empty()) {
        const Vector<Dim>& force = analysis.state.forces[i][k];
        const double normal = force.dot(face.normal);
        corner["normal_N"] = normal;
        corner["shear_N"] = point(force - normal * face.normal);
      }
      entry["corners"].push_back(corner);
    }
    list.push_back(entry);
  }
  return list;
}

// at each joint that they cross
template <int Dim>
Json bolts_json(const LimitAnalysis<Dim>& analysis) {
  Json list = Json::array();
  for (std::size_t i = 0; i < analysis.assembly.ties.size(); ++i) {
    const CornerTie<Dim>& tie = analysis.assembly.ties[i];
    const Bolt<Dim>& bolt = analysis.model.bolts[tie.bolt];
    Json entry = {{"name", analysis.model.bolt_properties[bolt.properties].name},
                  {"number", bolt.number},
                  {"bodies", {tie.body_a, tie.body_b}},
                  {"yield_N", tie.most}};
    if (i < analysis.state.tensions.size()) entry["tension_N"] = analysis.state.tensions[i];
    list.push_back(entry);
  }
  return list;
}

// the bounds of joints that dilate; of others only the upper one is a bound
Json proof_json(const ProvedBounds& proof) {
  Json json;
  for (const auto& [name, bound, reason] : {std::tuple("proved_upper", proof.upper, proof.no_upper),
                                            {"carried_if_joints_dilate", proof.lower, proof.no_lower}})
    if (bound)
      json[name] = *bound;
    else
      json[std::string("no_") + name] = reason;
  if (!proof.file.empty()) json["file"] = "proof.json.gz";
  return json;
}

}  // namespace

template <int Dim>
std::string limit_json(const LimitAnalysis<Dim>& analysis) {
  const Evidence& evidence = analysis.evidence;
  Json json;
  json["schema"] = "voussoir.limit";
  json["schema_version"] = 2;
  json["title"] = analysis.title;
  json["input_hash"] = analysis.input_hash;
  json["warnings"] = analysis.warnings;
  json["program"] = {{"version", version()},
                     {"commit", commit()},
                     {"compiler", compiler()},
                     {"origins", origins_json({this_origin()})}};
  json["sought"] = analysis.sought;
  json["status"] = analysis.answered || analysis.enclosed          ? "done"
                   : analysis.status == LimitStatus::solver_failed ? "failed"
                                                                   : "incomplete";
  json["message"] = analysis.message;
  json["caveat"] = fmt::format("{}", fmt::join(analysis.caveats, "; "));
  json["values"] = values_json(analysis);
  json["evidence"] = {{"gap", evidence.gap},
                      {"out_of_balance", evidence.out_of_balance},
                      {"inadmissible", evidence.inadmissible},
                      {"cone_programs", evidence.programs}};
  if (evidence.rounds_of_tangents > 0)
    json["evidence"]["envelope"] = {{"rounds_of_tangents", evidence.rounds_of_tangents},
                                    {"agree", evidence.tangents_agree}};
  json["bound"] = analysis.bound;
  if (analysis.without_dilation) {
    Json held = Json::array();
    if (analysis.without_dilation->apart)
      for (const BlockMotion<Dim>& motion : analysis.mechanism.moving)
        held.push_back(motion.body);
    json["without_dilation"] = {{"rounds", analysis.without_dilation->rounds},
                                {"converged", analysis.without_dilation->converged},
                                {"held_by_self_stress", held}};
  }
  if (analysis.proof) json["proof"] = proof_json(*analysis.proof);
  if (analysis.values.empty()) json["evidence"] = {{"cone_programs", evidence.programs}};
  json["mechanism"] = mechanism_json(analysis);
  json["interfaces"] = interfaces_json(analysis);
  if (!analysis.assembly.ties.empty()) json["bolts"] = bolts_json(analysis);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

template std::string limit_json(const LimitAnalysis<2>&);
template std::string limit_json(const LimitAnalysis<3>&);

}  // namespace voussoir
