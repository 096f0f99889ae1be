#include "app/study/evaluations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <thread>

#include "app/base/interruption.hpp"
#include "app/study/blocks_answers.hpp"
#include "app/study/found.hpp"
#include "app/study/parallel_rows.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

constexpr const char* evaluations_folder = "reliability_runs";

EvaluatedSetting told_by_blocks(const BlocksAnswers& answers, const BlocksAnswer& answer) {
  EvaluatedSetting setting{answer.value, std::nullopt, answers.unit(), answers.divides(), answer.mode};
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

Evaluate by_runs(const StudyFolder& study, const Sweep& sweep, const WorkOptions& how) {
  return [&study, &sweep, how](const KeySettings& settings) {
    const std::vector<std::string> keys = sweep.drawn->scene_keys();
    std::vector<StudyRun> runs;
    for (const std::vector<double>& values : settings) {
      Sweep one = sweep;
      for (std::size_t k = 0; k < keys.size(); ++k)
        one.overrides.push_back(fmt::format("{}={}", keys[k], values[k]));
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
    for (std::size_t k = 0; k < runs.size(); ++k) {
      const RunFound found = ended.failures[k].empty() ? found_in(options.folder / runs[k].name, study.plan)
                                                       : RunFound{.status = ended.failures[k]};
      EvaluatedSetting setting{.status = found.status};
      if (found.result) {
        setting.value = found.result->value;
        setting.error_bar = found.result->error_bar;
        setting.unit = found.result->unit;
        setting.divides = found.result->divides;
      }
      all.push_back(setting);
    }
    return all;
  };
}

}  // namespace

Evaluate evaluations_of(const StudyFolder& study, const Sweep& sweep, const WorkOptions& how) {
  if (sweep.other && sweep.other->name == "blocks") return by_blocks(study, sweep);
  return by_runs(study, sweep, how);
}

}  // namespace voussoir
