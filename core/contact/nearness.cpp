#include "core/contact/nearness.hpp"

#include <algorithm>
#include <limits>

#include "core/contact/rounding.hpp"
#include "core/contact/separation.hpp"

namespace voussoir {
namespace {

// of a gap, as a fraction of the pair's size: two that were found at different times may differ by as much
constexpr double gap_rounding = 64 * std::numeric_limits<double>::epsilon();

template <int Dim>
double pair_size(const Pair<Dim>& pair) {
  return pair.a->radius + pair.b->radius + pair.offset.norm();
}

template <int Dim>
double near_within(const Pair<Dim>& pair) {
  return std::min(pair.a->inscribed_radius, pair.b->inscribed_radius);
}

// The pair in the frame of the second part.
template <int Dim>
Pair<Dim> seen_from_second(const Pair<Dim>& pair) {
  return {pair.b,
          pair.a,
          pair.axes * pair.rotation,
          pair.rotation.transpose(),
          -(pair.rotation.transpose() * pair.offset),
          pair.level};
}

// The largest gap of the second part behind a face of the first, rounding included.
template <int Dim>
double widest_gap(const Pair<Dim>& pair) {
  const HalfSpaces<Dim>& faces = pair.a->faces;
  const Vector<Dim> centre = pair.offset + pair.rotation * pair.b->centre;
  // the second part's inscribed ball bounds each gap from above: few faces need its vertices
  const auto bound = [&](const HalfSpace<Dim>& face) {
    return signed_distance(face, centre) - pair.b->inscribed_radius;
  };
  std::size_t first = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (const double upper = bound(faces[i]); upper > most) {
      most = upper;
      first = i;
    }
  if (faces.empty()) return most;
  double widest = gap_behind(pair, faces[first].normal, faces[first].offset);
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (i != first && bound(faces[i]) > widest)
      widest = std::max(widest, gap_behind(pair, faces[i].normal, faces[i].offset));
  return widest;
}

// Bound of the change of a gap behind a face of the first part, by the motion of the bodies' farthest points: a plane
// that turns moves more at the second part than at the first. `way` bounds that motion.
template <int Dim>
double lever(const Pair<Dim>& pair, double radius_a, double way) {
  return std::max(1.0, (pair.offset.norm() + pair.b->radius + way) / radius_a) / downwards;
}

// The motion of bodies before the widest gap behind a face of the first part, `distance` away from a bound, crosses it.
// A sliver's vertices may be useless, so that the distance is infinite.
template <int Dim>
double way_to_bound(const Pair<Dim>& pair, double radius_a, double distance) {
  const double way = std::min(distance, pair_size(pair));
  return std::max(0.0, way - gap_rounding * pair_size(pair)) / lever(pair, radius_a, way) * downwards;
}

}  // namespace

template <int Dim>
Nearness nearness(const Pair<Dim>& pair, double radius_a, double radius_b) {
  const double within = near_within(pair);
  const Pair<Dim> turned = seen_from_second(pair);
  const double behind_a = widest_gap(pair) - within, behind_b = widest_gap(turned) - within;
  if (behind_a > 0 || behind_b > 0)
    return {false, std::max(behind_a > 0 ? way_to_bound(pair, radius_a, behind_a) : 0,
                            behind_b > 0 ? way_to_bound(turned, radius_b, behind_b) : 0)};
  return {true, std::min(way_to_bound(pair, radius_a, -behind_a), way_to_bound(turned, radius_b, -behind_b))};
}

template <int Dim>
bool may_come_near(const Pair<Dim>& pair, double radius_a, double radius_b, double way) {
  const auto kept_apart = [&](const Pair<Dim>& seen, double radius) {
    const double needed = 2 * way * lever(seen, radius, 2 * way) + gap_rounding * pair_size(seen);
    return (widest_gap(seen) - near_within(seen)) * downwards > needed;
  };
  return !kept_apart(pair, radius_a) && !kept_apart(seen_from_second(pair), radius_b);
}

template Nearness nearness<2>(const Pair<2>&, double, double);
template Nearness nearness<3>(const Pair<3>&, double, double);
template bool may_come_near<2>(const Pair<2>&, double, double, double);
template bool may_come_near<3>(const Pair<3>&, double, double, double);

}  // namespace voussoir
