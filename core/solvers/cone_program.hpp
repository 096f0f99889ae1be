// Forces in second-order cones that keep bodies in equilibrium: the largest factor of a load. A primal-dual interior
// point method with Nesterov and Todd's scaling and Mehrotra's corrector on the homogeneous self-dual embedding
// (Andersen, Roos and Terlaky 2003), whose linear systems have one row of blocks a body.
#pragma once

#include <algorithm>
#include <vector>

#include "core/geometry/types.hpp"

namespace voussoir {

// A force x with |(x1, …)| <= x0, between two bodies or on one.
template <int Freedoms, int Width>
struct ForceCone {
  int body_a = -1, body_b = -1;                                              // -1: none, or one that is held
  FixedMatrix<Freedoms, Width> on_a = FixedMatrix<Freedoms, Width>::Zero(),  // force and moment of each number of x
      on_b = FixedMatrix<Freedoms, Width>::Zero();
  double cost = 0;  // of x0
  double head = 0;  // > 0: x0 is given
};

// Minimise Σ cost x0 - λ, subject to Σ on_a x + Σ on_b x + λ live = right_side and x in their cones. Of a freedom that
// is held all coefficients are zero. `live` without any coefficient: there is no λ.
template <int Freedoms, int Width>
struct ConeProgram {
  std::vector<ForceCone<Freedoms, Width>> cones;
  Eigen::VectorXd right_side, live;  // by body
};

enum class ConeStatus {
  optimal,
  unbounded,   // forces that need no right side make a positive λ
  infeasible,  // no forces balance the right side at any λ
  stalled      // digits were lost before either was certain
};

struct ConeProgramAnswer {
  ConeStatus status = ConeStatus::stalled;
  double factor = 0;            // λ
  double value = 0, bound = 0;  // of the minimum: of these forces, and of the multipliers
  Eigen::VectorXd x;            // by cone; of an unbounded program a direction
  Eigen::VectorXd y;  // by body: multipliers, velocities; of an infeasible one a mechanism that the right side drives
  Eigen::VectorXd heads;                                 // by cone: multipliers of given heads
  double gap = 0, out_of_balance = 0, inadmissible = 0;  // relative; of the program's numbers
  int iterations = 0;

  double error() const { return std::max({gap, out_of_balance, inadmissible}); }
};

// The same bits for any machine and number of threads.
template <int Freedoms, int Width>
ConeProgramAnswer solve(const ConeProgram<Freedoms, Width>& program);

}  // namespace voussoir
