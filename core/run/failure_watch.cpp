#include "core/run/failure_watch.hpp"

#include <algorithm>
#include <cmath>

#include "core/joint_laws/joint_law.hpp"
#include "core/step/elastic_displacement.hpp"

namespace voussoir {
namespace {

// elastic displacements after which what settling has locked in is spent: shear dies away as e^(-u/1.1 u_el)
constexpr double until_elastic_is_spent = 10;

// Straight: the slope over the last doubling is at least this much of the one before. A straight line gives 1, a block
// that turns on its edge 0.35, what dies away exponentially less.
constexpr double straight_from = 0.5;

// or what the line still falls by over the whole way is this fraction of the search's tolerance
constexpr double flat_fraction = 0.1;

// of the strength: falling by more than this over one elastic displacement is elastic still; of the fall: what bolts
// that load up may take
constexpr double elastic_fall = 0.01, loading_share = 0.1;

// bodies turn when a point of theirs moves by this much of the displacement through it
constexpr double turning_share = 0.1;

// bodies that move at least so far as this fraction of the one that moves most are those that fail
constexpr double moving_share = 0.5;

// displacements of the two looks of a line, at least this factor apart
constexpr double looks_apart = 1.15;

// the motion between two looks, its power, and the resistance of the joints along it
struct Work {
  double most = 0;        // m
  double power = 0;       // P, J
  double resistance = 0;  // D, J
};

template <int Dim>
struct Moved {
  std::vector<Vector<Dim>> by;    // m, by body; 0 of one that is held
  std::vector<Spin<Dim>> turned;  // rad
};

template <int Dim>
Moved<Dim> moved_between(const Model<Dim>& model, const std::vector<Placement<Dim>>& from,
                         const std::vector<Placement<Dim>>& to) {
  Moved<Dim> moved;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    Vector<Dim> by = to[b].displacement - from[b].displacement;
    Spin<Dim> turn = rotation_vector(to[b].rotation) - rotation_vector(from[b].rotation);
    const Body<Dim>& body = model.bodies[b];
    for (int k = 0; k < Dim; ++k)
      if (body.fixed || !body.free_translation[k]) by[k] = 0;
    for (int k = 0; k < spin_freedoms<Dim>; ++k)
      if (body.fixed || !body.free_rotation[k]) turn[k] = 0;
    moved.by.push_back(by);
    moved.turned.push_back(turn);
  }
  return moved;
}

// N: the cohesion in force of a contact's bonds
template <int Dim>
double cohesion_of(const Model<Dim>& model, const State<Dim>& state, std::size_t place) {
  const Contact<Dim>& c = state.contacts.list[place];
  const JointProperties& joint = model.properties[c.properties];
  if (!joint.laws.bond) return 0;
  const std::vector<double>& divided = state.schedule.strength_factor;
  double sum = 0;
  const auto add = [&](const JointState<Dim>& h) {
    sum += cohesion_answer(joint, h.bond, h.bond_slip, divided.empty() ? 1 : divided[c.properties]).stress * h.area;
  };
  if (c.cells == 0) add(c.history);
  for (const SubContact<Dim>& s : subs_of(state.contacts, place))
    if (s.area > 0) add(s.history);
  return sum;
}

template <int Dim>
Work work_of(const Model<Dim>& model, const State<Dim>& state, const WatchPlan& plan, const Moved<Dim>& moved) {
  Work work;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    work.power += state.loads.total[b].force.dot(moved.by[b]) + state.loads.total[b].moment.dot(moved.turned[b]);
    work.most = std::max(work.most, moved.by[b].norm());
  }
  const bool factor = plan.searched == Searched::factor;
  for (std::size_t place = 0; place < state.contacts.list.size(); ++place) {
    const Contact<Dim>& c = state.contacts.list[place];
    if (!c.touching() || !std::ranges::binary_search(plan.properties, c.properties)) continue;
    const int a = model.parts[c.part_a].body, b = model.parts[c.part_b].body;
    const Vector<Dim>& arm_a = c.geometry.point;
    const Vector<Dim> arm_b = arm_a - between(state.bodies.poses[a], state.bodies.poses[b]);
    const Vector<Dim> slip = moved.by[b] + cross(moved.turned[b], arm_b) - moved.by[a] - cross(moved.turned[a], arm_a);
    const Vector<Dim>& normal = c.geometry.normal;
    const double pressed = std::max(0.0, c.force.dot(normal));
    const double strength =
        factor ? pressed * std::tan(state.schedule.friction[c.properties]) + cohesion_of(model, state, place) : pressed;
    work.resistance += strength * (slip - slip.dot(normal) * normal).norm();
  }
  return work;
}

