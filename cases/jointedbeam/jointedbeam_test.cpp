// Jointed beam: six blocks between abutments under rising gravity, against the chain of rigid blocks.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "cases/jointedbeam/beam_run.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::jointedbeam_test {
namespace {

// ---- data for the figures
// ------------------------------------------------------------------------------------------

constexpr double mm = 1e3;

// the line through the middles of the blocks' ends, with its steps at the joints
void write_profiles(const std::string& file, const JointedBeam& beam, const std::vector<BeamState>& states,
                    const std::vector<double>& gravities) {
  std::vector<std::string> header{"position_mm"};
  std::vector<std::vector<double>> columns(1);
  for (std::size_t b = 0; b < states.front().blocks.size(); ++b)
    for (const int side : {-1, 1})
      columns[0].push_back(mm * beam.length * (static_cast<double>(b) + 0.5 + 0.5 * side));
  for (const double gravity : gravities) {
    header.push_back(std::to_string(static_cast<int>(gravity)) + "_g");
    std::vector<double>& column = columns.emplace_back();
    for (const BeamBlock& block : at_gravity(states, gravity).blocks)
      for (const int side : {-1, 1})
        column.push_back(-mm * sunk(block, beam.length, side));
  }
  write_csv("jointedbeam", file, header, columns);
}

void write_build_up(const std::string& file, const JointedBeam& beam, const std::vector<BeamState>& states) {
  std::vector<std::vector<double>> columns(4);
  for (const BeamState& s : states) {
    columns[0].push_back(s.gravity);
    columns[1].push_back(s.thrust);
    columns[2].push_back(mm * s.deflection);
    columns[3].push_back(reference::least_thrust(beam, s.gravity, s.deflection));
  }
  write_csv("jointedbeam", file, {"gravity_g", "thrust_N", "deflection_mm", "least_thrust_N"}, columns);
}

// outlines of the displaced blocks, each closed and followed by an empty corner
void write_blocks(const std::string& file, const JointedBeam& beam, const BeamState& s) {
  std::vector<double> x, y;
  for (std::size_t b = 0; b < s.blocks.size(); ++b) {
    const BeamBlock& block = s.blocks[b];
    const double c = std::cos(block.rotation), sine = std::sin(block.rotation);
    constexpr int corners[][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
    for (const auto& corner : corners) {
      const double u = 0.5 * beam.length * corner[0], v = 0.5 * beam.height * corner[1];
      x.push_back(mm * (beam.length * (static_cast<double>(b) + 0.5) + block.displacement.x + c * u - sine * v));
      y.push_back(mm * (block.displacement.y + sine * u + c * v));
    }
    x.push_back(NAN);
    y.push_back(NAN);
  }
  write_csv("jointedbeam", file, {"x_mm", "y_mm"}, {x, y});
}

// contact points, and the force there as a length along its direction
void write_line(const std::string& file, const BeamState& s) {
  std::vector<std::vector<double>> columns(4);
  constexpr double drawn = 9;  // mm
  for (const BeamJoint& joint : s.joints) {
    const double force = std::hypot(joint.force.x, joint.force.y);
    columns[0].push_back(mm * joint.point.x);
    columns[1].push_back(mm * joint.point.y);
    columns[2].push_back(drawn * joint.force.x / force);
    columns[3].push_back(drawn * joint.force.y / force);
  }
  write_csv("jointedbeam", file, {"x_mm", "y_mm", "along_mm", "up_mm"}, columns);
}

void write_figures(const std::string& name, const JointedBeam& beam, const std::vector<BeamState>& found,
                   const std::vector<BeamState>& chain, const std::vector<double>& profiles) {
  write_build_up(name + ".csv", beam, found);
  write_build_up(name + "_chain.csv", beam, chain);
  write_profiles(name + "_profiles.csv", beam, found, profiles);
  write_profiles(name + "_profiles_chain.csv", beam, chain, profiles);
  write_blocks(name + "_blocks.csv", beam, found.back());
  write_line(name + "_line.csv", found.back());
  write_line(name + "_line_chain.csv", at_gravity(chain, found.back().gravity));
}

std::vector<double> from_to(double from, double to, double step) {
  std::vector<double> values;
  for (double v = from; v < to + 0.5 * step; v += step)
    values.push_back(v);
  return values;
}

TEST(JointedBeam, OfFullBlocksIsTheChain) {
  CaseReport report("jointedbeam");
  const JointedBeam beam = full_block();
  const BeamRun run = run_beam(beam, "scene.toml");
  ASSERT_EQ(run.lost, 0) << run.results.message;
  const std::vector<BeamState> chain = raise_gravity(beam, from_to(1, 40, 1), full_closure);
  const std::vector<BeamState> cells = raise_gravity(with_cells(beam, 16), judged, full_closure);

  report.record({"thrust, full block, 1 g",
                 "N",
                 Kind::exact,
                 "demanded: 60 N, for which the abutments are moved in",
                 60,
                 {0, 1e-3},
                 "the closure has five digits; the last step of the move is cut by half a step"},
                at_gravity(run.held, 1).thrust, cost(run));
  for (const double gravity : judged) {
    const BeamState &found = at_gravity(run.held, gravity), &expected = at_gravity(chain, gravity);
    const std::string name = "full block, " + in_g(gravity);
    record_thrust(report, name, expected, found, 0.001, "a chain of 16 cells a joint deviates by 0.01 %", cost(run));
    record_deflection(report, name, expected, found, 0.005,
                      "a chain of 16 cells a joint deviates by 0.01 to 0.25 %: a cell slips as a whole");
    const std::string same =
        "the same cells under the same law: the chain's steps of 0.25 g leave 1e-5, equilibrium 1e-6";
    record_thrust(report, name + ", chain of 16 cells", at_gravity(cells, gravity), found, 2e-4, same);
    record_deflection(report, name + ", chain of 16 cells", at_gravity(cells, gravity), found, 5e-4, same);
  }

  const BeamState &last = run.held.back(), &last_of_chain = at_gravity(chain, 40);
  double apart = 0;
  for (std::size_t j = 0; j < last.joints.size(); ++j)
    apart = std::max(apart, std::hypot(last.joints[j].point.x - last_of_chain.joints[j].point.x,
                                       last.joints[j].point.y - last_of_chain.joints[j].point.y));
  report.record({"line of thrust, full block, 40 g, farthest from the chain's",
                 "m",
                 Kind::exact,
                 chain_source,
                 0,
                 {5e-5, 0},
                 "0.1 % of the height: normal forces are exact in position, their shares change with the slip"},
                apart);
  const reference::VoussoirBeam arch = reference::voussoir_beam(beam, 40);
  report.report("least thrust of three hinges, full block, 40 g", "N", least_thrust(beam, 40, last.deflection),
                "W L/(8 (height - deflection)): the line of thrust cannot rise higher");
  report.report("thrust of Diederichs & Kaiser's arch, full block, 40 g", "N", arch.thrust,
                "compressed over 3/4 of the height");
  report.reference("block3_displacement_y", last_of_chain.blocks[2].displacement.y, "m");
  write_figures("full", beam, run.held, chain, judged);
}

// 4, 8, 16, 32 sub-contacts: each nearer to the distributed joint
TEST(JointedBeam, ComesNearerWithSubContacts) {
  CaseReport report("jointedbeam");
  const JointedBeam beam = full_block();
  const std::vector<BeamState> chain = raise_gravity(beam, judged, full_closure);
  std::vector<std::vector<double>> columns(3);
  double last = 1;
  for (const int count : {4, 8, 16, 32}) {
    const std::string number = std::to_string(count);
    const BeamRun run = run_beam(beam, "scene.toml", {"joint_properties.rock.sub_contacts=" + number});
    ASSERT_EQ(run.lost, 0) << run.results.message;
    double thrust = 0, deflection = 0;
    for (const double gravity : judged) {
      const BeamState &found = at_gravity(run.held, gravity), &expected = at_gravity(chain, gravity);
      thrust = std::max(thrust, std::abs(found.thrust / expected.thrust - 1));
      deflection = std::max(deflection, std::abs(found.deflection / expected.deflection - 1));
    }
    report.record({"largest error of deflection, " + number + " sub-contacts",
                   "1",
                   Kind::limit,
                   "convergence: less than with half as many",
                   0,
                   {last, 0},
                   "cells slip one by one: more of them follow the front of slip more closely"},
                  deflection, cost(run));
    report.report(
        "largest error of thrust, " + number + " sub-contacts", "1", thrust,
        "normal forces and their positions are exact for any number; the error is that of the shape of the beam",
        cost(run));
    EXPECT_LT(deflection, last) << count;
    last = deflection;
    columns[0].push_back(count);
    columns[1].push_back(100 * thrust);
    columns[2].push_back(100 * deflection);
  }
  write_csv("jointedbeam", "sub_contacts.csv", {"sub_contacts", "thrust_percent", "deflection_percent"}, columns);
}

// One point at the centroid of the overlap carries 4/3 of the force of a triangle of stress: the joint is too stiff.
// One at the analytic centre carries the right force at half of the contact length from the edge instead of a third:
// the lever arm is short.
TEST(JointedBeam, DeviatesOnOnePointAsItsChainDoes) {
  CaseReport report("jointedbeam");
  const JointedBeam beam = full_block();
  const std::vector<BeamState> chain = raise_gravity(beam, judged, full_closure);
  struct Variant {
    std::string name, point;
    CellClosure closure;
  };
  for (const Variant& v : {Variant{"centroid", "centroid", CellClosure::at_point},
                           Variant{"analytic centre", "analytic_centre", CellClosure::at_centre}}) {
    const std::vector<BeamState> own_chain = raise_gravity(with_cells(beam, 1, v.closure), judged, full_closure);
    const BeamRun run =
        run_beam(beam, "scene.toml", {"joint_properties.rock.sub_contacts=1", "contact.point=\"" + v.point + "\""});
    ASSERT_EQ(run.lost, 0) << run.results.message;
    for (const double gravity : {10.0, 40.0}) {
      const BeamState &found = at_gravity(run.held, gravity), &expected = at_gravity(chain, gravity);
      const std::string name = "one point, " + v.name + ", " + in_g(gravity);
      const std::string because = "the same joint; the error of steps of 0.25 g in the chain's history";
      record_thrust(report, name, at_gravity(own_chain, gravity), found, 0.002, because, cost(run));
      record_deflection(report, name, at_gravity(own_chain, gravity), found, 0.005, because);
      report.report("error of thrust, " + name, "1", found.thrust / expected.thrust - 1, "against distributed joints",
                    cost(run));
      report.report("error of deflection, " + name, "1", found.deflection / expected.deflection - 1,
                    "against distributed joints");
    }
    write_build_up("full_" + v.point + ".csv", beam, run.held);
  }
}

TEST(JointedBeam, OfHalfBlocksFailsAsTheChainDoes) {
  CaseReport report("jointedbeam");
  const JointedBeam beam = half_block();
  const BeamRun run = run_beam(beam, "half.toml");
  const std::vector<BeamState> chain = raise_gravity(beam, from_to(1, 77, 1), half_closure);
  for (const double gravity : {10.0, 30.0, 50.0, 70.0}) {
    const std::string name = "half block, " + in_g(gravity);
    const BeamState &found = at_gravity(run.held, gravity), &expected = at_gravity(chain, gravity);
    record_thrust(report, name, expected, found, 0.005, "a chain of 16 cells a joint deviates by 0.2 % at 70 g",
                  cost(run));
    record_deflection(report, name, expected, found, 0.01, "a chain of 16 cells a joint deviates by 0.5 % at 70 g");
  }

  const std::vector<BeamState> pushed = raise_deflection(beam, 0.012, {.gravity = 0.25, .deflection = 5e-5});
  const reference::BeamLimit limit = limit_of(pushed);
  report.record({"loss of equilibrium, half block",
                 "g",
                 Kind::exact,
                 chain_source + ": peak of gravity over deflection",
                 limit.gravity,
                 {1, 0},
                 "the middle of a bracket of 1 g; a chain of 16 cells fails within 0.3 g of the distributed one"},
                0.5 * (run.held.back().gravity + run.lost), cost(run));
  EXPECT_EQ(run.lost - run.held.back().gravity, 1);
  report.report("deflection at the loss of equilibrium, half block, chain", "m", limit.deflection, "at the peak");
  report.report("gravity that leaves Diederichs & Kaiser no arch, half block", "g", voussoir_beam_limit(beam),
                "no shear in joints, no prestress");
  report.report("gravity at which Diederichs & Kaiser's design limit is reached, half block", "g",
                voussoir_beam_limit(beam, 0.35), "35 % of the arches have failed");
  write_figures("half", beam, run.held, chain, {10, 30, 50, 70, 77});
  write_build_up("half_pushed.csv", beam, pushed);
}

// ---- stiffness and friction that depend on stress -----------------------------------------------------------------

// a row of Table 4.2 or 4.3
struct Law {
  std::string name, test, file;
  std::vector<std::string> keys;  // of joint_properties
  reference::JointLaw joint;
  double full_closure, half_closure;  // m, for 60 N at 1 g: abutment_closure
};

void PrintTo(const Law& law, std::ostream* out) {
  *out << law.name;
}

constexpr double forty = 40 * degree;
const std::vector<std::string> linear_shear{"shear_law=\"linear\"", "shear_stiffness=1e8", "shear_growth=9.7e4"};

std::vector<std::string> with(std::vector<std::string> keys, const std::vector<std::string>& more) {
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

const Law laws[] = {
    {"linear (Eqs 4.10, 4.11)",
     "Linear",
     "linear",
     with({"normal_law=\"linear\"", "normal_stiffness=4e9", "normal_growth=7.4e4"}, linear_shear),
     {.normal = {4e9, 7.4e4, 1}, .shear = {1e8, 9.7e4, 1}, .friction = {.angle = forty}},
     39.8179e-6,
     67.6999e-6},
    {"half as stiff (Eqs 4.14, 4.11)",
     "HalfAsStiff",
     "half_stiff",
     with({"normal_law=\"linear\"", "normal_stiffness=2e9", "normal_growth=3.7e4"}, linear_shear),
     {.normal = {2e9, 3.7e4, 1}, .shear = {1e8, 9.7e4, 1}, .friction = {.angle = forty}},
     79.6360e-6,
     135.400e-6},
    {"continuously yielding (Eqs 4.14, 4.17, 4.18)",
     "Yielding",
     "yielding",
     {"normal_law=\"linear\"", "normal_stiffness=2e9", "normal_growth=3.7e4", "shear_law=\"power\"",
      "shear_stiffness=1.9e6", "shear_exponent=0.7", "friction_law=\"hardening\"", "hardening_slip_m=2e-6",
      "hardening_exponent=0.213"},
     {.normal = {2e9, 3.7e4, 1},
      .shear = {0, 1.9e6, 0.7},
      .friction = {.angle = forty, .peak_slip = 2e-6, .peak_power = 0.213}},
     79.6374e-6,
     135.402e-6},
};

// the scene under a law, its abutments moved in for it
std::vector<std::string> overrides(const Law& law, double closure) {
  std::vector<std::string> all;
  for (const std::string& key : law.keys)
    all.push_back("joint_properties.rock." + key);
  const double speed = closure / 2 / 0.005;  // m/s: falls to zero within 0.01 s
  all.push_back(fmt::format("stage.close.move.left.velocity=[{},0]", speed));
  all.push_back(fmt::format("stage.close.move.right.velocity=[{},0]", -speed));
  return all;
}

class JointedBeamUnder : public testing::TestWithParam<Law> {};

TEST_P(JointedBeamUnder, ItsLawIsTheChain) {
  const Law& law = GetParam();
  CaseReport report("jointedbeam");
  for (const bool half : {false, true}) {
    JointedBeam beam = half ? half_block() : full_block();
    beam.joint = law.joint;
    const std::vector<double> gravities = half ? std::vector<double>{10, 30, 50, 70, 90} : judged;
    const double closure = half ? law.half_closure : law.full_closure;
    const BeamRun run = run_beam(beam, half ? "half_laws.toml" : "scene.toml", overrides(law, closure));
    ASSERT_EQ(run.lost, 0) << run.results.message;
    const double most = gravities.back();
    const std::vector<BeamState> chain =
        raise_gravity(with_cells(beam, 64), from_to(1, most, 1), closure, {.gravity = 0.5});
    const std::vector<BeamState> cells = raise_gravity(with_cells(beam, 16), gravities, closure);
    ASSERT_EQ(cells.size(), gravities.size());
    for (const double gravity : gravities) {
      const BeamState &found = at_gravity(run.held, gravity), &same = at_gravity(cells, gravity);
      const std::string name = (half ? "half block, " : "full block, ") + in_g(gravity) + ", " + law.name;
      const std::string because =
          "a chain of 16 cells deviates by at most 0.6 % in thrust and 0.8 % in deflection: the "
          "stress at a cell's mean overlap misses some of its exponential growth";
      record_thrust(report, name, at_gravity(chain, gravity), found, 0.01, because, cost(run));
      record_deflection(report, name, at_gravity(chain, gravity), found, 0.015, because);
      const std::string steps = "the same cells under the same law: the chain's steps of 0.25 g leave 1e-4";
      record_thrust(report, name + ", chain of 16 cells", same, found, 5e-4, steps);
      record_deflection(report, name + ", chain of 16 cells", same, found, 1e-3, steps);
    }
    const std::string file = (half ? "half_" : "full_") + law.file;
    write_build_up(file + ".csv", beam, run.held);
    write_build_up(file + "_chain.csv", beam, chain);
    write_profiles(file + "_profiles.csv", beam, run.held, gravities);
    write_profiles(file + "_profiles_chain.csv", beam, chain, gravities);
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, JointedBeamUnder, testing::ValuesIn(laws),
                         [](const auto& chosen) { return chosen.param.test; });

}  // namespace
}  // namespace voussoir::cases::jointedbeam_test
