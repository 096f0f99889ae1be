// Keys of a study without effect: known from the scenes before any run, or from results that do not differ.
#pragma once

#include <string>
#include <vector>

#include "app/study/sweep.hpp"
#include "app/study/table.hpp"

namespace voussoir {

// A line for each key of a sweep, grid or sample that acts in no stage of its scene: another of its values leaves the
// input of a run unchanged. Reported only if that is certain.
std::vector<std::string> idle_keys(const StudyPlan& plan);

// A line for each sweep, grid or sample whose results do not differ, or by less than their error bars, and for each key
// of a grid on which no result depends. `rows` as table_of gives them.
std::vector<std::string> flat_results(const StudyPlan& plan, const std::vector<StudyRow>& rows);

}  // namespace voussoir
