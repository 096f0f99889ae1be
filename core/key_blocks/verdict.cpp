#include "core/key_blocks/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace voussoir {
namespace {

constexpr double no_force = 1e-9;  // of the load: a normal force below it is rounding

// Normal forces that share a line are not unique: of the sets of at most Dim - 1 faces along which the block slides and
// that carry the load, the one of least resistance.
template <int Dim>
void take_least_resistance(const Block<Dim>& block, const Vector<Dim>& load, Verdict<Dim>& verdict) {
  const Vector<Dim> along = verdict.direction();
  std::vector<int> sharing;
  for (int f = 0; f < static_cast<int>(block.faces.size()); ++f)
    if (slides_along(block.faces[f], along)) sharing.push_back(f);
  if (static_cast<int>(sharing.size()) <= verdict.loaded) return;
  const double smallest = no_force * load.norm();
  int carrying = 0;
  double least = std::numeric_limits<double>::infinity();
  const auto attempt = [&](std::array<int, Dim> faces, int count) {
    std::array<double, Dim> forces{};
    if (!balance<Dim>(block.normals, faces, count, load, forces)) return;
    Vector<Dim> left = load - verdict.motion;
    double resistance = 0;
    for (int k = 0; k < count; ++k) {
      if (forces[k] <= smallest) return;
      left += forces[k] * block.normals[faces[k]];
      resistance += block.faces[faces[k]].friction_force(forces[k]);
    }
    if (left.norm() > smallest) return;
    ++carrying;
    if (resistance >= least) return;
    least = resistance;
    verdict.loaded = count;
    verdict.faces = faces;
    verdict.forces = forces;
  };
  for (std::size_t i = 0; i < sharing.size(); ++i) {
    attempt({sharing[i]}, 1);
    if constexpr (Dim == 3)
      for (std::size_t j = i + 1; j < sharing.size(); ++j)
        attempt({sharing[i], sharing[j]}, 2);
  }
  verdict.indeterminate = carrying > 1;
}

}  // namespace

template <int Dim>
Verdict<Dim> judge(const Block<Dim>& block, const Vector<Dim>& load, const Vector<Dim>& gravity, bool distinguish) {
  Verdict<Dim> verdict;
  if (block.enclosed()) {
    verdict.kind = BlockKind::enclosed;
    return verdict;
  }
  const Projection<Dim> projection = project(block.normals, load);
  if (!projection.found) return verdict;
  verdict.loaded = projection.loaded;
  verdict.faces = projection.faces;
  verdict.forces = projection.forces;
  verdict.motion = projection.motion;
  if (verdict.driving() > 0) {
    const Vector<Dim> along = verdict.direction();
    if (verdict.loaded > 0) {
      verdict.kind = BlockKind::slides;
      take_least_resistance(block, load, verdict);
    } else {
      const bool down = along.dot(gravity) >= std::numbers::sqrt2 / 2 * gravity.norm() && gravity.norm() > 0;
      verdict.kind = down ? BlockKind::falls : BlockKind::lifts;
    }
    for (int k = 0; k < verdict.loaded; ++k)
      verdict.friction += block.faces[verdict.faces[k]].friction_force(verdict.forces[k]);
    for (const RockFace<Dim>& face : block.faces)
      if (slides_along(face, along)) verdict.cohesion += face.cohesion;
    return verdict;
  }
  verdict.kind = BlockKind::tapered;
  if (!distinguish) return verdict;
  const Removability<Dim> removability = find_removability(block.normals);
  if (!removability.found) verdict.kind = BlockKind::undecided;
  if (removability.removable) verdict.kind = load.norm() > 0 ? BlockKind::stable : BlockKind::no_load;
  return verdict;
}

template <int Dim>
Vector<Dim> pretension(const Block<Dim>& block) {
  Vector<Dim> sum = Vector<Dim>::Zero();
  for (const BlockBolt<Dim>& bolt : block.bolts)
    sum += bolt.pretension * bolt.direction;
  return sum;
}

template <int Dim>
Vector<Dim> bolt_capacity(const Block<Dim>& block) {
  Vector<Dim> sum = Vector<Dim>::Zero();
  for (const BlockBolt<Dim>& bolt : block.bolts)
    sum += bolt.capacity * bolt.direction;
  return sum;
}

template <int Dim>
BoltedVerdict<Dim> judge_bolted(const Block<Dim>& block, const Vector<Dim>& more, const Vector<Dim>& gravity) {
  BoltedVerdict<Dim> result;
  const Vector<Dim> bare = load_without_bolts(block) + more;
  result.load = bare;
  result.verdict = judge(block, bare, gravity);
  result.factor = result.factor_passive = result.verdict.factor();
  if (block.bolts.empty()) return result;
  if (moves(result.verdict.kind) && result.verdict.kind != BlockKind::slides) {
    const double held = std::max(0.0, -result.verdict.direction().dot(bolt_capacity(block)));
    result.factor = result.factor_passive = (result.verdict.cohesion + held) / result.verdict.driving();
    return result;
  }
  const Vector<Dim> tension = pretension(block), further = bolt_capacity(block) - tension;
  const Verdict<Dim> tightened = judge(block, Vector<Dim>(bare + tension), gravity);
  result.factor_passive = tightened.factor();
  if (moves(tightened.kind)) {
    std::array<double, Dim> changes{};
    double resistance = tightened.friction + tightened.cohesion - further.dot(tightened.direction());
    if (tightened.loaded > 0 && balance<Dim>(block.normals, tightened.faces, tightened.loaded, further, changes))
      for (int k = 0; k < tightened.loaded; ++k)
        resistance += block.faces[tightened.faces[k]].friction_gain(tightened.forces[k], changes[k]);
    result.factor_passive = resistance / tightened.driving();
  }
  result.load = bare + bolt_capacity(block);
  result.verdict = judge(block, result.load, gravity);
  result.factor = result.verdict.factor();
  return result;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                    \
  template Verdict<Dim> judge<Dim>(const Block<Dim>&, const Vector<Dim>&, const Vector<Dim>&, bool); \
  template Vector<Dim> pretension<Dim>(const Block<Dim>&);                                           \
  template Vector<Dim> bolt_capacity<Dim>(const Block<Dim>&);                                        \
  template BoltedVerdict<Dim> judge_bolted<Dim>(const Block<Dim>&, const Vector<Dim>&, const Vector<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
