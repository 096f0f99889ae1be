#pragma once

#include <vector>

#include "reference/hingedbeam/overlap.hpp"

// One joint between two rigid faces in the plane that press into each other: no tension, stress by a law of the
// overlap, shear by a law of the slip, Coulomb friction. The face is divided into cells; their stresses are summed, so
// that many cells are a distributed joint and few of them are the contact points of a discrete element code. Boon
// (2013), section 4.12.
namespace voussoir::reference {

// dσ/du or dτ/ds, Pa/m, at the normal stress σ in Pa: constant + factor σ^power (Eqs 4.10, 4.11, 4.13, 4.17)
struct StressStiffness {
  double constant = 0, factor = 0, power = 1;
};
double stiffness_at(const StressStiffness& stiffness, double normal_stress);

// Its integral from zero, Pa; 0 for u <= 0. Closed forms: constant; power 1 (Eqs 4.12, 4.14); no constant and 0 < power
// < 1. Throws std::invalid_argument for others.
double normal_stress(const StressStiffness& stiffness, double overlap);

// μ = tan(angle) (1 - exp(-β/u_peak)), β the plastic slip, u_peak = peak_slip σ^peak_power (Eqs 4.16, 4.18); tan(angle)
// from the start for peak_slip = 0
struct JointFriction {
  double angle = 0;                      // rad
  double peak_slip = 0, peak_power = 0;  // m at 1 Pa
};

enum class CellClosure {
  mean,      // of the overlap over the cell: with linear stiffness exact for any number of cells
  at_point,  // at the centroid of the cell's overlap: 4/3 of the mean if it is a triangle
  at_centre  // of one cell only: at the analytic centre of the overlap, to which all faces of both bodies contribute
};

struct JointLaw {
  StressStiffness normal{.constant = 10e9}, shear{.constant = 1e9};
  JointFriction friction{.angle = 0.6981317007977318};  // 40 degrees
  int cells = 200;
  CellClosure closure = CellClosure::mean;
};

// a rigid face: position of its middle, rotation (counter-clockwise) and height; its outward normal is along +x or -x
struct BeamFace {
  Point middle;     // m
  double turn = 0;  // rad
  double height = 0;
};

struct CellHistory {
  double area = 0, shear = 0, plastic_slip = 0;  // m², N on the right body upwards, m
  double stress = 0;                             // Pa, normal
};
struct JointHistory {
  double slip = 0;  // m, of the right face along the joint, upwards
  std::vector<CellHistory> cells;
};

// Action of the left body on the right one: force, its moment about the left face's middle, and the components along
// the joint's own axes (the mean of both faces').
struct JointForce {
  Point force;                   // N
  double moment = 0;             // N m
  double normal = 0, shear = 0;  // N
  double sliding = 0;            // N: part of the normal force on cells at the limit of friction
  double open = 0;               // m of the face that does not touch
  Point point;                   // point at which the resultant crosses the joint, from the left face's middle
};

// The force at a position that the joint reached from `history`, and its new history. Slip is taken in one increment,
// with the mean of the stiffness before and after: exact for constant shear stiffness without friction while the area
// does not grow.
JointForce joint_force(const JointLaw& law, double width, const BeamFace& left, const BeamFace& right,
                       const JointHistory& history, JointHistory& next);

}  // namespace voussoir::reference
