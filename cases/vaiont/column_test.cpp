// Three blocks on the back (figures 6.13 to 6.15): below their friction angle they creep while their joints vibrate,
// and are in equilibrium without vibration.
#include <gtest/gtest.h>

#include <cmath>

#include "cases/case_tools.hpp"

namespace voussoir::cases::column_test {
namespace {

using verification::Bound;
using verification::CaseReport;
using verification::Kind;

struct Creep {
  SceneRun run;
  std::vector<double> time, way;  // s, mm: of the bottom block, from the end of the damping on

  double last() const { return way.back(); }
};

Creep creep(const std::string& scene, const std::vector<std::string>& overrides = {}) {
  constexpr int free = 2;  // stage
  Creep found{run(scene, overrides), {}, {}};
  found.time = column(found.run, "time_s", free);
  const std::vector<double> x = column(found.run, "bottom_displacement_x_m", free),
                            y = column(found.run, "bottom_displacement_y_m", free);
  const double start = found.time.front();
  for (std::size_t row = 0; row < x.size(); ++row) {
    found.time[row] -= start;
    found.way.push_back(1e3 * std::hypot(x[row] - x.front(), y[row] - y.front()));
  }
  return found;
}

TEST(VaiontColumn, CreepsWhileItRings) {
  CaseReport report("vaiont", {"way of the column from rest", "way of the column that rings"});
  const std::string bound = "equilibrium: 37.49 deg are below 40 deg: a column in equilibrium stays";
  const Creep rough = creep("column.toml"), rest = creep("column_relaxed.toml"),
              damped = creep("column.toml", {"stage.free.damping.viscous_ratio=0.1"});
  report.record({"way of the column from rest", "mm", Kind::limit, bound, 0, {1e-6, 0}, "1e-9 of unbalanced force"},
                rest.last(), cost(rest.run));
  report.record({"way of the column that rings",
                 "mm",
                 Kind::limit,
                 "Boon (2013), figure 6.14: sliding becomes obvious after 30 s",
                 10,
                 {0, 0, Bound::at_least},
                 "the displacement itself is not legible"},
                rough.last(), cost(rough.run));
  report.record({"way of the column at 0.1 of critical damping",
                 "mm",
                 Kind::limit,
                 "comparison: the vibration decays within some periods",
                 0.1 * rough.last(),
                 {0, 0, Bound::at_most},
                 "a tenth of the undamped displacement: it ends after a second, of 60"},
                damped.last(), cost(damped.run));
  report.record({"energy of the column unexplained",
                 "1",
                 Kind::limit,
                 "conservation of energy",
                 0,
                 {0.05, 0, Bound::at_most},
                 "as demanded, of the largest energy of the run"},
                rough.run.results.energy.relative_error());
  write_csv("vaiont", "column.csv", {"time_s", "way_mm"}, {rough.time, rough.way});
  write_csv("vaiont", "column_damped.csv", {"time_s", "way_mm"}, {damped.time, damped.way});
  write_csv("vaiont", "column_rest.csv", {"time_s", "way_mm"}, {rest.time, rest.way});
}

}  // namespace
}  // namespace voussoir::cases::column_test
