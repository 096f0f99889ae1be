// The cube that slides down a slab, the whole problem turned: no direction of space is special.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "cases/case_tools.hpp"
#include "reference/small/small.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::turned_test {
namespace {

using verification::CaseReport;
using verification::Kind;

// as turned.toml states it
constexpr double duration = 0.5, gravity = 9.81, stiffness = 1e9, mass = 2000;
const reference::Incline incline{20 * degree, 30 * degree, gravity, 1};

std::string vector_text(const Eigen::Vector3d& v) {
  return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v[0], v[1], v[2]);
}

std::string corners_text(const Eigen::Matrix3d& turn, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  std::string text;
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3d corner(k & 1 ? high[0] : low[0], k & 2 ? high[1] : low[1], k & 4 ? high[2] : low[2]);
    text += (k ? ", " : "[") + vector_text(turn * corner);
  }
  return text + "]";
}

double path(const Eigen::Matrix3d& turn, verification::Cost& spent) {
  const double angle = incline.angle;
  const Eigen::Vector3d down = turn * Eigen::Vector3d(gravity * std::sin(angle), 0, -gravity * std::cos(angle));
  const SceneRun run =
      cases::run("turned.toml",
                 {"gravity=" + vector_text(down), "blocks.slab.vertices=" + corners_text(turn, {-6, -3, -1}, {6, 3, 0}),
                  "blocks.cube.vertices=" + corners_text(turn, {-0.5, -0.5, 0}, {0.5, 0.5, 1}),
                  "blocks.cube.velocity=" + vector_text(turn.col(0))});
  spent = cost(run);
  double squares = 0;
  for (const char* axis : {"x", "y", "z"})
    squares += std::pow(column(run, std::string("cube_displacement_") + axis + "_m").back(), 2);
  return std::sqrt(squares);
}

TEST(Incline, SlidesAsFarInEveryPosition) {
  const std::string sent = "cube sent off at 1 m/s: path, ";
  CaseReport report("incline", {sent + "as drawn", sent + "least of the turned positions",
                                sent + "greatest of the turned positions"});
  const double expected = reference::incline_distance(incline, duration);
  const double sinking = mass * gravity * std::cos(incline.angle) / stiffness;
  const auto record = [&](const std::string& which, double value, const verification::Cost& spent) {
    report.record(
        {sent + which,
         "m",
         Kind::exact,
         "Newton: v t + g (sin - cos tan) t2/2",
         expected,
         {2 * sinking, 0},
         "it is set down on a slab that does not yet press: until the joint bears the weight, for a quarter of a "
         "swing, friction is missing and the cube sinks; both are of the order of the overlap under its weight"},
        value, spent);
  };
  verification::Cost spent;
  const double drawn = path(Eigen::Matrix3d::Identity(), spent);
  record("as drawn", drawn, spent);
  double least = 1e300, greatest = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (const double angle : {15, 30, 45, 60, 90}) {
      const double here =
          path(Eigen::AngleAxisd(angle * degree, Eigen::Vector3d::Unit(axis)).toRotationMatrix(), spent);
      least = std::min(least, here);
      greatest = std::max(greatest, here);
    }
  record("least of the turned positions", least, spent);
  record("greatest of the turned positions", greatest, spent);
}

}  // namespace
}  // namespace voussoir::cases::turned_test
