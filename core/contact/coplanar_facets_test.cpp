// A face that consists of several facets, coplanar but for a noise, acts as one face: a block supported at one point of
// such faces neither tilts nor sinks by more than the noise, of any size.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "core/base/floating_point_traps.hpp"
#include "core/geometry/facet_weights.hpp"
#include "core/potential/particle.hpp"
#include "core/run/run.hpp"
#include "core/solvers/central_path.hpp"
#include "core/solvers/weighted_centre.hpp"
#include "core/testing/models.hpp"
#include "core/testing/oracles.hpp"

namespace voussoir::coplanar_facets_test {
namespace {

using shapes::Random;

// ---- members: a box whose faces are made of several facets ----------------------------------------------------------

constexpr double size = 1;  // m, of the block

template <int Dim>
struct Box {
  Vector<Dim> low, high;
};

template <int Dim>
using Maker = std::function<Polytope<Dim>(const Box<Dim>&)>;

template <int Dim>
Polytope<Dim> exact_box(const Box<Dim>& box) {
  return shapes::block<Dim>(shapes::box<Dim>(box.low, box.high));
}

// the hull of a box's corners, each moved by the noise: in space every side has two facets, in the plane one
template <int Dim>
Polytope<Dim> noisy_corners(const Box<Dim>& box, double noise, Random& random) {
  std::vector<Vector<Dim>> corners;
  for (int corner = 0; corner < 1 << Dim; ++corner) {
    Vector<Dim> p;
    for (int k = 0; k < Dim; ++k)
      p[k] = (corner >> k & 1 ? box.high[k] : box.low[k]) + noise * shapes::uniform(random, -1, 1);
    corners.push_back(p);
  }
  return shapes::block<Dim>(hull_planes<Dim>(corners));
}

// up to two more planes for each side, through a point near its middle, leaning by the noise
template <int Dim>
Polytope<Dim> noisy_planes(const Box<Dim>& box, double noise, Random& random) {
  HalfSpaces<Dim> planes = shapes::box<Dim>(box.low, box.high);
  const Vector<Dim> middle = 0.5 * (box.low + box.high);
  for (const HalfSpace<Dim>& side : shapes::box<Dim>(box.low, box.high))
    for (int more = shapes::integer(random, 0, 2); more > 0; --more) {
      const Vector<Dim> near = middle + 0.3 * size * shapes::direction<Dim>(random);
      const Vector<Dim> hinge = near - signed_distance<Dim>(side, near) * side.normal;
      const Vector<Dim> normal = (side.normal + noise * shapes::direction<Dim>(random)).normalized();
      planes.push_back({normal, normal.dot(hinge)});
    }
  return shapes::block<Dim>(planes);
}

// The block on a fixed base twice as wide, whose middles are one above the other.
template <int Dim>
Model<Dim> on_base(const Maker<Dim>& base, const Maker<Dim>& block, double stiffness) {
  const auto corner = [](double across, double up) {
    Vector<Dim> p = Vector<Dim>::Constant(across);
    p[Dim - 1] = up;
    return p;
  };
  std::vector<Body<Dim>> bodies{
      make_body<Dim>({base({corner(-size, -size), corner(size, 0)})}, shapes::density),
      make_body<Dim>({block({corner(-size / 2, 0), corner(size / 2, size)})}, shapes::density)};
  bodies[0].fixed = true;
  bodies[1].name = "block";
  Model<Dim> model = shapes::model_of<Dim>(std::move(bodies));
  model.properties[0].normal_stiffness = stiffness;
  model.properties[0].shear_stiffness = stiffness / 2;
  return model;
}

// ---- in equilibrium -------------------------------------------------------------------------------------------------

// A facet is inclined by at most some three times the noise over its extent, and both bodies have facets; a face that
// counts twice tilts the block by a quarter to all of `depth` over its size.
constexpr double leaning = 10;

struct Case {
  Settings settings{};
  double stiffness = 1e9;  // Pa/m: the weight presses the block in by 2.6e-5 m
  // Of the depth: the forces balance to 1e-6 (EquilibriumSettings), and a moment of that times the weight turns the
  // block by some ten times that of depth over size.
  double rest = 1e-5;
  bool closed_form = true;  // depth = weight / (stiffness area); else the result of one face each
};

struct Rest {
  double tilt = 0, depth = 0;
};

template <int Dim>
Rest settle(const Model<Dim>& model, const Settings& settings) {
  State<Dim> state = initial_state(model);
  const RunReport report = run<Dim>(model, settings, {.rest = true, .step_limit = 200'000}, {}, state);
  EXPECT_EQ(report.reason, StopReason::equilibrium) << describe(report.reason) << ": " << report.detail;
  const Motion<Dim>& motion = state.bodies.motions[shapes::index_of(model, "block")];
  return {rotation_vector(motion.rotation).norm(), -motion.displacement[Dim - 1]};
}

template <int Dim>
void expect_as_one_face(const Model<Dim>& model, double noise, const Case& c, double depth) {
  const Rest rest = settle<Dim>(model, c.settings);
  EXPECT_LT(rest.tilt, leaning * noise / size + c.rest * depth / size) << rest.tilt / depth << " of depth over size";
  EXPECT_NEAR(rest.depth, depth, leaning * noise + c.rest * depth);
}

template <int Dim>
void expect_noise_to_be_harmless(const Case& c, int seed, const std::vector<double>& noises) {
  Random random(seed);
  const Maker<Dim> exact = exact_box<Dim>;
  const double weight = shapes::density * shapes::gravity * size;
  const double depth =
      c.closed_form ? weight / c.stiffness : settle<Dim>(on_base<Dim>(exact, exact, c.stiffness), c.settings).depth;
  for (const double noise : noises) {
    SCOPED_TRACE(noise);
    const Maker<Dim> corners = [&](const Box<Dim>& box) { return noisy_corners<Dim>(box, noise, random); };
    const Maker<Dim> planes = [&](const Box<Dim>& box) { return noisy_planes<Dim>(box, noise, random); };
    for (const Maker<Dim>& noisy : {corners, planes}) {
      expect_as_one_face<Dim>(on_base<Dim>(noisy, exact, c.stiffness), noise, c, depth);
      expect_as_one_face<Dim>(on_base<Dim>(exact, noisy, c.stiffness), noise, c, depth);
      expect_as_one_face<Dim>(on_base<Dim>(noisy, noisy, c.stiffness), noise, c, depth);
    }
  }
}

// 0 and two in every decade from 1e-16 to 1e-3 m
std::vector<double> every_noise() {
  std::vector<double> all{0};
  for (int decade = -16; decade < -3; ++decade)
    for (const double digit : {1, 3})
      all.push_back(digit * std::pow(10, decade));
  all.push_back(1e-3);
  return all;
}

TEST(CoplanarFacets, ActAsOneFaceInSpace) {
  expect_noise_to_be_harmless<3>({}, 71, every_noise());
}
TEST(CoplanarFacets, ActAsOneFaceInThePlane) {
  expect_noise_to_be_harmless<2>({}, 72, every_noise());
}

const std::vector<double> some_noises{1e-12, 1e-10, 3e-9, 1e-7, 3e-6};

// pressed in by a fortieth of the largest expected overlap
TEST(CoplanarFacets, ActAsOneFaceOfASoftJoint) {
  const Case soft{.stiffness = 1e8};
  expect_noise_to_be_harmless<3>(soft, 73, some_noises);
  expect_noise_to_be_harmless<2>(soft, 74, some_noises);
}

// Between inclined faces the static solver leaves the slip of its one increment: 1e-8 to 5e-7 rad, for single faces
// too.
TEST(CoplanarFacets, ActAsOneFaceForTheStaticSolver) {
  Case c{.rest = 0.05};
  c.settings.statics.method = Statics::newton;
  expect_noise_to_be_harmless<3>(c, 75, some_noises);
  expect_noise_to_be_harmless<2>(c, 76, some_noises);
}

TEST(CoplanarFacets, ActAsOneFaceOnTheCentralPath) {
  Case c{.closed_form = false};
  c.settings.contact.point = ContactPoint::central_path;
  c.settings.contact.normal = ContactNormal::multipliers;
  expect_noise_to_be_harmless<3>(c, 77, some_noises);
  expect_noise_to_be_harmless<2>(c, 78, some_noises);
}

// At the first touch only an edge or a corner may overlap, by any depth down to rounding: its area is no measure for
// the time step, after which the block was once 1e9 to 1e25 m away.
template <int Dim>
void expect_no_flight(double depth) {
  const auto turned_box = [&](const Box<Dim>& box) {
    const Matrix<Dim> turn = matrix(turned(Rotation<Dim>{}, Spin<Dim>(Spin<Dim>::Constant(depth))));
    const Vector<Dim> corner = turn * box.low - box.low;
    Vector<Dim> in = Vector<Dim>::Zero();
    in[Dim - 1] = -depth - corner[Dim - 1];
    return shapes::block<Dim>(
        shapes::placed<Dim>(shapes::placed<Dim>(shapes::box<Dim>(box.low, box.high), turn, Vector<Dim>::Zero()),
                            Matrix<Dim>::Identity(), in));
  };
  settle<Dim>(on_base<Dim>(exact_box<Dim>, turned_box, 1e9), {});
}
TEST(CoplanarFacets, AFirstTouchByRoundingEjectsNoBlock) {
  for (double depth = 1e-15; depth < 1e-6; depth *= 1.7) {
    SCOPED_TRACE(depth);
    expect_no_flight<2>(depth);
    expect_no_flight<3>(depth);
  }
}

// The form of a part for a potential particle: its potential 1 at r outside a face, by facets too.
template <int Dim>
void expect_the_potential_of_one_face(int seed) {
  constexpr double fraction = 0.02;
  Random random(seed);
  const Box<Dim> box{Vector<Dim>::Constant(-size), Vector<Dim>::Constant(size)};
  const double radius = fraction * size;
  const PotentialShape<Dim> exact = inner_particle<Dim>(exact_box<Dim>(box), fraction).shape;
  for (const double noise : some_noises)
    for (int i = 0; i < 20; ++i) {
      const Polytope<Dim> part = i % 2 ? noisy_planes<Dim>(box, noise, random) : noisy_corners<Dim>(box, noise, random);
      const PotentialShape<Dim> shape = inner_particle<Dim>(part, fraction).shape;
      for (int k = 0; k < 10; ++k) {
        Vector<Dim> at = size * shapes::direction<Dim>(random);
        at /= at.cwiseAbs().maxCoeff();  // on a face
        const double f = value<Dim>(placed<Dim>(shape), at - part.centre),
                     expected = value<Dim>(placed<Dim>(exact), at);
        // at most Dim faces; of each the slack, over r, and the weight of two facets or three
        const double allowed = Dim * (2 * leaning * noise / radius + 2 * leaning * noise / leans_apart) + 1e-9;
        EXPECT_NEAR(f, expected, allowed) << noise;
      }
    }
}
TEST(CoplanarFacets, ActAsOneFaceOnPotentialParticles) {
  expect_the_potential_of_one_face<2>(81);
  expect_the_potential_of_one_face<3>(82);
}

// ---- weights --------------------------------------------------------------------------------------------------------

// of m facets 1/m each, of inclined faces 1; in between without a jump
TEST(CoplanarFacets, ShareTheWeightOfTheirFace) {
  for (const double angle :
       {0.0, 1e-16, 1e-12, 1e-9, 1e-6, 0.5 * leans_apart, 0.999 * leans_apart, 1.001 * leans_apart}) {
    SCOPED_TRACE(angle);
    const double c = std::cos(angle), s = std::sin(angle);
    const HalfSpaces<3> faces{{{-1, 0, 0}, 1}, {{0, -1, 0}, 1}, {{0, 0, -1}, 1}, {{0, 0, 1}, 1},
                              {{0, 1, 0}, 1},  {{s, 0, c}, 1},  {{1, 0, 0}, 1}};
    const std::vector<double> weights = facet_weights<3>(faces);
    EXPECT_EQ(weights.empty(), !(angle < leans_apart));
    const double shared = 1 / (2 - std::min(angle / leans_apart, 1.0));
    for (std::size_t f = 0; f < weights.size(); ++f)
      // the chord replaces the angle: 2e-7 of it
      EXPECT_NEAR(weights[f], f == 3 || f == 5 ? shared : 1, leans_apart * leans_apart / 20) << f;
  }
}

// A plane given m times with the weight 1/m is the plane: the centre is that of the planes given once, by an oracle in
// long double, and Newton's method needs few more iterations.
template <int Dim>
void expect_repeated_planes_to_count_once(int seed) {
  Random random(seed);
  for (int i = 0; i < 200; ++i) {
    const HalfSpaces<Dim> once = shapes::random_planes<Dim>(random, shapes::integer(random, 0, 8), 1);
    HalfSpaces<Dim> planes;
    std::vector<double> weights;
    for (const HalfSpace<Dim>& plane : once)
      for (int m = shapes::integer(random, 1, 9), k = 0; k < m; ++k) {
        planes.push_back(plane);
        weights.push_back(1.0 / m);
      }
    const Vector<Dim> start = 0.5 * shapes::direction<Dim>(random);
    const CentreResult<Dim> found = solve_weighted_centre<Dim>(planes, weights, {start});
    ASSERT_EQ(found.status, CentreStatus::converged);
    const auto expected = oracle::analytic_centre<Dim>(once, oracle::RealVector<Dim>::Zero());
    EXPECT_LT((found.point - expected.template cast<double>()).norm(), 1e-9);
    EXPECT_LT(found.iterations, 25);

    CentralPathRequest<Dim> request{start, 1e-3};
    const CentralPathResult<Dim> path_once = follow_central_path<Dim>(once, request);
    request.weights = weights;
    const CentralPathResult<Dim> path = follow_central_path<Dim>(planes, request);
    ASSERT_EQ(path.status, CentralPathStatus::converged);
    EXPECT_LT((path.point - path_once.point).norm(), 1e-8);
    EXPECT_NEAR(path.bound, path_once.bound, 1e-8);
  }
}
TEST(CoplanarFacets, OfWeightsThatAddUpToOneCountOnce) {
  expect_repeated_planes_to_count_once<2>(79);
  expect_repeated_planes_to_count_once<3>(80);
}

}  // namespace
}  // namespace voussoir::coplanar_facets_test
