// Potential particles in scenes: closed forms of equilibrium and motion, also together with blocks of half-spaces, and
// identical bits for any threads, order of input and interruptions.
#include "core/scene/particles.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/contact/particles.hpp"
#include "core/potential/particle.hpp"
#include "core/run/checkpoint.hpp"
#include "core/run/simulate.hpp"
#include "core/scene/scene.hpp"
#include "core/step.hpp"
#include "core/step/neighbours.hpp"
#include "core/testing/counted_allocations.hpp"
#include "core/testing/end_bytes.hpp"
#include "core/testing/potential_pairs.hpp"

namespace voussoir::particles_test {
namespace {

constexpr double g = 9.81, density = 2600, stiffness = 1e7;  // m/s², kg/m³, N/m

template <int Dim>
struct Ran {
  Prepared<Dim> scene;
  Progress<Dim> progress;
};

template <int Dim>
Ran<Dim> whole_run(const std::string& text, const std::vector<std::string>& overrides = {}, int threads = 1) {
  Ran<Dim> run{prepare<Dim>(parse_scene(text, "scene.toml", overrides)), {}};
  run.scene.settings.threads = threads;
  run.progress = initial_progress(run.scene);
  EXPECT_TRUE(simulate(run.scene, run.progress, {}));
  EXPECT_EQ(run.progress.results.outcome, Outcome::done) << run.progress.results.message;
  return run;
}

template <int Dim>
int body_named(const Model<Dim>& model, const std::string& name) {
  return select<Dim>(model, {.names = {name}, .above = {}, .below = {}, .inside = {}}).front();
}

// m: position of the centre of a particle's sphere; its body's centroid differs by the mass properties' error
template <int Dim>
Vector<Dim> place(const Ran<Dim>& run, const std::string& name) {
  const int b = body_named(run.scene.model, name);
  const Body<Dim>& body = run.scene.model.bodies[b];
  const Motion<Dim>& motion = run.progress.state.bodies.motions[b];
  const Polytope<Dim>& part = body.parts.front();
  return run.scene.model.origin + body.reference + motion.displacement +
         matrix(motion.rotation) * (part.centre + part.particle->shape.centre);
}

const std::string properties =
    "joint_properties = [{ name = \"rock\", normal_stiffness = 1e7, shear_stiffness = 5e6, constant_stiffness = true, "
    "friction_deg = 30 }]\n";
const std::string in_space =
    "preset = \"thesis\"\ndimension = 3\ngravity = [0, 0, -9.81]\ndensity = 2600\n" + properties;
const std::string in_the_plane =
    "preset = \"thesis\"\ndimension = 2\ngravity = [0, -9.81]\ndensity = 2600\n" + properties;

// ---- closed forms ---------------------------------------------------------------------------------------------------

// Half-spaces, or a particle whose upper face is flat at k = 0: an overlap of m g / k in both cases. In equilibrium the
// forces balance to 1e-6.
TEST(Particles, ABallInEquilibriumOnAPlaneHasTheOverlapOfItsWeight) {
  const double radius = 0.1, mass = density * 4 / 3 * std::numbers::pi * radius * radius * radius;
  for (const char* floor : {"box = { min = [-1, -1, -0.5], max = [1, 1, 0] }",
                            "shape = \"potential\"\nsphericity = 0\ncorner_radius = 0.1\n"
                            "box = { min = [-1, -1, -0.5], max = [1, 1, -0.1] }"}) {
    const Ran<3> run = whole_run<3>(in_space + "[[blocks]]\nname = \"floor\"\nfixed = true\n" + floor +
                                    "\n[[blocks]]\nname = \"ball\"\nshape = \"potential\"\nsphericity = 1\n"
                                    "sphere_radius = 0.1\ncentre = [0.1, 0.05, 0.1]\n"
                                    "[[stage]]\nname = \"settle\"\nkind = \"settle\"\n");
    EXPECT_NEAR(run.scene.model.bodies[body_named(run.scene.model, "ball")].mass, mass, 1e-12 * mass);
    const Vector<3> at = place(run, "ball");
    EXPECT_NEAR(radius - at[2], mass * g / stiffness, 2e-6 * mass * g / stiffness) << floor;
    EXPECT_NEAR(at[0], 0.1, 1e-12) << floor;
    EXPECT_NEAR(at[1], 0.05, 1e-12) << floor;
  }
}

// The spring of a contact in a stage of kind run with all defaults: the ball starts with zero velocity and half its
// static overlap, so that it stays in contact. Leapfrog's cosine is exact except for its frequency, which is too high
// by (ω dt)² / 24: a phase error of that times ω t, plus the next order.
TEST(Particles, ABallOscillatesOnAPlaneWithThePeriodOfItsSpring) {
  const double radius = 0.1, mass = density * std::numbers::pi * radius * radius, rest = mass * g / stiffness;
  const double period = 2 * std::numbers::pi * std::sqrt(mass / stiffness), omega = 2 * std::numbers::pi / period;
  const std::string text = fmt::format(
      "{}[[blocks]]\nname = \"floor\"\nfixed = true\nbox = {{ min = [-1, -0.5], max = [1, 0] }}\n"
      "[[blocks]]\nname = \"ball\"\nshape = \"potential\"\nsphericity = 1\nsphere_radius = 0.1\n"
      "centre = [0.25, {}]\n[[monitors]]\nname = \"ball\"\nbodies = [\"ball\"]\n"
      "quantities = [\"displacement\"]\n[[stage]]\nname = \"swing\"\nkind = \"run\"\nduration_s = {}\n",
      in_the_plane, radius - rest / 2, 3 * period);
  const Ran<2> run = whole_run<2>(text);
  const History& history = run.progress.results.history;
  const auto column = [&](const char* name) {
    return std::find(history.columns.begin(), history.columns.end(), name) - history.columns.begin();
  };
  const auto time = column("time_s"), moved = column("ball_displacement_y_m");
  ASSERT_LT(moved, static_cast<long>(history.columns.size()));
  ASSERT_GT(history.rows.size(), 50u);
  const double step = history.rows.back()[time] / static_cast<double>(run.progress.state.counters.steps);
  const double phase = omega * 3 * period * omega * omega * step * step / 24;
  for (const std::vector<double>& row : history.rows)
    EXPECT_NEAR(row[moved], -rest / 2 * (1 - std::cos(omega * row[time])), 1.2 * phase * rest / 2) << row[time];
}

// A cube of small r: along its axis f = (1 - k) s² / r² + k (a + s)² / R² - 1, so that it ends at a + s. It is flat on
// half-spaces, whose inner particle has the same faces for any r.
TEST(Particles, ACubeSettlesOnABlockOfHalfSpacesToItsOverlap) {
  constexpr double a = 0.099, r = 0.001, k = 0.02, sphere = 0.2;
  const double c = (1 - k) / (r * r), s = k / (sphere * sphere);
  const double end = (-s * a + std::sqrt(s * s * a * a + (c + s) * (1 - s * a * a))) / (c + s);
  for (const char* radius : {"0.005", "0.02", "0.1"}) {
    const Ran<3> run =
        whole_run<3>(in_space + "[contact]\npotential_radius = " + radius +
                     "\n[[blocks]]\nname = \"floor\"\nfixed = true\nbox = { min = [-1, -1, -0.5], max = [1, 1, 0] }\n"
                     "[[blocks]]\nname = \"cube\"\nshape = \"potential\"\nsphericity = 0.02\ncorner_radius = 0.001\n"
                     "sphere_radius = 0.2\nbox = { min = [-0.099, -0.099, 0.001], max = [0.099, 0.099, 0.199] }\n"
                     "[[stage]]\nname = \"settle\"\nkind = \"settle\"\n");
    const int cube = body_named(run.scene.model, "cube");
    const double overlap = run.scene.model.bodies[cube].mass * g / stiffness;
    EXPECT_NEAR(a + end - place(run, "cube")[2], overlap, 2e-6 * overlap) << radius;
    // a cube of the same width, less its rounded edges
    const double width = 2 * (a + r);
    EXPECT_NEAR(run.scene.model.bodies[cube].mass, density * width * width * width,
                1e-3 * density * width * width * width);
  }
}

// Newton's method finds the same equilibrium: its stiffness comes from differences of the contact force.
TEST(Particles, NewtonFindsTheEquilibriumOfAStack) {
  std::string text =
      in_space + "[[blocks]]\nname = \"floor\"\nfixed = true\nbox = { min = [-1, -1, -0.5], max = [1, 1, 0] }\n";
  for (int i = 0; i < 3; ++i)
    text += fmt::format(
        "[[blocks]]\nname = \"cube{}\"\nshape = \"potential\"\nsphericity = 0.02\ncorner_radius = 0.01\n"
        "box = {{ min = [{}, -0.09, {}], max = [{}, 0.09, {}] }}\n",
        i, -0.09 + 0.01 * i, 0.2 * i + 0.01, 0.09 + 0.01 * i, 0.2 * i + 0.19);
  text += "[[stage]]\nname = \"settle\"\nkind = \"settle\"\n";
  const Ran<3> relaxed = whole_run<3>(text), by_newton = whole_run<3>(text, {"statics=\"newton\""});
  EXPECT_GT(by_newton.progress.state.counters.static_iterations, 0);
  EXPECT_EQ(by_newton.progress.state.counters.static_fallbacks, 0);
  for (const char* name : {"cube0", "cube1", "cube2"})
    EXPECT_NEAR(place(relaxed, name)[2], place(by_newton, name)[2], 1e-8) << name;
}

// ---- other data of a part with a particle --------------------------------------------------------------------------

// an edge at right angles recedes by (1 - sqrt(1/2)) r / sin 45°, a face not at all
TEST(Particles, AnInnerParticleHasTheFacesOfItsPart) {
  const Polytope<2> part = shapes::block<2>(shapes::box<2>({-1, -0.5}, {3, 0.5}));
  const Particle<2> inner = inner_particle<2>(part, 0.1);
  const double r = 0.1 * 0.5;
  EXPECT_DOUBLE_EQ(inner.shape.corner_radius, r);
  const PlacedPotential<2> own = placed<2>(inner.shape);
  for (const double x : {-0.9, 0.0, 2.9})
    EXPECT_NEAR(value<2>(own, Vector<2>(x, 0.5) - part.centre), 0, 1e-13);
  const double recedes = (1 - std::sqrt(0.5)) * r / std::sin(std::numbers::pi / 4);
  const Vector<2> corner = Vector<2>(3, 0.5) - part.centre, inwards = Vector<2>(-1, -1).normalized();
  EXPECT_NEAR(value<2>(own, corner + recedes * inwards), 0, 1e-13);
}

template <int Dim>
Polytope<Dim> part_of(const std::string& keys) {
  const Scene scene = parse_scene("dimension = " + std::to_string(Dim) +
                                      "\ndensity = 1\n[[blocks]]\nname = \"it\"\nshape = \"potential\"\n" + keys +
                                      "[[stage]]\nname = \"rest\"\nkind = \"settle\"\n",
                                  "scene.toml");
  Prepared<Dim> prepared = prepare<Dim>(scene);
  return prepared.model.bodies.front().parts.front();
}

// One part is moved towards the other by the distance that was found free, along the line of centres and along others:
// they do not touch; between spheres it is the full distance.
template <int Dim>
void expect_free_way(const Polytope<Dim>& a, const Polytope<Dim>& b, const Vector<Dim>& offset, bool exact) {
  Pair<Dim> pair{&a, &b, Matrix<Dim>::Identity(), Matrix<Dim>::Identity(), offset, QueryLevel::overlap};
  const auto find = [&] {
    Contact<Dim> contact;
    Contact<Dim>* slot = &contact;
    KernelCounters counters;
    narrow_phase_with_particles<Dim>({&pair, 1}, {}, {}, {&slot, 1}, counters);
    return contact;
  };
  const Contact<Dim> apart = find();
  ASSERT_EQ(apart.status, ContactStatus::separated);
  const double way = apart.proof.margin;
  ASSERT_GT(way, 0);
  shapes::Random random(7);
  for (int i = 0; i < 100; ++i) {
    Vector<Dim> direction = i == 0 ? Vector<Dim>(-offset.normalized()) : Vector<Dim>(shapes::direction<Dim>(random));
    pair.offset = offset + way * direction;
    EXPECT_NE(find().status, ContactStatus::touching);
  }
  if (!exact) return;
  // the rounding error of f, about 64 ulp per part, is subtracted
  EXPECT_NEAR(way, offset.norm() - a.particle->shape.sphere_radius - b.particle->shape.sphere_radius, 1e-13);
}

TEST(Particles, HaveADistanceOverWhichTheyStayApart) {
  const Polytope<3> ball = part_of<3>("sphericity = 1\nsphere_radius = 1\ncentre = [0, 0, 0]\n");
  const Polytope<3> cube =
      part_of<3>("sphericity = 0.1\ncorner_radius = 0.1\nbox = { min = [-1, -1, -1], max = [1, 1, 1] }\n");
  expect_free_way<3>(ball, ball, Vector<3>(2, 1, 0.5), true);
  expect_free_way<3>(ball, cube, Vector<3>(2.2, 0.3, 0.1), false);
  expect_free_way<3>(cube, cube, Vector<3>(2.3, 1, -0.2), false);
  const Polytope<2> square =
      part_of<2>("sphericity = 0.01\ncorner_radius = 0.01\nbox = { min = [-1, -1], max = [1, 1] }\n");
  expect_free_way<2>(square, square, Vector<2>(2.1, 0.4), false);
}

// no point of the body is farther along any direction than the drawing's points plus its error
template <int Dim>
void expect_drawn(const Polytope<Dim>& part) {
  const PotentialDrawing<Dim>& drawing = part.particle->drawing;
  const PlacedPotential<Dim> own = placed<Dim>(part.particle->shape);
  const double size = part.particle->shape.sphere_radius;
  EXPECT_LE(drawing.error, 0.05 * size);
  for (const Vector<Dim>& p : drawing.points)
    EXPECT_NEAR(std::sqrt(1 + value<Dim>(own, p)), 1, 1e-11);
  shapes::Random random(11);
  RayScratch scratch;
  for (int i = 0; i < 300; ++i) {
    const Vector<Dim> direction = shapes::direction<Dim>(random);
    double reached = -size;
    for (const Vector<Dim>& p : drawing.points)
      reached = std::max(reached, direction.dot(p));
    const double whole = direction.dot(find_support<Dim>(own, direction, scratch).point);
    EXPECT_LE(reached, whole + 1e-9 * size);
    EXPECT_LE(whole - reached, drawing.error);
  }
}

TEST(Particles, AreDrawnWithinTheStatedError) {
  expect_drawn<3>(part_of<3>("sphericity = 1\nsphere_radius = 1\ncentre = [0, 0, 0]\n"));
  expect_drawn<3>(
      part_of<3>("sphericity = 0.02\ncorner_radius = 0.05\nbox = { min = [-1, -1, -1], max = [1, 2, 1] }\n"));
  expect_drawn<3>(part_of<3>(
      "sphericity = 0.1\ncorner_radius = 0.2\nplanes = [{ normal = [1, 1, 1], offset = 1 }, { normal = [1, "
      "-1, -1], offset = 1 }, { normal = [-1, 1, -1], offset = 1 }, { normal = [-1, -1, 1], offset = 1 }]\n"));
  expect_drawn<2>(part_of<2>("sphericity = 0.5\ncorner_radius = 0.2\nbox = { min = [-1, -1], max = [1, 1] }\n"));
  expect_drawn<2>(part_of<2>("sphericity = 0\ncorner_radius = 0.001\nbox = { min = [-1, -1], max = [1, 1] }\n"));
}

// ---- the same bits --------------------------------------------------------------------------------------------------

// a ball, cubes, a tetrahedron and a block of half-spaces fall onto one another and onto a floor
std::string heap(bool reversed = false) {
  std::vector<std::string> blocks{
      "name = \"floor\"\nfixed = true\nbox = { min = [-1, -1, -0.5], max = [1, 1, 0] }\n",
      "name = \"ball\"\nshape = \"potential\"\nsphericity = 1\nsphere_radius = 0.1\ncentre = [0.02, 0, 0.11]\n",
      "name = \"block\"\nbox = { min = [0.11, -0.1, 0.001], max = [0.31, 0.1, 0.2] }\nvelocity = [-0.2, 0, 0]\n",
      "name = \"cube\"\nshape = \"potential\"\nsphericity = 0.05\ncorner_radius = 0.02\n"
      "box = { min = [0, -0.05, 0.24], max = [0.16, 0.11, 0.38] }\n",
      "name = \"pyramid\"\nshape = \"potential\"\nsphericity = 0.1\ncorner_radius = 0.03\n"
      "planes = [{ normal = [1, 1, 1], offset = 0.66 }, { normal = [1, -1, -1], offset = -0.44 }, "
      "{ normal = [-1, 1, -1], offset = -0.44 }, { normal = [-1, -1, 1], offset = 0.54 }]\nvelocity = [0, 0.1, "
      "-0.5]\n"};
  if (reversed) std::reverse(blocks.begin(), blocks.end());
  std::string text = in_space;
  for (const std::string& block : blocks)
    text += "[[blocks]]\n" + block;
  return text + "[[stage]]\nname = \"fall\"\nkind = \"run\"\nduration_s = 0.2\n";
}

// the complete final state, except the clock
TEST(Particles, KeepTheirBitsOverThreadsOrderAndInterruptions) {
  const Ran<3> run = whole_run<3>(heap());
  const Counters& counters = run.progress.state.counters;
  EXPECT_GT(counters.motion_skips, 0);
  EXPECT_GT(counters.contact_evaluations, 500);
  EXPECT_EQ(counters.unconverged, 0);
  const std::string expected = end_of(run.progress);
  EXPECT_TRUE(end_of(whole_run<3>(heap(), {}, 3).progress) == expected);
  EXPECT_TRUE(end_of(whole_run<3>(heap(true)).progress) == expected);

  Progress<3> progress = initial_progress(run.scene);
  const std::string hash = "fnv1a64:0123456789abcdef";
  int interruptions = 0;
  for (long long k = 37;; k += 37) {
    Watcher<3> watcher;
    watcher.pause = [k](const Progress<3>& p) { return p.state.counters.steps >= k; };
    if (simulate(run.scene, progress, watcher)) break;
    progress = read_checkpoint<3>(checkpoint_bytes(progress, hash), hash);
    ++interruptions;
  }
  EXPECT_GT(interruptions, 5);
  EXPECT_TRUE(end_of(progress) == expected);
}

TEST(Particles, AllocateNoMemoryWhileTheirNeighboursStay) {
  Prepared<3> scene = prepare<3>(parse_scene(heap(), "scene.toml", {"contact.skin=20"}));
  for (int i = 0; i < 400; ++i)
    step(scene.model, scene.settings, scene.state);
  const long long builds = scene.state.counters.neighbour_builds, made = allocations;
  for (int i = 0; i < 200; ++i)
    step(scene.model, scene.settings, scene.state);
  const long long asked = allocations - made;
  if (!allocations_are_counted) GTEST_SKIP() << "this build counts no allocations";
  EXPECT_EQ(asked, 0);
  EXPECT_EQ(scene.state.counters.neighbour_builds, builds);
}

// a wider skin lists more neighbours and changes nothing
TEST(Particles, MoveTheSameForAnySkin) {
  const Ran<3> one = whole_run<3>(heap()), other = whole_run<3>(heap(), {"contact.skin=0.7"});
  for (std::size_t b = 0; b < one.progress.state.bodies.motions.size(); ++b)
    EXPECT_TRUE(one.progress.state.bodies.motions[b].displacement ==
                other.progress.state.bodies.motions[b].displacement)
        << b;
}

}  // namespace
}  // namespace voussoir::particles_test
