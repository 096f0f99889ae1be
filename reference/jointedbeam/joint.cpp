#include "reference/jointedbeam/joint.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace voussoir::reference {
namespace {

// a force this fraction below the limit of friction counts as at it
constexpr double at_limit = 1e-9;

// The two faces in the frame of their mean direction: places along the joint are measured from the left face's middle,
// t upwards and n to the right.
struct Meeting {
  Point n, t;
  double apart_n = 0, apart_t = 0;  // m, of the right face's middle
  double slope = 0;                 // tangent of half the angle between the faces; the overlap grows with twice of it
  double low = 0, high = 0;         // m: the interval that both faces cover and on which they overlap
  std::array<double, 4> edges{};    // m: where each face ends

  double overlap(double at) const { return slope * (2 * at - apart_t) - apart_n; }
  // the line half-way between the faces is parallel to t
  double middle() const { return 0.5 * (apart_n + slope * apart_t); }
};

Meeting meeting(const BeamFace& left, const BeamFace& right) {
  Meeting m;
  const double mean = 0.5 * (left.turn + right.turn), half = 0.5 * (right.turn - left.turn);
  m.n = {std::cos(mean), std::sin(mean)};
  m.t = {-m.n.y, m.n.x};
  const Point apart = right.middle - left.middle;
  m.apart_n = dot(m.n, apart);
  m.apart_t = dot(m.t, apart);
  m.slope = std::tan(half);
  const double shortened = 0.5 * std::cos(half);
  m.edges = {-shortened * left.height, shortened * left.height, m.apart_t - shortened * right.height,
             m.apart_t + shortened * right.height};
  m.low = std::max(m.edges[0], m.edges[2]);
  m.high = std::min(m.edges[1], m.edges[3]);
  // only the part that overlaps
  if (m.slope != 0) {
    const double edge = 0.5 * (m.apart_t + m.apart_n / m.slope);
    if (m.slope > 0) m.low = std::max(m.low, edge);
    if (m.slope < 0) m.high = std::min(m.high, edge);
  } else if (m.apart_n >= 0) {
    m.high = m.low;
  }
  return m;
}

// plastic slip p >= 0 after which the remaining trial force equals the friction at that slip: trial - stiffness p = μ(β
// + p) N. Convex and falling, so Newton from zero rises to the root and never overshoots it.
double return_slip(double trial, double stiffness, double strength, double peak, double slipped) {
  double p = 0;
  constexpr int most = 100;
  for (int i = 0; i < most; ++i) {
    const double left = peak > 0 ? std::exp(-(slipped + p) / peak) : 0;
    const double excess = trial - stiffness * p - strength * (1 - left);
    const double slope = stiffness + (peak > 0 ? strength * left / peak : 0);
    const double further = excess / slope;
    if (!(further > 1e-14 * (p + trial / stiffness))) return p + std::max(further, 0.0);
    p += further;
  }
  throw std::runtime_error("jointed beam: the return to the friction cone does not converge");
}

struct Cell {
  double area = 0, normal = 0;  // m², N
  double at = 0;                // m along the joint: point of action of the normal force
};

// Analytic centre of the overlap, m along the joint: greatest sum of the logarithms of the distances to the two faces
// in contact (both half the overlap on the line between them) and to the four edges. The bodies' far ends are farther
// away than the overlap by many orders and do not count.
double analytic_centre(const Meeting& m) {
  const auto slope = [&](double at) {
    const double overlap = 2 * 2 * m.slope / m.overlap(at);
    double edges = 0;
    for (const double edge : m.edges)
      edges += 1 / (at - edge);
    return overlap + edges;
  };
  // the sum is concave, its slope falls from +∞ to -∞ over the contact
  double low = m.low, high = m.high;
  constexpr int halvings = 60;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (slope(middle) > 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// force of one cell of the face, from `low` to `high`
Cell cell_of(const JointLaw& law, double width, const Meeting& m, double low, double high) {
  Cell cell;
  if (!(high > low)) return cell;
  const double breadth = high - low, middle = 0.5 * (low + high), mean = m.overlap(middle);
  if (!(mean > 0)) return cell;
  // the overlap falls off linearly: the centroid of the trapezoid is also the centre of its pressure
  cell.at =
      law.closure == CellClosure::at_centre ? analytic_centre(m) : middle + breadth * breadth / 12 * 2 * m.slope / mean;
  cell.area = breadth * width;
  cell.normal = cell.area * normal_stress(law.normal, law.closure == CellClosure::mean ? mean : m.overlap(cell.at));
  return cell;
}

// The shear force of a cell, N on the right body, after a slip; true: it is at the limit of friction.
bool slide(const JointLaw& law, const Cell& cell, double slip, const CellHistory& was, CellHistory& now) {
  const double stress = cell.normal / cell.area, before = was.area > 0 ? was.stress : stress;
  const double stiffness = 0.5 * (stiffness_at(law.shear, before) + stiffness_at(law.shear, stress)) * cell.area;
  // lost area takes its stress with it; a cell that has just closed has not slipped yet
  now = was;
  now.area = cell.area;
  now.stress = stress;
  if (cell.area < was.area) now.shear *= cell.area / was.area;
  if (was.area > 0) now.shear -= stiffness * slip;

  const double strength = std::tan(law.friction.angle) * cell.normal;
  const double peak = law.friction.peak_slip * std::pow(stress, law.friction.peak_power);
  const auto limit = [&] { return peak > 0 ? strength * -std::expm1(-now.plastic_slip / peak) : strength; };
  const double trial = std::abs(now.shear);
  if (trial > limit() && stiffness > 0) {
    const double slipped = return_slip(trial, stiffness, strength, peak, now.plastic_slip);
    now.plastic_slip += slipped;
    now.shear *= 1 - stiffness * slipped / trial;
  }
  return std::abs(now.shear) > (1 - at_limit) * limit();
}

}  // namespace

double stiffness_at(const StressStiffness& stiffness, double normal_stress) {
  if (stiffness.factor == 0) return stiffness.constant;
  return stiffness.constant + stiffness.factor * std::pow(normal_stress, stiffness.power);
}

double normal_stress(const StressStiffness& k, double overlap) {
  if (!(overlap > 0)) return 0;
  if (k.factor == 0) return k.constant * overlap;
  if (k.power == 1) return k.constant / k.factor * std::expm1(k.factor * overlap);
  if (k.constant == 0 && k.power > 0 && k.power < 1)
    return std::pow((1 - k.power) * k.factor * overlap, 1 / (1 - k.power));
  throw std::invalid_argument("jointed beam: this stiffness has no closed form of the stress");
}

JointForce joint_force(const JointLaw& law, double width, const BeamFace& left, const BeamFace& right,
                       const JointHistory& history, JointHistory& next) {
  if (law.closure == CellClosure::at_centre && law.cells != 1)
    throw std::invalid_argument("jointed beam: the analytic centre is defined for a single cell");
  const Meeting m = meeting(left, right);
  next.slip = m.apart_t;
  next.cells.assign(law.cells, {});
  const bool divides_left = left.height <= right.height;
  const double height = (divides_left ? left : right).height * std::cos(0.5 * (right.turn - left.turn));
  const double bottom = (divides_left ? 0 : m.apart_t) - 0.5 * height, slip = m.apart_t - history.slip;

  JointForce f;
  f.open = std::min(left.height, right.height);
  double turning = 0;  // N m: of the normal forces about the left face's middle
  for (int k = 0; k < law.cells; ++k) {
    const double low = std::max(m.low, bottom + height * k / law.cells);
    const double high = std::min(m.high, bottom + height * (k + 1) / law.cells);
    const Cell cell = cell_of(law, width, m, low, high);
    if (!(cell.area > 0)) continue;
    const CellHistory was = history.cells.empty() ? CellHistory{} : history.cells[k];
    if (slide(law, cell, slip, was, next.cells[k])) f.sliding += cell.normal;
    f.normal += cell.normal;
    f.shear += next.cells[k].shear;
    turning += cell.normal * cell.at;
    f.open -= cell.area / width;
  }
  f.force = f.normal * m.n + f.shear * m.t;
  f.moment = m.middle() * f.shear - turning;
  if (f.normal > 0) f.point = m.middle() * m.n + (turning / f.normal) * m.t;
  return f;
}

}  // namespace voussoir::reference
