// A scene that rests beside another one that differs from it in one number by very little. It is moved by the other
// one's motion and corrected with the other one's factors, so that it needs no iterations of its own.
#pragma once

#include <string>
#include <vector>

#include "core/model/prepared.hpp"
#include "core/run/progress.hpp"
#include "core/run/stage_in_force.hpp"
#include "core/solvers/complete_factors.hpp"
#include "core/step/static_solver_base.hpp"

namespace voussoir {

template <int Dim>
class Twin {
 public:
  explicit Twin(const Prepared<Dim>& of) : scene(&of), model(of.model), progress{} { progress.state = of.state; }

  // the changes of the next stage; the state is the first increment's base
  void enter(int stage);

  // The schedule of this scene at the moment of another one's: searched strength, time and gravity are equal, stated
  // friction and water are its own.
  Schedule schedule_beside(const Twin& other, const Schedule& of_other) const;

  // The unbalanced forces after a motion q since the base, by degree of freedom: loads at base + q with the joints'
  // return mapping from the base's histories. Contacts and loads of the state are then those at base + q.
  Eigen::VectorXd residual(const Schedule& schedule, const StaticBase<Dim>& from, const Eigen::VectorXd& q);

  // Before the first motion of an increment: joints that are closed but without force get a history, as the solver
  // gives them one (find_closed_joints).
  void begin_increment(const Schedule& schedule);

  // K = -dr/dq where the residual was last found, without regularisation; restrained directions have their scale on
  // the diagonal
  BlockMatrix<freedoms<Dim>> tangent(const StaticBase<Dim>& from);

  // the motion since the base to where these bodies are
  Eigen::VectorXd motion_to(const std::vector<Motion<Dim>>& motions) const;

  // the motion that was last evaluated is an increment's end: the state there is the next base
  void take_base();

  StageInForce<Dim> stage() const { return {*scene, progress.stage, model, settings}; }
  const State<Dim>& state() const { return progress.state; }
  bool answers() const { return progress.state.counters.unconverged == 0; }

  const Prepared<Dim>* scene;
  Model<Dim> model;  // of the stage, like the settings
  Settings settings{};
  Progress<Dim> progress;
  Unknowns<Dim> unknowns{model};
  StaticBase<Dim> base{};  // of the increment to come
};

// The factors of a tangent: those of the matrix itself, for its transpose, too.
template <int Dim>
class TangentFactors {
 public:
  explicit TangentFactors(const BlockMatrix<freedoms<Dim>>& matrix)
      : plan_(neighbours_in(matrix)), factors_(plan_, false), regular_(factors_.factorise(matrix)) {}

  bool regular() const { return regular_; }
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const { return factors_.solve(b); }
  Eigen::VectorXd solve_transposed(const Eigen::VectorXd& b) const { return factors_.solve_transposed(b); }

 private:
  EliminationPlan plan_;
  CompleteFactors<freedoms<Dim>> factors_;
  bool regular_;
};

// The two directions of a nearly singular matrix K whose rows and columns have these scales D (N/m, N m): of
// D^-1/2 K D^-1/2 the smallest singular value and the second one; the motion u, by degree of freedom, that meets least
// resistance, K u = smallest D^1/2 v', and the virtual motion v against which the resistance does least work.
struct NullVectors {
  double smallest = 0, second = 0;
  Eigen::VectorXd motion, weight;  // u, v
};
template <int Dim>
NullVectors null_vectors(const TangentFactors<Dim>& factors, const Eigen::VectorXd& scale);

}  // namespace voussoir
