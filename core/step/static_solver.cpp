#include "core/step/static_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/solvers/block_solver.hpp"
#include "core/step/bodies_of_step.hpp"
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

constexpr int iteration_limit = 150;  // accepted ones of an increment before it is left to relaxation

// A step is shortened if less than this is left of the residual's work along it, 1 before it and 0 at the least energy
// (negative: the joints drive it back): to where that work, interpolated, is zero, within these bounds. It has at most
// so many lengths. None is made longer than the solution of the linear system, for slip is not taken back.
constexpr double may_drive_back = -0.5, most_shortening = 0.1, least_shortening = 0.7;
constexpr int most_lengths = 6;

// Regularisation falls with the residual of a step that was not shortened, within these bounds, or by the third if more
// than half of the work is left, since it is then regularisation that bounds the step. It rises by the last if the step
// was shortened below that fraction; else it falls by the fourth if the step was bounded by the blocks' size.
constexpr double most_fall = 0.02, least_fall = 0.5, slow_fall = 0.1, bounded_fall = 0.5, far_shortened = 0.3, rise = 4;

// A residual of which more than this is left after a step that went nearly as far as it could: contacts open and close
// alternately, and a short step (at least this regularisation) breaks the cycle.
constexpr double hardly_fallen = 0.7, short_step = 0.1;

// Accepted iterations after which an increment follows a valley, a mode softer than the joints by many powers of ten,
// such as the sway of an arch on four hinges: stiff joints resist the square of a step along it, so the residual grows
// even if the step is right. Or is left to relaxation, if its trials broke bonds. Others converge in fewer.
constexpr int valley_after = 50;

// The few bodies of most of the residual move by themselves, after the first steps of all, until no more than this
// share of its square is theirs, or for so many steps between two of all; with which regularisation they begin.
constexpr int few_after = 2, most_of_few = 6;
constexpr double left_to_few = 0.2, first_of_few = 0.1;

// With which an increment begins if the loads are balanced up to this fraction of the contact forces and of so many
// joints that touch at most one carries nothing.
constexpr double first_if_carried = 0.01, nearly_balanced = 0.1;
constexpr std::ptrdiff_t one_closed_of = 10;

// Refused steps, which break bonds, before relaxation takes over; accepted ones before the increment so far is kept.
constexpr int most_tries = 12, most_since_commit = 25;

// Closed joints without force count as stiff for this many iterations; otherwise a load would reach only one more row
// of blocks with each iteration. Also as long as the number of touching pairs grows by this factor per iteration: while
// lambda falls, a column of n blocks shortens from its ends, and its middle is compressed only at n^-2.
constexpr int closed_iterations = 6;
constexpr double still_reaching = 1.1;

// Forces in contacts that the base does not have, over all forces: they have no shear, so the increment so far is kept.
constexpr double most_in_new_contacts = 0.1;

// A residual has not grown within this factor of the largest of the last three; one in the same direction may double.
constexpr double may_rise = 1.05, may_double = 2;

// Of the residual, for the linear systems; their iterations. Whose rest is searched along them needs no more.
constexpr double linear_tolerance = 1e-3;
constexpr int linear_limit = 150;

// Of the residual: a system of which more remains after the iterations is too far from definite. Joints that only just
// touch cause it; more regularisation repairs it.
constexpr double most_unsolved = 1e-2;

