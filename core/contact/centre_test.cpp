// The contact point against the fully converged analytic centre (113 bits, exact planes): rows A1-A6 of the catalogue
// of extremes. A2, closed forms: here for A1's aspects, else solvers/centre_test
// (AnalyticCentre.OfASimplexIsItsCentroid, OfABoxIsItsMiddleHoweverThin).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "core/testing/contacts.hpp"
#include "core/testing/exact_contacts.hpp"

namespace voussoir::centre_test {
namespace {

using contacts::Outcome;
using exact::Quad;
using exact::to_double;
using shapes::integer;
using shapes::Random;
using shapes::uniform;

constexpr double ulp = std::numeric_limits<double>::epsilon();

// ---- A1: depth by aspect by offset ----------------------------------------------------------------------------------

// the accuracy of a stop rule: the point, as a fraction of the region in every direction; overlap and area, relative
struct Level {
  double newton_tolerance, point, value;
};
constexpr Level timed{1e-3, 1e-4, 1e-6}, reference{1e-9, 1e-9, 1e-9};

// Rounded poses and slacks leave this fraction of a region as thin as the overlap uncertain, in every direction, since
// a normal turned by 1 ulp moves the centre along a patch by ulp/overlap of the patch.
double left_open(double size, double overlap) {
  return 16 * ulp * size / overlap;
}

struct Cell {
  double depth, aspect, distance;  // of edges of 1 m; of the patch; m from the origin
};

template <int Dim>
struct CubePair {
  Polytope<Dim> a, b;
  Matrix<Dim> rotation;
  Vector<Dim> offset;
};

// Two turned cubes, face on face to the depth, shifted until they share a strip of 1/aspect, tilted as far as the strip
// permits; far from the origin, references subtracted first.
template <int Dim>
CubePair<Dim> overlapping_cubes(const Cell& cell, Random& random) {
  const Matrix<Dim> axes_a = matrix(shapes::orientation<Dim>(random)),
                    axes_b = matrix(shapes::orientation<Dim>(random));
  CubePair<Dim> cubes;
  cubes.a = shapes::block<Dim>(shapes::placed<Dim>(shapes::cube<Dim>(0.5), axes_a, Vector<Dim>::Zero()));
  cubes.b = shapes::block<Dim>(shapes::placed<Dim>(shapes::cube<Dim>(0.5), axes_b, Vector<Dim>::Zero()));
  Matrix<Dim> tilt;
  Vector<Dim> shift;
  const double flat = 0.1 * std::min(cell.depth, 1 / cell.aspect) * uniform(random, -1, 1);
  if constexpr (Dim == 3) {
    const double spin = 0.1 / cell.aspect * uniform(random, -1, 1);
    tilt = (Eigen::AngleAxisd(flat, shapes::direction<3>(random)) * Eigen::AngleAxisd(spin, Vector<3>::UnitZ()))
               .toRotationMatrix();
    shift << uniform(random, -0.6, 0.6), 1 - 1 / cell.aspect + (cell.aspect == 1 ? uniform(random, 0, 0.6) : 0),
        1 - cell.depth;
  } else {
    tilt = matrix(Rotation<2>{flat});
    shift << 1 - std::max(1 / cell.aspect, 10 * cell.depth), 1 - cell.depth;
  }
  const Vector<Dim> reference_a = cell.distance * shapes::direction<Dim>(random);
  const Vector<Dim> reference_b = reference_a + shift, between = reference_b - reference_a;
  const Vector<Dim> relative = between + (shift - between);
  cubes.rotation = axes_a * tilt * axes_b.transpose();
  cubes.offset = axes_a * relative;
  return cubes;
}

struct Worst {
  double point = 0, value = 0;  // of the accuracy
};

template <int Dim>
void expect_converged(const CubePair<Dim>& cubes, const Outcome<Dim>& found, const Level& level, Worst& worst) {
  ASSERT_EQ(found.contact.status, ContactStatus::touching);
  const ContactGeometry<Dim>& g = found.contact.geometry;
  const Pair<Dim> pair{&cubes.a, &cubes.b, Matrix<Dim>::Identity(), cubes.rotation, cubes.offset};
  const ContactSettings settings;
  const double radius = settings.potential_radius * std::min(cubes.a.inscribed_radius, cubes.b.inscribed_radius);
  auto best = exact::converged_contact(exact::planes_of(pair), static_cast<int>(cubes.a.faces.size()),
                                       static_cast<int>(cubes.b.faces.size()), exact::point_of(g.point), radius);
  ASSERT_TRUE(best) << "the point is outside";
  if constexpr (Dim == 2) best->section.area /= 2 * exact::lid_height(pair);

  const double size = cubes.a.radius + cubes.b.radius, overlap = to_double(best->overlap);
  ASSERT_GT(overlap, 0);
  const double open = left_open(size, overlap);
  const double off = to_double(best->distance) / (level.point + open);
  const double thick = std::abs(to_double(best->overlap - g.overlap)) / (level.value * overlap + 64 * ulp * size);
  const double area = to_double(best->section.area);
  const double wide = std::abs(g.area - area) / ((level.value + open) * area + 64 * ulp * size * (Dim == 3 ? 1 : 0));
  EXPECT_LE(off, 1) << "the point is off by " << to_double(best->distance) << " of the region";
  EXPECT_LE(thick, 1) << "overlap " << g.overlap << ", converged " << overlap;
  EXPECT_LE(wide, 1) << "area " << g.area << ", converged " << area;
  worst.point = std::max(worst.point, off);
  worst.value = std::max({worst.value, thick, wide});
}

// cold, then warm after a move of a hundredth of the overlap: the start must not matter (A6)
template <int Dim>
void expect_cell(const Cell& cell, Random& random, Worst& worst) {
  const CubePair<Dim> here = overlapping_cubes<Dim>(cell, random);
  CubePair<Dim> there = here;
  there.offset += 0.01 * std::min(cell.depth, 1 / cell.aspect) * shapes::direction<Dim>(random);
  for (const Level& level : {timed, reference}) {
    const ContactSettings settings{.newton_tolerance = level.newton_tolerance};
    const Outcome<Dim> cold = contacts::touch<Dim>(here.a, here.b, here.rotation, here.offset, settings);
    expect_converged<Dim>(here, cold, level, worst);
    const Outcome<Dim> warm =
        contacts::touch<Dim>(there.a, there.b, there.rotation, there.offset, settings, cold.contact);
    expect_converged<Dim>(there, warm, level, worst);
  }
}

template <int Dim>
void expect_grid(std::uint64_t seed, int instances) {
  Worst worst;
  for (int depth = -12; depth <= -1; ++depth)
    for (int aspect = 0; aspect <= (Dim == 3 ? 6 : 0); ++aspect)
      for (const double distance : {0.0, 1e3, 1e6})
        for (int i = 0; i < instances; ++i) {
          const Cell cell{std::pow(10.0, depth), std::pow(10.0, aspect), distance};
          SCOPED_TRACE(
              fmt::format("{}-D, depth 1e{}, aspect 1e{}, distance {}, instance {}", Dim, depth, aspect, distance, i));
          Random random(seed + 1000u * static_cast<unsigned>(i) + static_cast<unsigned>(-depth * 10 + aspect));
          expect_cell<Dim>(cell, random, worst);
          if (testing::Test::HasFailure()) return;  // the first cell that fails is enough
        }
  testing::Test::RecordProperty(fmt::format("worst_share_of_point_{}d", Dim), fmt::format("{:.3g}", worst.point));
  testing::Test::RecordProperty(fmt::format("worst_share_of_value_{}d", Dim), fmt::format("{:.3g}", worst.value));
}

// Eq. 3.28
TEST(Centre, IsTheConvergedOneOverDepthAspectAndDistance3D) {
  expect_grid<3>(401, 2);
}
TEST(Centre, IsTheConvergedOneOverDepthAspectAndDistance2D) {
  expect_grid<2>(402, 8);
}
TEST(CentreLong, DenseGrid) {
  expect_grid<3>(403, 200);
  expect_grid<2>(404, 1000);
}

// ---- A2, A3: closed forms -------------------------------------------------------------------------------------------

TEST(Centre, CopiesOfAPlaneCountByTheirNumber) {
  // max (k+1) log(1 - x) + log(1 + x): x = -k/(k + 2); a plane as far as 10 shifts it less, and never in the other
  // direction
  double last_near = 1, last_far = 1;
  for (const int copies : {0, 1, 2, 3, 10, 100, 1000}) {
    HalfSpaces<3> near = shapes::cube<3>(1), far = near;
    for (int k = 0; k < copies; ++k) {
      near.push_back({Vector<3>::UnitX(), 1});
      far.push_back({Vector<3>::UnitX(), 10});
    }
    const CentreResult<3> r = solve_analytic_centre<3>(near, {Vector<3>(0.1, 0.2, -0.3), 1e-9}),
                          s = solve_analytic_centre<3>(far, {Vector<3>(0.1, 0.2, -0.3), 1e-9});
    ASSERT_EQ(r.status, CentreStatus::converged);
    ASSERT_EQ(s.status, CentreStatus::converged);
    EXPECT_NEAR(r.point[0], -copies / (copies + 2.0), 1e-13);
    EXPECT_LT(r.point.tail<2>().norm(), 1e-13);
    const double x = s.point[0];
    EXPECT_NEAR(1 / (1 + x) - 1 / (1 - x) - copies / (10 - x), 0, 1e-10 * (1 + copies));
    EXPECT_LT(r.point[0], last_near);
    EXPECT_LT(x, last_far);
    last_near = r.point[0];
    last_far = x;
  }
}

// ---- A4: starts next to the boundary --------------------------------------------------------------------------------

TEST(Centre, IsFoundFromNextToTheBoundary) {
  Random random(405);
  for (const double thin : {1.0, 1e-4, 1e-9})
    for (int k = 3; k <= 15; ++k) {
      const Matrix<3> axes = matrix(shapes::orientation<3>(random));
      const HalfSpaces<3> planes =
          shapes::placed<3>(shapes::box<3>({-1, -1, -thin}, {1, 1, thin}), axes, Vector<3>::Zero());
      // near a face, an edge, a corner: 10^-k of the half width away from it, as far as the coordinates' rounding
      // permits
      const double fraction = std::pow(10.0, -k);
      for (int kind = 1; kind <= 3; ++kind) {
        Vector<3> start(kind > 2 ? 1 - fraction : 0.3, kind > 1 ? -1 + fraction : 0.2, thin * (1 - fraction));
        start = axes * start;
        const bool inside = std::all_of(planes.begin(), planes.end(),
                                        [&](const HalfSpace<3>& p) { return signed_distance<3>(p, start) < 0; });
        const CentreResult<3> r = solve_analytic_centre<3>(planes, {start, 1e-9});
        if (!inside) {
          EXPECT_EQ(r.status, CentreStatus::start_not_interior);
          continue;
        }
        ASSERT_EQ(r.status, CentreStatus::converged) << "thin " << thin << ", 1e-" << k << ", kind " << kind;
        const Vector<3> own = axes.transpose() * r.point;
        EXPECT_LT(own.head<2>().norm(), 1e-10 + left_open(2, thin));
        EXPECT_LT(std::abs(own[2]), 1e-10 * thin + 16 * ulp);
      }
    }
}

// ---- A5: continuity -------------------------------------------------------------------------------------------------

// A cube turns from a corner to an edge to a face on another one at equal depth; warm from step to step.
struct Jumps {
  double point = 0, normal = 0, overlap = 0, area = 0;
};

Jumps largest_jumps(int steps) {
  constexpr double depth = 1e-2;
  const Polytope<3> lower = shapes::block<3>(shapes::cube<3>(1)), upper = contacts::unit_cube<3>();
  Jumps jumps;
  Contact<3> last;
  for (int i = 0; i <= steps; ++i) {
    // first one tilt passes through 0, then the other
    const double way = 2.0 * i / steps;
    const double first = 0.2 * std::max(0.0, 1 - way), second = 0.15 * std::min(1.0, 2 - way);
    const Matrix<3> turn =
        (Eigen::AngleAxisd(first, Vector<3>::UnitX()) * Eigen::AngleAxisd(second, Vector<3>::UnitY()))
            .toRotationMatrix();
    Vector<3> offset(0.1, 0.05, 0);
    offset[2] = 1 - depth - contacts::lowest_corner<3>(upper, turn)[2];
    const Contact<3> now = contacts::touch<3>(lower, upper, turn, offset, {.newton_tolerance = 1e-9}, last).contact;
    EXPECT_TRUE(now.touching());
    if (i > 0) {
      const ContactGeometry<3>&g = now.geometry, &h = last.geometry;
      jumps.point = std::max(jumps.point, (g.point - h.point).norm());
      jumps.normal = std::max(jumps.normal, (g.normal - h.normal).norm());
      jumps.overlap = std::max(jumps.overlap, std::abs(g.overlap - h.overlap));
      jumps.area = std::max(jumps.area, std::abs(g.area - h.area));
    }
    last = now;
  }
  return jumps;
}

// a jump would stay the same at any size of the steps; the changes of a continuous function with a slope halve with
// them
void expect_no_jump(int steps) {
  const Jumps coarse = largest_jumps(steps), fine = largest_jumps(2 * steps);
  constexpr double halved = 0.55;
  EXPECT_LT(fine.point, halved * coarse.point);
  EXPECT_LT(fine.normal, halved * coarse.normal + 1e-12);
  EXPECT_LT(fine.overlap, halved * coarse.overlap + 1e-14);
  EXPECT_LT(fine.area, halved * coarse.area);
}

TEST(Centre, MovesWithoutAJumpFromCornerToEdgeToFace) {
  expect_no_jump(2000);
}
TEST(CentreLong, MovesWithoutAJumpInAHundredThousandSteps) {
  expect_no_jump(100'000);
}

}  // namespace
}  // namespace voussoir::centre_test
