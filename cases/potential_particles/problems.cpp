#include "cases/potential_particles/problems.hpp"

#include <fmt/format.h>

#include <cmath>

#include "reference/potential_particles/rounded_blocks.hpp"
#include "text/angle.hpp"

namespace voussoir::cases {
namespace {

const std::filesystem::path all_cases = std::filesystem::path(VOUSSOIR_SOURCE_DIR) / "cases";

template <int Dim>
struct Sharp {
  LoadedScene loaded;
  double size;  // m

  explicit Sharp(const std::filesystem::path& scene, const std::vector<std::string>& overrides = {})
      : loaded(load_scene(scene, overrides)), size(smallest_size<Dim>(prepared().model)) {}

  const Prepared<Dim>& prepared() const { return std::get<Prepared<Dim>>(loaded.prepared); }

  std::string blocks(const RelativeRounding& rounding) const {
    return blocks_as_particles<Dim>(prepared().model, prepared().state, {rounding.radius * size, rounding.sphericity});
  }
};

// a spring on which the weight compresses a contact by a fraction of r: any deeper, the inner bodies would meet
double stiffness_for(double weight, double radius, double fraction) {
  return weight / (fraction * radius);
}

constexpr double pressed = 0.02;       // of r, by a weight
constexpr double sharp_radius = 1e-2;  // of the size: r for which the half-space blocks' numbers are chosen

double radius_of(const RelativeRounding& rounding, double size) {
  return (rounding.radius > 0 ? rounding.radius : sharp_radius) * size;
}

}  // namespace

Trial sliding_wedge(const RelativeRounding& rounding) {
  const Sharp<3> sharp(all_cases / "wedge" / "scene.toml");
  const Model<3>& model = sharp.prepared().model;
  std::string wedge;
  double weight = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.bodies[b].fixed) wedge = fmt::format("block_{}", b), weight = model.bodies[b].mass * 9.81;
  const double stiffness = stiffness_for(weight, radius_of(rounding, sharp.size), pressed);
  return ask("study_wedge",
             fmt::format(R"(preset = "thesis"
dimension = 3
gravity = [0, 0, -9.81]
density = 2000
{}
joint_properties = [{{ name = "rock", normal_stiffness = {}, shear_stiffness = {}, friction_deg = 85, constant_stiffness = true }}]
restrain = [{{ bodies = ["{}"], rotation = true }}]
stage = [{{ name = "settle", kind = "settle", gravity_ramp_s = 1.0 }},
         {{ name = "reduce", kind = "reduce", method = "bisection", from_deg = 45, to_deg = 22, tolerance_deg = 0.01, ramp_steps = 100 }}]
)",
                         sharp.blocks(rounding), stiffness, stiffness / 10, wedge),
             [](const SceneRun& run) { return cases::value(run, "critical_friction"); });
}

namespace {

// Pushes the beam as the case hingedbeam does, to a rotation (rad) within the same time.
Trial push_beam(const RelativeRounding& rounding, double rotation, double viscous_ratio,
                const std::function<double(const std::vector<reference::HingedBeamLoad>&)>& answer) {
  const Sharp<2> sharp(all_cases / "hingedbeam" / "scene.toml");
  const Model<2>& model = sharp.prepared().model;
  std::string left;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (!model.bodies[b].fixed && model.origin[0] + model.bodies[b].reference[0] < 0) left = fmt::format("block_{}", b);
  constexpr double duration = 0.46, ramp = 0.06, first = 0.002, half_length = 0.069;
  const double rate = rotation / (duration - ramp / 2);
  const auto move = [&](const char* name, double side, double speed, const std::string& more) {
    return fmt::format("{{ name = \"{}\", inside = [{}, 0], velocity = [0, {}], translation = [\"y\"], {} }}", name,
                       side * half_length, -speed * half_length, more);
  };
  const auto turning = [&](double side) { return fmt::format("angular_velocity = {}", side * rate * first); };
  const std::string ramped = fmt::format("times_s = [0, {}], factors = [{}, 1]", ramp, first);
  return ask("study_beam",
             fmt::format(R"(preset = "thesis"
dimension = 2
density = 2000
{}
joint_properties = [{{ name = "rock", normal_stiffness = 100e6, shear_stiffness = 1e9, friction_deg = 50, constant_stiffness = true }}]
contact = {{ point = "centroid", potential_radius = 0.1 }}
time = {{ fraction = 0.2 }}
damping = {{ local = 0, viscous_ratio = {} }}
stage = [{{ name = "close", kind = "run", duration_s = 0.001, move = [{}, {}] }},
         {{ name = "push", kind = "run", duration_s = {}, move = [{}, {}] }}]
monitors = [{{ name = "block", bodies = ["{}"], quantities = ["rotation", "contact_load"] }}]
output = {{ history_interval_s = 0.002 }}
)",
                         sharp.blocks(rounding), viscous_ratio, move("left", -1, rate * first, turning(-1)),
                         move("right", 1, rate * first, turning(1)), duration, move("left", -1, rate, ramped),
                         move("right", 1, rate, ramped), left),
             [&](const SceneRun& run) {
               const std::vector<double> turned = column(run, "block_rotation_deg", 2),
                                         weight = column(run, "block_contact_load_y_N", 2);
               std::vector<reference::HingedBeamLoad> curve;
               for (std::size_t i = 0; i < turned.size(); ++i)
                 curve.push_back({-turned[i] * degree, weight[i], 0});
               return answer(curve);
             });
}

