#pragma once

#include <vector>

// Two blocks between two abutments, loaded by their weight: the three-hinged beam (Boon 2013, section 4.11 and appendix
// E; after Goodman 1989, chapter 7, problem 22). Each block turns by `rotation`, its end faces press their corners into
// abutment and neighbour, and the thrust times the arm between the corners supports the weight. Only the joints deform:
// they have a stiffness in N/m, whatever their area.
//
// m, N (in the plane: per metre), rad. By symmetry one half is treated, the left one, which turns clockwise.
namespace voussoir::reference {

struct HingedBeam {
  double length = 0.138;     // m, of one block
  double depth = 0.046;      // m
  double stiffness = 100e6;  // N/m, of an abutment's joint; that at mid-span, on twice the overlap, has half of it
};

struct HingedBeamLoad {
  double rotation = 0;  // rad
  double weight = 0;    // N, of one block
  double thrust = 0;    // N, horizontal
};

// Rotation at which the three hinges are in one line (Goodman 1989): atan(depth/length).
double hinged_beam_geometric_limit(const HingedBeam& beam);

// The first-order theory, equilibrium of the undeformed beam: corners press in by δ = depth θ/2, forces act at depth/6
// from the edges on an overlap of 2δ/3, so H = K depth θ/3 and W = 4 K depth² θ/(9 length). No snap-through.
HingedBeamLoad hinged_beam_first_order(const HingedBeam& beam, double rotation);

// Eqs E.1 and E.2, equilibrium of the deformed beam: corner penetration δ = (L1 cosθ + L2 sinθ - L1)/2, centroid
// of the overlap y = δ (cotθ - tanθ)/3 from the corner, overlap d = δ (2 + tan²θ)/3 there, arm l = L2 cosθ - L1 sinθ
// - 2y, thrust H = K d, weight W = 2 H l/L1. Tall walls, horizontal forces; the weight's arm stays L1/2. 0 < θ.
HingedBeamLoad hinged_beam_second_order(const HingedBeam& beam, double rotation);

enum class HingePoint {
  centroid,        // of the overlap
  analytic_centre  // maximum of the sum of the logarithms of the distances to all faces of both bodies
};
enum class HingeNormal {
  horizontal,
  mean  // of the two faces that meet: tilted by half the rotation at the abutment
};

// the fixed block at the end: a rectangle whose inner face holds the beam's end
struct HingeAbutment {
  double below = 0, above = 0;  // m: how far it reaches below the beam's lower edge and above its upper one
  double thickness = 0.138;     // m
};

// The same as a discrete element code computes it: the point of action and the line of each force are stated, overlap
// regions are clipped and their analytic centre is found by maximisation, and the weight has its true arm.
struct HingedBeamModel {
  HingedBeam beam;
  HingeAbutment abutment;
  HingePoint point = HingePoint::centroid;
  HingeNormal normal = HingeNormal::mean;
};

struct HingedBeamState : HingedBeamLoad {
  double normal_force = 0, shear_force = 0;  // N, of the abutment on the block: along the normal, and upwards across it
  double x = 0, y = 0;                       // m: the block's centroid from the middle of the abutment's face
};

// Equilibrium at a rotation, 0 < rotation, while the ends still touch: the sideways position follows from equal
// thrusts, the shear force from the weight. The lower corner at the abutment is `raised` above its first height, which
// matters if the abutment ends near it. Throws std::domain_error when the block touches one side only.
HingedBeamState hinged_beam_equilibrium(const HingedBeamModel& model, double rotation, double raised = 0);

// The same along a path on which the abutment's joint deforms in shear, by a stiffness in N/m without slip: T' = -Ks (v
// · t), v the velocity of the block's material at the point of contact. In `steps` equal steps from zero to `rotation`;
// the error estimated by doubling is below 1e-4 of the weight from 200 steps on.
std::vector<HingedBeamState> hinged_beam_path(const HingedBeamModel& model, double shear_stiffness, double rotation,
                                              int steps);

// the greatest weight and its rotation on a smooth curve; E.2 and `hinged_beam_equilibrium` at the first height
HingedBeamLoad hinged_beam_second_order_peak(const HingedBeam& beam);
HingedBeamState hinged_beam_peak(const HingedBeamModel& model);

// The greatest weight of a sampled curve, by the parabola through the greatest sample and its neighbours; samples need
// not be evenly spaced. Throws std::domain_error when the greatest is the first or the last.
HingedBeamLoad peak_of(const std::vector<HingedBeamLoad>& curve);

}  // namespace voussoir::reference
