// The verdict of one block under a load: whether it can move by translation, how, and its factor by limit equilibrium.
#pragma once

#include <optional>

#include "core/key_blocks/assembly.hpp"
#include "core/key_blocks/direction_cone.hpp"

namespace voussoir {

// With Goodman & Shi's types.
enum class BlockKind {
  enclosed,  // no free face
  tapered,   // IV: a free face, but no direction closes no joint
  no_load,   // removable, but no load acts
  stable,    // III: removable, but its load presses it in; without any friction
  slides,    // I or II: on one face, on two, or on a line that more share
  falls,     // no face is loaded, and the load is within 45° of gravity
  lifts,     // likewise, another load
  undecided  // the limit of steps was reached
};

inline bool moves(BlockKind kind) {
  return kind == BlockKind::slides || kind == BlockKind::falls || kind == BlockKind::lifts;
}

template <int Dim>
struct Verdict {
  BlockKind kind = BlockKind::undecided;
  int loaded = 0;                            // number of loaded faces
  std::array<int, Dim> faces{};              // them, in Block::faces
  std::array<double, Dim> forces{};          // N, their normal forces
  bool indeterminate = false;                // more faces share the line: the least resistance is taken
  Vector<Dim> motion = Vector<Dim>::Zero();  // v of (1), N; its length is the driving force
  double friction = 0, cohesion = 0;         // N: resistance. Σ N tan φ; cohesion of every face along which it slides

  double driving() const { return motion.norm(); }
  Vector<Dim> direction() const { return motion.normalized(); }
  // none if the block does not move without friction
  std::optional<double> factor() const {
    return moves(kind) ? std::optional((friction + cohesion) / driving()) : std::nullopt;
  }
  std::optional<double> factor_friction_only() const {
    return moves(kind) ? std::optional(friction / driving()) : std::nullopt;
  }
};

// Under this force. Kinds without motion are told apart only if `distinguish`.
template <int Dim>
Verdict<Dim> judge(const Block<Dim>& block, const Vector<Dim>& load, const Vector<Dim>& gravity,
                   bool distinguish = true);

// the faces along which a motion slides without opening them
template <int Dim>
bool slides_along(const RockFace<Dim>& face, const Vector<Dim>& direction) {
  return std::abs(face.normal.dot(direction)) <= closing_tolerance;
}

// The forces on a block: `active` counts bolts in the load, at their capacity; `passive` counts pretension in the load
// and the rest of the capacity as resistance that is not divided.
template <int Dim>
Vector<Dim> load_without_bolts(const Block<Dim>& block) {
  return block.stated.force + block.water.force;
}
template <int Dim>
Vector<Dim> pretension(const Block<Dim>& block);
template <int Dim>
Vector<Dim> bolt_capacity(const Block<Dim>& block);

// A block with its bolts. If it falls without them its verdict stays that, and its factors are the resistance and the
// bolts' capacity against the load over the load.
template <int Dim>
struct BoltedVerdict {
  Verdict<Dim> verdict;                    // of the load with the bolts at their capacity, or without them if it falls
  std::optional<double> factor;            // active: bolts are part of the load
  std::optional<double> factor_passive;    // bolts are part of the resistance, which is not divided
  Vector<Dim> load = Vector<Dim>::Zero();  // of the verdict
};
template <int Dim>
BoltedVerdict<Dim> judge_bolted(const Block<Dim>& block, const Vector<Dim>& more, const Vector<Dim>& gravity);

}  // namespace voussoir
