#include "core/step/static_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/solvers/block_solver.hpp"
#include "core/step/integrate.hpp"
#include "core/step/joint_forces.hpp"
#include "core/step/loads.hpp"
#include "core/step/motion.hpp"
#include "core/step/pair_stiffness.hpp"
#include "core/step/relaxation.hpp"
#include "core/step/static_solver_base.hpp"
#include "core/step/step_length.hpp"
#include "core/step/support_table.hpp"
#include "core/step/tangent.hpp"
#include "core/step/trial_slip.hpp"
#include "core/step/water_stiffness.hpp"

namespace voussoir {
namespace {

constexpr double first_regularisation = 1, least_regularisation = 1e-9;

// Accepted iterations of an increment before it is left to relaxation.
constexpr int iteration_limit = 150;

// Accepted iterations after which an increment counts as slow. It then follows a valley: a mode softer than the joints
// by many powers of ten, such as the sway of an arch on four hinges. Stiff joints resist the square of a step along it,
// so the residual grows tenfold even if the step is right, and regularisation that avoids this leaves almost nothing of
// the step. Columns, walls and sliced rock of thousands of blocks converge in fewer.
constexpr int lingering_after = 50;

// A slow increment judges a step by the residual's work along it: the step is shortened if less of that work remains
// than this (negative: the joints drive it back); by no more than the second factor in one iteration.
constexpr double may_drive_back = -0.5, most_shortening = 0.1;

// Consecutive refused steps before one is accepted unconditionally; accepted ones before the increment so far is kept.
constexpr int most_tries = 12, most_since_commit = 25;

// Closed joints without force count as stiff for this many iterations; otherwise a load would reach only one more row
// of blocks with each iteration. Also as long as the number of touching pairs grows by this factor per iteration: while
// lambda falls, a column of n blocks shortens from its ends, and its middle is compressed only at n^-2.
constexpr int closed_iterations = 6;
constexpr double still_reaching = 1.1;

// Forces in contacts that the base does not have, over all forces: they have no shear, so the increment so far is kept.
constexpr double most_in_new_contacts = 0.1;

// A residual counts as not larger within this factor of the largest of the last three; one in the same direction may
// double.
constexpr double may_rise = 1.05, may_double = 2;

// After a refused step regularisation is reduced slowly: lambda falls by at most this factor.
constexpr double after_refusal = 0.5;

// Of the residual, for the linear systems; their iterations. The remaining error in the softest directions moves joints
// with almost no force: at 1e-3 they open and close alternately, and a wall of 1,000 bricks takes three times the
// evaluations.
constexpr double linear_tolerance = 1e-6;
constexpr int linear_limit = 200;

// Of the residual: a system of which more remains after the iterations is too far from definite. Joints that only just
// touch cause it; more regularisation repairs it.
constexpr double most_unsolved = 1e-3;

// Unbalanced forces drive the softest mode, whose momentum relaxation weighs with the stiffest frequency: convergence
// is to this fraction of the criterion that relaxation must confirm, or, if that cannot be reached, after this many
// more iterations.
constexpr double of_unbalanced = 1e-3;
constexpr int most_polishing = 4;

template <int Dim>
struct Newton {
  static constexpr int F = freedoms<Dim>, S = spin_freedoms<Dim>;
  using Trial = typename StaticIncrement<Dim>::Trial;

  const Model<Dim>& model;
  const Settings& settings;
  State<Dim>& state;
  StaticIncrement<Dim>& increment;
  StaticBase<Dim>& base;
  StaticProgress& progress;
  StaticSystem<Dim>& system;
  Unknowns<Dim> unknowns;

  Newton(const Model<Dim>& m, const Settings& s, State<Dim>& now)
      : model(m),
        settings(s),
        state(now),
        increment(now.increment),
        base(increment.base),
        progress(increment.progress),
        system(increment.system),
        unknowns(m) {}

  Eigen::VectorXd numbers(const std::vector<double>& list) const {
    return Eigen::Map<const Eigen::VectorXd>(list.data(), static_cast<Eigen::Index>(list.size()));
  }
  static void keep(const Eigen::VectorXd& x, std::vector<double>& list) { list.assign(x.data(), x.data() + x.size()); }

