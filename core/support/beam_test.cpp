// The co-rotational beam against its own potential, the elastica, rings and the eigenvalues of chains.
#include "core/support/beam.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/testing/dense.hpp"
#include "core/testing/shapes.hpp"

namespace voussoir::beam_test {
namespace {

using shapes::Random;
using shapes::uniform;
constexpr double pi = std::numbers::pi;

Vector<2> polar(double radius, double angle) {
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

using State = Eigen::Matrix<double, 6, 1>;

BeamStrain strain_of(const Beam& beam, const State& q) {
  return beam_strain(beam, {q.head<2>(), q[2]}, {q.segment<2>(3), q[5]});
}

// on the nodes
State forces_on(const Beam& beam, const State& q) {
  const BeamForces f = beam_forces(beam, strain_of(beam, q));
  return (State() << f.force[0], f.moment[0], f.force[1], f.moment[1]).finished();
}

// nodes joined by beams in a row, the last to the first if it is closed
struct Chain {
  std::vector<Vector<2>> nodes;
  std::vector<Beam> beams;

  Chain(std::vector<Vector<2>> places, bool closed, double ea, double ei) : nodes(std::move(places)) {
    for (std::size_t i = 0; i + (closed ? 0 : 1) < nodes.size(); ++i)
      beams.push_back({nodes[(i + 1) % nodes.size()] - nodes[i], ea, ei});
  }
  int freedoms() const { return 3 * static_cast<int>(nodes.size()); }
  int second(int beam) const { return (beam + 1) % static_cast<int>(nodes.size()); }
  State state(const Eigen::VectorXd& q, int beam) const {
    return (State() << q.segment<3>(3 * beam), q.segment<3>(3 * second(beam))).finished();
  }
  BeamForces forces(const Eigen::VectorXd& q, int beam) const {
    return beam_forces(beams[beam], strain_of(beams[beam], state(q, beam)));
  }
  Eigen::VectorXd inner(const Eigen::VectorXd& q) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(freedoms());
    for (int b = 0; b < static_cast<int>(beams.size()); ++b) {
      const State f = forces_on(beams[b], state(q, b));
      sum.segment<3>(3 * b) += f.head<3>();
      sum.segment<3>(3 * second(b)) += f.tail<3>();
    }
    return sum;
  }
  Eigen::MatrixXd tangent(const Eigen::VectorXd& q) const {
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(freedoms(), freedoms());
    for (int b = 0; b < static_cast<int>(beams.size()); ++b) {
      const BeamMatrix own = beam_tangent(beams[b], strain_of(beams[b], state(q, b)));
      const int place[2] = {3 * b, 3 * second(b)};
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
          k.block<3, 3>(place[i], place[j]) += own.block<3, 3>(3 * i, 3 * j);
    }
    return k;
  }
};

Chain straight(int beams, double length, double ea, double ei) {
  std::vector<Vector<2>> nodes;
  for (int i = 0; i <= beams; ++i)
    nodes.emplace_back(length * i / beams, 0);
  return {nodes, false, ea, ei};
}

Chain ring(int beams, double radius, double ea, double ei) {
  std::vector<Vector<2>> nodes;
  for (int i = 0; i < beams; ++i)
    nodes.push_back(polar(radius, 2 * pi * i / beams));
  return {nodes, true, ea, ei};
}

// Equilibrium under dead loads by Newton's method, from q, with some degrees of freedom held. Convergence is quadratic:
// a small step that is no longer half the last one is rounding.
void find_equilibrium(const Chain& chain, const Eigen::VectorXd& load, const std::vector<int>& held,
                      Eigen::VectorXd& q) {
  double last = 1;
  for (int iteration = 0; iteration < 60; ++iteration) {
    Eigen::MatrixXd k = chain.tangent(q);
    Eigen::VectorXd left = load + chain.inner(q);
    for (const int i : held) {
      k.row(i).setZero();
      k.col(i).setZero();
      k(i, i) = 1;
      left[i] = 0;
    }
    const Eigen::VectorXd step = oracle::solution(k, left);
    q += step;
    const double size = step.cwiseAbs().maxCoeff();
    if (size < 1e-6 && size >= 0.5 * last) return;
    last = size;
  }
  FAIL() << "Newton's method did not find the equilibrium of the chain";
}

// slope of the error against the number of beams, doubled each time
void expect_second_order(const std::vector<double>& errors) {
  for (std::size_t i = 1; i < errors.size(); ++i)
    EXPECT_NEAR(std::log2(errors[i - 1] / errors[i]), 2, 0.1) << errors[i - 1] << " then " << errors[i];
}

// ---- the potential --------------------------------------------------------------------------------------------------

Beam random_beam(Random& random) {
  return {polar(uniform(random, 0.5, 2), uniform(random, -pi, pi)), uniform(random, 0.5, 2), uniform(random, 0.5, 2)};
}

// stretched by up to a third, bent by up to 0.7 rad, turned rigidly by up to three turns
State random_state(Random& random, const Beam& beam) {
  const double turn = uniform(random, -6 * pi, 6 * pi);
  const Vector<2> at(uniform(random, -1, 1), uniform(random, -1, 1));
  const Vector<2> chord =
      uniform(random, 0.7, 1.3) * (matrix(Rotation<2>{turn + uniform(random, -0.2, 0.2)}) * beam.chord);
  return (State() << at, turn + uniform(random, -0.5, 0.5), at + chord - beam.chord, turn + uniform(random, -0.5, 0.5))
      .finished();
}

// Fourth order. The shortest chord is 0.35 m, so that fifth derivatives stay below 1e5 and truncation below 1e-11;
// rounding of values near 100 leaves 1e-10.
template <typename Value, typename Function>
Value derivative(const Function& f, const State& q, int i) {
  const double h = 2e-4;
  const auto at = [&](double times) -> Value { return f(State(q + times * h * State::Unit(i))); };
  return Value((8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h));
}
constexpr double difference = 1e-9;

TEST(Beam, ForcesAreMinusTheGradientOfTheEnergy) {
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Beam beam = random_beam(random);
    const State q = random_state(random, beam), f = forces_on(beam, q);
    const auto energy = [&](const State& at) { return beam_forces(beam, strain_of(beam, at)).energy; };
    for (int i = 0; i < 6; ++i)
      EXPECT_NEAR(f[i], -derivative<double>(energy, q, i), difference);
  }
}

TEST(Beam, TangentIsMinusTheDerivativeOfTheForces) {
  Random random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const Beam beam = random_beam(random);
    const State q = random_state(random, beam);
    const BeamMatrix k = beam_tangent(beam, strain_of(beam, q));
    EXPECT_EQ((k - k.transpose()).cwiseAbs().maxCoeff(), 0);
    for (int i = 0; i < 6; ++i) {
      const State column = -derivative<State>([&](const State& at) { return forces_on(beam, at); }, q, i);
      EXPECT_LT((k.col(i) - column).cwiseAbs().maxCoeff(), difference);
    }
  }
}

