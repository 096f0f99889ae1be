// The scene's domain, cut by its joints and excavations.
#pragma once

#include "core/model/model.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir {

template <int Dim>
struct DomainBody {
  std::vector<Polytope<Dim>> parts;
  bool fixed = false;  // by a boundary joint
};

// Cuts by the model's joints, which are the scene's, and adds to them what outlines excavations; those that a stage
// takes out are whole, and stand in Model::excavations. Throws SceneError on
// outlines that are none, on excavations that take out nothing and on too many blocks.
template <int Dim>
std::vector<DomainBody<Dim>> cut_domain(const Scene& scene, Model<Dim>& model);

}  // namespace voussoir
