// Rocking block: its quarter period, the restitution of its impacts, and the moment that holds it when it is rotated
// slowly on its base.
#include <gtest/gtest.h>

#include <cmath>

#include "cases/case_tools.hpp"
#include "cases/recorded_run.hpp"
#include "reference/small/rocking.hpp"
#include "text/angle.hpp"

namespace voussoir::cases {
namespace {

using verification::Bound;
using verification::CaseReport;
using verification::Kind;

constexpr int hold = 1, rock = 2;

// as the scenes state it
const reference::RockingBlock block{1, 4, 2500, 9.81};
constexpr double stiffness = 100e9, soft = 1e9;           // Pa/m: of scene.toml and of tilt.toml
constexpr double dashpot_ratio = 0.1, turn_speed = 3e-4;  // rad/s: of tilt.toml
const double start = 0.5 * slenderness(block);

// lean to the right since the block was released; rows of the history
struct Rocking {
  std::vector<double> time, lean, spin;  // s, rad, rad/s, both to the right
};

Rocking rocking(const SceneRun& run) {
  Rocking r{column(run, "time_s", rock), column(run, "block_rotation_deg", rock),
            column(run, "block_angular_velocity_rad_per_s", rock)};
  const double let_go = column(run, "time_s", hold).back();
  for (double& t : r.time)
    t -= let_go;
  for (double& lean : r.lean)
    lean = start - lean * degree;
  for (double& spin : r.spin)
    spin = -spin;
  return r;
}

// times at which a column changes its sign, and the other column there
std::vector<std::pair<double, double>> zeros(const std::vector<double>& time, const std::vector<double>& of,
                                             const std::vector<double>& other) {
  std::vector<std::pair<double, double>> found;
  for (std::size_t i = 1; i < of.size(); ++i) {
    if (!(of[i - 1] * of[i] < 0)) continue;
    const double fraction = of[i - 1] / (of[i - 1] - of[i]);
    found.emplace_back(time[i - 1] + fraction * (time[i] - time[i - 1]),
                       other[i - 1] + fraction * (other[i] - other[i - 1]));
  }
  return found;
}

void judge_quarter_period(CaseReport& report, const std::string& which, const std::vector<std::string>& carried) {
  std::vector<std::string> overrides{"stage.rock.duration_s=0.75", "time.fraction=0.05",
                                     "output.history_interval_s=0.001"};
  overrides.insert(overrides.end(), carried.begin(), carried.end());
  const SceneRun fine = run("scene.toml", overrides);
  const Rocking r = rocking(fine);
  const auto upright = zeros(r.time, r.lean, r.spin);
  ASSERT_FALSE(upright.empty());
  const StageResult& stage = fine.results.stages[rock - 1];
  const double step = stage.time / static_cast<double>(stage.steps);
  const double expected = elastic_quarter_period(block, start, stiffness, stiffness);
  report.record({"quarter period" + which,
                 "s",
                 Kind::exact,
                 "Housner (1963) on an elastic base: Newton's laws of a rigid block, reference/small",
                 expected,
                 {step, 0},
                 "one time step, since the block is released between two; the base's delay is thirty of them"},
                upright.front().first, cost(fine));
}

// Steps of ten times the explicit limit. What presses of a leaning face is taken at five points: the base's delay,
// which is all that differs from a rigid one, errs by less than a tenth.
void judge_quarter_period_by_implicit_steps(CaseReport& report) {
  const SceneRun run_of = run("scene.toml", {"stage.rock.duration_s=0.75", "stage.rock.damping.viscous_ratio=0",
                                             "stage.rock.time.integration=implicit", "stage.rock.time.step_s=0.0037",
                                             "output.history_interval_s=0.001", whole_faces});
  const Rocking r = rocking(run_of);
  const auto upright = zeros(r.time, r.lean, r.spin);
  ASSERT_FALSE(upright.empty());
  const double expected = elastic_quarter_period(block, start, stiffness, stiffness);
  report.record({"quarter period, implicit steps",
                 "s",
                 Kind::exact,
                 "Housner (1963) on an elastic base: Newton's laws of a rigid block, reference/small",
                 expected,
                 {0.1 * (expected - rigid_quarter_period(block, start)), 0},
                 "a tenth of the base's delay: what presses of the leaning face is taken at five points"},
                upright.front().first, cost(run_of));
}

TEST(Rocking, TakesItsQuarterPeriod) {
  CaseReport report("rocking", {"quarter period", "quarter period, whole face", "quarter period, implicit steps"});
  judge_quarter_period(report, "", {});
  judge_quarter_period(report, ", whole face", {whole_faces});
  judge_quarter_period_by_implicit_steps(report);
  report.reference("block_rotation", to_degrees(elastic_turn(block, start, stiffness, stiffness, 0.5)), "deg");
  const std::string note = "for comparison: the base delays the block by its pressed length";
  report.report("quarter period, rigid base", "s", rigid_quarter_period(block, start), note);
  report.report("quarter period, Housner's closed form", "s", housner_quarter_period(block, start),
                "acosh(2)/p; sines taken as angles");
}

// energy of a rigid block without velocity at this lean, over its weight; m
double raised(double lean) {
  const double radius = 0.5 * std::hypot(block.breadth, block.height), alpha = slenderness(block);
  return radius * (std::cos(alpha - std::abs(lean)) - std::cos(alpha));
}

// Housner's motion, for the figure: between impacts the lean is alpha - (alpha - peak) cosh(p t)
void write_housner() {
  const double alpha = slenderness(block), p = rocking_frequency(block);
  std::vector<double> time, lean;
  double peak = start, at_peak = 0, side = 1;
  for (double t = 0; t < 3.4; t += 0.01) {
    double quarter = housner_quarter_period(block, peak);
    if (t - at_peak > quarter) {
      // the speed falls by the restitution, its square is 1 - (1 - lean/alpha)^2 times a constant
      const double left = std::pow(housner_restitution(block), 2) * (1 - std::pow(1 - peak / alpha, 2));
      peak = alpha * (1 - std::sqrt(1 - left));
      at_peak += quarter;
      quarter = housner_quarter_period(block, peak);
      at_peak += quarter;
      side = -side;
    }
    time.push_back(t);
    lean.push_back(side / degree * (alpha - (alpha - peak) * std::cosh(p * (t - at_peak))));
  }
  write_csv("rocking", "housner.csv", {"time_s", "lean_deg"}, {time, lean});
}

Rocking judge_impacts(CaseReport& report, const std::string& which, const std::vector<std::string>& carried) {
  const SceneRun scene = run("scene.toml", carried);
  const Rocking r = rocking(scene);
  const auto peaks = zeros(r.time, r.spin, r.lean);
  if (peaks.size() < 2) throw std::runtime_error("the block does not rock");
  const double first = std::sqrt(raised(peaks[0].second) / raised(start)),
               second = std::sqrt(raised(peaks[1].second) / raised(peaks[0].second));
  report.record({"restitution of the first impact" + which,
                 "1",
                 Kind::limit,
                 "Housner (1963): all of the impact at the far corner, the most a rigid base can take",
                 housner_restitution(block),
                 {0.002, 0, Bound::at_least},
                 "rows of the history are 5 ms apart: 1e-5 of a peak; the base delays by 0.2 % of the quarter period"},
                first, cost(scene));
  report.report("restitution of the second impact" + which, "1", second, "dashpot of 0.2");
  report.report("energy left unexplained" + which, "1", scene.results.energy.relative_error(),
                "of the largest energy, after the impacts: their contacts change in area and last few steps");
  return r;
}

TEST(Rocking, LosesLessThanHousnersRestitution) {
  CaseReport report("rocking", {"restitution of the first impact", "restitution of the first impact, whole face"});
  const Rocking r = judge_impacts(report, "", {});
  judge_impacts(report, ", whole face", {whole_faces});
  std::vector<double> lean_deg;
  for (const double lean : r.lean)
    lean_deg.push_back(lean / degree);
  write_csv("rocking", "rocking.csv", {"time_s", "lean_deg"}, {r.time, lean_deg});
  write_housner();
}

// One moment of the slow rotation: of the force about the middle of the face, over the weight, m.
struct Held {
  double lean = 0, arm = 0;  // rad, m
};

std::vector<Held> turned_slowly(const std::string& carried) {
  const RecordedRun<2> run = record<2>("tilt.toml", {carried});
  const Model<2>& model = run.model();
  const int of_block = model.bodies[0].fixed ? 1 : 0;
  std::vector<Held> held;
  for (const State<2>& state : run.frames) {
    const Motion<2>& motion = state.bodies.motions[of_block];
    const double lean = -motion.rotation.angle;
    if (!(lean > 0)) continue;
    const Vector<2> along = matrix(motion.rotation) * Vector<2>(1, 0);
    const Vector<2> middle = model.bodies[of_block].reference + motion.displacement +
                             matrix(motion.rotation) * Vector<2>(0, -0.5 * block.height);
    double turning = 0, pressed = 0;
    for (std::size_t i = 0; i < state.contacts.list.size(); ++i) {
      const Contact<2>& c = state.contacts.list[i];
      if (!c.touching()) continue;
      const int a = model.parts[c.part_a].body;
      const Vector<2> first = model.bodies[a].reference + state.bodies.motions[a].displacement;
      const auto add = [&](const Vector<2>& point, const Vector<2>& force) {
        turning += (first + point - middle).dot(along) * force.dot(c.geometry.normal);
        pressed += force.dot(c.geometry.normal);
      };
      if (c.cells == 0) add(c.geometry.point, c.force);
      for (const SubContact<2>& sub : subs_of(state.contacts, i))
        if (sub.area > 0) add(sub.point, sub.force);
    }
    held.push_back({lean, turning / pressed});
  }
  return held;
}

TEST(Rocking, IsHeldByTheMomentOfItsBase) {
  const double mass = block.density * block.breadth * block.height, weight = mass * block.gravity;
  // the dashpots of the rotation, spread along the face, and their moment over the weight's
  const double dashpot = 2 * dashpot_ratio * std::sqrt(soft * block.breadth * mass);
  const double allowed = dashpot * block.breadth / 12 * turn_speed / weight;
  CaseReport report("rocking", {"arm of the base's force, 4 sub-contacts", "arm of the base's force, whole face"});
  const auto on_points = [](int number) { return "joint_properties.rock.sub_contacts=" + std::to_string(number); };
  struct {
    std::string name, file, carried;
  } const ways[] = {{"4 sub-contacts", "4", on_points(4)},
                    {"8 sub-contacts", "8", on_points(8)},
                    {"whole face", "whole", whole_faces},
                    {"one point", "1", on_points(1)}};
  for (const auto& way : ways) {
    const std::vector<Held> held = turned_slowly(way.carried);
    ASSERT_GT(held.size(), 20u);
    double worst = 0;
    std::vector<double> lean, arm, theory;
    for (const Held& h : held) {
      lean.push_back(1e3 * h.lean);
      arm.push_back(h.arm / block.breadth);
      theory.push_back(base_moment(block, h.lean, soft) / weight / block.breadth);
      worst = std::max(worst, std::abs(arm.back() - theory.back()));
    }
    write_csv("rocking", "held_" + way.file + ".csv", {"lean_mrad", "arm", "theory"}, {lean, arm, theory});
    const std::string quantity = "arm of the base's force, " + way.name;
    if (way.name == "one point")
      report.report(quantity, "1", worst, "largest deviation, over the breadth");
    else
      report.record({quantity,
                     "1",
                     Kind::limit,
                     "equilibrium: linear pressure without tension",
                     0,
                     {allowed, 0, Bound::at_most},
                     "largest deviation over the breadth, to 0.003 rad"},
                    worst);
  }
}

}  // namespace
}  // namespace voussoir::cases
