#pragma once

#include <array>
#include <limits>
#include <vector>

// The volume of a slide in space between two surfaces made of planes: the sliding surface is the highest of its planes,
// the ground of each strip the lowest of its planes. By the midpoint rule over a grid, whose error falls with the
// square of its spacing but for the edges of the surfaces. SI units; x east, y north, z up.
namespace voussoir::reference {

struct DippingPlane {
  double dip = 0, dip_direction = 0;  // degrees, the direction from north (y) over east (x)
  std::array<double, 3> point{};      // m
  double elevation(double x, double y) const;
};

struct GroundStrip {
  double west = 0, east = 0, south = 0, north = 0;  // m
  std::vector<DippingPlane> planes;
};

struct SlideInSpace {
  double west = 0, east = 0, south = 0, north = 0;  // m
  std::vector<DippingPlane> slide;
  std::vector<GroundStrip> ground;  // they may overlap: the lowest holds
  DippingPlane gorge;               // below it
};

// The Vaiont slide west of its eastern boundary, or of another end in the east, m: dips after Boon (2013), section 6.5,
// ground and boundary as in his input, points of the slide's planes reconstructed.
SlideInSpace vaiont_in_space(double east = 2690);

struct SlideVolumes {
  double all = 0, below = 0;  // m3: of the slide, and of its part below an elevation
  double plan = 0;            // m2, seen from above
  double thickest = 0;        // m
};

SlideVolumes slide_volumes(const SlideInSpace& slide, double spacing,
                           double elevation = std::numeric_limits<double>::infinity());

}  // namespace voussoir::reference
