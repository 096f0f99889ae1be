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
  std::vector<std::string> lines;                          // for people, one for each grid and sample
};

// `rows` as table_of gives them
Findings findings_of(const StudyPlan& plan, const std::vector<StudyRow>& rows);

}  // namespace voussoir
