#pragma once

#include <vector>

// A semicircular arch of equal voussoirs between radial joints, under its own weight. SI units, per metre of thickness
// out of the plane; angles from the crown, radians.
namespace voussoir::reference {

// n voussoirs, each the trapezoid between two radial joints: straight inside and outside
struct Arch {
  int voussoirs = 11;           // n >= 2
  double radius = 5;            // m, of the middle of the joints, R
  double weight = 2500 * 9.81;  // N/m3
};

// the four corners of voussoir k = 0 .. n-1 from the left springing to the right one, counter-clockwise, {x, y} in m
// about the centre of the circle
struct Corner {
  double x = 0, y = 0;
};
std::vector<Corner> voussoir_corners(const Arch& arch, double thickness, int k);

// one voussoir's
struct Voussoir {
  double weight = 0;    // N
  double centroid = 0;  // m from the centre of the circle
};
Voussoir voussoir_of(const Arch& arch, double thickness);

// --- rigid voussoirs (Heyman 1966: no tension, no crushing, no sliding)

// The points at which the thrust crosses the joints of the right half, from the crown down to the springing.
struct ThrustLine {
  double thrust = 0;           // N, horizontal
  double half_weight = 0;      // N
  double margin = 0;           // m: its least distance from the ends of a joint, negative outside
  std::vector<double> angle;   // of the joints
  std::vector<double> radius;  // m, where it crosses them
};

// The thrust line that keeps farthest inside, in the sense of largest least moment. The half arch above a joint is in
// equilibrium under the crown's thrust H at height y0, its weight W at x and the joint's force at radius r: H (y0 - r
// cos b) = W (r sin b - x). In H and H y0 the conditions inside <= r <= outside are linear.
ThrustLine best_thrust_line(const Arch& arch, double thickness);

// The least thickness (m) that contains a thrust line; for many voussoirs 0.1075 R (Milankovitch 1907, Z. Math.
// Physik 55, 1-27).
double minimum_thickness(const Arch& arch);

// --- voussoirs on elastic joints

struct ArchJoints {
  double normal_stiffness = 1e11;  // Pa/m, no tension; at most 1e10 of the weight, or rounding masks the drop
  double shear_stiffness = 1e11;   // Pa/m, no slip
};

struct ElasticJoint {
  double angle = 0;     // from the crown, positive to the right
  double crossing = 0;  // m from the middle of the joint outwards: point of action of the force
  double turn = 0;      // rad between the two faces, positive if the outer ends are pressed more
  double bearing = 0;   // m: length in contact
};

// an equilibrium, found by shooting from the springing to the keystone in the deformed geometry
struct ElasticArch {
  double thickness = 0;              // m
  double drop = 0;                   // m, of the keystone
  double thrust = 0;                 // N, horizontal
  std::vector<ElasticJoint> joints;  // of the right half, from the springing up
};

// Equilibria by growing drop: from an arch so thick that all joints are fully pressed, down to the thinnest and back
// up, with unstable equilibria, until the thickness has grown again by `beyond` of the least. Odd numbers of voussoirs
// only, which have a keystone; throws std::invalid_argument for others, std::runtime_error when the path is lost.
std::vector<ElasticArch> elastic_arch_path(const Arch& arch, const ArchJoints& joints, double beyond = 0.02);

// The stable one of a given thickness. Throws std::runtime_error below the least thickness.
ElasticArch elastic_arch(const Arch& arch, const ArchJoints& joints, double thickness);

// the thinnest of them: the least stable thickness
ElasticArch thinnest_elastic_arch(const Arch& arch, const ArchJoints& joints);

// an arch one of whose supports has moved towards the other, by shooting from springing to springing
struct ClosedArch {
  double thrust = 0;                 // N, horizontal
  double weight = 0;                 // N
  std::vector<ElasticJoint> joints;  // from the right springing on
};

// The equilibrium that is reached when the supports close step by step, by `closed` (m; negative: that part) in total.
// Other equilibria may exist next to it, swayed on the same hinges, with nearly the same thrust. Throws
// std::runtime_error if it finds none.
ClosedArch closed_arch(const Arch& arch, const ArchJoints& joints, double thickness, double closed);

}  // namespace voussoir::reference
