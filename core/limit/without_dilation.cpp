#include "core/limit/without_dilation.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "core/limit/shortfall.hpp"

namespace voussoir {
namespace {

// In the program's units a block that moves alone slips by about 1, whatever its size.
constexpr double loose = 5;            // slip of all corners at the start
constexpr int halving_rounds = 60;     // the first, with ε: to the mechanism's slips, but at most half way to none
constexpr double part_closed = 0.3;    // then the part of the way to the mechanism's slips
constexpr double slowly_closed = 0.1;  // in the second half of the rounds
constexpr int most_rounds = 260;       // of a fixed point
constexpr int standing_rounds = 10;    // in which the factor must not change
constexpr double standing = 1e-6;      // of the factor
// rounds of one factor after which slips that still change by this much, of the fastest, are taken to their limit
constexpr int slow_rounds = 25;
constexpr double slow_change = 0.01, largest_ratio = 0.995;
constexpr int most_polishing = 40;
constexpr double slips_equal = 1e-9;                        // of the fastest
constexpr double slips_agree = 1e-4;                        // of the fastest
constexpr double first_excess = 0.01, last_excess = 0.001;  // ε
constexpr double numerical = 1e-6;                          // of 1 or of a factor: closed forms are met to 1e-7
constexpr double same_mechanism = 1e-4;                     // of the factor: a lower one belongs to another
constexpr double first_aside = 1e-3, last_aside = 1e-4;     // of the slips, for the ends of the interval

template <int Dim>
class FixedPoints {
  using Cone = ForceCone<freedoms<Dim>, Dim>;

 public:
  FixedPoints(const CornerAssembly<Dim>& assembly, const Loads<Dim>& dead, const Loads<Dim>& live,
              const RoundHook& hook)
      : assembly_(assembly), hook_(hook), program_(corner_program(assembly, dead, live)) {
    scale_ = program_.live.cwiseAbs().maxCoeff();
    if (scale_ > 0) program_.live /= scale_;
  }

  bool has_load() const { return scale_ > 0; }
  int rounds() const { return rounds_; }
  int programs() const { return programs_; }

  // slips from which fixed points are sought: of a neighbour's mechanism, else those of loose joints
  void begin_at(std::span<const double> neighbour) {
    slips_ = sines_of_cones(assembly_);
    step_.assign(slips_.size(), 0);
    step_before_ = step_;
    const bool of_neighbour = neighbour.size() == slips_.size();
    for (std::size_t k = 0; k < slips_.size(); ++k)
      slips_[k] *= of_neighbour ? neighbour[k] : loose;
  }

  std::vector<double> slips() const {
    std::vector<double> slips = sines_of_cones(assembly_);
    for (std::size_t k = 0; k < slips.size(); ++k)
      slips[k] = slips[k] > 0 ? slips_[k] / slips[k] : 0;
    return slips;
  }

  // with s = (1 + excess)|u_T|; none: no round of it was bounded
  struct Settled {
    bool settled = false;
    double factor = 0;
  };
  std::optional<Settled> settle(double excess) {
    std::optional<Settled> last;
    int stood = 0, same = 0;  // rounds of one factor: with slips that agree, with any
    for (int round = 0; round < most_rounds && stood < standing_rounds; ++round) {
      const std::optional<Round> found = next(excess, excess > 0 && round < halving_rounds ? 0
                                                      : round < most_rounds / 2            ? part_closed
                                                                                           : slowly_closed);
      if (!found) continue;  // unbounded: joints stay as loose as they are
      const bool stands =
          last && std::abs(found->factor - last->factor) <= standing * std::max(1.0, std::abs(found->factor));
      same = stands ? same + 1 : 0;
      stood = stands && (stood > 0 || found->change <= slips_agree) ? stood + 1 : 0;
      last = Settled{false, found->factor};
      if (same > 0 && same % slow_rounds == 0 && found->change > slow_change) go_to_limit();
    }
    if (!last || stood < standing_rounds) return last;
    last->settled = true;
    // the whole way in each round, as long as slips come nearer to the mechanism's
    double change = slips_agree;
    for (int round = 0; round < most_polishing && change > slips_equal; ++round) {
      const std::vector<double> before = slips_;
      const std::optional<Round> found = next(excess, 1);
      if (!found || found->change >= change) {
        slips_ = before;
        break;
      }
      change = found->change;
      last->factor = found->factor;
    }
    return last;
  }

  // with the slips of a mechanism times `part`
  ConeProgramAnswer end_of_interval(double part) { return solve_with(part, slips_); }

  double scale() const { return scale_; }

  // an upper bound of every mechanism's factor; none: forces without bound
  std::optional<double> associated() {
    const ConeProgramAnswer answer = solve_with(0, slips_);
    return answer.status == ConeStatus::optimal ? std::optional(answer.factor / scale_) : std::nullopt;
  }

