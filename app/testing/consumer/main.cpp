// Cuts a cube by a joint and steps it once: structs that hold Eigen types cross the library's border by value.
#include <cstdio>
#include <voussoir/core/slicing/block.hpp>
#include <voussoir/core/step.hpp>

int main() {
  using namespace voussoir;
  HalfSpaces<3> planes;
  for (int k = 0; k < 3; ++k) {
    planes.push_back({Vector<3>::Unit(k), 0.5});
    planes.push_back({-Vector<3>::Unit(k), 0.5});
  }
  Model<3> model;
  model.bodies.push_back(make_body<3>({make_block<3>(planes, std::vector<int>(6, no_joint)).part}, 2000));
  model.gravity = {0, 0, -10};
  number_bodies(model);
  State<3> state = initial_state(model);
  Settings settings;
  settings.time.step = 0.1;
  settings.damping.local = 0;
  step(model, settings, state);
  const bool right =
      std::abs(model.bodies[0].mass - 2000) < 1e-9 && std::abs(state.motions[0].displacement[2] + 0.05) < 1e-12;
  std::printf("mass %.17g kg, fell %.17g m\n", model.bodies[0].mass, -state.motions[0].displacement[2]);
  return right ? 0 : 1;
}
