// The runs of a plan, one a row of study.csv, with the forecast cost of each.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/study/plan.hpp"
#include "app/study/runs.hpp"

namespace voussoir {

struct PlannedRow {
  int row = 0;      // in study.csv without extrapolations, from 1
  double cost = 0;  // forecast contact evaluations, within a factor of a few; for limit analysis the number of blocks
  StudyRun run;     // named by a digest of scene and program; `begin` is a name too
};

// A run of the sweep's scene with these overrides. Throws SceneError, BadInput.
PlannedRow row_of(const StudyPlan& plan, const Sweep& sweep, const std::vector<std::string>& overrides,
                  const std::string& program_digest);

// Every row in order. All are read first: a mistake in the last must not appear after an hour. Throws SceneError,
// BadInput.
std::vector<PlannedRow> rows_of_plan(const StudyPlan& plan, const std::string& program_digest);

// The runs that make the initial states of others: for each the first row that needs it, up to the stage `until`.
std::vector<StudyRun> generations_of(const std::vector<PlannedRow>& rows, const std::string& until);

}  // namespace voussoir
