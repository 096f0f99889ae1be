// The data that the solvers keep from step to step, apart from the state of the rock: the time step, relaxation, the
// static solver.
#pragma once

#include <vector>

#include "core/contact/contact.hpp"
#include "core/model/bodies_state.hpp"
#include "core/model/joint_histories.hpp"
#include "core/model/ledger.hpp"
#include "core/model/loads_state.hpp"
#include "core/model/supports_state.hpp"
#include "core/solvers/linear_work.hpp"

namespace voussoir {

struct TimeStep {
  double length = 0;                 // s: of the last step; 0 at the start
  double allowed = 0;                // s: of the next; 0: to be estimated
  std::vector<double> frequency;     // rad/s, by body: stiffest mode of the last estimate
  double shortest = 0, longest = 0;  // s: of the implicit steps of this stage; 0: none
};

// Adaptive dynamic relaxation (step/relaxation.hpp): the data that it keeps from step to step.
template <int Dim>
struct Relaxation {
  bool under_way = false;               // the run seeks equilibrium by it: inertia, velocities and time are fictitious
  bool rested = false;                  // it has stopped every body, and none has moved since
  std::vector<double> inertia;          // by body: fictitious over true mass and moments of inertia
  std::vector<Load<Dim>> contact_load;  // by body: of the step before, without weight
  std::vector<Load<Dim>> imposed;       // by body: the change of its load by a change of water; empty if there is none
  int until_renewal = 0;                // steps until the inertia is chosen again
};

// How the force and moment of a contact's second body, about its centroid, change with that body's motion against the
// first: translations, then turns.
template <int Dim>
struct PairStiffness {
  using Block = FixedMatrix<freedoms<Dim>, freedoms<Dim>>;
  using Wrench = FixedMatrix<freedoms<Dim>, 1>;
  int contact = 0;  // place in ContactsState::list; -1: of a bolt or a lining
  int body_a = 0, body_b = 0;
  Block stiffness = Block::Zero();          // minus the derivative, N/m, N and N m
  Wrench wrench = Wrench::Zero();           // its present value, N and N m
  Vector<Dim> apart = Vector<Dim>::Zero();  // m, of the second centroid from the first
};

// The start of an increment of the static solver: the parts of the state from which a trial begins, and the values with
// which it is compared.
template <int Dim>
struct StaticBase {
  std::vector<Motion<Dim>> motions;  // by body
  JointHistories<Dim> histories;
  SupportsState<Dim> supports;
  Ledger ledger;
  LoadsBySource<Dim> loads;  // under the present loads
  long long held_bonds = 0;
  long long listed = 0;  // Counters::neighbour_builds that the histories belong to
};

// Steps of few bodies between two of all (step/bodies_of_step.hpp).
struct StepsOfFew {
  std::vector<int> list;      // of the free bodies, ascending; none: all move
  int since_all = 0;          // of the few since the last step of all
  double regularisation = 0;  // lambda of the steps of all meanwhile
  double merit = 0;           // of these bodies' residual after the last step
  double merit_of_all = 0;    // before the last step of all, and whether that step went about as far as it could
  bool went_far = false;
};

// How far the iterations of an increment have come.
struct StaticProgress {
  int iteration = 0;  // accepted ones of this increment
  int since_commit = 0, tries = 0, polished = 0;
  bool broke = false;         // bonds, in a trial that was refused
  double regularisation = 1;  // lambda
  double overshoot = 0;       // the linear system's solution over the largest permitted step
  double length = 1;          // of the last step, over the bounded solution; how often it was shortened
  int lengths = 0;
  std::vector<double> accepted;          // by degree of freedom: motion since the reference state
  std::vector<double> residual, change;  // by degree of freedom: unbalanced forces, last step
  std::vector<double> merits;            // of the accepted ones
  int pairs = 0;                         // that touched in the last one
  StepsOfFew few;
};

// The parts of its linear system.
template <int Dim>
struct StaticSystem {
  std::vector<PairStiffness<Dim>> stiffness, closed;  // of the contacts that touch; of those that touch without force
  std::vector<typename PairStiffness<Dim>::Block> of_water;  // by body; none without water
  LinearWork<freedoms<Dim>> work;                            // of the last system
};

// The static solver (step/static_solver.hpp): the data that an increment keeps from one evaluation to the next.
template <int Dim>
struct StaticIncrement {
  // the kind of the next evaluation; `complete`, `last`: of the accepted motion, before the increment ends and before
  // it is left to relaxation
  enum class Trial { waiting, start, step, complete, last };
  bool under_way = false;
  Trial trial = Trial::start;
  int increments_left = 0;    // after this one
  double increment_time = 0;  // s: by how much the schedules advance with each
  double ends = 0;            // s: their time after the last one
  // m, by body: the elastic displacement (core/step/elastic_displacement.hpp), by which slip since the base and steps
  // are measured, and where the bodies were when the solver began; none if the increments alone bound the slip
  std::vector<double> elastic;
  std::vector<Vector<Dim>> began;
  StaticBase<Dim> base;
  StaticProgress progress;
  StaticSystem<Dim> system;
};

}  // namespace voussoir