TEST(Beam, ForcesOnItsNodesBalance) {
  Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const Beam beam = random_beam(random);
    const State q = random_state(random, beam);
    const BeamStrain strain = strain_of(beam, q);
    const BeamForces f = beam_forces(beam, strain);
    EXPECT_EQ((f.force[0] + f.force[1]).norm(), 0);
    const double about_first = f.moment[0] + f.moment[1] + moment(strain.length * strain.along, f.force[1])[0];
    EXPECT_NEAR(about_first, 0, 1e-14);
  }
}

TEST(Beam, TurnedRigidlyItHasNoForce) {
  Random random(4);
  constexpr double ulp = 2.3e-16;
  for (int trial = 0; trial < 1000; ++trial) {
    const Beam beam = random_beam(random);
    const double turn = uniform(random, -50, 50);
    const Vector<2> at(uniform(random, -9, 9), uniform(random, -9, 9));
    const Vector<2> to = at + matrix(Rotation<2>{turn}) * beam.chord - beam.chord;
    const State f = forces_on(beam, (State() << at, turn, to, turn).finished());
    // 10 m of displacement are known to one ulp, 50 rad too; stiffnesses are below 2/0.5 and 6 · 2/0.5
    EXPECT_LT(f.cwiseAbs().maxCoeff(), 24 * (4 * 20 + 50) * ulp);
  }
}

