// A rectangle of rock is cut by a joint that dips at 30 degrees; the lower block is fixed. For which friction angles is
// the upper one stable? The library slices and settles the blocks without a scene.
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <voussoir/core/run/run.hpp>
#include <voussoir/core/slicing/block.hpp>
#include <voussoir/core/slicing/slice.hpp>

using namespace voussoir;

namespace {

constexpr double degree = std::numbers::pi / 180, dip = 30 * degree;

Model<2> slope(double friction) {
  // a block is an intersection of half-spaces: normals out of the rock, distances in m
  const HalfSpaces<2> sides{{{1, 0}, 2}, {{-1, 0}, 2}, {{0, 1}, 1.5}, {{0, -1}, 1.5}};
  const BlockResult<2> whole = make_block<2>(sides, {no_joint, no_joint, no_joint, no_joint});
  if (whole.status != BlockStatus::ok) throw std::runtime_error("the sides close no block");
  Cut<2> joint;
  joint.plane = {{-std::sin(dip), std::cos(dip)}, 0};
  joint.joint = 0;
  SlicingCounters counters;

  Model<2> model;
  for (const Polytope<2>& part : slice<2>(whole.part, {joint}, {}, counters))
    model.bodies.push_back(make_body<2>({part}, 2600));  // kg/m³
  number_bodies(model);
  for (Body<2>& body : model.bodies)
    body.fixed = body.reference.dot(joint.plane.normal) < 0;
  model.properties = {
      {.name = "joint", .normal_stiffness = 1e9, .shear_stiffness = 1e9, .friction = friction}};  // Pa/m
  model.joints = {{"bedding", joint.plane, 0}};
  model.gravity = {0, -9.81};
  return model;
}

bool stays(double friction) {
  const Model<2> model = slope(friction);
  State<2> state = initial_state(model);
  const RunGoal goal{.rest = true, .step_limit = 100'000, .moved_away = 0.01};
  const RunReport report = run(model, Settings{}, goal, {}, state);
  std::printf("friction %4.1f deg: %s after %lld steps, %.3g m from where it began\n", friction / degree,
              describe(report.reason).c_str(), report.steps,
              state.bodies.motions.at(model.bodies[0].fixed ? 1 : 0).displacement.norm());
  if (report.reason != StopReason::equilibrium && report.reason != StopReason::moved_away)
    throw std::runtime_error("no result");
  return report.reason == StopReason::equilibrium;
}

}  // namespace

int main() {
  // a block that does not tip slides if the joint dips more steeply than its friction angle
  return !stays(20 * degree) && !stays(29 * degree) && stays(31 * degree) && stays(40 * degree) ? 0 : 1;
}
