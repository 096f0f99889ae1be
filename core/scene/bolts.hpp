// [[bolts]]: read, checked, and placed.
#pragma once

#include <array>
#include <vector>

#include "core/scene/scene_spec.hpp"

namespace voussoir {

// Throws SceneError.
void read_bolts(const Subject& top, Scene& scene);

// What angles of rays across an axis count from and turn to: right and up; in the plane the x and the y axis.
template <int Dim>
std::array<Vector<Dim>, 2> ray_axes(const std::vector<double>& axis);

// Model::bolts and their properties, whatever the order in which the scene states them; the model has its origin.
template <int Dim>
void add_bolts(const Scene& scene, Model<Dim>& model);

}  // namespace voussoir
