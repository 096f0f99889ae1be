#include "verification/problems/write_json.hpp"

namespace voussoir::problems {
namespace {

using Json = nlohmann::ordered_json;

// no negative zeros, which readers would print
Json vector_json(const Point& p) {
  return Json::array({p[0] + 0.0, p[1] + 0.0, p[2] + 0.0});
}

Json quaternion_json(const Eigen::Quaterniond& q) {
  const double sign = q.w() < 0 ? -1 : 1;
  return Json::array({sign * q.w() + 0.0, sign * q.x() + 0.0, sign * q.y() + 0.0, sign * q.z() + 0.0});
}

Json block_json(const Solid& b) {
  Json own = Json::array(), world = Json::array(), faces = Json::array();
  for (const Point& v : b.vertices) {
    world.push_back(vector_json(v));
    own.push_back(vector_json(b.axes.transpose() * (v - b.centre)));
  }
  for (const Face& face : b.faces)
    faces.push_back({{"normal", vector_json(face.normal)}, {"offset_m", face.offset + 0.0}, {"corners", face.corners}});
  return {{"name", b.name},
          {"fixed", b.fixed},
          {"density_kg_m3", b.density},
          {"mass_kg", b.mass},
          {"centre_m", vector_json(b.centre)},
          {"quaternion_wxyz", quaternion_json(Eigen::Quaterniond(b.axes))},
          {"moments_kg_m2", b.moments},
          {"box_m", b.box ? Json(*b.box) : Json(nullptr)},
          {"vertices_m", world},
          {"vertices_in_axes_m", own},
          {"faces", faces},
          {"velocity_m_s", vector_json(b.velocity)},
          {"spin_rad_s", vector_json(b.spin)}};
}

Json stiffness_json(const Stiffness& s) {
  return {{"kn_Pa_per_m", s.normal}, {"ks_Pa_per_m", s.shear}};
}

Json joint_json(const JointOf& j) {
  return {{"blocks", j.first.empty() ? Json("all others") : Json::array({j.first, j.second})},
          {"friction_deg", j.friction_deg},
          {"cohesion_Pa", j.cohesion},
          {"tension_Pa", j.tension},
          {"restitution", 0},
          {"stiff", stiffness_json(j.stiff)},
          {"stated", j.stated ? stiffness_json(*j.stated) : Json(nullptr)}};
}

Json gravity_json(const std::vector<GravityAt>& table) {
  Json rows = Json::array();
  for (const GravityAt& row : table)
    rows.push_back({{"time_s", row.time}, {"g_m_s2", vector_json(row.gravity)}});
  return rows;
}

Json acts_json(const Search& search) {
  switch (search.kind) {
    case SearchKind::friction:
      return {{"kind", "friction"}};
    case SearchKind::tension:
      return {{"kind", "tension"}};
    case SearchKind::gravity_direction:
      return {{"kind", "gravity direction"}, {"axis", vector_json(search.axis)}};
    case SearchKind::vertices:
      break;
  }
  Json change = Json::object();
  for (const auto& [block, moves] : search.change)
    for (const Point& move : moves)
      change[block].push_back(vector_json(move));
  return {{"kind", "vertices"}, {"at", search.nominal}, {"change", change}};
}

Json search_json(const std::optional<Search>& search) {
  if (!search) return nullptr;
  return {{"parameter", search->parameter},
          {"lower", search->lower},
          {"upper", search->upper},
          {"tolerance", search->tolerance},
          {"fails_at", search->fails_at_upper ? "upper" : "lower"},
          {"acts", acts_json(*search)}};
}

Json criterion_json(const std::optional<Criterion>& criterion) {
  if (!criterion) return nullptr;
  Json out{{"kind", criterion->kind}};
  if (!criterion->block.empty()) out["block"] = criterion->block;
  if (!criterion->times.empty()) out["times_s"] = criterion->times;
  if (criterion->kind == "accelerates") out["excess_m"] = criterion->excess;
  if (criterion->kind == "gets faster")
    out["stopped_m"] = criterion->stopped;
  else
    out["far_m"] = criterion->far;
  return out;
}

Json forces_json(const std::vector<GivenForce>& forces) {
  Json list = Json::array();
  for (const GivenForce& f : forces)
    list.push_back({{"block", f.block},
                    {"force_N", vector_json(f.force)},
                    {"point_m", vector_json(f.point)},
                    {"times_s", f.times},
                    {"factors", f.factors}});
  return list;
}

Json bolts_json(const std::vector<Bolt>& bolts) {
  Json list = Json::array();
  for (const Bolt& b : bolts)
    list.push_back({{"name", b.name},
                    {"blocks", Json::array({b.from_block, b.to_block})},
                    {"from_m", vector_json(b.from)},
                    {"to_m", vector_json(b.to)},
                    {"stiffness_N_per_m", b.stiffness},
                    {"yield_N", b.yield_force}});
  return list;
}

Json variants_json(const std::vector<Variant>& variants) {
  Json list = Json::array();
  for (const Variant& v : variants) {
    Json velocities = Json::object();
    for (const auto& [block, velocity] : v.velocities)
      velocities[block] = vector_json(velocity);
    list.push_back({{"name", v.name},
                    {"quantities", v.quantities},
                    {"velocities_m_s", velocities},
                    {"gravity", gravity_json(v.gravity)},
                    {"duration_s", v.duration},
                    {"search", search_json(v.search)},
                    {"criterion", criterion_json(v.criterion)}});
  }
  return list;
}

}  // namespace

nlohmann::ordered_json blocks_json(const Problem& p) {
  Json blocks = Json::array(), joints = Json::array(), positions = Json::array(), asked = Json::array();
  for (const Solid& b : p.blocks)
    blocks.push_back(block_json(b));
  for (const JointOf& j : p.joints)
    joints.push_back(joint_json(j));
  for (const Position& position : p.positions)
    positions.push_back({{"name", position.name}, {"turn_wxyz", quaternion_json(position.turn)}});
  for (const Asked& a : p.asked)
    asked.push_back({{"quantity", a.quantity}, {"unit", a.unit}, {"how", a.how}});
  Json section = nullptr;
  if (p.dimension == 2) section = {{"axis", "y"}, {"depth_m", p.depth}};
  return {{"format", "voussoir problem 1"},
          {"name", p.name},
          {"title", p.title},
          {"dimension", p.dimension},
          {"units",
           {{"length", "m"}, {"mass", "kg"}, {"time", "s"}, {"force", "N"}, {"angle", "deg"}, {"stiffness", "Pa/m"}}},
          {"section", section},
          {"blocks", blocks},
          {"joints", joints},
          {"gravity", gravity_json(p.gravity)},
          {"duration_s", p.duration},
          {"output_s", p.output},
          {"loads", forces_json(p.forces)},
          {"bolts", bolts_json(p.bolts)},
          {"search", search_json(p.search)},
          {"criterion", criterion_json(p.criterion)},
          {"positions", positions},
          {"variants", variants_json(p.variants)},
          {"asked", asked}};
}

}  // namespace voussoir::problems
