#pragma once

// A slab that slides on one joint whose strength scatters. SI units, radians.
namespace voussoir::reference {

// Cohesion is lognormal, with the mean and deviation of the value itself; the friction angle is normal.
struct ScatteredSlab {
  double length = 1;                                 // m, of the joint per metre of width: its area
  double weight = 1;                                 // N/m
  double dip = 0;                                    // of the joint, 0 .. pi/2
  double cohesion_mean = 0, cohesion_deviation = 0;  // Pa
  double friction_mean = 0, friction_deviation = 0;  // rad
};

// rad: the friction angle at which it just stands with this cohesion; below 0 if cohesion alone is more than enough
double critical_friction(const ScatteredSlab& slab, double cohesion);

// p = ∫ φ(z) Φ((φ*(c(z)) - m)/s) dz, c(z) the cohesion at the standard normal z, m and s of the friction. By the
// trapezoidal rule, which converges exponentially here.
double failure_probability(const ScatteredSlab& slab, int intervals = 4000);

// β of first-order reliability: the least √(z² + ((φ*(c(z)) - m)/s)²)
double reliability_index(const ScatteredSlab& slab);

// Φ(-beta)
double probability_of_index(double beta);

}  // namespace voussoir::reference
