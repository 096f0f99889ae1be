// The joints of a scene's sets, drawn for its domain.
#pragma once

#include "core/joint_sets/joint_set.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir {

// of one set those that meet the domain, in the order drawn
template <int Dim>
struct DrawnSet {
  const JointSetSpec* spec = nullptr;
  Polytope<Dim> solid;  // the domain, or the part of it that the set is confined to
  std::vector<DrawnJoint<Dim>> joints;

  // unique in the scene as far as the set's name is
  std::string name_of(std::size_t joint) const { return spec->set.name + "-" + std::to_string(joint + 1); }
};

// The scene with the joints of its sets as joints of its own, set by set behind those it states, and no sets any more.
// SceneError where a set has no domain.
template <int Dim>
Scene with_drawn_joints(const Scene& scene);

// The domain is seen from `origin`. SceneError where a set has no domain or asks for too many joints.
template <int Dim>
std::vector<DrawnSet<Dim>> draw_joint_sets(const Scene& scene, const Polytope<Dim>& domain, const Vector<Dim>& origin);

}  // namespace voussoir
