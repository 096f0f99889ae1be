#include "core/modes/tangent_at_rest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "core/contact/integrable.hpp"
#include "core/joint_laws/joint_law.hpp"
#include "core/run/run.hpp"
#include "core/run/stage_in_force.hpp"
#include "core/run/twin.hpp"
#include "core/step/integrate.hpp"
#include "core/step/neighbours.hpp"

namespace voussoir {
namespace {

constexpr double near_strength = 0.99;  // of the strength: such joints may slip in the mode
// Over its criterion: a run stops within it, and the forces found again at rest are no further from equilibrium.
constexpr double may_be_unbalanced = 10;

// The friction coefficient and cohesion, Pa, of joints that stick.
constexpr double sticking_friction = 1e6, sticking_cohesion = 1e20;

// of its area, by which a joint may lose area without losing shear force; differences change it by a hundredth of this
constexpr double spare_area = 1e-4;

// of the mean unbalanced force: forces of joints that stick are those of the state
constexpr double same_forces = 1e-6;

// of |K|: beyond this the symmetric part is another system
constexpr double most_asymmetry = 1e-2;

// the shear force over the strength at a point; `pressed`, N
template <int Dim>
double use_of_strength(const JointProperties& p, const Schedule& schedule, std::size_t of, double pressed, double area,
                       const JointState<Dim>& history) {
  const double factor = schedule.strength_factor.empty() ? 1 : schedule.strength_factor[of];
  const double stress = area > 0 ? pressed / area : 0;
  const double coefficient =
      friction_answer(p, schedule.friction[of], history.plastic_slip, stress, factor).coefficient;
  const double cohesion = cohesion_answer(p, history.bond, history.bond_slip, factor).stress;
  const double strength = coefficient * pressed + cohesion * area, shear = history.shear_force.norm();
  if (strength > 0) return shear / strength;
  return shear > 0 ? 1 : 0;
}

// the largest of a contact's points
template <int Dim>
double use_of_contact(const Model<Dim>& model, const State<Dim>& state, std::size_t place) {
  const Contact<Dim>& c = state.contacts.list[place];
  const JointProperties& p = model.properties[c.properties];
  const Vector<Dim>& normal = c.geometry.normal;
  if (c.cells == 0)
    return use_of_strength<Dim>(p, state.schedule, c.properties, c.force.dot(normal), c.history.area, c.history);
  double most = 0;
  for (const SubContact<Dim>& s : subs_of(state.contacts, place))
    if (s.area > 0)
      most = std::max(
          most, use_of_strength<Dim>(p, state.schedule, c.properties, s.force.dot(normal), s.history.area, s.history));
  return most;
}

template <int Dim>
void count_contacts(const Model<Dim>& model, const Settings& settings, const State<Dim>& state, TangentAtRest& found) {
  std::map<std::string, JointAtStrength> joints;
  for (std::size_t i = 0; i < state.contacts.list.size(); ++i) {
    const Contact<Dim>& c = state.contacts.list[i];
    const auto moves = [&](int part) { return !model.bodies[model.parts[part].body].fixed; };
    if (!c.touching() || (!moves(c.part_a) && !moves(c.part_b))) continue;
    ++found.contacts;
    const JointProperties& p = model.properties[c.properties];
    if (c.cells == 0 && p.sub_contacts == 1 && !is_integrated(settings.contact, p)) ++found.one_point;
    const int joint = joint_of(model, c);
    JointAtStrength& row = joints[joint == no_joint ? "" : model.joints[joint].name];
    ++row.closed;
    row.at_strength += use_of_contact(model, state, i) >= near_strength;
  }
  for (auto& [name, row] : joints) {
    row.joint = name;
    if (row.at_strength > 0) found.at_strength.push_back(row);
  }
}

// No joint slips, whichever way its bodies move; forces and the other histories are as they are.
template <int Dim>
void make_joints_stick(Model<Dim>& model, Schedule& schedule) {
  for (JointProperties& p : model.properties) {
    if (p.follows_barton_bandis()) p.laws.set_aside = true;  // keeps its rise
    p.laws.friction = FrictionLaw::constant;
    if (!p.laws.bond) continue;
    p.cohesion = sticking_cohesion;
    p.cohesion_law = CohesionLaw::plastic;
  }
  std::ranges::fill(schedule.friction, std::atan(sticking_friction));
}

// A joint that is partly open loses the shear force of area that opens, and area that closes brings none: two slopes.
// In between is that of a joint whose shear force stays, whichever way its area changes.
template <int Dim>
void keep_shear_forces(JointHistories<Dim>& histories) {
  const auto keep = [](JointState<Dim>& history) {
    history.area *= 1 - spare_area;
    history.polar *= 1 - spare_area;
  };
  for (ContactHistory<Dim>& contact : histories.contacts)
    keep(contact.history);
  std::ranges::for_each(histories.subs, keep);
}

template <int Dim>
typename Pencil<freedoms<Dim>>::Block root_of_mass(const Body<Dim>& body, const CachedPose<Dim>& pose,
                                                   const Eigen::VectorXd& free, Eigen::Index at) {
  constexpr int S = spin_freedoms<Dim>;
  typename Pencil<freedoms<Dim>>::Block root = Pencil<freedoms<Dim>>::Block::Zero();
  root.template topLeftCorner<Dim, Dim>().diagonal().setConstant(std::sqrt(body.mass));
  const Spin<Dim> roots = body.inertia.cwiseSqrt();
  if constexpr (Dim == 2)
    root(2, 2) = roots[0];
  else
    root.template bottomRightCorner<S, S>() = (pose.axes * body.principal_axes) * roots.asDiagonal();
  for (int f = 0; f < freedoms<Dim>; ++f)
    if (!(free[at + f] > 0)) root.row(f).setZero();
  return root;
}

// Makes a matrix symmetric. Returns |K - Kᵀ| / |K|.
template <int Size>
double make_symmetric(BlockMatrix<Size>& k) {
  double difference = 0, all = 0;
  for (int i = 0; i < k.rows(); ++i)
    for (int p = k.first[i]; p < k.first[i + 1]; ++p) {
      const int j = k.column[p];
      if (j < i) continue;
      typename BlockMatrix<Size>::Block& block = k.blocks[p];
      typename BlockMatrix<Size>::Block& other = k.at(j, i);
      const typename BlockMatrix<Size>::Block turned = other.transpose();
      difference += (j == i ? 1 : 2) * (block - turned).squaredNorm();
      all += block.squaredNorm() + (j == i ? 0 : turned.squaredNorm());
      const typename BlockMatrix<Size>::Block mean = 0.5 * (block + turned);
      block = mean;
      if (j != i) other = mean.transpose();
    }
  return all > 0 ? std::sqrt(difference / all) : 0;
}

template <int Dim>
std::string not_possible(const Model<Dim>& model) {
  const auto is_held = [](const Body<Dim>& body) {
    return body.present && (body.fixed || !std::ranges::all_of(body.free_translation, std::identity()));
  };
  const auto moves = [](const Body<Dim>& body) { return body.present && !body.fixed; };
  if (model.particles) return "modes need blocks with faces; the scene has potential particles";
  if (std::ranges::none_of(model.bodies, moves)) return "every block is fixed: no block can swing";
  if (std::ranges::none_of(model.bodies, is_held))
    return "nothing is fixed: the blocks move together without resistance; fix one, for instance "
           "fix = [{ below = [\"bedding\"] }]";
  return {};
}

}  // namespace

template <int Dim>
PencilAtRest<Dim> pencil_at_rest(const Prepared<Dim>& scene, const State<Dim>& rest, int stage) {
  constexpr int F = freedoms<Dim>;
  PencilAtRest<Dim> found;
  Twin<Dim> twin(scene);
  twin.model = model_after(scene, stage + 1);
  twin.settings = settings_of(scene.stages[stage], scene.settings);
  found.model = twin.model;
  found.reason = not_possible(twin.model);
  if (!found.reason.empty()) return found;

  State<Dim>& state = twin.progress.state;
  state = rest;
  state.relaxation = {};
  state.relaxation.under_way = true;  // joints have no dashpots
  state.increment = {};
  state.time_step.frequency.clear();  // of the measure of equilibrium; no body moves
  stop(state.bodies.motions);
  cache_poses(twin.model, twin.settings.threads, state.bodies);
  twin.unknowns = Unknowns<Dim>(twin.model);
  twin.take_base();
  twin.begin_increment(state.schedule);
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(twin.unknowns.free.size());
  const Eigen::VectorXd unbalanced = twin.residual(state.schedule, twin.base, still);
  found.tangent.unbalanced = unbalanced_ratio(twin.model, twin.settings.threads, state);
  const double limit = may_be_unbalanced * twin.settings.equilibrium.unbalanced;
  if (!(found.tangent.unbalanced <= limit)) {
    found.reason = fmt::format(
        "stage {} does not end in equilibrium: unbalanced ratio {:.2g}, at most {:.2g} is asked; settle before, or "
        "name "
        "another stage with --stage",
        scene.stages[stage].name, found.tangent.unbalanced, limit);
    return found;
  }
  count_contacts(twin.model, twin.settings, state, found.tangent);

  make_joints_stick(twin.model, state.schedule);
  keep_shear_forces(twin.base.histories);
  const Schedule sticking = state.schedule;
  const Eigen::VectorXd then = twin.residual(sticking, twin.base, still);
  double mean = 0;
  for (const Load<Dim>& load : state.loads.by_source[Source::contacts])
    mean = std::max(mean, load.force.norm());
  if ((then - unbalanced).norm() > same_forces * std::max(mean, unbalanced.norm())) {
    found.reason = "the forces of joints that stick are not those at rest: their laws have no elastic tangent";
    return found;
  }
  found.pencil.stiffness = twin.tangent(twin.base);
  found.tangent.asymmetry = make_symmetric(found.pencil.stiffness);
  if (found.tangent.asymmetry > most_asymmetry) {
    found.reason = fmt::format(
        "the tangent is not symmetric, by {:.1e} of itself: forces that turn with the blocks, water or closure that is "
        "lost have no modes of a symmetric system",
        found.tangent.asymmetry);
    return found;
  }
  found.bodies = twin.unknowns.bodies;
  found.free = twin.unknowns.free;
  for (std::size_t i = 0; i < found.bodies.size(); ++i) {
    const int b = found.bodies[i];
    found.pencil.mass_root.push_back(
        root_of_mass<Dim>(twin.model.bodies[b], state.bodies.poses[b], found.free, F * static_cast<Eigen::Index>(i)));
    typename Pencil<F>::Block own = found.pencil.stiffness.blocks[found.pencil.stiffness.diagonal[i]];
    for (int f = 0; f < F; ++f)
      if (!(found.free[F * static_cast<Eigen::Index>(i) + f] > 0)) own(f, f) = 0;
    if (own.isZero(0)) found.tangent.hanging.push_back(b);
  }
  return found;
}

template PencilAtRest<2> pencil_at_rest<2>(const Prepared<2>&, const State<2>&, int);
template PencilAtRest<3> pencil_at_rest<3>(const Prepared<3>&, const State<3>&, int);

}  // namespace voussoir