  void set_trial_at(const Eigen::VectorXd& q, Trial trial) {
    increment.trial = trial;
    set_trial(model, unknowns, base, q, state.bodies, state.contacts, state.supports, state.ledger, state.time_step);
  }

  Eigen::VectorXd residual_now() const {
    Eigen::VectorXd r(unknowns.free.size());
    for (std::size_t i = 0; i < unknowns.count(); ++i) {
      r.segment<Dim>(F * i) = state.loads.total[unknowns.bodies[i]].force;
      r.segment<S>(F * i + Dim) = state.loads.total[unknowns.bodies[i]].moment;
    }
    return r.cwiseProduct(unknowns.free);
  }

  double merit(const Eigen::VectorXd& residual) const {
    return std::sqrt(residual.dot(residual.cwiseQuotient(unknowns.scale)));
  }

  // ---- linear system ------------------------------------------------------------------------------------------------

  // stiffness of the loads other than contacts, by body
  std::vector<typename PairStiffness<Dim>::Block> stiffness_of_loads() const {
    std::vector<typename PairStiffness<Dim>::Block> blocks = load_stiffness(model, state);
    if (blocks.empty()) return system.of_water;
    for (std::size_t b = 0; b < system.of_water.size(); ++b)
      blocks[b] += system.of_water[b];
    return blocks;
  }

  BlockMatrix<F> tangent(double regularisation) const {
    std::vector<const PairStiffness<Dim>*> pairs;
    for (const PairStiffness<Dim>& p : system.stiffness)
      pairs.push_back(&p);
    for (const PairStiffness<Dim>& p : system.closed)
      if (!state.contacts.list[p.contact].touching()) pairs.push_back(&p);
    const Eigen::VectorXd& free = unknowns.free;
    BlockMatrix<F> k = tangent_of<Dim>(settings.threads, pairs, stiffness_of_loads(), unknowns.place, free);
    // restrained directions do not move
    k.add_diagonal(regularisation * unknowns.scale.cwiseProduct(free) +
                   unknowns.scale.cwiseProduct(Eigen::VectorXd::Ones(free.size()) - free));
    return k;
  }

  void find_stiffness() {
    std::vector<PairStiffness<Dim>> pairs;
    find_pair_stiffness(model, settings, state.schedule, joint_step(settings, state.time_step, state.relaxation),
                        state.bodies, state.contacts, base.histories, state.counters, pairs);
    for (const StepSupport<Dim>& row : step_supports<Dim>)
      row.add_pairs(model, settings, state, pairs);
    system.stiffness = std::move(pairs);
    find_water_stiffness(model, settings, state.schedule, state.bodies, system.of_water);
  }

  // A step along which the residual does positive work; if the tangent gives none, more regularisation.
  Eigen::VectorXd next_step(const Eigen::VectorXd& residual) {
    for (int tries = 0; tries < most_tries; ++tries) {
      const LinearAnswer answer = solve_blocks(tangent(progress.regularisation), unknowns.upwards, residual,
                                               linear_tolerance, linear_limit, settings.threads);
      state.counters.linear_iterations += answer.iterations;
      if (answer.residual <= most_unsolved && residual.dot(answer.x) > 0) return answer.x;
      progress.regularisation = std::max(8 * progress.regularisation, 1e-6);
    }
    return residual.cwiseQuotient(unknowns.scale);
  }

  // ---- judgement ----------------------------------------------------------------------------------------------------

  // the fraction left of the residual's work along the last step: 1 before it, 0 if the step ends at the least energy
  double work_left(const Eigen::VectorXd& residual) const {
    const Eigen::VectorXd change = numbers(progress.change);
    return residual.dot(change) / numbers(progress.residual).dot(change);
  }

  bool lingers() const { return progress.iteration >= lingering_after; }

