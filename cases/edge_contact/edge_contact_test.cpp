// Edge on edge: overlap, force and normal where no face touches.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cases/case_tools.hpp"

namespace voussoir::cases {
namespace {

using verification::CaseReport;
using verification::Kind;

// as scene.toml states it: a square prism of 4 m3 on a spring
constexpr double weight = 2000 * 4 * 10.0, stiffness = 80e6, overlap = weight / stiffness;
constexpr double degrees = 180 / std::numbers::pi;

struct Rest {
  double overlap, drift, force, tilt;  // m, m, N, deg
};

Rest rest(const SceneRun& run) {
  const auto last = [&](const std::string& name) { return value(run, name); };
  const double across = std::hypot(last("upper_contact_load_x"), last("upper_contact_load_y"));
  Rest r;
  r.overlap = -last("upper_displacement_z");
  r.force = last("upper_contact_load_z");
  r.tilt = std::atan2(across, r.force) * degrees;
  r.drift = 0;
  const std::vector<double> x = column(run, "upper_displacement_x_m"), y = column(run, "upper_displacement_y_m");
  for (std::size_t i = 0; i < x.size(); ++i) r.drift = std::max(r.drift, std::hypot(x[i], y[i]));
  return r;
}

void check(CaseReport& report, const std::string& which, const SceneRun& run) {
  const Rest found = rest(run);
  report.record({"overlap" + which, "m", Kind::exact, "W/k", overlap, {0, 2e-6},
                 "rest leaves 1e-6 of the force unbalanced, the search for the contact point 1e-9 of the overlap"},
                found.overlap, cost(run));
  report.record({"contact force" + which, "N", Kind::exact, "W", weight, {0, 2e-6}, "as the overlap, of which it is k times"},
                found.force, cost(run));
  report.record({"contact force on the base" + which, "N", Kind::exact, "Newton: equal and opposite", -found.force,
                 {0, 1e-15}, "the same number with the other sign"},
                value(run, "lower_contact_load_z"), cost(run));
  report.record({"sideways drift" + which, "m", Kind::exact, "symmetry: a half turn about the vertical", 0, {1e-9 * overlap, 0},
                 "the contact point is found to 1e-9 of the overlap"},
                found.drift, cost(run));
  report.record({"tilt of the contact force" + which, "deg", Kind::exact, "common perpendicular of the edges: vertical", 0,
                 {1e-9 * degrees, 0}, "the contact point is found to 1e-9 of the overlap"},
                found.tilt, cost(run));
}

TEST(EdgeContact, RestsWithoutFriction) {
  CaseReport report("edge_contact", {"overlap", "contact force", "sideways drift"});
  report.reference("overlap", overlap, "m");
  const SceneRun run = cases::run("scene.toml");
  check(report, "", run);
  write_csv("edge_contact", "settlement.csv", {"time_s", "displacement_mm", "force_kN"},
            {column(run, "time_s"), [&] {
               std::vector<double> mm = column(run, "upper_displacement_z_m");
               for (double& u : mm) u *= 1e3;
               return mm;
             }(), [&] {
               std::vector<double> kn = column(run, "upper_contact_load_z_N");
               for (double& f : kn) f *= 1e-3;
               return kn;
             }()});
}

TEST(EdgeContact, RestsWithFriction) {
  CaseReport report("edge_contact");
  check(report, ", friction 30 deg", cases::run("scene.toml", {"joint_properties.edge.friction_deg=30"}));
}

}  // namespace
}  // namespace voussoir::cases
