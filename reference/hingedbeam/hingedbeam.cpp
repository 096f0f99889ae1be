#include "reference/hingedbeam/hingedbeam.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "reference/hingedbeam/overlap.hpp"
#include "reference/parabola.hpp"
#include "reference/peak.hpp"

namespace voussoir::reference {
namespace {

// Illinois: a bracketing secant; f(low) and f(high) have different signs
double root(const std::function<double(double)>& f, double low, double high, double width) {
  double at_low = f(low), at_high = f(high);
  if (!(at_low * at_high <= 0)) throw std::domain_error("hinged beam: no equilibrium within the bracket");
  constexpr int most = 200;
  for (int i = 0; i < most && std::abs(high - low) > width && at_low != 0; ++i) {
    const double x = high - at_high * (high - low) / (at_high - at_low), at = f(x);
    if (at * at_high <= 0) {
      low = high;
      at_low = at_high;
    } else {
      at_low *= 0.5;
    }
    if (x == high) break;
    high = x;
    at_high = at;
  }
  return high;
}

// m: far below the resolution of the checks, far above rounding
constexpr double position_width = 1e-16;

// of the search for a height: forces meet to this fraction of stiffness times depth, 5 mN
constexpr int most_secants = 30;
constexpr double forces_meet = 1e-9;

// a rectangle turned clockwise
Planes rectangle(Point middle, double half_length, double half_depth, double turn) {
  const Point along{std::cos(turn), -std::sin(turn)}, up{std::sin(turn), std::cos(turn)};
  const double a = dot(along, middle), u = dot(up, middle);
  return {{along, a + half_length}, {-along, half_length - a}, {up, u + half_depth}, {-up, half_depth - u}};
}

// the middle of the block above its lower corner at the abutment
double middle_above_corner(const HingedBeam& beam, double rotation) {
  return 0.5 * (beam.depth * std::cos(rotation) - beam.length * std::sin(rotation));
}

Point hinge(const HingedBeamModel& model, const Planes& a, const Planes& b) {
  const Polygon region = clipped(a, b);
  if (region.size() < 3) throw std::domain_error("hinged beam: the bodies do not overlap");
  const Point centroid = centroid_of(region);
  return model.point == HingePoint::centroid ? centroid : analytic_centre(a, b, centroid);
}

// forces and the residual of the horizontal balance, with the block's middle at (x, y)
struct Balance {
  double residual;  // N
  HingedBeamState state;
  Point at_abutment;
};

Balance balance(const HingedBeamModel& model, double rotation, double x, double y) {
  const HingedBeam& beam = model.beam;
  const HingeAbutment& end = model.abutment;
  const double low = -0.5 * beam.depth - end.below, high = 0.5 * beam.depth + end.above;
  const Planes wall = rectangle({-0.5 * end.thickness, 0.5 * (low + high)}, 0.5 * end.thickness, 0.5 * (high - low), 0);
  const Planes block = rectangle({x, y}, 0.5 * beam.length, 0.5 * beam.depth, rotation);
  const Planes mirrored = rectangle({2 * beam.length - x, y}, 0.5 * beam.length, 0.5 * beam.depth, -rotation);
  const Point left = hinge(model, wall, block), right = hinge(model, block, mirrored);

  // the normal force turns with the faces at the abutment; at mid-span symmetry keeps it level
  const double tilt = model.normal == HingeNormal::mean ? 0.5 * rotation : 0;
  const Point normal{std::cos(tilt), -std::sin(tilt)};
  HingedBeamState s;
  s.rotation = rotation;
  s.x = x;
  s.y = y;
  s.normal_force = beam.stiffness * overlap_along(normal, wall, block, left);
  s.thrust = 0.5 * beam.stiffness * overlap_along({1, 0}, block, mirrored, right);

  // moments about the hinge at the abutment, then the shear force that supports the weight there
  s.weight = s.thrust * (right.y - left.y) / (x - left.x);
  s.shear_force = (s.weight + s.normal_force * std::sin(tilt)) / std::cos(tilt);
  return {s.normal_force * std::cos(tilt) + s.shear_force * std::sin(tilt) - s.thrust, s, left};
}

Balance balanced(const HingedBeamModel& model, double rotation, double y) {
  const HingedBeam& beam = model.beam;
  // the block is broader than its place by the overlaps at its two corners together
  const double excess = 0.5 * (beam.length * std::cos(rotation) + beam.depth * std::sin(rotation) - beam.length);
  constexpr double fraction = 0.5;  // the two ends differ by some hundredths of it
  const double middle = 0.5 * beam.length, reach = fraction * excess;
  const double x = root([&](double at) { return balance(model, rotation, at, y).residual; }, middle - reach,
                        middle + reach, position_width);
  return balance(model, rotation, x, y);
}

// fractions of the geometric limit between which every model here has its peak, and the number of golden
// sections that leaves 1e-7 of the range
constexpr double peak_from = 0.1, peak_to = 0.6;
constexpr int sections = 32;

}  // namespace

double hinged_beam_geometric_limit(const HingedBeam& beam) {
  return std::atan2(beam.depth, beam.length);
}

HingedBeamLoad hinged_beam_first_order(const HingedBeam& beam, double rotation) {
  const double thrust = beam.stiffness * beam.depth * rotation / 3, arm = 2 * beam.depth / 3;
  return {rotation, 2 * thrust * arm / beam.length, thrust};
}

HingedBeamLoad hinged_beam_second_order(const HingedBeam& beam, double rotation) {
  const double c = std::cos(rotation), s = std::sin(rotation), t = s / c;
  const double corner = 0.5 * (beam.length * c + beam.depth * s - beam.length);
  const double thrust = beam.stiffness * corner * (2 + t * t) / 3;
  const double arm = beam.depth * c - beam.length * s - 2 * corner * (1 / t - t) / 3;
  return {rotation, 2 * thrust * arm / beam.length, thrust};
}

HingedBeamState hinged_beam_equilibrium(const HingedBeamModel& model, double rotation, double raised) {
  const double corner = -0.5 * model.beam.depth + raised;
  return balanced(model, rotation, corner + middle_above_corner(model.beam, rotation)).state;
}

std::vector<HingedBeamState> hinged_beam_path(const HingedBeamModel& model, double shear_stiffness, double rotation,
                                              int steps) {
  std::vector<HingedBeamState> path;
  HingedBeamState last;
  last.x = 0.5 * model.beam.length;
  for (int i = 1; i <= steps; ++i) {
    const double turn = rotation / steps, now = i * turn, middle = now - 0.5 * turn;
    const Point along =
        model.normal == HingeNormal::mean ? Point{std::sin(0.5 * middle), std::cos(0.5 * middle)} : Point{0, 1};
    // residual of the law of the joint's spring at a height
    const auto missing = [&](double y) {
      const Balance b = balanced(model, now, y);
      const Point arm = b.at_abutment - Point{0.5 * (last.x + b.state.x), 0.5 * (last.y + y)};
      const Point moved = Point{b.state.x - last.x, y - last.y} + Point{turn * arm.y, -turn * arm.x};
      return b.state.shear_force - last.shear_force + shear_stiffness * dot(moved, along);
    };
    // secants from the height of pure rolling; the spring is almost all of the slope
    double y = last.y - turn * last.x, at_y = missing(y), slope = shear_stiffness;
    for (int k = 0; k < most_secants && std::abs(at_y) > forces_meet * model.beam.stiffness * model.beam.depth; ++k) {
      const double next = y - at_y / slope, at_next = missing(next);
      if (next == y) break;
      slope = (at_next - at_y) / (next - y);
      y = next;
      at_y = at_next;
    }
    last = balanced(model, now, y).state;
    path.push_back(last);
  }
  return path;
}

HingedBeamLoad hinged_beam_second_order_peak(const HingedBeam& beam) {
  const double limit = hinged_beam_geometric_limit(beam);
  const auto weight = [&](double at) { return hinged_beam_second_order(beam, at).weight; };
  return hinged_beam_second_order(beam, peak(weight, peak_from * limit, peak_to * limit, sections).at);
}

HingedBeamState hinged_beam_peak(const HingedBeamModel& model) {
  const double limit = hinged_beam_geometric_limit(model.beam);
  const auto weight = [&](double at) { return hinged_beam_equilibrium(model, at).weight; };
  return hinged_beam_equilibrium(model, peak(weight, peak_from * limit, peak_to * limit, sections).at);
}

HingedBeamLoad peak_of(const std::vector<HingedBeamLoad>& curve) {
  const auto greatest =
      std::max_element(curve.begin(), curve.end(), [](const auto& a, const auto& b) { return a.weight < b.weight; });
  if (curve.size() < 3 || greatest == curve.begin() || greatest + 1 == curve.end())
    throw std::domain_error("hinged beam: the curve has no peak inside");
  const HingedBeamLoad &a = greatest[-1], &b = greatest[0], &c = greatest[1];
  const ParabolaTop top = parabola_top({a.rotation, a.weight}, {b.rotation, b.weight}, {c.rotation, c.weight});
  HingedBeamLoad peak{b.rotation + top.aside, top.y, 0};
  const HingedBeamLoad& other = top.aside < 0 ? a : c;
  peak.thrust = b.thrust + (other.thrust - b.thrust) * top.aside / (other.rotation - b.rotation);
  return peak;
}

}  // namespace voussoir::reference
