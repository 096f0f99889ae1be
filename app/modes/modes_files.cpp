#include "app/modes/modes_files.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "app/run_folder/origin.hpp"
#include "app/view/page.hpp"
#include "core/base/version.hpp"
#include "core/output/atomic_file.hpp"
#include "core/output/json_parts.hpp"
#include "core/output/paraview.hpp"
#include "core/output/view.hpp"
#include "core/run/run.hpp"

namespace voussoir {
namespace {

using ModesJson = nlohmann::ordered_json;

constexpr double drawn_reach = 0.05;  // of the model's size: the drawn displacement of a mode
constexpr int swing_frames = 16;      // of one swing
constexpr const char* mode_axes[] = {"x", "y", "z"};

// Beyond this it is reported: differences of the forces of joints that hardly close leave some 1e-9.
constexpr double symmetric = 1e-8;

template <int Dim>
bool is_unstable(const Mode<Dim>& mode) {
  return mode.omega_squared < 0 && !mode.no_stiffness;
}

template <int Dim>
std::string frequency_text(const Mode<Dim>& mode) {
  if (is_unstable(mode)) return fmt::format("{:.4g}i", std::sqrt(-mode.omega_squared) / (2 * std::numbers::pi));
  return fmt::format("{:.6g}", mode.frequency());
}

template <class List>
std::string first_names(const List& list, std::size_t most = 5) {
  std::string text;
  for (std::size_t k = 0; k < list.size() && k < most; ++k)
    text += (k > 0 ? ", " : "") + list[k];
  return list.size() > most ? fmt::format("{} and {} more", text, list.size() - most) : text;
}

std::string joint_name(const std::string& name) {
  return name.empty() ? "faces that no joint made" : name;
}

template <class Numbers>
ModesJson numbers_json(const Numbers& numbers) {
  ModesJson list = ModesJson::array();
  for (Eigen::Index k = 0; k < numbers.size(); ++k)
    list.push_back(numbers[k]);
  return list;
}

template <int Dim>
ModesJson mode_json(const Mode<Dim>& mode, const Model<Dim>& model, int number) {
  ModesJson shape = ModesJson::array();
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].fixed || !model.bodies[b].present) continue;
    shape.push_back({{"body", b},
                     {"displacement", numbers_json(Vector<Dim>(mode.displacement[b] / mode.largest))},
                     {"rotation_per_m", numbers_json(Spin<Dim>(mode.rotation[b] / mode.largest))}});
  }
  const double frequency = mode.frequency();
  return {{"mode", number},
          {"omega_squared", mode.omega_squared},
          {"frequency_Hz", frequency > 0 ? ModesJson(frequency) : ModesJson()},
          {"period_s", frequency > 0 ? ModesJson(1 / frequency) : ModesJson()},
          {"unstable", is_unstable(mode)},
          {"participation_factor", numbers_json(Vector<Dim>(mode.participation * mode.largest))},
          {"effective_mass_share", numbers_json(mode.mass_share)},
          {"translation_share", mode.translation_share},
          {"moves_most", {{"body", mode.body}, {"name", model.bodies[mode.body].name}, {"share", mode.body_share}}},
          {"shape", shape}};
}

template <int Dim>
void write_view(const Modes<Dim>& modes, const Model<Dim>& model, const State<Dim>& rest, const Prepared<Dim>& scene,
                double reach, const std::filesystem::path& folder) {
  Prepared<Dim> shown = scene;
  shown.stages.assign(modes.list.size(), scene.stages.front());
  for (std::size_t k = 0; k < modes.list.size(); ++k)
    shown.stages[k].name = fmt::format("mode {}: {} Hz", k + 1, frequency_text(modes.list[k]));
  ViewSeries series = begin_view(folder / view_file, shown);
  double time = 0;
  for (std::size_t k = 0; k < modes.list.size(); ++k) {
    const double frequency = modes.list[k].frequency();
    for (int frame = 0; frame < swing_frames; ++frame) {
      const double phase = std::sin(2 * std::numbers::pi * frame / swing_frames);
      add_view_frame(series, model, swung(rest, model, modes.list[k], reach, phase),
                     {ViewMoment::Kind::frame, time, static_cast<int>(k)});
      time += (frequency > 0 ? 1 / frequency : 1) / swing_frames;
    }
  }
  write_file(folder / page_file, view_page(folder / view_file));
}

}  // namespace

