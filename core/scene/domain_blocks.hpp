// The scene's domain, cut by joints and excavations.
#pragma once

#include "core/model/model.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir {

template <int Dim>
struct DomainBody {
  std::vector<Polytope<Dim>> parts;
  bool fixed = false;  // by a boundary joint
};

// Cuts by the model's joints, which are the scene's, and adds to them the outlines of excavations; the blocks of
// excavations that a stage makes are not cut apart yet, and are listed in Model::excavations. Throws SceneError for
// invalid outlines, for excavations that remove nothing and for too many blocks.
template <int Dim>
std::vector<DomainBody<Dim>> cut_domain(const Scene& scene, Model<Dim>& model);

}  // namespace voussoir
