#include "core/scene/read_joint_sets.hpp"

#include "core/scene/keys.hpp"
#include "core/scene/read_plane.hpp"
#include "core/scene/read_slicing.hpp"

namespace voussoir {
namespace {

void check_intensity(const Subject& item, const JointSet& set) {
  if (set.spacing && set.intensity)
    refuse(item, "intensity", "is stated together with spacing; one follows from the other, remove one");
  if (!set.spacing && !set.intensity)
    refuse(item, "spacing", "a set needs spacing or intensity; write for example spacing = 2 (m)");
  if (set.intensity && item.node->find("persistence"))
    refuse(item, "persistence", "applies to spacing only: intensity already measures the actual joint area; remove it");
}

JointSet read_set(const Subject& item, int dimension) {
  JointSet set;
  read_keys(*item.node, "joint_sets", set);
  const PlaneSpec plane = read_plane(item, "joint_sets", dimension);
  set.dip = plane.dip;
  set.dip_direction = plane.dip_direction;
  check_intensity(item, set);
  if (!set.point.empty() && set.scatter != Scatter::none)
    refuse(item, "point",
           "is stated together with scatter: a joint of random orientation does not pass through a stated point; "
           "remove one of them");

  if (dimension == 2) {
    if (set.scatter == Scatter::fisher)
      refuse(item, "scatter",
             "Fisher's law is a distribution of directions in 3-D but dimension = 2; write \"normal\"");
    for (const char* key : {"shape", "elongation", "dip_direction_deviation_deg"})
      if (item.node->find(key)) refuse(item, key, "has no meaning if dimension = 2: joints are traces; remove it");
  }
  return set;
}

}  // namespace

std::vector<JointSetSpec> read_joint_sets(const Subject& scene, int dimension) {
  std::vector<JointSetSpec> sets;
  for (const Subject& item : children(scene, "joint_sets")) {
    JointSetSpec spec{item, read_set(item, dimension), {}, {}};
    read_keys(*item.node, "joint_sets", spec);
    if (const auto within = child(item, "within")) spec.within = read_region(*within, dimension);
    sets.push_back(std::move(spec));
  }
  return sets;
}

}  // namespace voussoir
