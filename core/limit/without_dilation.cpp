#include "core/limit/without_dilation.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "core/limit/shortfall.hpp"

namespace voussoir {
namespace {

// In the program's units a block that moves alone slips by about 1, whatever its size.
constexpr double loose = 5;          // slip of all corners at the start
constexpr double closing = 0.3;      // part of the way to the mechanism's slips in a round
constexpr int most_rounds = 200;     // of a fixed point
constexpr int standing_rounds = 10;  // in which the factor must not change
constexpr double standing = 1e-6;    // of the factor
constexpr int most_polishing = 40;
constexpr double slips_equal = 1e-9;                        // of the largest
constexpr double slips_agree = 1e-4;                        // of the largest
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

  void loosen() {
    slips_ = sines_of_cones(assembly_);
    for (double& slip : slips_)
      slip *= loose;
  }

  // with s = (1 + excess)|u_T|; none: no round of it was bounded
  struct Settled {
    bool settled = false;
    double factor = 0;
  };
  std::optional<Settled> settle(double excess) {
    std::optional<Settled> last;
    int stood = 0;
    for (int round = 0; round < most_rounds && stood < standing_rounds; ++round) {
      const std::optional<Round> found = next(excess, closing);
      if (!found) continue;  // unbounded: joints stay as loose as they are
      const bool stands =
          last && std::abs(found->factor - last->factor) <= standing * std::max(1.0, std::abs(found->factor));
      stood = stands && (stood > 0 || found->change <= slips_agree) ? stood + 1 : 0;
      last = Settled{false, found->factor};
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
    double factor = 0, change = 0;  // of the slips, over the largest
  };
  // slips move by `part` of the way to those of the mechanism that they give; none: it is not bounded
  std::optional<Round> next(double excess, double part) {
    ++rounds_;
    const ConeProgramAnswer answer = solve_with(1, slips_);
    if (answer.status != ConeStatus::optimal) return {};
    double largest = 0, change = 0;
    for (std::size_t k = 0; k < slips_.size(); ++k) {
      if (!is_frictional(program_.cones[k])) continue;
      const double slip = (1 + excess) * slip_of(program_.cones[k], answer.y);
      largest = std::max(largest, slip);
      change = std::max(change, std::abs(slip - slips_[k]));
      slips_[k] += part * (slip - slips_[k]);
    }
    if (hook_) hook_(rounds_, answer.factor / scale_);
    return Round{answer.factor / scale_, largest > 0 ? change / largest : 0};
  }

  static bool is_frictional(const Cone& cone) { return cone.head == 0; }

  static double slip_of(const Cone& cone, const Eigen::VectorXd& y) {
    constexpr int rows = freedoms<Dim>;
    Vector<Dim> speed = Vector<Dim>::Zero();
    if (cone.body_a >= 0) speed += cone.on_a.transpose() * y.segment<rows>(rows * cone.body_a);
    if (cone.body_b >= 0) speed += cone.on_b.transpose() * y.segment<rows>(rows * cone.body_b);
    return speed.template tail<Dim - 1>().norm();
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
  std::vector<double> slips_;  // by cone: sin φ |u_T|, as the cone's numbers have it
  double scale_ = 0;
  int rounds_ = 0, programs_ = 0;
};

// The least and the largest factor of a mechanism, by slips a little larger and smaller than its own, both ends taken
// to the slips themselves.
struct Interval {
  bool settled = false, unbounded = false;
  EndOfFactor least, largest;
  ConeProgramAnswer at_least;
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
  Interval found{.settled = settled->settled};
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
std::optional<Interval> loosened(FixedPoints<Dim>& points) {
  points.loosen();
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
std::optional<Interval> closed(FixedPoints<Dim>& points) {
  points.loosen();
  return interval_at(0, points);
}

}  // namespace

template <int Dim>
FactorWithoutDilation<Dim> find_factor_without_dilation(const CornerAssembly<Dim>& assembly, const Loads<Dim>& dead,
                                                        const Loads<Dim>& live, const RoundHook& hook) {
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
  std::optional<Interval> lowest = closed(points), other = loosened(points);
  const auto is_lower = [](const Interval& a, const Interval& b) {
    return a.least.factor < b.least.factor - same_mechanism * std::max(1.0, std::abs(b.least.factor));
  };
  if (other && (!lowest || is_lower(*other, *lowest))) lowest = std::move(other);
  result.rounds = points.rounds();
  result.programs = 1 + points.programs();
  if (!lowest) return result.status = LimitStatus::solver_failed, result;
  result.settled = lowest->settled;
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
                                                               const Loads<2>&, const RoundHook&);
template FactorWithoutDilation<3> find_factor_without_dilation(const CornerAssembly<3>&, const Loads<3>&,
                                                               const Loads<3>&, const RoundHook&);

}  // namespace voussoir