  bool is_acceptable(const Eigen::VectorXd& residual, double now) {
    if (lingers()) return is_acceptable_lingering(residual, now);
    const double largest = *std::max_element(
        progress.merits.end() - std::min<std::ptrdiff_t>(3, std::ssize(progress.merits)), progress.merits.end());
    const double left = work_left(residual);
    if (!std::isfinite(now) || !(now <= may_rise * largest || (left > 0 && now <= may_double * largest))) return false;
    // the faster the residual falls, the less is needed
    const double last = progress.merits.back();
    progress.flat = progress.overshoot <= 1 && left <= 0.5 && now > 0.7 * last ? progress.flat + 1 : 0;
    const double fall = progress.overshoot > 1 ? 0.5 : left > 0.5 ? 0.1 : std::clamp(now / last, 0.02, 0.5);
    progress.regularisation *= progress.tries > 0 ? std::max(fall, after_refusal) : fall;
    if (progress.regularisation < least_regularisation) progress.regularisation = 0;
    // contacts that open and close alternately: a short step breaks the cycle
    if (progress.flat > 0) {
      progress.regularisation = std::max(0.1, 4 * progress.regularisation);
      progress.flat = 0;
    }
    return true;
  }

  bool is_acceptable_lingering(const Eigen::VectorXd& residual, double now) {
    if (!std::isfinite(now) || !(work_left(residual) >= may_drive_back)) return false;
    if (progress.tries == 0) progress.regularisation *= progress.overshoot > 1 ? 0.5 : 0.1;
    if (progress.tries > 1)
      progress.regularisation = std::max(8 * progress.regularisation, 1e-6);  // a kink: a shorter step is better
    if (progress.regularisation < least_regularisation) progress.regularisation = 0;
    return true;
  }

  double fraction_in_new_contacts() const {
    double all = 0, of_new = 0;
    for (std::size_t i = 0; i < state.contacts.list.size(); ++i) {
      if (!state.contacts.list[i].touching()) continue;
      const double force = state.contacts.list[i].force.norm();
      all += force;
      if (base.histories.contacts[i].history.normal.isZero(0)) of_new += force;
    }
    return all > 0 ? of_new / all : 0;
  }

  // ---- work ---------------------------------------------------------------------------------------------------------

  // Of the loads over the increment so far, by the mean of those at its ends: exact for linear loads. All of it counts
  // as removed, as under relaxation.
  void add_work() {
    const Eigen::VectorXd q = numbers(progress.accepted);
    for (std::size_t i = 0; i < load_count; ++i) {
      const std::vector<Load<Dim>>&then = base.loads.values[i], &now = state.loads.by_source.values[i];
      double work = 0;
      for (std::size_t k = 0; k < unknowns.count(); ++k) {
        const auto along = [&](const Load<Dim>& l) {
          return l.force.dot(q.segment<Dim>(F * k)) + l.moment.dot(q.segment<S>(F * k + Dim));
        };
        const auto b = static_cast<std::size_t>(unknowns.bodies[k]);
        work += 0.5 * ((b < then.size() ? along(then[b]) : 0) + (b < now.size() ? along(now[b]) : 0));
      }
      state.ledger.energy.flows.values[i] += source_table[i].motion * work;
      state.ledger.energy.flows[Source::relaxation] += work;
    }
    state.ledger.energy.kinetic = 0;
    balance(state.ledger.energy);
  }

  void take_base() {
    stop(state.bodies.motions);
    cache_poses(model, settings.threads, state.bodies);  // they are stopped
    base = base_of(state);
    progress.accepted.assign(static_cast<std::size_t>(unknowns.free.size()), 0);
    progress.since_commit = 0;
  }

  // the accepted trial, just evaluated, is the new base
  void commit() {
    add_work();
    take_base();
  }

  // ---- one evaluation -----------------------------------------------------------------------------------------------

  bool rests() {
    const double ratio = unbalanced_ratio(model, settings.threads, state) / settings.equilibrium.unbalanced;
    return ratio <= of_unbalanced || (ratio <= 0.5 && ++progress.polished > most_polishing);
  }

  void start_increment() {
    progress.iteration = progress.tries = progress.flat = progress.polished = 0;
    progress.regularisation = first_regularisation;
    progress.merits.clear();
    system.closed.clear();
    find_closed_joints(model, settings, state.bodies, state.contacts, base.histories, state.counters, system.closed);
    // origins of the ledger's balances, if they are new
    const EnergyFlows before = base.ledger.energy.flows;
    state.ledger.energy.kinetic = 0;
    balance(state.ledger.energy);
    base.ledger.energy = state.ledger.energy;
    base.ledger.energy.flows = before;
    base.loads = state.loads.by_source;
  }

