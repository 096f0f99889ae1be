// Elementary functions from +, -, *, / and exact scaling alone, in a fixed order: the same bits wherever doubles are
// IEEE 754 and nothing is fused. The C library's differ in the last bit from one system to the next, and every joint
// drawn by them would differ too.
#pragma once

namespace voussoir::portable {

// natural logarithm of a positive finite number; within 2 ulp, near 1 within 2 ulp of x - 1
double log(double x);

// |x| <= 700; within 2 ulp
double exp(double x);

// |x| <= 100 rad; within 3e-16 absolute
double sine(double x);
double cosine(double x);

// rad, -pi to pi, of the direction (x, y), which is not zero; within 1e-15 absolute
double angle(double x, double y);

}  // namespace voussoir::portable
