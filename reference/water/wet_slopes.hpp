#pragma once

// Blocks that water pushes and lifts: limit equilibrium with effective contact forces (Terzaghi), per metre of slope.
// SI units, radians.
namespace voussoir::reference {

inline constexpr double water_unit_weight = 9810;  // N/m^3

// Acceleration (m/s^2) down an incline of a block wholly below one level of still water, its joint included: buoyancy
// reduces weight and contact force by the same fraction, (1 - rho_w/rho) g (sin - cos tan phi); 0 if friction holds it.
// `density_ratio` rho/rho_w > 1. The water's resistance and added mass are neglected.
double submerged_acceleration(double incline, double friction_angle, double density_ratio, double gravity);

// --- plane failure with a vertical tension crack behind the crest (Hoek & Bray 1981, Rock Slope Engineering, ch. 7)

struct PlaneFailure {
  double height = 0;           // m, of the slope
  double face = 0, joint = 0;  // rad, dips: joint < face
  double crack_distance = 0;   // m behind the crest, at which the joint must still be below the horizontal top
  double unit_weight = 0;      // N/m^3
  double water_in_crack = 0;   // m above the joint, 0 .. crack_depth
  double cohesion = 0;         // Pa, on the joint
  double friction_angle = 0;   // rad
};

struct PlaneFailureForces {
  double joint_length = 0;  // m, from the toe to the crack
  double crack_depth = 0;   // m
  double weight = 0;        // N/m
  double uplift = 0;        // N/m, U = gamma_w z_w length/2: falls linearly to the toe
  double thrust = 0;        // N/m, V = gamma_w z_w^2/2, horizontal
};

// Throws std::invalid_argument on values out of range.
PlaneFailureForces forces_of(const PlaneFailure& slope);

// (c A + (W cos - U - V sin) tan phi)/(W sin + V cos); 0 if the contact force is not compressive.
double factor_of_safety(const PlaneFailure& slope);

// The friction angle at which it slides without cohesion, rad. Throws std::invalid_argument if none holds it.
double critical_friction(const PlaneFailure& slope);

// --- a gravity block on its foundation, water on one side and uplift below that falls linearly to zero at the other

struct GravityBlock {
  double width = 0, height = 0;  // m
  double unit_weight = 0;        // N/m^3
  double water = 0;              // m on its one side, 0 .. height
};

// tan phi = V/(W - U), V = gamma_w h^2/2, U = gamma_w h b/2.
double critical_friction(const GravityBlock& block);

// The depth of water (m, `water` of the block ignored) at which it tips about its dry edge, supported there only:
// gamma_w h^3/6 + gamma_w h b^2/3 = gamma H b^2/2. Throws std::invalid_argument if that is above its top.
double tipping_water(const GravityBlock& block);

// --- a block on an incline whose joint is still full after the drawdown of the reservoir

struct DrawnDownBlock {
  double length = 0, height = 0;  // m, along the incline and across it
  double incline = 0;             // rad
  double unit_weight = 0;         // N/m^3
  double level = 0;               // m above the block's lowest corner, at least that of the joint's upper end
};

// The height (m) of its highest corner above its lowest.
double highest_corner(const DrawnDownBlock& block);

// tan phi = W sin/(W cos - U), U = gamma_w l (level - l sin/2). Throws std::invalid_argument if the water lifts it.
double critical_friction(const DrawnDownBlock& block);

}  // namespace voussoir::reference