double required_by(const WatchPlan& plan, const Schedule& schedule, const Work& work) {
  const double in_force = strength_of(plan.searched, level_in_force(plan.searched, plan.properties, schedule));
  const double more = work.power / work.resistance;
  return plan.searched == Searched::friction ? in_force + more : in_force * (1 + more);
}

template <int Dim>
double forces_of_bolts(const Model<Dim>& model, const LoadsState<Dim>& loads) {
  const std::vector<Load<Dim>>& of_bolts = loads.by_source[Source::bolts];
  double sum = 0;
  for (std::size_t b = 0; b < of_bolts.size(); ++b)
    if (!model.bodies[b].fixed) sum += of_bolts[b].force.norm();
  return sum;
}

double slope(const RequiredStrength& from, const RequiredStrength& to) {
  return (from.strength - to.strength) / (to.displacement - from.displacement);
}

// Judges the line through the last three looks.
template <int Dim>
void judge_line(const Model<Dim>& model, const Moved<Dim>& since_begin, const Work& work, double moved, double loading,
                double tolerance, TrialWatch<Dim>& trial) {
  double turned = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    turned = std::max(turned, since_begin.turned[b].norm() * model.bodies[b].radius);
  trial.turns = turned > turning_share * moved;
  trial.straight = trial.loads = false;
  const std::size_t n = trial.required.size();
  if (n < 3) return;
  const RequiredStrength &now = trial.required[n - 1], &before = trial.required[n - 2];
  const double first = slope(trial.required[n - 3], before), second = slope(before, now);
  const double flat = flat_fraction * tolerance, falls = second * moved;
  const bool keeps_on = first <= 0 || second >= straight_from * first;
  trial.loads = second > 0 && loading > loading_share * (before.strength - now.strength) * work.resistance;
  const bool elastic = second * trial.elastic > elastic_fall * now.strength || trial.loads;
  const bool drives = work.power > 0 && now.strength > trial.target;
  trial.straight = !trial.turns && ((first > 0 && second >= straight_from * first && second <= first / straight_from) ||
                                    std::abs(falls) <= flat);
  trial.lost = !trial.turns && drives && !elastic && (keeps_on || falls <= flat) &&
               moved >= until_elastic_is_spent * trial.elastic;
}

template <int Dim>
NoLine why_no_line(const TrialWatch<Dim>& trial) {
  const std::size_t n = trial.required.size();
  if (trial.turns) return NoLine::turned;
  if (n == 0) return NoLine::no_slip;
  if (trial.broke) return NoLine::broke;
  if (trial.loads && !trial.straight) return NoLine::loads;
  if (n < 3) return NoLine::too_short;
  if (!trial.straight) return NoLine::not_straight;
  return trial.required[n - 1].displacement > looks_apart * trial.required[n - 2].displacement ? NoLine::none
                                                                                               : NoLine::too_short;
}

template <int Dim>
const Vector<Dim>& displacement_of(const Vector<Dim>& displacement) {
  return displacement;
}
template <int Dim>
const Vector<Dim>& displacement_of(const Placement<Dim>& placed) {
  return placed.displacement;
}

}  // namespace

template <int Dim, class From>
MovingBodies moving_bodies(const Model<Dim>& model, const std::vector<From>& from,
                           const std::vector<Placement<Dim>>& placed, const std::vector<double>& values) {
  const auto moved = [&](std::size_t b) {
    return model.bodies[b].fixed ? 0 : (placed[b].displacement - displacement_of<Dim>(from[b])).norm();
  };
  MovingBodies moving;
  for (std::size_t b = 0; b < placed.size(); ++b) {
    if (moved(b) <= moving.farthest) continue;
    moving.farthest = moved(b);
    moving.body = static_cast<int>(b);
  }
  for (std::size_t b = 0; b < placed.size(); ++b)
    if (moved(b) >= moving_share * moving.farthest) moving.most_of = std::max(moving.most_of, values[b]);
  return moving;
}

template <int Dim>
double farthest_since(const Model<Dim>& model, const std::vector<Vector<Dim>>& began,
                      const std::vector<Placement<Dim>>& placed) {
  return moving_bodies(model, began, placed, std::vector<double>(placed.size(), 0)).farthest;
}

