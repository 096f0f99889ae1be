#pragma once

#include <functional>
#include <vector>

// Ordinary differential equations y' = f(x, y), for references that have no closed form and for checking those that
// have.
namespace voussoir::reference {

using OdeRight = std::function<void(double x, const double* y, double* slope)>;

// y at x_end from y at x_begin (x_end may be the smaller), by the embedded Runge-Kutta-Prince-Dormand pair of order
// 8(9) (Hairer, Norsett & Wanner 1993, section II.5) with the given relative tolerance per step. `first_step` is tried
// first, as a share of the interval, and shortened if its error is too large. Throws std::runtime_error when the step size
// collapses.
std::vector<double> integrate_ode(const OdeRight& right, std::vector<double> y, double x_begin, double x_end,
                                  double relative_tolerance = 1e-12, double first_step = 1e-3);

}  // namespace voussoir::reference
