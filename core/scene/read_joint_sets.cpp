#include "core/scene/read_joint_sets.hpp"

#include "core/scene/read_plane.hpp"
#include "core/scene/read_slicing.hpp"
#include "core/scene/values.hpp"

namespace voussoir {
namespace {

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

std::vector<JointSetSpec> read_joint_sets(const Subject& scene, int dimension) {
  std::vector<JointSetSpec> sets;
  for (const Subject& item : children(scene, "joint_sets")) {
    JointSetSpec spec{item, read_set(item, dimension), {}, {}};
    read(item, "properties", spec.properties);
    if (const auto within = child(item, "within")) spec.within = read_region(*within, dimension);
    sets.push_back(std::move(spec));
  }
  return sets;
}

}  // namespace voussoir
