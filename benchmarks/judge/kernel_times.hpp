// Times of a kernel on the benchmark's own pairs, beside ours and the libraries that are found.
#pragma once

#include <string>
#include <vector>

#include "benchmarks/judge/kernels.hpp"
#include "benchmarks/method.hpp"

namespace voussoir::benchmarks {

// nanoseconds a pair: medians over repetitions in which all methods take turns
struct KernelTime {
  std::string shape, state;
  std::string method;    // the kernel's name, or one of method_names.hpp
  std::string delivers;  // decision, or contact: with point, normal and overlap
  double median_ns = 0;
  int wrong = 0, pairs = 0;  // decisions that differ from how the pairs were made
};

// the kernel as a method of the benchmark; stage `decision` or `overlap`
Method method_of(const Kernel& kernel, std::int32_t asked);

struct TimingPlan {
  int repetitions = 5;
  double seconds = 2e-3;  // of each; slow methods resolve fewer pairs
  std::vector<Shape> shapes;
  std::vector<PairState> states;
};
TimingPlan all_pairs_timed();

std::vector<KernelTime> time_kernel(const Kernel& kernel, const std::vector<Method>& others, const TimingPlan& plan);

}  // namespace voussoir::benchmarks
