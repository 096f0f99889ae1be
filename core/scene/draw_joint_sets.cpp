#include "core/scene/draw_joint_sets.hpp"

#include <fmt/format.h>

#include <set>

#include "core/scene/bodies.hpp"
#include "core/scene/region.hpp"
#include "core/slicing/block.hpp"

namespace voussoir {
namespace {

// some 400 MB of joints, drawn in seconds; no slicing needs as many
constexpr double most_joints = 1e6;

template <int Dim>
void check_number(const JointSetSpec& spec, const Ball<Dim>& ball) {
  const double expected = expected_number<Dim>(spec.set, ball.radius);
  if (expected <= most_joints) return;
  const char* key = spec.set.spacing ? "spacing" : "intensity";
  refuse(spec.subject, key,
         fmt::format("makes about {:.2g} joints that may reach the domain, more than {:.0g}; state a larger spacing, a "
                     "smaller intensity, larger joints or a smaller domain (domain.box, domain.planes)",
                     expected, most_joints));
}

// the part of the domain to which a set is confined
template <int Dim>
Polytope<Dim> confined(const JointSetSpec& spec, const Polytope<Dim>& domain, const Vector<Dim>& origin) {
  if (!spec.within) return domain;
  HalfSpaces<Dim> planes = domain.faces;
  for (const HalfSpace<Dim>& bound : region_planes<Dim>(*spec.within, origin))
    planes.push_back(bound);
  BlockResult<Dim> part = make_block<Dim>(planes, std::vector<int>(planes.size(), no_joint));
  if (part.status != BlockStatus::ok)
    refuse(*spec.within->subject.node, spec.within->subject.path,
           "contains no part of the domain; check its position against domain.box and domain.planes");
  return std::move(part.part);
}

// its plane and its outline are those of the drawn joint, to the last bit
template <int Dim>
JointSpec spec_of(const DrawnSet<Dim>& drawn, std::size_t j) {
  const DrawnJoint<Dim>& joint = drawn.joints[j];
  JointSpec spec;
  spec.subject = drawn.spec->subject;
  spec.name = drawn.name_of(j);
  spec.set = drawn.spec->set.name;
  spec.properties = drawn.spec->properties;
  spec.within = drawn.spec->within;
  spec.plane.normal.assign(joint.normal.data(), joint.normal.data() + Dim);
  spec.plane.point.assign(joint.point.data(), joint.point.data() + Dim);
  spec.outline.shape = joint.outline.shape;
  if (joint.outline.shape == OutlineForm::none) return spec;
  spec.outline.length = 2 * joint.outline.half_sizes.front();
  spec.outline.width = 2 * joint.outline.half_sizes.back();
  return spec;
}

}  // namespace

template <int Dim>
Scene with_drawn_joints(const Scene& scene) {
  if (!scene.domain)
    refuse({scene.tree.get(), ""}, "domain",
           "joint sets fill a region; add for example domain = { box = { min = …, max = … } }");
  const Vector<Dim> origin = find_origin<Dim>(scene);
  std::set<std::string> stated;
  for (const JointSpec& joint : scene.joints)
    stated.insert(joint.name);
  Scene whole = scene;
  whole.joint_sets.clear();
  for (const DrawnSet<Dim>& drawn : draw_joint_sets<Dim>(scene, make_domain<Dim>(scene, origin), origin))
    for (std::size_t j = 0; j < drawn.joints.size(); ++j) {
      whole.joints.push_back(spec_of<Dim>(drawn, j));
      if (stated.contains(whole.joints.back().name))
        refuse(drawn.spec->subject, "name",
               "contains a joint " + whole.joints.back().name +
                   ", which is also the name of one of [[joints]]; rename the set");
    }
  return whole;
}

template <int Dim>
std::vector<DrawnSet<Dim>> draw_joint_sets(const Scene& scene, const Polytope<Dim>& domain, const Vector<Dim>& origin) {
  const Ball<Dim> ball = ball_around<Dim>(domain, origin);
  std::vector<DrawnSet<Dim>> sets;
  for (const JointSetSpec& spec : scene.joint_sets) {
    check_number<Dim>(spec, ball);
    DrawnSet<Dim> drawn{&spec, confined<Dim>(spec, domain, origin), {}};
    for (DrawnJoint<Dim>& joint : draw<Dim>(spec.set, ball))
      if (measure_inside(plane_of(joint, origin), outline_from(joint, origin), drawn.solid) > 0)
        drawn.joints.push_back(std::move(joint));
    sets.push_back(std::move(drawn));
  }
  return sets;
}

template Scene with_drawn_joints<2>(const Scene&);
template Scene with_drawn_joints<3>(const Scene&);
template std::vector<DrawnSet<2>> draw_joint_sets<2>(const Scene&, const Polytope<2>&, const Vector<2>&);
template std::vector<DrawnSet<3>> draw_joint_sets<3>(const Scene&, const Polytope<3>&, const Vector<3>&);

}  // namespace voussoir