  void end_increment() {
    commit();
    if (increment.increments_left == 0) return leave();
    --increment.increments_left;
    state.schedule.time =
        increment.increments_left == 0 ? increment.ends : state.schedule.time + increment.increment_time;
    set_trial_at(numbers(progress.accepted), Trial::start);
  }

  // relaxation continues from the base
  void leave() { begin_relaxation(state); }

  void give_up() {
    ++state.counters.static_fallbacks;
    commit();
    leave();
  }

  // A broken bond loses its force suddenly: relaxation finds the path.
  bool breaks_bonds() const {
    const long long expected = base.held_bonds + state.ledger.bonds.made - base.ledger.bonds.made;
    return expected > 0 && bonds_of(state.contacts).held() < expected;
  }

  // Back on the step to the point where its work, interpolated between both ends, is zero.
  void shorten_lingering(const Eigen::VectorXd& residual) {
    const double left = work_left(residual), factor = std::isfinite(left) ? 1 / (1 - left) : 0;
    keep(std::clamp(factor, most_shortening, 0.5) * numbers(progress.change), progress.change);
    set_trial_at(numbers(progress.accepted) + numbers(progress.change),
                 progress.tries >= most_tries ? Trial::forced : Trial::step);
  }

  void reject(const Eigen::VectorXd& residual, bool breaks) {
    ++state.counters.static_rejections;
    ++progress.tries;
    if (lingers() && !breaks) return shorten_lingering(residual);
    progress.regularisation = std::max(8 * progress.regularisation, 1e-6);
    const bool forced = progress.tries >= most_tries;
    if (forced && breaks) return set_trial_at(numbers(progress.accepted), Trial::last);
    if (forced) progress.regularisation = first_regularisation;
    step_from_accepted(forced ? Trial::forced : Trial::step);
  }

  void step_from_accepted(Trial trial) {
    Eigen::VectorXd dq = next_step(numbers(progress.residual));
    progress.overshoot = shorten(model, unknowns, state, dq);
    progress.overshoot = std::max(progress.overshoot, shorten_in_trial(unknowns, increment, dq));
    keep(dq, progress.change);
    set_trial_at(numbers(progress.accepted) + dq, trial);
  }

  void accept(const Eigen::VectorXd& residual, double now, bool forced) {
    if (increment.trial != Trial::start) {
      keep(numbers(progress.accepted) + numbers(progress.change), progress.accepted);
      ++progress.iteration;
      ++state.counters.static_iterations;
    }
    keep(residual, progress.residual);
    progress.merits.push_back(now);
    progress.tries = 0;
    if (rests()) return end_increment();
    if (progress.iteration >= iteration_limit) return give_up();
    if (forced || ++progress.since_commit >= most_since_commit ||
        has_slipped_far(model, settings.statics.slip, unknowns, increment) ||
        fraction_in_new_contacts() > most_in_new_contacts)
      commit();
    const double reached = static_cast<double>(system.stiffness.size());
    find_stiffness();
    const bool reached_all = static_cast<double>(system.stiffness.size()) < still_reaching * reached;
    if (progress.iteration >= closed_iterations && reached_all) system.closed.clear();
    step_from_accepted(Trial::step);
  }

