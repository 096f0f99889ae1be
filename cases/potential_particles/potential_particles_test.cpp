// Potential particles: where two touch, which way and how far; and how they approach the sharp bodies.
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

namespace voussoir::cases {
namespace {

using verification::CaseReport;
using verification::Kind;

constexpr double ulp = std::numeric_limits<double>::epsilon();
constexpr double half = 0.5;   // m, half edge of the cubes
constexpr double share = 2.0;  // depth of the sharp bodies over r

PotentialShape<3> sphere(double radius) {
  return {{}, 1, 1, radius, Vector<3>::Zero()};
}

// the rounded body shares the faces of the sharp cube at k = 0: its planes lie r inside
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
                 "D_A / R_A = D_B / R_B",
                 form.from_first,
                 {8 * ulp * size, 0},
                 because},
                found.point.dot(normal));
  report.record({"spheres: overlap", "m", Kind::exact, "R_A + R_B - D", form.overlap, {8 * ulp * size, 0}, because},
                found.overlap);
  report.record({"spheres: normal",
                 "-",
                 Kind::exact,
                 "the line of centres",
                 0,
                 {8 * ulp * size, 0},
                 "gradients turn by what rounding moves the point, over the smaller radius of 1 m"},
                (found.normal - normal).norm());
#ifdef VOUSSOIR_HAS_IPOPT
  const ConeAnswer<3> linked = solve_cone_program<3>(pair, ConeReading::linked);
  const ConeAnswer<3> unlinked = solve_cone_program<3>(pair, ConeReading::unlinked);
  report.record({"spheres: contact point by Ipopt, with the link",
                 "m",
                 Kind::exact,
                 "D_A / R_A = D_B / R_B",
                 form.from_first,
                 {1e-9 * size, 0},
                 "Ipopt's error measure is brought below 1e-12"},
                linked.point.dot(normal));
  report.record({"spheres: point by Ipopt, without the link",
                 "m",
                 Kind::exact,
                 "D_A / R_A + D_B / R_B is least at the smaller sphere's centre",
                 reference::unlinked_spheres(2, 1, distance),
                 {1e-4, 0},
                 "the program's second cone has its tip there, and Ipopt comes near it as the root of its measure"},
                unlinked.point.dot(normal));
#endif
}

struct Approach {
  std::vector<double> point, overlap, normal;  // off the sharp bodies', over r
};

// One cube below, another above it that sharp bodies would push `share` r into the first: corner on face, or edge
// across edge. The sharp contact point lies midway, its normal is vertical.
Approach approach(bool edges, double k, const std::vector<double>& radii) {
  const auto turn = [](const Vector<3>& from) {
    return Eigen::Quaterniond::FromTwoVectors(from, Vector<3>(0, 0, -1)).toRotationMatrix();
  };
  const Matrix<3> upper_turn = edges ? Matrix<3>(turn({0, 1, 1})) : Matrix<3>(turn({1, 1, 1}));
  const Matrix<3> lower_turn = edges ? Matrix<3>(turn({-1, 0, -1})) : Matrix<3>(Matrix<3>::Identity());
  const double top = edges ? half * std::sqrt(2.0) : half, reach = half * std::sqrt(edges ? 2.0 : 3.0);
  Approach result;
  PotentialWorkspace<3> workspace;
  for (const double r : radii) {
    const PotentialShape<3> cube = rounded_cube(r, k);
    const double depth = share * r;
    const Vector<3> upper(0.1, 0.05, top + reach - depth);
    const PotentialPair<3> pair{&cube, &cube, lower_turn.transpose() * upper_turn, lower_turn.transpose() * upper};
    const PotentialContact<3> found = resolve<3>(pair, PotentialQuery::overlap, workspace);
    EXPECT_EQ(found.status, PotentialStatus::touching);
    result.point.push_back(((lower_turn * found.point)[2] - (top - depth / 2)) / r);
    result.overlap.push_back((depth - found.overlap) / r);
    const Vector<3> normal = lower_turn * found.normal;
    result.normal.push_back(std::hypot(normal[0], normal[1]) / r);
  }
  return result;
}

TEST(PotentialParticles, ApproachSharpBodiesInProportionToTheRadius) {
  CaseReport report("potential_particles");
  const std::vector<double> radii{1e-1, 1e-2, 1e-3, 1e-4};
  for (const bool edges : {false, true}) {
    const std::string name = edges ? "edge across edge" : "corner on face";
    // what the two features lie inside the sharp ones, and so what the overlap lacks; the point is off by half of their
    // difference
    const double lower = reference::recess(edges ? 2 : 1, 1), upper = reference::recess(edges ? 2 : 3, 1);
    const Approach exact = approach(edges, 0, radii);
    for (std::size_t i = 0; i < radii.size(); ++i) {
      const double rounding = 16 * ulp / radii[i];
      const std::string at = fmt::format(", r/size {:g}", radii[i]);
      report.record({name + ", k = 0: overlap lacking over r" + at,
                     "-",
                     Kind::exact,
                     "recess of both features",
                     lower + upper,
                     {rounding, 0},
                     "rounding of coordinates of 1 m, over r"},
                    exact.overlap[i]);
      report.record({name + ", k = 0: height of the point off, over r" + at,
                     "-",
                     Kind::exact,
                     "half the difference of the recesses",
                     (upper - lower) / 2,
                     {rounding, 0},
                     "rounding of coordinates of 1 m, over r"},
                    exact.point[i]);
    }
    const Approach mixed = approach(edges, 0.1, radii);
    const auto order = [&](const std::vector<double>& over_r) { return 1 + std::log10(over_r[2] / over_r[3]); };
    const std::string because =
        "every term beyond the first is of order r/R: 1e-3 at the larger radius, with a factor of some units; a decade "
        "turns a relative change of 1e-2 into 0.005 of the order";
    report.record({name + ", k = 0.1: order of the overlap's approach",
                   "-",
                   Kind::limit,
                   "first order in r",
                   1,
                   {0.005, 0},
                   because},
                  order(mixed.overlap));
    report.report(name + ", k = 0.1: overlap lacking over r", "-", mixed.overlap.back(), "r/size 1e-4");
    report.report(name + ", k = 0.1: tilt of the normal over r", "1/m", mixed.normal.back(), "r/size 1e-4");
  }

  // beside it, the half-space kernel on the sharp bodies
  const Polytope<3> cube = shapes::centred_block<3>(shapes::cube<3>(half));
  const Matrix<3> corner_down =
      Eigen::Quaterniond::FromTwoVectors(Vector<3>(1, 1, 1), Vector<3>(0, 0, -1)).toRotationMatrix();
  for (const double depth : {2e-3, 2e-4}) {
    const Vector<3> above(0.1, 0.05, half * (1 + std::sqrt(3.0)) - depth);
    const ContactBetween<3> sharp = contact_between<3>(cube, {}, cube, {above, corner_down});
    report.report(
        fmt::format("corner on face, half-space kernel: overlap lacking over depth, depth {:g} m", depth), "-",
        1 - sharp.geometry.overlap / depth,
        "the centre answers to all planes, so that it lies off the corner's axis by the square of the depth, and "
        "the line through it leaves by a face beside the corner");
  }
}

}  // namespace
}  // namespace voussoir::cases
