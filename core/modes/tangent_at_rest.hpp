// The pencil of a state at rest: elastic tangent and masses.
#pragma once

#include <string>
#include <vector>

#include "core/model/prepared.hpp"
#include "core/modes/spectrum.hpp"

namespace voussoir {

// contacts of a joint whose shear force is within a hundredth of their strength
struct JointAtStrength {
  std::string joint;  // its name; empty: faces that no joint made
  int at_strength = 0, closed = 0;
};

// how K was found
struct TangentAtRest {
  double unbalanced = 0;  // the equilibrium measure
  // |K - Kᵀ| / |K|, Frobenius; its symmetric part is used
  double asymmetry = 0;
  int contacts = 0;                            // that touch a free body
  int one_point = 0;                           // of them: faces that act at one point, which rock too stiffly
  std::vector<JointAtStrength> at_strength{};  // by joint, those with any
  std::vector<int> hanging{};                  // free bodies without stiffness
};

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
