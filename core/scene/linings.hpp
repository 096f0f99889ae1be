// [[linings]]: reading, checks and positions along the outlines.
#pragma once

#include "core/scene/scene_spec.hpp"

namespace voussoir {

// Throws SceneError.
void read_linings(const Subject& top, Scene& scene);

// Model::linings, independent of their order in the scene; the model's origin and joint properties are set.
// Throws SceneError.
template <int Dim>
void add_linings(const Scene& scene, Model<Dim>& model);

}  // namespace voussoir
