// Pairs of the benchmark with the answers of the exact referee of the tests, which is under the GPL: only the tool
// that writes pairs.json and tests link it.
#pragma once

#include "benchmarks/judge/pair_file.hpp"
#include "benchmarks/workload.hpp"

namespace voussoir::benchmarks {

// The answer for two blocks of these planes, which are normals as they are, unit but for rounding. Everything but
// shape, state, number and unit is set. Throws std::logic_error if planes close no block.
ExactPair exact_answer(const HalfSpaces<3>& a, const HalfSpaces<3>& b);

// the first pairs of a workload of that seed; the benchmark's own for workload_seed
std::vector<ExactPair> exact_pairs(Shape shape, PairState state, std::uint64_t seed, int count);

// of all shapes and states but the single polyhedra, shape by shape
PairFile all_exact_pairs(std::uint64_t seed, int count);

}  // namespace voussoir::benchmarks
