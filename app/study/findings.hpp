// Results of a study's grids and samples: grid_1.csv and its axes, grid_1.json; sample_1.csv and sample_1.json.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/study/sweep.hpp"
#include "app/study/table.hpp"

namespace voussoir {

// the files' names, of the first grid and the first sample from 1
std::vector<std::string> finding_names(const StudyPlan& plan);

struct Findings {
  std::vector<std::pair<std::string, std::string>> files;  // name and content, in the order of their names
  std::vector<std::string> lines;                          // for people, of each grid and sample
  std::vector<std::string> divides;                        // what factors of safety divide, of rows without runs
  bool interrupted = false;                                // while rows were drawn: nothing else is complete
};

// `rows` as table_of gives them. Samples on block theory are drawn and judged here.
Findings findings_of(const StudyPlan& plan, const std::vector<StudyRow>& rows, bool quiet = true);

}  // namespace voussoir