template <int Dim>
std::vector<std::string> doubts_of(const Modes<Dim>& modes, const Model<Dim>& model) {
  std::vector<std::string> lines;
  const TangentAtRest& t = modes.tangent;
  std::vector<std::string> unstable, joints, hanging;
  for (std::size_t k = 0; k < modes.list.size(); ++k)
    if (is_unstable(modes.list[k]))
      unstable.push_back(fmt::format("mode {} (grows by e in {:.3g} s; {} moves most)", k + 1,
                                     1 / std::sqrt(-modes.list[k].omega_squared), label_of(model, modes.list[k].body)));
  if (!unstable.empty())
    lines.push_back(fmt::format("the state is unstable: it buckles or rocks over along {}", first_names(unstable)));
  for (const JointAtStrength& row : t.at_strength)
    joints.push_back(fmt::format("{} of {} on {}", row.at_strength, row.closed, joint_name(row.joint)));
  if (!joints.empty())
    lines.push_back(
        fmt::format("joints within 1 % of their strength may slip in the mode, which takes them as sticking: "
                    "contacts {}",
                    first_names(joints)));
  for (const int b : t.hanging)
    hanging.push_back(label_of(model, b));
  int loose = 0;
  for (const Mode<Dim>& mode : modes.list)
    loose += mode.no_stiffness;
  if (!hanging.empty())
    lines.push_back(fmt::format("nothing touches {}: free, with modes of frequency 0", first_names(hanging)));
  else if (loose > 0)
    lines.push_back(fmt::format("{} mode{} meet{} no resistance (frequency 0): blocks hang free together", loose,
                                loose == 1 ? "" : "s", loose == 1 ? "s" : ""));
  if (t.one_point > 0)
    lines.push_back(fmt::format(
        "{} of {} contacts act at one point: faces rock 2.9 times too stiffly; state contact.face = \"integrated\" or "
        "sub_contacts = 2 or more",
        t.one_point, t.contacts));
  if (t.asymmetry > symmetric)
    lines.push_back(
        fmt::format("the tangent is not symmetric, by {:.1e} of itself (contact points, followers or water): "
                    "modes are those of its symmetric part",
                    t.asymmetry));
  if (modes.missing > 0)
    lines.push_back(fmt::format("{} further mode{} below the last one of the list {} not found", modes.missing,
                                modes.missing == 1 ? "" : "s", modes.missing == 1 ? "was" : "were"));
  return lines;
}

template <int Dim>
std::string modes_text(const Modes<Dim>& modes, const Model<Dim>& model) {
  std::string text = fmt::format("  {:>4} {:>12} {:>12}", "mode", "frequency Hz", "period s");
  for (int d = 0; d < Dim; ++d)
    text += fmt::format(" {:>8}", fmt::format("mass {}", mode_axes[d]));
  text += "  moves most\n";
  for (std::size_t k = 0; k < modes.list.size(); ++k) {
    const Mode<Dim>& mode = modes.list[k];
    const double frequency = mode.frequency();
    text += fmt::format("  {:>4} {:>12} {:>12}", k + 1, frequency_text(mode),
                        frequency > 0 ? fmt::format("{:.5g}", 1 / frequency) : "-");
    for (int d = 0; d < Dim; ++d)
      text += fmt::format(" {:>7.2f}%", 100 * mode.mass_share[d]);
    text += fmt::format("  {}, {:.0f} %\n", label_of(model, mode.body), 100 * mode.body_share);
  }
  Vector<Dim> sum = Vector<Dim>::Zero();
  for (const Mode<Dim>& mode : modes.list)
    sum += mode.mass_share;
  text += fmt::format("  {:>4} {:>12} {:>12}", "sum", fmt::format("of {}", modes.available), "");
  for (int d = 0; d < Dim; ++d)
    text += fmt::format(" {:>7.2f}%", 100 * sum[d]);
  return text + "\n";
}

