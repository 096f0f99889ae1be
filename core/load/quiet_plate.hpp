// Quiet side: a massless plate behind half a joint, and behind the plate a dashpot of the medium's impedance
// (Lysmer & Kuhlemeyer 1969). A dashpot on the block itself would return tan(π/2n) of a wave of n blocks; behind half a
// joint, as here, it returns tan²(π/2n).
//
//   block u - spring K - plate w - dashpot C - medium that carries the wave v_in:    C dw/dt = K (u - w) + 2 C v_in
//
// by the midpoint rule with the block's place half-way: stable for a step of any length.
#pragma once

#include "core/geometry/types.hpp"

namespace voussoir {

// the constants of a plate, along the columns of `axes`
template <int Dim>
struct QuietPlate {
  Matrix<Dim> axes = Matrix<Dim>::Identity();   // world axes
  Vector<Dim> stiffness = Vector<Dim>::Zero();  // N/m, positive: of half a joint, twice that of the joint
  Vector<Dim> impedance = Vector<Dim>::Zero();  // N s/m, positive
};

// What a step makes of a plate. The block's face moves by h times a mean velocity; everything in world axes.
template <int Dim>
struct PlateStep {
  Vector<Dim> plate;        // m: displacement of the plate at the end of the step
  Vector<Dim> mean_force;   // N on the block: -K times half the sum of u - w before and after
  Matrix<Dim> by_velocity;  // N s/m: derivative of mean_force by the mean velocity; symmetric, negative definite
  double came_in = 0;       // J: 2 C v_in · Δw
  double went_out = 0;      // J: Δw · C Δw / h, never negative
};

// `face`, `plate`: displacements of the block's face and of the plate at the start of the step, m; `velocity`: the
// face's mean over the step, m/s; `upgoing`: that of the entering wave; h > 0, s.
template <int Dim>
PlateStep<Dim> step_of(const QuietPlate<Dim>& constants, const Vector<Dim>& face, const Vector<Dim>& plate,
                       const Vector<Dim>& velocity, const Vector<Dim>& upgoing, double h);

// N on the block, with its face and the plate at these displacements
template <int Dim>
Vector<Dim> force_of(const QuietPlate<Dim>& constants, const Vector<Dim>& face, const Vector<Dim>& plate);

// J, in the spring
template <int Dim>
double energy_of(const QuietPlate<Dim>& constants, const Vector<Dim>& face, const Vector<Dim>& plate);

}  // namespace voussoir
