// Edge on edge: overlap, force and normal without any face in contact.
#include <gtest/gtest.h>

#include <cmath>

#include "cases/case_tools.hpp"
#include "text/angle.hpp"

namespace voussoir::cases {
namespace {

using verification::CaseReport;
using verification::Kind;

// as scene.toml states it: a square prism of 4 m3 on a spring
constexpr double weight = 2000 * 4 * 10.0, stiffness = 80e6, shear_stiffness = 8e6, overlap = weight / stiffness;

struct Rest {
  double overlap, drift, force, tilt;  // m, m, N, deg
};

Rest rest(const SceneRun& run) {
  const auto last = [&](const std::string& name) { return value(run, name); };
  const double across = std::hypot(last("upper_contact_load_x"), last("upper_contact_load_y"));
  Rest r;
  r.overlap = -last("upper_displacement_z");
  r.force = last("upper_contact_load_z");
  r.tilt = std::atan2(across, r.force) / degree;
  r.drift = 0;
  const std::vector<double> x = column(run, "upper_displacement_x_m"), y = column(run, "upper_displacement_y_m");
  for (std::size_t i = 0; i < x.size(); ++i)
    r.drift = std::max(r.drift, std::hypot(x[i], y[i]));
  return r;
}

void check(CaseReport& report, const std::string& which, const SceneRun& run) {
  const Rest found = rest(run);
  report.record(
      {"overlap" + which,
       "m",
       Kind::exact,
       "equilibrium: W/k",
       overlap,
       {0, 2e-6},
       "equilibrium leaves 1e-6 of the force unbalanced, the search for the contact point 1e-9 of the overlap"},
      found.overlap, cost(run));
  report.record({"contact force" + which,
                 "N",
                 Kind::exact,
                 "equilibrium: W",
                 weight,
                 {0, 2e-6},
                 "as the overlap, of which it is k times"},
                found.force, cost(run));
  report.record({"contact force on the base" + which,
                 "N",
                 Kind::exact,
                 "Newton: equal and opposite",
                 -found.force,
                 {0, 1e-15},
                 "the same number with the other sign"},
                value(run, "lower_contact_load_z"), cost(run));
  report.record({"sideways drift" + which,
                 "m",
                 Kind::exact,
                 "symmetry: a half turn about the vertical",
                 0,
                 {1e-9 * overlap, 0},
                 "the contact point is found to 1e-9 of the overlap"},
                found.drift, cost(run));
  report.record({"tilt of the contact force" + which,
                 "deg",
                 Kind::exact,
                 "geometry: common perpendicular of the edges: vertical",
                 0,
                 {1e-9 / degree, 0},
                 "the contact point is found to 1e-9 of the overlap"},
                found.tilt, cost(run));
}

TEST(EdgeContact, HasEquilibriumWithoutFriction) {
  CaseReport report("edge_contact", {"overlap", "contact force", "sideways drift"});
  report.reference("upper_displacement_z", -overlap, "m");
  const SceneRun run = cases::run("scene.toml");
  check(report, "", run);

  std::vector<double> closing = column(run, "upper_displacement_z_m"), force = column(run, "upper_contact_load_z_N");
  for (double& u : closing)
    u *= -1e3;
  for (double& f : force)
    f *= 1e-3;
  write_csv("edge_contact", "settlement.csv", {"time_s", "overlap_mm", "force_kN"},
            {column(run, "time_s"), closing, force});
  write_csv("edge_contact", "closed_form.csv", {"overlap_mm"}, {{1e3 * overlap}});
}

TEST(EdgeContact, HasEquilibriumWithFriction) {
  CaseReport report("edge_contact");
  check(report, ", friction 30 deg", cases::run("scene.toml", {"joint_properties.edge.friction_deg=30"}));
}

// An edge whose faces dip differently: the method's normal is not the common perpendicular.
TEST(EdgeContact, UnevenEdgeIsReported) {
  CaseReport report("edge_contact");
  const SceneRun run = cases::run("uneven.toml");
  const double sideways = std::hypot(value(run, "upper_displacement_x"), value(run, "upper_displacement_y"));
  report.report("tilt of the normal, uneven edge", "deg", std::asin(shear_stiffness * sideways / weight) / degree,
                "the direction of each edge is the bisector of its faces, one upright, one tilted by 8.13 deg; the "
                "normal is the mean; from the friction that holds the block",
                cost(run));
}

}  // namespace
}  // namespace voussoir::cases
