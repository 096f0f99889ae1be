// Slicing by planes of small integers, which meet in lines, points and each other, against the same slicing in
// rationals: the same number of cells, each at the referee's place.
#include <gtest/gtest.h>

#include "core/slicing/slice.hpp"
#include "core/testing/exact_referee.hpp"
#include "core/testing/shapes.hpp"

namespace voussoir::exact::exact_slicing_test {
namespace {

using shapes::Random;

// of a cell's size: the unit normals of the planes are rounded to 1e-16, and cells are up to a hundred times as small
constexpr double closeness = 1e-12;

struct Joint {
  int normal[3];
  int offset;
};

Joint random_joint(Random& random) {
  Joint joint{};
  while (joint.normal[0] == 0 && joint.normal[1] == 0 && joint.normal[2] == 0)
    for (int& entry : joint.normal)
      entry = shapes::integer(random, -2, 2);
  joint.offset = shapes::integer(random, -3, 3);
  return joint;
}

Plane exact_plane(const Joint& joint, int sign) {
  return {{sign * joint.normal[0], sign * joint.normal[1], sign * joint.normal[2]}, sign * joint.offset};
}

std::vector<Planes> exact_cells(const HalfSpaces<3>& domain, const std::vector<Joint>& joints) {
  std::vector<Planes> cells{planes_of(domain)};
  for (const Joint& joint : joints) {
    std::vector<Planes> next;
    for (const Planes& cell : cells) {
      if (section_feasibility(cell, exact_plane(joint, 1)).value >= 0) {
        next.push_back(cell);
        continue;
      }
      for (const int sign : {1, -1}) {
        next.push_back(cell);
        next.back().push_back(exact_plane(joint, sign));
      }
    }
    cells = std::move(next);
  }
  return cells;
}

Vector<3> centroid_of(const Solid& solid) {
  return {to_double(solid.centroid[0]), to_double(solid.centroid[1]), to_double(solid.centroid[2])};
}

// Eq. 3.7
TEST(ExactSlicing, CellsOfIntegerPlanesAreTheReferees) {
  Random random(71);
  int cells = 0;
  for (int n = 1; n <= 10; ++n) {
    std::vector<Joint> joints;
    std::vector<Cut<3>> cuts;
    for (int k = 0; k < n; ++k) {
      joints.push_back(random_joint(random));
      const Joint& joint = joints.back();
      const Vector<3> normal(joint.normal[0], joint.normal[1], joint.normal[2]);
      cuts.push_back({{normal / normal.norm(), joint.offset / normal.norm()}, k});
    }
    const HalfSpaces<3> domain = shapes::cube<3>(2);
    const std::vector<Planes> expected = exact_cells(domain, joints);
    SlicingCounters counters;
    const auto blocks = slice<3>(shapes::block<3>(domain), cuts, {}, counters);
    ASSERT_EQ(blocks.size(), expected.size()) << n << " planes";
    EXPECT_EQ(counters.undone, 0);
    cells += static_cast<int>(expected.size());

    std::vector<bool> taken(blocks.size(), false);
    for (const Planes& planes : expected) {
      const Solid cell = solid(planes);
      const Vector<3> centroid = centroid_of(cell);
      std::size_t nearest = 0;
      for (std::size_t b = 0; b < blocks.size(); ++b)
        if ((blocks[b].mass.centroid - centroid).norm() < (blocks[nearest].mass.centroid - centroid).norm())
          nearest = b;
      const Polytope<3>& block = blocks[nearest];
      EXPECT_FALSE(taken[nearest]);
      taken[nearest] = true;
      EXPECT_LE((block.mass.centroid - centroid).norm(), closeness);
      EXPECT_NEAR(block.mass.volume / to_double(cell.volume), 1, closeness);
      EXPECT_EQ(static_cast<int>(block.faces.size()), cell.facets);
      EXPECT_EQ(block.vertices.size(), vertices(planes).size());
    }
  }
  EXPECT_GT(cells, 200);
}

}  // namespace
}  // namespace voussoir::exact::exact_slicing_test
