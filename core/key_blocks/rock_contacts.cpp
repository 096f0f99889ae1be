#include "core/key_blocks/rock_contacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/key_blocks/flat_overlap.hpp"

namespace voussoir {
namespace {

constexpr double same_direction = 1e-6;  // of unit normals: planes written with seven digits
constexpr double same_place = 1e-6;      // of the smallest block's inscribed radius, between two planes
constexpr double negligible = 1e-9;      // of the smaller face's box: an area below it is rounding

struct FaceId {
  int body, part, face;
  int joint;
};

// a plane with faces in it
template <int Dim>
struct FacePlane {
  HalfSpace<Dim> plane;
  int joint = no_joint;
  FaceId first{};  // of its faces
  bool used = false;
};

// Planes without equals. An entry is a joint of the model, or after them a face that no joint made, in order of bodies.
template <int Dim>
struct FacePlanes {
  std::vector<FacePlane<Dim>> list;
  std::vector<int> of_entry;  // place in `list`
};

// sorts planes so that equal ones are neighbours, whatever their sign
template <int Dim>
struct PlaneKey {
  HalfSpace<Dim> plane;  // its sign chosen
  double key;
  int place;
};

template <int Dim>
PlaneKey<Dim> key_of(const HalfSpace<Dim>& plane, double extent, int place) {
  // a direction without meaning, to which hardly any plane is parallel
  static constexpr std::array<double, 3> unlikely{0.8317, 0.4643, 0.3041};
  double along = 0;
  for (int k = 0; k < Dim; ++k)
    along += unlikely[k] * plane.normal[k];
  const double sign = along < 0 ? -1 : 1;
  return {{sign * plane.normal, sign * plane.offset}, sign * (along + 0.5 * plane.offset / extent), place};
}

template <int Dim>
bool is_face(const Polytope<Dim>& part, std::size_t face) {
  return part.loops[face].size() >= Dim;  // others only touch an edge or a corner
}

// calls `act` for every face of present bodies, in order of bodies, with its entry in FacePlanes
template <int Dim, class Act>
void for_faces(const Model<Dim>& model, const Act& act) {
  std::size_t loose = model.joints.size();
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<Dim>& body = model.bodies[b];
    if (!body.present) continue;
    for (std::size_t p = 0; p < body.parts.size(); ++p)
      for (std::size_t f = 0; f < body.parts[p].faces.size(); ++f) {
        if (!is_face(body.parts[p], f)) continue;
        const int joint = body.parts[p].joints[f];
        act(FaceId{static_cast<int>(b), static_cast<int>(p), static_cast<int>(f), joint},
            joint == no_joint ? loose++ : static_cast<std::size_t>(joint));
      }
  }
}

// Joints, and planes of faces that no joint made; equal planes become one.
template <int Dim>
FacePlanes<Dim> planes_of(const Model<Dim>& model) {
  std::vector<FacePlane<Dim>> all;
  for (std::size_t j = 0; j < model.joints.size(); ++j)
    all.push_back({model.joints[j].plane, static_cast<int>(j)});
  for_faces(model, [&](const FaceId& id, std::size_t entry) {
    if (entry == all.size()) {
      const Body<Dim>& body = model.bodies[id.body];
      all.push_back({moved_origin<Dim>(body.parts[id.part].faces[id.face], -body.reference)});
    }
    if (!all[entry].used) all[entry].first = id;
    all[entry].used = true;
  });
  double extent = 0, smallest = std::numeric_limits<double>::infinity();
  for (const Body<Dim>& body : model.bodies) {
    if (!body.present || body.parts.empty()) continue;
    extent = std::max(extent, body.reference.norm() + body.radius);
    smallest = std::min(smallest, body.size);
  }
  std::vector<PlaneKey<Dim>> keys;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].used) keys.push_back(key_of(all[i].plane, extent, static_cast<int>(i)));
  std::sort(keys.begin(), keys.end(), [](const PlaneKey<Dim>& a, const PlaneKey<Dim>& b) {
    return a.key != b.key ? a.key < b.key : a.place < b.place;
  });
  const double apart = same_place * smallest, window = 2 * same_direction + apart / extent;
  FacePlanes<Dim> planes;
  planes.of_entry.assign(all.size(), -1);
  std::vector<std::pair<PlaneKey<Dim>, int>> open;  // planes within the window, with their place in the list
  for (const PlaneKey<Dim>& key : keys) {
    std::erase_if(open, [&](const auto& earlier) { return earlier.first.key < key.key - window; });
    const auto equal = std::find_if(open.begin(), open.end(), [&](const auto& earlier) {
      return (earlier.first.plane.normal - key.plane.normal).norm() <= same_direction &&
             std::abs(earlier.first.plane.offset - key.plane.offset) <= apart;
    });
    if (equal != open.end()) {
      planes.of_entry[key.place] = equal->second;
      continue;
    }
    planes.of_entry[key.place] = static_cast<int>(planes.list.size());
    open.emplace_back(key, planes.of_entry[key.place]);
    planes.list.push_back(all[key.place]);
  }
  return planes;
}

