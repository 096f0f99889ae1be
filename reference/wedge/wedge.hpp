#pragma once

#include <array>
#include <optional>
#include <string>

// A block on two planes by limit equilibrium: the rigid wedge of rock slope engineering, general form.
//
// Sources: Hoek & Bray (1974), Rock Slope Engineering, wedge failure (factor of safety, contact lost on one plane);
// Warburton (1981), Vector stability analysis of an arbitrary polyhedral rock block, IJRMMS 18, 415-427 (the modes
// distinguished apart with vectors). No moments: the block only translates.
//
// x east, y north, z up; angles in radians; forces in any one unit. The block is above both planes: the normal of a
// plane points up and into the block (a vertical plane's normal points along its dip direction).
namespace voussoir::reference {

using Vector3 = std::array<double, 3>;

struct WedgePlane {
  double dip = 0;             // below horizontal, 0..pi/2
  double dip_direction = 0;   // clockwise from north, any value
  double friction_angle = 0;  // 0 <= angle < pi/2
  double cohesion_force = 0;  // cohesion times area, >= 0; acts only while the planes stay in contact
  double uplift_force = 0;    // water force on the face, >= 0; acts along the normal into the block, contact or not
};

struct Wedge {
  WedgePlane a, b;
  double weight = 1;      // > 0, acts along -z
  Vector3 extra_force{};  // any other force on the block: anchor, earthquake, surcharge
};

enum class WedgeMode { both_planes, plane_a, plane_b, lifts_off };

struct WedgeSolution {
  WedgeMode mode = WedgeMode::both_planes;
  double normal_force_a = 0;  // effective (less the water's), >= 0; 0 if contact is lost
  double normal_force_b = 0;
  double driving_force = 0;     // part of the resultant along the sliding direction, >= 0
  double factor_of_safety = 0;  // strength / driving force; +infinity if nothing drives, 0 if the block lifts off
  Vector3 sliding_direction{};  // unit; direction of sliding
  double line_trend = 0;        // line of intersection, downward end: clockwise from north, [0, 2 pi)
  double line_plunge = 0;       // below horizontal, 0..pi/2
};

// "both planes", "plane A only", "plane B only", "lifts off both"
std::string describe(WedgeMode mode);

// Upward unit normal of a plane: (sin d sin p, sin d cos p, cos d), d the dip, p the dip direction.
Vector3 upward_normal(double dip, double dip_direction);

// Unit vector down the dip.
Vector3 down_dip(double dip, double dip_direction);

// With R the resultant of weight, extra force and uplifts, N_A n_A + N_B n_B + S s + R = 0, s along the line of
// intersection, determines N_A and N_B. Both positive: sliding on both. A negative one: contact is lost there and the
// block slides on the other plane along the projection of R (Hoek & Bray 1974; Warburton 1981). R off both planes: it
// lifts. Throws std::invalid_argument on parallel planes or values out of range.
WedgeSolution solve_wedge(const Wedge& wedge);

// The friction angle, equal on both planes, at which the factor of safety is one (the planes' own angles are ignored):
// tan(phi) = (S - cohesion) / (N_A + N_B) over the planes in contact, since the normal forces do not depend on
// friction. 0 if cohesion alone holds the block; empty if no angle below 90 degrees does (it lifts off).
std::optional<double> critical_friction(const Wedge& wedge);

struct WedgeClass {
  bool non_degenerate = false;
  std::string reason;  // empty if non-degenerate; else which condition failed, and the value
};

// Whether the wedge is far enough from a change of mode for a discrete-element model to find the same result. Gravity
// only, the planes' strengths ignored. Line plunge >= 15 degrees; every plane that supports load has N >= 0.05 W; with
// t_i the down-dip vector of plane i, sliding on both needs t_A.n_B <= -0.3 and t_B.n_A <= -0.3, sliding on plane i
// alone needs t_i.n_j >= 0.3. Nearer the border the critical angle depends on the loading path by up to 0.5 degrees.
WedgeClass classify_wedge(const Wedge& wedge);

}  // namespace voussoir::reference
