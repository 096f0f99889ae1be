#include "core/modes/modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/modes/spectrum.hpp"
#include "core/run/stage_in_force.hpp"

namespace voussoir {
namespace {

// The sign of an eigenvector is free: its largest component is positive.
void fix_sign(Eigen::VectorXd& shape) {
  Eigen::Index at = 0;
  for (Eigen::Index i = 1; i < shape.size(); ++i)
    if (std::abs(shape[i]) > std::abs(shape[at])) at = i;
  if (shape.size() > 0 && shape[at] < 0) shape = -shape;
}

// largest displacement of a vertex of the body
template <int Dim>
double largest_of(const Body<Dim>& body, const Matrix<Dim>& axes, const Vector<Dim>& way, const Spin<Dim>& turn) {
  double most = way.norm();
  for (const Polytope<Dim>& part : body.parts)
    for (const Vector<Dim>& vertex : part.vertices)
      most = std::max(most, (way + cross(turn, Vector<Dim>(axes * vertex))).norm());
  return most;
}

template <int Dim>
Mode<Dim> mode_of(const PencilAtRest<Dim>& rest, const State<Dim>& state, Eigenpair pair, double resolution,
                  const Vector<Dim>& free_mass) {
  constexpr int F = freedoms<Dim>, S = spin_freedoms<Dim>;
  fix_sign(pair.shape);
  Mode<Dim> mode;
  mode.omega_squared = pair.value;
  mode.no_stiffness = std::abs(pair.value) <= resolution;
  mode.displacement.assign(rest.model.bodies.size(), Vector<Dim>::Zero());
  mode.rotation.assign(rest.model.bodies.size(), Spin<Dim>::Zero());
  const Eigen::VectorXd momentum = rest.pencil.times_mass(pair.shape);
  for (std::size_t i = 0; i < rest.bodies.size(); ++i) {
    const int b = rest.bodies[i];
    const Eigen::Index at = F * static_cast<Eigen::Index>(i);
    mode.displacement[b] = pair.shape.segment<Dim>(at);
    mode.rotation[b] = pair.shape.segment<S>(at + Dim);
    mode.participation += momentum.segment<Dim>(at);
    const double moved = momentum.segment<Dim>(at).dot(mode.displacement[b]);
    const double all = moved + momentum.segment<S>(at + Dim).dot(mode.rotation[b]);
    mode.translation_share += moved;
    if (all > mode.body_share) {
      mode.body_share = all;
      mode.body = b;
    }
    mode.largest =
        std::max(mode.largest, largest_of<Dim>(rest.model.bodies[b], matrix(state.bodies.motions[b].rotation),
                                               mode.displacement[b], mode.rotation[b]));
  }
  for (int d = 0; d < Dim; ++d)
    if (free_mass[d] > 0) mode.mass_share[d] = mode.participation[d] * mode.participation[d] / free_mass[d];
  return mode;
}

}  // namespace

template <int Dim>
double Mode<Dim>::frequency() const {
  return omega_squared > 0 && !no_stiffness ? std::sqrt(omega_squared) / (2 * std::numbers::pi) : 0;
}

std::optional<int> stage_of_modes(const std::vector<StagePlan>& stages, const std::string& name) {
  for (const auto matches : {+[](const StagePlan& s) { return std::holds_alternative<SettlePlan>(s.plan); },
                             +[](const StagePlan& s) { return std::holds_alternative<ReducePlan>(s.plan); }})
    for (std::size_t i = stages.size(); i-- > 0;)
      if (name.empty() ? matches(stages[i]) : stages[i].name == name) return static_cast<int>(i);
  return std::nullopt;
}

template <int Dim>
Modes<Dim> find_modes(const Prepared<Dim>& scene, const Progress<Dim>& end, int stage, int number) {
  Modes<Dim> modes;
  modes.stage = scene.stages[stage].name;
  const PencilAtRest<Dim> rest = pencil_at_rest(scene, end.state, stage);
  modes.reason = rest.reason;
  modes.tangent = rest.tangent;
  if (!modes.reason.empty()) return modes;
  modes.free_bodies = static_cast<int>(rest.bodies.size());
  modes.available = rest.pencil.count();
  for (const int b : rest.bodies)
    for (int d = 0; d < Dim; ++d)
      if (rest.model.bodies[b].free_translation[d]) modes.free_mass[d] += rest.model.bodies[b].mass;
  Spectrum spectrum = lowest_eigenvalues(rest.pencil, number);
  modes.shift = spectrum.shift;
  modes.missing = spectrum.missing;
  modes.factorisations = spectrum.factorisations;
  modes.solutions = spectrum.solutions;
  if (spectrum.pairs.empty() || !spectrum.converged)
    modes.reason = spectrum.resolution > 0 ? "the iteration for the eigenvalues did not converge"
                                           : "no block touches another: nothing has stiffness";
  for (Eigenpair& pair : spectrum.pairs)
    modes.list.push_back(mode_of(rest, end.state, std::move(pair), spectrum.resolution, modes.free_mass));
  return modes;
}

template <int Dim>
double extent_of_free(const Model<Dim>& model) {
  Vector<Dim> low = Vector<Dim>::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Body<Dim>& body : model.bodies) {
    if (body.fixed || !body.present) continue;
    for (const Polytope<Dim>& part : body.parts)
      for (const Vector<Dim>& vertex : part.vertices) {
        low = low.cwiseMin(body.reference + vertex);
        high = high.cwiseMax(body.reference + vertex);
      }
  }
  return std::max((high - low).maxCoeff(), 0.0);
}

template <int Dim>
State<Dim> swung(const State<Dim>& rest, const Model<Dim>& model, const Mode<Dim>& mode, double reach, double phase) {
  State<Dim> state = rest;
  stop(state.bodies.motions);
  const double scale = mode.largest > 0 ? phase * reach / mode.largest : 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    Motion<Dim>& motion = state.bodies.motions[b];
    motion.displacement += scale * mode.displacement[b];
    motion.rotation = turned(motion.rotation, Spin<Dim>(scale * mode.rotation[b]));
  }
  return state;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                            \
  template struct Mode<Dim>;                                                                 \
  template Modes<Dim> find_modes<Dim>(const Prepared<Dim>&, const Progress<Dim>&, int, int); \
  template double extent_of_free<Dim>(const Model<Dim>&);                                    \
  template State<Dim> swung<Dim>(const State<Dim>&, const Model<Dim>&, const Mode<Dim>&, double, double);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
