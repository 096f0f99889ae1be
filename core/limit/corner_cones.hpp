// Blocks whose faces carry forces at their corners (in the plane at their ends), within Coulomb's exact cone: input of
// every program of limit analysis. Forces at corners give the resultants of all pressures on a convex face, and of all
// friction.
#pragma once

#include <array>
#include <vector>

#include "core/load/load.hpp"
#include "core/model/model.hpp"
#include "core/solvers/cone_program.hpp"

namespace voussoir {

template <int Dim>
struct CornerBody {
  Vector<Dim> centroid = Vector<Dim>::Zero();  // m
  double weight = 0;                           // N: the unit of its forces
  double radius = 0;                           // m: with it, that of its moments
  std::array<bool, freedoms<Dim>> free{};      // translations, then rotations

  bool moves() const;
};

template <int Dim>
struct CornerFace {
  int body_a = 0, body_b = 0;
  Vector<Dim> normal = Vector<Dim>::Zero();  // unit, from a to b
  std::vector<Vector<Dim>> corners;          // m, around the face
  int properties = 0;                        // Model::properties
  double friction = 0;                       // rad
  double cohesion = 0;                       // Pa

  double area() const;                 // m² (2-D: m)
  std::vector<double> shares() const;  // of the area, by corner; their sum is 1, and their mean place the centroid
};

// A bolt at a joint: two blocks held together along a line by a tension between two bounds.
template <int Dim>
struct CornerTie {
  int body_a = 0, body_b = 0;
  Vector<Dim> place = Vector<Dim>::Zero(), axis = Vector<Dim>::Zero();  // m; unit, from a to b
  double least = 0, most = 0;                                           // N: of the tension; the least is negative
                                                                        // where it also resists compression
  double dowel = 0;                                                     // N: of the shear force across it
  int bolt = 0;                                                         // Model::bolts

  double mean() const { return 0.5 * (least + most); }
  double half() const { return 0.5 * (most - least); }
};

template <int Dim>
struct CornerAssembly {
  std::vector<CornerBody<Dim>> bodies;
  std::vector<CornerFace<Dim>> faces;
  std::vector<JointProperties> properties;  // Model::properties, of the faces
  std::vector<CornerTie<Dim>> ties{};
};

// The areas by which present bodies touch (key_blocks/rock_contacts.hpp), without those between two that are held.
// `acceleration`, m/s²: that of the weights. Cohesion is what the properties state where bonds are as sliced, between
// faces of one joint; `bonded`: everywhere. There is no tension.
template <int Dim>
CornerAssembly<Dim> corner_assembly(const Model<Dim>& model, double acceleration, bool bonded = false);

// the force on body_b of a face at each of its corners, N
template <int Dim>
using CornerForces = std::vector<std::vector<Vector<Dim>>>;

// Velocities of a mechanism: only their ratios have a meaning. For the fastest body, the speed of the centroid plus
// that of the farthest corner about it is 1.
template <int Dim>
struct BodyVelocity {
  Vector<Dim> velocity = Vector<Dim>::Zero();  // of the centroid
  Spin<Dim> spin = Spin<Dim>::Zero();          // 1/m
};

// Loads on each body, by id, in the reference configuration.
template <int Dim>
using Loads = std::vector<Load<Dim>>;

template <int Dim>
using CornerProgram = ConeProgram<freedoms<Dim>, Dim>;

// Equilibrium under dead loads (by body): of every corner a cone of friction and, where there is cohesion, one of a
// given size for it; then of every tie one for what its tension differs from the mean of its bounds, which is a dead
// load, and, if it is a dowel, one for that. `live` without loads: none.
template <int Dim>
CornerProgram<Dim> corner_program(const CornerAssembly<Dim>& assembly, const Loads<Dim>& dead,
                                  const Loads<Dim>& live = {});

// sin φ of every cone of friction, in the program's order; 0 of those of a given size
template <int Dim>
std::vector<double> sines_of_cones(const CornerAssembly<Dim>& assembly);

// Adds forces on every free body, in units of its weight, whose sum is to be least.
template <int Dim>
void add_missing_forces(const CornerAssembly<Dim>& assembly, CornerProgram<Dim>& program);

// Adds forces of any size and sign at the chosen corners, by face: normal ones, and shear where the face `gains` it.
// `cost`: of a unit of them.
template <int Dim>
void add_free_forces(const CornerAssembly<Dim>& assembly, const std::vector<std::vector<bool>>& corners,
                     const std::vector<bool>& gains, double cost, CornerProgram<Dim>& program);

template <int Dim>
CornerForces<Dim> corner_forces(const CornerAssembly<Dim>& assembly, const Eigen::VectorXd& x);
// N: of every tie
template <int Dim>
std::vector<double> tensions(const CornerAssembly<Dim>& assembly, const Eigen::VectorXd& x);

// The largest unbalanced force on a body under the program's right side and λ times its live load, over its weight (a
// moment: of that times its radius), by the first numbers of x: those of the program's own cones.
template <int Dim>
double out_of_balance(const CornerProgram<Dim>& program, const Eigen::VectorXd& x, double factor = 0);

template <int Dim>
std::vector<BodyVelocity<Dim>> mechanism_of(const CornerAssembly<Dim>& assembly, const Eigen::VectorXd& y);

// the velocity of body_b relative to body_a at a place
template <int Dim>
Vector<Dim> opening_at(const CornerAssembly<Dim>& assembly, const CornerFace<Dim>& face, const Vector<Dim>& place,
                       const std::vector<BodyVelocity<Dim>>& velocities);

// How the least sum of missing forces changes with each face's friction (rad) and cohesion (of itself), from the
// program's answer.
struct Sensitivity {
  double friction = 0, cohesion = 0;
};
template <int Dim>
std::vector<Sensitivity> sensitivity_of(const CornerAssembly<Dim>& assembly, const ConeProgramAnswer& answer);

}  // namespace voussoir
