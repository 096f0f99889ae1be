#include "app/study/evaluations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <thread>

#include "app/base/interruption.hpp"
#include "app/base/run_scene.hpp"
#include "app/study/blocks_answers.hpp"
#include "app/study/found.hpp"
#include "app/study/parallel_rows.hpp"
#include "app/study/search_trial.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

constexpr const char* evaluations_folder = "reliability_runs";

EvaluatedSetting told_by_blocks(const BlocksAnswers& answers, const BlocksAnswer& answer) {
  EvaluatedSetting setting{
      .value = answer.value, .unit = answers.unit(), .divides = answers.divides(), .mode = answer.mode};
  if (!answer.value) setting.status = status_text(answer);
  return setting;
}

Evaluate by_blocks(const StudyFolder& study, const Sweep& sweep) {
  const auto answers =
      std::make_shared<BlocksAnswers>(sweep.scene, sweep.overrides, sweep.other->options, study.plan.quantity);
  answers->vary(*sweep.drawn);
  return [answers](const KeySettings& settings) {
    std::vector<EvaluatedSetting> all(settings.size());
    each_row_in_parallel(static_cast<int>(settings.size()),
                         [&](int k) { all[k] = told_by_blocks(*answers, answers->answer(settings[k])); });
    if (interruption()) throw EvaluationsInterrupted();
    return all;
  };
}

EvaluatedSetting told_by_results(const RunFound& found) {
  EvaluatedSetting setting{.status = found.status};
  if (!found.result) return setting;
  setting.value = found.result->value;
  setting.error_bar = found.result->error_bar;
  setting.unit = found.result->unit;
  setting.divides = found.result->divides;
  return setting;
}

EvaluatedSetting told_by_trial(const fs::path& folder) {
  const std::optional<bool> failed = trial_failed(folder);
  return {.failed = failed,
          .status = !failed   ? "its trial has neither stood nor failed"
                    : *failed ? "fails"
                              : "stands"};
}

// a run for each setting with these overrides, told by its folder
using TellRun = std::function<EvaluatedSetting(const fs::path&)>;
Evaluate by_runs(const StudyFolder& study, const Sweep& sweep, const WorkOptions& how,
                 const std::vector<std::string>& overrides, const TellRun& tell) {
  return [&study, &sweep, how, overrides, tell](const KeySettings& settings) {
    const std::vector<std::string> keys = sweep.drawn->scene_keys();
    std::vector<StudyRun> runs;
    for (const std::vector<double>& values : settings) {
      Sweep one = sweep;
      for (std::size_t k = 0; k < keys.size(); ++k)
        one.overrides.push_back(fmt::format("{}={}", keys[k], values[k]));
      one.overrides.insert(one.overrides.end(), overrides.begin(), overrides.end());
      one.with.clear();
      runs.push_back(row_of(study.plan, one, overrides_of(one, 0), study.program_digest).run);
    }
    RunsOptions options;
    options.folder = study.folder / evaluations_folder;
    options.jobs = how.jobs > 0 ? how.jobs : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    options.threads = how.threads;
    options.time_limit = how.time_limit;
    options.quiet = how.quiet;
    options.others = Others::wait_for_theirs;
    const RunsEnded ended = carry_out_runs(runs, options);
    if (ended.interrupted) throw EvaluationsInterrupted();
    std::vector<EvaluatedSetting> all;
    for (std::size_t k = 0; k < runs.size(); ++k)
      all.push_back(ended.failures[k].empty() ? tell(options.folder / runs[k].name)
                                              : EvaluatedSetting{.status = ended.failures[k]});
    return all;
  };
}

}  // namespace

Evaluations evaluations_of(const StudyFolder& study, const Sweep& sweep, const WorkOptions& how) {
  if (sweep.other && sweep.other->name == "blocks") return {by_blocks(study, sweep)};
  const auto value_in = [&study](const fs::path& folder) { return told_by_results(found_in(folder, study.plan)); };
  Evaluations all{by_runs(study, sweep, how, {}, value_in)};
  if (sweep.other || study.plan.history) return all;
  const std::vector<std::string> trial =
      trial_at_limit(*load_scene(sweep.scene, sweep.overrides).stated, study.plan.quantity, *sweep.fails);
  if (!trial.empty()) all.failed = by_runs(study, sweep, how, trial, told_by_trial);
  return all;
}

}  // namespace voussoir
