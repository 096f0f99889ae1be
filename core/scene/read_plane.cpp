#include "core/scene/read_plane.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/geometry/half_space.hpp"
#include "core/scene/keys.hpp"

namespace voussoir {
namespace {

// angles in files are rounded to a few digits, a normal stated with them is exact
constexpr double same_plane = 1e-4;  // rad

// the normal as stated, turned up
std::vector<double> upward_normal(const Subject& subject, const PlaneSpec& plane, bool with_dip) {
  std::vector<double> normal = plane.normal;
  const double square = squared_length(normal);
  if (!is_unit(square))
    refuse(subject, "normal",
           fmt::format("must have length 1, but has {:.6g}; divide it by its length", std::sqrt(square)));
  if (normal.back() < 0)
    for (double& x : normal)
      x = -x;
  if (!with_dip) return normal;
  const Vector<3> in_space = upward_normal_3d(plane.dip, plane.dip_direction);
  const Vector<2> in_plane = upward_normal_2d(plane.dip, plane.dip_direction);
  double cosine = 0;
  for (std::size_t k = 0; k < normal.size(); ++k)
    cosine += normal[k] * (normal.size() == 3 ? in_space[k] : in_plane[k]);
  if (!(1 - std::abs(cosine) <= same_plane * same_plane))
    refuse(subject, "normal", "does not agree with dip and dip_direction; remove one of them");
  return normal;
}

}  // namespace

PlaneSpec read_plane(const Subject& subject, std::string_view group, int dimension) {
  PlaneSpec plane;
  read_keys(*subject.node, group, plane);
  const bool with_dip = subject.node->find("dip"), with_normal = subject.node->find("normal");
  const bool stated = subject.node->find("dip_direction");
  if (!with_dip && !with_normal)
    refuse(subject, "dip", "angle below the horizontal; write for example dip = 40, or give the plane's normal");
  if (!stated && plane.dip > 0)
    refuse(subject, "dip_direction",
           std::string("a plane that dips needs it; write for example dip_direction = ") +
               (dimension == 2 ? "90 (to the right) or 270 (to the left)" : "130 (clockwise from north)"));
  if (dimension == 2 && stated) {
    const double degrees = subject.node->find("dip_direction")->number;
    if (degrees != 90 && degrees != 270)
      refuse(subject, "dip_direction",
             "must be 90 (dips to the right) or 270 (to the left) because dimension = 2; choose one");
  }
  if (dimension == 2 && !stated) plane.dip_direction = std::numbers::pi / 2;
  if (with_normal) plane.normal = upward_normal(subject, plane, with_dip);
  return plane;
}

}  // namespace voussoir
