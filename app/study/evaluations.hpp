// Answers for settings that an analysis chooses as it goes: by block theory in this process, else by a run each.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/study/folder.hpp"
#include "app/study/work_options.hpp"

namespace voussoir {

// thrown between answers if a signal asks to stop; completed runs are kept
struct EvaluationsInterrupted {};

struct EvaluatedSetting {
  std::optional<double> value, error_bar;
  std::optional<bool> failed;  // instead of a value, where only that was asked
  std::string unit, divides;
  std::string mode;           // the mechanism's name, if it is known
  std::string status = "ok";  // or why there is no value
};

// values in the order of DrawnKeys::scene_keys; the answers' order is that of the settings
using KeySettings = std::vector<std::vector<double>>;
using Evaluate = std::function<std::vector<EvaluatedSetting>(const KeySettings&)>;

struct Evaluations {
  Evaluate value;
  Evaluate failed = {};  // whether it fails, if that costs less: one trial of a run's search. Empty: the value tells it
};

// Of a reliability analysis. Runs are in `reliability_runs` of the study's folder, one for each different scene, and
// are kept for later calls. Throws as the runs do, and EvaluationsInterrupted.
Evaluations evaluations_of(const StudyFolder& study, const Sweep& sweep, const WorkOptions& how);

}  // namespace voussoir
