// The projection against an enumeration of every candidate in whole numbers, which shares no code with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_int_distribution.hpp>
#include <cmath>
#include <optional>

#include "core/key_blocks/direction_cone.hpp"
#include "text/angle.hpp"

namespace voussoir::cone_test {
namespace {

using Whole = std::array<long long, 3>;

long long dot(const Whole& a, const Whole& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Whole cross(const Whole& a, const Whole& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
bool is_zero(const Whole& a) {
  return a == Whole{0, 0, 0};
}
Vector<3> real(const Whole& a) {
  return {static_cast<double>(a[0]), static_cast<double>(a[1]), static_cast<double>(a[2])};
}

bool is_open(const std::vector<Whole>& normals, const Whole& direction) {
  return std::all_of(normals.begin(), normals.end(), [&](const Whole& n) { return dot(n, direction) >= 0; });
}

// the motion by enumeration: the load itself, its projections on faces, the lines of pairs whose forces both press
std::vector<Whole> motions(const std::vector<Whole>& normals, const Whole& load) {
  std::vector<Whole> found;
  if (is_open(normals, load)) found.push_back(load);
  for (const Whole& n : normals) {
    const long long along = dot(n, load), length = dot(n, n);
    if (along >= 0) continue;
    const Whole motion{load[0] * length - along * n[0], load[1] * length - along * n[1],
                       load[2] * length - along * n[2]};
    if (!is_zero(motion) && is_open(normals, motion)) found.push_back(motion);
  }
  for (std::size_t i = 0; i < normals.size(); ++i)
    for (std::size_t j = i + 1; j < normals.size(); ++j) {
      const Whole &a = normals[i], &b = normals[j];
      Whole line = cross(a, b);
      if (is_zero(line)) continue;
      const long long down = dot(line, load);
      if (down == 0) continue;
      if (down < 0) line = {-line[0], -line[1], -line[2]};
      const long long aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), ra = dot(a, load), rb = dot(b, load);
      if (bb * ra - ab * rb >= 0 || aa * rb - ab * ra >= 0) continue;  // a force pulls or is none
      if (is_open(normals, line)) found.push_back(line);
    }
  return found;
}

bool is_removable(const std::vector<Whole>& normals) {
  bool spans = false;
  for (std::size_t i = 0; i < normals.size(); ++i)
    for (std::size_t j = i + 1; j < normals.size(); ++j) {
      const Whole line = cross(normals[i], normals[j]);
      for (const Whole& n : normals)
        spans |= dot(line, n) != 0;
      if (!is_zero(line) && (is_open(normals, line) || is_open(normals, {-line[0], -line[1], -line[2]}))) return true;
    }
  return !spans;  // the extreme directions of a cone that holds no line are lines of pairs
}

// random normals, with parallel ones and prisms on purpose
std::vector<Whole> random_normals(boost::random::mt19937& random) {
  const auto number = [&](int low, int high) {
    return boost::random::uniform_int_distribution<int>(low, high)(random);
  };
  std::vector<Whole> normals;
  const int count = number(4, 12), kind = number(0, 3);
  while (static_cast<int>(normals.size()) < count) {
    Whole n{number(-9, 9), number(-9, 9), kind == 1 ? 0 : number(-9, 9)};
    if (is_zero(n)) continue;
    normals.push_back(n);
    if (kind == 2 && number(0, 1)) normals.push_back({-n[0], -n[1], -n[2]});
  }
  return normals;
}

void compare_with_enumeration(int blocks, unsigned seed) {
  boost::random::mt19937 random(seed);
  int moving = 0, held = 0, drawers = 0;
  for (int k = 0; k < blocks; ++k) {
    const std::vector<Whole> whole = random_normals(random);
    const Whole load{boost::random::uniform_int_distribution<int>(-3, 3)(random),
                     boost::random::uniform_int_distribution<int>(-3, 3)(random), -7};
    std::vector<Vector<3>> normals;
    for (const Whole& n : whole)
      normals.push_back(real(n).normalized());
    const Projection<3> projection = project(normals, real(load));
    ASSERT_TRUE(projection.found) << k;
    const std::vector<Whole> expected = motions(whole, load);
    ASSERT_EQ(projection.motion.norm() > 0, !expected.empty()) << k;
    for (const Whole& motion : expected)  // they agree with each other, too
      ASSERT_LT((projection.motion.normalized() - real(motion).normalized()).norm(), 1e-11) << k;
    // equation (1)
    Vector<3> sum = projection.motion - real(load);
    for (int i = 0; i < projection.loaded; ++i) {
      ASSERT_GE(projection.forces[i], 0) << k;
      sum -= projection.forces[i] * normals[projection.faces[i]];
    }
    ASSERT_LT(sum.norm(), 1e-7 * real(load).norm()) << k;
    const Removability<3> removability = find_removability(normals);
    ASSERT_TRUE(removability.found) << k;
    ASSERT_EQ(removability.removable, is_removable(whole)) << k;
    Vector<3> balance = Vector<3>::Zero();
    for (std::size_t i = 0; i < removability.weights.size(); ++i) {
      ASSERT_GE(removability.weights[i], 1) << k;
      balance += removability.weights[i] * normals[i];
    }
    ASSERT_LT(balance.norm(), 1e-7) << k;
    moving += projection.motion.norm() > 0;
    held += !removability.removable;
    drawers += removability.removable && projection.motion.norm() == 0;
  }
  EXPECT_GT(moving, blocks / 20);
  EXPECT_GT(held, blocks / 20);
  EXPECT_GT(drawers, 0);
}

TEST(DirectionCone, AgreesWithEnumerationInWholeNumbers) {
  compare_with_enumeration(1000, 1);
}

TEST(DirectionConeLong, AgreesWithEnumerationInWholeNumbers) {
  compare_with_enumeration(20'000, 2);
}

TEST(DirectionCone, DrawersAreRemovable) {
  // walls left and right, above and below, and behind: out at the front only
  const std::vector<Vector<3>> normals{{1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}, {0, 1, 0}};
  const Removability<3> drawer = find_removability(normals);
  EXPECT_TRUE(drawer.removable);
  EXPECT_LT((drawer.direction - Vector<3>(0, 1, 0)).norm(), 1e-9);
  EXPECT_EQ(project(normals, Vector<3>(0, 0, -1)).motion.norm(), 0);
  std::vector<Vector<3>> closed = normals;
  closed.emplace_back(0, -1, 0);
  EXPECT_FALSE(find_removability(closed).removable);
  EXPECT_TRUE(find_removability<3>({}).removable);
  EXPECT_TRUE(find_removability<2>({{0, 1}, {0, -1}}).removable);
  EXPECT_FALSE(find_removability<2>({{0, 1}, {0, -1}, {1, 0}, {-1, 0}}).removable);
}

TEST(DirectionCone, TaperIsTheAngleByWhichWallsMustTurn) {
  // a block with a free top whose four walls lean inwards by 0.3 degrees and whose floor is level
  const double lean = 0.3 * degree;
  std::vector<Vector<3>> normals{{0, 0, 1}};
  for (const Vector<3>& side : {Vector<3>(1, 0, 0), Vector<3>(-1, 0, 0), Vector<3>(0, 1, 0), Vector<3>(0, -1, 0)})
    normals.push_back(std::cos(lean) * side - std::sin(lean) * Vector<3>(0, 0, 1));
  EXPECT_FALSE(find_removability(normals).removable);
  EXPECT_NEAR(*find_taper(normals) / degree, 0.3, 1e-6);
  for (std::size_t k = 1; k < normals.size(); ++k)
    normals[k][2] *= -1;
  EXPECT_TRUE(find_removability(normals).removable);
  EXPECT_FALSE(find_taper(normals));
}

TEST(DirectionCone, InThePlaneTwoFacesHold) {
  const Vector<2> down(0, -1);
  const std::vector<Vector<2>> slope{Vector<2>(std::sin(30 * degree), std::cos(30 * degree))};
  const Projection<2> slides = project(slope, down);
  EXPECT_EQ(slides.loaded, 1);
  EXPECT_NEAR(slides.motion.norm(), 0.5, 1e-15);
  EXPECT_NEAR(slides.forces[0], std::cos(30 * degree), 1e-15);
  const std::vector<Vector<2>> notch{slope[0], Vector<2>(-std::sin(30 * degree), std::cos(30 * degree))};
  EXPECT_EQ(project(notch, down).motion.norm(), 0);
  EXPECT_EQ(project(slope, Vector<2>(0, 1)).loaded, 0);
}

}  // namespace
}  // namespace voussoir::cone_test
