// [[linings]]: read, checked, and laid along their outlines.
#pragma once

#include "core/scene/scene_spec.hpp"

namespace voussoir {

// Throws SceneError.
void read_linings(const Subject& top, Scene& scene);

// Model::linings, whatever the order in which the scene states them; the model has its origin and its joint properties.
// Throws SceneError.
template <int Dim>
void add_linings(const Scene& scene, Model<Dim>& model);

}  // namespace voussoir
