#include "core/scene/domain_blocks.hpp"

#include <algorithm>
#include <map>

#include "core/scene/bodies.hpp"
#include "core/scene/joint_ends.hpp"
#include "core/scene/joint_outline.hpp"
#include "core/scene/region.hpp"
#include "core/slicing/clump.hpp"

namespace voussoir {
namespace {

// sides of the polygon around an ellipse, which is 1.3 % larger
constexpr int ellipse_sides = 16;

template <int Dim>
std::vector<Cut<Dim>> cuts_of(const Scene& scene, const Model<Dim>& model) {
  std::vector<Cut<Dim>> cuts;
  std::map<std::string, int> sets;
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    const JointSpec& joint = scene.joints[j];
    const int number = static_cast<int>(j);
    Cut<Dim> cut{model.joints[j].plane, number};
    const Outline<Dim> outline = outline_of<Dim>(joint, cut.plane.normal, model.origin);
    if (scene.slicing.ends != JointEnds::ignored) cut.extent = extent_of(cut.plane.normal, outline, ellipse_sides);
    if (joint.within)
      for (const HalfSpace<Dim>& bound : region_planes<Dim>(*joint.within, model.origin))
        cut.extent.bounds.push_back(bound);
    // a joint without a set is a set of its own
    cut.set = joint.set.empty() ? number : sets.try_emplace(joint.set, number).first->second;
    cut.kind = joint.kind;
    cut.fixed_side = joint.fixed_side;
    cuts.push_back(std::move(cut));
  }
  put_in_order(cuts, scene.slicing.order);
  return cuts;
}

// construction joints along the region's faces, each confined to its face
template <int Dim>
void add_outline(const Scene& scene, const ExcavationSpec& spec, const HalfSpaces<Dim>& region, Model<Dim>& model,
                 std::vector<Cut<Dim>>& cuts) {
  for (std::size_t f = 0; f < region.size(); ++f) {
    const HalfSpace<Dim>& face = region[f];
    const bool upward = face.normal[Dim - 1] >= 0;
    Cut<Dim> cut{upward ? face : HalfSpace<Dim>{-face.normal, -face.offset}, static_cast<int>(model.joints.size())};
    for (std::size_t other = 0; other < region.size(); ++other)
      if (other != f) cut.extent.bounds.push_back(region[other]);
    cut.kind = JointKind::construction;
    const std::string name = spec.name + " face " + std::to_string(f + 1);
    for (const JointSpec& joint : scene.joints)
      if (joint.name == name)
        refuse(joint.subject, "name", "is also the name of a face of an excavation; choose another name");
    model.joints.push_back({name, cut.plane, model.default_properties, true});
    cuts.push_back(std::move(cut));
  }
}

SlicingLimits limits_of(const Scene& scene) {
  SlicingLimits limits;
  limits.smallest_inscribed_radius = scene.slicing.smallest_inscribed_radius;
  if (scene.slicing.largest_aspect_ratio > 0) limits.largest_aspect_ratio = scene.slicing.largest_aspect_ratio;
  limits.most_blocks = scene.slicing.most_blocks;
  limits.threads = scene.settings.threads;
  return limits;
}

// The body of each part before any excavation, and the size below which its remaining pieces are excavated.
struct Origins {
  std::vector<int> body;      // by remaining part
  std::vector<double> least;  // by body, m: inscribed radius; 0 if it has lost nothing
};

template <int Dim>
Origins origins_of(const std::vector<Polytope<Dim>>& parts, const std::vector<Cut<Dim>>& cuts, bool heal) {
  return {bodies_of<Dim>(parts, cuts, heal), std::vector<double>(parts.size(), 0)};
}

// updates it after `excavated` has removed some of these parts
template <int Dim>
void excavate(const std::vector<Polytope<Dim>>& parts, const HalfSpaces<Dim>& region, double least, Origins& origins) {
  std::vector<int> left;
  for (std::size_t p = 0; p < parts.size(); ++p)
    if (lies_inside<Dim>(region, parts[p].mass.centroid))
      origins.least[origins.body[p]] = std::max(origins.least[origins.body[p]], least);
    else
      left.push_back(origins.body[p]);
  origins.body = std::move(left);
}

bool excavated_by_stage(const Scene& scene, const std::string& name) {
  return std::ranges::any_of(
      scene.stages, [&](const StageSpec& stage) { return std::ranges::count(stage.plan.change.excavate, name) > 0; });
}

}  // namespace

