#include "core/limit/interfaces.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace voussoir {
namespace {

// of the smaller inscribed radius: corners written with seven digits are on one line within this; lever arms change by
// no more
constexpr double coplanar = 1e-6;

// a face as a segment of its plane, in model coordinates
struct Face {
  HalfSpace<2> plane;
  std::array<Vector<2>, 2> ends;
  int joint;
};

struct PlacedPart {
  int body;
  double size;
  Vector<2> low, high;
  std::vector<Face> faces;
};

PlacedPart place(const Model<2>& model, const PartId& id) {
  const Body<2>& body = model.bodies[id.body];
  const Polytope<2>& part = body.parts[id.part];
  PlacedPart placed{id.body, part.inscribed_radius, body.reference + part.vertices.front(), {}, {}};
  placed.high = placed.low;
  for (const Vector<2>& vertex : part.vertices) {
    placed.low = placed.low.cwiseMin(body.reference + vertex);
    placed.high = placed.high.cwiseMax(body.reference + vertex);
  }
  for (std::size_t f = 0; f < part.faces.size(); ++f) {
    const std::vector<int>& loop = part.loops[f];
    if (loop.size() != 2) continue;  // a plane that only touches a corner
    placed.faces.push_back({moved_origin<2>(part.faces[f], -body.reference),
                            {body.reference + part.vertices[loop[0]], body.reference + part.vertices[loop[1]]},
                            part.joints[f]});
  }
  return placed;
}

// the common segment of two faces, as an interface from a to b; the caller sets its joint and friction
bool meet(const Face& a, const Face& b, double tolerance, Interface& found) {
  if (a.plane.normal.dot(b.plane.normal) >= 0) return false;
  const Vector<2> origin = a.ends[0], along = (a.ends[1] - a.ends[0]).normalized();
  const auto place = [&](const Vector<2>& point) { return along.dot(point - origin); };
  const auto [low, high] = std::minmax({place(b.ends[0]), place(b.ends[1])});
  const double begin = std::max(0.0, low), end = std::min(place(a.ends[1]), high);
  if (end - begin <= tolerance) return false;
  found.ends = {origin + begin * along, origin + end * along};
  for (const Vector<2>& point : found.ends)
    if (std::abs(signed_distance(b.plane, point)) > tolerance) return false;
  found.normal = a.plane.normal;
  return true;
}

void find_between(const Model<2>& model, const PlacedPart& a, const PlacedPart& b, std::vector<Interface>& interfaces) {
  const double tolerance = coplanar * std::min(a.size, b.size);
  if (((a.low - b.high).array() > tolerance).any() || ((b.low - a.high).array() > tolerance).any()) return;
  for (const Face& face_a : a.faces)
    for (const Face& face_b : b.faces) {
      Interface found;
      if (!meet(face_a, face_b, tolerance, found)) continue;
      found.body_a = a.body;
      found.body_b = b.body;
      found.joint = std::max(face_a.joint, face_b.joint);
      found.one_joint = face_a.joint == face_b.joint && found.joint != no_joint;
      found.properties = found.joint == no_joint ? model.default_properties : model.joints[found.joint].properties;
      found.friction = model.properties[found.properties].friction;
      interfaces.push_back(found);
    }
}

}  // namespace

std::vector<Interface> find_interfaces(const Model<2>& model, bool bonded) {
  std::vector<PlacedPart> parts;
  for (const PartId& id : model.parts)
    if (model.bodies[id.body].present) parts.push_back(place(model, id));
  // swept from left to right: only parts that begin before this part ends can touch it
  std::stable_sort(parts.begin(), parts.end(),
                   [](const PlacedPart& a, const PlacedPart& b) { return a.low[0] < b.low[0]; });

  std::vector<Interface> interfaces;
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t j = i + 1; j < parts.size(); ++j) {
      if (parts[j].low[0] > parts[i].high[0] + coplanar * parts[i].size) break;
      const int a = parts[i].body, b = parts[j].body;
      if (a == b || (model.bodies[a].fixed && model.bodies[b].fixed)) continue;
      find_between(model, parts[a < b ? i : j], parts[a < b ? j : i], interfaces);
    }
  for (Interface& face : interfaces) {
    const JointProperties& p = model.properties[face.properties];
    if (bonded || (face.one_joint && p.bonds == BondsMade::as_sliced)) face.cohesion = p.cohesion;
  }
  std::stable_sort(interfaces.begin(), interfaces.end(), [](const Interface& p, const Interface& q) {
    const auto key = [](const Interface& x) { return std::tuple(x.body_a, x.body_b, x.ends[0][0], x.ends[0][1]); };
    return key(p) < key(q);
  });
  return interfaces;
}

}  // namespace voussoir