template <int Dim>
std::string modes_json(const Modes<Dim>& modes, const Model<Dim>& model, const LoadedScene& scene) {
  ModesJson json;
  json["schema"] = "voussoir.modes";
  json["schema_version"] = 1;
  json["title"] = scene.title;
  json["input_hash"] = scene.hash;
  json["program"] = {{"version", version()},
                     {"commit", commit()},
                     {"compiler", compiler()},
                     {"origins", origins_json({this_origin()})}};
  json["stage"] = modes.stage;
  json["warnings"] = doubts_of(modes, model);
  json["free_blocks"] = modes.free_bodies;
  json["modes_in_total"] = modes.available;
  json["free_mass_kg"] = numbers_json(modes.free_mass);
  const TangentAtRest& t = modes.tangent;
  ModesJson at_strength = ModesJson::array();
  for (const JointAtStrength& row : t.at_strength)
    at_strength.push_back({{"joint", row.joint}, {"at_strength", row.at_strength}, {"closed", row.closed}});
  json["tangent"] = {{"unbalanced", t.unbalanced},  {"asymmetry", t.asymmetry},   {"contacts", t.contacts},
                     {"at_one_point", t.one_point}, {"at_strength", at_strength}, {"hanging", t.hanging}};
  json["search"] = {{"shift", modes.shift},
                    {"missing", modes.missing},
                    {"factorisations", modes.factorisations},
                    {"back_substitutions", modes.solutions}};
  json["modes"] = ModesJson::array();
  for (std::size_t k = 0; k < modes.list.size(); ++k)
    json["modes"].push_back(mode_json(modes.list[k], model, static_cast<int>(k) + 1));
  return json.dump(2, ' ', false, ModesJson::error_handler_t::replace) + "\n";
}

std::vector<std::string> mode_files(int number) {
  std::vector<std::string> files;
  for (int k = 1; k <= number; ++k)
    files.push_back(fmt::format("mode_{:02}.vtp", k));
  return files;
}

template <int Dim>
void write_modes(const Modes<Dim>& modes, const Model<Dim>& model, const State<Dim>& rest, const Prepared<Dim>& scene,
                 const std::string& json, bool view, const std::filesystem::path& folder) {
  const double reach = drawn_reach * extent_of_free(model);
  const std::vector<std::string> files = mode_files(static_cast<int>(modes.list.size()));
  std::vector<TimedFile> timed;
  for (std::size_t k = 0; k < files.size(); ++k) {
    const State<Dim> state = swung(rest, model, modes.list[k], reach, 1);
    write_file(folder / files[k], vtp(block_faces(model, state, static_cast<double>(k + 1), scene.joint_sets)));
    timed.push_back({static_cast<double>(k + 1), files[k]});
  }
  write_file(folder / "modes.pvd", pvd(timed));
  if (view) write_view(modes, model, rest, scene, reach, folder);
  write_file(folder / "modes.json", json);  // last: if it exists, all else is complete
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                               \
  template std::vector<std::string> doubts_of<Dim>(const Modes<Dim>&, const Model<Dim>&);                       \
  template std::string modes_text<Dim>(const Modes<Dim>&, const Model<Dim>&);                                   \
  template std::string modes_json<Dim>(const Modes<Dim>&, const Model<Dim>&, const LoadedScene&);               \
  template void write_modes<Dim>(const Modes<Dim>&, const Model<Dim>&, const State<Dim>&, const Prepared<Dim>&, \
                                 const std::string&, bool, const std::filesystem::path&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