TEST(Beam, TinyStrainsAreAccurate) {
  const Beam beam{{3, 4}, 1, 1};
  const BeamStrain strain = beam_strain(beam, {}, {{3e-14, -1e-14}, 2e-14});
  // along (0.6, 0.8), across (-0.8, 0.6); second order of the strains, 1e-14, and rounding
  EXPECT_NEAR(strain.elongation, 1e-14, 1e-28);
  EXPECT_NEAR(strain.end_rotation[0], 0.6e-14, 1e-28);
  EXPECT_NEAR(strain.end_rotation[1], 2.6e-14, 1e-28);
}

TEST(Beam, CoincidingNodesAreReportedWithoutForces) {
  const Beam beam{{1, 0}, 1, 1};
  const BeamStrain strain = beam_strain(beam, {}, {{-1, 0}, 0.3});
  EXPECT_EQ(strain.length, 0);
  EXPECT_EQ(beam_forces(beam, strain).energy, 0);
  EXPECT_TRUE(beam_tangent(beam, strain).isZero(0));
}

// compression, sagging and shear as in the header
TEST(Beam, Signs) {
  const Beam beam{{2, 0}, 10, 4};
  EXPECT_GT(beam_forces(beam, beam_strain(beam, {}, {{-0.01, 0}, 0})).normal_force, 0);
  const BeamForces smile = beam_forces(beam, beam_strain(beam, {{0, 0}, -0.1}, {{0, 0}, 0.1}));
  EXPECT_LT(smile.end_moment[0], 0);
  EXPECT_GT(smile.end_moment[1], 0);
  EXPECT_NEAR(smile.end_moment[1], 4 * 0.2 / 2, 1e-15);  // EI times curvature
  const BeamForces raised = beam_forces(beam, beam_strain(beam, {}, {{0, 1e-4}, 0}));
  EXPECT_LT(raised.force[1][1], 0);
  EXPECT_NEAR(raised.force[1][1], -12 * 4 * 1e-4 / 8, 1e-11);  // 12 EI w/L³, and (w/L)² of it
}

// ---- the elastica ---------------------------------------------------------------------------------------------------

TEST(BeamChain, RollsUpIntoAClosedCircle) {
  const int n = 12;
  const double length = 3, ei = 2;
  const Chain chain = straight(n, length, 5, ei);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(chain.freedoms()), load = q;
  for (int part = 1; part <= 8; ++part) {
    load[3 * n + 2] = part / 8.0 * 2 * pi * ei / length;
    find_equilibrium(chain, load, {0, 1, 2}, q);
  }
  EXPECT_NEAR(q[3 * n], -length, 1e-9);
  EXPECT_NEAR(q[3 * n + 1], 0, 1e-9);
  EXPECT_NEAR(q[3 * n + 2], 2 * pi, 1e-9);
}

// v/L of a cantilever under a dead load P at its end, EI = L = 1 (Bisshopp & Drucker 1945, elliptic integrals)
double deflection(int beams, double load) {
  const double inextensible = 1e8;  // strains below 1e-7
  const Chain chain = straight(beams, 1, inextensible, 1);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(chain.freedoms()), loads = q;
  const int parts = 4;  // Newton needs no smaller ones
  for (int part = 1; part <= parts; ++part) {
    loads[3 * beams + 1] = load * part / parts;
    find_equilibrium(chain, loads, {0, 1, 2}, q);
  }
  return q[3 * beams + 1];
}

TEST(BeamChain, CantileverFollowsTheElastica) {
  const double known[][2] = {{1, 0.301721}, {2, 0.493457}, {5, 0.713792}, {10, 0.810609}};
  for (const auto& [load, expected] : known) {
    const double ten = deflection(10, load), twenty = deflection(20, load), forty = deflection(40, load);
    EXPECT_NEAR(ten, expected, 2e-3 * expected) << load;
    expect_second_order({ten - twenty, twenty - forty});
    // the remaining error is of fourth order: a few (1/40)⁴; the printed digits
    EXPECT_NEAR((4 * forty - twenty) / 3, expected, 2e-6 + 5e-7) << load;
    RecordProperty("error of 10 beams at " + std::to_string(load), std::to_string(ten / expected - 1));
  }
}

// ---- rings ----------------------------------------------------------------------------------------------------------

// the degrees of freedom held by symmetry about both axes; reactions vanish
std::vector<int> symmetric_supports(int n) {
  return {1, 2, 3 * (n / 4)};
}

