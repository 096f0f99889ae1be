// Scenes that tests state as text, and their runs from beginning to end.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/run/checkpoint.hpp"
#include "core/run/simulate.hpp"
#include "core/scene/scene.hpp"

namespace voussoir {

template <int Dim = 2>
Prepared<Dim> scene_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return prepare<Dim>(parse_scene(text, "scene.toml", overrides));
}

// to any outcome
template <int Dim>
Progress<Dim> simulated(const Prepared<Dim>& scene, const Watcher<Dim>& watcher = {}) {
  Progress<Dim> progress = initial_progress(scene);
  EXPECT_TRUE(simulate(scene, progress, watcher));
  return progress;
}

template <int Dim>
Progress<Dim> whole_run(const Prepared<Dim>& scene) {
  Progress<Dim> progress = simulated(scene);
  EXPECT_EQ(progress.results.outcome, Outcome::done) << progress.results.message;
  return progress;
}

// interrupted after so many steps, then continued from its checkpoint as read back
template <int Dim>
Progress<Dim> continued(const Prepared<Dim>& scene, long long steps) {
  Watcher<Dim> watcher;
  watcher.pause = [steps](const Progress<Dim>& now) { return now.state.counters.steps >= steps; };
  Progress<Dim> first = initial_progress(scene);
  EXPECT_FALSE(simulate(scene, first, watcher)) << "ended before step " << steps;
  Progress<Dim> second = read_checkpoint<Dim>(checkpoint_bytes(first, "scene"), "scene");
  EXPECT_TRUE(simulate(scene, second, {}));
  return second;
}

}  // namespace voussoir
