// Bolts and lining of an opening in bonded rock, against a linear network of the same blocks.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cases/tunnel/oedometer.hpp"
#include "cases/tunnel/twin.hpp"
#include "reference/tunnel/bolted_ring.hpp"
#include "reference/tunnel/lining.hpp"

namespace voussoir::cases::supported_test {
namespace {

using verification::CaseReport;
using verification::Kind;

struct Difference {
  double mean = 0;     // of the differences' magnitudes, over the mean magnitude
  double largest = 0;  // over the largest magnitude
};

Difference difference(const std::vector<double>& computed, const std::vector<double>& expected) {
  if (computed.size() != expected.size() || expected.empty()) throw std::runtime_error("nothing to compare");
  double apart = 0, size = 0, worst = 0, largest = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    apart += std::abs(computed[i] - expected[i]);
    size += std::abs(expected[i]);
    worst = std::max(worst, std::abs(computed[i] - expected[i]));
    largest = std::max(largest, std::abs(expected[i]));
  }
  return {apart / size, worst / largest};
}

const char* const network = "linear network of the same blocks (reference/tunnel/network.hpp)";

const char* const why =
    "of a hundred joints two to three are not in compression when the others are bonded, and have no bond: in the "
    "network they are intact; the effect of such a joint 7 m and more from the centre on the opening falls with the "
    "square of the distance over a block's size, 1/50; displacements over block sizes are 1e-4";

void compare(CaseReport& report, const std::string& what, const std::vector<double>& program,
             const std::vector<double>& linear, verification::Cost cost) {
  const Difference apart = difference(program, linear);
  report.record(
      {what + ": mean difference from the network, of the mean", "1", Kind::exact, network, 0, {0.01, 0}, why},
      apart.mean, cost);
  report.record(
      {what + ": largest difference from the network, of the largest", "1", Kind::exact, network, 0, {0.02, 0}, why},
      apart.largest, cost);
}

// `which` mass, to distinguish several in one table; empty: the only one, small enough for its bolts to cross the same
// joints.
void compare(CaseReport& report, const std::string& which, const SupportedRun& run, const Twins& both) {
  const verification::Cost cost = cases::cost(run.run);
  std::vector<double> program, linear;
  for (std::size_t i = 0; i < both.twin_of_spring.size(); ++i) {
    if (both.twin_of_spring[i] < 0) continue;
    program.push_back(both.program.bolts[i]);
    linear.push_back(both.linear.bolts[both.twin_of_spring[i]]);
  }
  const BondCount& bonds = run.run.results.bonds.value();
  report.record({"bonds that break" + which,
                 "1",
                 Kind::exact,
                 "equilibrium: bonds hold the released forces",
                 0,
                 {0, 0},
                 "a count"},
                static_cast<double>(bonds.broken), cost);
  const auto unmatched = static_cast<double>(both.program.bolts.size() + both.linear.bolts.size() - 2 * program.size());
  const std::string springs = "springs of bolts that the network has not, or the program" + which;
  if (which.empty())
    report.record({springs, "1", Kind::exact, network, 0, {0, 0}, "a count"}, unmatched, cost);
  else
    report.report(springs, "1", unmatched,
                  "of some 370: blocks are some 5 mm from their initial positions, so near to a face's end a bolt "
                  "crosses another joint",
                  cost);
  report.record({"mean convergence that supports meet" + which,
                 "m",
                 Kind::exact,
                 network,
                 both.linear.mean_convergence,
                 {0, 0.01},
                 why},
                both.program.mean_convergence, cost);
  compare(report, "convergence" + which, both.program.convergence, both.linear.convergence, cost);
  compare(report, "bolt forces" + which, program, linear, cost);
  compare(report, "thrust of the lining" + which, both.program.thrust, both.linear.thrust, cost);
  compare(report, "moment of the lining" + which, both.program.moment, both.linear.moment, cost);
}

double sum(const std::vector<double>& forces) {
  double total = 0;
  for (const double force : forces)
    total += std::abs(force);
  return total;
}

TEST(Supported, TheSameBlocksAsTheNetwork) {
  CaseReport report("tunnel", {"convergence: mean difference from the network, of the mean"});
  const SupportedRun run = run_supported("same_blocks.toml");
  compare(report, "", run, twins(run, 2));
}

// Half of the forces is released before the supports are installed: they get half.
TEST(Supported, ForcesReleasedBeforeAreNotCarriedBySupports) {
  CaseReport report("tunnel");
  const Increment all = twins(run_supported("same_blocks.toml"), 2).program;
  const SupportedRun run = run_supported("same_blocks.toml", {"stage.dig.excavation_forces.remaining=0.885"});
  const Increment half = twins(run, 2).program;
  const auto check = [&](const char* what, double computed) {
    report.record({fmt::format("{} where half is let off before, of all", what),
                   "1",
                   Kind::exact,
                   "comparison: 1 - x of linear supports",
                   0.5,
                   {0.005, 0},
                   "1 % of it: joints that are bonded in one run and not in the other, as against the network"},
                  computed, cost(run.run));
  };
  check("bolt forces", sum(half.bolts) / sum(all.bolts));
  check("thrust of the lining", sum(half.thrust) / sum(all.thrust));
  check("moments of the lining", sum(half.moment) / sum(all.moment));
}

// ---- the chapter's mass, bonded -------------------------------------------------------------------------------------

// of a draw's mass with closed joints: means of vertical and horizontal oedometer tests
Moduli moduli_of(int seed) {
  const Overrides rough = draw(seed, {"joint_properties.rock.friction_deg=89"});
  const Moduli down = pressed_down(rough), across = pressed_across(rough);
  return {(down.shear + across.shear) / 2, (down.poisson + across.poisson) / 2, {}};
}

// of bonded.toml
constexpr double relieved = 0.05 * 662175, bolt_length = 7, bolt_stiffness = 2e8;
constexpr int bolt_count = 32;
// of circles of the area of the twelve sides, and of the square that is fixed
const double wall_radius = 5 * std::sqrt(12 * std::tan(std::numbers::pi / 12) / std::numbers::pi),
             held_radius = 70 / std::sqrt(std::numbers::pi);

// sum over all springs, of the smeared ring's, with the spacing of the joints that the bolts cross
double bolts_of_smeared(const Increment& program, const Moduli& rock) {
  const double crossings = static_cast<double>(program.bolts.size()) / (bolt_count * bolt_length);
  reference::BoltedRing ring{wall_radius,
                             relieved,
                             rock.shear,
                             rock.poisson,
                             bolt_stiffness,
                             1 / crossings,
                             bolt_length,
                             2 * std::numbers::pi * wall_radius / bolt_count,
                             1};
  ring.fixed_radius = held_radius;
  double total = 0;
  for (const double force : program.bolts)
    total += force;
  return total / (static_cast<double>(program.bolts.size()) * reference::mean_bolt_force(ring));
}

double thrust_of_smeared(const SupportedRun& run, const Moduli& rock) {
  reference::SoftLining lining{wall_radius, relieved, rock.shear, 25e9, 0.3, 1e8, 0};
  lining.fixed_radius = held_radius;
  lining.ground_poisson_ratio = rock.poisson;
  double mean = 0;
  for (const LiningRow& node : run.run.results.linings)
    mean += node.forces.thrust / static_cast<double>(run.run.results.linings.size());
  return mean / reference::lining_hoop_force(lining);
}

// Draws 3, which is the model, 0 and 1, chosen before any run.
TEST(SupportedLong, TheChaptersMassBonded) {
  CaseReport report("tunnel", {"sum of bolt forces in the chapter's bonded mass, of the smeared ring's"});
  double bolts = 0, thrust = 0;
  verification::Cost cost;
  for (const int seed : {3, 0, 1}) {
    const std::string which = fmt::format(", chapter's mass, draw {}", seed);
    const Moduli rock = moduli_of(seed);
    const SupportedRun both = run_supported("bonded_lined.toml", draw(seed));
    compare(report, which, both, twins(both, 2));
    const SupportedRun bolted = run_supported("bonded.toml", draw(seed));
    const SupportedRun lined = run_supported("bonded_lined.toml", draw(seed, {"bolts.bolts.stiffness=1"}));
    const double of_bolts = bolts_of_smeared(twins(bolted, 2).program, rock), of_ring = thrust_of_smeared(lined, rock);
    cost = cases::cost(bolted.run);
    report.report("shear modulus" + which, "Pa", rock.shear, "mean of vertical and horizontal, 89°", cost);
    report.report("sum of bolt forces, of the smeared ring's" + which, "1", of_bolts, "own G, ν and spacing", cost);
    report.report("mean thrust, of appendix H" + which, "1", of_ring, "own G and ν", cost);
    bolts += of_bolts / 3;
    thrust += of_ring / 3;
  }
  const char* const within =
      "blocks of 0.6 m on a wall of 5 m, in a mass that is a fifth stiffer horizontally than vertically: the network's "
      "isotropic masses keep within 15 % at s/a 0.2";
  report.record({"sum of bolt forces in the chapter's bonded mass, of the smeared ring's",
                 "1",
                 Kind::limit,
                 "Carranza-Torres (2009), Eq. 5.3, held at the circle of the square's area; mean of three draws",
                 1,
                 {0.15, 0},
                 within},
                bolts, cost);
  report.record({"mean thrust in the chapter's bonded mass, of appendix H",
                 "1",
                 Kind::limit,
                 "Boon (2013), Eq. H.6, held likewise; mean of three draws",
                 1,
                 {0.15, 0},
                 within},
                thrust, cost);
}

// How often another draw of the small mass passes: a joint of the wall that is not in compression is not bonded.
TEST(SupportedLong, OtherDrawsOfTheSameBlocks) {
  CaseReport report("tunnel");
  for (int seed = 1; seed <= 8; ++seed) {
    const SupportedRun run = run_supported("same_blocks.toml", draw(seed));
    const Twins both = twins(run, 2);
    const auto show = [&](const char* what, const std::vector<double>& program, const std::vector<double>& linear) {
      const Difference apart = difference(program, linear);
      report.report(fmt::format("{}: mean difference from the network, draw {}", what, seed), "1", apart.mean,
                    fmt::format("largest {:.2f} %", 100 * apart.largest), cost(run.run));
    };
    show("convergence", both.program.convergence, both.linear.convergence);
    show("thrust of the lining", both.program.thrust, both.linear.thrust);
    show("moment of the lining", both.program.moment, both.linear.moment);
  }
}

}  // namespace
}  // namespace voussoir::cases::supported_test
