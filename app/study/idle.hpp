// Keys of a study that nothing uses: known from the scenes before any run, or from results that do not differ.
#pragma once

#include <string>
#include <vector>

#include "app/study/sweep.hpp"
#include "app/study/table.hpp"

namespace voussoir {

// A line for each key of a sweep, grid or sample that acts in no stage of its scene: with another of its values, alone,
// all that a run depends on is the same. Told only where that is certain.
std::vector<std::string> idle_keys(const StudyPlan& plan);

// A line for each sweep, grid or sample whose results do not differ, or by less than their own error bars, and for each
// key of a grid along which none differs. `rows` as table_of gives them.
std::vector<std::string> flat_results(const StudyPlan& plan, const std::vector<StudyRow>& rows);

}  // namespace voussoir