template <int Dim>
class ContactFinder {
 public:
  explicit ContactFinder(const Model<Dim>& model) : model_(model) {
    found_.surface.assign(model.bodies.size(), 0);
    for (const Body<Dim>& body : model.bodies)
      fixed_.push_back(body.fixed);
    const FacePlanes<Dim> planes = planes_of(model);
    for (const FacePlane<Dim>& plane : planes.list)
      planes_.push_back({plane, frame_along(plane), {}, {}});
    // in order of bodies, whose memory is then read once
    for_faces(model, [&](const FaceId& id, std::size_t entry) { add_face(id, planes_[planes.of_entry[entry]]); });
  }

  // the contacts between the faces on the two sides of each plane
  void find() {
    std::size_t faces = 0;
    for (const Sides& sides : planes_)
      faces += sides.below.faces().size() + sides.above.faces().size();
    found_.list.reserve(faces / 2);  // most faces lie on one other
    found_.corners.reserve(5 * faces / 2);
    for (const Sides& sides : planes_)
      for_overlaps(sides.below, sides.above, negligible,
                   [&](const FlatFaces::Face& a, const FlatFaces::Face& b, const FlatOverlap& overlap) {
                     if (a.body == b.body)
                       found_.surface[a.body] -= 2 * sides.frame.unit_area() * overlap.area;
                     else if (!fixed_[a.body] || !fixed_[b.body])
                       add(a, b, overlap, sides);
                   });
  }

  RockContacts<Dim> finish() {
    const std::size_t bodies = model_.bodies.size();
    found_.first.assign(bodies + 1, 0);
    for (const RockContact<Dim>& contact : found_.list) {
      ++found_.first[contact.body_a + 1];
      ++found_.first[contact.body_b + 1];
    }
    for (std::size_t b = 0; b < bodies; ++b)
      found_.first[b + 1] += found_.first[b];
    std::vector<int> next(found_.first.begin(), found_.first.end() - 1);
    found_.of_bodies.resize(2 * found_.list.size());
    for (std::size_t i = 0; i < found_.list.size(); ++i)
      for (const int body : {found_.list[i].body_a, found_.list[i].body_b})
        found_.of_bodies[next[body]++] = static_cast<int>(i);
    return std::move(found_);
  }

 private:
  struct Sides {
    FacePlane<Dim> plane;
    PlaneFrame<Dim> frame;
    FlatFaces below, above;
  };

  void add_face(const FaceId& id, Sides& sides) {
    const Body<Dim>& body = model_.bodies[id.body];
    const Polytope<Dim>& part = body.parts[id.part];
    FlatFaces& side = part.faces[id.face].normal.dot(sides.plane.plane.normal) > 0 ? sides.below : sides.above;
    for (const int vertex : part.loops[id.face])
      side.add(sides.frame.flat(Vector<Dim>(part.vertices[vertex] + body.reference)));
    found_.surface[id.body] += sides.frame.unit_area() * side.end_face(id.body, id.part, id.face, id.joint);
  }

  // along two edges of the first face
  PlaneFrame<Dim> frame_along(const FacePlane<Dim>& plane) const {
    const Polytope<Dim>& part = model_.bodies[plane.first.body].parts[plane.first.part];
    const std::vector<int>& loop = part.loops[plane.first.face];
    const Vector<Dim> edge = part.vertices[loop[1]] - part.vertices[loop[0]];
    return {plane.plane.normal, edge, Vector<Dim>(part.vertices[loop.back()] - part.vertices[loop[0]])};
  }

  void add(const FlatFaces::Face& a, const FlatFaces::Face& b, const FlatOverlap& overlap, const Sides& sides) {
    const FacePlane<Dim>& plane = sides.plane;
    const PlaneFrame<Dim>& frame = sides.frame;
    const double height = plane.plane.offset;
    RockContact<Dim> contact{a.body, b.body, plane.plane.normal};
    if (plane.joint == no_joint) contact.normal = model_.bodies[a.body].parts[a.part].faces[a.face].normal;
    contact.joint = std::max(a.joint, b.joint);
    contact.one_joint = a.joint == b.joint;
    contact.properties =
        contact.joint == no_joint ? model_.default_properties : model_.joints[contact.joint].properties;
    contact.area = frame.unit_area() * overlap.area;
    contact.centroid = frame.place(overlap.centroid, height);
    contact.first_corner = static_cast<int>(found_.corners.size());
    contact.corners = static_cast<int>(overlap.corners.size());
    for (const FlatPoint& corner : overlap.corners)
      found_.corners.push_back(frame.place(corner, height));
    found_.list.push_back(contact);
  }

  const Model<Dim>& model_;
  RockContacts<Dim> found_;
  std::vector<Sides> planes_;
  std::vector<char> fixed_;  // by body: near each other in memory, as the bodies are not
};

}  // namespace

template <int Dim>
RockContacts<Dim> find_rock_contacts(const Model<Dim>& model) {
  ContactFinder<Dim> finder(model);
  finder.find();
  return finder.finish();
}

template RockContacts<2> find_rock_contacts<2>(const Model<2>&);
template RockContacts<3> find_rock_contacts<3>(const Model<3>&);

}  // namespace voussoir
