// Blocks against exact arithmetic: rows R, V and M of the catalogue of extremes. Tests of the rows:
//   R1 R2 R3  here; the joint that a coincident plane keeps: slicing_test MakeBlock.OfEqualPlanesTheLastOneStays
//   V1 V2 V3  here; also geometry_test Topology, sliver_test, and the robustness atlas down to 1e-12 rad
//   V4  no loop over triples of planes: surfaces are cut from a box, plane by plane
//   M1 M4  here     M2  sliver_test InertiaSurvivesTheDistance, the atlas to 1e12 m
//   M3  bodies have their exact tensors, no spheres replace them
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/slicing/block.hpp"
#include "core/testing/exact_referee.hpp"
#include "core/testing/shapes.hpp"
#include "core/testing/workers.hpp"

namespace voussoir::geometry_catalogue_test {
namespace {

using exact::Quad;
using exact::Rational;
using exact::to_double;
using shapes::integer;
using shapes::power_of_ten;
using shapes::Random;
using shapes::uniform;

constexpr double ulp = std::numeric_limits<double>::epsilon();

// make_block drops a plane that would cut off less than this fraction of the inscribed radius (block.hpp); planes that
// cut off half or twice as much are clearly on one side of it
constexpr double dropped = 1e-10;

// ---- mass -----------------------------------------------------------------------------------------------------------

// the part of a prism of height 1 about z = 0 represents a part of the plane: same area, centroid and moments in x, y
exact::Planes solid_of(const HalfSpaces<3>& planes) {
  return exact::planes_of(planes);
}
exact::Planes solid_of(const HalfSpaces<2>& planes) {
  exact::Planes prism;
  for (const HalfSpace<2>& p : planes)
    prism.push_back({exact::point_of(p.normal), Rational(p.offset)});
  prism.push_back({{0, 0, 1}, Rational(1, 2)});
  prism.push_back({{0, 0, -1}, Rational(1, 2)});
  return prism;
}

struct Allowed {
  double volume, centroid, moment;  // relative; of the radius; of the largest second moment
};
constexpr Allowed thick{1e-13, 1e-13, 1e-12};

// corners are doubles: rounding them moves a sliver's faces by up to 1 ulp of its extent against its thickness
template <int Dim>
Allowed sliver(const Polytope<Dim>& part) {
  const double rounding = ulp * part.radius / part.inscribed_radius;
  return {thick.volume + rounding, thick.centroid + rounding, thick.moment + rounding};
}

// the error in a part's mass properties, or an empty text
template <int Dim>
std::string wrong_mass(const Polytope<Dim>& part, const HalfSpaces<Dim>& planes, const Allowed& allowed) {
  const exact::Solid solid = exact::solid(solid_of(planes));
  const double volume = to_double(Quad(part.mass.volume) / solid.volume - 1);
  if (!(std::abs(volume) <= allowed.volume)) return fmt::format("volume off by {:.3g}", volume);
  double largest = 0, moment = 0;
  for (int i = 0; i < Dim; ++i) {
    const double off = to_double(Quad(part.mass.centroid[i]) - solid.centroid[i]) / part.radius;
    if (!(std::abs(off) <= allowed.centroid)) return fmt::format("centroid off by {:.3g}", off);
    for (int k = 0; k < Dim; ++k) {
      // about the origin, as the part has it
      const Quad expected = solid.second_moment[i][k] + solid.volume * solid.centroid[i] * solid.centroid[k];
      largest = std::max(largest, std::abs(to_double(expected)));
      moment = std::max(moment, std::abs(to_double(Quad(part.mass.second_moment(i, k)) - expected)));
    }
  }
  if (!(moment <= allowed.moment * largest)) return fmt::format("second moment off by {:.3g}", moment / largest);
  return "";
}

// a random solid squeezed along x, turned anyhow
template <int Dim>
HalfSpaces<Dim> squeezed(Random& random, int planes, double thin) {
  HalfSpaces<Dim> list = shapes::random_planes<Dim>(random, planes, 1);
  for (HalfSpace<Dim>& p : list) {
    p.normal[0] /= thin;
    const double length = p.normal.norm();
    p.normal /= length;
    p.offset /= length;
  }
  return shapes::placed<Dim>(list, matrix(shapes::orientation<Dim>(random)), Vector<Dim>::Zero());
}

// M1, M4 and R6's combinatorics, by number: random solids of 4 to 100 planes; every third a sliver
template <int Dim>
std::string wrong_block(std::uint64_t number) {
  Random random(600 + number);
  static constexpr std::array counts{0, 4, 8, 16, 30, 94};
  const int count = counts[number % (number % 50 == 49 ? 6 : 5)];
  const bool thin = number % 3 == 2;
  HalfSpaces<Dim> planes =
      thin ? squeezed<Dim>(random, count, power_of_ten(random, -6, -1)) : shapes::random_planes<Dim>(random, count, 1);
  shapes::shuffle(planes, random);
  const BlockResult<Dim> made = make_block<Dim>(planes, std::vector<int>(planes.size(), no_joint));
  if (made.status != BlockStatus::ok) return "no block";
  // against all planes, also those that make_block found redundant (M4)
  const std::string mass = wrong_mass<Dim>(made.part, planes, thin ? sliver<Dim>(made.part) : thick);
  if (!mass.empty() || thin) return mass;
  const exact::Planes input = solid_of(planes);
  const std::size_t corners = exact::vertices(input).size() / (Dim == 2 ? 2 : 1);
  if (made.part.vertices.size() != corners)
    return fmt::format("{} corners, not {}", made.part.vertices.size(), corners);
  const int facets = exact::solid(input).facets - (Dim == 2 ? 2 : 0);
  if (static_cast<int>(made.part.faces.size()) != facets)
    return fmt::format("{} faces, not {}", made.part.faces.size(), facets);
  return "";
}

template <int Dim>
void expect_blocks(std::uint64_t first, std::uint64_t last) {
  const auto work = [&](int worker, volatile long long& progress) -> std::string {
    for (std::uint64_t number = first + static_cast<std::uint64_t>(worker); number < last; number += 2) {
      progress = static_cast<long long>(number);
      const std::string problem = wrong_block<Dim>(number);
      if (!problem.empty()) return fmt::format("wrong_block<{}>({}): {}\n", Dim, number, problem);
    }
    return "";
  };
  for (const std::string& problem : workers::in_processes(2, work))
    if (!problem.empty()) ADD_FAILURE() << problem;
}

// the region of Eqs 3.1 and 3.2; its corners, in place of Eq. B.1 for all choices of planes, counted in exact
// arithmetic
TEST(BlockCatalogue, RandomBlocksHaveTheirExactMassAndCorners3D) {
  expect_blocks<3>(0, 250);
}
TEST(BlockCatalogue, RandomBlocksHaveTheirExactMassAndCorners2D) {
  expect_blocks<2>(0, 250);
}
TEST(BlockCatalogueLong, AHundredThousandBlocks) {
  expect_blocks<3>(1000, 51'000);
  expect_blocks<2>(1000, 51'000);
}

TEST(BlockCatalogue, ARigidMotionKeepsTheVolume) {
  Random random(601);
  for (int i = 0; i < 40; ++i) {
    const HalfSpaces<3> planes = shapes::random_planes<3>(random, 10, 1);
    const double volume = shapes::block<3>(planes).mass.volume;
    const Polytope<3> moved = shapes::block<3>(
        shapes::placed<3>(planes, matrix(shapes::orientation<3>(random)), shapes::direction<3>(random)));
    EXPECT_NEAR(moved.mass.volume, volume, 1e-13 * volume);
  }
}

// ---- V: corners where more than three planes meet -------------------------------------------------------------------

// The planes' normals were made unit, which may split a corner of many planes by its rounding: corners within 1e-9 of
// the size are one.
std::size_t distinct_corners(const Polytope<3>& part) {
  std::vector<Vector<3>> found;
  for (const Vector<3>& v : part.vertices)
    if (std::none_of(found.begin(), found.end(),
                     [&](const Vector<3>& other) { return (other - v).norm() < 1e-9 * part.radius; }))
      found.push_back(v);
  return found.size();
}

// faces, corners and edges of a part as exact arithmetic counts them on the whole numbers it was made of
void expect_counted(const HalfSpaces<3>& planes, const std::string& what) {
  const BlockResult<3> made = make_block<3>(planes, std::vector<int>(planes.size(), no_joint));
  ASSERT_EQ(made.status, BlockStatus::ok) << what;
  const exact::Planes input = exact::planes_of(planes);
  const std::size_t corners = exact::vertices(input).size();
  const exact::Solid solid = exact::solid(input);
  EXPECT_EQ(distinct_corners(made.part), corners) << what;
  EXPECT_EQ(static_cast<int>(made.part.faces.size()), solid.facets) << what;
  std::size_t edges = 0;
  for (const std::vector<int>& loop : made.part.loops)
    edges += loop.size();
  EXPECT_EQ(made.part.vertices.size() - edges / 2 + made.part.faces.size(), 2u) << what;
  EXPECT_NEAR(to_double(Quad(made.part.mass.volume) / solid.volume), 1, 1e-13) << what;
}

// the apex (0, 0, height) over a polygon whose corners are whole and lie on a circle: all planes whole
HalfSpaces<3> whole_pyramid(const std::vector<std::array<int, 2>>& base, int height) {
  HalfSpaces<3> planes{{{0, 0, -1}, 0}};
  for (std::size_t k = 0; k < base.size(); ++k) {
    const auto [x, y] = base[k];
    const auto [u, v] = base[(k + 1) % base.size()];
    const double nx = v - y, ny = x - u, d = nx * x + ny * y;  // the base's edge, outward
    planes.push_back({{height * nx, height * ny, d}, d * height});
  }
  return planes;
}

TEST(BlockCatalogue, ManyPlanesThroughACornerAreCountedOnce) {
  // 12 and 36 whole points on circles of radius² 25 and 5^2 13^2: Pythagorean triples
  for (const int radius : {5, 65, 325, 1105}) {
    std::vector<std::array<int, 2>> circle;
    for (int x = -radius; x <= radius; ++x)
      for (int y = -radius; y <= radius; ++y)
        if (x * x + y * y == radius * radius) circle.push_back({x, y});
    std::sort(circle.begin(), circle.end(),
              [](const auto& p, const auto& q) { return std::atan2(p[1], p[0]) < std::atan2(q[1], q[0]); });
    expect_counted(whole_pyramid(circle, 2 * radius), fmt::format("pyramid of {} sides", circle.size()));
  }
  // cubes whose corners are cut exactly through the three next ones
  for (int mask = 0; mask < 256; ++mask) {
    HalfSpaces<3> planes = shapes::cube<3>(1);
    for (int corner = 0; corner < 8; ++corner)
      if (mask >> corner & 1)
        planes.push_back({{corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0}, 1});
    // two opposite corners of each face cut: the rest is the octahedron or a smaller solid
    expect_counted(planes, fmt::format("cube without corners {:#x}", mask));
  }
}

// normals and offsets of small whole numbers: planes coincide, touch corners and edges, meet by fours and fives
HalfSpaces<3> whole_planes(Random& random) {
  HalfSpaces<3> planes = shapes::cube<3>(3);
  for (int k = integer(random, 3, 14); k > 0; --k) {
    Vector<3> n;
    do
      n << integer(random, -2, 2), integer(random, -2, 2), integer(random, -2, 2);
    while (n.isZero(0));
    planes.push_back({n, static_cast<double>(integer(random, 2, 6))});
  }
  return planes;
}

TEST(BlockCatalogue, WholeNumbersAreCountedExactly) {
  Random random(602);
  for (int i = 0; i < 400; ++i)
    expect_counted(whole_planes(random), fmt::format("instance {}", i));
}

TEST(BlockCatalogue, NearlyCommonCornersStayNearExactOnes) {
  // V2: the same with offsets moved by 10^-k
  Random random(603);
  for (int i = 0; i < 120; ++i) {
    HalfSpaces<3> planes = i % 4 == 0 ? shapes::platonic_solids(1)[i % 8 ? 2 : 4].planes : whole_planes(random);
    const double moved = std::pow(10.0, -integer(random, 1, 16));
    for (HalfSpace<3>& p : planes) {
      p.offset *= 1 + moved * uniform(random, -1, 1);
      const double length = p.normal.norm();
      p.offset /= length;
      p.normal /= length;
    }
    const Polytope<3> part = shapes::block<3>(planes);
    std::vector<Vector<3>> corners;
    for (const exact::Point& v : exact::vertices(exact::planes_of(planes)))
      corners.emplace_back(v[0].get_d(), v[1].get_d(), v[2].get_d());
    for (const Vector<3>& v : part.vertices) {
      double nearest = 1e300;
      for (const Vector<3>& c : corners)
        nearest = std::min(nearest, (c - v).norm());
      EXPECT_LT(nearest, 1e-9 * part.radius) << "instance " << i << ", moved " << moved;
    }
    const exact::Solid solid = exact::solid(exact::planes_of(planes));
    EXPECT_NEAR(to_double(Quad(part.mass.volume) / solid.volume), 1, 1e-12) << "instance " << i;
  }
}

TEST(BlockCatalogue, CornersOfNearlyParallelPlanesLieOnThem) {
  // V3: two or three planes turned by 10^-k; a corner may be anywhere along them, but on them, and outside none
  Random random(604);
  for (int k = 1; k <= 15; ++k)
    for (int i = 0; i < 12; ++i) {
      HalfSpaces<3> planes = shapes::random_planes<3>(random, 4, 1);
      const HalfSpace<3> seed_plane = planes[integer(random, 0, static_cast<int>(planes.size()) - 1)];
      const Vector<3> pivot = seed_plane.offset * seed_plane.normal + 0.1 * shapes::direction<3>(random);
      for (int copy = 0; copy < 1 + i % 3; ++copy) {
        const Vector<3> n = (seed_plane.normal + std::pow(10.0, -k) * shapes::direction<3>(random)).normalized();
        planes.push_back({n, n.dot(pivot)});
      }
      const BlockResult<3> made = make_block<3>(planes, std::vector<int>(planes.size(), no_joint));
      ASSERT_EQ(made.status, BlockStatus::ok) << "1e-" << k << ", instance " << i;
      const Polytope<3>& part = made.part;
      const double rounding = 64 * ulp * part.radius;
      for (std::size_t f = 0; f < part.faces.size(); ++f) {
        for (const Vector<3>& v : part.vertices)
          EXPECT_LT(signed_distance<3>(part.faces[f], v), rounding) << "1e-" << k << ", instance " << i;
        for (const int v : part.loops[f])
          EXPECT_GT(signed_distance<3>(part.faces[f], part.vertices[v]), -rounding) << "1e-" << k << ", instance " << i;
      }
    }
}

// ---- R: redundant planes --------------------------------------------------------------------------------------------

bool has_face(const Polytope<3>& part, const HalfSpace<3>& plane) {
  return std::any_of(part.faces.begin(), part.faces.end(),
                     [&](const HalfSpace<3>& f) { return f.normal == plane.normal && f.offset == plane.offset; });
}

// the exact depth to which a plane cuts the region that the others enclose within a far box
double cut_depth(const HalfSpaces<3>& planes, std::size_t number) {
  HalfSpaces<3> others = shapes::cube<3>(100);
  for (std::size_t k = 0; k < planes.size(); ++k)
    if (k != number) others.push_back(planes[k]);
  const exact::Plane own = exact::planes_of(HalfSpaces<3>{planes[number]})[0];
  return Rational(exact::support(exact::planes_of(others), own.normal) - own.offset).get_d();
}

// Eq. 3.8
TEST(BlockCatalogue, APlaneIsKeptIfItCutsSomethingOff) {
  // R1, R3: a plane across a corner, an edge or along a face, off it by +-10^-k of the inscribed radius
  Random random(605);
  int stays = 0, goes = 0, close = 0;
  for (int i = 0; i < 220; ++i) {
    const Polytope<3> part = shapes::block<3>(shapes::random_planes<3>(random, 5, 1));
    const std::vector<int>& loop = part.loops[integer(random, 0, static_cast<int>(part.faces.size()) - 1)];
    const std::size_t shared = i % 3 == 0 ? 1 : i % 3 == 1 ? 2 : loop.size();
    Vector<3> n = Vector<3>::Zero();
    for (std::size_t f = 0; f < part.faces.size(); ++f) {
      const auto holds = [&](std::size_t k) {
        return std::find(part.loops[f].begin(), part.loops[f].end(), loop[k]) != part.loops[f].end();
      };
      bool all = true;
      for (std::size_t k = 0; k < shared; ++k)
        all = all && holds(k);
      if (all) n += uniform(random, 0.3, 1) * part.faces[f].normal;
    }
    n.normalize();
    const double off = (i % 2 ? 1 : -1) * std::pow(10.0, -(i / 2 % 17)) * part.inscribed_radius;
    if (off < -0.5 * part.inscribed_radius) continue;
    HalfSpaces<3> planes = part.faces;
    planes.push_back({n, n.dot(part.vertices[loop[0]]) + off});
    const HalfSpaces<3> input = planes;
    shapes::shuffle(planes, random);
    const Polytope<3> made = shapes::block<3>(planes);
    // of two planes along one face, nearer to each other than the limit, the later stays
    const double limit = dropped * made.inscribed_radius, beyond = shared == loop.size() ? 2 * limit : 64 * ulp;
    for (std::size_t k = 0; k < input.size(); ++k) {
      const double depth = cut_depth(input, k);
      if (depth > 2 * limit) {
        EXPECT_TRUE(has_face(made, input[k])) << "instance " << i << ": cuts off " << depth;
        ++stays;
      } else if (depth < -beyond) {
        EXPECT_FALSE(has_face(made, input[k])) << "instance " << i << ": beyond by " << -depth;
        ++goes;
      } else {
        ++close;
      }
    }
    // along a face, one of the two nearly equal planes bounds the block
    if (shared == loop.size()) {
      EXPECT_EQ(made.faces.size(), part.faces.size()) << "instance " << i;
    }
  }
  EXPECT_GT(stays, 1000);
  EXPECT_GT(goes, 50);
  EXPECT_LT(close, 150);
}

TEST(BlockCatalogue, TouchingAndRepeatedPlanesAreDroppedInAnyOrder) {
  // R2, R3, in whole numbers: planes through a corner or an edge, copies, copies in another unit
  Random random(606);
  for (int i = 0; i < 60; ++i) {
    HalfSpaces<3> planes = shapes::cube<3>(2);
    planes.push_back({{1, 1, 1}, 6});
    planes.push_back({{1, -1, 0}, 4});
    planes.push_back({{2, 1, 1}, 8});
    for (int copies = integer(random, 1, 5); copies > 0; --copies) {
      const HalfSpace<3> p = planes[integer(random, 0, static_cast<int>(planes.size()) - 1)];
      const double unit = integer(random, 1, 4);
      planes.push_back({unit * p.normal, unit * p.offset});
    }
    shapes::shuffle(planes, random);
    const Polytope<3> part = shapes::block<3>(planes);
    ASSERT_EQ(part.faces.size(), 6u);
    const Polytope<3> cube = shapes::block<3>(shapes::cube<3>(2));
    for (const HalfSpace<3>& f : cube.faces)
      EXPECT_TRUE(has_face(part, f));
    EXPECT_EQ(part.mass.volume, cube.mass.volume);
    EXPECT_EQ(part.vertices, cube.vertices);
  }
}

}  // namespace
}  // namespace voussoir::geometry_catalogue_test
