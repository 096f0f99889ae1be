#include "reference/jointedbeam/jointedbeam.hpp"
#include "text/angle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

using namespace voussoir::reference;
using voussoir::degree;

namespace {

constexpr double millimetre = 1e-3;

JointedBeam full_block() {
  JointedBeam beam;
  beam.joint.cells = 100;
  return beam;
}

JointedBeam half_block() {
  JointedBeam beam = full_block();
  beam.height = beam.abutment_height = 0.023;
  return beam;
}

// cells do not slip by themselves, as in the earlier values
JointedBeam without_slip(JointedBeam beam) {
  beam.joint.friction.angle = 89 * degree;
  return beam;
}

JointedBeam with_cells(JointedBeam beam, int cells, CellClosure closure) {
  beam.joint.cells = cells;
  beam.joint.closure = closure;
  return beam;
}

// m, downwards, of the third block's centroid: the mid-span of the earlier values
double third_block(const BeamState& state) {
  return -state.blocks[2].displacement.y;
}

double weight_of_all(const JointedBeam& beam, double gravity) {
  return beam.blocks * beam.density * beam.length * beam.height * beam.width * beam.g * gravity;
}

JointForce pressed(const JointLaw& law, double apart, double turn, double height, double width) {
  JointHistory next;
  return joint_force(law, width, {{0, 0}, 0, height}, {{apart, 0}, turn, height}, {}, next);
}

// ---- one joint ----------------------------------------------------------------------------------------------------

TEST(BeamJoint, HasTheForceOfATriangleOfStress) {
  constexpr double height = 0.04, width = 0.05, turn = -1e-3, stiffness = 10e9;
  JointLaw law;
  // the overlap is 0 at 1 mm below the middle and grows by 1e-3 downwards: right faces that turn clockwise open above
  const double least = 1e-6, contact = 0.5 * height - 1e-3;
  for (const int cells : {1, 7, 200}) {
    law.cells = cells;
    law.closure = CellClosure::mean;
    const JointForce f = pressed(law, least, turn, height, width);
    const double normal = 0.5 * stiffness * width * contact * contact * 1e-3;
    EXPECT_NEAR(f.normal / normal, 1, 1e-6) << cells;
    EXPECT_NEAR(f.point.y, -(0.5 * height - contact / 3), 1e-6 * height) << cells;
    EXPECT_NEAR(f.moment, -f.normal * f.point.y, 1e-3 * std::abs(f.moment)) << cells;
    EXPECT_NEAR(f.open, height - contact, 1e-6 * height) << cells;
  }
  // one point at the centroid: two thirds of the greatest stress over all the area, instead of one half
  law.cells = 1;
  law.closure = CellClosure::at_point;
  const JointForce one = pressed(law, least, turn, height, width);
  law.closure = CellClosure::mean;
  const double whole = pressed(law, least, turn, height, width).normal;
  EXPECT_NEAR(one.normal / whole, 4.0 / 3, 1e-12);
  // the analytic centre halves the contact but for the upper edges: at y from the edge of a contact of breadth b,
  // 2/(b - y) = 2/y - 2/(h - y); the force is right, the arm is short
  law.closure = CellClosure::at_centre;
  const JointForce centre = pressed(law, least, turn, height, width);
  const double y = centre.point.y + 0.5 * height;
  EXPECT_NEAR(2 / (contact - y) - 2 / y + 2 / (height - y), 0, 1e-4 / height);
  EXPECT_NEAR(centre.normal / whole, 2 * (1 - y / contact), 1e-6);
  law.cells = 2;
  EXPECT_THROW(pressed(law, least, turn, height, width), std::invalid_argument);
}

TEST(BeamJoint, StressIntegratesItsStiffness) {
  for (const StressStiffness& k : {StressStiffness{10e9, 0, 1}, StressStiffness{4e9, 7.4e4, 1},
                                   StressStiffness{2e9, 3.7e4, 1}, StressStiffness{0, 2.1e6, 0.75}}) {
    const double u = 3e-5, h = 1e-10, stress = normal_stress(k, u);
    const double slope = (normal_stress(k, u + h) - normal_stress(k, u - h)) / (2 * h);
    EXPECT_NEAR(slope / stiffness_at(k, stress), 1, 1e-6);
    EXPECT_EQ(normal_stress(k, -u), 0);
  }
  // Eqs 4.12 and 4.13 written out
  EXPECT_NEAR(normal_stress({4e9, 7.4e4, 1}, 2e-5), 5.405405e4 * (std::exp(7.4e4 * 2e-5) - 1), 1e-1);
  EXPECT_NEAR(normal_stress({0, 2.1e6, 0.75}, 2e-5), std::pow(0.25 * 2.1e6 * 2e-5, 4), 1e-6);
  EXPECT_THROW(normal_stress({1e9, 1e6, 0.5}, 1e-6), std::invalid_argument);
}

// Continuously yielding under constant pressure: slip = τ/ks + p, τ = σ tanφ (1 - exp(-p/u_peak)); in one step or in
// many.
TEST(BeamJoint, HardensAlongTheClosedForm) {
  JointLaw law;
  law.cells = 1;
  law.shear = {0, 1.9e6, 0.7};
  law.friction.peak_slip = 2e-6;
  law.friction.peak_power = 0.213;
  constexpr double height = 0.046, width = 0.046, overlap = 3e-6, slip = 4e-5;
  for (const int steps : {1, 50}) {
    JointHistory history, next;
    JointForce f = joint_force(law, width, {{0, 0}, 0, 1}, {{-overlap, 0}, 0, height}, {}, history);
    for (int i = 1; i <= steps; ++i) {
      f = joint_force(law, width, {{0, 0}, 0, 1}, {{-overlap, -slip * i / steps}, 0, height}, history, next);
      history = next;
    }
    const double stress = f.normal / (height * width), shear = f.shear / (height * width);
    EXPECT_NEAR(stress, 10e9 * overlap, 1e-6);
    const double p = history.cells[0].plastic_slip, peak = 2e-6 * std::pow(stress, 0.213);
    EXPECT_NEAR(shear, stress * std::tan(40 * degree) * (1 - std::exp(-p / peak)), 1e-9 * stress) << steps;
    EXPECT_NEAR(shear / (1.9e6 * std::pow(stress, 0.7)) + p, slip, 1e-12 * slip + 1e-18) << steps;
    EXPECT_GT(f.sliding, 0);
  }
}

// ---- the beam -----------------------------------------------------------------------------------------------------

// Earlier values, to the digits given: of joints whose cells do not slip, deflection at the third block's centroid.
TEST(JointedBeam, HasItsEarlierValues) {
  const std::vector<BeamState> full = raise_gravity(without_slip(full_block()), {40});
  ASSERT_EQ(full.size(), 1u);
  EXPECT_NEAR(full[0].thrust, 296.0, 0.05);
  EXPECT_NEAR(third_block(full[0]) / millimetre, 0.557, 5e-4);
  // the whole joint is far from sliding
  for (const BeamJoint& joint : full[0].joints)
    EXPECT_LT(std::abs(joint.shear / joint.normal), 0.5);
  EXPECT_EQ(raise_gravity(without_slip(half_block()), {77.5, 78}).size(), 1u);
}

// Coulomb's law in every cell: a tenth of the pressure at an abutment is on cells that slip, the others take their
// shear, and the beam sinks by 6 % more at almost the same thrust. Half blocks fall 0.3 g earlier.
TEST(JointedBeam, SinksMoreIfCellsSlip) {
  const BeamState slips = raise_gravity(full_block(), {40}).at(0);
  const BeamState holds = raise_gravity(without_slip(full_block()), {40}).at(0);
  EXPECT_NEAR(slips.joints[0].sliding, 0.11, 0.01);
  EXPECT_EQ(holds.joints[0].sliding, 0);
  EXPECT_NEAR(slips.thrust / holds.thrust, 1, 1e-3);
  EXPECT_NEAR(third_block(slips) / third_block(holds), 1.059, 1e-3);
  EXPECT_EQ(raise_gravity(half_block(), {77.25, 77.5}).size(), 1u);
}

// one centroid point, and n of them; the earlier deviations, in percent at 10 and 40 g
TEST(JointedBeam, FewPointsHaveTheirEarlierDeviations) {
  const JointedBeam beam = without_slip(full_block());
  const std::vector<BeamState> exact = raise_gravity(beam, {10, 20, 30, 40});
  const auto deviation = [&](int cells, int at, bool thrust) {
    static int cached = 0;
    static std::vector<BeamState> path;
    if (cells != cached) path = raise_gravity(with_cells(beam, cells, CellClosure::at_point), {10, 20, 30, 40});
    cached = cells;
    return 100 * (thrust ? path[at].thrust / exact[at].thrust : third_block(path[at]) / third_block(exact[at])) - 100;
  };
  EXPECT_NEAR(deviation(1, 0, false), -20, 0.6);
  EXPECT_NEAR(deviation(1, 3, false), -14, 0.5);
  EXPECT_NEAR(deviation(1, 0, true), 5.3, 0.1);  // "+6 %"
  for (int at = 1; at < 4; ++at)
    EXPECT_LT(std::abs(deviation(1, at, true)), 1);
  EXPECT_NEAR(deviation(8, 0, true), 1.2, 0.06);
  EXPECT_NEAR(deviation(8, 3, true), 0.9, 0.05);
  EXPECT_NEAR(deviation(8, 0, false), -0.35, 0.05);
  EXPECT_NEAR(deviation(8, 3, false), -0.8, 0.05);
  for (int at = 0; at < 4; ++at)
    EXPECT_LT(std::abs(deviation(16, at, true)), 0.7);
  for (int at = 0; at < 4; ++at)
    EXPECT_LT(std::abs(deviation(32, at, true)), 0.3);
}

// mean closures give the normal force exactly, so only the slip of cells has to converge
TEST(JointedBeam, ConvergesWithTheNumberOfCells) {
  const auto at_forty = [](int cells, CellClosure closure) {
    return raise_gravity(with_cells(full_block(), cells, closure), {40}).at(0);
  };
  const BeamState exact = at_forty(400, CellClosure::mean);
  double last = 1;
  for (const int cells : {4, 8, 16, 32, 100}) {
    const BeamState found = at_forty(cells, CellClosure::mean);
    const double error = std::abs(found.deflection / exact.deflection - 1);
    EXPECT_LT(error, last) << cells;
    EXPECT_NEAR(found.thrust / exact.thrust, 1, 2e-4) << cells;
    last = error;
  }
  EXPECT_LT(last, 1e-4);
  EXPECT_NEAR(at_forty(400, CellClosure::at_point).deflection / exact.deflection, 1, 1e-3);
}

// stiffness that changes with stress is followed from step to step
TEST(JointedBeam, DoesNotDependOnItsSteps) {
  JointedBeam beam = with_cells(full_block(), 8, CellClosure::mean);
  beam.joint.normal = {2e9, 3.7e4, 1};
  beam.joint.shear = {0, 1.9e6, 0.7};
  beam.joint.friction = {.angle = 40 * degree, .peak_slip = 2e-6, .peak_power = 0.213};
  const double closure = 79.64e-6;
  const BeamState coarse = raise_gravity(beam, {20}, closure).at(0);
  const BeamState fine = raise_gravity(beam, {20}, closure, {.gravity = 0.05}).at(0);
  EXPECT_NEAR(coarse.deflection / fine.deflection, 1, 1e-4);
  EXPECT_NEAR(coarse.thrust / fine.thrust, 1, 1e-5);
}

// sums that do not use the joints: of forces on all blocks, and of moments on the left half in its displaced position
TEST(JointedBeam, BalancesInTotalAndByHalves) {
  for (const JointedBeam& beam : {full_block(), half_block()}) {
    const double gravity = 35, weight = weight_of_all(beam, gravity);
    const BeamState s = raise_gravity(beam, {gravity}).at(0);
    EXPECT_NEAR(s.joints.front().force.y - s.joints.back().force.y, weight, 1e-5 * weight);
    EXPECT_NEAR(s.joints.front().force.x, s.joints.back().force.x, 1e-5 * weight);
    const Point from = s.joints[0].point;
    double moment =
        s.joints[3].force.x * (s.joints[3].point.y - from.y) - s.joints[3].force.y * (s.joints[3].point.x - from.x);
    for (int b = 0; b < 3; ++b)
      moment -= weight / 6 * (beam.length * (b + 0.5) + s.blocks[b].displacement.x - from.x);
    EXPECT_NEAR(moment, 0, 1e-5 * s.thrust * beam.height);
    // no line of thrust leaves the beam
    EXPECT_GT(s.thrust, least_thrust(beam, gravity, s.deflection));
    for (const BeamJoint& joint : s.joints)
      EXPECT_LT(joint.open, beam.height);
  }
}

// except that cells are counted from the left face: half a cell slips more or less
TEST(JointedBeam, IsSymmetric) {
  const BeamState s = raise_gravity(full_block(), {40}).at(0);
  for (int b = 0; b < 6; ++b) {
    const BeamBlock &here = s.blocks[b], &there = s.blocks[5 - b];
    EXPECT_NEAR(here.displacement.x, -there.displacement.x, 1e-4 * s.deflection);
    EXPECT_NEAR(here.displacement.y, there.displacement.y, 1e-4 * s.deflection);
    EXPECT_NEAR(here.rotation, -there.rotation, 1e-4 * std::abs(here.rotation));
  }
}

// Two blocks, small rotation θ, stress (k u)^m: the joint at an abutment closes over a, the middle one over b = a
// 2^(-m/(m+1)) for it opens by 2θ, and θ (a + b) = θ h + closure/2. Pressure acts at 1/(m+2) of these from the edges.
struct TwoBlocks {
  double rotation = 0, thrust = 0, breadth = 0;
};
TwoBlocks two_blocks(const JointedBeam& beam, double k, double m, double closure, double weight) {
  const auto at = [&](double rotation) {
    TwoBlocks s{rotation, 0, 0};
    const double sum = beam.height + 0.5 * closure / rotation;
    s.breadth = sum / (1 + std::pow(2, -m / (m + 1)));
    s.thrust = beam.width * std::pow(k * rotation, m) * std::pow(s.breadth, m + 1) / (m + 1);
    return std::pair(s, s.thrust * (beam.height - sum / (m + 2)) - weight * 2 * beam.length / 8);
  };
  double low = closure / beam.height, high = 0.1;
  for (int i = 0; i < 100; ++i)
    (at(0.5 * (low + high)).second < 0 ? low : high) = 0.5 * (low + high);
  return at(low).first;
}

// The more a joint stiffens with stress, the more its pressure draws to the edge: without prestress the thrust is (m +
// 2)/(m + 1) times the least, that of three hinges at the corners.
TEST(JointedBeam, OfTwoBlocksIsTheClosedFormAndTendsToThreeHinges) {
  JointedBeam beam = without_slip(full_block());
  beam.blocks = 2;
  beam.abutment_height = 1;
  beam.joint.shear.constant = 1e12;
  constexpr double closure = 2e-6, gravity = 60, overlap = 5e-6, stress = 1e5;
  double last = 2;
  for (const double power : {0.0, 0.5, 0.75}) {
    const double m = 1 / (1 - power), k = std::pow(stress, 1 / m) / overlap;
    beam.joint.normal = power == 0 ? StressStiffness{k, 0, 1} : StressStiffness{0, k * m, power};
    const BeamState s = raise_gravity(beam, {gravity}, closure).at(0);
    const TwoBlocks expected = two_blocks(beam, k, m, closure, weight_of_all(beam, gravity));
    // the closed form neglects the loss of arm by sinking, a fraction of rotation times length over height
    EXPECT_NEAR(s.thrust / expected.thrust, 1, 2 * expected.rotation) << m;
    EXPECT_NEAR(s.blocks[1].rotation / expected.rotation, 1, 4 * expected.rotation) << m;
    EXPECT_NEAR((s.deflection + s.joints[0].slip) / (expected.rotation * beam.length), 1, 4 * expected.rotation) << m;
    EXPECT_NEAR(s.joints[0].open / (beam.height - expected.breadth), 1, 4 * expected.rotation) << m;
    const double ratio = s.thrust / least_thrust(beam, gravity, s.deflection);
    EXPECT_GT(ratio, (m + 2) / (m + 1));
    EXPECT_LT(ratio, last);
    last = ratio;
  }
}

TEST(JointedBeam, IsLostAtTheGreatestGravityOfTheDeflectionPath) {
  const JointedBeam beam = half_block();
  const BeamSteps steps{.gravity = 0.5, .deflection = 5e-5};
  const BeamLimit limit = limit_of(raise_deflection(beam, 0.009, steps));
  EXPECT_NEAR(limit.gravity, 77.42, 0.01);
  EXPECT_NEAR(limit.deflection / millimetre, 7.70, 0.02);
  EXPECT_EQ(raise_gravity(beam, {limit.gravity - 0.05, limit.gravity + 0.05}, {}, steps).size(), 1u);
  // between the design limit of Diederichs & Kaiser and the load that leaves them no arch
  EXPECT_GT(limit.gravity, voussoir_beam_limit(beam, 0.35));
  EXPECT_LT(limit.gravity, voussoir_beam_limit(beam));
  EXPECT_THROW(limit_of(raise_deflection(beam, 0.001, steps)), std::domain_error);
}

TEST(JointedBeam, ClosureGivesTheThrustAtOneG) {
  for (JointedBeam beam : {full_block(), half_block()})
    for (const StressStiffness& k : {StressStiffness{10e9, 0, 1}, StressStiffness{4e9, 7.4e4, 1}}) {
      beam.joint.normal = k;
      EXPECT_NEAR(raise_gravity(beam, {1}).at(0).thrust, 60, 1e-5);
    }
  // joints that stay closed are springs in a row
  EXPECT_NEAR(abutment_closure(full_block()) / (7 * 60 / (10e9 * 0.046 * 0.046)), 1, 1e-3);
}

// their own iteration, for one fraction of the height
TEST(VoussoirBeam, IsTheIterationOfDiederichsAndKaiser) {
  const JointedBeam beam = half_block();
  const double gravity = 30, span = 0.276, modulus = 10e9 * span / 7, load = 1207 * 9.81 * gravity;
  const VoussoirBeam found = voussoir_beam(beam, gravity);
  const double n = found.compressed, first = beam.height * (1 - 2 * n / 3);
  double rise = first, stress = 0;
  for (int i = 0; i < 200; ++i) {
    stress = load * span * span / (4 * n * rise);
    const double length = span + 8 * first * first / (3 * span),
                 shorter = stress * (2.0 / 3 + n) / 3 / modulus * length;
    rise = std::sqrt(3 * span / 8 * (8 * first * first / (3 * span) - shorter));
  }
  EXPECT_NEAR(found.deflection / (first - rise), 1, 1e-9);
  EXPECT_NEAR(found.thrust / (0.5 * stress * n * beam.height * beam.width), 1, 1e-9);
  // stiff: N = 3/4, half of the height is the rise
  EXPECT_NEAR(voussoir_beam(beam, 1e-3).compressed, 0.75, 0.002);
  EXPECT_NEAR(voussoir_beam(beam, 1e-3).thrust / (2 * least_thrust(beam, 1e-3)), 1, 1e-3);
}

}  // namespace
