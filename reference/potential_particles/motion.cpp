#include "reference/potential_particles/motion.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "reference/small/small.hpp"

namespace voussoir::reference {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double quadrature_tolerance = 1e-12;
constexpr int most_intervals = 200;

void require(const RollingCorner& body, double lean) {
  if (!(body.mass > 0 && body.inertia > 0 && body.arm > 0 && body.corner_radius >= 0 && body.gravity > 0))
    throw std::invalid_argument(
        "rolling corner: mass, inertia, arm and gravity must be positive, the radius not less than 0");
  if (!(body.start > 0 && body.start < pi && lean >= body.start && lean <= pi))
    throw std::invalid_argument("rolling corner: 0 < start < pi, start <= lean <= pi");
}

// kg m²: about the point of contact
double inertia_at(const RollingCorner& body, double lean) {
  const double L = body.arm, r = body.corner_radius;
  return body.inertia + body.mass * (L * L + r * r + 2 * r * L * std::cos(lean));
}

// cos start - cos lean without cancellation
double fallen(const RollingCorner& body, double more) {
  return 2 * std::sin(body.start + more / 2) * std::sin(more / 2);
}

double speed_after(const RollingCorner& body, double more) {
  return std::sqrt(2 * body.mass * body.gravity * body.arm * fallen(body, more) / inertia_at(body, body.start + more));
}

double slowness(double s, void* parameters) {
  const RollingCorner& body = *static_cast<const RollingCorner*>(parameters);
  return 2 * s / speed_after(body, s * s);
}

}  // namespace

double ball_period(const BouncingBall& ball, double height) {
  if (!(ball.mass > 0 && ball.stiffness > 0 && ball.gravity > 0 && height >= 0))
    throw std::invalid_argument("ball_period: mass, stiffness and gravity must be positive, height not less than 0");
  const double speed = std::sqrt(2 * ball.gravity * height), frequency = std::sqrt(ball.stiffness / ball.mass);
  return 2 * speed / ball.gravity + 2 * (pi - std::atan(frequency * speed / ball.gravity)) / frequency;
}

double centroid_height(const RollingCorner& body, double lean) {
  return body.corner_radius + body.arm * std::cos(lean);
}

double rolling_speed(const RollingCorner& body, double lean) {
  require(body, lean);
  return speed_after(body, lean - body.start);
}

double rolling_time(const RollingCorner& body, double lean) {
  require(body, lean);
  if (lean == body.start) return 0;
  gsl_set_error_handler_off();
  const std::unique_ptr<gsl_integration_workspace, decltype(&gsl_integration_workspace_free)> workspace(
      gsl_integration_workspace_alloc(most_intervals), gsl_integration_workspace_free);
  RollingCorner copy = body;
  gsl_function function{slowness, &copy};
  double time = 0, error = 0;
  // the rule has no point at the ends, where the integrand is a limit
  if (!workspace ||
      gsl_integration_qag(&function, 0, std::sqrt(lean - body.start), 0, quadrature_tolerance, most_intervals,
                          GSL_INTEG_GAUSS31, workspace.get(), &time, &error) != GSL_SUCCESS)
    throw std::runtime_error("rolling corner: the quadrature did not converge");
  return time;
}

RoundedSquare rounded_square(double half, double corner_radius) {
  const double a = half - corner_radius, r = corner_radius;
  if (!(a > 0 && r >= 0)) throw std::invalid_argument("rounded_square: 0 <= corner radius < half");
  // the square, four strips of r, and four quarters of a disc whose centroids lie 4 r/(3 π) beyond the arcs' centres
  const double strip = 2 * a * r;
  const double strip_inertia = strip * ((4 * a * a + r * r) / 12 + std::pow(a + r / 2, 2));
  const double beyond = 4 * r / (3 * pi), quarter = pi * r * r / 4;
  const double quarter_inertia =
      pi * std::pow(r, 4) / 8 - 2 * quarter * beyond * beyond + 2 * quarter * std::pow(a + beyond, 2);
  return {4 * a * a + 4 * strip + 4 * quarter, 8 * std::pow(a, 4) / 3 + 4 * strip_inertia + 4 * quarter_inertia,
          std::numbers::sqrt2 * a};
}

}  // namespace voussoir::reference
