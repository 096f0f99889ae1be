// Linings: a ring that is pressed, an invert in its bed, and a plate that hangs from its interface.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "cases/case_tools.hpp"
#include "reference/tunnel/bedded_arc.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::lining_test {
namespace {

using verification::CaseReport;
using verification::Kind;

// Beam on an elastic foundation that is pressed by 1 mm, twelve sides that deform with each other's thrust: the closed
// form of reference/tunnel/network_test.cpp, twelve_sides_pressed_inwards.
struct PressedRing {
  const char *scene, *interface;
  double thrust, vertex, middle;  // N, N m, N m
};

const char* const foundation = "equilibrium: EI w'''' + K w = K d on each side, w(h) tan²(π/12) EA/h = K ∫(d - w)";

void check_ring(CaseReport& report, const PressedRing& ring) {
  const SceneRun run = cases::run(ring.scene);
  for (const auto& [place, moment] : {std::pair("corner", ring.vertex), std::pair("middle", ring.middle)}) {
    report.record({fmt::format("thrust of the pressed ring, {}, K_L {}", place, ring.interface),
                   "N",
                   Kind::exact,
                   foundation,
                   ring.thrust,
                   {0, 1e-3},
                   "the form is one of small displacements: a millimetre is 2e-4 of the radius, and the thrust is 2e-3 "
                   "of the buckling load of the sides on their foundation, which increases their deflections by that"},
                  value(run, fmt::format("{}_thrust", place)), cost(run));
    report.record(
        {fmt::format("moment of the pressed ring, {}, K_L {}", place, ring.interface),
         "N m",
         Kind::exact,
         foundation,
         moment,
         {0, 1e-2},
         "pressure lumped at nodes leaves out the fixed-end moment q l²/12 of beams of l = 134 mm: 1.5 N m of 298, "
         "290 of 32,401 if the interface is stiff; the thrust adds 2e-3"},
        value(run, fmt::format("{}_moment", place)), cost(run));
  }
}

// at a tenth of the millimetre, at which the thrust adds a tenth to the deflections
void check_order(CaseReport& report, const PressedRing& ring) {
  const std::string less = "stage.press.duration_s=0.0004";
  const SceneRun fine = cases::run(ring.scene, {less}),
                 coarse = cases::run(ring.scene, {less, "linings.ring.nodes=120"});
  for (const auto& [place, moment] : {std::pair("corner", ring.vertex), std::pair("middle", ring.middle)}) {
    const std::string column = fmt::format("{}_moment", place);
    report.record(
        {fmt::format("moment of the ring pressed by 0.1 mm from 10 and 20 beams a side, {}, K_L {}", place,
                     ring.interface),
         "N m",
         Kind::exact,
         foundation,
         moment / 10,
         {0, 1e-3},
         "second order: (4 M20 - M10)/3; the remainder is of fourth order, (l/λ)⁴ = 1.4e-3 if the interface is stiff "
         "(λ = 0.69 m) times the 0.15 that the second order shows, and 2e-4 by the thrust"},
        (4 * value(fine, column) - value(coarse, column)) / 3, cost(fine));
  }
}

TEST(Lining, RigidSidesPressARing) {
  CaseReport report("support", {"thrust of the pressed ring, corner, K_L 1 GPa/m"});
  for (const PressedRing& ring : {PressedRing{"ring.toml", "1 GPa/m", 967499, -89017.7, 32401.4},
                                  PressedRing{"ring_soft.toml", "1 MPa/m", 4977.08, -595.35, 297.57}}) {
    check_ring(report, ring);
    check_order(report, ring);
  }
}

// Uniform pressure bends a polygon, but not a ring: the smoothing removes this bending.
TEST(Lining, SmoothingTakesTheRippleOfThePolygon) {
  CaseReport report("support");
  const SceneRun run = cases::run("ring_soft.toml");
  double smoothed = 0, raw = 0;
  for (const LiningRow& node : run.results.linings) {
    if (node.stage != 2) continue;
    smoothed = std::max(smoothed, std::abs(node.smoothed_moment.value()));
    raw = std::max(raw, std::abs(node.forces.moment));
  }
  report.record({"smoothed moment of a ring of twelve sides under even pressure, of the largest before",
                 "1",
                 Kind::exact,
                 "equilibrium: uniform pressure does not bend a ring",
                 0,
                 {1e-6, 0},
                 "by symmetry all sides have one pressure except for the residual of Newton's method, 1e-8 of the "
                 "forces, times N a over M, 40"},
                smoothed / raw, cost(run));
}

// An arc over a bed of n sides per revolution. A node at a corner is on two sides, each rotated by π/n: a part of the
// bed's normal stiffness acts along the arc there besides the shear stiffness, and vice versa.
reference::BeddedArc invert(double shear_stiffness, int sides, double half_angle_deg) {
  constexpr double thickness = 0.3, modulus = 25e9, normal_stiffness = 1e7, density = 2400, gravity = 9.81;
  const double turn = std::numbers::pi / sides, along = std::pow(std::sin(turn), 2);
  return {5 / std::cos(turn),
          half_angle_deg * degree,
          modulus * thickness,
          modulus * std::pow(thickness, 3) / 12,
          normal_stiffness + (shear_stiffness - normal_stiffness) * along,
          shear_stiffness + (normal_stiffness - shear_stiffness) * along,
          density * gravity * thickness};
}

// largest at a node except the ends, of the largest
struct ArcError {
  double thrust = 0, moment = 0;
};

ArcError arc_error(const SceneRun& run, const reference::BeddedArc& arc) {
  ArcError error;
  double thrust = 0, moment = 0;
  const std::vector<LiningRow>& nodes = run.results.linings;
  for (std::size_t i = 1; i + 1 < nodes.size(); ++i) {
    const SectionForces& forces = nodes[i].forces;
    const reference::MemberForces exact = bedded_arc(arc, std::atan2(nodes[i].x, -nodes[i].y));
    error.thrust = std::max(error.thrust, std::abs(forces.thrust - exact.thrust));
    error.moment = std::max(error.moment, std::abs(forces.moment - exact.moment));
    thrust = std::max(thrust, std::abs(exact.thrust));
    moment = std::max(moment, std::abs(exact.moment));
  }
  return {error.thrust / thrust, error.moment / moment};
}

void check_invert(CaseReport& report, double shear_stiffness) {
  const std::string stiffness = fmt::format("joint_properties.bed.shear_stiffness={}", shear_stiffness),
                    name = fmt::format("shear stiffness {:g} MPa/m", 1e-6 * shear_stiffness),
                    form = "arc on an elastic bed under its weight, reference/tunnel/bedded_arc.hpp";
  const SceneRun run = cases::run("invert.toml", {stiffness});
  const SceneRun coarse =
      cases::run("invert.toml", {stiffness, "excavations.opening.cylinder.sides=90", "linings.invert.nodes=31",
                                 "linings.invert.from_deg=210", "linings.invert.to_deg=330"});
  const ArcError fine = arc_error(run, invert(shear_stiffness, 180, 59)),
                 rough = arc_error(coarse, invert(shear_stiffness, 90, 60));
  report.record(
      {"thrust of an invert, largest error of the largest, " + name,
       "1",
       Kind::exact,
       form,
       0,
       {1.5e-3, 0},
       "beams of 2°: a thrust that changes with γ a cos θ, γ a = 35 kN, is accurate to (2°)²/2 of that, 21 N of 15 kN"},
      fine.thrust, cost(run));
  report.record({"moment of an invert, largest error of the largest, " + name,
                 "1",
                 Kind::exact,
                 form,
                 0,
                 {2e-2, 0},
                 "the largest thrust, 15 to 17 kN, times l²/8a = 0.76 mm, the distance of a beam's middle from the "
                 "circle: 13 N m of 700 "
                 "to 800"},
                fine.moment, cost(run));
  report.record({"error of an invert's moment with 30 beams over that with 59, " + name,
                 "1",
                 Kind::limit,
                 "convergence: second order, 4",
                 3,
                 {0, 0, verification::Bound::at_least},
                 "half way between the first order's 2 and 4: it is the largest error, not that at one place"},
                rough.moment / fine.moment, cost(coarse));
}

TEST(Lining, AnInvertOnItsElasticBed) {
  CaseReport report("support");
  for (const double shear_stiffness : {1e6, 1e4})
    check_invert(report, shear_stiffness);
}

TEST(Lining, APlateHangsFromItsInterface) {
  CaseReport report("support");
  const double weight = 2400 * 9.81 * 0.3;  // Pa
  const SceneRun run = cases::run("hung_lining.toml");
  double pull = weight, bending = 0, length = 0;
  for (const LiningRow& node : run.results.linings) {
    if (std::abs(node.pressure + weight) > std::abs(pull - weight)) pull = -node.pressure;
    bending = std::max(bending, std::abs(node.forces.moment));
    length = std::max(length, std::abs(node.x));
  }
  report.record({"pull between a hanging lining and its roof, the node farthest from it",
                 "Pa",
                 Kind::exact,
                 "equilibrium: ρ g t",
                 weight,
                 {0, 1e-6},
                 "equilibrium leaves 1e-9 of the mean force; a node's mass and tributary length are of the same beams, "
                 "whatever joint is in the roof"},
                pull, cost(run));
  report.record({"bending of the hanging lining, of its weight times its half length",
                 "1",
                 Kind::exact,
                 "equilibrium: a load supported at its own points causes no bending",
                 0,
                 {1e-6, 0},
                 "the same"},
                bending / (weight * length * length), cost(run));
}

TEST(Lining, APlateFallsIfItsInterfaceIsTooWeak) {
  CaseReport report("support");
  const auto ends = [](double of_weight) {
    return run_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / "hung_lining.toml",
                     {fmt::format("joint_properties.rock_to_lining.tension={}", of_weight * 2400 * 9.81 * 0.3),
                      "stage.hang.step_limit=100000"},
                     1);
  };
  const SceneRun holds = ends(1.001), falls = ends(0.999);
  report.record({"linings at rest, of one whose interface holds 1.001 of its weight and one 0.999",
                 "1",
                 Kind::exact,
                 "equilibrium: tension > ρ g t",
                 1,
                 {0, 0},
                 "the first reaches equilibrium, the second does not"},
                (holds.results.outcome == Outcome::done) + (falls.results.outcome == Outcome::done), cost(falls));
}

}  // namespace
}  // namespace voussoir::cases::lining_test
