#include "core/joint_sets/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace voussoir {
namespace {

// lines along each side of their bundle: enough that a few joints are met many times, few enough to cost nothing
constexpr int lines_per_side = 8;

// An intensity, summed over the joints.
class Intensity {
 public:
  void add(double x) {
    sum_ += x;
    squares_ += x * x;
  }
  Estimate over(double extent) const {
    if (!(extent > 0)) return {};
    return {sum_ / extent, std::sqrt(squares_) / extent};
  }

 private:
  double sum_ = 0, squares_ = 0;
};

template <int Dim>
Vector<Dim> mean_normal(const JointSet& set) {
  if constexpr (Dim == 3)
    return upward_normal_3d(set.dip, set.dip_direction);
  else
    return upward_normal_2d(set.dip, set.dip_direction);
}

template <int Dim>
struct Scanline {
  Vector<Dim> start;
  std::array<double, 2> stretch;  // inside the domain
  std::vector<double> hits;
};

// The places of lines along a side of the domain's projection: the middles of equal intervals.
template <int Dim>
std::vector<Vector<Dim>> places_along(const Vector<Dim>& side, const Polytope<Dim>& domain) {
  double low = side.dot(domain.vertices[0]), high = low;
  for (const Vector<Dim>& v : domain.vertices) {
    low = std::min(low, side.dot(v));
    high = std::max(high, side.dot(v));
  }
  std::vector<Vector<Dim>> places;
  for (int i = 0; i < lines_per_side; ++i)
    places.push_back((low + (high - low) * (i + 0.5) / lines_per_side) * side);
  return places;
}

// parallel lines through the domain, in a rectangular lattice across its projection
template <int Dim>
std::vector<Scanline<Dim>> scanlines(const Vector<Dim>& direction, const Polytope<Dim>& domain) {
  const Vector<Dim> side = perpendicular(direction);
  std::vector<Vector<Dim>> across{Vector<Dim>::Zero()};
  if constexpr (Dim == 3) across = places_along<3>(direction.cross(side), domain);
  std::vector<Scanline<Dim>> lines;
  for (const Vector<Dim>& along : places_along<Dim>(side, domain))
    for (const Vector<Dim>& more : across) {
      const Vector<Dim> start = along + more;
      if (const auto stretch = stretch_inside<Dim>(start, direction, domain.faces))
        lines.push_back({start, *stretch, {}});
    }
  return lines;
}

template <int Dim>
void scan(const JointSet& set, const std::vector<DrawnJoint<Dim>>& joints, const Polytope<Dim>& domain,
          const Vector<Dim>& origin, SetStatistics<Dim>& found) {
  const Vector<Dim> direction = mean_normal<Dim>(set);
  std::vector<Scanline<Dim>> lines = scanlines<Dim>(direction, domain);
  for (const Scanline<Dim>& line : lines)
    found.scanned += line.stretch[1] - line.stretch[0];
  Intensity frequency;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (found.measures[i] == 0) continue;
    const HalfSpace<Dim> plane = plane_of(joints[i], origin);
    const Outline<Dim> outline = outline_from(joints[i], origin);
    const double speed = plane.normal.dot(direction);
    int met = 0;
    for (Scanline<Dim>& line : lines) {
      if (speed == 0) break;
      const double at = -signed_distance<Dim>(plane, line.start) / speed;
      if (at < line.stretch[0] || at > line.stretch[1] || !contains<Dim>(outline, line.start + at * direction))
        continue;
      line.hits.push_back(at);
      ++met;
    }
    frequency.add(met);
  }
  found.frequency = frequency.over(found.scanned);
  found.stated_frequency = found.stated_intensity * mean_projection<Dim>(set);
  for (Scanline<Dim>& line : lines) {
    std::sort(line.hits.begin(), line.hits.end());
    for (std::size_t k = 1; k < line.hits.size(); ++k)
      found.spacings.push_back(line.hits[k] - line.hits[k - 1]);
  }
  std::sort(found.spacings.begin(), found.spacings.end());
}

// the section of a solid by the plane through `centre` normal to an axis
Polytope<3> section(const Polytope<3>& solid, const Vector<3>& centre, int axis, double half_thickness) {
  Polytope<3> slab = solid;
  const Vector<3> normal = Vector<3>::Unit(axis);
  slab.faces.push_back({normal, normal.dot(centre) + half_thickness});
  slab.faces.push_back({-normal, -normal.dot(centre) + half_thickness});
  return slab;
}

