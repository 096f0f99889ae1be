// What potential particles cannot have beside them.
#pragma once

#include "core/model/model.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir {

// Throws SceneError for what a scene with particles may not state beside them.
template <int Dim>
void check_beside_particles(const Scene& scene, const Model<Dim>& model);

}  // namespace voussoir
