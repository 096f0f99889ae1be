#include "core/model/model.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <stdexcept>

#include "core/geometry/eigen_pairs.hpp"
#include "core/load/water.hpp"
#include "core/potential/particle.hpp"

namespace voussoir {
namespace {

void find_principal_axes(Body<2>& body, const MassProperties<2>& mass, double density) {
  body.inertia[0] = density * inertia_tensor(mass);
}

void find_principal_axes(Body<3>& body, const MassProperties<3>& mass, double density) {
  const Matrix<3> tensor = density * inertia_tensor(mass);
  // axes that are principal already, to rounding, are kept: eigenvectors of equal moments are arbitrary
  const double off_diagonal = std::max({std::abs(tensor(0, 1)), std::abs(tensor(0, 2)), std::abs(tensor(1, 2))});
  if (off_diagonal <= 1e-13 * tensor.trace()) {
    body.inertia = tensor.diagonal();
    return;
  }
  const EigenPairs<3> own = eigen_pairs<3>(tensor);
  body.inertia = own.values;
  body.principal_axes = own.vectors;
  if (body.principal_axes.determinant() < 0) body.principal_axes.col(0) *= -1;
}

template <int Dim>
const Joint<Dim>& joint_named(const Model<Dim>& model, const std::string& name) {
  for (const Joint<Dim>& j : model.joints)
    if (j.name == name) return j;
  throw std::out_of_range(name);
}

template <int Dim>
bool contains(const Body<Dim>& body, const Vector<Dim>& point) {
  return std::any_of(body.parts.begin(), body.parts.end(), [&](const Polytope<Dim>& part) {
    if (is_particle(part)) return outside_by<Dim>(part, point - body.reference) <= 0;
    return std::all_of(part.faces.begin(), part.faces.end(),
                       [&](const HalfSpace<Dim>& f) { return signed_distance<Dim>(f, point - body.reference) <= 0; });
  });
}

// visits the outer faces of a body that face along an axis, with their position, m
template <int Dim, class Visit>
void each_outer_face(const Body<Dim>& body, int axis, double sign, const Visit& visit) {
  constexpr double aligned = 1 - 1e-12;
  for (const Polytope<Dim>& part : body.parts)
    for (std::size_t f = 0; f < part.faces.size(); ++f)
      if (part.joints[f] == no_joint && sign * part.faces[f].normal[axis] > aligned)
        visit(body.reference[axis] + part.vertices[part.loops[f].front()][axis]);
}

// a side of the model: the position of the outermost of all such faces
struct NamedSide {
  int axis = 0;
  double sign = 1, place = 0, size = 0;  // m
};

template <int Dim>
NamedSide side_named(const Model<Dim>& model, const std::string& name) {
  const std::vector<std::string> names = side_names<Dim>();
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) throw std::out_of_range(name);
  const auto number = found - names.begin();
  NamedSide side{.axis = static_cast<int>(number / 2), .sign = number % 2 == 0 ? -1.0 : 1.0};
  side.place = -side.sign * std::numeric_limits<double>::infinity();
  for (const Body<Dim>& body : model.bodies) {
    if (body.column) continue;
    each_outer_face(body, side.axis, side.sign, [&](double place) {
      side.place = side.sign < 0 ? std::min(side.place, place) : std::max(side.place, place);
    });
    side.size = std::max(side.size, body.reference.norm() + body.radius);
  }
  return side;
}

template <int Dim>
bool touches(const Body<Dim>& body, const NamedSide& side) {
  constexpr double rounding = 1e-9;
  bool found = false;
  each_outer_face(body, side.axis, side.sign,
                  [&](double place) { found = found || std::abs(place - side.place) <= rounding * side.size; });
  return found;
}

template <int Dim>
bool chosen(const Model<Dim>& model, const Body<Dim>& body, const Selector& s, const std::vector<NamedSide>& sides) {
  if (!body.present || body.column) return false;
  if (!sides.empty() && std::ranges::none_of(sides, [&](const NamedSide& side) { return touches(body, side); }))
    return false;
  for (std::size_t k = 0; k < s.low.size(); ++k) {
    const double place = model.origin[static_cast<int>(k)] + body.reference[static_cast<int>(k)];
    if (place < s.low[k] || place > s.high[k]) return false;
  }
  for (const std::string& name : s.above)
    if (!(signed_distance<Dim>(joint_named(model, name).plane, body.reference) > 0)) return false;
  for (const std::string& name : s.below)
    if (!(signed_distance<Dim>(joint_named(model, name).plane, body.reference) < 0)) return false;
  if (!s.names.empty() && std::find(s.names.begin(), s.names.end(), body.name) == s.names.end()) return false;
  if (s.inside && !contains<Dim>(body, Eigen::Map<const Vector<Dim>>(s.inside->data()) - model.origin)) return false;
  return true;
}

}  // namespace

template <int Dim>
std::vector<std::string> side_names() {
  if constexpr (Dim == 2)
    return {"left", "right", "bottom", "top"};
  else
    return {"west", "east", "south", "north", "bottom", "top"};
}

