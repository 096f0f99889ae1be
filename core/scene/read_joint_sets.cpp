#include "core/scene/read_joint_sets.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/geometry/half_space.hpp"
#include "core/scene/values.hpp"

namespace voussoir {
namespace {

// angles in files are rounded to some digits, a normal beside them is exact
constexpr double same_plane = 1e-4;  // rad
constexpr double unit_within = 1e-6;

// the normal as stated, turned up
std::vector<double> read_normal(const Subject& subject, const PlaneSpec& plane, bool with_dip) {
  std::vector<double> normal;
  read(subject, "normal", normal);
  double square = 0;
  for (const double x : normal)
    square += x * x;
  if (!(std::abs(square - 1) <= 2 * unit_within))
    refuse(subject, "normal",
           fmt::format("must have length 1, has {:.6g}; divide it by its length", std::sqrt(square)));
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
    refuse(subject, "normal", "is that of another plane than dip and dip_direction state; remove one of them");
  return normal;
}

void read_intensity(const Subject& item, JointSet& set) {
  read(item, "spacing", set.spacing);
  read(item, "intensity", set.intensity);
  read(item, "persistence", set.persistence);
  if (set.spacing && set.intensity)
    refuse(item, "intensity", "stands beside spacing; one follows from the other, remove one");
  if (!set.spacing && !set.intensity)
    refuse(item, "spacing", "a set needs spacing or intensity; write for example spacing = 2 (m)");
  if (set.intensity && item.node->find("persistence"))
    refuse(item, "persistence", "belongs to spacing: intensity already counts the joints alone; remove it");
}

JointSet read_set(const Subject& item, int dimension) {
  JointSet set;
  read(item, "name", set.name);
  PlaneSpec plane;
  read_plane(item, dimension, plane);
  set.dip = plane.dip;
  set.dip_direction = plane.dip_direction;

  std::string word = "none";
  read(item, "scatter", word);
  set.scatter = word == "fisher" ? Scatter::fisher : word == "normal" ? Scatter::normal : Scatter::none;
  read(item, "fisher_constant", set.fisher_constant);
  read_degrees(item, "dip_deviation_deg", set.dip_deviation);
  read_degrees(item, "dip_direction_deviation_deg", set.dip_direction_deviation);

  word = "persistent";
  read(item, "size", word);
  set.size_law = word == "constant"      ? SizeLaw::constant
                 : word == "exponential" ? SizeLaw::exponential
                 : word == "lognormal"   ? SizeLaw::lognormal
                                         : SizeLaw::persistent;
  read(item, "size_mean", set.size_mean);
  read(item, "size_deviation", set.size_deviation);
  word = "ellipse";
  read(item, "shape", word);
  set.shape = word == "rectangle" ? OutlineForm::rectangle : OutlineForm::ellipse;
  read(item, "elongation", set.elongation);

  read_intensity(item, set);
  word = "poisson";
  read(item, "arrangement", word);
  set.arrangement = word == "equal" ? Arrangement::equal : Arrangement::poisson;
  long long seed = 0;
  read(item, "seed", seed);
  set.seed = static_cast<std::uint64_t>(seed);

  if (dimension == 2) {
    if (set.scatter == Scatter::fisher)
      refuse(item, "scatter", "Fisher's law is one of directions in space but dimension = 2; write \"normal\"");
    for (const char* key : {"shape", "elongation", "dip_direction_deviation_deg"})
      if (item.node->find(key)) refuse(item, key, "means nothing where dimension = 2: joints are traces; remove it");
  }
  return set;
}

}  // namespace

void read_plane(const Subject& subject, int dimension, PlaneSpec& plane) {
  read(subject, "point", plane.point);
  read_degrees(subject, "dip", plane.dip);
  const bool with_dip = subject.node->find("dip"), with_normal = subject.node->find("normal");
  const bool stated = subject.node->find("dip_direction");
  if (!with_dip && !with_normal)
    refuse(subject, "dip", "angle below the horizontal; write for example dip = 40, or give the plane's normal");
  if (!stated && plane.dip > 0)
    refuse(subject, "dip_direction",
           std::string("a plane that dips needs it; write for example dip_direction = ") +
               (dimension == 2 ? "90 (to the right) or 270 (to the left)" : "130 (clockwise from north)"));
  read_degrees(subject, "dip_direction", plane.dip_direction);
  if (dimension == 2 && stated) {
    const double degrees = subject.node->find("dip_direction")->number;
    if (degrees != 90 && degrees != 270)
      refuse(subject, "dip_direction",
             "must be 90 (dips to the right) or 270 (to the left) because dimension = 2; choose one");
  }
  if (dimension == 2 && !stated) plane.dip_direction = std::numbers::pi / 2;
  if (with_normal) plane.normal = read_normal(subject, plane, with_dip);
}

std::vector<JointSetSpec> read_joint_sets(const Subject& scene, int dimension) {
  std::vector<JointSetSpec> sets;
  for (const Subject& item : children(scene, "joint_sets")) {
    JointSetSpec spec{item, read_set(item, dimension), {}};
    read(item, "properties", spec.properties);
    sets.push_back(std::move(spec));
  }
  return sets;
}

}  // namespace voussoir
