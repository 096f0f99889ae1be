// Potential particles: contact point, normal and overlap of two; and their convergence to the sharp bodies.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/contact/contact_between.hpp"
#ifdef VOUSSOIR_HAS_IPOPT
#include "core/potential/ipopt.hpp"
#endif
#include "core/potential/valid_shape.hpp"
#include "core/testing/shapes.hpp"
#include "reference/potential_particles/contact.hpp"
#include "verification/case_report.hpp"

namespace voussoir::cases::potential_particles_test {
namespace {

using verification::CaseReport;
using verification::Kind;

constexpr double ulp = std::numeric_limits<double>::epsilon();
constexpr double half = 0.5;   // m, half edge of the cubes
constexpr double share = 2.0;  // depth of the sharp bodies over r

PotentialShape<3> sphere(double radius) {
  return {{}, 1, 1, radius, Vector<3>::Zero()};
}

// the rounded body shares the faces of the sharp cube at k = 0: its planes are r inside
PotentialShape<3> rounded_cube(double r, double k) {
  PotentialShape<3> shape{shapes::cube<3>(half - r), r, k};
  shape.sphere_radius = enclosing_radius<3>(shape.planes, r, Vector<3>::Zero());
  return shape;
}

TEST(PotentialParticles, Spheres) {
  CaseReport report("potential_particles", {"spheres: contact point", "spheres: overlap", "spheres: normal"});
  const PotentialShape<3> a = sphere(2), b = sphere(1);
  const Vector<3> normal = Vector<3>(2, -1, 2) / 3;
  const double distance = 2.9, size = 3;
  const PotentialPair<3> pair{&a, &b, Matrix<3>::Identity(), distance * normal};
  const reference::PotentialContactForm form = reference::touching_spheres(2, 1, distance);
  PotentialWorkspace<3> workspace;
  const PotentialContact<3> found = resolve<3>(pair, PotentialQuery::overlap, workspace);
  const std::string because = "8 ulp of the size, R_A + R_B: coordinates and their differences round by that";
  report.record({"spheres: contact point",
                 "m",
                 Kind::exact,
                 "Eq. A.3: D_A / R_A = D_B / R_B",
                 form.from_first,
                 {8 * ulp * size, 0},
                 because},
                found.point.dot(normal));
  report.record(
      {"spheres: overlap", "m", Kind::exact, "Eq. A.3: R_A + R_B - D", form.overlap, {8 * ulp * size, 0}, because},
      found.overlap);
  report.record({"spheres: normal",
                 "-",
                 Kind::exact,
                 "geometry: the line of centres",
                 0,
                 {8 * ulp * size, 0},
                 "gradients rotate by the rounding error of the point over the smaller radius of 1 m"},
                (found.normal - normal).norm());
#ifdef VOUSSOIR_HAS_IPOPT
  const ConeAnswer<3> linked = solve_cone_program<3>(pair, ConeReading::linked);
  const ConeAnswer<3> unlinked = solve_cone_program<3>(pair, ConeReading::unlinked);
  report.record({"spheres: contact point by Ipopt, with the link",
                 "m",
                 Kind::exact,
                 "Eq. A.3: D_A / R_A = D_B / R_B",
                 form.from_first,
                 {1e-9 * size, 0},
                 "Ipopt's error measure is brought below 1e-12"},
                linked.point.dot(normal));
  report.record({"spheres: point by Ipopt, without the link",
                 "m",
                 Kind::exact,
                 "Eq. A.10: D_A / R_A + D_B / R_B is least at the smaller sphere's centre",
                 reference::unlinked_spheres(2, 1, distance),
                 {1e-4, 0},
                 "the program's second cone has its apex there, and Ipopt approaches it as the root of its measure"},
                unlinked.point.dot(normal));
#endif
}

struct Approach {
  std::vector<double> point, overlap, normal;  // deviation from the sharp bodies, over r
};

// One cube below, another above it: corner on face, or edge across edge.
struct Stack {
  Matrix<3> lower = Matrix<3>::Identity(), upper;
  double top, reach;  // m: height of the lower one's highest point, and downward extent of the upper one

