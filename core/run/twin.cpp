#include "core/run/twin.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/run/stage_changes.hpp"
#include "core/step.hpp"
#include "core/step/bodies_of_step.hpp"
#include "core/step/loads.hpp"
#include "core/step/pair_stiffness.hpp"
#include "core/step/support_table.hpp"
#include "core/step/tangent.hpp"
#include "core/step/water_stiffness.hpp"

namespace voussoir {
namespace {

// of the two singular vectors: changes of the smaller value beyond which iteration ends, and most iterations
constexpr double steady_direction = 1e-13;
constexpr int most_inverse_iterations = 200;

// how far a water's numbers have come from those before a change to those after it
double share_of_change(const WaterPlan& plan, const std::vector<double>& now) {
  for (std::size_t k = 0; k < now.size(); ++k)
    if (plan.from[k] != plan.to[k]) return (now[k] - plan.from[k]) / (plan.to[k] - plan.from[k]);
  return 1;
}

template <int Dim>
Spin<Dim> turn_between(const Rotation<Dim>& from, const Rotation<Dim>& to) {
  if constexpr (Dim == 2)
    return Spin<2>(to.angle - from.angle);
  else
    return rotation_vector(Rotation<3>{to.quaternion * from.quaternion.conjugate()});
}

}  // namespace

template <int Dim>
void Twin<Dim>::enter(int stage) {
  progress.stage = stage;
  progress.stage_under_way = false;
  enter_stage(*scene, model, settings, progress);
  begin_stage(this->stage(), progress);
  State<Dim>& state = progress.state;
  state.relaxation = {};
  state.relaxation.under_way = true;  // joints have no dashpots
  state.increment = {};
  stop(state.bodies.motions);
  cache_poses(model, settings.threads, state.bodies);
  unknowns = Unknowns<Dim>(model);
  take_base();
}

template <int Dim>
Schedule Twin<Dim>::schedule_beside(const Twin& other, const Schedule& of_other) const {
  Schedule own = of_other;
  for (std::size_t p = 0; p < model.properties.size(); ++p) {
    const double stated = other.model.properties[p].friction;
    const double factor = of_other.strength_factor.empty() ? 1 : of_other.strength_factor[p];
    if (factor != 1)
      set_strength(model, Searched::factor, {static_cast<int>(p)}, factor, own);
    else if (of_other.friction[p] == stated)
      own.friction[p] = model.properties[p].friction;
  }
  // a water that no stage has changed yet has the numbers of its model
  own.water = progress.state.schedule.water;
  const std::vector<WaterPlan>&plans = stage().plan().water, &of_plans = other.stage().plan().water;
  for (std::size_t k = 0; k < std::min(plans.size(), of_plans.size()); ++k) {
    const WaterPlan& plan = plans[k];
    std::vector<double>& numbers = own.water[plan.water];
    const double share = share_of_change(of_plans[k], of_other.water[plan.water]);
    for (std::size_t i = 0; i < numbers.size(); ++i)
      numbers[i] = plan.from[i] + share * (plan.to[i] - plan.from[i]);
  }
  own.last_water = own.water;
  return own;
}

template <int Dim>
Eigen::VectorXd Twin<Dim>::residual(const Schedule& schedule, const StaticBase<Dim>& from, const Eigen::VectorXd& q) {
  constexpr int F = freedoms<Dim>, S = spin_freedoms<Dim>;
  State<Dim>& state = progress.state;
  state.schedule = schedule;
  state.contacts.kept.clear();
  StaticBase<Dim> begin = from;
  std::vector<PairStiffness<Dim>> none;
  follow_list(state.contacts, state.counters.neighbour_builds, begin, none);
  set_trial(model, unknowns, begin, q, state.bodies, state.contacts, state.supports, state.ledger, state.time_step);
  find_forces(model, settings, state);
  Eigen::VectorXd r(unknowns.free.size());
  for (std::size_t i = 0; i < unknowns.count(); ++i) {
    r.segment<Dim>(F * i) = state.loads.total[unknowns.bodies[i]].force;
    r.segment<S>(F * i + Dim) = state.loads.total[unknowns.bodies[i]].moment;
  }
  return r.cwiseProduct(unknowns.free);
}

template <int Dim>
void Twin<Dim>::begin_increment(const Schedule& schedule) {
  residual(schedule, base, Eigen::VectorXd::Zero(unknowns.free.size()));
  State<Dim>& state = progress.state;
  std::vector<PairStiffness<Dim>> closed;
  follow_list(state.contacts, state.counters.neighbour_builds, base, closed);
  find_closed_joints(model, settings, state.bodies, state.contacts, base.histories, state.counters, closed);
}

template <int Dim>
BlockMatrix<freedoms<Dim>> Twin<Dim>::tangent(const StaticBase<Dim>& from) {
  State<Dim>& state = progress.state;
  StaticBase<Dim>& begin = state.increment.base;  // which the pairs of linings read
  begin = from;
  std::vector<PairStiffness<Dim>> none, stiffness;
  follow_list(state.contacts, state.counters.neighbour_builds, begin, none);
  const BodiesOfStep<Dim> bodies(unknowns, {});
  find_pair_stiffness(model, settings, state.schedule, joint_step(settings, state.time_step, state.relaxation),
                      state.bodies, state.contacts, begin.histories, bodies.place, state.counters, stiffness);
  for (const StepSupport<Dim>& row : step_supports<Dim>)
    row.add_pairs(model, settings, state, stiffness);
  std::vector<typename PairStiffness<Dim>::Block> of_water, own = load_stiffness(model, state);
  find_water_stiffness(model, settings, state.schedule, state.bodies, of_water);
  if (own.empty()) own.resize(of_water.size(), PairStiffness<Dim>::Block::Zero());
  for (std::size_t b = 0; b < of_water.size(); ++b)
    own[b] += of_water[b];
  std::vector<const PairStiffness<Dim>*> pairs;
  for (const PairStiffness<Dim>& p : stiffness)
    pairs.push_back(&p);
  BlockMatrix<freedoms<Dim>> k;
  find_tangent<Dim>(settings.threads, pairs, own, bodies.place, bodies.free, k);
  k.add_diagonal(bodies.scale.cwiseProduct(Eigen::VectorXd::Ones(bodies.free.size()) - bodies.free));
  return k;
}

template <int Dim>
Eigen::VectorXd Twin<Dim>::motion_to(const std::vector<Motion<Dim>>& motions) const {
  constexpr int F = freedoms<Dim>, S = spin_freedoms<Dim>;
  Eigen::VectorXd q(unknowns.free.size());
  for (std::size_t i = 0; i < unknowns.count(); ++i) {
    const Motion<Dim>&from = base.motions[unknowns.bodies[i]], &to = motions[unknowns.bodies[i]];
    q.segment<Dim>(F * i) = to.displacement - from.displacement;
    q.segment<S>(F * i + Dim) = turn_between<Dim>(from.rotation, to.rotation);
  }
  return q;
}

template <int Dim>
void Twin<Dim>::take_base() {
  State<Dim>& state = progress.state;
  stop(state.bodies.motions);
  cache_poses(model, settings.threads, state.bodies);
  base = base_of(state);
}

template <int Dim>
NullVectors null_vectors(const TangentFactors<Dim>& factors, const Eigen::VectorXd& scale) {
  const Eigen::VectorXd root = scale.cwiseSqrt();
  const auto inverse = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return root.cwiseProduct(factors.solve(root.cwiseProduct(x)));
  };
  const auto inverse_transposed = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return root.cwiseProduct(factors.solve_transposed(root.cwiseProduct(x)));
  };
  const auto across = [](Eigen::VectorXd x, const Eigen::VectorXd* known) -> Eigen::VectorXd {
    if (known) x -= known->dot(x) * *known;
    return x;
  };
  // the right and left directions, across those that are known, which K shortens most, and its singular value
  const auto find = [&](const Eigen::VectorXd* right, const Eigen::VectorXd* left) {
    Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(scale.size(), 1, 2);
    for (Eigen::Index i = 0; i < x.size(); i += 2)
      x[i] = -x[i];
    double value = 0;
    for (int k = 0; k < most_inverse_iterations; ++k) {
      x = across(x, right).normalized();
      const Eigen::VectorXd next = inverse(across(inverse_transposed(x), left));
      const double now = 1 / std::sqrt(across(next, right).norm());
      x = next;
      if (std::abs(now - std::exchange(value, now)) <= steady_direction * now) break;
    }
    x = across(x, right).normalized();
    return std::pair(value, x);
  };
  const auto [smallest, right] = find(nullptr, nullptr);
  const Eigen::VectorXd left = inverse_transposed(right).normalized();
  NullVectors found{.smallest = smallest, .motion = right.cwiseQuotient(root), .weight = left.cwiseQuotient(root)};
  if (scale.size() > 1) found.second = find(&right, &left).first;
  if (found.weight.dot(found.motion) < 0) found.weight = -found.weight;
  return found;
}

#define VOUSSOIR_INSTANTIATE(Dim) \
  template class Twin<Dim>;       \
  template NullVectors null_vectors<Dim>(const TangentFactors<Dim>&, const Eigen::VectorXd&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
