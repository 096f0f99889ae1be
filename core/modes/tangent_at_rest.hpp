// The pencil of a state at rest: elastic tangent and masses.
#pragma once

#include <string>

#include "core/modes/modes.hpp"
#include "core/modes/spectrum.hpp"

namespace voussoir {

template <int Dim>
struct PencilAtRest {
  std::string reason{};       // why there is none
  Model<Dim> model;           // of the stage
  std::vector<int> bodies{};  // of the pencil's rows
  Eigen::VectorXd free{};     // by degree of freedom: 1, or 0 if it is restrained
  Pencil<freedoms<Dim>> pencil{};
  TangentAtRest tangent{};
};

template <int Dim>
PencilAtRest<Dim> pencil_at_rest(const Prepared<Dim>& scene, const State<Dim>& rest, int stage);

}  // namespace voussoir
