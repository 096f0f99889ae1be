#include "core/scene/linings.hpp"

#include <algorithm>
#include <numbers>

#include "core/scene/keys.hpp"
#include "core/scene/region.hpp"
#include "core/slicing/block.hpp"
#include "text/plain_text.hpp"

namespace voussoir {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;

const ExcavationSpec& excavation_of(const Scene& scene, const LiningSpec& spec) {
  std::vector<std::string> names;
  for (const ExcavationSpec& excavation : scene.excavations) {
    if (excavation.name != spec.excavation) {
      names.push_back(excavation.name);
      continue;
    }
    if (!excavation.outline)
      refuse(spec.subject, "excavation",
             "is not cut along its outline, so that there is no face against which a lining could be cast; write "
             "outline = true in the "
             "excavation");
    return excavation;
  }
  refuse(spec.subject, "excavation",
         names.empty() ? "there are no excavations; add [[excavations]] with a name, a region and outline = true"
                       : "no excavation has this name; " + suggestion(spec.excavation, names));
}

template <int Dim>
int interface_of(const Model<Dim>& model, const LiningSpec& spec) {
  std::vector<std::string> names;
  for (std::size_t p = 0; p < model.properties.size(); ++p) {
    const JointProperties& properties = model.properties[p];
    names.push_back(properties.name);
    if (properties.name != spec.interface_properties) continue;
    if (properties.constant_stiffness)
      refuse(
          spec.subject, "joint_properties",
          "has constant_stiffness, but a lining's interface needs stiffness per area; give it properties of its own");
    if (properties.laws.depends_on_stress())
      refuse(spec.subject, "joint_properties",
             "has a stiffness that depends on stress, but a lining's interface needs a constant one; give it "
             "properties of its own");
    if (properties.states_barton_bandis())
      refuse(
          spec.subject, "joint_properties",
          "has Barton and Bandis' friction, but a lining's interface needs Coulomb's; give it properties of its own");
    if (properties.dilates())
      refuse(spec.subject, "joint_properties",
             "dilates, which a lining's interface does not; give it properties of its own");
    return static_cast<int>(p);
  }
  refuse(spec.subject, "joint_properties",
         names.empty() ? "there are no joint_properties; add [[joint_properties]] for the interface"
                       : "no joint_properties of this name; " + suggestion(spec.interface_properties, names));
}

// the sides of a convex region, counter-clockwise
std::vector<LiningSide> sides_of(const Polytope<2>& outline) {
  const std::vector<int> ring = boundary_ring(outline);
  std::vector<LiningSide> sides;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vector<2>&a = outline.vertices[ring[k]], &b = outline.vertices[ring[(k + 1) % ring.size()]];
    const double length = (b - a).norm();
    const Vector<2> along = (b - a) / length;
    sides.push_back({.corner = a, .normal = {along[1], -along[0]}, .length = length});
  }
  return sides;
}

std::vector<double> turns_of(const LiningSpec& spec) {
  const double from = spec.from.value_or(0);
  const double step = spec.to ? (*spec.to - from) / (spec.nodes - 1) : full_turn / spec.nodes;
  std::vector<double> turns;
  for (int k = 0; k < spec.nodes; ++k)
    turns.push_back(from + k * step);
  return turns;
}

Lining lining_of(const Scene& scene, const LiningSpec& spec, const Model<2>& model) {
  const ExcavationSpec& excavation = excavation_of(scene, spec);
  const HalfSpaces<2> region = region_planes<2>(excavation.region, model.origin);
  const BlockResult<2> outline = make_block<2>(region, std::vector<int>(region.size(), no_joint));
  if (outline.status != BlockStatus::ok)
    refuse(spec.subject, "excavation",
           "has no closed outline that a lining could follow; bound it on all sides, by a cylinder, a box or planes");
  Lining lining = make_lining(spec.properties, sides_of(outline.part), outline.part.mass.centroid, turns_of(spec),
                              !spec.to.has_value());
  lining.interface_properties = interface_of(model, spec);
  return lining;
}

LiningSpec read_lining(const Subject& item) {
  LiningSpec spec;
  spec.subject = item;
  read_keys(*item.node, "linings", spec);
  read_keys(*item.node, "linings", spec.properties);
  if (spec.to && !spec.from)
    refuse(item, "to_deg", "from_deg is missing: a lining that is not a ring needs both its ends; add it");
  if (spec.to && !(*spec.to > *spec.from && *spec.to - *spec.from < full_turn))
    refuse(item, "to_deg",
           "must be beyond from_deg (" + value_text(*item.node->find("from_deg")) +
               "), counter-clockwise, by less than 360; for a ring leave to_deg out");
  const LiningProperties& p = spec.properties;
  if (p.compressive_strength.has_value() != p.tensile_strength.has_value()) {
    const bool first = p.compressive_strength.has_value();
    refuse(item, first ? "compressive_strength" : "tensile_strength",
           std::string(first ? "tensile_strength" : "compressive_strength") +
               " is missing: the utilisation needs both strengths; add it");
  }
  return spec;
}

}  // namespace

void read_linings(const Subject& top, Scene& scene) {
  for (const Subject& item : children(top, "linings")) {
    if (scene.dimension == 3)
      refuse(item, "name", "applies only if dimension = 2: linings are plane beams; remove [[linings]]");
    scene.linings.push_back(read_lining(item));
  }
}

template <int Dim>
void add_linings(const Scene& scene, Model<Dim>& model) {
  if constexpr (Dim == 2) {
    for (const LiningSpec& spec : scene.linings)
      model.linings.push_back(lining_of(scene, spec, model));
    std::ranges::sort(model.linings, {}, [](const Lining& lining) { return lining.properties.name; });
  }
}

template void add_linings<2>(const Scene&, Model<2>&);
template void add_linings<3>(const Scene&, Model<3>&);

}  // namespace voussoir