// Traces on three sections. A thin slab turns area into length: a joint's area in it over its thickness, times the sine
// of the angle between joint and section, is the trace, exact unless an end or an edge is within the slab.
void measure_traces(const std::vector<DrawnJoint<3>>& joints, const Vector<3>& centre, double radius,
                    const Polytope<3>& domain, const Vector<3>& origin, SetStatistics<3>& found) {
  constexpr double thickness_over_radius = 1e-6;
  const double half = thickness_over_radius * radius;
  for (int axis = 0; axis < 3; ++axis) {
    const Polytope<3> slab = section(domain, centre, axis, half);
    HalfSpace<3> plane{Vector<3>::Unit(axis), centre[axis]};
    const double area = measure_inside(plane, Outline<3>{}, domain);
    Intensity traces;
    double sines = 0;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const double sine = joints[i].normal.cross(plane.normal).norm();
      sines += sine;
      if (found.measures[i] == 0) continue;
      traces.add(sine * measure_inside(plane_of(joints[i], origin), outline_from(joints[i], origin), slab) /
                 (2 * half));
    }
    found.traces.push_back(traces.over(area));
    found.stated_traces.push_back(joints.empty() ? 0
                                                 : found.stated_intensity * sines / static_cast<double>(joints.size()));
  }
}

// of the poles of the joints inside, each taken to the mean's side
void measure_scatter(const JointSet& set, const std::vector<DrawnJoint<3>>& joints, SetStatistics<3>& found) {
  const Vector<3> mean = mean_normal<3>(set);
  Vector<3> sum = Vector<3>::Zero();
  for (std::size_t i = 0; i < joints.size(); ++i)
    if (found.measures[i] > 0) sum += joints[i].normal.dot(mean) < 0 ? Vector<3>(-joints[i].normal) : joints[i].normal;
  const auto n = static_cast<double>(found.inside);
  // parallel joints: the difference is the sum's rounding
  constexpr double rounding = 1e-12;
  const double fall = n - sum.norm();
  if (n < 2 || fall <= rounding * n) return;
  const double constant = (n - 1) / fall;
  found.fisher_constant = {constant, constant / std::sqrt(n - 1)};
}

template <int Dim>
bool is_inside(const Polytope<Dim>& domain, const Vector<Dim>& point) {
  return std::all_of(domain.faces.begin(), domain.faces.end(),
                     [&](const HalfSpace<Dim>& face) { return signed_distance<Dim>(face, point) <= 0; });
}

}  // namespace

template <int Dim>
SetStatistics<Dim> measure(const JointSet& set, const std::vector<DrawnJoint<Dim>>& joints, const Ball<Dim>& ball,
                           const Polytope<Dim>& domain, const Vector<Dim>& origin) {
  SetStatistics<Dim> found;
  found.stated_intensity = stated_intensity<Dim>(set);
  Intensity intensity;
  std::vector<double> sizes;
  for (const DrawnJoint<Dim>& joint : joints) {
    const double inside = measure_inside(plane_of(joint, origin), outline_from(joint, origin), domain);
    found.measures.push_back(inside);
    found.inside += inside > 0 ? 1 : 0;
    intensity.add(inside);
    if (joint.size > 0 && is_inside<Dim>(domain, joint.point - origin)) sizes.push_back(joint.size);
  }
  found.intensity = intensity.over(domain.mass.volume);
  found.centred = static_cast<long long>(sizes.size());
  const Moments moments = moments_of(sizes);
  found.size = moments.mean;
  found.size_deviation = moments.deviation;

  scan<Dim>(set, joints, domain, origin, found);
  if constexpr (Dim == 3) {
    measure_traces(joints, ball.centre - origin, ball.radius, domain, origin, found);
    measure_scatter(set, joints, found);
  }
  return found;
}

Moments moments_of(const std::vector<double>& sample) {
  Moments moments;
  if (sample.empty()) return moments;
  const auto n = static_cast<double>(sample.size());
  moments.mean.value = std::accumulate(sample.begin(), sample.end(), 0.0) / n;
  if (sample.size() < 2) return moments;
  double squares = 0;
  for (const double x : sample)
    squares += (x - moments.mean.value) * (x - moments.mean.value);
  moments.deviation = std::sqrt(squares / (n - 1));
  moments.mean.error = moments.deviation / std::sqrt(n);
  return moments;
}

double size_at_fraction(const std::vector<double>& ascending, double fraction) {
  const double total = std::accumulate(ascending.begin(), ascending.end(), 0.0);
  double sum = 0;
  for (const double x : ascending)
    if ((sum += x) >= fraction * total) return x;
  return ascending.empty() ? 0 : ascending.back();
}

template SetStatistics<2> measure<2>(const JointSet&, const std::vector<DrawnJoint<2>>&, const Ball<2>&,
                                     const Polytope<2>&, const Vector<2>&);
template SetStatistics<3> measure<3>(const JointSet&, const std::vector<DrawnJoint<3>>&, const Ball<3>&,
                                     const Polytope<3>&, const Vector<3>&);

}  // namespace voussoir
