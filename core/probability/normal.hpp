// The normal distribution of mean 0 and deviation 1, in IEEE arithmetic and `portable_math` only: the same bits on
// every machine. Its digits are those of the lower tail; for the upper half ask for -z.
#pragma once

namespace voussoir {

double normal_density(double z);          // φ(z); 0 where it is below the least double
double normal_probability(double z);      // Φ(z), relative error below 1e-14 wherever Φ is a normal double
double log_normal_probability(double z);  // log Φ(z), also where Φ is below the least double

// z of Φ(z) = p, 0 < p < 1. Exact in the lower tail; above 1/2 the digits are those of p, so ask for -z of 1 - p there.
double normal_quantile(double p);

// P(X <= a, Y <= b) of two normals, -1 <= correlation <= 1; relative error some 1e-10 down to 1e-30
double bivariate_normal_probability(double a, double b, double correlation);

}  // namespace voussoir
