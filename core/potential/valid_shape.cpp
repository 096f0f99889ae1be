#include "core/potential/valid_shape.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/potential/rounding.hpp"
#include "core/potential/support.hpp"

namespace voussoir {
namespace {

// planes that meet at less have no corner that matters: their neighbours cut it off
constexpr double flat_corner = 1e-10;

// a corner may lie outside a plane by this fraction of its coordinates
constexpr double corner_rounding = 1e-9;

// normals as read from files with seven digits, as elsewhere
constexpr double unit_tolerance = 1e-6;

// a sphere that is stated with ten digits may cut off their rounding
constexpr double stated_radius = 1e-9;

constexpr int climb_limit = 200;
// of the distance, which a support's rounding cannot resolve further
constexpr double climb_end = 16 * machine_epsilon;

// Calls with every choice of Size different planes.
template <int Size, class Call>
void for_each_choice(int count, Call call) {
  std::array<int, Size> chosen;
  for (int i = 0; i < Size; ++i)
    chosen[i] = i;
  while (Size <= count) {
    call(chosen);
    int k = Size - 1;
    while (k >= 0 && chosen[k] == count - Size + k)
      --k;
    if (k < 0) return;
    ++chosen[k];
    for (int j = k + 1; j < Size; ++j)
      chosen[j] = chosen[j - 1] + 1;
  }
}

template <int Dim>
bool leaves_open(const HalfSpaces<Dim>& planes, const Vector<Dim>& direction) {
  return std::all_of(planes.begin(), planes.end(),
                     [&](const HalfSpace<Dim>& plane) { return plane.normal.dot(direction) <= flat_corner; });
}

// An open set of planes has a ray along an edge, or, if their normals do not span the space, an entire line.
template <int Dim>
bool is_open(const HalfSpaces<Dim>& planes) {
  Matrix<Dim> spread = Matrix<Dim>::Zero();
  for (const HalfSpace<Dim>& plane : planes)
    spread += plane.normal * plane.normal.transpose();
  if (!(spread.determinant() > flat_corner * flat_corner)) return true;
  bool open = false;
  for_each_choice<Dim - 1>(static_cast<int>(planes.size()), [&](const auto& chosen) {
    Vector<Dim> along;
    if constexpr (Dim == 2)
      along = {-planes[chosen[0]].normal[1], planes[chosen[0]].normal[0]};
    else
      along = planes[chosen[0]].normal.cross(planes[chosen[1]].normal);
    if (along.norm() <= flat_corner) return;
    along.normalize();
    open = open || leaves_open<Dim>(planes, along) || leaves_open<Dim>(planes, -along);
  });
  return open;
}

// the corners of the planes moved out by r
template <int Dim>
std::vector<Vector<Dim>> outer_corners(const HalfSpaces<Dim>& planes, double corner_radius) {
  std::vector<Vector<Dim>> corners;
  for_each_choice<Dim>(static_cast<int>(planes.size()), [&](const auto& chosen) {
    Matrix<Dim> rows;
    Vector<Dim> offsets;
    for (int k = 0; k < Dim; ++k) {
      rows.row(k) = planes[chosen[k]].normal.transpose();
      offsets[k] = planes[chosen[k]].offset + corner_radius;
    }
    if (std::abs(rows.determinant()) <= flat_corner) return;
    const Vector<Dim> corner = rows.inverse() * offsets;
    const double room = corner_radius + corner_rounding * (corner.norm() + corner_radius);
    if (std::all_of(planes.begin(), planes.end(),
                    [&](const HalfSpace<Dim>& plane) { return signed_distance<Dim>(plane, corner) <= room; }))
      corners.push_back(corner);
  });
  return corners;
}

// the body of the planes and r alone, seen from its least point
template <int Dim>
PlacedPotential<Dim> planes_alone(const HalfSpaces<Dim>& planes, double corner_radius, const Vector<Dim>& inside,
                                  double reach) {
  PlacedPotential<Dim> potential{planes, 1 / (corner_radius * corner_radius), 0, inside, reach};
  return potential;
}

template <int Dim>
bool is_finite(const PotentialShape<Dim>& shape) {
  const auto plane_is = [](const HalfSpace<Dim>& plane) {
    return plane.normal.allFinite() && std::isfinite(plane.offset);
  };
  return std::isfinite(shape.corner_radius) && std::isfinite(shape.sphericity) && std::isfinite(shape.sphere_radius) &&
         shape.centre.allFinite() && std::all_of(shape.planes.begin(), shape.planes.end(), plane_is);
}

template <int Dim>
ShapeVerdict check_planes(const HalfSpaces<Dim>& planes) {
  if (planes.empty()) return {ShapeProblem::no_planes};
  for (std::size_t i = 0; i < planes.size(); ++i)
    if (!(std::abs(planes[i].normal.norm() - 1) <= unit_tolerance))
      return {ShapeProblem::normal_not_unit, static_cast<int>(i)};
  return is_open<Dim>(planes) ? ShapeVerdict{ShapeProblem::open} : ShapeVerdict{};
}

}  // namespace

template <int Dim>
double enclosing_radius(const HalfSpaces<Dim>& planes, double corner_radius, const Vector<Dim>& centre) {
  if (planes.empty() || is_open<Dim>(planes)) return std::numeric_limits<double>::infinity();
  const std::vector<Vector<Dim>> corners = outer_corners<Dim>(planes, corner_radius);
  double reach = 0;
  for (const Vector<Dim>& corner : corners)
    reach = std::max(reach, (corner - centre).norm());
  RayScratch scratch;
  const PlacedPotential<Dim> from_centre = planes_alone<Dim>(planes, corner_radius, centre, reach);
  const LeastPoint<Dim> least = find_least_point<Dim>({{&from_centre, nullptr}, {1, 0}}, centre, scratch);
  if (!(value<Dim>(from_centre, least.point) < 0)) return 0;

  const PlacedPotential<Dim> rounded = planes_alone<Dim>(planes, corner_radius, least.point, 2 * reach);
  double farthest = 0;
  for (const Vector<Dim>& corner : corners) {
    Vector<Dim> point = corner;
    double distance = 0;
    for (int i = 0; i < climb_limit; ++i) {
      const Vector<Dim> arm = point - centre;
      if (!(arm.norm() > 0)) break;
      point = find_support<Dim>(rounded, arm.normalized(), scratch).point;
      const double now = (point - centre).norm();
      if (now <= distance * (1 + climb_end)) break;
      distance = now;
    }
    farthest = std::max(farthest, distance);
  }
  return farthest;
}

template <int Dim>
ShapeVerdict check_shape(const PotentialShape<Dim>& shape) {
  if (!is_finite<Dim>(shape)) return {ShapeProblem::not_finite};
  if (!(shape.corner_radius > 0)) return {ShapeProblem::corner_radius};
  if (!(shape.sphericity >= 0 && shape.sphericity <= 1)) return {ShapeProblem::sphericity};
  if (!(shape.sphere_radius > 0)) return {ShapeProblem::sphere_radius};
  if (shape.sphericity == 1) return {};
  if (const ShapeVerdict planes = check_planes<Dim>(shape.planes); !planes.ok()) return planes;

  const PlacedPotential<Dim> own = placed<Dim>(shape);
  RayScratch scratch;
  const LeastPoint<Dim> least = find_least_point<Dim>({{&own, nullptr}, {1, 0}}, shape.centre, scratch);
  if (!(value<Dim>(own, least.point) < 0)) return {ShapeProblem::no_inside};
  if (!(value<Dim>(own, own.centre) < 0)) return {ShapeProblem::centre_outside};
  const double enclosing = enclosing_radius<Dim>(shape.planes, shape.corner_radius, shape.centre);
  if (shape.sphere_radius < enclosing * (1 - stated_radius))
    return {ShapeProblem::sphere_does_not_enclose, -1, enclosing};
  return {};
}

template <int Dim>
std::string describe(const ShapeVerdict& verdict, const PotentialShape<Dim>& shape) {
  switch (verdict.problem) {
    case ShapeProblem::none:
      return {};
    case ShapeProblem::not_finite:
      return "a potential particle has a number that is not finite; state planes, r, k and R as finite numbers";
    case ShapeProblem::corner_radius:
      return fmt::format("r = {} m is not allowed: the radius of the corners must be above 0", shape.corner_radius);
    case ShapeProblem::sphericity:
      return fmt::format("k = {} is not allowed: the fraction of the sphere must be 0 to 1", shape.sphericity);
    case ShapeProblem::sphere_radius:
      return fmt::format("R = {} m is not allowed: the radius of the sphere must be above 0", shape.sphere_radius);
    case ShapeProblem::no_planes:
      return fmt::format("k = {} needs planes: state them, or k = 1 for a sphere", shape.sphericity);
    case ShapeProblem::normal_not_unit:
      return fmt::format("plane {} has a normal of length {}: it must be 1", verdict.plane + 1,
                         shape.planes[verdict.plane].normal.norm());
    case ShapeProblem::open:
      return "the planes do not close a region: add the planes that are missing";
    case ShapeProblem::no_inside:
      return "no point lies inside the potential particle: move its planes out, or make r larger";
    case ShapeProblem::centre_outside:
      return "the centre of the sphere lies outside the potential particle: state the planes from an origin within it";
    case ShapeProblem::sphere_does_not_enclose:
      return fmt::format("R = {} m does not enclose the potential particle: its planes and r need {} m or more",
                         shape.sphere_radius, verdict.least);
  }
  return {};
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                            \
  template double enclosing_radius<Dim>(const HalfSpaces<Dim>&, double, const Vector<Dim>&); \
  template ShapeVerdict check_shape<Dim>(const PotentialShape<Dim>&);                        \
  template std::string describe<Dim>(const ShapeVerdict&, const PotentialShape<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
