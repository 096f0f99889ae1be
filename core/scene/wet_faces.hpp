// Assigns waters to faces.
#pragma once

#include "core/model/model.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir {

// Gives the model, whose joints and bodies are set, the scene's waters. Throws SceneError for an unknown joint and for
// a face with two waters.
template <int Dim>
void add_waters(const Scene& scene, Model<Dim>& model);

// a change in the model's coordinates
template <int Dim>
WaterPlan in_model(WaterPlan plan, const Model<Dim>& model);

}  // namespace voussoir
