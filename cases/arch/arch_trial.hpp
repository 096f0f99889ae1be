// Shared by the tests of the arch: runs that end in equilibrium or during collapse, the state of the joints, and data
// for the figures.
#pragma once

#include <string>
#include <vector>

#include "cases/case_tools.hpp"

namespace voussoir::cases {

// that gives the joints of a scene this stiffness (Pa/m), in shear and normal direction
std::vector<std::string> on_joints(double stiffness);

constexpr double fallen = 0.25;  // m: a drop at which the hinges are visibly open

// A scene of this folder that was run until equilibrium, or until a block had dropped so far, or until the step limit.
struct Trial {
  LoadedScene scene;
  State<2> state;  // at the end
  bool stands = false, comes_down = false;
  verification::Cost cost;

  const Model<2>& model() const { return std::get<Prepared<2>>(scene.prepared).model; }
  double drop(const std::string& block, const Vector<2>& point) const;  // m, of a point of the scene on that block
};
Trial attempt(const std::string& scene, const std::vector<std::string>& overrides, double drop = fallen);

// the state of a joint, by its place in the arch
struct Joint {
  double angle = 0;     // from the crown, rad, positive to the right
  double outwards = 0;  // m from its middle: the point at which its force crosses it
  double turn = 0;      // rad between its faces
  Vector<2> point;      // m, where the force crosses
  Vector<2> force;      // N
};

// the joints in compression, from the left
struct ArchShape {
  int voussoirs = 0;
  double radius = 0;  // m
};
std::vector<Joint> joints_of(const Trial& trial, const ArchShape& shape);

// joints that rotate by more than a tenth of the largest rotation
std::vector<Joint> hinges_of(const std::vector<Joint>& joints);

// CSV files in the folder of the case, for the figures
void draw_blocks(const std::string& file, const Trial& trial);  // closed outlines, separated by an empty line
void draw_forces(const std::string& file, const Trial& trial);  // of every sub-contact: its point and its force
void draw_points(const std::string& file, const std::vector<Joint>& joints);

}  // namespace voussoir::cases
