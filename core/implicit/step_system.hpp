// The equations of an implicit step: mean velocities of the free bodies and forces of the points together, by Newton's
// method. The points' forces are eliminated one by one, so that the system has the pattern of the bodies.
#pragma once

#include <vector>

#include "core/implicit/mean_motion.hpp"
#include "core/implicit/step_points.hpp"
#include "core/model/loads_state.hpp"
#include "core/solvers/block_matrix.hpp"

namespace voussoir {

// degrees of freedom of the bodies that move by their loads
template <int Dim>
struct StepUnknowns {
  std::vector<int> bodies, place;  // by unknown; by body: index among them, or -1
  Eigen::VectorXd free;            // 1, or 0 if it is restrained

  explicit StepUnknowns(const Model<Dim>& model);
};

struct StepSolution {
  bool solved = false;
  int iterations = 0;
};

// Finds the mean motions and the forces of the points, whose geometry does not change here. `before`: by body, at the
// start of the step; `loads`: by body, without the points' forces, at half of the step. Bodies that are not unknown
// keep their mean motion.
template <int Dim>
StepSolution solve_step(const Model<Dim>& model, const StepUnknowns<Dim>& unknowns, double h,
                        const std::vector<Motion<Dim>>& before, const std::vector<Load<Dim>>& loads,
                        std::vector<StepPoint<Dim>>& points, std::vector<MeanMotion<Dim>>& mean);

// Velocities v' of (M + h² Σ χ Bᵀ K B/4) v' = M v: the joints that stay closed, and those of them that stuck, by
// backward Euler, so that what the step does not resolve dies (K: the points' stiffness along their normals, and across
// where they stuck). `after`: by body, at the end of the step; bodies that are not unknown keep their velocities.
template <int Dim>
struct ClosedPoint {
  int body_a = 0, body_b = 0;
  Vector<Dim> direction, arm_a, arm_b;  // its normal and arms at the end of the step
  double normal = 0, shear = 0;         // N/m: χ k, 0 where it is open or slipped
};
struct Calmed {
  double taken = 0;   // J: out of the motion, never negative
  double driven = 0;  // J: put in by what moves bodies by prescription, against these impulses
};
template <int Dim>
Calmed calm_unresolved(const Model<Dim>& model, const StepUnknowns<Dim>& unknowns, double h,
                       const std::vector<ClosedPoint<Dim>>& closed, std::vector<Motion<Dim>>& after);

}  // namespace voussoir
