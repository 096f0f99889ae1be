#include "core/run/snapshot.hpp"

#include "core/run/stage_in_force.hpp"
#include "core/step.hpp"

namespace voussoir {

namespace {

// number of stages that have changed the model; one that did not reach its goal is the last
template <int Dim>
int stages_begun(const Progress<Dim>& progress) {
  return progress.stage + (progress.stage_under_way || progress.results.outcome != Outcome::done);
}

}  // namespace

template <int Dim>
Model<Dim> model_of(const Prepared<Dim>& scene, const Progress<Dim>& progress) {
  return model_after(scene, stages_begun(progress));
}

template <int Dim>
Snapshot<Dim> snapshot(const Prepared<Dim>& scene, const Progress<Dim>& progress) {
  Snapshot<Dim> now{model_of(scene, progress), progress.state};
  const int begun = stages_begun(progress);
  const Settings settings = begun > 0 ? settings_of(scene.stages[begun - 1], scene.settings) : scene.settings;
  if (progress.results.outcome != Outcome::failed) find_forces(now.model, settings, now.state);
  return now;
}

template Model<2> model_of(const Prepared<2>&, const Progress<2>&);
template Model<3> model_of(const Prepared<3>&, const Progress<3>&);
template Snapshot<2> snapshot(const Prepared<2>&, const Progress<2>&);
template Snapshot<3> snapshot(const Prepared<3>&, const Progress<3>&);

}  // namespace voussoir
