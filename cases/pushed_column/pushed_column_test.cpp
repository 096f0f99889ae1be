// Pushed column: the force at which it tips, found by search in the plane and in space; its lean before; a force that
// grows, is replaced and ends; blocks in space under forces that vary and rotate.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cases/case_tools.hpp"
#include "cases/recorded_run.hpp"
#include "core/step/integrate.hpp"
#include "reference/pushed_column/pushed_column.hpp"
#include "text/angle.hpp"

namespace voussoir::cases {
namespace {

using reference::Push;
using reference::PushedColumn;
using verification::CaseReport;
using verification::Kind;

// as the scenes state it
constexpr double height = 3, breadth = 1;          // m
const PushedColumn column_of_scene;                // on 10 GPa/m
const Push corner{-0.5 * breadth, height, false};  // the upper left one
constexpr double below_limit = 0.995;              // of the tipping force
const std::string source = "rigid column on a joint without tension, reference/pushed_column";

PushedColumn on(double stiffness) {
  PushedColumn column = column_of_scene;
  column.stiffness = stiffness;
  return column;
}

// settings of a run
struct Joint {
  double stiffness = 1e10;  // Pa/m, in both directions
  int points = 8;           // along the base
  bool turns = false;       // the force
};

std::vector<std::string> variant(const Joint& joint, const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides{"joint_properties.rock.normal_stiffness=" + text(joint.stiffness),
                                     "joint_properties.rock.shear_stiffness=" + text(joint.stiffness),
                                     "joint_properties.rock.sub_contacts=" + std::to_string(joint.points)};
  if (joint.turns) overrides.push_back("stage.push.force.push.turns_with_body=true");
  overrides.insert(overrides.end(), more.begin(), more.end());
  return overrides;
}

std::string push_of(const std::string& scene, double force) {
  return "stage.push.force.push.force=[" + text(force) + (scene == "space.toml" ? ", 0, 0]" : ", 0]");
}

struct Trial {
  bool rests = false;
  double tilt = 0;  // rad, at the end; if it tipped, when that was detected
  Results results;
};

template <int Dim>
Trial attempt(const std::string& scene, const std::vector<std::string>& overrides) {
  constexpr double tipped = 0.2;  // rad: beyond any tilt of equilibrium, before it reaches the ground
  const auto tilt = [](const Prepared<Dim>& prepared, const State<Dim>& state) {
    return rotation_vector(state.bodies.motions[prepared.model.bodies[0].fixed ? 1 : 0].rotation).norm();
  };
  RecordedRun<Dim> run = record<Dim>(
      scene, overrides, Demand::goals,
      [&](const Prepared<Dim>& prepared, const State<Dim>& state) { return tilt(prepared, state) > tipped; });
  return {run.ended, tilt(run.scene(), run.end), std::move(run.run.results)};
}

Trial attempt(const std::string& scene, const std::vector<std::string>& overrides) {
  return scene == "space.toml" ? attempt<3>(scene, overrides) : attempt<2>(scene, overrides);
}

// The least force that tips, over that of a rigid joint; and the tilts of the trials below it, for the figure.
struct Found {
  double force = 0, half_bracket = 0;
  std::vector<double> forces, tilts;
  verification::Cost cost;
};

Found search(const std::string& scene, const Joint& joint) {
  constexpr double narrow = 1e-4;
  const double rigid = rigid_push(on(joint.stiffness), corner);
  double low = 0.8, high = 1.2;
  Found found;
  const auto rests = [&](double force) {
    const Trial trial = attempt(scene, variant(joint, {push_of(scene, force * rigid)}));
    found.cost.contact_evaluations += trial.results.counters.contact_evaluations;
    found.cost.seconds += trial.results.seconds;
    if (!trial.rests) return false;
    found.forces.push_back(force);
    found.tilts.push_back(trial.tilt);
    return true;
  };
  if (!rests(low) || rests(high)) throw std::runtime_error("the search does not bracket the tipping force");
  while (high - low > narrow) {
    const double middle = 0.5 * (low + high);
    (rests(middle) ? low : high) = middle;
  }
  found.force = 0.5 * (low + high);
  found.half_bracket = 0.5 * (high - low);
  return found;
}

Push push_of(const Joint& joint) {
  return {corner.x, corner.y, joint.turns};
}

// the unbalanced force in equilibrium, 1e-6 of the weight, as a fraction of the force
const double unbalanced = 1e-6 * column_of_scene.weight / rigid_push(column_of_scene, corner);

Found judge_tipping(const std::string& scene, const Joint& joint, CaseReport& report) {
  const Found found = search(scene, joint);
  const PushedColumn column = on(joint.stiffness);
  const double rigid = rigid_push(column, corner);
  report.record(
      {"tipping force" + std::string(joint.turns ? ", turning" : "") +
           (scene == "space.toml" ? ", in space, " : ", in the plane, ") + text(joint.stiffness / 1e9) + " GPa/m",
       "1",
       Kind::exact,
       source,
       tipping(column, push_of(joint)).force / rigid,
       {found.half_bracket + unbalanced, 0},
       "half the bracket of the search, and the unbalanced force of the equilibrium criterion; over that of a rigid "
       "joint, W b/(2 h)"},
      found.force, found.cost);
  return found;
}

std::vector<double> in_units_of(double unit, std::vector<double> values) {
  for (double& value : values)
    value /= unit;
  return values;
}

TEST(PushedColumn, TipsEarlierOnSofterJoints) {
  CaseReport report("pushed_column", {"power of the stiffness in what is lost", "tipping force on a rigid joint"});
  std::vector<double> stiffness, force;
  for (const double k : {1e9, 1e10, 1e12}) {
    const Found found = judge_tipping("scene.toml", {.stiffness = k}, report);
    stiffness.push_back(k);
    force.push_back(found.force);
    write_csv("pushed_column", "found_" + text(k / 1e9) + ".csv", {"tilt_mrad", "force"},
              {in_units_of(1e-3, found.tilts), found.forces});
  }
  const double soft = 1 - force[1], stiff = 1 - force[2], bracket = 1e-4;
  report.record(
      {"power of the stiffness in what is lost",
       "1",
       Kind::limit,
       "closed form: the weight's lever loses a/3 + h/2 tilt, least at tilt ~ (W/k)^1/3",
       -1.0 / 3,
       {bracket / stiff / std::log(100) + 2e-3, 0},
       "the bracket as a fraction of the reduction at 1000 GPa/m; the next power, of the tilt of 5 mrad at 10"},
      std::log(stiff / soft) / std::log(100));
  // the reduction as a line over k^-1/3, extrapolated to k = infinity
  const double x_soft = std::pow(stiffness[1], -1.0 / 3), x_stiff = std::pow(stiffness[2], -1.0 / 3);
  report.record({"tipping force on a rigid joint",
                 "1",
                 Kind::limit,
                 "equilibrium: W b/(2 h)",
                 1,
                 {1.5 * bracket + 5e-3 * soft * x_stiff / x_soft, 0},
                 "extrapolated over k^-1/3 from 10 and 1000 GPa/m: 1.5 times the bracket, and the tilt of 5 mrad times "
                 "the reduction"},
                1 - (stiff * x_soft - soft * x_stiff) / (x_soft - x_stiff));
  write_csv("pushed_column", "found.csv", {"stiffness_GPa_m", "force"}, {in_units_of(1e9, stiffness), force});
}

TEST(PushedColumn, TipsInSpaceAsInThePlane) {
  CaseReport report("pushed_column");
  judge_tipping("space.toml", {}, report);
}

// the tipping force of a rotating push is 0.4 % above that of one that stays horizontal, at the same corner
TEST(PushedColumn, TipsLaterUnderAForceThatRotatesWithIt) {
  CaseReport report("pushed_column");
  for (const char* scene : {"scene.toml", "space.toml"})
    judge_tipping(scene, {.stiffness = 1e9, .turns = true}, report);
}

// the effect of one point per face
TEST(PushedColumn, NeedsMoreThanOnePointAlongItsBase) {
  CaseReport report("pushed_column");
  const Found one = search("scene.toml", {.points = 1});
  report.report("tipping force, one point, 10 GPa/m", "1", one.force,
                "over that of a rigid joint: the point is not at the centre of pressure");
}

// rad: change of the tilt by the unbalanced force of the equilibrium criterion
double allowed(const PushedColumn& column, const Push& push, double force) {
  return tilt_under(column, push, force * (1 + unbalanced)) - tilt_under(column, push, force);
}

TEST(PushedColumn, LeansAsItsBaseIsPressed) {
  CaseReport report("pushed_column");
  const std::string because = "effect of the unbalanced force of the equilibrium criterion";
  const auto judge = [&](const std::string& name, const std::string& scene, const Joint& joint) {
    const PushedColumn column = on(joint.stiffness);
    const double force = below_limit * tipping(column, push_of(joint)).force;
    const Trial trial = attempt(scene, variant(joint, {push_of(scene, force)}));
    ASSERT_TRUE(trial.rests) << name;
    report.record({"tilt at 99.5 %, " + name,
                   "rad",
                   Kind::exact,
                   source,
                   tilt_under(column, push_of(joint), force),
                   {allowed(column, push_of(joint), force), 0},
                   because},
                  trial.tilt, {trial.results.counters.contact_evaluations, trial.results.seconds});
    const Value* carried = trial.results.find("column_applied_load_x");
    ASSERT_TRUE(carried);
    EXPECT_NEAR(carried->value, force * (joint.turns ? std::cos(trial.tilt) : 1), 1e-9 * force) << name;
  };
  judge("1 GPa/m", "scene.toml", {.stiffness = 1e9});
  judge("10 GPa/m", "scene.toml", {});
  judge("1000 GPa/m", "scene.toml", {.stiffness = 1e12});
  judge("2 points", "scene.toml", {.points = 2});
  judge("32 points", "scene.toml", {.points = 32});
  judge("turning", "scene.toml", {.turns = true});
  judge("in space", "space.toml", {});
  judge("in space, turning", "space.toml", {.turns = true});
  // the scene as committed, whose force is rounded
  report.reference("column_rotation", -to_degrees(tilt_under(column_of_scene, corner, 11559)), "deg");
}

// from the rows of a history: work of the applied force at the column's upper left corner, J/m
double work_at_corner(const std::vector<double>& force, const std::vector<double>& x, const std::vector<double>& tilt) {
  const auto place = [&](std::size_t i) {
    return x[i] + corner.x * std::cos(tilt[i]) + 0.5 * height * std::sin(tilt[i]);
  };
  double work = 0;
  for (std::size_t i = 1; i < force.size(); ++i)
    work += 0.5 * (force[i] + force[i - 1]) * (place(i) - place(i - 1));
  return work;
}

std::vector<double> tilts_of(const SceneRun& run, int stage) {
  std::vector<double> tilts = column(run, "column_rotation_deg", stage);
  for (double& tilt : tilts)
    tilt *= -degree;
  return tilts;
}

// grown in time, at three fractions of the stable step and on two joints
TEST(PushedColumn, LeansAsFarWhenItIsPushedSlowly) {
  constexpr int push = 2, less = 3, none = 4;
  CaseReport report("pushed_column");
  const double swings = 1e-3;
  const std::string because =
      "local damping of 0.7 reduces an oscillation to 0.18 in half a period; the four half periods in ten seconds "
      "leave a thousandth of the last growth";
  for (const auto& [stiffness, fraction] : {std::pair(1e10, 0.8), {1e10, 0.2}, {1e11, 0.8}}) {
    const PushedColumn joint = on(stiffness);
    const double force = below_limit * tipping(joint, corner).force;
    const SceneRun slow = run("slow.toml", variant({.stiffness = stiffness},
                                                   {push_of("slow.toml", force), "time.fraction=" + text(fraction)}));
    const std::string name = text(stiffness / 1e9) + " GPa/m, " + text(fraction) + " of the step";
    const std::vector<double> tilts = tilts_of(slow, push), forces = column(slow, "column_applied_load_x_N", push);
    report.record({"tilt after a slow push, " + name,
                   "rad",
                   Kind::exact,
                   source,
                   tilt_under(joint, corner, force),
                   {0, swings},
                   because},
                  tilts.back(), cost(slow));
    EXPECT_NEAR(forces[forces.size() / 2], force, 1e-9 * force);

    if (stiffness != 1e10 || fraction != 0.2) continue;
    // the work of the energy balance so far, from a run that ends there
    const double by_rows = work_at_corner(forces, column(slow, "column_displacement_x_m", push), tilts);
    LoadedScene first = load_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / "slow.toml",
                                   variant({}, {push_of("slow.toml", force), "time.fraction=" + text(fraction)}));
    std::get<Prepared<2>>(first.prepared).stages.resize(push);
    const double in_ledger = simulate_scene(first).energy.flows[Source::applied_forces];
    report.record({"work of the push",
                   "J",
                   Kind::exact,
                   "conservation of energy: the integral of force over the displacement of its point",
                   by_rows,
                   {0, 1e-4},
                   "rows 20 ms apart, 1e-3 of the push's growth, by the trapezoidal rule; each row's force is a step "
                   "older than its displacement"},
                  in_ledger, cost(slow));

    // replaced, and ended
    const double smaller = 11300;
    report.record({"tilt under the force that replaces it",
                   "rad",
                   Kind::exact,
                   source,
                   tilt_under(joint, corner, smaller),
                   {allowed(joint, corner, smaller), 0},
                   "effect of the unbalanced force of the equilibrium criterion"},
                  tilts_of(slow, less).back(), cost(slow));
    const double upright = 1e-6 * joint.weight * height / (joint.stiffness * std::pow(breadth, 3) / 12);
    report.record(
        {"tilt when it has ended",
         "rad",
         Kind::exact,
         "equilibrium: the whole base carries the weight",
         0,
         {upright, 0},
         "the unbalanced force of the equilibrium criterion, at the top of the column, over the rocking stiffness of "
         "its base"},
        tilts_of(slow, none).back(), cost(slow));
    EXPECT_EQ(column(slow, "column_applied_load_x_N", none).back(), 0);
  }
  const double beyond = 1.005 * tipping(column_of_scene, corner).force;
  EXPECT_FALSE(attempt("slow.toml", {push_of("slow.toml", beyond), "time.fraction=0.8"}).rests);
}

TEST(FreeBlocks, MoveByNewtonsLaws) {
  CaseReport report("pushed_column");
  const SceneRun free = run("free.toml");
  constexpr double duration = 1.6, step = 5e-4, mass = 2500, inertia = mass / 6;  // s, s, kg, kg m²
  const double pi = std::numbers::pi, w = 2 * pi * 1.25, sine = 10e3, thrust = 2500, arm = 0.4;
  const std::string because = "leapfrog: a twelfth of the square of the step times the frequency, of the displacement";
  const reference::Ride ride = reference::shaken_ride(sine / mass, w, 30 * degree, duration);
  report.record({"way of a shaken block",
                 "m",
                 Kind::exact,
                 "Newton: integral of a sine",
                 ride.way,
                 {sine / mass / (w * w) * std::pow(w * step, 2) / 12 * w * duration, 0},
                 because},
                value(free, "shaken_displacement_y"), cost(free));
  const reference::Spiral spiral = reference::spun_up(thrust / mass, thrust * arm / inertia, duration);
  const double spin = thrust * arm / inertia * duration;
  report.record({"way of a spun block, along",
                 "m",
                 Kind::exact,
                 "Newton: Fresnel's integrals",
                 spiral.along,
                 {std::hypot(spiral.along, spiral.aside) * std::pow(spin * step, 2) / 12, 0},
                 because},
                value(free, "spun_displacement_x"), cost(free));
  report.record({"way of a spun block, aside",
                 "m",
                 Kind::exact,
                 "Newton: Fresnel's integrals",
                 spiral.aside,
                 {std::hypot(spiral.along, spiral.aside) * std::pow(spin * step, 2) / 12, 0},
                 because},
                value(free, "spun_displacement_y"), cost(free));
  report.record({"turn of a spun block",
                 "deg",
                 Kind::exact,
                 "Newton: a constant moment",
                 to_degrees(spiral.turn),
                 {0, 1e-9},
                 "leapfrog is exact for it: rounding"},
                value(free, "spun_rotation_z"), cost(free));
  EXPECT_LT(free.results.energy.relative_error(), 1e-12);

  // the work of both forces is the motion's energy; the energy balance is half a step ahead
  const double pace = thrust / mass;  // of the spun block: its speed by a difference of the closed form
  const reference::Spiral before = reference::spun_up(pace, thrust * arm / inertia, duration - step),
                          after = reference::spun_up(pace, thrust * arm / inertia, duration + step);
  const double speed = std::hypot(after.along - before.along, after.aside - before.aside) / (2 * step);
  const double kinetic = 0.5 * mass * (ride.velocity * ride.velocity + speed * speed) + 0.5 * inertia * spin * spin;
  const double power = std::abs(sine * ride.velocity) + thrust * (speed + arm * spin);
  report.record(
      {"work in space",
       "J",
       Kind::exact,
       "conservation of energy: kinetic energy of both blocks",
       kinetic,
       {power * step, 0},
       "a step's work: the last work of the energy balance is half a step ahead, the positions are one step ahead"},
      free.results.energy.flows[Source::applied_forces], cost(free));
}

// the closed forms, for the figure
TEST(PushedColumnFigure, HasItsReference) {
  std::vector<std::vector<double>> columns(1);
  for (double mrad = 1e-3; mrad < 16; mrad *= 1.02)
    columns[0].push_back(mrad);
  for (const double k : {1e9, 1e10, 1e12}) {
    std::vector<double>& force = columns.emplace_back();
    for (const double mrad : columns[0])
      force.push_back(1e-3 * mrad > 2 * column_of_scene.weight / k
                          ? push_at(on(k), corner, 1e-3 * mrad) / rigid_push(on(k), corner)
                          : std::nan(""));
  }
  write_csv("pushed_column", "theory.csv", {"tilt_mrad", "1", "10", "1000"}, columns);
  std::vector<double> stiffness, force;
  for (double exponent = 8.5; exponent < 13.01; exponent += 0.1) {
    const double k = std::pow(10, exponent);
    stiffness.push_back(k / 1e9);
    force.push_back(tipping(on(k), corner).force / rigid_push(on(k), corner));
  }
  write_csv("pushed_column", "limit.csv", {"stiffness_GPa_m", "force"}, {stiffness, force});
}

}  // namespace
}  // namespace voussoir::cases