TEST(BeamRing, PressureGivesTheHoopForce) {
  const double a = 5, pressure = 1;
  std::vector<double> errors;
  for (const int n : {24, 48, 96}) {
    const Chain chain = ring(n, a, 1e9, 1e9);
    Eigen::VectorXd q = Eigen::VectorXd::Zero(chain.freedoms()), load = q;
    for (int i = 0; i < n; ++i)
      load.segment<2>(3 * i) = -pressure * 2 * pi * a / n * polar(1, 2 * pi * i / n);
    find_equilibrium(chain, load, symmetric_supports(n), q);
    double error = 0;
    for (int b = 0; b < n; ++b)
      error = std::max(error, std::abs(chain.forces(q, b).normal_force / (pressure * a) - 1));
    errors.push_back(error);
  }
  EXPECT_LT(errors.back(), 0.005);
  expect_second_order(errors);
  RecordProperty("error of 96 beams", std::to_string(errors.back()));
}

TEST(BeamRing, OvalPressureGivesMomentAndDisplacementOfAnInextensibleRing) {
  const double a = 5, ei = 56.25e6, p = 1;  // 1 Pa moves it by 1e-6 m: linear
  std::vector<double> moment_errors, displacement_errors;
  for (const int n : {24, 48, 96}) {
    const Chain chain = ring(n, a, 1e6 * ei, ei);
    Eigen::VectorXd q = Eigen::VectorXd::Zero(chain.freedoms()), load = q;
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * pi * i / n;
      load.segment<2>(3 * i) = p * std::cos(2 * angle) * 2 * pi * a / n * polar(1, angle);
    }
    find_equilibrium(chain, load, symmetric_supports(n), q);
    const double bending = -chain.forces(q, 0).end_moment[0];
    moment_errors.push_back(std::abs(bending / (p * a * a / 3) - 1));
    displacement_errors.push_back(std::abs(q[0] / (p * a * a * a * a / (9 * ei)) - 1));
  }
  EXPECT_LT(moment_errors.back(), 0.005);
  EXPECT_LT(displacement_errors.back(), 0.005);
  expect_second_order(moment_errors);
  expect_second_order(displacement_errors);
  RecordProperty("moment error of 96 beams", std::to_string(moment_errors.back()));
  RecordProperty("displacement error of 96 beams", std::to_string(displacement_errors.back()));
}

// The pressure at which a ring of n beams buckles into an oval, EI = a = 1: at which the stiffness of beams and
// pressure, which follows the chords and has the potential q times the area, is singular for the mode of two waves.
double buckling_pressure(int n) {
  const double ea = 1e7;
  const Chain chain = ring(n, 1, ea, 1);
  const auto determinant = [&](double pressure) {
    const double radius = ea / (ea + pressure * std::cos(pi / n));  // N = q times the inscribed radius
    Eigen::VectorXd q = Eigen::VectorXd::Zero(chain.freedoms());
    Eigen::MatrixXd mode = Eigen::MatrixXd::Zero(chain.freedoms(), 3);
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * pi * i / n;
      q.segment<2>(3 * i) = (radius - 1) * polar(1, angle);
      mode.block<2, 1>(3 * i, 0) = std::cos(2 * angle) * polar(1, angle);
      mode.block<2, 1>(3 * i, 1) = std::sin(2 * angle) * polar(1, angle + pi / 2);
      mode(3 * i + 2, 2) = std::sin(2 * angle);
    }
    Eigen::MatrixXd k = chain.tangent(q);
    for (int i = 0; i < n; ++i) {  // area = Σ x_i × x_j / 2
      const int j = 3 * chain.second(i);
      const Eigen::Matrix2d cross = 0.5 * pressure * Eigen::Matrix2d{{0, 1}, {-1, 0}};
      k.block<2, 2>(3 * i, j) += cross;
      k.block<2, 2>(j, 3 * i) += cross.transpose();
    }
    return Eigen::Matrix3d(mode.transpose() * k * mode).determinant();
  };
  double low = 1, high = 5;
  EXPECT_LT(determinant(high) * determinant(low), 0);
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (determinant(middle) * determinant(low) > 0 ? low : high) = middle;
  }
  return low;
}

