#pragma once

#include <vector>

#include "reference/arch/arch.hpp"

// The semicircular arch under its own weight and a vertical point load on its outer face: its capacity on rigid joints
// and on elastic ones. SI units, per metre of thickness out of the plane; angles from the crown, positive to the right,
// radians.
namespace voussoir::reference {

struct LoadedArch {
  Arch arch;
  double thickness = 0.75;  // m
  double x = -2.5;          // m from the middle of the span: of the load. -R/2 is a quarter of the span
};

// the voussoir under the load, counted as in voussoir_corners, and the loaded point of its outer face
struct LoadedPoint {
  int voussoir = 0;
  Corner point;  // m
};
LoadedPoint loaded_point(const LoadedArch& loaded);  // std::invalid_argument for an x outside the arch

// --- rigid voussoirs

struct Hinge {
  int joint = 0;         // between voussoirs joint - 1 and joint: 0 at the left springing
  bool outside = false;  // at the outer end of the joint
};

// The greatest load that rigid voussoirs support. The arch becomes a mechanism of three bodies on four hinges at ends
// of joints, each of which opens; the load and the weights then do no work. Of all such mechanisms the one with the
// least load governs (kinematic theorem). The thrust line through its hinges stays inside everywhere, which proves that
// this load is supported (static theorem).
struct RigidLoad {
  double load = 0;             // N
  double thrust = 0;           // N, horizontal
  std::vector<Hinge> hinges;   // four, from the left
  std::vector<double> radius;  // m: where the thrust line crosses the joints, from the left springing on
  double margin = 0;           // m: its least distance from the ends of a joint: zero but for rounding
};
// Throws std::invalid_argument for an arch that has no equilibrium without the load.
RigidLoad greatest_rigid_load(const LoadedArch& loaded);

// --- voussoirs on elastic joints

// an equilibrium, found by shooting from springing to springing in the deformed geometry
struct ElasticLoad {
  double load = 0;                   // N
  double drop = 0;                   // m, of its point
  double thrust = 0;                 // N, horizontal
  std::vector<ElasticJoint> joints;  // from the left springing on
};

// Equilibria by growing drop of the loaded point: from a fiftieth of the capacity of rigid voussoirs up to the greatest
// load and beyond, where they are unstable, until the load has fallen again by `beyond` of it. Throws as elastic_arch
// and greatest_rigid_load do.
std::vector<ElasticLoad> elastic_load_path(const LoadedArch& loaded, const ArchJoints& joints, double beyond = 0.02);

// The stable one under a given load. Throws std::runtime_error above the greatest.
ElasticLoad elastic_load(const LoadedArch& loaded, const ArchJoints& joints, double load);

// the greatest load that the arch supports on such joints
ElasticLoad greatest_elastic_load(const LoadedArch& loaded, const ArchJoints& joints);

}  // namespace voussoir::reference
