// What the judge found, as tables.
#pragma once

#include <string>
#include <vector>

#include "benchmarks/judge/judge.hpp"
#include "benchmarks/judge/kernel_times.hpp"

namespace voussoir::benchmarks {

// A sentence: how many errors of which kind, and the first of them.
std::string verdict_sentence(const std::string& kernel, const std::vector<Verdict>& verdicts);

// Markdown that is also readable in a terminal. A quantity that a kernel never gives is "not given".
std::string verdict_table(const std::vector<Verdict>& verdicts);
std::string time_table(const std::vector<KernelTime>& times);

// kernel,shape,state,pairs,wrong_decisions,unusable,wrong_points,wrong_normals,wrong_overlaps,worst_point_m,
// worst_normal_rad,worst_overlap_m,first_error
std::string verdict_csv(const std::string& kernel, const std::vector<Verdict>& verdicts);
// shape,state,method,delivers,median_ns,wrong,pairs
std::string time_csv(const std::vector<KernelTime>& times);

}  // namespace voussoir::benchmarks
