// The top of a scene file.
#include "core/base/preset.hpp"
#include "core/scene/keys/supports.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable top_keys() {
  KeyTable top{"", {
    {.key = "title", .members = {in(&Scene::title)}, .example = "\"Sliding wedge\"",
     .meaning = "title of the scene, one line, for reports"},
    {.key = "base", .type = text, .example = "\"scene.toml\"",
     .meaning = "another scene in the same folder, from which this one states only the differences: tables are merged key by key, tables "
         "of a list by name; a stage of another kind or method replaces the base's"},
    {.key = "dimension", .members = {in(&Scene::dimension)}, .range = {2, 3}, .example = "3", .required = true,
     .meaning = "2: plane scene, x to the right, y up, unit thickness; 3: x east, y north, z up",
     .repair = "write dimension = 2 or dimension = 3"},
    {.key = "gravity", .members = {in(&Scene::gravity)}, .unit = "m/s²", .range = sane, .plausible = {.low = 1, .high = 30, .or_zero = true},
     .example = "[0, 0, -9.81]",
     .meaning = "acceleration of gravity; zero without it", .breaks = "a wrong sign lifts the blocks off",
     .mistake = "on earth it is 9.81; was it given in another unit?"},
    {.key = "density", .members = {in(&Scene::density)}, .unit = "kg/m³", .range = positive,
     .plausible = plausible_density, .example = "2600",
     .meaning = "density of every block that does not state its own", .repair = "rock has 2000 to 3000 kg/m³",
     .mistake = density_mistake},
    {.key = "domain", .type = table, .holds = {"domain"},
     .meaning = "a convex region that the joints cut into blocks"},
    {.key = "joints", .type = tables, .holds = {"joints"},
     .meaning = "planes that cut the domain, finite or infinite"},
    {.key = "joints_file", .type = text, .example = "\"joints.csv\"",
     .meaning = "a table of joints in the same folder, one per row, cut before those of [[joints]]; a [[joints]] table of the same name "
         "changes a joint; columns x_m, y_m, z_m, and dip_deg, dip_direction_deg (or strike_deg, by the right-hand rule 90 degrees "
         "less) or normal_x, normal_y, normal_z; optionally name, set, properties, shape with length_m and width_m or "
         "corners_m. The scene that names the file states its dimension"},
    {.key = "joint_sets", .type = tables, .holds = {"joint_sets"},
     .meaning = "random joints that fill the domain, cut after [[joints]], set by set; every set is drawn independently and gives the same "
         "joints on every platform"},
    {.key = "excavations", .type = tables, .holds = {"excavations", "region"},
     .meaning = "convex regions: blocks of the domain whose centroids are inside are excavated before the first stage, or by the stage "
         "that names the excavation in excavate"},
    {.key = "joint_properties", .type = tables, .holds = {"joint_properties"},
     .meaning = "stiffness and strength of joints, by name; `default`, or else the first table, also applies to contacts between faces "
         "that no joint made"},
    {.key = "blocks", .type = tables, .holds = {"blocks"},
     .meaning = "blocks given directly, by exactly one of vertices, planes or box"},
    {.key = "blocks_file", .type = text, .example = "\"blocks.obj\"",
     .meaning = "a file of convex blocks in the same folder: .csv of planes (columns block, normal_x, normal_y, normal_z, "
         "offset_m; optionally part), .stl or .obj; [[blocks]] of the same name may add density, fixed, …"},
    {.key = "repeat", .type = tables, .holds = {"label", "copies"},
     .meaning = "copies of blocks, joints or bolts at equal steps, shifted, rotated or both: an arch from one stone"},
    {.key = "water", .type = tables, .holds = {"water", "water_surface"},
     .meaning = "water in joints and around blocks: its pressure acts on their faces and their total weight on their mass, so that contact "
         "forces are effective. It is at rest: no flow, no drag, no added mass"},
  }};
  for (KeyRow& row : support_rows())
    top.rows.push_back(std::move(row));
  for (KeyRow& row : statics_rows())
    top.rows.push_back(std::move(row));
  const std::vector<KeyRow> others{
    {.key = "fix", .type = tables, .holds = {"label", "selector"}, .meaning = "blocks that never move"},
    {.key = "restrain", .type = tables, .holds = {"label", "restrain", "selector"},
     .meaning = "blocks that cannot move in some directions (world axes)"},
    {.key = "initial_velocity", .type = tables, .holds = {"label", "motion", "selector"},
     .meaning = "blocks that move when the first stage begins"},
    {.key = "preset", .type = choice, .example = "\"thesis\"", .choices = {presets.begin(), presets.end()},
     .meaning = "numerical choices that the scene does not state; standard (taken without this key): Newton's method, integrated faces, "
         "4 sub_contacts in joints that cannot be integrated, failure by the required strength, error bars with the joints' stiffness; thesis: none of these, the "
         "defaults of each key, with which the cases are verified. `voussoir check` lists what it sets",
     .breaks = "thesis: one contact point a face resists neither spin nor rocking"},
    {.key = "accuracy", .type = table, .holds = {"accuracy"},
     .meaning = "numerical settings for a required accuracy"},
    {.key = "contact", .members = {group(&Settings::contact, "contact")},
     .meaning = "computation of contacts between blocks"},
    {.key = "damping", .members = {group(&Settings::damping, "damping")},
     .meaning = "damping of every stage without its own"},
    {.key = "time", .members = {group(&Settings::time, "time")}, .meaning = "the time step"},
    {.key = "equilibrium", .members = {group(&Settings::equilibrium, "equilibrium")},
     .meaning = "criterion of equilibrium"},
    {.key = "slicing", .members = {group(&Scene::slicing, "slicing")}, .meaning = "bounds and order of the cuts"},
    {.key = "stage", .type = tables, .holds = {"stage"},
     .meaning = "stages of the run, in this order; at least one"},
    {.key = "monitors", .type = tables, .holds = {"monitors", "selector"},
     .meaning = "quantities written to history.csv: of one block that a selector chooses, or of a joint's contacts"},
    {.key = "output", .members = {group(&Scene::output, "output")},
     .meaning = "frequency and kinds of output"},
  };
  top.rows.insert(top.rows.end(), others.begin(), others.end());
  return top;
}
// clang-format on

}  // namespace voussoir::keys
