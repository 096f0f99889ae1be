// Blocks drawn at random: the projection against an enumeration of every candidate in whole numbers, which shares no
// code with it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_int_distribution.hpp>

#include "cases/case_tools.hpp"
#include "core/key_blocks/direction_cone.hpp"
#include "reference/key_blocks/whole_block.hpp"

namespace voussoir::cases::random_blocks_test {
namespace {

using reference::Whole3;
using reference::WholeBlock;
using verification::CaseReport;
using verification::Kind;

Vector<3> real(const Whole3& a) {
  return {static_cast<double>(a[0]), static_cast<double>(a[1]), static_cast<double>(a[2])};
}

// random faces, with parallel ones and prisms on purpose
class Blocks {
 public:
  explicit Blocks(unsigned seed) : random_(seed) {}

  WholeBlock next() {
    WholeBlock block;
    const std::size_t count = number(4, 12);
    const int kind = number(0, 3);
    while (block.normals.size() < count) {
      const Whole3 n{number(-9, 9), number(-9, 9), kind == 1 ? 0 : number(-9, 9)};
      if (n == Whole3{0, 0, 0}) continue;
      block.normals.push_back(n);
      if (kind == 2 && number(0, 1)) block.normals.push_back({-n[0], -n[1], -n[2]});
    }
    block.load = {number(-3, 3), number(-3, 3), -7};
    return block;
  }

 private:
  int number(int low, int high) { return boost::random::uniform_int_distribution<int>(low, high)(random_); }

  boost::random::mt19937 random_;
};

struct Disagreements {
  int removability = 0, motion = 0, faces = 0, several = 0;
};

struct Comparison {
  Disagreements wrong;
  double direction = 0;         // largest distance of two unit vectors
  double balance = 0;           // largest residual of R = v - Σ N n over R, and of the weights that prove a taper
  int moving = 0, tapered = 0;  // blocks
  int on_two = 0, several_lines = 0, first_line_wrong = 0;
};

// whether the loaded faces of the projection are those of a candidate: several of them share a line
bool has_faces(const std::vector<reference::WholeMotion>& motions, const Projection<3>& projection,
               const WholeBlock& block) {
  return std::any_of(motions.begin(), motions.end(), [&](const reference::WholeMotion& motion) {
    if (motion.loaded != projection.loaded) return false;
    for (int k = 0; k < motion.loaded; ++k) {
      const Vector<3> n = real(block.normals[motion.faces[k]]).normalized();
      bool found = false;  // a face may be there twice
      for (int l = 0; l < projection.loaded; ++l)
        found |= (real(block.normals[projection.faces[l]]).normalized() - n).norm() < 1e-12;
      if (!found) return false;
    }
    return true;
  });
}

void compare_motion(const WholeBlock& block, const std::vector<Vector<3>>& normals, Comparison& sum) {
  const Vector<3> load = real(block.load);
  const Projection<3> projection = project(normals, load);
  const std::vector<reference::WholeMotion> motions = find_motions(block);
  const bool moves = projection.motion.norm() > 0;
  sum.moving += moves;
  sum.wrong.motion += !projection.found || moves == motions.empty();
  if (moves && !motions.empty()) {
    sum.wrong.faces += !has_faces(motions, projection, block);
    for (const reference::WholeMotion& motion : motions) {
      sum.direction =
          std::max(sum.direction, (projection.motion.normalized() - real(motion.direction).normalized()).norm());
      sum.wrong.several +=
          (real(motion.direction).normalized() - real(motions[0].direction).normalized()).norm() > 1e-12;
    }
  }
  Vector<3> residual = projection.motion - load;
  for (int k = 0; k < projection.loaded; ++k)
    residual -= projection.forces[k] * normals[projection.faces[k]];
  sum.balance = std::max(sum.balance, residual.norm() / load.norm());
  if (projection.loaded != 2 || !moves) return;
  // a rule that takes the first line that is open and goes with the load
  ++sum.on_two;
  const std::vector<Whole3> lines = open_lines(block);
  if (lines.empty()) return;
  const auto apart = [&](const Whole3& line) {
    return (real(line).normalized() - projection.motion.normalized()).norm() > 1e-9;
  };
  sum.several_lines += std::any_of(lines.begin(), lines.end(), apart);
  sum.first_line_wrong += apart(lines.front());
}

void compare_removability(const WholeBlock& block, const std::vector<Vector<3>>& normals, Comparison& sum) {
  const Removability<3> found = find_removability(normals);
  sum.wrong.removability += !found.found || found.removable != is_removable(block);
  sum.tapered += !found.removable;
  Vector<3> balance = Vector<3>::Zero();
  double weights = 1;
  for (std::size_t i = 0; i < found.weights.size(); ++i) {
    balance += found.weights[i] * normals[i];
    weights += found.weights[i];
    sum.wrong.removability += !(found.weights[i] > 0);
  }
  sum.balance = std::max(sum.balance, balance.norm() / weights);
}

void compare(CaseReport& report, int blocks, unsigned seed) {
  Blocks drawn(seed);
  Comparison sum;
  for (int k = 0; k < blocks; ++k) {
    const WholeBlock block = drawn.next();
    std::vector<Vector<3>> normals;
    for (const Whole3& n : block.normals)
      normals.push_back(real(n).normalized());
    compare_motion(block, normals, sum);
    compare_removability(block, normals, sum);
  }
  const std::string of = fmt::format(", {} blocks", blocks),
                    source = "enumeration in whole numbers, reference/key_blocks";
  const auto count = [&](const std::string& what, int found) {
    report.record({what + of, "1", Kind::exact, source, 0, {0, 0}, "a count: no block may differ"}, found);
  };
  count("blocks whose removability differs", sum.wrong.removability);
  count("blocks of which only one method has a motion", sum.wrong.motion);
  count("blocks on other faces", sum.wrong.faces);
  count("blocks with two motions in whole numbers", sum.wrong.several);
  report.record(
      {"direction of motion, largest difference" + of,
       "1",
       Kind::limit,
       source,
       0,
       {1e-10, 0, verification::Bound::at_most},
       "rounding over the sine between two faces, at least 1/250 for normals of whole numbers up to 9; to its "
       "square where their forces are large"},
      sum.direction);
  report.record({"R = v - sum N n and sum w n = 0, largest residual" + of,
                 "1",
                 Kind::limit,
                 "identity: the proof of a verdict",
                 0,
                 {1e-9, 0, verification::Bound::at_most},
                 "faces may be closed by the sine 1e-9"},
                sum.balance);
  const auto share = [&](const std::string& what, int part, int whole) {
    report.report(what + of, "1", static_cast<double>(part) / whole, fmt::format("{} of {}", part, whole));
  };
  share("share that moves", sum.moving, blocks);
  share("share that is tapered", sum.tapered, blocks);
  share("blocks on two faces with several open lines", sum.several_lines, sum.on_two);
  share("blocks on two faces of which the first open line is not the motion", sum.first_line_wrong, sum.on_two);
  EXPECT_GT(sum.moving, blocks / 20);
  EXPECT_GT(sum.tapered, blocks / 20);
  EXPECT_GT(sum.on_two, blocks / 20);
}

TEST(RandomBlocks, ProjectionAgreesWithEnumeration) {
  CaseReport report("key_blocks", {"blocks whose removability differs, 20000 blocks"});
  compare(report, 20'000, 2);
}

}  // namespace
}  // namespace voussoir::cases::random_blocks_test
