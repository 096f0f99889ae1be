// Each kernel's result for an instance, judged by the exact referee against the kernel's promise (README.md).
#pragma once

#include <limits>
#include <string>
#include <utility>

#include "cases/robustness/instances.hpp"
#include "core/slicing/block.hpp"

namespace voussoir::atlas {

// Every promise is of one kind: the result is exact for planes within so many units of rounding (2^-53 of the
// coordinates) of the given ones. 64 for a result of assembly and solution, 16 for one stage alone.
inline constexpr double unit_rounding = std::numeric_limits<double>::epsilon() / 2;
inline constexpr double whole_chain = 64 * unit_rounding, one_stage = 16 * unit_rounding;

inline Judgement wrong(std::string reason) {
  return {Verdict::wrong, std::move(reason), 0};
}

// decision (with the LP's value), centre, normal, overlap and area of two bodies that meet
Judgements judge_pair(const Meeting& meeting);

// a block made of the planes
Judgement judge_block(const HalfSpaces<3>& planes);

// a block cut by a plane
Judgement judge_cut(const Polytope<3>& block, const HalfSpace<3>& joint);

}  // namespace voussoir::atlas
