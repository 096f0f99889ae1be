// [[bolts]]: reading, checks and positions.
#pragma once

#include <array>
#include <vector>

#include "core/scene/scene_spec.hpp"

namespace voussoir {

// Throws SceneError.
void read_bolts(const Subject& top, Scene& scene);

// Axes for the angles of rays perpendicular to an axis, from the first towards the second: right and up; in 2-D the x
// and the y axis.
template <int Dim>
std::array<Vector<Dim>, 2> ray_axes(const std::vector<double>& axis);

// Model::bolts and their properties, independent of their order in the scene; the model's origin is set.
template <int Dim>
void add_bolts(const Scene& scene, Model<Dim>& model);

}  // namespace voussoir