TEST(BeamRing, BucklesAtTheFollowerPressure) {
  std::vector<double> errors;
  for (const int n : {12, 24, 48, 96})
    errors.push_back(std::abs(buckling_pressure(n) / 3 - 1));
  EXPECT_LT(errors[2], 0.01);
  expect_second_order(errors);
  RecordProperty("error of 48 beams", std::to_string(errors[2]));
}

// ---- the time step --------------------------------------------------------------------------------------------------

// stable step by each beam's bound, over that by the eigenvalues of the chain
double step_ratio(const Chain& chain, double thickness, bool closed) {
  const int n = static_cast<int>(chain.nodes.size());
  const double l = chain.beams[0].chord.norm(), mass = 2500 * thickness * l;
  const BeamInertia half{0.5 * mass, 0.5 * mass * (l * l + thickness * thickness) / 12};
  double bound = 0;
  for (const Beam& beam : chain.beams)
    bound = std::max(bound, largest_eigenvalue_bound(beam_tangent(beam, beam_strain(beam, {}, {})), {half, half}));

  Eigen::VectorXd moves(3 * n);
  for (int i = 0; i < n; ++i) {
    const double beams = closed || (i > 0 && i < n - 1) ? 2 : 1;
    moves.segment<3>(3 * i) << 1 / std::sqrt(beams * half.mass), 1 / std::sqrt(beams * half.mass),
        1 / std::sqrt(beams * half.inertia);
  }
  const Eigen::MatrixXd k = moves.asDiagonal() * chain.tangent(Eigen::VectorXd::Zero(3 * n)) * moves.asDiagonal();
  return std::sqrt(oracle::largest_eigenvalue(k) / bound);
}

TEST(BeamStep, BoundIsSafeAndCloseToTheLimitOfTheChain) {
  double least = 1, most = 0;
  for (const double slenderness : {0.01, 0.1, 0.3, 0.5, 0.7, 1.0, 1.2, 1.414, 1.7, 2.0, 3.0, 10.0}) {
    const double l = 0.4, t = slenderness * l, e = 25e9;
    for (const bool closed : {false, true}) {
      const int n = 24;
      const double radius = l / (2 * std::sin(pi / n));
      const Chain chain =
          closed ? ring(n, radius, e * t, e * t * t * t / 12) : straight(n, n * l, e * t, e * t * t * t / 12);
      const double ratio = step_ratio(chain, t, closed);
      EXPECT_GE(ratio, 0.7) << slenderness << closed;
      EXPECT_LE(ratio, 1) << slenderness << closed;
      least = std::min(least, ratio);
      most = std::max(most, ratio);
    }
  }
  RecordProperty("least", std::to_string(least));
  RecordProperty("most", std::to_string(most));
}

TEST(BeamStep, BoundOfOneBeamIsItsEigenvalue) {
  Random random(5);
  for (int trial = 0; trial < 200; ++trial) {
    const Beam beam = random_beam(random);
    const BeamMatrix k = beam_tangent(beam, beam_strain(beam, {}, {}));
    const std::array<BeamInertia, 2> nodes{BeamInertia{uniform(random, 0.1, 2), uniform(random, 0.1, 2)},
                                           BeamInertia{uniform(random, 0.1, 2), uniform(random, 0.1, 2)}};
    State m;
    m << nodes[0].mass, nodes[0].mass, nodes[0].inertia, nodes[1].mass, nodes[1].mass, nodes[1].inertia;
    const State moves = m.cwiseSqrt().cwiseInverse();
    const BeamMatrix scaled = moves.asDiagonal() * k * moves.asDiagonal();
    const double exact = oracle::largest_eigenvalue(scaled);
    const double bound = largest_eigenvalue_bound(k, nodes);
    EXPECT_GE(bound, exact * (1 - 1e-13));
    EXPECT_LE(bound, exact * std::pow(3, 1.0 / 32));
  }
}

// a held node has no inertia; one that vibrates against it
TEST(BeamStep, HeldNodesAreIgnored) {
  const Beam beam{{2, 0}, 8, 0};
  const BeamMatrix k = beam_tangent(beam, beam_strain(beam, {}, {}));
  EXPECT_NEAR(largest_eigenvalue_bound(k, {BeamInertia{}, BeamInertia{0.5, 1}}), 8 / 2 / 0.5, 1e-13);
  EXPECT_EQ(largest_eigenvalue_bound(k, {}), 0);
}

}  // namespace
}  // namespace voussoir::beam_test