template <int Dim>
bool has_failed_by_displacement(const Model<Dim>& model, const std::vector<Vector<Dim>>& began,
                                const std::vector<Placement<Dim>>& placed, const WatchPlan& plan) {
  const MovingBodies moving = moving_bodies(model, began, placed, plan.moved_away);
  return moving.farthest > moving.most_of;
}

template <int Dim>
void begin_watch(const State<Dim>& state, double level, FailureWatch<Dim>& watch) {
  watch.trial = {};
  note_placements(state.bodies, watch.trial.first);
  watch.trial.last = watch.trial.first;
  watch.trial.bonds = bonds_of(state.contacts).held();
  watch.trial.target = strength_of(watch.plan.searched, level);
}

template <int Dim>
void look(const Model<Dim>& model, const State<Dim>& state, const std::vector<Placement<Dim>>& placed,
          const std::vector<Vector<Dim>>& began, FailureWatch<Dim>& watch) {
  TrialWatch<Dim>& trial = watch.trial;
  const MovingBodies moving = moving_bodies(model, trial.first, placed, watch.plan.elastic);
  const double moved = moving.farthest;
  if (!(moved > 0)) return;
  trial.elastic = moving.most_of;
  if (!(trial.elastic > 0) || moved < std::ldexp(trial.elastic, trial.looks - 1)) return;

  const Moved<Dim> since_last = moved_between(model, trial.last, placed);
  const Work work = work_of(model, state, watch.plan, since_last);
  const double displacement = moving_bodies(model, began, placed, watch.plan.elastic).farthest;
  const double bolts = forces_of_bolts(model, state.loads);
  const bool goes_on = trial.required.empty() || displacement > trial.required.back().displacement;
  if (work.resistance > 0 && work.most > 0 && goes_on) {
    trial.required.push_back({displacement, required_by(watch.plan, state.schedule, work)});
    trial.broke = trial.broke || bonds_of(state.contacts).held() < trial.bonds;
    judge_line(model, moved_between(model, trial.first, placed), work, moved, (bolts - trial.bolts) * work.most,
               watch.plan.tolerance, trial);
  }
  trial.last = placed;
  trial.bolts = bolts;
  while (moved >= std::ldexp(trial.elastic, trial.looks - 1))
    ++trial.looks;
}

namespace {

// m: the slip over which the shear strength changes; none if it does not. Hardening is asked at an ordinary stress.
double slip_of_strength(const JointProperties& p) {
  constexpr double ordinary_stress = 1e6;  // Pa
  double slip = p.softens_cohesion() ? p.cohesion_slip : 0;
  if (p.laws.friction == FrictionLaw::softening) slip = std::max(slip, p.softening_slip);
  if (p.laws.friction == FrictionLaw::hardening)
    slip = std::max(slip, p.hardening_slip * std::pow(ordinary_stress, p.hardening_exponent));
  // the elastic slip comes before, which is seldom longer than that at the peak
  if (p.follows_barton_bandis() && p.mobilises()) slip = std::max(slip, 2 * p.barton_bandis.peak_slip);
  return slip;
}

}  // namespace

template <int Dim>
double failure_displacement_of(const Model<Dim>& model, const ReducePlan& plan) {
  if (plan.failure_displacement > 0) return plan.failure_displacement;
  double smallest = 0;
  for (const Body<Dim>& b : model.bodies)
    if (!b.fixed) smallest = smallest == 0 ? b.size : std::min(smallest, b.size);
  double displacement = failure_fraction_of_radius * smallest;
  for (const JointProperties& p : model.properties)
    displacement = std::max(displacement, slip_of_strength(p));
  return displacement;
}

template <int Dim>
std::vector<int> chosen_properties(const Model<Dim>& model, const ReducePlan& plan) {
  std::vector<int> chosen;
  for (std::size_t p = 0; p < model.properties.size(); ++p)
    if (plan.properties.empty() ||
        std::find(plan.properties.begin(), plan.properties.end(), model.properties[p].name) != plan.properties.end())
      chosen.push_back(static_cast<int>(p));
  return chosen;
}

