// [[linings]]: read, checked, and laid along their outlines.
#pragma once

#include "core/scene/scene_spec.hpp"

namespace voussoir {

// Throws SceneError.
std::vector<LiningSpec> read_linings(const Subject& scene, int dimension);

// Model::linings, whatever the order in which the scene states them; the model has its origin and its joint properties.
// Throws SceneError.
template <int Dim>
void add_linings(const Scene& scene, Model<Dim>& model);

}  // namespace voussoir
