// The blocks of a problem for the eye: a mesh and a sketch.
#pragma once

#include <string>

#include "verification/problems/problem.hpp"

namespace voussoir::problems {

// Wavefront OBJ, m, an object for each block, faces counter-clockwise from outside
std::string blocks_obj(const Problem& problem);

// SVG: a problem in the plane seen along y, one in space in parallel projection; fixed blocks are hatched grey; the
// problem's dimensions, gravity at full strength and initial velocities as arrows
std::string sketch_svg(const Problem& problem);

}  // namespace voussoir::problems