template <int Dim>
std::string not_watched(const Model<Dim>& model, const ReducePlan& plan, const SupportsState<Dim>& supports) {
  if (plan.failure_displacement > 0) return "a failure displacement is stated";
  if (plan.method != ReductionMethod::bisection) return "the search does not bisect";
  if (plan.failure_fraction > 0) return "a fraction of the blocks must fail";
  if (!model.prescribed.empty()) return "bodies are driven";
  if (model.particles) return "there are potential particles";
  if (!supports.grouted.empty()) return "there are grouted bolts";
  if (!supports.linings.empty()) return "there are linings";
  for (const JointProperties& joint : model.properties)
    if (joint.mobilises()) return "friction depends on the slip";
  for (const JointProperties& joint : model.properties)
    if (joint.follows_barton_bandis()) return "friction depends on the normal stress";
  for (const JointProperties& joint : model.properties)
    if (joint.remembers_place()) return "the normal stress depends on the slip or on the largest closure";
  for (const JointProperties& joint : model.properties)
    if (joint.softens_cohesion()) return "cohesion depends on the slip";
  return {};
}

template <int Dim>
WatchPlan watch_plan(const Model<Dim>& model, const Settings& settings, const ReducePlan& plan, const Levels& levels,
                     const State<Dim>& stable) {
  if (plan.criterion == FailureCriterion::displacement || !not_watched(model, plan, stable.supports).empty()) return {};
  WatchPlan watch{.searched = plan.searched,
                  .properties = chosen_properties(model, plan),
                  .elastic = elastic_displacements(model, settings, stable)};
  for (const Body<Dim>& body : model.bodies)
    watch.moved_away.push_back(failure_fraction_of_radius * inscribed_radius(body));
  watch.tolerance =
      std::abs(levels.strength(levels.from) - levels.strength(levels.from + levels.direction * levels.tolerance));
  return watch;
}

template <int Dim>
void note_stable_trial(const Model<Dim>& model, const State<Dim>& state, const std::vector<Vector<Dim>>& began,
                       const WatchPlan& plan, double strength, SearchEstimates& known) {
  std::vector<Placement<Dim>> placed;
  note_placements(state.bodies, placed);
  const MovingBodies moving = moving_bodies(model, began, placed, plan.moved_away);
  known.stable.push_back(
      {.level = strength, .displacement = moving.farthest, .of_failure = moving.farthest / moving.most_of});
}

// The line through the last two looks.
template <int Dim>
void note_failed_trial(const TrialWatch<Dim>& trial, double strength, SearchEstimates& known) {
  known.no_line = why_no_line(trial);
  if (known.no_line != NoLine::none) return;
  const std::size_t n = trial.required.size();
  const RequiredStrength &first = trial.required[n - 2], &second = trial.required[n - 1];
  const double critical = first.strength + slope(first, second) * first.displacement;
  known.failed.push_back({.level = strength, .critical = critical, .taken_out = std::abs(critical - second.strength)});
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                             \
  template MovingBodies moving_bodies<Dim>(const Model<Dim>&, const std::vector<Vector<Dim>>&,                \
                                           const std::vector<Placement<Dim>>&, const std::vector<double>&);   \
  template MovingBodies moving_bodies<Dim>(const Model<Dim>&, const std::vector<Placement<Dim>>&,             \
                                           const std::vector<Placement<Dim>>&, const std::vector<double>&);   \
  template double farthest_since<Dim>(const Model<Dim>&, const std::vector<Vector<Dim>>&,                     \
                                      const std::vector<Placement<Dim>>&);                                    \
  template bool has_failed_by_displacement<Dim>(const Model<Dim>&, const std::vector<Vector<Dim>>&,           \
                                                const std::vector<Placement<Dim>>&, const WatchPlan&);        \
  template void begin_watch<Dim>(const State<Dim>&, double, FailureWatch<Dim>&);                              \
  template void look<Dim>(const Model<Dim>&, const State<Dim>&, const std::vector<Placement<Dim>>&,           \
                          const std::vector<Vector<Dim>>&, FailureWatch<Dim>&);                               \
  template WatchPlan watch_plan<Dim>(const Model<Dim>&, const Settings&, const ReducePlan&, const Levels&,    \
                                     const State<Dim>&);                                                      \
  template void note_stable_trial<Dim>(const Model<Dim>&, const State<Dim>&, const std::vector<Vector<Dim>>&, \
                                       const WatchPlan&, double, SearchEstimates&);                           \
  template void note_failed_trial<Dim>(const TrialWatch<Dim>&, double, SearchEstimates&);                     \
  template double failure_displacement_of<Dim>(const Model<Dim>&, const ReducePlan&);                         \
  template std::vector<int> chosen_properties<Dim>(const Model<Dim>&, const ReducePlan&);                     \
  template std::string not_watched<Dim>(const Model<Dim>&, const ReducePlan&, const SupportsState<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
