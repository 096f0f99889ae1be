#include "app/import/imported.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "app/base/dip_angles.hpp"
#include "core/geometry/eigen_pairs.hpp"
#include "text/plain_text.hpp"

namespace voussoir {
namespace {

constexpr double largest_coordinate = 1e12;  // m, of a scene
constexpr std::size_t most_corners = 200;    // of a scene's joint
constexpr std::size_t most_points = 10'000;  // of an outline before its convex hull
constexpr std::size_t longest_name = 200;    // bytes
constexpr double line_width = 1e-6;          // over its length: narrower points have no plane worth the name
constexpr double nearly_straight = 1e-6;     // rad; such a corner would not outlive the rounding of coordinates
constexpr double noticed_growth = 1e-6;      // of an area
constexpr const char* on_a_line = "corners on a line or in a point, which have no plane";

double cross(const Vector<2>& a, const Vector<2>& b) {
  return a[0] * b[1] - a[1] * b[0];
}

double twice_area(const std::vector<Vector<2>>& loop) {
  double sum = 0;
  for (std::size_t k = 1; k + 1 < loop.size(); ++k)
    sum += cross(loop[k] - loop[0], loop[k + 1] - loop[0]);
  return std::abs(sum);
}

// counter-clockwise, from the leftmost (Andrew 1979)
std::vector<Vector<2>> hull_of(std::vector<Vector<2>> points) {
  std::sort(points.begin(), points.end(),
            [](const auto& a, const auto& b) { return a[0] != b[0] ? a[0] < b[0] : a[1] < b[1]; });
  std::vector<Vector<2>> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Vector<2>& p : points) {
      while (hull.size() >= first + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();  // begins the other side
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

double turn_at(const Vector<2>& before, const Vector<2>& corner, const Vector<2>& after) {
  const Vector<2> in = corner - before, out = after - corner;
  return std::atan2(cross(in, out), in.dot(out));
}

std::vector<Vector<2>> without_straight_corners(std::vector<Vector<2>> loop) {
  for (bool changed = true; changed && loop.size() >= 3;) {
    std::vector<Vector<2>> kept;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Vector<2>& before = kept.empty() ? loop.back() : kept.back();
      if (turn_at(before, loop[k], loop[(k + 1) % loop.size()]) > nearly_straight) kept.push_back(loop[k]);
    }
    changed = kept.size() < loop.size();
    loop = std::move(kept);
  }
  return loop;
}

template <int Dim>
JointRow row_of(const Vector<Dim>& normal, const Vector<Dim>& point) {
  JointRow row;
  const DipAndDirection angles = angles_of(normal);
  row.dip_deg = angles.dip;
  row.dip_direction_deg = angles.direction;
  row.normal = {normal.data(), normal.data() + Dim};
  row.point = {point.data(), point.data() + Dim};
  return row;
}

// with '.' or '=' no --set could address it
std::string as_name(const std::string& text) {
  std::string name = one_line(text, longest_name);
  for (char& c : name)
    if (c == '.' || c == '=') c = '-';
  return name;
}

}  // namespace

std::optional<StatedPlane> fitted_plane(const std::vector<Vector<3>>& points) {
  if (points.size() < 3) return std::nullopt;
  Vector<3> mean = Vector<3>::Zero();
  for (const Vector<3>& p : points)
    mean += (p - points[0]) / static_cast<double>(points.size());
  const Vector<3> centre = points[0] + mean;
  double reach = 0;
  for (const Vector<3>& p : points)
    reach = std::max(reach, (p - centre).norm());
  if (!(reach > 0)) return std::nullopt;
  Matrix<3> moments = Matrix<3>::Zero();
  for (const Vector<3>& p : points) {
    const Vector<3> arm = (p - centre) / reach;
    moments += arm * arm.transpose();
  }
  const EigenPairs<3> own = eigen_pairs<3>(moments);
  const double width = own.values[1], length = own.values[2];
  if (!(width > line_width * line_width * length)) return std::nullopt;
  const Vector<3> normal = own.vectors.col(0).normalized();
  return StatedPlane{normal[2] < 0 ? Vector<3>(-normal) : normal, centre};
}

void JointCollector::polygon(const JointSource& origin, const std::vector<Vector<3>>& corners,
                             const std::optional<StatedPlane>& stated) {
  found_.work += static_cast<long long>(corners.size());
  if (corners.size() < 3) return drop(origin.line, "fewer than three corners, which have no plane");
  if (corners.size() > most_points)
    return drop(origin.line, fmt::format("more than {} corners; simplify the outline", most_points));
  const std::optional<StatedPlane> plane = stated ? stated : fitted_plane(corners);
  if (!plane) return drop(origin.line, on_a_line);

  const PlaneAxes<3> axes = plane_axes(plane->normal);
  std::vector<Vector<2>> flat;
  double out_of_plane = 0;
  for (const Vector<3>& corner : corners) {
    const Vector<3> arm = corner - plane->centre;
    flat.emplace_back(axes.transpose() * arm);
    out_of_plane = std::max(out_of_plane, std::abs(plane->normal.dot(arm)));
  }
  const std::vector<Vector<2>> outline = without_straight_corners(hull_of(flat));
  if (outline.size() < 3) return drop(origin.line, on_a_line);
  if (outline.size() > most_corners)
    return drop(origin.line, fmt::format("a convex outline of more than {} corners; simplify it", most_corners));

  JointRow row = row_of<3>(plane->normal, plane->centre);
  row.shape = OutlineForm::polygon;
  std::vector<Vector<2>> written;  // as a scene sees the corners when they are read back
  for (const Vector<2>& corner : outline) {
    const Vector<3> place = plane->centre + axes * corner;
    row.corners.push_back({place[0], place[1], place[2]});
    written.emplace_back(axes.transpose() * (place - plane->centre));
  }
  if (counter_clockwise(written).empty())
    return drop(origin.line, "an outline too small for the digits of its coordinates; give a --shift to the origin");
  const double growth = twice_area(outline) / std::max(twice_area(flat), noticed_growth * twice_area(outline)) - 1;
  if (growth > noticed_growth) {
    ++not_convex_;
    largest_growth_ = std::max(largest_growth_, growth);
  }
  add(origin, std::move(row), out_of_plane);
}

void JointCollector::ellipse(const JointSource& origin, const StatedPlane& plane, double along_strike,
                             double down_dip) {
  if (!(along_strike > 0 && down_dip > 0)) return drop(origin.line, "an extent of 0");
  JointRow row = row_of<3>(plane.normal, plane.centre);
  row.shape = OutlineForm::ellipse;
  row.extents = {along_strike, down_dip};
  add(origin, std::move(row), std::nullopt);
}

void JointCollector::trace(const JointSource& origin, const Vector<2>& from, const Vector<2>& to) {
  const Vector<2> along = to - from;
  const double length = along.norm();
  if (!(length > 0)) return drop(origin.line, "a segment without length");
  const Vector<2> across = Vector<2>(-along[1], along[0]) / length;
  JointRow row = row_of<2>(across[1] < 0 ? Vector<2>(-across) : across, from + along / 2);
  row.shape = OutlineForm::rectangle;
  row.extents = {length};
  add(origin, std::move(row), std::nullopt);
}

void JointCollector::add(const JointSource& origin, JointRow row, std::optional<double> out_of_plane) {
  if (found_.joints.size() == most_table_joints)
    throw FileFault(
        origin.line, 0,
        fmt::format("more than {} joints, the most that a scene can have; divide the file", most_table_joints));
  row.line = origin.line;
  row.name = free_name(as_name(origin.name));
  row.set = as_name(origin.set);
  found_.joints.push_back(std::move(row));
  found_.out_of_plane.push_back(out_of_plane);
}

std::string JointCollector::free_name(const std::string& wanted) {
  std::string name = wanted;
  while (!names_.insert(name).second) {
    name = fmt::format("{}-{}", wanted, ++repeated_.try_emplace(wanted, 1).first->second);
    ++found_.work;
  }
  ++found_.work;
  return name;
}

ImportedJoints JointCollector::finish() {
  if (found_.joints.empty())
    throw FileFault(found_.dropped.empty() ? 1 : found_.dropped[0].line, 0,
                    found_.dropped.empty() ? "has no joint; is it a file of this kind?"
                                           : fmt::format("has no usable joint; {} dropped, the first for {}",
                                                         found_.dropped.size(), found_.dropped[0].reason));
  if (not_convex_ > 0)
    remark(fmt::format("{} outlines are not convex: their convex hulls were used, up to {:.3g} % larger", not_convex_,
                       100 * largest_growth_));
  return std::move(found_);
}

void refuse_far_coordinate(double coordinate, int line, int column) {
  if (std::abs(coordinate) > largest_coordinate)
    throw FileFault(line, column, "the coordinate exceeds 1e12 m; is it in m?");
}

double coordinate_of(const Word& word, const std::string& what) {
  const double x = number_of(word, what);
  refuse_far_coordinate(x, word.line, word.column);
  return x;
}

std::string upper_case(std::string_view text) {
  std::string upper(text);
  std::transform(upper.begin(), upper.end(), upper.begin(), [](unsigned char c) { return std::toupper(c); });
  return upper;
}

}  // namespace voussoir
