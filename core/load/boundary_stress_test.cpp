// Stress on outer faces: its resultants, the force of a joint under it, and its part in the energy balance.
#include "core/load/boundary_stress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/run/run.hpp"
#include "core/step/integrate.hpp"
#include "core/testing/models.hpp"
#include "core/testing/oracles.hpp"

namespace voussoir::boundary_stress_test {
namespace {

using namespace shapes;

template <int Dim>
Matrix<Dim> some_stress() {
  return stress_tensor<Dim>(Dim == 2 ? std::vector<double>{3e5, 1e5, -0.7e5}
                                     : std::vector<double>{3e5, 1e5, 2e5, 0.4e5, -0.3e5, -0.7e5});
}

// blocks given directly: no face was made by a joint
template <int Dim>
Body<Dim> outer_body(const HalfSpaces<Dim>& planes, bool fixed, const char* name) {
  Body<Dim> body = make_body<Dim>({make_block<Dim>(planes, std::vector<int>(planes.size(), no_joint)).part}, density);
  body.fixed = fixed;
  body.name = name;
  return body;
}

template <int Dim>
BoundaryPlan on_all(const std::vector<double>& stress) {
  return {.bodies = {.all = true, .names = {}, .above = {}, .below = {}, .inside = {}}, .stress = stress};
}

template <int Dim>
Load<Dim> sum_of(const std::vector<DeadLoad<Dim>>& forces) {
  Load<Dim> sum;
  for (const DeadLoad<Dim>& force : forces)
    sum += load_of<Dim>(force, Matrix<Dim>::Identity());
  return sum;
}

// A stress that is the same everywhere balances itself on any closed surface: no force, no moment.
TEST(BoundaryStress, BalancesItselfOnEveryBlock) {
  Random random(7);
  for (int i = 0; i < 20; ++i) {
    HalfSpaces<3> planes = cube<3>(1);
    for (int k = 0; k < 4; ++k)
      planes.push_back({normal_vector<3>(random).normalized(), uniform(random, 0.5, 1)});
    Body<3> body = outer_body<3>(planes, false, "block");
    const std::vector<DeadLoad<3>> forces = boundary_loads<3>(body.parts.front(), some_stress<3>());
    ASSERT_GE(forces.size(), 4u);
    const Load<3> sum = sum_of<3>(forces);
    EXPECT_LT(sum.force.norm(), 1e-13 * 3e5 * 24);
    EXPECT_LT(sum.moment.norm(), 1e-12 * 3e5 * 24);
  }
  Body<2> body = outer_body<2>(cube<2>(1), false, "block");
  const Load<2> sum = sum_of<2>(boundary_loads<2>(body.parts.front(), some_stress<2>()));
  EXPECT_LT(sum.force.norm() + sum.moment.norm(), 1e-12 * 3e5 * 8);
}

// Compression pushes inwards, shear along; a face that a joint made has no load.
TEST(BoundaryStress, LoadsOuterFacesOnly) {
  Polytope<3> part = make_block<3>(cube<3>(1), {no_joint, 0, 0, 0, 0, 0}).part;
  const Matrix<3> stress = some_stress<3>();
  const std::vector<DeadLoad<3>> loads = boundary_loads<3>(part, stress);
  ASSERT_EQ(loads.size(), 1u);
  std::size_t outer = 0;
  while (part.joints[outer] != no_joint)
    ++outer;
  const Vector<3>& n = part.faces[outer].normal;
  EXPECT_LT((loads[0].place - n).norm(), 1e-14);
  EXPECT_LT((loads[0].force + 4 * stress * n).norm(), 1e-9);
  EXPECT_TRUE(boundary_loads<3>(part, Matrix<3>::Zero()).empty());
}

// A block on a plate, whose base a joint made, is pushed down and sideways on its other faces: in equilibrium the joint
// supports these forces and the weight. The settled block then turns freely under a couple, and both balances of energy
// close.
template <int Dim>
void expect_pressed_joint() {
  Vector<Dim> low = Vector<Dim>::Constant(-3), high = Vector<Dim>::Constant(3);
  high[Dim - 1] = 0;
  Vector<Dim> block_low = Vector<Dim>::Constant(-0.5), block_high = Vector<Dim>::Constant(0.5);
  block_low[Dim - 1] = 0;
  Body<Dim> pressed = outer_body<Dim>(box<Dim>(block_low, block_high), false, "block");
  Polytope<Dim>& part = pressed.parts.front();
  for (std::size_t f = 0; f < part.faces.size(); ++f)
    if (part.faces[f].normal[Dim - 1] < -0.5) part.joints[f] = 0;
  Model<Dim> model = model_of<Dim>({outer_body<Dim>(box<Dim>(low, high), true, "plate"), pressed});
  const Matrix<Dim> stress = some_stress<Dim>();
  const int block = index_of(model, "block");
  model.bodies[block].free_rotation.fill(false);
  model = apply(model, {.fix = {},
                        .release = {},
                        .remove = {},
                        .move = {},
                        .boundary = {on_all<Dim>(Dim == 2 ? std::vector<double>{3e5, 1e5, -0.7e5}
                                                          : std::vector<double>{3e5, 1e5, 2e5, 0.4e5, -0.3e5, -0.7e5})},
                        .friction = {}});
  Settings settings;
  State<Dim> state = initial_state(model);
  const RunReport report = run(model, settings, {.rest = true, .step_limit = 100000}, {.properties = {}}, state);
  ASSERT_EQ(report.reason, StopReason::equilibrium);
  Vector<Dim> expected = model.bodies[block].mass * model.gravity;
  expected -= stress.col(Dim - 1);  // all faces but the base: the sum without the base's part, area 1
  Vector<Dim> carried = Vector<Dim>::Zero();
  for (const Contact<Dim>& c : state.contacts.list)
    carried += (model.parts[c.part_a].body == block ? 1.0 : -1.0) * c.force;
  EXPECT_LT((carried - expected).norm(), 1e-5 * expected.norm());
  EXPECT_LT(state.ledger.energy.relative_error(), 1e-3) << "linear springs of constant area";
  EXPECT_GT(state.ledger.energy.flows[Source::boundary_stress], 0);
}

TEST(BoundaryStress, IsSupportedByTheJoint) {
  expect_pressed_joint<3>();
  expect_pressed_joint<2>();
}

// The force of a stress that grows with depth on the faces of a block is that of its mean, and its moment that of the
// growth over each face; all around, the forces are the divergence of the stress over the block.
template <int Dim>
void expect_growing_stress() {
  const double size = 1;
  const Polytope<Dim> part = outer_body<Dim>(cube<Dim>(size), false, "block").parts.front();
  const Matrix<Dim> growth = some_stress<Dim>();
  const DepthStress<Dim> stress{some_stress<Dim>(), growth, 5};
  Load<Dim> sum;
  for (const DeadLoad<Dim>& load : boundary_loads<Dim>(part, stress))
    sum += load_of<Dim>(load, Matrix<Dim>::Identity());
  const double volume = std::pow(2 * size, Dim);
  // -∫ σ n dA = -∫ div σ dV, the stress falling by `growth` with each metre of height
  const Vector<Dim> expected = volume * growth.col(Dim - 1);
  EXPECT_LT((sum.force - expected).norm(), 1e-12 * expected.norm());
  // about the centroid, for a symmetric stress: ∫ x × div σ dV = 0
  EXPECT_LT(sum.moment.norm(), 1e-12 * expected.norm());
  const DepthStress<Dim> above{some_stress<Dim>(), growth, -5};
  Load<Dim> none;
  for (const DeadLoad<Dim>& load : boundary_loads<Dim>(part, above))
    none += load_of<Dim>(load, Matrix<Dim>::Identity());
  EXPECT_LT(none.force.norm(), 1e-12 * expected.norm());
}

TEST(BoundaryStress, GrowsWithDepth) {
  expect_growing_stress<2>();
  expect_growing_stress<3>();
}

// ---- a surface within faces --------------------------------------------------------------------------------------

using oracle::Real;

// Of the stress on one face, about the origin: chords across the direction in which its depth changes fastest, by
// Gauss's three points between corners and surface. Chord, its middle and depth are linear there, their product a
// cubic.
Load<3> load_by_chords(const std::vector<oracle::RealVector<3>>& ring, const oracle::RealVector<3>& normal,
                       const DepthStress<3>& stress) {
  using Point = oracle::RealVector<3>;
  Point along = Point::UnitZ() - normal[2] * normal;
  if (along.norm() < 1e-9L) along = Point::UnitX() - normal[0] * normal;
  along.normalize();
  const Point across = normal.cross(along);
  std::vector<Real> places;
  for (const Point& p : ring)
    places.push_back(along.dot(p));
  if (std::abs(along[2]) > 1e-6L)  // the face's plane meets the surface in a line across
    places.push_back(along.dot(ring[0]) + (stress.surface - ring[0][2]) / along[2]);
  std::ranges::sort(places);
  const auto [first, last] = std::ranges::minmax(ring, {}, [&](const Point& p) { return along.dot(p); });
  Point force = Point::Zero(), moment = Point::Zero();
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const Real a = std::max(places[i], along.dot(first)), b = std::min(places[i + 1], along.dot(last));
    if (b - a < 1e-18L) continue;
    for (const auto& [node, weight] :
         {std::pair<Real, Real>{-std::sqrt(0.6L), 5 / 18.0L}, {0, 8 / 18.0L}, {std::sqrt(0.6L), 5 / 18.0L}}) {
      const Real t = (a + b) / 2 + node * (b - a) / 2;
      std::vector<Point> ends;
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Point &p = ring[k], &q = ring[(k + 1) % ring.size()];
        const Real of_p = along.dot(p) - t, of_q = along.dot(q) - t;
        if ((of_p < 0) != (of_q < 0)) ends.push_back(p + of_p / (of_p - of_q) * (q - p));
      }
      if (ends.size() != 2) continue;
      const Point middle = (ends[0] + ends[1]) / 2;
      const Real depth = std::max(Real(0), stress.surface - middle[2]);
      const oracle::RealMatrix<3> there = stress.above.cast<Real>() + depth * stress.per_depth.cast<Real>();
      const Point push = -weight * (b - a) * std::abs(across.dot(ends[1] - ends[0])) * (there * normal);
      force += push;
      moment += middle.cross(push);
    }
  }
  return {force.cast<double>(), moment.cast<double>()};
}

