// Small models for the tests.
#pragma once

#include <string>

#include "core/model.hpp"
#include "core/testing/shapes.hpp"

namespace voussoir::shapes {

inline constexpr double gravity = 9.81;                   // m/s²
inline constexpr double density = 2600;                   // kg/m³
inline constexpr double degree = std::numbers::pi / 180;  // rad

template <int Dim>
Model<Dim> model_of(std::vector<Body<Dim>> bodies, double friction = 35 * degree) {
  Model<Dim> model;
  model.bodies = std::move(bodies);
  number_bodies(model);
  model.properties = {{"joint", 1e9, 5e8, friction, false}};
  model.joints = {{"all", {Vector<Dim>::Unit(Dim - 1), 0}, 0}};  // what the cuts below remember
  model.gravity[Dim - 1] = -gravity;
  return model;
}

template <int Dim>
Body<Dim> body_of(const HalfSpaces<Dim>& planes, bool fixed = false, const char* name = "") {
  Body<Dim> body = make_body<Dim>({block<Dim>(planes)}, density);
  body.fixed = fixed;
  body.name = name;
  return body;
}

// a block 1 wide and 0.5 high on a fixed plate that dips to the left
template <int Dim>
Model<Dim> block_on_plate(double slope, double friction) {
  const Matrix<Dim> turn = [&] {
    if constexpr (Dim == 3)
      return Matrix<3>(Eigen::AngleAxisd(slope, -Vector<3>::UnitY()).toRotationMatrix());
    else
      return matrix(Rotation<2>{slope});
  }();
  Vector<Dim> low = Vector<Dim>::Constant(-3), high = Vector<Dim>::Constant(3);
  high[Dim - 1] = 0;
  Vector<Dim> block_low = Vector<Dim>::Constant(-0.5), block_high = Vector<Dim>::Constant(0.5);
  block_low[Dim - 1] = 0;
  block_high[Dim - 1] = 0.5;
  return model_of<Dim>(
      {body_of<Dim>(placed<Dim>(box<Dim>(low, high), turn, Vector<Dim>::Zero()), true, "plate"),
       body_of<Dim>(placed<Dim>(box<Dim>(block_low, block_high), turn, Vector<Dim>::Zero()), false, "block")},
      friction);
}

template <int Dim>
int index_of(const Model<Dim>& model, const std::string& name) {
  return select(model, {.names = {name}, .above = {}, .below = {}, .inside = {}}).front();
}

}  // namespace voussoir::shapes
