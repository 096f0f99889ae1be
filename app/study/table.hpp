// study.csv: a row for every run of a study, and for every extrapolation from two of them.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/study/found.hpp"
#include "app/study/sweep.hpp"

namespace voussoir {

// one line of study.csv
struct StudyRow {
  int row = 0;        // of the plan, counted from 1; 0: an extrapolation
  std::string curve;  // the sweep's name; extrapolations from it are a curve of their own
  std::string key, value, unit;
  std::optional<double> result, error_bar;  // without a result: the run failed
  std::string result_unit;
  std::string divides;        // of a factor of safety (Value::divides)
  std::string status = "ok";  // or the failure
  long long contact_evaluations = 0, steps = 0;
  double seconds = 0;
};

// Every row in the plan's order; `found` gives the result of a row's run, counted from 1.
std::vector<StudyRow> table_of(const StudyPlan& plan, const std::function<RunFound(int row)>& found);

std::string study_csv(const StudyPlan& plan, const std::vector<StudyRow>& rows);

}  // namespace voussoir