// the same of an edge in the plane
Load<2> load_by_chords(const std::vector<oracle::RealVector<2>>& edge, const oracle::RealVector<2>& normal,
                       const DepthStress<2>& stress) {
  using Point = oracle::RealVector<2>;
  const Point &p = edge[0], &q = edge[1];
  std::vector<Real> places{0, 1};
  if ((p[1] < stress.surface) != (q[1] < stress.surface)) places.push_back((stress.surface - p[1]) / (q[1] - p[1]));
  std::ranges::sort(places);
  Point force = Point::Zero();
  Real moment = 0;
  for (std::size_t i = 0; i + 1 < places.size(); ++i)
    for (const Real node : {-std::sqrt(1 / 3.0L), std::sqrt(1 / 3.0L)}) {
      const Real width = places[i + 1] - places[i], t = places[i] + (1 + node) / 2 * width;
      const Point at = p + t * (q - p);
      const oracle::RealMatrix<2> there =
          stress.above.cast<Real>() + std::max(Real(0), stress.surface - at[1]) * stress.per_depth.cast<Real>();
      const Point push = -width / 2 * (q - p).norm() * (there * normal);
      force += push;
      moment += at[0] * push[1] - at[1] * push[0];
    }
  return {force.cast<double>(), Spin<2>(static_cast<double>(moment))};
}

