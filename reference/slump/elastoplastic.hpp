// A slope of steep layers on a base that dips into it, as rigid blocks on elastic, perfectly plastic Coulomb springs
// that do not dilate: relaxed to equilibrium by a plain loop. A second opinion beside limit analysis, whose joints open
// as they slip.
#pragma once

#include <vector>

namespace voussoir::reference {

// The toe is the origin, y points up, the slope faces left. Layers dip out of the slope, base and cross joints into it.
// Behind the last layer and below the base the rock is fixed; the top is level and cuts the blocks that reach it.
struct LayeredSlope {
  double dip = 0, base_dip = 0;  // rad
  double thickness = 0;          // of a layer, across it, m
  double spacing = 0;            // of the cross joints, across them, m
  double height = 0;             // m
  int layers = 0;
  double density = 0, gravity = 0;                   // kg/m³, m/s²
  double normal_stiffness = 0, shear_stiffness = 0;  // Pa/m
};

// a block's motion in the collapse, relative to the largest motion of any corner
struct SlopeBlockMotion {
  int layer = 0, row = 0;  // from the face, from the base
  double x = 0, y = 0;     // of its centroid, 1
  double turn = 0;         // 1/m, counter-clockwise
  double largest = 0;      // of its corners, 1
};

struct SlopeCollapse {
  double collapses = 0, stands = 0;      // rad: the bracket
  std::vector<SlopeBlockMotion> motion;  // at `collapses`, after it was lost
  long long sweeps = 0;                  // of the relaxation, all trials together
};

// The blocks settle at `from`; friction is then bisected between `from`, which must hold them, and `to`, which must
// not, to a bracket of `tolerance`; every trial continues from the last equilibrium. Displacements are small: the
// geometry stays, so that only the ratio of the stiffnesses matters. Throws std::runtime_error if an end of the range
// is on the wrong side, or a trial neither reaches equilibrium nor moves away.
SlopeCollapse elastoplastic_collapse(const LayeredSlope& slope, double from, double to, double tolerance);

// The same between the first of the friction coefficients 1, 2, 4 and 8 that holds the blocks, and zero. Throws
// std::runtime_error also if the last does not hold them.
SlopeCollapse elastoplastic_collapse(const LayeredSlope& slope, double tolerance);

std::vector<double> slope_block_areas(const LayeredSlope& slope);  // m², layer by layer, from the base upwards

}  // namespace voussoir::reference
