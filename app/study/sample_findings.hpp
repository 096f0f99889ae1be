// What the results of a sample say: mean, deviation, the share failed with its interval.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/study/statistics.hpp"
#include "app/study/sweep.hpp"
#include "core/joint_sets/statistics.hpp"

namespace voussoir {

struct RowVerdicts {
  int failed = 0, standing = 0, undecided = 0;
  bool at_limit = false;  // some stable results are equal to the limit

  void add(const Fails& fails, double result, std::optional<double> error_bar);
};

// "5 of them below 1, 24 above, 1 within its error bar of 1"
std::string verdicts_text(const Fails& fails, const RowVerdicts& verdicts);

// rows of block theory without a result
struct WithoutResult {
  std::size_t no_block = 0, nothing_moves = 0, undecided = 0, refused = 0;
  std::size_t count() const { return no_block + nothing_moves + undecided + refused; }
};

struct SampleFound {
  std::size_t rows = 0;
  std::string unit;
  std::vector<double> results;
  RowVerdicts verdicts;
  std::optional<WithoutResult> without;  // if it is known why rows have none
  Moments moments;
  std::optional<Share> failed;  // of the rows with a result

  void add(const Sweep& sample, double result, std::optional<double> error_bar);
  // after the last row
  void conclude(const Sweep& sample);
};

// sample_N.json
std::string sample_json(const StudyPlan& plan, const Sweep& sample, const SampleFound& found);

// for people
std::vector<std::string> sample_lines(const Sweep& sample, const SampleFound& found);

}  // namespace voussoir
