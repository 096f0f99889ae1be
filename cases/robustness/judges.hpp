// Each kernel's result for an instance, judged by the exact referee against the kernel's promise (README.md).
#pragma once

#include "cases/robustness/instances.hpp"
#include "core/slicing/block.hpp"

namespace voussoir::atlas {

// decision (with the LP's value), centre, normal, overlap and area of two bodies that meet
Judgements judge_pair(const Meeting& meeting);

// a block made of the planes
Judgement judge_block(const HalfSpaces<3>& planes);

// a block cut by a plane
Judgement judge_cut(const Polytope<3>& block, const HalfSpace<3>& joint);

}  // namespace voussoir::atlas
