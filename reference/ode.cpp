#include "reference/ode.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <memory>
#include <stdexcept>
#include <string>

namespace voussoir::reference {
namespace {

int evaluate(double x, const double* y, double* slope, void* right) {
  (*static_cast<const OdeRight*>(right))(x, y, slope);
  return GSL_SUCCESS;
}

}  // namespace

std::vector<double> integrate_ode(const OdeRight& right, std::vector<double> y, double x_begin, double x_end,
                                  double relative_tolerance, double first_step) {
  if (x_begin == x_end) return y;
  gsl_set_error_handler_off();
  OdeRight copy = right;
  gsl_odeiv2_system system{evaluate, nullptr, y.size(), &copy};
  const double step = first_step * (x_end - x_begin);  // signed: it gives the direction
  const std::unique_ptr<gsl_odeiv2_driver, decltype(&gsl_odeiv2_driver_free)> driver(
      gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, step, relative_tolerance * 1e-3,
                                    relative_tolerance),
      gsl_odeiv2_driver_free);
  if (!driver) throw std::runtime_error("ode: no memory, or a tolerance that is not positive");
  double x = x_begin;
  const int status = gsl_odeiv2_driver_apply(driver.get(), &x, x_end, y.data());
  if (status != GSL_SUCCESS)
    throw std::runtime_error(std::string("ode: ") + gsl_strerror(status) + "; loosen the relative tolerance");
  return y;
}

}  // namespace voussoir::reference
