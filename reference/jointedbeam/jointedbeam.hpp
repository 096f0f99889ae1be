#pragma once

#include <optional>
#include <vector>

#include "reference/jointedbeam/joint.hpp"

// A beam of rigid blocks between two fixed abutments, joints without tension: the physical model of Talesnick et al.
// (2007) as Boon (2013, section 4.12) calculates it. The abutments are moved in before there is weight, then gravity is
// raised. Equilibrium of the displaced blocks, for displacements of any size; joints as in joint.hpp. Gravity is
// counted in g.
//
// Friction acts cell by cell: a cell of little pressure slips long before the joint does. A friction angle near 90
// degrees excludes that.
//
// m, N, rad; x along the beam from the middle of the left abutment's face, y up.
namespace voussoir::reference {

struct JointedBeam {
  int blocks = 6;
  double length = 0.046, height = 0.046, width = 0.046;  // m, of a block; width out of the plane
  double density = 1207, g = 9.81;                       // kg/m³, m/s²
  double abutment_height = 0.046;                        // m, its middle level with the blocks'
  double thrust = 60;                                    // N at 1 g
  JointLaw joint;
};

struct BeamJoint {
  Point point;                   // m: position of the thrust line in the joint, displaced
  Point force;                   // N, of the left body on the right one
  double normal = 0, shear = 0;  // N, along the joint's own axes
  double sliding = 0;            // fraction of the normal force on cells at the limit of friction
  double open = 0;               // m of the face
  double slip = 0;               // m, of the right face upwards
};

struct BeamBlock {
  Point displacement;   // m, of the centroid
  double rotation = 0;  // rad, counter-clockwise
};

struct BeamState {
  double gravity = 0;             // g
  double thrust = 0;              // N, on the left abutment
  double deflection = 0;          // m, downwards, of the middle joint (odd: of the middle block)
  std::vector<BeamBlock> blocks;  // from the left
  std::vector<BeamJoint> joints;  // one more
};

// resolution of the histories; the equilibrium of each step is exact
struct BeamSteps {
  double gravity = 0.25;     // g
  double deflection = 2e-5;  // m, if the deflection is raised instead
};

// m: by how much both abutments together are moved in to give the stated thrust at 1 g
double abutment_closure(const JointedBeam& beam, const BeamSteps& steps = {});

// Equilibrium at ascending gravities, g. `closure` as from abutment_closure, found if not given. Ends early if the beam
// is lost: fewer states than gravities.
std::vector<BeamState> raise_gravity(const JointedBeam& beam, const std::vector<double>& gravities,
                                     std::optional<double> closure = {}, const BeamSteps& steps = {});

// The same path with the deflection raised instead of gravity, from 1 g to `deflection`: it continues when gravity
// must fall to keep the balance.
std::vector<BeamState> raise_deflection(const JointedBeam& beam, double deflection, const BeamSteps& steps = {});

// greatest gravity of a path by the parabola through its three highest points
struct BeamLimit {
  double gravity = 0;     // g
  double deflection = 0;  // m
};
// Throws std::domain_error when the path rises to its end.
BeamLimit limit_of(const std::vector<BeamState>& path);

// Three hinges exactly at the corners, rigid blocks: no line of thrust rises higher than the beam, so the thrust at a
// gravity is not less than W L/(8 (height - deflection)), W the weight of all blocks, L the span. N.
double least_thrust(const JointedBeam& beam, double gravity, double deflection = 0);

// The voussoir beam of Diederichs & Kaiser (1999), Int. J. Rock Mech. Min. Sci. 36, 97-117: a parabolic arch of
// compression, triangular stress over the fraction N of the height at abutments and mid-span, shortened by its mean
// stress (2/3 + N)/3 of the greatest; of the N for which an arch exists, that of least stress. Their iteration for the
// rise under load is a cubic, which is solved. The modulus is that of the joints, the stiffness at no stress times span
// over joints; no prestress, no shear in joints. It is an estimate, not a bound: N near 0.75, so a thrust of W L/(4
// height).
struct VoussoirBeam {
  double compressed = 0;  // N: fraction of the height
  double thrust = 0;      // N
  double deflection = 0;  // m
  double buckling = 0;    // fraction of N for which there is no arch; 1: none
};
VoussoirBeam voussoir_beam(const JointedBeam& beam, double gravity);
// g: at which no arch is left (`fraction` = 1), or at which this fraction of N has none (their design limit: 0.35)
double voussoir_beam_limit(const JointedBeam& beam, double fraction = 1);

}  // namespace voussoir::reference
