// Blocks in space whose faces carry forces at their corners, within Coulomb's exact cone: input of every program of
// limit analysis in space. Forces at corners give the resultants of all pressures on a convex face, and of all
// friction.
#pragma once

#include <array>
#include <vector>

#include "core/load/load.hpp"
#include "core/model/model.hpp"
#include "core/solvers/cone_program.hpp"

namespace voussoir {

struct CornerBody {
  Vector<3> centroid = Vector<3>::Zero();  // m
  double weight = 0;                       // N: the unit of its forces
  double radius = 0;                       // m: with it, that of its moments
  std::array<bool, 6> free{};              // translations, then rotations
};

struct CornerFace {
  int body_a = 0, body_b = 0;
  Vector<3> normal = Vector<3>::Zero();  // unit, from a to b
  std::vector<Vector<3>> corners;        // m, around the face
  int properties = 0;                    // Model::properties
  double friction = 0;                   // rad
  double cohesion = 0;                   // Pa

  double area() const;                 // m²
  std::vector<double> shares() const;  // of the area, by corner; their sum is 1, and their mean place the centroid
};

struct CornerAssembly {
  std::vector<CornerBody> bodies;
  std::vector<CornerFace> faces;
  std::vector<JointProperties> properties;  // Model::properties, of the faces
};

// The areas by which present bodies touch (key_blocks/rock_contacts.hpp), without those between two fixed ones.
// `acceleration`, m/s²: that of the weights. Cohesion acts as for `find_interfaces`.
CornerAssembly corner_assembly(const Model<3>& model, double acceleration, bool bonded = false);

// the force on body_b of a face at each of its corners, N
using CornerForces = std::vector<std::vector<Vector<3>>>;

struct MotionInSpace {
  Vector<3> velocity = Vector<3>::Zero();  // of the centroid
  Vector<3> spin = Vector<3>::Zero();      // 1/m
};

using CornerProgram = ConeProgram<6, 3>;

// Equilibrium under dead loads (by body): of every corner a cone of friction and, where there is cohesion, one of a
// given size for it. `live` without loads: none.
CornerProgram corner_program(const CornerAssembly& assembly, const std::vector<Load<3>>& dead,
                             const std::vector<Load<3>>& live = {});

// sin φ of every cone of friction, in the program's order; 0 of those of cohesion
std::vector<double> sines_of_cones(const CornerAssembly& assembly);

// Adds forces on every free body, in units of its weight, whose sum is to be least.
void add_missing_forces(const CornerAssembly& assembly, CornerProgram& program);

CornerForces corner_forces(const CornerAssembly& assembly, const Eigen::VectorXd& x);

// The fastest body's speed and turning (the speed of its farthest corner about the centroid) are 1 together.
std::vector<MotionInSpace> mechanism_of(const CornerAssembly& assembly, const Eigen::VectorXd& y);

// How the least sum of missing forces changes with each face's friction (rad) and cohesion (of itself), from the
// program's answer.
struct Sensitivity {
  double friction = 0, cohesion = 0;
};
std::vector<Sensitivity> sensitivity_of(const CornerAssembly& assembly, const ConeProgramAnswer& answer);

}  // namespace voussoir
