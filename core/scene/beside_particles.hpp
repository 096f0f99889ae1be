// Parts of a scene that cannot be combined with potential particles.
#pragma once

#include "core/model/model.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir {

// Throws SceneError if a scene with particles states something that cannot be combined with them.
template <int Dim>
void check_beside_particles(const Scene& scene, const Model<Dim>& model);

}  // namespace voussoir