 private:
  struct Round {
    double factor = 0, change = 0;  // of the slips, over the fastest opening or slip
  };
  // Slips move by `part` of the way to those of the mechanism that they give; 0: all the way, but none to less than
  // half of itself. None: the mechanism is not bounded.
  std::optional<Round> next(double excess, double part) {
    ++rounds_;
    const ConeProgramAnswer answer = solve_with(1, slips_);
    if (answer.status != ConeStatus::optimal) return {};
    double fastest = 0, change = 0;
    for (std::size_t k = 0; k < slips_.size(); ++k) {
      if (!is_frictional(program_.cones[k])) continue;
      const Vector<Dim> opening = opening_of(program_.cones[k], answer.y);
      const double slip = (1 + excess) * opening.template tail<Dim - 1>().norm();
      fastest = std::max(fastest, opening.norm());
      change = std::max(change, std::abs(slip - slips_[k]));
      const double step = part > 0 ? part * (slip - slips_[k]) : std::max(slip, 0.5 * slips_[k]) - slips_[k];
      step_before_[k] = std::exchange(step_[k], step);
      slips_[k] += step_[k];
    }
    if (hook_) hook_(rounds_, answer.factor / scale_);
    return Round{answer.factor / scale_, fastest > 0 ? change / fastest : 0};
  }

  // Slips of one mechanism tend to its own in steps of a ratio, which is near 1 where blocks follow each other: to the
  // sum of all that follow (Aitken).
  void go_to_limit() {
    for (std::size_t k = 0; k < slips_.size(); ++k) {
      const double ratio = step_before_[k] != 0 ? step_[k] / step_before_[k] : 0;
      if (ratio > 0 && ratio < largest_ratio) slips_[k] = std::max(0.0, slips_[k] + step_[k] * ratio / (1 - ratio));
    }
  }

  static bool is_frictional(const Cone& cone) { return cone.head == 0; }

  static Vector<Dim> opening_of(const Cone& cone, const Eigen::VectorXd& y) {
    constexpr int rows = freedoms<Dim>;
    Vector<Dim> speed = Vector<Dim>::Zero();
    if (cone.body_a >= 0) speed += cone.on_a.transpose() * y.segment<rows>(rows * cone.body_a);
    if (cone.body_b >= 0) speed += cone.on_b.transpose() * y.segment<rows>(rows * cone.body_b);
    return speed;
  }

  ConeProgramAnswer solve_with(double part, const std::vector<double>& slips) {
    for (std::size_t k = 0; k < slips.size(); ++k)
      if (is_frictional(program_.cones[k])) program_.cones[k].cost = part * slips[k];
    ++programs_;
    return solve(program_);
  }

