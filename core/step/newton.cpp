#include "core/step/newton.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/motion/integrate.hpp"
#include "core/motion/relaxation.hpp"
#include "core/step/motion.hpp"
#include "core/step/pair_stiffness.hpp"
#include "core/step/tangent.hpp"
#include "core/step/water_stiffness.hpp"

namespace voussoir {
namespace {

constexpr double first_regularisation = 1, least_regularisation = 1e-9;

// The longest step of neighbours against each other, of the smaller one's inscribed radius: beyond it contacts have
// another geometry.
constexpr double longest_step = 0.02;

// Accepted iterations of an increment until it is left to relaxation.
constexpr int iteration_limit = 150;

// Refused steps in a row until one is taken as it comes; accepted ones until the increment so far is kept.
constexpr int most_tries = 12, most_since_commit = 25;

// Joints that are closed but carry nothing count as stiff for so many iterations; without, a load would reach one more
// row of blocks with each.
constexpr int closed_iterations = 6;

// Forces in contacts that the base does not know, over all: they have no shear, so the increment so far is kept.
constexpr double most_in_new_contacts = 0.1;

// A residual counts as no larger within this factor of the largest of the last three; one that drives on the same way
// may double.
constexpr double may_rise = 1.05, may_double = 2;

// of the residual, for the linear systems; their iterations
constexpr double linear_tolerance = 1e-3;
constexpr int linear_limit = 400;

// What is left out of balance drives the softest motion, whose momentum relaxation weighs with the stiffest frequency:
// rest is left with this fraction of what relaxation must confirm, or, where no more can be had of it, after so many
// more iterations.
constexpr double of_unbalanced = 1e-3;
constexpr int most_polishing = 4;

// more than so many free bodies: a few loose ones do not hold back the others
constexpr std::size_t many = 100;
constexpr std::ptrdiff_t one_loose_of = 50;

template <int Dim>
struct Newton {
  static constexpr int F = freedoms<Dim>, S = spin_freedoms<Dim>;
  using Increment = NewtonIncrement<Dim>;
  using Trial = typename Increment::Trial;

  const Model<Dim>& model;
  const Settings& settings;
  State<Dim>& state;
  Increment& n;
  std::vector<int> bodies, place;  // the free ones; by body: among them, or -1
  Eigen::VectorXd scale, free;     // by freedom: D, N/m and N m; 1, or 0 where it is held

  Newton(const Model<Dim>& m, const Settings& s, State<Dim>& now)
      : model(m), settings(s), state(now), n(now.newton), place(m.bodies.size(), -1) {
    for (std::size_t b = 0; b < model.bodies.size(); ++b)
      if (!model.bodies[b].fixed && model.bodies[b].present) {
        place[b] = static_cast<int>(bodies.size());
        bodies.push_back(static_cast<int>(b));
      }
    double stiffest = 0;
    for (const JointProperties& p : model.properties)
      stiffest = std::max(stiffest, p.normal_stiffness);
    scale.resize(F * bodies.size());
    free.resize(F * bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const Body<Dim>& body = model.bodies[bodies[i]];
      double face = 0;
      for (const Polytope<Dim>& part : body.parts)
        face = std::max(face, part.largest_face);
      for (int f = 0; f < F; ++f) {
        // a body that turns about its middle: a third of the square of its radius
        scale[F * i + f] = stiffest * face * (f < Dim ? 1 : body.radius * body.radius / 3);
        free[F * i + f] = f < Dim ? body.free_translation[f] : body.free_rotation[f - Dim];
      }
    }
  }

  Eigen::VectorXd numbers(const std::vector<double>& list) const {
    return Eigen::Map<const Eigen::VectorXd>(list.data(), static_cast<Eigen::Index>(list.size()));
  }
  static void keep(const Eigen::VectorXd& x, std::vector<double>& list) { list.assign(x.data(), x.data() + x.size()); }

  // ---- base and trial -----------------------------------------------------------------------------------------------

  std::size_t stride() const { return state.contacts.empty() ? 0 : state.subs.size() / state.contacts.size(); }