  explicit Stack(bool edges)
      : upper(turn(edges ? Vector<3>(0, 1, 1) : Vector<3>(1, 1, 1))),
        top(edges ? half * std::sqrt(2.0) : half),
        reach(half * std::sqrt(edges ? 2.0 : 3.0)) {
    if (edges) lower = turn({-1, 0, -1});
  }
  static Matrix<3> turn(const Vector<3>& down) { return matrix(rotation_onto(down, Vector<3>(0, 0, -1))); }
  Vector<3> above(double depth) const { return {0.1, 0.05, top + reach - depth}; }
};

// Sharp bodies would overlap by `share` r. The sharp contact point is midway, its normal is vertical.
Approach approach(bool edges, double k, const std::vector<double>& radii) {
  const Stack stack(edges);
  Approach result;
  PotentialWorkspace<3> workspace;
  for (const double r : radii) {
    const PotentialShape<3> cube = rounded_cube(r, k);
    const double depth = share * r;
    const Matrix<3> back = stack.lower.transpose();
    const PotentialPair<3> pair{&cube, &cube, back * stack.upper, back * stack.above(depth)};
    const PotentialContact<3> found = resolve<3>(pair, PotentialQuery::overlap, workspace);
    EXPECT_EQ(found.status, PotentialStatus::touching);
    result.point.push_back(((stack.lower * found.point)[2] - (stack.top - depth / 2)) / r);
    result.overlap.push_back((depth - found.overlap) / r);
    const Vector<3> normal = stack.lower * found.normal;
    result.normal.push_back(std::hypot(normal[0], normal[1]) / r);
  }
  return result;
}

// k = 0.1: all three in proportion to r, with the factors of rounded_features and tilt
void expect_mixed(CaseReport& report, const std::string& name, bool edges, const std::vector<double>& radii) {
  const double k = 0.1, sphere = half * half * 3, along_a = edges ? 0.05 : std::hypot(0.1, 0.05),
               along_b = edges ? 0.1 : 0;
  const double lower = edges ? 2 : 1, upper = edges ? 2 : 3;  // faces of the features
  const reference::RoundedForm form = reference::rounded_features(k, (lower * half * half + along_a * along_a) / sphere,
                                                                  (upper * half * half + along_b * along_b) / sphere,
                                                                  std::sqrt(lower) + std::sqrt(upper) - share);
  const double tilted = std::hypot(reference::tilt(k, along_a, std::sqrt(sphere), form.from_first),
                                   reference::tilt(k, along_b, std::sqrt(sphere), form.from_second));
  const Approach mixed = approach(edges, k, radii);
  const std::string because =
      "terms beyond the first are of order r/R, some 1e-4 at r = 1e-4 m, with factors of some units";
  const auto expect = [&](const std::string& what, const std::vector<double>& computed, double expected) {
    report.record({name + ", k = 0.1: " + what + " over r, r/size 1e-4",
                   what == "tilt of the normal" ? "1/m" : "-",
                   Kind::limit,
                   "Eq. A.2: first order in r, closed form",
                   expected,
                   {5e-4, 0},
                   because},
                  computed[3]);
    report.record({name + ", k = 0.1: order of what is then left, " + what,
                   "-",
                   Kind::limit,
                   "convergence: second order in r",
                   2,
                   {0.1, 0},
                   "the next term is smaller by r/R, 1e-2 at the larger radius, with a factor of some units"},
                  1 + std::log10(std::abs(computed[1] - expected) / std::abs(computed[2] - expected)));
  };
  expect("overlap lacking", mixed.overlap, share - form.overlap);
  expect("height of the point off", mixed.point, form.from_first - std::sqrt(lower) + share / 2);
  expect("tilt of the normal", mixed.normal, tilted);
}

TEST(PotentialParticles, ApproachSharpBodiesInProportionToTheRadius) {
  CaseReport report("potential_particles");
  const std::vector<double> radii{1e-1, 1e-2, 1e-3, 1e-4};
  for (const bool edges : {false, true}) {
    const std::string name = edges ? "edge across edge" : "corner on face";
    // recess of the two features from the sharp ones, which the overlap lacks; the point is off by half of their
    // difference
    const double lower = reference::recess(edges ? 2 : 1, 1), upper = reference::recess(edges ? 2 : 3, 1);
    const Approach exact = approach(edges, 0, radii);
    for (std::size_t i = 0; i < radii.size(); ++i) {
      const double rounding = 16 * ulp / radii[i];
      const std::string at = fmt::format(", r/size {:g}", radii[i]);
      report.record({name + ", k = 0: overlap lacking over r" + at,
                     "-",
                     Kind::exact,
                     "closed form: recess of both features",
                     lower + upper,
                     {rounding, 0},
                     "rounding of coordinates of 1 m, over r"},
                    exact.overlap[i]);
      report.record({name + ", k = 0: height of the point off, over r" + at,
                     "-",
                     Kind::exact,
                     "closed form: half the difference of the recesses",
                     (upper - lower) / 2,
                     {rounding, 0},
                     "rounding of coordinates of 1 m, over r"},
                    exact.point[i]);
    }
    expect_mixed(report, name, edges, radii);
  }

  // beside it, the half-space kernel on the sharp bodies
  const Polytope<3> cube = shapes::centred_block<3>(shapes::cube<3>(half));
  for (const bool edges : {false, true})
    for (const double depth : {2e-3, 2e-4}) {
      const Stack stack(edges);
      const ContactBetween<3> sharp =
          contact_between<3>(cube, {Vector<3>::Zero(), stack.lower}, cube, {stack.above(depth), stack.upper});
      const std::string name =
          fmt::format("{}, half-space kernel, depth {:g} m: ", edges ? "edge across edge" : "corner on face", depth);
      report.report(name + "overlap lacking over depth", "-", 1 - sharp.geometry.overlap / depth,
                    "the centre depends on all planes, so that it is off the corner's axis by the square of the depth, "
                    "and the line through it leaves by a face beside the corner");
      report.report(name + "height of the point off over depth", "-",
                    (sharp.origin[2] + sharp.geometry.point[2] - (stack.top - depth / 2)) / depth,
                    "from the middle of the overlap");
      report.report(name + "tilt of the normal", "-", std::hypot(sharp.geometry.normal[0], sharp.geometry.normal[1]),
                    "the mean of two gradients of inner potentials");
    }
}

}  // namespace
}  // namespace voussoir::cases::potential_particles_test