  const CornerAssembly<Dim>& assembly_;
  const RoundHook& hook_;
  CornerProgram<Dim> program_;
  std::vector<double> slips_;               // by cone: sin φ |u_T|, as the cone's numbers have it
  std::vector<double> step_, step_before_;  // of the last two rounds
  double scale_ = 0;
  int rounds_ = 0, programs_ = 0;
};

// The least and the largest factor of a mechanism, by slips a little larger and smaller than its own, both ends taken
// to the slips themselves.
struct Interval {
  bool settled = false, unbounded = false;
  EndOfFactor least, largest;
  ConeProgramAnswer at_least;
  std::vector<double> slips;
};

// where a number that is at `first` and at `last` of something small goes as it vanishes; it may be off by as much as
// the last was
EndOfFactor to_zero(double at_first, double at_last, double first, double last) {
  const double at_zero = (first * at_last - last * at_first) / (first - last);
  return {at_zero, std::max(numerical * std::max(1.0, std::abs(at_zero)), std::abs(at_zero - at_last))};
}

template <int Dim>
std::optional<Interval> interval_at(double excess, FixedPoints<Dim>& points) {
  const auto settled = points.settle(excess);
  if (!settled) return {};
  Interval found{.settled = settled->settled, .slips = points.slips()};
  const auto end = [&](double sign) -> std::optional<EndOfFactor> {
    double at[2];
    for (int k = 0; k < 2; ++k) {
      const double aside = k == 0 ? first_aside : last_aside;
      ConeProgramAnswer answer = points.end_of_interval((1 + sign * aside) / (1 + excess));
      if (answer.status != ConeStatus::optimal) return {};
      at[k] = answer.factor / points.scale();
      if (sign > 0 && k == 1) found.at_least = std::move(answer);
    }
    return to_zero(at[0], at[1], first_aside, last_aside);
  };
  found.least = end(1).value_or(EndOfFactor{settled->factor, numerical * std::max(1.0, std::abs(settled->factor))});
  const std::optional<EndOfFactor> largest = end(-1);
  found.unbounded = !largest;
  found.largest = largest.value_or(found.least);
  return found;
}

// slips of which a part vanishes as ε does
template <int Dim>
std::optional<Interval> loosened(FixedPoints<Dim>& points, std::span<const double> neighbour) {
  points.begin_at(neighbour);
  const std::optional<Interval> first = interval_at(first_excess, points);
  if (!first) return {};
  std::optional<Interval> last = interval_at(last_excess, points);
  if (!last) return {};
  const auto of_both = [](const EndOfFactor& at_first, const EndOfFactor& at_last) {
    EndOfFactor end = to_zero(at_first.factor, at_last.factor, first_excess, last_excess);
    end.error = std::max(end.error, at_last.error);
    return end;
  };
  last->least = of_both(first->least, last->least);
  last->largest = of_both(first->largest, last->largest);
  last->unbounded = last->unbounded || first->unbounded;
  last->settled = last->settled && first->settled;
  return last;
}

template <int Dim>
std::optional<Interval> closed(FixedPoints<Dim>& points, std::span<const double> neighbour) {
  points.begin_at(neighbour);
  return interval_at(0, points);
}

// of two fixed points of one mechanism
void take_wider(const Interval& other, Interval& found) {
  found.settled = found.settled || other.settled;
  found.unbounded = found.unbounded || other.unbounded;
  if (other.largest.factor > found.largest.factor + same_mechanism * std::max(1.0, std::abs(found.largest.factor)))
    found.largest = other.largest;
}

}  // namespace

template <int Dim>
FactorWithoutDilation<Dim> find_factor_without_dilation(const CornerAssembly<Dim>& assembly, const Loads<Dim>& dead,
                                                        const Loads<Dim>& live, const RoundHook& hook,
                                                        std::span<const double> neighbour) {
  FactorWithoutDilation<Dim> result;
  if (std::ranges::none_of(assembly.bodies, &CornerBody<Dim>::moves))
    return result.status = LimitStatus::nothing_free, result;
  FixedPoints<Dim> points(assembly, dead, live, hook);
  if (!points.has_load()) return result.status = LimitStatus::no_load, result;

  // any multiple of the live loads is carried if joints without friction carry these alone
  CornerAssembly<Dim> smooth = assembly;
  smooth.ties.clear();
  for (CornerFace<Dim>& face : smooth.faces)
    face.friction = face.cohesion = 0;
  const Shortfall alone = shortfall(smooth, corner_program(smooth, live));
  if (!alone.failed() && alone.stands()) return result.status = LimitStatus::carries_any, result.programs = 1, result;

  // the second has no part that vanishes with ε, but may end at forces that the loads do not ask for
  std::optional<Interval> lowest = closed(points, neighbour), other = loosened(points, neighbour);
  const auto is_lower = [](const Interval& a, const Interval& b) {
    return a.least.factor < b.least.factor - same_mechanism * std::max(1.0, std::abs(b.least.factor));
  };
  if (other && (!lowest || is_lower(*other, *lowest)))
    lowest = std::move(other);
  else if (other && !is_lower(*lowest, *other))
    // one mechanism: where forces are free, as of a bolt that it does not stretch, one of both need not stand
    take_wider(*other, *lowest);
  result.rounds = points.rounds();
  result.programs = 1 + points.programs();
  if (!lowest) return result.status = LimitStatus::solver_failed, result;
  result.settled = lowest->settled;
  result.slips = std::move(lowest->slips);
  result.least = lowest->least;
  result.largest = lowest->largest;
  result.unbounded = lowest->unbounded;
  if (const std::optional<double> associated = points.associated()) {
    result.largest.factor = std::min(result.largest.factor, *associated);
    ++result.programs;
  }
  result.largest.factor = std::max(result.largest.factor, result.least.factor);
  if (lowest->at_least.status == ConeStatus::optimal) {
    result.state.forces = corner_forces(assembly, lowest->at_least.x);
    result.state.tensions = tensions(assembly, lowest->at_least.x);
    result.state.velocities = mechanism_of(assembly, lowest->at_least.y);
  }
  result.state.velocities.resize(assembly.bodies.size());
  return result;
}

template FactorWithoutDilation<2> find_factor_without_dilation(const CornerAssembly<2>&, const Loads<2>&,
                                                               const Loads<2>&, const RoundHook&,
                                                               std::span<const double>);
template FactorWithoutDilation<3> find_factor_without_dilation(const CornerAssembly<3>&, const Loads<3>&,
                                                               const Loads<3>&, const RoundHook&,
                                                               std::span<const double>);

}  // namespace voussoir