  // the state as it stands, its histories included, becomes the base
  void take_base() {
    for (Motion<Dim>& m : state.motions) {
      m.velocity.setZero();
      m.angular_momentum.setZero();
    }
    n.base = state.motions;
    n.histories.clear();
    for (const Contact<Dim>& c : state.contacts)
      n.histories.push_back({c.part_a, c.part_b, c.divided_face, c.history});
    n.sub_histories.clear();
    for (const SubContact<Dim>& s : state.subs)
      n.sub_histories.push_back(s.history);
    n.listed = state.counters.neighbour_builds;
    n.energy = state.energy;
    n.accepted.assign(F * bodies.size(), 0);
    n.since_commit = 0;
    cache_poses(model, settings.threads, state);  // they stand still
  }

  // the base's histories in the order of the contacts, which may have been listed again: both in ascending order
  void follow_list() {
    if (n.listed == state.counters.neighbour_builds) return;
    n.listed = state.counters.neighbour_builds;
    const std::vector<BaseHistory<Dim>> old = std::move(n.histories);
    const std::vector<JointState<Dim>> old_subs = std::move(n.sub_histories);
    const std::size_t cells = old.empty() ? 0 : old_subs.size() / old.size();
    n.histories.assign(state.contacts.size(), {});
    n.sub_histories.assign(state.subs.size(), {});
    std::map<int, int> moved;  // places of contacts, old to new
    std::size_t from = 0;
    for (std::size_t i = 0; i < state.contacts.size(); ++i) {
      const std::pair key(state.contacts[i].part_a, state.contacts[i].part_b);
      n.histories[i].part_a = key.first;
      n.histories[i].part_b = key.second;
      while (from < old.size() && std::pair(old[from].part_a, old[from].part_b) < key)
        ++from;
      if (from == old.size() || std::pair(old[from].part_a, old[from].part_b) != key) continue;
      n.histories[i] = old[from];
      for (std::size_t k = 0; k < std::min(cells, stride()); ++k)
        n.sub_histories[i * stride() + k] = old_subs[from * cells + k];
      moved[static_cast<int>(from)] = static_cast<int>(i);
    }
    std::vector<PairStiffness<Dim>> closed;
    for (PairStiffness<Dim>& c : n.closed)
      if (const auto to = moved.find(c.contact); to != moved.end()) {
        c.contact = to->second;
        closed.push_back(c);
      }
    n.closed = std::move(closed);
  }

  // bodies at base + q, histories those of the base: ready to be evaluated
  void set_trial(const Eigen::VectorXd& q, Trial trial) {
    n.trial = trial;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const int b = bodies[i];
      Motion<Dim>& m = state.motions[b];
      const Vector<Dim> way = q.segment<Dim>(F * i);
      const Spin<Dim> turn = q.segment<S>(F * i + Dim);
      m.displacement = n.base[b].displacement + way;
      m.rotation = turned(n.base[b].rotation, turn);
      m.velocity = way;  // per time step of one
      m.angular_momentum = angular_momentum(model.bodies[b], m.rotation, turn);
    }
    for (std::size_t i = 0; i < n.histories.size(); ++i) {
      state.contacts[i].history = n.histories[i].history;
      state.contacts[i].divided_face = n.histories[i].divided_face;
    }
    for (std::size_t i = 0; i < n.sub_histories.size(); ++i)
      state.subs[i].history = n.sub_histories[i];
    state.energy = n.energy;
    state.time_step = 1;
  }

  Eigen::VectorXd residual_now() const {
    Eigen::VectorXd r(F * bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      r.segment<Dim>(F * i) = state.loads[bodies[i]].force;
      r.segment<S>(F * i + Dim) = state.loads[bodies[i]].moment;
    }
    return r.cwiseProduct(free);
  }

  double merit(const Eigen::VectorXd& residual) const { return std::sqrt(residual.dot(residual.cwiseQuotient(scale))); }

  // ---- linear system ------------------------------------------------------------------------------------------------