// Blocks turned anyhow and boxes, whose faces are vertical and level; a surface anywhere, or at a corner.
template <int Dim>
void expect_clipped_at_the_surface(int blocks) {
  Random random(60 + Dim);
  int crossed = 0, wrong = 0;
  double worst = 0;
  for (int i = 0; i < blocks; ++i) {
    HalfSpaces<Dim> planes = random_planes<Dim>(random, integer(random, 0, 5), 1);
    if (integer(random, 0, 3) > 0) planes = placed<Dim>(planes, matrix(orientation<Dim>(random)), Vector<Dim>::Zero());
    Polytope<Dim> part = centred_block<Dim>(planes);
    DepthStress<Dim> stress{Matrix<Dim>::Zero(), some_stress<Dim>(), uniform(random, -1.5, 1.5)};
    if (integer(random, 0, 2) == 0) stress.above = 3 * some_stress<Dim>();
    if (integer(random, 0, 2) == 0)
      stress.surface = part.vertices[integer(random, 0, part.vertices.size() - 1)][Dim - 1];
    for (std::size_t f = 0; f < part.faces.size(); ++f) {
      if (static_cast<int>(part.loops[f].size()) < Dim) continue;
      part.joints.assign(part.faces.size(), 0);
      part.joints[f] = no_joint;
      std::vector<oracle::RealVector<Dim>> ring;
      double lowest = 10, highest = -10;
      for (const int v : part.loops[f]) {
        ring.push_back(part.vertices[v].template cast<Real>());
        lowest = std::min(lowest, part.vertices[v][Dim - 1]);
        highest = std::max(highest, part.vertices[v][Dim - 1]);
      }
      const Load<Dim> found = sum_of<Dim>(boundary_loads<Dim>(part, stress));
      const Load<Dim> expected = load_by_chords(ring, part.faces[f].normal.template cast<Real>(), stress);
      // stress at the deepest point over all of the face; in space a polygon's corners lie in its plane to some 1e-15
      const double deepest = face_area<Dim>(part, static_cast<int>(f)) *
                             (stress.above + std::max(0.0, stress.surface - lowest) * stress.per_depth).norm();
      const double error =
          std::max((found.force - expected.force).norm(), (found.moment - expected.moment).norm() / part.radius);
      if (deepest > 0) worst = std::max(worst, error / deepest);
      wrong += !(error <= 1e-12 * deepest);
      crossed += lowest < stress.surface && stress.surface < highest;
    }
  }
  EXPECT_EQ(wrong, 0) << "the worst by " << worst << " of its load at the deepest point";
  EXPECT_GT(crossed, blocks);
}

