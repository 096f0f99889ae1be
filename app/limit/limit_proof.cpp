#include "app/limit/limit_proof.hpp"

#include <nlohmann/json.hpp>

#include "core/limit/proof.hpp"

namespace voussoir {
namespace {

using ProofJson = nlohmann::ordered_json;

ProofJson list_of(const auto& numbers) {
  ProofJson list = ProofJson::array();
  for (const auto& number : numbers)
    list.push_back(number);
  return list;
}

std::string hexadecimal(const Integer& number) {
  return (number < 0 ? "-" : "") + Integer(abs(number)).str(0, std::ios_base::hex);
}

template <int Dim>
ProofJson load_json(const Load<Dim>& load) {
  return {{"force_N", list_of(load.force)}, {"moment_Nm", list_of(load.moment)}};
}

template <int Dim>
ProofJson parts_json(const Model<Dim>& model, const LoadParts<Dim>& parts) {
  ProofJson others = ProofJson::array();
  for (const AppliedForce<Dim>& f : parts.forces)
    others.push_back({{"body", f.body},
                      {"point_m", list_of(Vector<Dim>(model.bodies[f.body].reference + f.place))},
                      {"force_N", list_of(f.force)}});
  for (std::size_t b = 0; b < parts.waters.size(); ++b) {
    if (parts.waters[b].force.isZero(0) && parts.waters[b].moment.isZero(0)) continue;
    ProofJson of = load_json(parts.waters[b]);
    of["body"] = b;
    others.push_back(of);
  }
  return {{"acceleration_m_s2", list_of(parts.acceleration)}, {"others", others}};
}

template <int Dim>
ProofJson body_json(const Model<Dim>& model, const LimitProof<Dim>& proof, std::size_t b) {
  const Body<Dim>& body = model.bodies[b];
  ProofJson parts = ProofJson::array();
  for (const Polytope<Dim>& part : body.parts) {
    ProofJson vertices = ProofJson::array(), loops = ProofJson::array();
    for (const Vector<Dim>& vertex : part.vertices)
      vertices.push_back(list_of(Vector<Dim>(body.reference + vertex)));
    for (const std::vector<int>& loop : part.loops)
      if (loop.size() >= Dim) loops.push_back(loop);
    parts.push_back({{"vertices_m", vertices}, {"faces", loops}});
  }
  ProofJson entry{{"name", body.name},
                  {"mass_kg", body.mass},
                  {"density_kg_m3", body.mass / volume(body)},
                  {"centroid_m", list_of(proof.assembly.bodies[b].centroid)},
                  {"free", proof.assembly.bodies[b].free},
                  {"dead", load_json(proof.dead[b])},
                  {"live", load_json(proof.live[b])}};
  if (proof.upper) {
    entry["velocity"] = list_of(proof.velocities[b].velocity);
    entry["spin_1_m"] = list_of(proof.velocities[b].spin);
  }
  entry["parts"] = parts;
  return entry;
}

template <int Dim>
ProofJson face_json(const LimitProof<Dim>& proof, std::size_t f) {
  const CornerFace<Dim>& face = proof.assembly.faces[f];
  ProofJson corners = ProofJson::array(), forces = ProofJson::array();
  for (const Vector<Dim>& corner : face.corners)
    corners.push_back(list_of(corner));
  ProofJson entry{{"bodies", {face.body_a, face.body_b}}, {"normal", list_of(face.normal)},
                  {"properties", face.properties},        {"friction_rad", face.friction},
                  {"tangent", proof.tangents[f]},         {"cohesion_Pa", face.cohesion},
                  {"cohesion_N", proof.cohesion[f]},      {"corners_m", corners}};
  if (!proof.lower) return entry;
  for (const Numbers<Integer, Dim>& force : proof.forces.at_corners[f]) {
    forces.emplace_back(ProofJson::array());
    for (const Integer& number : force)
      forces.back().push_back(hexadecimal(number));
  }
  entry["forces"] = forces;
  return entry;
}

template <int Dim>
std::string limit_proof_json(const Model<Dim>& model, const LimitProof<Dim>& proof, const LoadParts<Dim>& dead,
                             const LoadParts<Dim>& live) {
  const auto bound = [](const std::optional<double>& of) { return of ? ProofJson(*of) : ProofJson(); };
  ProofJson bodies = ProofJson::array(), faces = ProofJson::array(), properties = ProofJson::array();
  for (const JointProperties& p : model.properties)
    properties.push_back({{"name", p.name}, {"friction_rad", p.friction}, {"cohesion_Pa", p.cohesion}});
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    bodies.push_back(model.bodies[b].present && !model.bodies[b].parts.empty() ? body_json(model, proof, b)
                                                                               : ProofJson());
  for (std::size_t f = 0; f < proof.assembly.faces.size(); ++f)
    faces.push_back(face_json(proof, f));
  const ProofJson json{{"format", "voussoir limit proof 1"},
                       {"dimension", Dim},
                       {"origin_m", list_of(model.origin)},
                       {"gravity_m_s2", list_of(model.gravity)},
                       {"lower", bound(proof.lower)},
                       {"upper", bound(proof.upper)},
                       {"force_exponent", proof.forces.unit},
                       {"loads", {{"dead", parts_json(model, dead)}, {"live", parts_json(model, live)}}},
                       {"properties", properties},
                       {"bodies", bodies},
                       {"faces", faces}};
  return json.dump(-1, ' ', false, ProofJson::error_handler_t::replace) + "\n";
}

}  // namespace

template <int Dim>
Loads<Dim> loads_of(const Model<Dim>& model, const LoadParts<Dim>& parts) {
  Loads<Dim> loads = loads_of_acceleration(model, parts.acceleration);
  const Loads<Dim> applied = loads_of_applied_forces(model, parts.forces);
  for (std::size_t b = 0; b < loads.size(); ++b) {
    loads[b] += applied[b];
    if (!parts.waters.empty()) loads[b] += parts.waters[b];
  }
  return loads;
}

template <int Dim>
ProvedBounds prove_bounds(const Model<Dim>& model, const CornerAssembly<Dim>& assembly, const LoadParts<Dim>& dead,
                          const LoadParts<Dim>& live, const LoadFactor<Dim>& found) {
  const LimitProof<Dim> proof = prove_load_factor(assembly, loads_of(model, dead), loads_of(model, live), found);
  ProvedBounds bounds{proof.lower, proof.upper, proof.no_lower, proof.no_upper, {}};
  if (proof.lower || proof.upper) bounds.file = limit_proof_json(model, proof, dead, live);
  return bounds;
}

template Loads<2> loads_of(const Model<2>&, const LoadParts<2>&);
template Loads<3> loads_of(const Model<3>&, const LoadParts<3>&);
template ProvedBounds prove_bounds(const Model<2>&, const CornerAssembly<2>&, const LoadParts<2>&, const LoadParts<2>&,
                                   const LoadFactor<2>&);
template ProvedBounds prove_bounds(const Model<3>&, const CornerAssembly<3>&, const LoadParts<3>&, const LoadParts<3>&,
                                   const LoadFactor<3>&);

}  // namespace voussoir
