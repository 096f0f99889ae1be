#pragma once

// A block on an inclined plane that is wider, on an elastic joint without tension, whose normal and shear stiffness are
// spread along the face. SI units, radians, per metre of width; a block leans by `turn` down the slope.
//
// At the turn t a block whose lower and upper corner are d and e beneath the plane overlaps the plane in a wedge or, if
// both are beneath, in a strip. Along the line that halves the angle between face and plane, from one side of the block
// to the other or to the intersection of face and plane, the overlap u is linear and the energy
//
//   E = k/2 int u^2 = k (d^3 - max(e, 0)^3)/(6 sin t cos^7(t/2)),
//
// exact at any turn. It depends on depth and turn alone, so the joint pushes along the plane's normal, N = dE/dd.
namespace voussoir::reference {

struct BlockOnJoint {
  double breadth = 1;               // m along the slope, b
  double height = 2;                // m, h
  double slope = 0;                 // of the plane below horizontal
  double friction_angle = 0;        // the same at rest and in motion
  double density = 2500;            // kg/m3
  double gravity = 9.81;            // m/s2
  double normal_stiffness = 100e9;  // Pa/m, k
  double shear_stiffness = 100e9;   // Pa/m
  double dashpot_ratio = 0;         // of a normal dashpot 2 ratio (k A m)^1/2, A the pressed length
  double ramp = 0;                  // s in which gravity grows from nothing, in proportion to time
};

// Force of the joint on the block at a turn, its centroid `above` the plane; |turn| < pi/2.
struct JointPress {
  struct Place {
    double x = 0, y = 0;  // m from the centroid: down the slope, off the plane
  };
  double energy = 0;     // J/m, E
  double force = 0;      // N/m off the plane, -dE/d above
  double moment = 0;     // N m/m down the slope about the centroid, -dE/d turn
  double length = 0;     // m of the line that halves the angle, in contact
  Place centre, corner;  // of that length; the lower one of the block
};
JointPress press_on_joint(const BlockOnJoint& block, double above, double turn);

// The greatest slope at which the block is in equilibrium, whatever its friction: the largest over all turns of the
// slope that a turn balances, exact in the turn. Throws std::invalid_argument if a number is not positive, or if the
// whole face is still pressed at a quarter of the turn that overturns a rigid block.
double greatest_resting_slope(const BlockOnJoint& block);

// The start from rest, the face just touching: Newton's laws of the block's three freedoms in time. Shear acts along
// the plane, half way along the length in contact, and follows Coulomb's law; length that loses contact takes its shear
// with it. The dashpot acts at the same place.
struct JointStart {
  double slip = 0;  // m that the lower corner has moved down the plane
  double turn = 0;  // rad
  double time = 0;  // s
};
// as it is when the block has turned by `turn`, or else at `time`
JointStart start_on_joint(const BlockOnJoint& block, double turn, double time);

}  // namespace voussoir::reference
