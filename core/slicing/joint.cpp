#include "core/slicing/joint.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace voussoir {

// the lines of Eqs 3.9 and 3.10, turned and moved to the joint: Eqs 3.14 and 3.15
Extent<3> polygon_extent(const Vector<3>& normal, const Vector<3>& point, const std::vector<Vector<2>>& stated) {
  Extent<3> extent;
  const std::vector<Vector<2>> corners = counter_clockwise(stated);
  if (corners.empty()) return extent;
  const PlaneAxes<3> axes = plane_axes(normal);

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
  const Vector<2> axis = plane_axes(normal);
  const double middle = axis.dot(centre);
  return {{{axis, middle + length / 2}, {-axis, length / 2 - middle}}, centre, length / 2};
}

Extent<2> extent_of(const Vector<2>& normal, const Outline<2>& outline, int) {
  if (outline.shape == OutlineForm::none) return {};
  return trace_extent(normal, outline.centre, 2 * outline.half_sizes[0]);
}

Extent<3> extent_of(const Vector<3>& normal, const Outline<3>& outline, int ellipse_sides) {
  const double length = 2 * outline.half_sizes[0], width = 2 * outline.half_sizes[1];
  switch (outline.shape) {
    case OutlineForm::none:
      break;
    case OutlineForm::ellipse:
      return ellipse_extent(normal, outline.centre, length, width, ellipse_sides);
    case OutlineForm::rectangle:
      return rectangle_extent(normal, outline.centre, length, width);
    case OutlineForm::polygon:
      return polygon_extent(normal, outline.centre, outline.corners);
  }
  return {};
}

template <int Dim>
void put_in_order(std::vector<Cut<Dim>>& cuts, CuttingOrder order) {
  if (order == CuttingOrder::given) return;
  // boundary joints leave one side in one piece and come first; construction joints shape the pieces that the others
  // leave
  const auto stage = [](const Cut<Dim>& cut) {
    return cut.kind == JointKind::boundary ? 0 : cut.kind == JointKind::construction ? 2 : 1;
  };
  std::map<int, int> seen;  // joints of each set so far
  std::vector<std::tuple<int, double, int, std::size_t>> rank;
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const double size = order == CuttingOrder::by_size ? cuts[i].extent.radius : 0;
    rank.emplace_back(stage(cuts[i]), -size, seen[cuts[i].set]++, i);
  }
  std::sort(rank.begin(), rank.end());
  std::vector<Cut<Dim>> ordered;
  ordered.reserve(cuts.size());
  for (const auto& entry : rank)
    ordered.push_back(std::move(cuts[std::get<std::size_t>(entry)]));
  cuts = std::move(ordered);
}

template void put_in_order<2>(std::vector<Cut<2>>&, CuttingOrder);
template void put_in_order<3>(std::vector<Cut<3>>&, CuttingOrder);

}  // namespace voussoir