  BlockMatrix<F> tangent(double regularisation) const {
    std::vector<const PairStiffness<Dim>*> pairs;
    for (const PairStiffness<Dim>& p : n.stiffness)
      pairs.push_back(&p);
    for (const PairStiffness<Dim>& p : n.closed)
      if (!state.contacts[p.contact].touching()) pairs.push_back(&p);
    BlockMatrix<F> k = tangent_of<Dim>(settings.threads, pairs, n.of_water, place, free);
    // what is held goes nowhere
    k.add_diagonal(regularisation * scale.cwiseProduct(free) +
                   scale.cwiseProduct(Eigen::VectorXd::Ones(free.size()) - free));
    return k;
  }

  // A step along which the residual drives; where the tangent gives none, more regularisation.
  Eigen::VectorXd next_step(const Eigen::VectorXd& residual) {
    for (int tries = 0; tries < most_tries; ++tries) {
      const LinearAnswer answer =
          solve_blocks(tangent(n.regularisation), residual, linear_tolerance, linear_limit, settings.threads);
      state.counters.linear_iterations += answer.iterations;
      if (std::isfinite(answer.residual) && residual.dot(answer.x) > 0) return answer.x;
      n.regularisation = std::max(8 * n.regularisation, 1e-6);
    }
    return residual.cwiseQuotient(scale);
  }

  // ---- length of a step ---------------------------------------------------------------------------------------------

  Vector<Dim> way_of(const Eigen::VectorXd& dq, int at) const {
    return at < 0 ? Vector<Dim>(Vector<Dim>::Zero()) : Vector<Dim>(dq.segment<Dim>(F * at));
  }
  double turning_way(const Eigen::VectorXd& dq, std::size_t i) const {
    return model.bodies[bodies[i]].radius * dq.segment<S>(F * i + Dim).norm();
  }

  // Over what it may be: of a body against its neighbours, since a column may sink by far more than its blocks are
  // wide; of one without neighbours, by itself.
  std::vector<double> excess_by_body(const Eigen::VectorXd& dq) const {
    std::vector<double> excess(bodies.size(), 0);
    std::vector<char> alone(bodies.size(), 1);
    for (const Contact<Dim>& c : state.contacts) {
      if (c.status == ContactStatus::apart) continue;
      const int ba = model.parts[c.part_a].body, bb = model.parts[c.part_b].body, a = place[ba], b = place[bb];
      if (a < 0 && b < 0) continue;
      const double size = a < 0   ? model.bodies[bb].size
                          : b < 0 ? model.bodies[ba].size
                                  : std::min(model.bodies[ba].size, model.bodies[bb].size);
      const double over = (way_of(dq, b) - way_of(dq, a)).norm() / (longest_step * size);
      const int mover = way_of(dq, a).norm() > way_of(dq, b).norm() ? a : b;
      if (mover >= 0) excess[mover] = std::max(excess[mover], over);
      if (a >= 0) alone[a] = 0;
      if (b >= 0) alone[b] = 0;
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const double own = turning_way(dq, i) + (alone[i] ? way_of(dq, static_cast<int>(i)).norm() : 0);
      excess[i] = std::max(excess[i], own / (longest_step * model.bodies[bodies[i]].size));
    }
    return excess;
  }

  // Shortened to the longest step; where few of many bodies are loose, they alone are.
  void shorten(Eigen::VectorXd& dq) {
    std::vector<double> excess = excess_by_body(dq);
    const auto loose = std::count_if(excess.begin(), excess.end(), [](double over) { return over > 1; });
    if (loose > 0 && bodies.size() >= many && loose * one_loose_of <= static_cast<std::ptrdiff_t>(bodies.size())) {
      for (std::size_t i = 0; i < bodies.size(); ++i)
        if (excess[i] > 1) dq.segment<F>(F * i) /= excess[i];
      excess = excess_by_body(dq);
    }
    n.overshoot = excess.empty() ? 0 : *std::max_element(excess.begin(), excess.end());
    if (n.overshoot > 1) dq /= n.overshoot;
  }

  // ---- judgement ----------------------------------------------------------------------------------------------------

