#include "reference/key_blocks/whole_block.hpp"

#include <algorithm>

#include "reference/require.hpp"

namespace voussoir::reference {
namespace {

constexpr Require whole_requires{"whole block: "};
constexpr long long largest = 1000;

long long dot(const Whole3& a, const Whole3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Whole3 cross(const Whole3& a, const Whole3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Whole3 opposite(const Whole3& a) {
  return {-a[0], -a[1], -a[2]};
}
bool is_zero(const Whole3& a) {
  return a == Whole3{0, 0, 0};
}

void check(const WholeBlock& block) {
  const auto in_range = [](const Whole3& a) {
    return std::all_of(a.begin(), a.end(), [](long long x) { return x >= -largest && x <= largest; });
  };
  for (const Whole3& n : block.normals)
    whole_requires(!is_zero(n) && in_range(n), "normals must not be zero, nor beyond 1000");
  whole_requires(in_range(block.load), "the load must not be beyond 1000");
}

bool closes_none(const WholeBlock& block, const Whole3& direction) {
  return std::all_of(block.normals.begin(), block.normals.end(),
                     [&](const Whole3& n) { return dot(n, direction) >= 0; });
}

// along the line of two faces, with the load; zero if they are parallel or the load is across it
Whole3 line_with(const Whole3& a, const Whole3& b, const Whole3& load) {
  const Whole3 line = cross(a, b);
  const long long along = dot(line, load);
  return along == 0 ? Whole3{0, 0, 0} : along > 0 ? line : opposite(line);
}

template <typename Act>
void for_pairs(const WholeBlock& block, const Act& act) {
  for (int i = 0; i < static_cast<int>(block.normals.size()); ++i)
    for (int j = i + 1; j < static_cast<int>(block.normals.size()); ++j)
      act(i, j);
}

}  // namespace

bool is_removable(const WholeBlock& block) {
  check(block);
  bool spans = false, open = false;
  for_pairs(block, [&](int i, int j) {
    const Whole3 line = cross(block.normals[i], block.normals[j]);
    for (const Whole3& n : block.normals)
      spans |= dot(line, n) != 0;
    open |= !is_zero(line) && (closes_none(block, line) || closes_none(block, opposite(line)));
  });
  return open || !spans;
}

std::vector<WholeMotion> find_motions(const WholeBlock& block) {
  check(block);
  const Whole3& load = block.load;
  std::vector<WholeMotion> found;
  const auto attempt = [&](const WholeMotion& motion) {
    if (!is_zero(motion.direction) && closes_none(block, motion.direction)) found.push_back(motion);
  };
  attempt({load});
  for (int i = 0; i < static_cast<int>(block.normals.size()); ++i) {
    const Whole3& n = block.normals[i];
    const long long across = dot(n, load), length = dot(n, n);
    if (across >= 0) continue;
    attempt({{length * load[0] - across * n[0], length * load[1] - across * n[1], length * load[2] - across * n[2]},
             {i, -1},
             1});
  }
  for_pairs(block, [&](int i, int j) {
    const Whole3 &a = block.normals[i], &b = block.normals[j];
    // load = motion - N_a a - N_b b, solved for the signs of N_a and N_b
    const long long aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), la = dot(a, load), lb = dot(b, load);
    if (bb * la - ab * lb < 0 && aa * lb - ab * la < 0) attempt({line_with(a, b, load), {i, j}, 2});
  });
  return found;
}

std::vector<Whole3> open_lines(const WholeBlock& block) {
  check(block);
  std::vector<Whole3> found;
  for_pairs(block, [&](int i, int j) {
    const Whole3 line = line_with(block.normals[i], block.normals[j], block.load);
    if (!is_zero(line) && closes_none(block, line)) found.push_back(line);
  });
  return found;
}

}  // namespace voussoir::reference
