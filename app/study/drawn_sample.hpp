// A sample on block theory: its rows are drawn and judged in this process, by all cores, and have no folders.
#pragma once

#include <optional>
#include <string>

#include "app/study/sample_findings.hpp"

namespace voussoir {

struct DrawnSample {
  std::string csv;  // sample_N.csv: the first hundred thousand rows
  SampleFound found;
  std::string divides;  // what a factor of safety divides
};

// Bitwise the same for any number of threads. None: interrupted.
std::optional<DrawnSample> draw_sample(const StudyPlan& plan, const Sweep& sample, bool quiet);

}  // namespace voussoir