  bool is_acceptable(const Eigen::VectorXd& residual, double now) {
    const double largest =
        *std::max_element(n.merits.end() - std::min<std::ptrdiff_t>(3, std::ssize(n.merits)), n.merits.end());
    const Eigen::VectorXd change = numbers(n.change);
    const double before = numbers(n.residual).dot(change), left = residual.dot(change) / before;
    if (!std::isfinite(now) || !(now <= may_rise * largest || (left > 0 && now <= may_double * largest))) return false;
    // the better the residual falls, the less is needed
    const double last = n.merits.back();
    n.flat = n.overshoot <= 1 && left <= 0.5 && now > 0.7 * last ? n.flat + 1 : 0;
    n.regularisation *= n.overshoot > 1 ? 0.5 : left > 0.5 ? 0.1 : std::clamp(now / last, 0.02, 0.5);
    if (n.regularisation < least_regularisation) n.regularisation = 0;
    // contacts that open and close in turn: a short step breaks the ring
    if (n.flat > 0) {
      n.regularisation = std::max(0.1, 4 * n.regularisation);
      n.flat = 0;
    }
    return true;
  }

  double fraction_in_new_contacts() const {
    double all = 0, of_new = 0;
    for (std::size_t i = 0; i < state.contacts.size(); ++i) {
      if (!state.contacts[i].touching()) continue;
      const double force = state.contacts[i].force.norm();
      all += force;
      if (n.histories[i].history.normal.isZero(0)) of_new += force;
    }
    return all > 0 ? of_new / all : 0;
  }

  // ---- work ---------------------------------------------------------------------------------------------------------

  // Of the loads over the increment so far, by the mean of those at its ends: exact for what is linear. All of it
  // counts as taken out, as under relaxation.
  void add_work() {
    const Eigen::VectorXd q = numbers(n.accepted);
    for (std::size_t i = 0; i < load_count; ++i) {
      const std::vector<Load<Dim>>&then = n.loads_begin.values[i], &now = state.loads_of.values[i];
      double work = 0;
      for (std::size_t k = 0; k < bodies.size(); ++k) {
        const auto along = [&](const Load<Dim>& l) {
          return l.force.dot(q.segment<Dim>(F * k)) + l.moment.dot(q.segment<S>(F * k + Dim));
        };
        const auto b = static_cast<std::size_t>(bodies[k]);
        work += 0.5 * ((b < then.size() ? along(then[b]) : 0) + (b < now.size() ? along(now[b]) : 0));
      }
      state.energy.flows.values[i] += source_table[i].motion * work;
      state.energy.flows[Source::relaxation] += work;
    }
    state.energy.kinetic = 0;
    balance(state.energy);
  }

  // what the accepted trial, which has just been evaluated, has come to is the new base
  void commit() {
    add_work();
    take_base();
    n.loads_begin = state.loads_of;
  }

  // ---- one evaluation -----------------------------------------------------------------------------------------------

  bool rests() {
    const double ratio = unbalanced_ratio(model, settings.threads, state) / settings.equilibrium.unbalanced;
    return ratio <= of_unbalanced || (ratio <= 0.5 && ++n.polished > most_polishing);
  }

  void start_increment() {
    n.iteration = n.tries = n.flat = n.polished = 0;
    n.regularisation = first_regularisation;
    n.merits.clear();
    n.closed.clear();
    find_closed_joints(model, settings, state);
    // origins of the ledger's balances, where they are new
    const EnergyFlows before = n.energy.flows;
    state.energy.kinetic = 0;
    balance(state.energy);
    n.energy = state.energy;
    n.energy.flows = before;
    n.loads_begin = state.loads_of;
  }

  void end_increment() {
    commit();
    if (n.increments_left == 0) return leave();
    --n.increments_left;
    state.time = n.increments_left == 0 ? n.ends : state.time + n.increment_time;
    set_trial(numbers(n.accepted), Trial::start);
  }

  // relaxation goes on from the base
  void leave() { begin_relaxation(state); }

