#include "core/motion/free_fall.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

namespace voussoir {
namespace {

// diagonal of the box around all bodies where they began
template <int Dim>
double width_of(const Model<Dim>& model) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Vector<Dim> low = Vector<Dim>::Constant(infinity), high = -low;
  for (const Body<Dim>& body : model.bodies) {
    low = low.cwiseMin(body.reference - Vector<Dim>::Constant(body.radius));
    high = high.cwiseMax(body.reference + Vector<Dim>::Constant(body.radius));
  }
  return (high - low).norm();
}

// free in all directions, and nothing but its weight acts on it
template <int Dim>
std::vector<bool> under_weight_alone(const Model<Dim>& model, const State<Dim>& state) {
  std::vector<bool> alone;
  for (const Body<Dim>& body : model.bodies)
    alone.push_back(
        body.present && !body.fixed &&
        std::all_of(body.free_translation.begin(), body.free_translation.end(), [](bool free) { return free; }));
  for (const Contact<Dim>& contact : state.contacts)
    if (contact.touching())
      for (const int part : {contact.part_a, contact.part_b})
        alone[model.parts[part].body] = false;
  for (const SourceRow& row : std::span(source_table).first(load_count)) {
    if (row.source == Source::gravity || row.motion < 0) continue;
    const std::vector<Load<Dim>>& loads = state.loads_of[row.source];
    for (std::size_t b = 0; b < loads.size(); ++b)
      if (!loads[b].force.isZero(0)) alone[b] = false;
  }
  return alone;
}

}  // namespace

template <int Dim>
int falling_free(const Model<Dim>& model, const State<Dim>& state) {
  const Vector<Dim> pull = state.schedule.gravity_factor * model.gravity;
  if (pull.isZero(0) || !model.prescribed.empty()) return -1;
  const Vector<Dim> ahead = pull.normalized();
  const double width = width_of(model);
  const std::vector<bool> alone = under_weight_alone(model, state);
  const auto falls = [&](std::size_t b) {
    const Motion<Dim>& motion = state.motions[b];
    return alone[b] && motion.displacement.dot(ahead) > width && motion.velocity.dot(ahead) >= 0;
  };

  // the foremost of all that might catch one
  double front = -std::numeric_limits<double>::infinity();
  const auto place = [&](std::size_t b) {
    return (model.bodies[b].reference + state.motions[b].displacement).dot(ahead);
  };
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (model.bodies[b].present && !falls(b)) front = std::max(front, place(b) + model.bodies[b].radius);
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (falls(b) && place(b) - model.bodies[b].radius > front) return static_cast<int>(b);
  return -1;
}

template <int Dim>
int fastest(const Model<Dim>& model, const State<Dim>& state) {
  int found = -1;
  double most = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<Dim>& body = model.bodies[b];
    if (!body.present || body.fixed) continue;
    const Motion<Dim>& motion = state.motions[b];
    const double speed = motion.velocity.norm() + body.radius * angular_velocity(body, motion).norm();
    if (!(speed > most)) continue;
    most = speed;
    found = static_cast<int>(b);
  }
  return found;
}

template int falling_free<2>(const Model<2>&, const State<2>&);
template int falling_free<3>(const Model<3>&, const State<3>&);
template int fastest<2>(const Model<2>&, const State<2>&);
template int fastest<3>(const Model<3>&, const State<3>&);

}  // namespace voussoir
