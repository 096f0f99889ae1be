// Small models for the tests.
#pragma once

#include <string>

#include "core/model/model.hpp"
#include "core/slicing/slice.hpp"
#include "core/testing/shapes.hpp"
#include "text/angle.hpp"

namespace voussoir::shapes {

inline constexpr double gravity = 9.81;  // m/s²
inline constexpr double density = 2600;  // kg/m³

template <int Dim>
Model<Dim> model_of(std::vector<Body<Dim>> bodies, double friction = 35 * degree) {
  Model<Dim> model;
  model.bodies = std::move(bodies);
  number_bodies(model);
  model.properties = {{"joint", 1e9, 5e8, friction, false}};
  model.joints = {{"all", {Vector<Dim>::Unit(Dim - 1), 0}, 0}};  // the joint of the cuts below
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

// three joint sets through a box, each at these distances from its middle; blocks at the bottom are fixed
inline std::vector<Body<3>> jointed_box(const std::vector<double>& distances = {-0.65, 0.05, 0.6}) {
  std::vector<Cut<3>> cuts;
  const Vector<3> sets[] = {upward_normal_3d(70 * degree, 80 * degree), upward_normal_3d(65 * degree, 190 * degree),
                            upward_normal_3d(12 * degree, 300 * degree)};
  for (const Vector<3>& n : sets)
    for (const double c : distances)
      cuts.push_back({{n, c}, 0});
  SlicingCounters counters;
  std::vector<Body<3>> bodies;
  for (const Polytope<3>& part : slice<3>(block<3>(cube<3>(1)), cuts, {0.01}, counters)) {
    Body<3> body = make_body<3>({part}, density);
    double lowest = 0;
    for (const Vector<3>& v : part.vertices)
      lowest = std::min(lowest, v[2]);
    body.fixed = lowest < -0.99;
    bodies.push_back(body);
  }
  return bodies;
}

}  // namespace voussoir::shapes
