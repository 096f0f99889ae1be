#include "cases/potential_particles/pack.hpp"

#include <fmt/format.h>

#include <ctime>

#include "cases/case_tools.hpp"
#include "cases/recorded_run.hpp"
#include "core/testing/fall_scene.hpp"
#include "core/testing/fall_watch.hpp"

namespace voussoir::cases {
namespace {

constexpr double carried = 50e3;       // N, by the most loaded contact
constexpr double pressed = 0.02;       // of r, by that
constexpr double first = 3, again = 0.5;  // s
constexpr double least_radius = 1e-4;  // of the size
// Of all places: the fallen blocks overlap by some 2 mm, which a stiffer contact would throw apart.
constexpr double loosened = 5e-3;

std::filesystem::path write(const std::string& name, const std::string& text) {
  const std::filesystem::path path = verification::case_output("potential_particles") / (name + ".toml");
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

// the blocks from where they lie, until next to nothing moves
std::string resting_scene(const std::string& blocks, double radius, double duration) {
  const double stiffness = carried / (pressed * radius);
  return fmt::format(R"(dimension = 3
gravity = [0, 0, -9.81]
density = 2500
{}
joint_properties = [{{ name = "rock", normal_stiffness = {}, shear_stiffness = {}, friction_deg = 35, constant_stiffness = true }}]
contact = {{ potential_radius = 0.1, skin = 0.2 }}
damping = {{ local = 0.7, viscous_ratio = 0.2 }}
time = {{ fraction = 0.5 }}
stage = [{{ name = "settle", kind = "run", duration_s = {} }}]
)",
                     blocks, stiffness, stiffness / 2, duration);
}

double mean_height(const Model<3>& model, const State<3>& state) {
  double sum = 0;
  int count = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.bodies[b].fixed) {
      sum += model.origin[2] + model.bodies[b].reference[2] + state.motions[b].displacement[2];
      ++count;
    }
  return sum / count;
}

}  // namespace

Pack settle_pack() {
  shapes::FallPlan plan;
  plan.blocks = 40;
  plan.side = 3;
  const LoadedScene fall = load_scene(write("study_pack_fall", shapes::fall_scene(plan, "Forty falling blocks")));
  const auto& scene = std::get<Prepared<3>>(fall.prepared);
  State<3> fallen;
  shapes::fall_until_rest(scene, plan.side * plan.pitch, [&](const State<3>& state) { fallen = state; });
  for (std::size_t b = 0; b < scene.model.bodies.size(); ++b)
    fallen.motions[b].displacement +=
        loosened * (scene.model.origin + scene.model.bodies[b].reference + fallen.motions[b].displacement);
  const double size = smallest_size(scene.model);
  const RecordedRun<3> rested = record<3>(
      write("study_pack_sharp", resting_scene(blocks_as_particles<3>(scene.model, fallen, {}), least_radius * size, first)));
  fmt::print("pack sharp: {} {} steps {} kin {}\n", rested.run.results.message, mean_height(scene.model, fallen),
             rested.run.results.counters.steps, shapes::kinetic_fraction(rested.model(), rested.last()));
  return {rested.model(), rested.last(), mean_height(rested.model(), rested.last()), size};
}

Trial settled_pack(const Pack& pack, const RelativeRounding& rounding) {
  const std::string blocks =
      blocks_as_particles<3>(pack.model, pack.state, {rounding.radius * pack.size, rounding.sphericity});
  Trial trial;
  const std::clock_t began = std::clock();
  const double radius = (rounding.radius > 0 ? rounding.radius : least_radius) * pack.size;
  const RecordedRun<3> run = record<3>(write("study_pack", resting_scene(blocks, radius, again)));
  fmt::print("kin {}\n", shapes::kinetic_fraction(run.model(), run.last()));
  trial.seconds = static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC;
  trial.evaluations = run.run.results.counters.contact_evaluations;
  trial.why = run.run.results.message;
  trial.answered = run.run.results.outcome == Outcome::done;
  trial.value = 1 - mean_height(run.model(), run.last()) / pack.height;
  return trial;
}

}  // namespace voussoir::cases
