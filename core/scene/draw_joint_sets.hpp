// The joints of a scene's sets, drawn for its domain.
#pragma once

#include "core/joint_sets/joint_set.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir {

// joints of one set that meet the domain, in the order drawn
template <int Dim>
struct DrawnSet {
  const JointSetSpec* spec = nullptr;
  Polytope<Dim> solid;  // the domain, or the part of it to which the set is confined
  std::vector<DrawnJoint<Dim>> joints;

  // unique in the scene if the set's name is
  std::string name_of(std::size_t joint) const { return spec->set.name + "-" + std::to_string(joint + 1); }
};

// The scene with its joint sets replaced by their joints, set by set after the stated ones. SceneError if a set has no
// domain.
template <int Dim>
Scene with_drawn_joints(const Scene& scene);

// The domain is seen from `origin`. SceneError if a set has no domain or too many joints.
template <int Dim>
std::vector<DrawnSet<Dim>> draw_joint_sets(const Scene& scene, const Polytope<Dim>& domain, const Vector<Dim>& origin);

}  // namespace voussoir
