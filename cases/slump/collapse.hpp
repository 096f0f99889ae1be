// A slope that fails by the distinct element method: the motion of every block.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "cases/recorded_run.hpp"

namespace voussoir::cases {

// The distinct element run: in equilibrium before friction is lowered, and at the end of the last failed trial.
template <int Dim>
struct Collapse {
  SceneRun run;
  State<Dim> settled, failed;

  const Model<Dim>& model() const { return std::get<Prepared<Dim>>(run.scene.prepared).model; }
};

template <int Dim>
Collapse<Dim> run_to_collapse(const std::filesystem::path& scene, const std::vector<std::string>& overrides = {}) {
  RecordedRun<Dim> recorded = record<Dim>(scene, overrides);
  return {std::move(recorded.run), recorded.frames.front(), recorded.trials.at(recorded.trials.size() - 1)};
}

struct CollapsedBlock {
  int body = 0;
  Vector<2> place;     // of its centroid, in the plane of the slope
  double largest = 0;  // of its corners' motions, m
  double turn = 0;     // rad, counter-clockwise as seen with x to the right
};

template <int Dim>
std::vector<CollapsedBlock> motions_at_collapse(const Collapse<Dim>& collapse) {
  const Model<Dim>& model = collapse.model();
  std::vector<CollapsedBlock> moved;
  for (int b = 0; b < static_cast<int>(model.bodies.size()); ++b) {
    const Body<Dim>& body = model.bodies[b];
    if (body.fixed) continue;
    const Motion<Dim>&before = collapse.settled.bodies.motions[b], &after = collapse.failed.bodies.motions[b];
    const Matrix<Dim> turned = matrix(after.rotation) - matrix(before.rotation);
    const Matrix<Dim> turn = matrix(after.rotation) * matrix(before.rotation).transpose();
    const Vector<Dim> place = model.origin + body.reference;
    CollapsedBlock block{b, {place[0], place[Dim - 1]}, 0, std::atan2(turn(Dim - 1, 0), turn(0, 0))};
    for (const Vector<Dim>& corner : body.parts.front().vertices) {
      const Vector<Dim> way = after.displacement - before.displacement + turned * corner;
      block.largest = std::max(block.largest, way.norm());
    }
    moved.push_back(block);
  }
  return moved;
}

}  // namespace voussoir::cases
