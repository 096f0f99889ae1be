#include "cases/potential_particles/pack.hpp"

#include <fmt/format.h>

#include "cases/recorded_run.hpp"
#include "core/testing/fall_scene.hpp"
#include "core/testing/fall_watch.hpp"

namespace voussoir::cases {
namespace {

constexpr double carried = 50e3;          // N, by the most loaded contact
constexpr double most_pressed = 0.02;     // of r, by that
constexpr double least_radius = 1e-4;     // of the size
constexpr double first = 3, again = 0.5;  // s
// The fallen blocks overlap by some 2 mm everywhere, and stiffer contacts would throw them apart.
constexpr double loosened = 5e-3;

// the blocks at their current positions; `radius` in m
std::string resting_scene(const Model<3>& model, const State<3>& state, const Rounding& rounding, double radius,
                          double duration) {
  std::string free;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.bodies[b].fixed) free += fmt::format("{}\"{}\"", free.empty() ? "" : ", ", model.bodies[b].name);
  const double stiffness = carried / (most_pressed * radius);
  return fmt::format(R"(preset = "thesis"
dimension = 3
gravity = [0, 0, -9.81]
density = 2500
{}
joint_properties = [{{ name = "rock", normal_stiffness = {}, shear_stiffness = {}, friction_deg = 35, constant_stiffness = true }}]
contact = {{ potential_radius = 0.1, skin = 0.2 }}
damping = {{ local = 0.7, viscous_ratio = 0.2 }}
time = {{ fraction = 0.5 }}
stage = [{{ name = "settle", kind = "run", duration_s = {} }}]
monitors = [{{ name = "pack", bodies = [{}], over = "mean", quantities = ["displacement"] }}]
output = {{ history_interval_s = 0.01 }}
)",
                     blocks_as_particles<3>(model, state, rounding), stiffness, stiffness / 2, duration, free);
}

double mean_height(const Model<3>& model, const State<3>& state) {
  double sum = 0;
  int count = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.bodies[b].fixed) {
      sum += model.origin[2] + model.bodies[b].reference[2] + state.bodies.motions[b].displacement[2];
      ++count;
    }
  return sum / count;
}

}  // namespace

Pack settle_pack() {
  shapes::FallPlan plan;
  plan.blocks = 40;
  plan.side = 3;
  const LoadedScene fall = load_scene(write_scene("study_pack_fall", shapes::fall_scene(plan, "Forty falling blocks")));
  const auto& scene = std::get<Prepared<3>>(fall.prepared);
  State<3> fallen;
  shapes::fall_until_rest(scene, plan.side * plan.pitch, [&](const State<3>& state) { fallen = state; });
  for (std::size_t b = 0; b < scene.model.bodies.size(); ++b)
    fallen.bodies.motions[b].displacement +=
        loosened * (scene.model.origin + scene.model.bodies[b].reference + fallen.bodies.motions[b].displacement);
  const double size = smallest_size(scene.model);
  const RecordedRun<3> rested =
      record<3>(write_scene("study_pack_sharp", resting_scene(scene.model, fallen, {}, least_radius * size, first)));
  return {rested.model(), rested.last(), mean_height(rested.model(), rested.last()), size};
}

Trial settled_pack(const Pack& pack, const RelativeRounding& rounding) {
  const double radius = (rounding.radius > 0 ? rounding.radius : least_radius) * pack.size;
  const Rounding rounded{rounding.radius * pack.size, rounding.sphericity};
  return ask("study_pack", resting_scene(pack.model, pack.state, rounded, radius, again),
             [&](const SceneRun& run) { return -column(run, "pack_mean_displacement_z_m").back() / pack.height; });
}

}  // namespace voussoir::cases