  void iterate() {
    follow_list(state.contacts, state.counters.neighbour_builds, base, system.closed);
    if (increment.trial == Trial::waiting) {
      state.schedule.time += increment.increment_time;
      return set_trial_at(numbers(progress.accepted), Trial::start);
    }
    const EnergyFlows before = state.ledger.energy.flows;
    add_ramps(model, settings, state.bodies, state.loads, state.schedule, state.ledger.energy, state.relaxation);
    for (const Source ramp : {Source::gravity_ramp, Source::water_change})
      base.ledger.energy.flows[ramp] += state.ledger.energy.flows[ramp] - before[ramp];
    const Trial trial = increment.trial;
    if (trial == Trial::start) start_increment();
    const bool breaks = breaks_bonds();
    if (trial == Trial::last || (trial == Trial::start && breaks)) return give_up();
    const Eigen::VectorXd residual = residual_now();
    const double now = merit(residual);
    if (breaks || (trial == Trial::step && !is_acceptable(residual, now))) return reject(residual, breaks);
    accept(residual, now, trial == Trial::forced);
  }
};

}  // namespace

bool newton_follows(const JointProperties& joint) {
  return joint.laws.friction != FrictionLaw::softening && !joint.softens_cohesion();
}

template <int Dim>
bool newton_applies(const Model<Dim>& model) {
  return model.prescribed.empty() && std::all_of(model.properties.begin(), model.properties.end(), newton_follows);
}

template <int Dim>
void begin_newton(const Model<Dim>& model, const Settings& settings, double ramp, const std::vector<double>& elastic,
                  State<Dim>& state) {
  state.increment = {};
  StaticIncrement<Dim>& n = state.increment;
  n.under_way = true;
  n.elastic = elastic;
  if (!elastic.empty()) n.began = displacements(state.bodies);
  Newton<Dim>(model, settings, state).take_base();
  if (!(ramp > 0)) return;
  n.trial = StaticIncrement<Dim>::Trial::waiting;
  n.increments_left = settings.statics.increments - 1;
  n.increment_time = ramp / settings.statics.increments;
  n.ends = state.schedule.time + ramp;
}

template <int Dim>
void iterate(const Model<Dim>& model, const Settings& settings, State<Dim>& state) {
  Newton<Dim>(model, settings, state).iterate();
}

template <int Dim>
std::string progress_of_newton(const State<Dim>& state) {
  const StaticProgress& n = state.increment.progress;
  if (!state.increment.under_way || n.merits.empty()) return {};
  return fmt::format("Newton iteration {}, residual {:.1e} of the first, lambda {:.1e}", n.iteration,
                     n.merits.front() > 0 ? n.merits.back() / n.merits.front() : 0, n.regularisation);
}

template <int Dim>
double memory_of_newton(const State<Dim>& state) {
  // of the linear system, its lists and factors, which are complete in 2-D: measured with 20,000 blocks
  constexpr double blocks_of_a_pair = Dim == 2 ? 60 : 10;
  using Pair = PairStiffness<Dim>;
  return static_cast<double>(state.contacts.list.size()) *
             (sizeof(ContactHistory<Dim>) + sizeof(Pair) + blocks_of_a_pair * sizeof(typename Pair::Block)) +
         static_cast<double>(state.contacts.subs.size() * sizeof(JointState<Dim>) +
                             state.contacts.rises.size() * sizeof(JointRise<Dim>));
}

template <int Dim>
std::vector<Placement<Dim>> accepted_placements(const Model<Dim>& model, const StaticIncrement<Dim>& increment) {
  std::vector<Placement<Dim>> placed;
  const double* q = increment.progress.accepted.data();  // of the free bodies, in order
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    placed.push_back({increment.base.motions[b].displacement, increment.base.motions[b].rotation});
    if (model.bodies[b].fixed || !model.bodies[b].present) continue;
    placed.back().displacement += Eigen::Map<const Vector<Dim>>(q);
    placed.back().rotation = turned(placed.back().rotation, Spin<Dim>(Eigen::Map<const Spin<Dim>>(q + Dim)));
    q += freedoms<Dim>;
  }
  return placed;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                         \
  template bool newton_applies<Dim>(const Model<Dim>&);                                                   \
  template void begin_newton<Dim>(const Model<Dim>&, const Settings&, double, const std::vector<double>&, \
                                  State<Dim>&);                                                           \
  template void iterate<Dim>(const Model<Dim>&, const Settings&, State<Dim>&);                            \
  template std::string progress_of_newton<Dim>(const State<Dim>&);                                        \
  template double memory_of_newton<Dim>(const State<Dim>&);                                               \
  template std::vector<Placement<Dim>> accepted_placements<Dim>(const Model<Dim>&, const StaticIncrement<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
