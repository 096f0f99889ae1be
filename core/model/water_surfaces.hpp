// The loads of a model's waters on its bodies: Terzaghi's pore pressure on faces, so that contact forces are effective.
#pragma once

#include <vector>

#include "core/load/water.hpp"
#include "core/model/model.hpp"

namespace voussoir {

// The surfaces of a model's waters at some values, prepared for many bodies.
template <int Dim>
struct WaterSurfaces {
  struct Surface {
    double weight = 0;                         // N/m³, times the factor of gravity
    double pressure = 0;                       // Pa, likewise: of a water without a table
    std::vector<WaterStretch<Dim>> stretches;  // none of a constant pressure
  };
  std::vector<Surface> of;  // by water
  double steepest = 0;  // N/m³: upper bound of the change of a pressure's gradient (core/load/water.hpp, steepness)
};

// `factor`: of gravity, with which every water grows, or a ramp of gravity would float the rock
template <int Dim>
void find_surfaces(const Model<Dim>& model, const WaterValues& values, double factor, WaterSurfaces<Dim>& surfaces);

// force and moment about the centroid of a body in this pose; zero for a body that is not present
template <int Dim>
Load<Dim> water_load(const Model<Dim>& model, const WaterSurfaces<Dim>& surfaces, int body,
                     const Standing<Dim>& standing);

// J: ∫ p dV over the body, of which the load is minus the gradient. For a model whose water has one (water_by_volume).
template <int Dim>
double water_potential(const Model<Dim>& model, const WaterSurfaces<Dim>& surfaces, int body,
                       const Standing<Dim>& standing);

// an upper bound of the stiffness of the load, for the time step
template <int Dim>
BodyStiffness water_stiffness(const Model<Dim>& model, const WaterSurfaces<Dim>& surfaces, int body,
                              const Standing<Dim>& standing);

// How many levels a water has: of each point of a table in the plane, one in space; 0: a constant pressure.
template <int Dim>
int levels_of(const Water& water);

// The waters' numbers before the first stage.
template <int Dim>
WaterValues initial_water(const Model<Dim>& model);

// Force (N, 2-D N/m) and moment about the centroid (N m) of all waters on each body, by body, in the scene's position
// before any motion, under the waters' numbers given (those of the first stage's begin: initial_water) and full
// gravity. Zero for every body of a model without water.
template <int Dim>
std::vector<Load<Dim>> water_loads_at_reference(const Model<Dim>& model, const WaterValues& values);
template <int Dim>
std::vector<Load<Dim>> water_loads_at_reference(const Model<Dim>& model);

}  // namespace voussoir
