#include "core/scene/read_slicing.hpp"

#include "core/scene/keys.hpp"
#include "core/scene/read_plane.hpp"

namespace voussoir {
namespace {

std::vector<DomainPlaneSpec> read_planes(const Subject& region, int dimension) {
  std::vector<DomainPlaneSpec> planes;
  for (const Subject& item : children(region, "planes")) {
    DomainPlaneSpec plane{item, read_plane(item, "domain.planes", dimension), true};
    read_keys(*item.node, "domain.planes", plane);
    planes.push_back(plane);
  }
  return planes;
}

OutlineSpec read_outline(const Subject& item, int dimension) {
  const Node* shape = item.node->find("shape");
  if (shape && shape->text != "infinite" && (shape->text == "trace") != (dimension == 2))
    refuse(item, "shape",
           dimension == 2 ? "cannot be in a plane because dimension = 2; write shape = \"trace\" and its length"
                          : "is for 2-D but dimension = 3; write \"rectangle\", \"ellipse\" or \"polygon\"");
  OutlineSpec outline;
  read_keys(*item.node, "joints", outline);
  return outline;
}

CylinderSpec read_cylinder(const Subject& subject, int dimension) {
  CylinderSpec cylinder;
  cylinder.subject = subject;
  read_keys(*subject.node, "cylinder", cylinder);
  if (dimension == 2 && !cylinder.to.empty())
    refuse(subject, "to", "the region is a circle with a centre only because dimension = 2; remove it");
  if (dimension == 3 && (cylinder.to.empty() || cylinder.to == cylinder.from))
    refuse(subject, "to", "a tunnel needs the other end of its axis; write for example to = [0, 10, 0]");
  return cylinder;
}

}  // namespace

BoxSpec read_box(const Subject& subject) {
  BoxSpec box{subject, {}, {}};
  read_keys(*subject.node, "box", box);
  for (std::size_t k = 0; k < box.min.size(); ++k)
    if (!(box.max[k] > box.min[k]))
      refuse(subject, "max",
             std::string("must exceed min along ") + "xyz"[k] + " (" + value_text(*subject.node->find("min")) +
                 "); swap the two or move a corner");
  return box;
}

std::optional<DomainSpec> read_domain(const Subject& scene, int dimension) {
  const auto subject = child(scene, "domain");
  if (!subject) return {};
  DomainSpec domain{*subject, {}, {}};
  if (const auto box = child(*subject, "box")) domain.box = read_box(*box);
  domain.planes = read_planes(*subject, dimension);
  if (!domain.box && domain.planes.empty())
    refuse(*subject, "box",
           "a domain needs a box, planes or both; write for example box = { min = [-4, -4, -4], max = [4, 4, 0] }");
  return domain;
}

std::vector<JointSpec> read_joints(const Subject& scene, int dimension) {
  std::vector<JointSpec> joints;
  for (const Subject& item : children(scene, "joints")) {
    JointSpec joint;
    joint.subject = item;
    read_keys(*item.node, "joints", joint);
    joint.plane = read_plane(item, "joints", dimension);
    joint.outline = read_outline(item, dimension);
    if (const auto within = child(item, "within")) joint.within = read_region(*within, dimension);
    if (!joint.ends_at.empty() && joint.kind == JointKind::boundary)
      refuse(item, "ends_at",
             "is stated together with kind = \"boundary\", but a boundary joint does not end; remove one of the two");
    joints.push_back(std::move(joint));
  }
  return joints;
}

RegionSpec read_region(const Subject& subject, int dimension) {
  RegionSpec region;
  region.subject = subject;
  if (const auto box = child(subject, "box")) region.box = read_box(*box);
  if (const auto cylinder = child(subject, "cylinder")) region.cylinder = read_cylinder(*cylinder, dimension);
  region.planes = read_planes(subject, dimension);
  if (region.box && region.cylinder)
    refuse(subject, "box", "a region takes only one of box and cylinder; remove one, or state two regions");
  if (!region.box && !region.cylinder && region.planes.empty())
    refuse(
        subject, "box",
        "a region needs a box, a cylinder or planes; write for example box = { min = [-1, -1, -1], max = [1, 1, 1] }");
  return region;
}

std::vector<ExcavationSpec> read_excavations(const Subject& scene, int dimension) {
  std::vector<ExcavationSpec> all;
  for (const Subject& item : children(scene, "excavations")) {
    ExcavationSpec spec;
    read_keys(*item.node, "excavations", spec);
    spec.region = read_region(item, dimension);
    all.push_back(std::move(spec));
  }
  return all;
}

}  // namespace voussoir
