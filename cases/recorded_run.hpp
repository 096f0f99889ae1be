// A scene of the case's folder, run with its states kept.
#pragma once

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "app/base/run_scene.hpp"

namespace voussoir::cases {

template <int Dim>
struct RecordedRun {
  SceneRun run;
  bool ended = true;               // false: `stop` stopped it
  std::vector<State<Dim>> frames;  // as the scene's output states, the end of each stage included
  std::vector<State<Dim>> trials;  // the ends of a search's failed trials
  State<Dim> end;                  // after the last step: its positions, and the forces at those before

  const Prepared<Dim>& scene() const { return std::get<Prepared<Dim>>(run.scene.prepared); }
  const Model<Dim>& model() const { return scene().model; }
  const State<Dim>& last() const { return frames.back(); }
};

// the failures to refuse: a number that is not finite, or also a stage that missed its goal
enum class Demand { no_failure, goals };

// Runs <case>/<scene> until its end, or until `stop` returns true. Throws std::runtime_error if `demand` is not met.
template <int Dim>
RecordedRun<Dim> record(const std::filesystem::path& scene, const std::vector<std::string>& overrides = {},
                        Demand demand = Demand::goals,
                        const std::function<bool(const Prepared<Dim>&, const State<Dim>&)>& stop = {}) {
  RecordedRun<Dim> recorded;
  recorded.run.scene = load_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / scene, overrides);
  const Prepared<Dim>& prepared = recorded.scene();
  Watcher<Dim> watcher;
  watcher.frame = [&](const Model<Dim>&, const State<Dim>& state, double) { recorded.frames.push_back(state); };
  watcher.trial_frame = [&](const Model<Dim>&, const State<Dim>& state, int) { recorded.trials.push_back(state); };
  if (stop) watcher.pause = [&](const Progress<Dim>& now) { return stop(prepared, now.state); };
  Progress<Dim> progress = initial_progress(prepared);
  recorded.ended = simulate(prepared, progress, watcher);
  recorded.end = std::move(progress.state);
  recorded.run.results = std::move(progress.results);
  const Outcome outcome = recorded.run.results.outcome;
  if (outcome == Outcome::failed || (demand == Demand::goals && recorded.ended && outcome != Outcome::done))
    throw std::runtime_error(scene.string() + ": " + recorded.run.results.message);
  return recorded;
}

}  // namespace voussoir::cases