  void reject() {
    ++state.counters.static_rejections;
    ++n.tries;
    n.regularisation = std::max(8 * n.regularisation, 1e-6);
    const bool forced = n.tries >= most_tries;
    if (forced) n.regularisation = first_regularisation;
    step_from_accepted(forced ? Trial::forced : Trial::step);
  }

  void step_from_accepted(Trial trial) {
    const Eigen::VectorXd residual = numbers(n.residual);
    Eigen::VectorXd dq = next_step(residual);
    shorten(dq);
    keep(dq, n.change);
    set_trial(numbers(n.accepted) + dq, trial);
  }

  void accept(const Eigen::VectorXd& residual, double now, bool forced) {
    if (n.trial != Trial::start) {
      keep(numbers(n.accepted) + numbers(n.change), n.accepted);
      ++n.iteration;
      ++state.counters.static_iterations;
    }
    keep(residual, n.residual);
    n.merits.push_back(now);
    n.tries = 0;
    if (rests()) return end_increment();
    if (n.iteration >= iteration_limit) {
      ++state.counters.static_fallbacks;
      commit();
      return leave();
    }
    if (n.iteration >= closed_iterations) n.closed.clear();
    if (forced || ++n.since_commit >= most_since_commit || fraction_in_new_contacts() > most_in_new_contacts) commit();
    find_pair_stiffness(model, settings, state);
    find_water_stiffness(model, settings, state);
    step_from_accepted(Trial::step);
  }

  void iterate() {
    follow_list();
    if (n.trial == Trial::waiting) {
      state.time += n.increment_time;
      return set_trial(numbers(n.accepted), Trial::start);
    }
    const EnergyFlows before = state.energy.flows;
    add_ramps(model, settings, state);
    for (const Source ramp : {Source::gravity_ramp, Source::water_change})
      n.energy.flows[ramp] += state.energy.flows[ramp] - before[ramp];
    const Trial trial = n.trial;
    if (trial == Trial::start) start_increment();
    const Eigen::VectorXd residual = residual_now();
    const double now = merit(residual);
    if (trial == Trial::step && !is_acceptable(residual, now)) return reject();
    accept(residual, now, trial == Trial::forced);
  }
};

}  // namespace

template <int Dim>
bool newton_applies(const Model<Dim>& model, const DampingSettings& damping) {
  return damping.statics == Statics::newton && model.prescribed.empty() &&
         std::all_of(model.properties.begin(), model.properties.end(),
                     [](const JointProperties& p) { return p.laws.is_plain(); });
}

template <int Dim>
void begin_newton(const Model<Dim>& model, const Settings& settings, double ramp, State<Dim>& state) {
  state.newton = {};
  NewtonIncrement<Dim>& n = state.newton;
  n.under_way = true;
  Newton<Dim>(model, settings, state).take_base();
  if (!(ramp > 0)) return;
  n.trial = NewtonIncrement<Dim>::Trial::waiting;
  n.increments_left = settings.damping.increments - 1;
  n.increment_time = ramp / settings.damping.increments;
  n.ends = state.time + ramp;
}

template <int Dim>
void iterate(const Model<Dim>& model, const Settings& settings, State<Dim>& state) {
  Newton<Dim>(model, settings, state).iterate();
}

template <int Dim>
std::vector<Vector<Dim>> accepted_displacements(const Model<Dim>& model, const State<Dim>& state) {
  std::vector<Vector<Dim>> displacements;
  const double* q = state.newton.accepted.data();  // of the free bodies, in their order
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    displacements.push_back(state.newton.base[b].displacement);
    if (model.bodies[b].fixed || !model.bodies[b].present) continue;
    displacements.back() += Eigen::Map<const Vector<Dim>>(q);
    q += freedoms<Dim>;
  }
  return displacements;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                           \
  template bool newton_applies<Dim>(const Model<Dim>&, const DampingSettings&);             \
  template void begin_newton<Dim>(const Model<Dim>&, const Settings&, double, State<Dim>&); \
  template void iterate<Dim>(const Model<Dim>&, const Settings&, State<Dim>&);              \
  template std::vector<Vector<Dim>> accepted_displacements<Dim>(const Model<Dim>&, const State<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