template <int Dim>
std::vector<DomainBody<Dim>> cut_domain(const Scene& scene, Model<Dim>& model) {
  // the cuts: the scene's joints, then the outlines of excavations; joints that end at these, or at others, come after
  // them
  std::vector<Cut<Dim>> cuts = cuts_of<Dim>(scene, model);
  std::vector<HalfSpaces<Dim>> regions;
  std::vector<std::vector<int>> faces;
  for (const ExcavationSpec& spec : scene.excavations) {
    regions.push_back(region_planes<Dim>(spec.region, model.origin));
    faces.emplace_back();
    for (std::size_t f = 0; spec.outline && f < regions.back().size(); ++f)
      faces.back().push_back(static_cast<int>(model.joints.size() + f));
    if (spec.outline) add_outline<Dim>(scene, spec, regions.back(), model, cuts);
  }
  const Polytope<Dim> domain = make_domain<Dim>(scene, model.origin);
  end_cuts<Dim>(scene, domain, model.origin, faces, cuts);

  SlicingCounters counters;
  const SlicingLimits limits = limits_of(scene);
  std::vector<Polytope<Dim>> parts = slice<Dim>(domain, cuts, limits, counters);
  if (counters.given_up)
    refuse({scene.tree.get(), ""}, "joints",
           "cut the domain into more than " + std::to_string(limits.most_blocks) +
               " blocks; state fewer joints, a smaller domain, slicing.smallest_inscribed_radius or a larger "
               "slicing.most_blocks");
  const bool heal = scene.slicing.ends == JointEnds::healed;
  Origins origins{std::vector<int>(parts.size(), 0), {0}};
  if (std::ranges::any_of(scene.excavations, [&](const auto& spec) { return !excavated_by_stage(scene, spec.name); }))
    origins = origins_of<Dim>(parts, cuts, heal);
  for (std::size_t e = 0; e < regions.size(); ++e) {
    const std::size_t before = parts.size();
    const ExcavationSpec& spec = scene.excavations[e];
    const bool in_a_stage = excavated_by_stage(scene, spec.name);
    const double least = spec.smallest_piece.value_or(limits.smallest_inscribed_radius);
    if (in_a_stage)
      model.excavations.push_back({spec.name, regions[e], least});
    else
      excavate<Dim>(parts, regions[e], least, origins);
    std::vector<Polytope<Dim>> left = excavated<Dim>(in_a_stage ? parts : std::move(parts), regions[e]);
    const Subject& subject = spec.region.subject;
    if (left.size() == before)
      refuse(*subject.node, subject.path,
             "excavates no block: no block's centroid is inside; check its position against domain.box and "
             "domain.planes, write outline = "
             "true to cut the blocks along it, or relax the bounds of slicing that leave them uncut");
    if (left.empty())
      refuse(*subject.node, subject.path, "excavates every block of the domain; check its size and position");
    if (!in_a_stage) parts = std::move(left);
  }

  // parts that are held together are one body
  const std::vector<int> body = bodies_of<Dim>(parts, cuts, heal);
  const std::vector<int> whole = boundary_parts<Dim>(parts, cuts);
  std::vector<DomainBody<Dim>> bodies(parts.empty() ? 0 : *std::max_element(body.begin(), body.end()) + 1);
  for (const int part : whole)
    bodies[body[part]].fixed = true;
  // small pieces that an outline leaves of blocks are excavated too; a block that lost nothing stays, however small its
  // parts
  std::vector<char> stays(bodies.size(), false);
  for (std::size_t p = 0; p < parts.size(); ++p)
    if (bodies[body[p]].fixed || parts[p].inscribed_radius >= origins.least[origins.body[p]]) stays[body[p]] = true;
  for (std::size_t p = 0; p < parts.size(); ++p)
    bodies[body[p]].parts.push_back(std::move(parts[p]));
  std::vector<DomainBody<Dim>> left;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (stays[b]) left.push_back(std::move(bodies[b]));
  return left;
}

template std::vector<DomainBody<2>> cut_domain<2>(const Scene&, Model<2>&);
template std::vector<DomainBody<3>> cut_domain<3>(const Scene&, Model<3>&);

}  // namespace voussoir
