// The runs that a plan asks for, one a row of study.csv, with what each is expected to cost.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/study/plan.hpp"
#include "app/study/runs.hpp"

namespace voussoir {

struct PlannedRow {
  int row = 0;      // in study.csv without extrapolations, from 1
  double cost = 0;  // contact evaluations that are expected, within a factor of a few; of limit analysis blocks
  StudyRun run;     // by the name of a digest of scene and program; `begin` is a name too
};

// Every row in order. Reading them all first: a mistake in the last should not show after an hour. Throws SceneError,
// BadInput.
std::vector<PlannedRow> rows_of_plan(const StudyPlan& plan, const std::string& program_digest);

// The runs that make what others begin with: of each the first row that needs it, up to the stage `until`.
std::vector<StudyRun> generations_of(const std::vector<PlannedRow>& rows, const std::string& until);

}  // namespace voussoir
