// The conservative overlap of potential particles in a scene (contact.normal = "multipliers"): the forces, moments and
// energy that a step finds have a potential. With the published overlap they have none.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/scene/scene.hpp"
#include "core/step.hpp"

namespace voussoir::particles_energy_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

constexpr double corner_radius = 0.1;          // m, of both bodies
constexpr double depth = 0.1 * corner_radius;  // of the overlap, about
constexpr double size = 1, stiffness = 1e7;    // m, N/m

// A tilted corner with an edge that is not right-angled, above a fixed floor: a particle, or a block of half-spaces.
// Without friction a contact has only its normal force.
template <int Dim>
std::string scene_of(const char* normal, bool half_spaces) {
  Matrix<Dim> turn;
  std::vector<Vector<Dim>> normals;
  std::string gravity, low, high;
  if constexpr (Dim == 3) {
    turn = matrix(rotation_onto(Vector<3>(1, 1.2, 0.9), Vector<3>(0, 0, -1)));
    normals = {{0.8, 0.6, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    gravity = "[0, 0, 0]", low = "[-2, -2, -1]", high = "[2, 2, 0]";
  } else {
    turn = matrix(turned(Rotation<2>(), Spin<2>(-std::numbers::pi / 2 - std::atan2(1.2, 1.0))));
    normals = {{0.8, 0.6}, {-1, 0}, {0, 1}, {0, -1}};
    gravity = "[0, 0]", low = "[-2, -1]", high = "[2, 0]";
  }
  const std::string particle =
      fmt::format("shape = \"potential\"\nsphericity = 0.1\ncorner_radius = {}\n", corner_radius);
  std::string text = fmt::format(
      "dimension = {}\ngravity = {}\ndensity = 2600\ncontact = {{ normal = \"{}\" }}\n"
      "joint_properties = [{{ name = \"smooth\", normal_stiffness = {}, shear_stiffness = {}, friction_deg = 0, "
      "constant_stiffness = true }}]\n"
      "[[blocks]]\nname = \"floor\"\nfixed = true\n{}box = {{ min = {}, max = {} }}\n"
      "[[blocks]]\nname = \"driven\"\n{}planes = [",
      Dim, gravity, normal, stiffness, stiffness, half_spaces ? "" : particle, low, high, particle);
  for (const Vector<Dim>& n : normals) {
    const Vector<Dim> a = turn * n;
    text += "{ normal = [";
    for (int k = 0; k < Dim; ++k)
      text += fmt::format("{}{:.17g}", k > 0 ? ", " : "", a[k]);
    text += fmt::format("], offset = {:.17g} }}, ", size / 2 + 2 * a[Dim - 1]);  // about 2 m above the floor
  }
  return text + "]\n[[stage]]\nname = \"drive\"\nkind = \"run\"\nduration_s = 1\n";
}

// The body, placed by a test with zero velocity, and the forces of a step there.
template <int Dim>
class Driven {
 public:
  Driven(const char* normal, bool half_spaces)
      : scene_(prepare<Dim>(parse_scene(scene_of<Dim>(normal, half_spaces), "scene.toml", {}))),
        body_(scene_.model.bodies.front().fixed ? 1 : 0) {
    double touching = -3, apart = 0;  // m, downwards from its position in the scene
    for (int i = 0; i < 60; ++i) {
      const double middle = (touching + apart) / 2;
      put(Vector<Dim>::Unit(Dim - 1) * middle, Spin<Dim>::Zero());
      (energy() > 0 ? touching : apart) = middle;
    }
    down_ = touching - depth;
  }

  // from the position with its corner `depth` in the floor: moved, then turned about its centroid
  void put_near(const Vector<Dim>& moved, const Spin<Dim>& turn) {
    put(down_ * Vector<Dim>::Unit(Dim - 1) + moved, turn);
  }
  const Load<Dim>& load() const { return scene_.state.loads.total[body_]; }
  double energy() const { return scene_.state.ledger.energy.elastic; }

 private:
  void put(const Vector<Dim>& displacement, const Spin<Dim>& turn) {
    scene_.state.bodies.motions[body_].displacement = displacement;
    scene_.state.bodies.motions[body_].rotation = turned(Rotation<Dim>(), turn);
    find_forces(scene_.model, scene_.settings, scene_.state);
    EXPECT_EQ(scene_.state.counters.unconverged, 0);
  }

  Prepared<Dim> scene_;
  int body_;
  double down_ = 0;
};

template <int Dim>
Spin<Dim> spin_of(double x, double y, double z) {
  if constexpr (Dim == 3)
    return {x, y, z};
  else
    return Spin<2>(x);
}
template <int Dim>
Vector<Dim> vector_of(double x, double y, double z) {
  if constexpr (Dim == 3)
    return {x, y, z};
  else
    return {x, z};
}

// Central differences over all degrees of freedom. The energy is k δ²/2 of an overlap that varies over lengths of r:
// the error from the third derivative is (h/r)² of the force, and for the moment an arm of 1 m times that. δ has the
// rounding error of coordinates of a few metres, which the difference divides by 2 h.
template <int Dim>
void expect_the_slope_of_the_energy(bool half_spaces) {
  constexpr double h = 1e-5 * corner_radius;
  Driven<Dim> driven("multipliers", half_spaces);
  const Vector<Dim> moved = vector_of<Dim>(0.01, 0.02, -0.002) * corner_radius;
  const Spin<Dim> turn = spin_of<Dim>(0.01, -0.02, 0.01);
  driven.put_near(moved, turn);
  const Load<Dim> load = driven.load();
  ASSERT_GT(load.force.norm(), 0.1 * stiffness * depth);
  const double allowed = load.force.norm() * (h * h / (corner_radius * corner_radius) + 32 * epsilon * size / (2 * h));
  const auto energy_at = [&](int freedom, double by) {
    if (freedom < Dim) {
      driven.put_near(moved + by * Vector<Dim>::Unit(freedom), turn);
    } else {
      const Spin<Dim> more = by * Spin<Dim>::Unit(freedom - Dim);
      driven.put_near(moved, rotation_vector(turned(turned(Rotation<Dim>(), turn), more)));
    }
    return driven.energy();
  };
  for (int k = 0; k < freedoms<Dim>; ++k) {
    const double slope = -(energy_at(k, h) - energy_at(k, -h)) / (2 * h);
    EXPECT_NEAR(slope, k < Dim ? load.force[k] : load.moment[k - Dim], allowed) << Dim << "-D, freedom " << k;
  }
}

TEST(ParticlesEnergy, ForceAndMomentAreTheGradientOfTheSpringEnergy) {
  for (const bool half_spaces : {false, true}) {
    expect_the_slope_of_the_energy<2>(half_spaces);
    expect_the_slope_of_the_energy<3>(half_spaces);
  }
}

struct Work {
  double net = 0, gross = 0;  // J
};

// Once around an ellipse of positions with an oscillating rotation about one axis of the same period. The same planes
// are active along the whole path, so that equal steps around the smooth closed path integrate its work to rounding.
template <int Dim>
Work around(const char* normal, bool half_spaces) {
  constexpr int steps = 200;
  Driven<Dim> driven(normal, half_spaces);
  const Vector<Dim> to = vector_of<Dim>(0.02, 0, 0.03) * corner_radius,
                    across = vector_of<Dim>(0.03, 0.01, 0) * corner_radius;
  const Spin<Dim> turn = spin_of<Dim>(0.02, 0.05, 0.01);
  Work work;
  for (int i = 0; i < steps; ++i) {
    const double part = 2 * std::numbers::pi / steps, sine = std::sin(i * part), cosine = std::cos(i * part);
    driven.put_near(cosine * to + sine * across, sine * turn);
    const Load<Dim>& load = driven.load();
    const double rate = load.force.dot(cosine * across - sine * to) + load.moment.dot(cosine * turn);
    EXPECT_GT(load.force.norm(), 0.1 * stiffness * depth);
    work.net += part * rate;
    work.gross += part * std::abs(rate);
  }
  return work;
}

TEST(ParticlesEnergy, ADrivenPairDoesNoWorkAroundAClosedPath) {
  for (const bool half_spaces : {false, true}) {
    const Work plane = around<2>("multipliers", half_spaces), space = around<3>("multipliers", half_spaces);
    // rounding of coordinates of 1 m over an overlap of 1e-2 m, 2e-14 of each term
    EXPECT_LE(std::abs(plane.net), 1e-12 * plane.gross);
    EXPECT_LE(std::abs(space.net), 1e-12 * space.gross);
    EXPECT_GE(std::abs(around<3>("potential", half_spaces).net), 1e-3 * space.gross);
  }
}

}  // namespace
}  // namespace voussoir::particles_energy_test
