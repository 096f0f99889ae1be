// The time, and values that vary within a stage.
#pragma once

#include <limits>
#include <vector>

#include "core/model/model.hpp"

namespace voussoir {

// values that vary within a stage
struct Schedule {
  double time = 0;  // s
  double gravity_factor = 1;
  double last_gravity_factor = 1;                         // of the step before
  std::vector<double> friction;                           // rad, for each of Model::properties
  std::vector<double> strength_factor;                    // for each: divides tan φ (done in `friction`) and cohesion;
                                                          // empty: no factor has been searched
  WaterValues water, last_water;                          // the numbers of Model::waters, and those of the step before
  double started = 0;                                     // s: when the schedules began to run
  double ends = std::numeric_limits<double>::infinity();  // s: when the present run is complete; its last
                                                          // step ends there
};

// Applies the present value of a search: the friction angle, rad, of some joint properties, or the factor that divides
// their tan φ and cohesion, both as the model states them.
template <int Dim>
void set_strength(const Model<Dim>& model, Searched searched, const std::vector<int>& properties, double level,
                  Schedule& schedule);

}  // namespace voussoir