template <int Dim>
std::vector<int> select(const Model<Dim>& model, const Selector& selector) {
  for (const std::string& name : selector.names)
    if (std::none_of(model.bodies.begin(), model.bodies.end(), [&](const Body<Dim>& b) { return b.name == name; }))
      throw std::out_of_range(name);
  std::vector<int> bodies;
  std::vector<NamedSide> sides;
  for (const std::string& name : selector.sides)
    sides.push_back(side_named(model, name));
  const bool any = selector.all || !selector.names.empty() || !selector.above.empty() || !selector.below.empty() ||
                   selector.inside.has_value() || !selector.sides.empty() || !selector.low.empty();
  for (std::size_t b = 0; any && b < model.bodies.size(); ++b)
    if (!model.bodies[b].parts.empty() && chosen(model, model.bodies[b], selector, sides))
      bodies.push_back(static_cast<int>(b));
  return bodies;
}

template <int Dim>
void assign_waters(Model<Dim>& model, std::vector<Water> waters, std::vector<int> water_of_joint) {
  model.waters = std::move(waters);
  model.water_of_joint = std::move(water_of_joint);
  model.water_by_volume = model.waters.size() == 1 && !model.waters.front().uniform &&
                          std::ranges::all_of(model.water_of_joint, [](int water) { return water == 0; });
  bound_water_stiffness(model);
}

template <int Dim>
void bound_water_stiffness(Model<Dim>& model) {
  model.water_bounds.clear();
  if (model.waters.empty()) return;
  for (const Body<Dim>& body : model.bodies)
    model.water_bounds.push_back(greatest_water_stiffness<Dim>(body.parts, body.radius));
}

template <int Dim>
Body<Dim> make_body(std::vector<Polytope<Dim>> parts, double density) {
  std::stable_sort(parts.begin(), parts.end(),
                   [](const Polytope<Dim>& a, const Polytope<Dim>& b) { return in_order(a.mass, b.mass); });
  return assemble_body(std::move(parts), density);
}

template <int Dim>
Body<Dim> assemble_body(std::vector<Polytope<Dim>> parts, double density) {
  MassProperties<Dim> total;
  for (const Polytope<Dim>& p : parts) {
    total.volume += p.mass.volume;
    total.centroid += p.mass.volume * p.mass.centroid;
  }
  total.centroid /= total.volume;

  Body<Dim> body;
  body.reference = total.centroid;
  body.mass = density * total.volume;
  body.free_translation.fill(true);
  body.free_rotation.fill(true);
  total.centroid.setZero();
  for (Polytope<Dim>& p : parts) {
    body.parts.push_back(moved_origin<Dim>(std::move(p), body.reference));
    const Polytope<Dim>& moved = body.parts.back();
    // recomputed: if moved there, the second moment of a small part far from the origin would be lost
    const MassProperties<Dim> own = is_particle(moved) ? moved_origin<Dim>(moved.particle->mass.mass, -moved.centre)
                                                       : integrate(moved.vertices, moved.loops);
    total.second_moment += own.second_moment;
    body.radius = std::max(body.radius, moved.radius);
    body.size = body.size == 0 ? moved.inscribed_radius : std::min(body.size, moved.inscribed_radius);
  }
  find_principal_axes(body, total, density);
  return body;
}

template <int Dim>
double inscribed_radius(const Body<Dim>& body) {
  double radius = body.size;  // all that there is of a body without parts
  for (const Polytope<Dim>& part : body.parts)
    radius = std::max(radius, part.inscribed_radius);
  return radius;
}

template <int Dim>
double volume(const Body<Dim>& body) {
  double sum = 0;
  for (const Polytope<Dim>& p : body.parts)
    sum += p.mass.volume;
  return sum;
}

template <int Dim>
void number_bodies(Model<Dim>& model) {
  std::stable_sort(model.bodies.begin(), model.bodies.end(), [](const Body<Dim>& a, const Body<Dim>& b) {
    return in_order<Dim>({.volume = volume(a), .centroid = a.reference},
                         {.volume = volume(b), .centroid = b.reference});
  });
  list_parts(model);
}

template <int Dim>
void list_parts(Model<Dim>& model) {
  model.parts.clear();
  model.particles = false;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    for (std::size_t p = 0; p < model.bodies[b].parts.size(); ++p) {
      model.parts.push_back({static_cast<int>(b), static_cast<int>(p)});
      model.particles = model.particles || is_particle(model.bodies[b].parts[p]);
    }
}

template Body<2> make_body<2>(std::vector<Polytope<2>>, double);
template Body<3> make_body<3>(std::vector<Polytope<3>>, double);
template Body<2> assemble_body<2>(std::vector<Polytope<2>>, double);
template Body<3> assemble_body<3>(std::vector<Polytope<3>>, double);
template double volume<2>(const Body<2>&);
template double inscribed_radius<2>(const Body<2>&);
template double inscribed_radius<3>(const Body<3>&);
template double volume<3>(const Body<3>&);
template void number_bodies<2>(Model<2>&);
template void number_bodies<3>(Model<3>&);
template std::vector<std::string> side_names<2>();
template std::vector<std::string> side_names<3>();
template std::vector<int> select<2>(const Model<2>&, const Selector&);
template std::vector<int> select<3>(const Model<3>&, const Selector&);
template void bound_water_stiffness<2>(Model<2>&);
template void bound_water_stiffness<3>(Model<3>&);
template void assign_waters<2>(Model<2>&, std::vector<Water>, std::vector<int>);
template void assign_waters<3>(Model<3>&, std::vector<Water>, std::vector<int>);
template void list_parts<2>(Model<2>&);
template void list_parts<3>(Model<3>&);

}  // namespace voussoir