// Unbalanced forces drive the softest mode, whose momentum relaxation weighs with the stiffest frequency: convergence
// is to this fraction of its criterion, or, if that cannot be reached, after this many more iterations.
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
    few_move() ? keep_others(model, moving(), state.contacts) : state.contacts.kept.clear();
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

  static double merit(const Eigen::VectorXd& residual, const Eigen::VectorXd& scale) {
    return std::sqrt(residual.dot(residual.cwiseQuotient(scale)));
  }

  BodiesOfStep<Dim> moving() const { return {unknowns, progress.few.list}; }
  bool few_move() const { return !progress.few.list.empty(); }

  // ---- linear system ------------------------------------------------------------------------------------------------

  // stiffness of the loads other than contacts, by body
  std::vector<typename PairStiffness<Dim>::Block> stiffness_of_loads() const {
    std::vector<typename PairStiffness<Dim>::Block> blocks = load_stiffness(model, state);
    if (blocks.empty()) return system.of_water;
    for (std::size_t b = 0; b < system.of_water.size(); ++b)
      blocks[b] += system.of_water[b];
    return blocks;
  }

  void find_matrix(const BodiesOfStep<Dim>& bodies, double regularisation) {
    std::vector<const PairStiffness<Dim>*> pairs;
    for (const PairStiffness<Dim>& p : system.stiffness)
      pairs.push_back(&p);
    for (const PairStiffness<Dim>& p : system.closed)
      if (!state.contacts.list[p.contact].touching()) pairs.push_back(&p);
    const Eigen::VectorXd& free = bodies.free;
    BlockMatrix<F>& k = system.work.matrix;
    find_tangent<Dim>(settings.threads, pairs, stiffness_of_loads(), bodies.place, free, k);
    // restrained directions do not move
    k.add_diagonal(regularisation * bodies.scale.cwiseProduct(free) +
                   bodies.scale.cwiseProduct(Eigen::VectorXd::Ones(free.size()) - free));
  }

  void find_stiffness() {
    find_pair_stiffness(model, settings, state.schedule, joint_step(settings, state.time_step, state.relaxation),
                        state.bodies, state.contacts, base.histories, moving().place, state.counters, system.stiffness);
    for (const StepSupport<Dim>& row : step_supports<Dim>)
      row.add_pairs(model, settings, state, system.stiffness);
    find_water_stiffness(model, settings, state.schedule, state.bodies, system.of_water);
  }

  // A step along which the residual does positive work; if the tangent gives none, more regularisation.
  Eigen::VectorXd next_step(const Eigen::VectorXd& residual_of_all) {
    const BodiesOfStep<Dim> bodies = moving();
    const Eigen::VectorXd residual = bodies.of(residual_of_all);
    const auto among_all = [&](const Eigen::VectorXd& x) { return bodies.among_all(x, unknowns.count()); };
    for (int tries = 0; tries < most_tries; ++tries) {
      find_matrix(bodies, progress.regularisation);
      const LinearAnswer answer =
          solve_blocks(system.work, bodies.upwards, residual, linear_tolerance, linear_limit, settings.threads);
      if (!few_move()) {
        ++state.counters.linear_systems;
        state.counters.linear_iterations += answer.iterations;
      }
      if (answer.residual <= most_unsolved && residual.dot(answer.x) > 0) return among_all(answer.x);
      progress.regularisation = std::max(8 * progress.regularisation, 1e-6);
    }
    return among_all(residual.cwiseQuotient(bodies.scale));
  }

  // ---- judgement ----------------------------------------------------------------------------------------------------

  // the fraction left of the residual's work along the last step: 1 before it, 0 if the step ends at the least energy
  double work_left(const Eigen::VectorXd& residual) const {
    const Eigen::VectorXd change = numbers(progress.change);
    return residual.dot(change) / numbers(progress.residual).dot(change);
  }

  bool in_valley() const { return progress.iteration >= valley_after; }
  bool refuses_growth() const { return settings.statics.refuses_growth && !in_valley() && progress.tries < most_tries; }
  bool grows(const Eigen::VectorXd& residual, double merit_now) const {
    const double largest = *std::max_element(
        progress.merits.end() - std::min<std::ptrdiff_t>(3, std::ssize(progress.merits)), progress.merits.end());
    return !(merit_now <= (work_left(residual) > 0 ? may_double : may_rise) * largest);
  }

  // whether a shorter length of the last step is evaluated
  bool shortens(const Eigen::VectorXd& residual) {
    const double left = work_left(residual);
    if (left >= may_drive_back || progress.lengths + 1 >= most_lengths) return false;
    ++progress.lengths;
    ++state.counters.static_rejections;
    const double factor =
        std::isfinite(left) ? std::clamp(1 / (1 - left), most_shortening, least_shortening) : most_shortening;
    progress.length *= factor;
    keep(factor * numbers(progress.change), progress.change);
    set_trial_at(numbers(progress.accepted) + numbers(progress.change), Trial::step);
    return true;
  }

  // `before`, `now`: merits of the bodies that move, before and after the last step
  void regularise(const Eigen::VectorXd& residual, double before, double now) {
    if (progress.length < far_shortened && progress.tries == 0)
      progress.regularisation *= rise;
    else if (progress.overshoot > 1 || progress.tries > 0)
      progress.regularisation *= bounded_fall;
    else if (progress.length >= 1)
      progress.regularisation *=
          work_left(residual) > 0.5 ? slow_fall : std::clamp(now / before, most_fall, least_fall);
    if (progress.regularisation < least_regularisation) progress.regularisation = 0;
  }

  // whether the last step went about as far as it could
  bool went_far(const Eigen::VectorXd& residual) const {
    return increment.trial == Trial::step && !in_valley() && progress.overshoot <= 1 && work_left(residual) <= 0.5;
  }
  void break_cycle() { progress.regularisation = std::max(short_step, 4 * progress.regularisation); }

  // whether the loads are nearly balanced already, and nearly all joints that are closed carry
  bool is_carried() const {
    const auto touching = std::ranges::count_if(state.contacts.list, &Contact<Dim>::touching);
    return unbalanced_ratio(model, settings.threads, state) < nearly_balanced &&
           std::ssize(system.closed) * one_closed_of < touching;
  }

  // ---- few bodies ---------------------------------------------------------------------------------------------------

  double merit_of_few(const Eigen::VectorXd& residual) const {
    const BodiesOfStep<Dim> few = moving();
    return merit(few.of(residual), few.scale);
  }

  // Chooses which bodies move in the next step: again the few that do, others, or all.
  void choose_moving(const Eigen::VectorXd& residual, double merit_of_all, bool far) {
    StepsOfFew& few = progress.few;
    if (few_move()) {
      const double before = std::exchange(few.merit, merit_of_few(residual));
      if (few.since_all < most_of_few && few.merit * few.merit > left_to_few * merit_of_all * merit_of_all) {
        if (far && few.merit > hardly_fallen * before) break_cycle();
        return;
      }
      progress.regularisation = few.regularisation;
    }
    few.list.clear();
    if (!settings.statics.refuses_growth && !in_valley() && progress.iteration >= few_after &&
        few.since_all < most_of_few)
      few.list = few_of_residual(unknowns, residual);
    if (few_move()) {
      few.merit = merit_of_few(residual);
      few.regularisation = std::exchange(progress.regularisation, first_of_few);
    } else if (few.went_far && merit_of_all > hardly_fallen * few.merit_of_all) {
      break_cycle();
    }
  }

  // ---- base ---------------------------------------------------------------------------------------------------------

  void take_base() {
    stop(state.bodies.motions);
    cache_poses(model, settings.threads, state.bodies);  // they are stopped
    base = base_of(state);
    progress.accepted.assign(static_cast<std::size_t>(unknowns.free.size()), 0);
    progress.since_commit = 0;
  }

  // the accepted trial, just evaluated, is the new base
  void commit() {
    add_work_of_increment(unknowns, base.loads, numbers(progress.accepted), state.loads.by_source, state.ledger.energy);
    take_base();
  }

  // ---- one evaluation -----------------------------------------------------------------------------------------------

  bool rests() {
    const double ratio = unbalanced_ratio(model, settings.threads, state) / settings.equilibrium.unbalanced;
    return ratio <= of_unbalanced || (!few_move() && ratio <= 0.5 && ++progress.polished > most_polishing);
  }

  void start_increment() {
    progress.iteration = progress.tries = progress.polished = progress.pairs = progress.broke = 0;
    progress.few = {};
    progress.merits.clear();
    system.closed.clear();
    find_closed_joints(model, settings, state.bodies, state.contacts, base.histories, state.counters, system.closed);
    progress.regularisation =
        !settings.statics.refuses_growth && is_carried() ? first_if_carried : first_regularisation;
    // origins of the ledger's balances, if they are new
    const EnergyFlows before = base.ledger.energy.flows;
    state.ledger.energy.kinetic = 0;
    balance(state.ledger.energy);
    base.ledger.energy = state.ledger.energy;
    base.ledger.energy.flows = before;
    base.loads = state.loads.by_source;
  }

  // at the accepted motion, for energies are summed over all contacts
  void find_all(Trial trial) {
    progress.few = {};
    set_trial_at(numbers(progress.accepted), trial);
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

  void give_up(long long Counters::*reason) {
    ++state.counters.static_fallbacks;
    ++(state.counters.*reason);
    commit();
    leave();
  }

  // A broken bond loses its force suddenly: relaxation finds the path.
  bool breaks_bonds() const {
    const long long expected = base.held_bonds + state.ledger.bonds.made - base.ledger.bonds.made;
    return expected > 0 && bonds_of(state.contacts).held() < expected;
  }

  void refuse(bool breaks) {
    ++state.counters.static_rejections;
    progress.broke = progress.broke || breaks;
    if (++progress.tries >= most_tries && breaks) return find_all(Trial::last);
    progress.regularisation = std::max(8 * progress.regularisation, 1e-6);
    step_from_accepted();
  }

  void step_from_accepted() {
    Eigen::VectorXd dq = next_step(numbers(progress.residual));
    progress.overshoot = shorten(model, unknowns, state, dq);
    progress.overshoot = std::max(progress.overshoot, shorten_in_trial(unknowns, increment, dq));
    progress.length = 1;
    progress.lengths = 0;
    keep(dq, progress.change);
    set_trial_at(numbers(progress.accepted) + dq, Trial::step);
  }

  void accept(const Eigen::VectorXd& residual, double now) {
    if (increment.trial != Trial::start) {
      keep(numbers(progress.accepted) + numbers(progress.change), progress.accepted);
      ++(few_move() ? progress.few.since_all : progress.iteration);
      ++(few_move() ? state.counters.static_iterations_of_few : state.counters.static_iterations);
    }
    const bool of_all = !few_move(), far = went_far(residual);
    if (of_all) {
      progress.few.since_all = 0;
      progress.few.merit_of_all = progress.merits.empty() ? now : progress.merits.back();
      progress.few.went_far = far;
    }
    keep(residual, progress.residual);
    progress.tries = 0;
    if (few_move())
      progress.merits.back() = now;
    else
      progress.merits.push_back(now);
    if (rests()) return of_all ? end_increment() : find_all(Trial::complete);
    if (of_all && progress.iteration >= (progress.broke ? valley_after : iteration_limit))
      return give_up(progress.broke ? &Counters::broken_bonds_fallbacks : &Counters::unconverged_fallbacks);
    choose_moving(residual, now, far);
    if (few_move()) {
      find_stiffness();
      return step_from_accepted();
    }
    if (of_all && (++progress.since_commit >= most_since_commit ||
                   has_slipped_far(model, settings.statics.slip, unknowns, increment) ||
                   fraction_in_new_contacts(state.contacts, base.histories) > most_in_new_contacts))
      commit();
    find_stiffness();
    const int reached = std::exchange(progress.pairs, static_cast<int>(system.stiffness.size()));
    const bool reached_all = progress.pairs < still_reaching * reached;
    if (progress.iteration >= closed_iterations && reached_all) system.closed.clear();
    step_from_accepted();
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
    if (trial == Trial::complete) return end_increment();
    if (trial == Trial::start) start_increment();
    const bool breaks = breaks_bonds();
    if (trial == Trial::last || (trial == Trial::start && breaks))
      return give_up(breaks || (base.held_bonds > 0 && progress.tries >= most_tries)
                         ? &Counters::broken_bonds_fallbacks
                         : &Counters::unconverged_fallbacks);
    const Eigen::VectorXd residual = residual_now();
    const double now = merit(residual, unknowns.scale);
    if (breaks || (trial == Trial::step && refuses_growth() && grows(residual, now))) return refuse(breaks);
    if (trial == Trial::step) {
      if (!refuses_growth() && shortens(residual)) return;
      if (!std::isfinite(now)) return find_all(Trial::last);
      if (few_move())
        regularise(residual, progress.few.merit, merit_of_few(residual));
      else
        regularise(residual, progress.merits.back(), now);
    }
    accept(residual, now);
  }
};

}  // namespace

bool newton_follows(const JointProperties& joint) {
  const bool falls = joint.laws.friction == FrictionLaw::softening ||
                     (joint.follows_barton_bandis() && joint.mobilises());  // beyond its peak
  return !falls && !joint.softens_cohesion() && !joint.dilates();
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

#define VOUSSOIR_INSTANTIATE(Dim)                                                                         \
  template bool newton_applies<Dim>(const Model<Dim>&);                                                   \
  template void begin_newton<Dim>(const Model<Dim>&, const Settings&, double, const std::vector<double>&, \
                                  State<Dim>&);                                                           \
  template void iterate<Dim>(const Model<Dim>&, const Settings&, State<Dim>&);                            \
  template std::string progress_of_newton<Dim>(const State<Dim>&);                                        \
  template double memory_of_newton<Dim>(const State<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