TEST(BoundaryStress, IsClippedAtItsSurface) {
  expect_clipped_at_the_surface<2>(400);
  expect_clipped_at_the_surface<3>(400);
}
TEST(BoundaryStressLong, IsClippedAtItsSurface) {
  expect_clipped_at_the_surface<2>(2'000);
  expect_clipped_at_the_surface<3>(2'000);
}

// One sheared face turns a block that is free in space: the work of the load is the kinetic energy.
TEST(BoundaryStress, WorkOnATurningBlockIsItsKineticEnergy) {
  Model<3> model = model_of<3>({outer_body<3>(cube<3>(1), false, "block")});
  model.gravity.setZero();
  model.boundary = {{0, {{{0, 0.3, 1}, {1e4, 0, 0}}}}};
  Settings settings;
  settings.damping.local = 0;
  settings.time.step = 1e-4;
  State<3> state = initial_state(model);
  run(model, settings, {.end_time = 0.2}, {.properties = {}}, state);
  const EnergyBalance& e = state.ledger.energy;
  EXPECT_GT(rotation_vector(state.bodies.motions[0].rotation).norm(), 1e-3);
  EXPECT_NEAR(e.kinetic, e.external(), 1e-3 * e.kinetic) << "the flow is half a step of 2,000 ahead";
  EXPECT_LT(std::abs(e.flows[Source::contacts]), 1e-12 * e.largest_energy);
  EXPECT_LT(e.relative_error(), 1e-12);
}

}  // namespace
}  // namespace voussoir::boundary_stress_test
