// Published wedges from their planes: geometry, factors dry and filled. README.md names the sources.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "core/key_blocks/verdict.hpp"
#include "core/slicing/block.hpp"
#include "core/testing/stated_block.hpp"

namespace voussoir::published_wedges_test {
namespace {

constexpr double foot = 0.3048, psf = 47.88025898, pcf = 157.087463863;  // m, Pa, N/m³
const Vector<3> down(0, 0, -9.81);

struct Orientation {
  double dip, direction;  // deg
  Vector<3> up() const { return above(dip, direction); }
};

struct Strength {
  double friction, cohesion;  // deg, Pa
};

struct Wedge {
  Orientation a, b, face, upper;
  std::optional<Orientation> crack{};
  double crest = 0;        // m, height above the toe of the line of intersection
  double line_height = 0;  // m, instead: vertical extent of that line
  double to_crack = 0;     // m, from the crest along the trace of a

  // the planes of a, b, face, upper slope and crack, outward; the toe of the line is the origin
  HalfSpaces<3> planes() const {
    const Vector<3> na = a.up(), nb = b.up(), nf = face.up(), nu = upper.up();
    Vector<3> edge = na.cross(nf), line = na.cross(nb);
    edge /= edge[2];
    line /= line[2];
    const double height = crest > 0 ? crest : line_height * nu.dot(line) / nu.dot(edge);
    const Vector<3> top = height * edge;
    HalfSpaces<3> planes{{-na, 0}, {-nb, 0}, {nf, 0}, {nu, nu.dot(top)}};
    if (crack) {
      Vector<3> trace = na.cross(nu).normalized();
      if (trace.dot(nf) > 0) trace = -trace;
      const Vector<3> nc = crack->up();
      planes.push_back({-nc, -nc.dot(top + to_crack * trace)});
    }
    return planes;
  }
};

// with one mean pressure on the faces on rock
struct Solved {
  double volume = 0;
  std::vector<double> areas;  // in the order of the planes
  double factor = 0;
  Vector<3> motion = Vector<3>::Zero();
};

Solved solve(const Wedge& wedge, double unit_weight, double pressure, const Strength& a, const Strength& b) {
  const HalfSpaces<3> planes = wedge.planes();
  const BlockResult<3> made = make_block<3>(planes, {0, 1, 2, 3, 4});
  EXPECT_EQ(made.status, BlockStatus::ok);
  Solved solved;
  solved.volume = made.part.mass.volume;
  solved.areas.assign(planes.size(), 0);
  for (std::size_t f = 0; f < made.part.faces.size(); ++f)
    solved.areas[made.part.joints[f]] = face_area(made.part, static_cast<int>(f));
  std::vector<StatedFace> faces{{Vector<3>(-planes[0].normal), solved.areas[0], a.friction, a.cohesion},
                                {Vector<3>(-planes[1].normal), solved.areas[1], b.friction, b.cohesion}};
  if (wedge.crack) faces.push_back({Vector<3>(-planes[4].normal), solved.areas[4], 0, 0});
  Block<3> block = block_of(faces, unit_weight * solved.volume);
  for (const StatedFace& face : faces)
    block.water.force += pressure * face.area * face.normal;
  const Verdict<3> verdict = judge(block, load_without_bolts(block), down);
  solved.motion = verdict.motion;
  solved.factor = verdict.factor().value_or(0);
  return solved;
}

const Wedge hoek_and_bray{{45, 105}, {70, 235}, {65, 185}, {12, 195}, {}, 100 * foot};

// Hoek & Bray (1981), comprehensive solution, in SI
TEST(PublishedWedges, HoekAndBrayWithItsTensionCrack) {
  Wedge wedge = hoek_and_bray;
  wedge.crack = Orientation{70, 165};
  wedge.to_crack = 40 * foot;
  const Strength a{20, 500 * psf}, b{30, 1000 * psf};
  const Solved dry = solve(wedge, 160 * pcf, 0, a, b);
  EXPECT_NEAR(dry.volume, 5003.621380, 1e-5);
  EXPECT_NEAR(dry.areas[0], 517.006146, 1e-5);
  EXPECT_NEAR(dry.areas[1], 597.192391, 1e-5);
  EXPECT_NEAR(dry.areas[4], 171.549044, 1e-5);
  EXPECT_NEAR(dry.factor, 1.735576747, 1e-9);
  EXPECT_NEAR(solve(wedge, 160 * pcf, 1084.266440 * psf, a, b).factor, 1.137822923, 1e-9);
}

// the same planes without the crack; the last two rows also in the tests of lythoskinematic
TEST(PublishedWedges, HoekAndBrayWithoutTheCrack) {
  Wedge wedge = hoek_and_bray;
  wedge.crest = 0;
  wedge.line_height = 40;
  const Strength a{30, 24e3}, b{20, 48e3};
  EXPECT_NEAR(solve(wedge, 25e3, 0, a, b).factor, 1.972061933, 1e-9);
  EXPECT_NEAR(solve(wedge, 25e3, 9.81e3 * 40 / 6, a, b).factor, 1.341940362, 1e-9);
  wedge.line_height = 0;
  wedge.crest = 40;
  const Strength equal{35, 0};
  EXPECT_NEAR(solve(wedge, 25e3, 0, equal, equal).factor, 1.7407205230520555, 1e-12);
  const double whole_height = 51.999226982;
  EXPECT_NEAR(solve(wedge, 25e3, 9.81e3 * whole_height / 6, equal, equal).factor, 0.8024581439219097, 1e-9);
}

// Low (1997), closed form of two joints
TEST(PublishedWedges, LowsTetrahedralWedge) {
  struct Row {
    double beta_1, beta_2, delta_1, delta_2, face, upper;  // deg
    Strength first, second;
    double height, unit_weight, water, factor;
  };
  for (const Row& row : {
           Row{62, 20, 50, 48, 70, 0, {30, 41.6e3}, {30, 41.6e3}, 16, 26e3, 0.5, 1.426837242035},
           Row{62, 20, 50, 48, 70, 0, {30, 41.6e3}, {30, 41.6e3}, 16, 26e3, 0, 1.803490600211},
           Row{45, 35, 55, 60, 68, 0, {32, 20e3}, {28, 15e3}, 25, 25.5e3, 0, 0.973924065449},
           Row{45, 35, 55, 60, 68, 12, {32, 20e3}, {28, 15e3}, 25, 25.5e3, 0, 0.973924065449},
           Row{45, 35, 55, 60, 68, 12, {32, 20e3}, {28, 15e3}, 25, 25.5e3, 0.3, 0.655122076478},
       }) {
    const Wedge wedge{{row.delta_1, 180 - row.beta_1},
                      {row.delta_2, 180 + row.beta_2},
                      {row.face, 180},
                      {row.upper, 180},
                      {},
                      row.height};
    const double pressure = row.water * 9.81e3 * row.height / 3;
    EXPECT_NEAR(solve(wedge, row.unit_weight, pressure, row.first, row.second).factor, row.factor, 2e-9);
  }
}

// Harrison & Hudson (2000), chapter 19: five planes and a level roof
TEST(PublishedWedges, RoofBlocksOfHarrisonAndHudson) {
  const std::array<Orientation, 5> sets{{{54, 58}, {70, 195}, {81, 127}, {32, 160}, {64, 335}}};
  std::string falling, on_one, on_two;
  for (int i = 0; i < 5; ++i)
    for (int j = i + 1; j < 5; ++j)
      for (int k = j + 1; k < 5; ++k)
        for (int code = 0; code < 8; ++code) {
          const std::array<int, 3> planes{i, j, k};
          std::vector<StatedFace> faces;
          std::vector<Vector<3>> normals;
          for (int s = 0; s < 3; ++s) {
            normals.push_back((code >> s & 1 ? -1 : 1) * sets[planes[s]].up());
            faces.push_back({normals.back()});
          }
          std::vector<Vector<3>> into_rock = normals;
          into_rock.emplace_back(0, 0, 1);
          if (!find_removability(normals).removable || find_removability(into_rock).removable) continue;
          const Block<3> block = block_of(faces, 1);
          const Verdict<3> verdict = judge(block, block.stated.force, down);
          std::string& list = verdict.kind == BlockKind::falls ? falling : verdict.loaded == 1 ? on_one : on_two;
          for (const int plane : planes)
            list += static_cast<char>('1' + plane);
          list += ' ';
        }
  EXPECT_EQ(falling, "125 145 235 345 ");  // published
  EXPECT_EQ(on_two, "124 135 234 ");       // published: 124 and 135 slide along a line
  EXPECT_EQ(on_one, "123 134 245 ");
}

// Wyllie & Mah: plane failure with a crack in the plane, 3 m of water: H 12 m, face 60, plane 35, c 25 kPa, friction 37
TEST(PublishedWedges, PlaneFailureInTheSection) {
  const Vector<2> plane(std::sin(35 * degree), std::cos(35 * degree)), crack(1, 0);
  const auto factor = [&](double uplift, double thrust, double cohesion) {
    Block<2> block;
    const double friction = std::tan(37 * degree);
    block.faces = {{plane, 0, 0, 13.337368, friction, cohesion * 13.337368, Vector<2>::Zero()},
                   {crack, 1, 0, 4.35, 0, 0, Vector<2>::Zero()}};
    block.normals = {plane, crack};
    block.contact_area = 17.7;
    block.surface = 40;
    block.stated.force = {0, -1241.379666e3};
    block.water.force = uplift * plane + thrust * crack;
    return *judge<2>(block, load_without_bolts(block), {0, -9.81}).factor();
  };
  EXPECT_NEAR(factor(196.259370e3, 44.145e3, 25e3), 1.246659038, 1e-7);
  EXPECT_NEAR(factor(0, 0, 25e3), 1.544475992, 1e-7);
  EXPECT_NEAR(factor(196.259370e3, 44.145e3, 0), 0.801003158, 1e-7);
}

}  // namespace
}  // namespace voussoir::published_wedges_test