constexpr double beam_stiffness = 100e6;
const reference::RoundedHingedBeam sharp_hinge{{}, beam_stiffness, 0};

}  // namespace

double beam_rotation(const RelativeRounding& rounding) {
  constexpr double inscribed = 0.023;   // m, as the blocks of the case are
  constexpr double most_turned = 0.05;  // rad: well before the peak
  // corners penetrate by 2/3 of L2 θ/2 if both joints have the same stiffness
  return std::min(1.5 * radius_of(rounding, inscribed) / sharp_hinge.beam.depth, most_turned);
}

Trial hinged_beam(const RelativeRounding& rounding) {
  return push_beam(rounding, beam_rotation(rounding), 0.02, [](const std::vector<reference::HingedBeamLoad>& curve) {
    return curve.back().weight / reference::rounded_hinged_beam(sharp_hinge, curve.back().rotation).weight;
  });
}

Trial hinged_beam_peak(const RelativeRounding& rounding) {
  return push_beam(rounding, 0.2, 0.02, [](const std::vector<reference::HingedBeamLoad>& curve) {
    return reference::peak_of(curve).weight;
  });
}

namespace {

constexpr int column_blocks = 8;
constexpr double block_weight = 20e3;  // N/m

// the case `column` in the plane: squares on a fixed one of their kind
std::string column_scene(const RelativeRounding& rounding, const std::string& rest) {
  constexpr double inscribed = 0.5;  // m
  const double stiffness = stiffness_for(column_blocks * block_weight, radius_of(rounding, inscribed), pressed);
  const std::string head = "preset = \"thesis\"\ndimension = 2\ngravity = [0, -10]\ndensity = 2000\n";
  const std::string properties = fmt::format(
      "joint_properties = [{{ name = \"rock\", normal_stiffness = {0}, shear_stiffness = {0}, friction_deg = 40, "
      "constant_stiffness = true }}]\n",
      stiffness);
  std::string squares = "blocks = [\n";
  for (int i = 0; i <= column_blocks; ++i)
    squares += fmt::format("  {{ name = \"b{}\", fixed = {}, box = {{ min = [0, {}], max = [1, {}] }} }},\n", i, i == 0,
                           i, i + 1);
  const Sharp<2> sharp(write_scene("study_column_sharp", head + squares + "]\n" + properties + rest));
  return head + sharp.blocks(rounding) + properties + rest;
}

const std::string monitor = "monitors = [{ name = \"top\", bodies = [\"b8\"], quantities = [\"displacement\"] }]\n";

}  // namespace

Trial settled_column(const RelativeRounding& rounding) {
  const std::string scene = column_scene(rounding,
                                         "restrain = [{ all = true, rotation = true }]\n"
                                         "stage = [{ name = \"settle\", kind = \"settle\", gravity_ramp_s = 0.5 }]\n" +
                                             monitor);
  // the lowest joint closes by `pressed` r, each further one by an eighth less
  const double settled = pressed * radius_of(rounding, 0.5) * (column_blocks + 1) / 2.0;
  return ask("study_column", scene,
             [&](const SceneRun& run) { return -column(run, "top_displacement_y_m").back() / settled; });
}

Trial leaning_column(const RelativeRounding& rounding) {
  const std::string scene = column_scene(rounding,
                                         "damping = { local = 0.1, viscous_ratio = 0.2 }\n"
                                         "stage = [{ name = \"lean\", kind = \"run\", duration_s = 12 }]\n" +
                                             monitor);
  return ask("study_column_lean", scene, [](const SceneRun& run) { return column(run, "top_displacement_x_m").back(); },
             {"blocks.b8.velocity=[0.001,0]"});
}

double joint_radius(const RelativeRounding& rounding) {
  constexpr double edge = 1;  // m
  HalfSpaces<2> faces;
  for (const Vector<2>& normal : {Vector<2>(1, 0), Vector<2>(-1, 0), Vector<2>(0, 1), Vector<2>(0, -1)})
    faces.push_back({normal, edge / 2});
  const PotentialShape<2> square =
      rounded<2>(faces, Vector<2>::Zero(), {rounding.radius * edge / 2, rounding.sphericity});
  const reference::FaceBulge bulge = reference::face_bulge(square.planes.front().offset, square.corner_radius,
                                                           square.sphericity, square.sphere_radius);
  return bulge.curvature_radius / 2 / edge;
}

}  // namespace voussoir::cases
