#pragma once

#include <optional>

#include "reference/wedge/wedge.hpp"

// Wedges of rock slopes as textbooks state them: by the planes that bound them. SI units, radians; x east, y north, z
// up.
namespace voussoir::reference {

struct PlaneAngles {
  double dip = 0, direction = 0;
};

// The line of intersection of a and b daylights in the face at the origin, its toe.
struct SlopeWedge {
  PlaneAngles a, b, face, upper;
  double crest_height = 0;  // m: the point in which a, face and upper slope meet, above the toe
  // a tension crack that cuts the upper slope along the trace of a at this distance (m) from the crest
  std::optional<PlaneAngles> crack{};
  double crack_distance = 0;
};

struct SlopeWedgeSolid {
  Vector3 crest{}, crack_point{};  // m: a point of the upper slope, and one of the crack
  double volume = 0;               // m^3
  double area_a = 0, area_b = 0, area_crack = 0;
  double line_height = 0;  // m: vertical extent of the line of intersection, without the crack
  double crack_depth = 0;  // m: of the crack's lowest corner below the upper slope, along the vertical
};

// By its corners: every three planes meet in a point, which is one if it is outside of no other plane. Throws
// std::invalid_argument if the planes enclose no wedge.
SlopeWedgeSolid solid_of(const SlopeWedge& wedge);

// m: crest height of a wedge without crack whose line of intersection has this vertical extent
double crest_height_of_line(const SlopeWedge& wedge, double line_height);

// Hoek & Bray's mean pressure on a, b and the crack: it falls linearly from the crack's lowest corner, or from half of
// the line's height, to zero where a face comes to daylight. Pa.
double mean_water_pressure(const SlopeWedgeSolid& solid, bool cracked, double water_unit_weight);

// Low (1997), Reliability analysis of rock wedges: a tetrahedral wedge in closed form. Horizontal angles beta from the
// crest to the strikes of the joints, their dips delta, face and upper slope of one dip direction.
struct LowWedge {
  double beta_1 = 0, beta_2 = 0, delta_1 = 0, delta_2 = 0, face = 0, upper = 0;  // rad
  double friction_1 = 0, friction_2 = 0;                                         // rad
  double cohesion_1 = 0, cohesion_2 = 0;                                         // Pa
  double crest_height = 0, unit_weight = 0;                                      // m, N/m^3
  double water = 0;  // mean pressure over water_unit_weight times a third of the crest height
};
double factor_of_safety(const LowWedge& wedge, double water_unit_weight);
// the same planes, for a face that dips to the south
SlopeWedge planes_of(const LowWedge& wedge);

}  // namespace voussoir::reference
