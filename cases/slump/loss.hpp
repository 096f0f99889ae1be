// A slope that the distinct element method loses: how every block moved.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "cases/case_tools.hpp"

namespace voussoir::cases {

// The distinct element run: at rest before friction is lowered, and as the last trial that failed left it.
template <int Dim>
struct Loss {
  SceneRun run;
  State<Dim> settled, lost;

  const Model<Dim>& model() const { return std::get<Prepared<Dim>>(run.scene.prepared).model; }
};

template <int Dim>
Loss<Dim> lose(const std::filesystem::path& scene, const std::vector<std::string>& overrides = {}) {
  Loss<Dim> loss;
  loss.run.scene = load_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / scene, overrides);
  const auto& prepared = std::get<Prepared<Dim>>(loss.run.scene.prepared);
  std::vector<State<Dim>> ends, trials;  // of the stages, of the trials that failed
  Watcher<Dim> watcher;
  watcher.frame = [&](const Model<Dim>&, const State<Dim>& state, double) { ends.push_back(state); };
  watcher.trial_frame = [&](const Model<Dim>&, const State<Dim>& state, int) { trials.push_back(state); };
  Progress<Dim> progress = begin(prepared);
  simulate(prepared, progress, watcher);
  loss.run.results = std::move(progress.results);
  if (loss.run.results.outcome != Outcome::done)
    throw std::runtime_error(scene.string() + ": " + loss.run.results.message);
  loss.settled = ends.front();
  loss.lost = trials.at(trials.size() - 1);
  return loss;
}

struct BlockLoss {
  int body = 0;
  Vector<2> place;     // of its centroid, in the plane of the slope
  double largest = 0;  // of its corners' motions, m
  double turn = 0;     // rad, counter-clockwise as seen with x to the right
};

template <int Dim>
std::vector<BlockLoss> motions_of_loss(const Loss<Dim>& loss) {
  const Model<Dim>& model = loss.model();
  std::vector<BlockLoss> moved;
  for (int b = 0; b < static_cast<int>(model.bodies.size()); ++b) {
    const Body<Dim>& body = model.bodies[b];
    if (body.fixed) continue;
    const Motion<Dim>&before = loss.settled.motions[b], &after = loss.lost.motions[b];
    const Matrix<Dim> turned = matrix(after.rotation) - matrix(before.rotation);
    const Matrix<Dim> turn = matrix(after.rotation) * matrix(before.rotation).transpose();
    const Vector<Dim> place = model.origin + body.reference;
    BlockLoss block{b, {place[0], place[Dim - 1]}, 0, std::atan2(turn(Dim - 1, 0), turn(0, 0))};
    for (const Vector<Dim>& corner : body.parts.front().vertices) {
      const Vector<Dim> way = after.displacement - before.displacement + turned * corner;
      block.largest = std::max(block.largest, way.norm());
    }
    moved.push_back(block);
  }
  return moved;
}

}  // namespace voussoir::cases
