// Results of a study's grids, samples and reliability analyses: grid_1.csv and its axes, grid_1.json; sample_1.csv and
// sample_1.json; reliability_1.csv and reliability_1.json.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "app/study/evaluations.hpp"
#include "app/study/sweep.hpp"
#include "app/study/table.hpp"

namespace voussoir {

struct Findings {
  std::vector<std::pair<std::string, std::string>> files;  // name and content, in the order of their names
  std::vector<std::string> lines;                          // for people, of each grid and sample
  std::vector<std::string> divides;                        // what factors of safety divide, of rows without runs
  bool failed = false;                                     // a reliability analysis has no probability
  bool interrupted = false;                                // while rows were drawn: nothing else is complete
};

using EvaluationsOf = std::function<Evaluations(const Sweep&)>;

// `rows` as table_of gives them. Samples on block theory are drawn and judged here, and reliability analyses are made.
Findings findings_of(const StudyPlan& plan, const std::vector<StudyRow>& rows, const EvaluationsOf& evaluations = {},
                     bool quiet = true);

}  // namespace voussoir
