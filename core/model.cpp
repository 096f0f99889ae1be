#include "core/model.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <stdexcept>

#include "core/load/water.hpp"

namespace voussoir {
namespace {

void find_principal_axes(Body<2>& body, const MassProperties<2>& mass, double density) {
  body.inertia[0] = density * inertia_tensor(mass);
}

void find_principal_axes(Body<3>& body, const MassProperties<3>& mass, double density) {
  const Matrix<3> tensor = density * inertia_tensor(mass);
  // axes that are principal already, to rounding, stay as they are: eigenvectors of equal moments are arbitrary
  const double off_diagonal = std::max({std::abs(tensor(0, 1)), std::abs(tensor(0, 2)), std::abs(tensor(1, 2))});
  if (off_diagonal <= 1e-13 * tensor.trace()) {
    body.inertia = tensor.diagonal();
    return;
  }
  const Eigen::SelfAdjointEigenSolver<Matrix<3>> eigen(tensor);
  body.inertia = eigen.eigenvalues();
  body.principal_axes = eigen.eigenvectors();
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
    return std::all_of(part.faces.begin(), part.faces.end(),
                       [&](const HalfSpace<Dim>& f) { return signed_distance<Dim>(f, point - body.reference) <= 0; });
  });
}

template <int Dim>
bool chosen(const Model<Dim>& model, const Body<Dim>& body, const Selector& s) {
  if (!body.present) return false;
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
std::vector<int> select(const Model<Dim>& model, const Selector& selector) {
  for (const std::string& name : selector.names)
    if (std::none_of(model.bodies.begin(), model.bodies.end(), [&](const Body<Dim>& b) { return b.name == name; }))
      throw std::out_of_range(name);
  std::vector<int> bodies;
  const bool any = selector.all || !selector.names.empty() || !selector.above.empty() || !selector.below.empty() ||
                   selector.inside.has_value();
  for (std::size_t b = 0; any && b < model.bodies.size(); ++b)
    if (chosen(model, model.bodies[b], selector)) bodies.push_back(static_cast<int>(b));
  return bodies;
}

template <int Dim>
void assign_waters(Model<Dim>& model, std::vector<Water> waters, std::vector<int> water_of_joint) {
  model.waters = std::move(waters);
  model.water_of_joint = std::move(water_of_joint);
  model.water_by_volume = model.waters.size() == 1 && !model.waters.front().uniform &&
                          std::ranges::all_of(model.water_of_joint, [](int water) { return water == 0; });
  model.water_bounds.clear();
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
    // integrated again: moved there, the second moment of a small part far from the origin would be lost
    total.second_moment += integrate(moved.vertices, moved.loops).second_moment;
    body.radius = std::max(body.radius, moved.radius);
    body.size = body.size == 0 ? moved.inscribed_radius : std::min(body.size, moved.inscribed_radius);
  }
  find_principal_axes(body, total, density);
  return body;
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
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    for (std::size_t p = 0; p < model.bodies[b].parts.size(); ++p)
      model.parts.push_back({static_cast<int>(b), static_cast<int>(p)});
}

template Body<2> make_body<2>(std::vector<Polytope<2>>, double);
template Body<3> make_body<3>(std::vector<Polytope<3>>, double);
template Body<2> assemble_body<2>(std::vector<Polytope<2>>, double);
template Body<3> assemble_body<3>(std::vector<Polytope<3>>, double);
template double volume<2>(const Body<2>&);
template double volume<3>(const Body<3>&);
template void number_bodies<2>(Model<2>&);
template void number_bodies<3>(Model<3>&);
template std::vector<int> select<2>(const Model<2>&, const Selector&);
template std::vector<int> select<3>(const Model<3>&, const Selector&);
template void assign_waters<2>(Model<2>&, std::vector<Water>, std::vector<int>);
template void assign_waters<3>(Model<3>&, std::vector<Water>, std::vector<int>);
template void list_parts<2>(Model<2>&);
template void list_parts<3>(Model<3>&);

}  // namespace voussoir
