// The equations of an implicit step: mean velocities of the free bodies and forces of the points together, by Newton's
// method. The points' forces are eliminated one by one, so that the system has the pattern of the bodies.
#pragma once

#include <vector>

#include "core/implicit/mean_motion.hpp"
#include "core/implicit/step_points.hpp"
#include "core/load/quiet_plate.hpp"
#include "core/model/loads_state.hpp"
#include "core/solvers/block_matrix.hpp"

namespace voussoir {

// degrees of freedom of the bodies that move by their loads
template <int Dim>
struct StepUnknowns {
  std::vector<int> bodies, place;  // by unknown; by body: index among them, or -1
  std::vector<int> moved;          // by body: the unknown by which it moves: its own, or that which an image repeats
  std::vector<int> beside;         // by body: of a free field's column, the unknown of the side's body beside it; or -1
  std::vector<bool> outside;       // by body: an image beyond its column, whose forces on the column load that body too
  Eigen::VectorXd free;            // 1, or 0 if it is restrained

  explicit StepUnknowns(const Model<Dim>& model);
};

// An open face over the step: its plate gives a force that is linear in the mean velocity of the face, relative to that
// of the free field's column if it has one.
template <int Dim>
struct StepPlate {
  const OpenFace<Dim>* face;
  Vector<Dim> from, plate, upgoing;  // displacements of the face and the plate at the start; the entering wave's mean
  Vector<Dim> arm, arm_of_column;    // m: of the face, means of those before and after the step

  // m/s
  Vector<Dim> velocity(const std::vector<MeanMotion<Dim>>& mean) const {
    const MeanMotion<Dim>& own = mean[face->body];
    Vector<Dim> v = own.velocity + cross(own.spin, arm);
    if (face->column >= 0) v -= mean[face->column].velocity + cross(mean[face->column].spin, arm_of_column);
    return v;
  }
  PlateStep<Dim> step(const std::vector<MeanMotion<Dim>>& mean, double h) const {
    return step_of<Dim>(face->plate, from, plate, velocity(mean), upgoing, h);
  }
};

// Images of a free field's columns have the mean motions of the bodies that they repeat.
template <int Dim>
void repeat_images(const Model<Dim>& model, std::vector<MeanMotion<Dim>>& mean);

// Calls act(unknown, sign, arm) for each body beside a free field's column that the force between two bodies loads, as
// it does the column: + for that of the second. And for each body at all.
template <int Dim>
void each_beside(const StepUnknowns<Dim>& unknowns, const auto& pair, const Vector<Dim>& arm_a,
                 const Vector<Dim>& arm_b, const auto& act) {
  const int a = pair.body_a, b = pair.body_b;
  if (unknowns.outside[b] && unknowns.beside[a] >= 0) act(unknowns.beside[a], -1.0, arm_a);
  if (unknowns.outside[a] && unknowns.beside[b] >= 0) act(unknowns.beside[b], 1.0, arm_b);
}
template <int Dim>
void each_loaded(const StepUnknowns<Dim>& unknowns, const auto& pair, const Vector<Dim>& arm_a,
                 const Vector<Dim>& arm_b, const auto& act) {
  if (const int a = unknowns.place[pair.body_a]; a >= 0) act(a, -1.0, arm_a);
  if (const int b = unknowns.place[pair.body_b]; b >= 0) act(b, 1.0, arm_b);
  each_beside(unknowns, pair, arm_a, arm_b, act);
}

struct StepSolution {
  bool solved = false;
  int iterations = 0;
};

// Finds the mean motions and the forces of the points, whose geometry does not change here. `before`: by body, at the
// start of the step; `loads`: by body, without the forces of points and plates, at half of the step. Bodies that are
// not unknown keep their mean motion, but for images.
template <int Dim>
StepSolution solve_step(const Model<Dim>& model, const StepUnknowns<Dim>& unknowns, double h,
                        const std::vector<Motion<Dim>>& before, const std::vector<Load<Dim>>& loads,
                        const std::vector<StepPlate<Dim>>& plates, std::vector<StepPoint<Dim>>& points,
                        std::vector<MeanMotion<Dim>>& mean);

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
  double beside = 0;  // J: put in by columns of free fields
};
template <int Dim>
Calmed calm_unresolved(const Model<Dim>& model, const StepUnknowns<Dim>& unknowns, double h,
                       const std::vector<ClosedPoint<Dim>>& closed, std::vector<Motion<Dim>>& after);

}  // namespace voussoir
