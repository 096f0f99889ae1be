// Three readings of the contact: with the link f_A = f_B, without it, and Eq. A.10 as printed. Their effect on point
// and force.
#include <gtest/gtest.h>

#include <fmt/format.h>

#ifdef VOUSSOIR_HAS_IPOPT
#include "core/potential/ipopt.hpp"
#endif
#include "core/potential/contact.hpp"
#include "core/potential/surface.hpp"
#include "core/testing/potential_pairs.hpp"
#include "reference/potential_particles/contact.hpp"
#include "verification/case_report.hpp"

namespace voussoir::cases::readings_test {
namespace {

using verification::CaseReport;
using verification::Kind;

// Two bodies whose contact is on the z axis: `gap` is the distance between the zeros of the first one's and the second
// one's f + 1, and both grow as (t / length)².
struct Example {
  std::string name;
  PotentialShape<3> a, b;
  Matrix<3> rotation;
  double from;  // m: z at which the first one's f + 1 vanishes
  double to;    // m: from the second one's origin down to the zero of its f + 1
  double length_a, length_b, gap;
  PotentialPair<3> pair() const { return {&a, &b, rotation, {0, 0, from + gap + to}}; }
};

Example spheres(double a, double b, double distance) {
  return {fmt::format("spheres of {:g} and {:g} m", a, b),
          {{}, 1, 1, a, Vector<3>::Zero()},
          {{}, 1, 1, b, Vector<3>::Zero()},
          Matrix<3>::Identity(),
          0,
          0,
          a,
          b,
          distance};
}

Example corner_on_face(double r_a, double r_b, double depth) {
  const Matrix<3> corner_down = matrix(rotation_onto(Vector<3>(1, 1, 1), Vector<3>(0, 0, -1)));
  return {fmt::format("corner, r = {:g} m, on a face, r = {:g} m", r_b, r_a),
          {shapes::box<3>({-2, -2, -1}, {2, 2, 0}), r_a, 0, 10, {0, 0, -0.5}},
          {shapes::cube<3>(0.5), r_b, 0, 10, Vector<3>::Zero()},
          corner_down,
          0,
          std::sqrt(0.75),
          r_a,
          r_b,
          r_a + r_b - depth};
}

// the bracketed overlap through a point by the rule of the method; 0 if the point is not inside both
double overlap_through(const Example& example, double height) {
  const double a = height / example.length_a, b = (example.gap - height) / example.length_b;
  if (!(a < 1 && b < 1)) return 0;
  return example.length_a + example.length_b - example.gap;
}

// λ = 1/2: the least f_A + f_B, by our own descent
double least_sum(const Example& example) {
  PlacedPotential<3> a, b;
  place<3>(example.a, a);
  place<3>(example.b, example.rotation, example.pair().offset, b);
  RayScratch scratch;
  const Vector<3> start(0, 0, example.from + example.gap / 2);
  return find_least_point<3>({{&a, &b}, {0.5, 0.5}}, start, scratch).point[2] - example.from;
}

TEST(PotentialParticles, ReadingsOfEquationA10) {
  CaseReport report("potential_particles");
  PotentialWorkspace<3> workspace;
  for (const Example& example : {spheres(2, 1, 2.9), spheres(1, 1, 1.9), corner_on_face(0.1, 0.02, 0.015),
                                 corner_on_face(0.1, 0.02, 0.018), corner_on_face(0.1, 0.1, 0.01)}) {
    const double a = example.length_a, b = example.length_b, depth = a + b - example.gap;
    const std::string name = fmt::format("{}, overlapping by {:g} m: ", example.name, depth);
    const double size = 3, rounding = 64 * std::numeric_limits<double>::epsilon() * size;
    const auto place_is = [&](const std::string& what, double expected, double tolerance, const std::string& because,
                              double computed) {
      report.record({name + what,
                     "m",
                     Kind::exact,
                     "readings of Eqs A.3 and A.10: closed form on the axis",
                     expected,
                     {tolerance, 0},
                     because},
                    computed);
    };
    const PotentialContact<3> found = resolve<3>(example.pair(), PotentialQuery::overlap, workspace);
    const double linked = reference::touching_features(a, b, example.gap).from_first;
    const double squares = reference::unlinked_squares(a, b, example.gap);
    place_is("point with the link", linked, rounding, "rounding of coordinates", found.point[2] - example.from);
    place_is("point without it, least f_A + f_B", squares, rounding, "rounding of coordinates", least_sum(example));
    place_is("overlap with the link", depth, rounding, "rounding of coordinates", found.overlap);
    report.report(name + "overlap without it", "m", overlap_through(example, squares),
                  "0: the point is outside one of them, so that no contact is detected");
#ifdef VOUSSOIR_HAS_IPOPT
    const auto ipopt = [&](ConeReading reading) {
      return solve_cone_program<3>(example.pair(), reading).point[2] - example.from;
    };
    const std::string measure = "Ipopt's error measure is brought below 1e-12";
    place_is("point with the link, Ipopt", linked, 1e-9 * size, measure, ipopt(ConeReading::linked));
    place_is("point without it, Ipopt", squares, 1e-9 * size, measure, ipopt(ConeReading::unlinked_squares));
    // for equal lengths every point between is optimal
    if (a != b)
      place_is("point of A.10 as printed, Ipopt", reference::unlinked_spheres(a, b, example.gap), 1e-4,
               "the second cone has its apex there, and Ipopt approaches it as the root of its measure",
               ipopt(ConeReading::unlinked));
#endif
  }
}

// Any shapes: of pairs that touch, the share that the least f_A + f_B misses, and the error of its point.
TEST(PotentialParticles, WithoutTheLinkContactsAreMissed) {
  CaseReport report("potential_particles");
  shapes::Random random(28);
  PotentialWorkspace<3> workspace;
  int touching = 0, missed = 0;
  std::vector<double> off;
  for (int i = 0; i < 2000; ++i) {
    const shapes::PotentialCase<3> c = shapes::random_potential_case<3>(random, 0.01);
    const PotentialContact<3> found = resolve<3>(c.pair(), PotentialQuery::overlap, workspace);
    if (found.status != PotentialStatus::touching) continue;
    ++touching;
    const LeastPoint<3> least =
        find_least_point<3>({{&workspace.a, &workspace.b}, {0.5, 0.5}}, found.point, workspace.ray);
    const double f = std::max(value<3>(workspace.a, least.point), value<3>(workspace.b, least.point));
    EXPECT_GE(f, found.value - 2 * found.rounding) << i;  // no point has a lower maximum than the linked one's
    missed += f >= 0;
    off.push_back((least.point - found.point).norm() / (c.a.corner_radius + c.b.corner_radius));
  }
  std::nth_element(off.begin(), off.begin() + off.size() / 2, off.end());
  report.report("without the link: random contacts that are not seen", "-", static_cast<double>(missed) / touching,
                "r 1e-4 to 0.5 of the size, overlaps 1e-9 to 1e-1");
  report.report("without the link: distance of the points over r_A + r_B, median", "-", off[off.size() / 2],
                "of the contacts detected and missed");
}

}  // namespace
}  // namespace voussoir::cases::readings_test
