// Block on a shaken incline: its slip, in space and in the plane.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cases/case_tools.hpp"
#include "reference/small/small.hpp"
#include "text/angle.hpp"

namespace voussoir::cases {
namespace {

using verification::CaseReport;
using verification::Kind;

constexpr int settle = 1, shake = 2;

// as scene.toml and plane.toml state it: the joint cuts the middle of a cube or square with sides of 2 m
const reference::ShakenIncline shaken{{10 * degree, 30 * degree, 9.81, 0}, 0.4, 2};
constexpr double density = 2000, shear_stiffness = 10e9;

// s since the shaking began: the block does not slip at either
constexpr double first_slip_over = 0.35, end = 1.7;
constexpr double slip_lasts = 0.168;  // s: of a cycle, from 0.195 to 0.363 s after its begin
constexpr double study_end = 1.75;    // as study.toml states it

struct Variant {
  std::string scene, name, test, file;
  int dimension;
  std::vector<std::string> carried{};  // settings of the run
  bool implicit = false;
};

void PrintTo(const Variant& v, std::ostream* out) {
  *out << v.name;
}

// the block's displacement relative to the base
struct Path {
  std::vector<double> time, distance;
};

Path path(const SceneRun& run, int dimension) {
  Path path{column(run, "time_s", shake), {}};
  const double start = column(run, "time_s", settle).back();
  for (double& t : path.time)
    t -= start;
  path.distance.assign(path.time.size(), 0);
  for (const char* axis : {"x", "y", "z"}) {
    if (axis[0] - 'x' == dimension) break;
    const auto of = [&](const std::string& body, int stage) {
      return column(run, body + "_displacement_" + axis + "_m", stage);
    };
    const std::vector<double> block = of("block", shake), base = of("base", shake);
    const double settled = of("block", settle).back();
    for (std::size_t i = 0; i < block.size(); ++i)
      path.distance[i] = std::hypot(path.distance[i], block[i] - settled - base[i]);
  }
  return path;
}

// at the first row from a time on
double distance_at(const Path& path, double time) {
  const auto row = std::lower_bound(path.time.begin(), path.time.end() - 1, time);
  return path.distance[row - path.time.begin()];
}

class Shaking : public testing::TestWithParam<Variant> {};

TEST_P(Shaking, SlipsByNewmarksDistance) {
  const Variant& v = GetParam();
  CaseReport report("shaking", {"first slip, " + v.name, "slip of three more cycles, " + v.name});
  const SceneRun scene = run(v.scene, v.carried);
  const Path found = path(scene, v.dimension);

  // elastic displacement of the joint before it slips, m, and the frequency of the block on it, rad/s
  const double area = v.dimension == 3 ? 4 / std::cos(shaken.incline.angle) : 2 / std::cos(shaken.incline.angle);
  const double mass = density * (v.dimension == 3 ? 4 : 2), stiffness = shear_stiffness * area;
  const double friction = mass * 9.81 * std::cos(shaken.incline.angle) * std::tan(shaken.incline.friction_angle);
  const double elastic = friction / stiffness, frequency = std::sqrt(stiffness / mass);
  const double acceleration = 2 * std::numbers::pi * shaken.frequency * shaken.speed;
  const double fastest = 0.1, lasts = 0.1;  // m/s, s: of a slip, at most
  const double step = scene.results.stages[shake - 1].time_step;

  const double first = reference::shaken_block(shaken, first_slip_over).distance;
  report.record({"first slip, " + v.name,
                 "m",
                 Kind::exact,
                 "Newmark (1965), sliding block",
                 first,
                 {acceleration / frequency * lasts, 0},
                 "the shaking begins with full acceleration: until the joint is fully sheared the plane gains at most "
                 "that over the block's "
                 "frequency on the joint, 3.2 mm/s, and keeps it while the slip lasts, 0.1 s"},
                distance_at(found, first_slip_over), cost(scene));
  // An implicit step in which a slip begins leaves up to j h²/8 of the speed out, j how fast the acceleration passes
  // what friction holds, and the slip keeps it while it lasts.
  const double holds = 9.81 * (std::cos(shaken.incline.angle) * std::tan(shaken.incline.friction_angle) -
                               std::sin(shaken.incline.angle));
  const double jerk = 2 * std::numbers::pi * shaken.frequency * std::sqrt(acceleration * acceleration - holds * holds);
  const double of_step = v.implicit ? jerk * step * step / 8 * slip_lasts : fastest * step;
  report.record(
      {"slip of three more cycles, " + v.name,
       "m",
       Kind::exact,
       "Newmark (1965), sliding block",
       reference::shaken_block(shaken, end).distance - first,
       {3 * (2 * elastic + of_step), 0},
       v.implicit ? "in each cycle a slip of 0.168 s begins within a step of 6 ms, whose friction is one force"
                  : "in each cycle the joint is sheared and released by 2.2 micrometres, and a step of 0.1 m/s is lost "
                    "or gained"},
      found.distance.back() - distance_at(found, first_slip_over), cost(scene));

  // for the study: the block in space when the plane has stopped after three cycles and a half
  if (v.dimension == 2 && !v.implicit) {
    const double uphill = shaken.speed / (std::numbers::pi * shaken.frequency);
    const double downhill = reference::shaken_block(shaken, study_end).distance;
    report.reference("block_displacement_x", (downhill - uphill) * std::cos(shaken.incline.angle), "m");
  }

  std::vector<double> closed_form;
  for (const double t : found.time)
    closed_form.push_back(1e3 * reference::shaken_block(shaken, t).distance);
  std::vector<double> millimetres = found.distance;
  for (double& d : millimetres)
    d *= 1e3;
  write_csv("shaking", v.file, {"time_s", "distance_mm", "closed_form_mm"}, {found.time, millimetres, closed_form});
}

INSTANTIATE_TEST_SUITE_P(Both, Shaking,
                         testing::Values(Variant{"scene.toml", "3-D", "Space", "space.csv", 3},
                                         Variant{"plane.toml", "2-D", "Plane", "plane.csv", 2},
                                         Variant{"plane.toml",
                                                 "2-D, implicit steps",
                                                 "PlaneByImplicitSteps",
                                                 "plane_implicit.csv",
                                                 2,
                                                 {"stage.shake.time.integration=implicit"},
                                                 true}),
                         [](const auto& chosen) { return chosen.param.test; });

}  // namespace
}  // namespace voussoir::cases
