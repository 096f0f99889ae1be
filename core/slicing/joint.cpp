#include "core/slicing/joint.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace voussoir {
namespace {

// a plane that dips less has no strike that its normal would still tell
constexpr double least_dip = 1e-12;

// a corner that turns by less than this (rad) lies on an edge: far above the rounding of coordinates
constexpr double straight = 1e-9;

// convex corners, counter-clockwise; empty when they are not convex
std::vector<Vector<2>> counter_clockwise(std::vector<Vector<2>> corners) {
  const std::size_t n = corners.size();
  double twice_area = 0, turned = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Vector<2> a = corners[k] - corners[0], b = corners[(k + 1) % n] - corners[0];
    twice_area += a[0] * b[1] - a[1] * b[0];
  }
  if (n < 3 || twice_area == 0) return {};
  if (twice_area < 0) std::reverse(corners.begin(), corners.end());
  for (std::size_t k = 0; k < n; ++k) {
    const Vector<2> in = corners[(k + 1) % n] - corners[k], out = corners[(k + 2) % n] - corners[(k + 1) % n];
    const double turn = std::atan2(in[0] * out[1] - in[1] * out[0], in.dot(out));
    if (in.isZero(0) || turn < -straight || turn > std::numbers::pi - straight) return {};
    turned += turn;
  }
  const bool once = turned < 3 * std::numbers::pi;  // a star turns left at every corner too
  return once ? corners : std::vector<Vector<2>>{};
}

}  // namespace

Eigen::Matrix<double, 3, 2> joint_axes(const Vector<3>& n) {
  const double sine = std::hypot(n[0], n[1]);
  Eigen::Matrix<double, 3, 2> axes;
  axes.col(0) = sine > least_dip ? Vector<3>(-n[1] / sine, n[0] / sine, 0) : Vector<3>(1, 0, 0);
  axes.col(1) = Vector<3>(axes.col(0)).cross(n).normalized();
  return axes;
}

Eigen::Matrix<double, 2, 1> joint_axes(const Vector<2>& n) {
  return n[0] < 0 ? Vector<2>(-n[1], n[0]) : Vector<2>(n[1], -n[0]);
}

Extent<3> polygon_extent(const Vector<3>& normal, const Vector<3>& point, const std::vector<Vector<2>>& stated) {
  Extent<3> extent;
  const std::vector<Vector<2>> corners = counter_clockwise(stated);
  if (corners.empty()) return extent;
  const Eigen::Matrix<double, 3, 2> axes = joint_axes(normal);

  Vector<2> middle = Vector<2>::Zero();
  for (const Vector<2>& c : corners)
    middle += c / static_cast<double>(corners.size());
  extent.centre = point + axes * middle;
  extent.radius = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector<2> edge = corners[(k + 1) % corners.size()] - corners[k];
    const Vector<3> outward = axes * Vector<2>(edge[1], -edge[0]).normalized();
    extent.bounds.push_back({outward, outward.dot(point + axes * corners[k])});
    extent.radius = std::max(extent.radius, (corners[k] - middle).norm());
  }
  return extent;
}

Extent<3> rectangle_extent(const Vector<3>& normal, const Vector<3>& centre, double along_strike, double down_dip) {
  const double a = along_strike / 2, b = down_dip / 2;
  return polygon_extent(normal, centre, {{-a, -b}, {a, -b}, {a, b}, {-a, b}});
}

Extent<3> ellipse_extent(const Vector<3>& normal, const Vector<3>& centre, double along_strike, double down_dip,
                         int sides) {
  // the regular polygon about the unit circle, stretched: tangents stay tangents
  std::vector<Vector<2>> corners;
  const double reach = 1 / std::cos(std::numbers::pi / sides);
  for (int k = 0; k < sides; ++k) {
    const double angle = (2 * k + 1) * std::numbers::pi / sides;
    corners.emplace_back(along_strike / 2 * reach * std::cos(angle), down_dip / 2 * reach * std::sin(angle));
  }
  return polygon_extent(normal, centre, corners);
}

Extent<2> trace_extent(const Vector<2>& normal, const Vector<2>& centre, double length) {
  const Vector<2> axis = joint_axes(normal);
  const double middle = axis.dot(centre);
  return {{{axis, middle + length / 2}, {-axis, length / 2 - middle}}, centre, length / 2};
}

template <int Dim>
void put_in_order(std::vector<Cut<Dim>>& cuts, CuttingOrder order) {
  if (order == CuttingOrder::by_size)
    std::stable_sort(cuts.begin(), cuts.end(),
                     [](const Cut<Dim>& a, const Cut<Dim>& b) { return a.extent.radius > b.extent.radius; });
  if (order != CuttingOrder::alternating) return;
  std::map<int, int> seen;  // joints of each set so far
  std::vector<std::pair<int, std::size_t>> rank;
  for (std::size_t i = 0; i < cuts.size(); ++i)
    rank.emplace_back(seen[cuts[i].set]++, i);
  std::sort(rank.begin(), rank.end());
  std::vector<Cut<Dim>> ordered;
  for (const auto& [round, i] : rank)
    ordered.push_back(cuts[i]);
  cuts = std::move(ordered);
}

template void put_in_order<2>(std::vector<Cut<2>>&, CuttingOrder);
template void put_in_order<3>(std::vector<Cut<3>>&, CuttingOrder);

}  // namespace voussoir
