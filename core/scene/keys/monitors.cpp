// [[monitors]]
#include "core/scene/keys/tables.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir::keys {

namespace {

Words<Monitored> words() {
  Words<Monitored> words;
  for (const Monitored& followed : monitored_quantities())
    words.emplace_back(followed.word, followed);
  return words;
}

}  // namespace

// clang-format off
KeyTable monitor_keys() {
  return {"monitors", {
    {.key = "name", .members = {in(&MonitorSpec::name, name)}, .example = "\"wedge\"", .required = true,
     .meaning = "unique among the monitors; begins its columns in history.csv"},
    {.key = "quantities", .members = {some_of(&MonitorSpec::quantities, words())},
     .example = "[\"displacement\", \"rotation\"]", .required = true,
     .meaning = "contact_force: resultant over the contacts of a joint, which `joint` names; whole_bonds: how many of its bonds are whole; level: of the water that `water` names; bolt_force: the largest and the mean force of the springs of the bolts that `bolts` names, of one bolt, and how many have yielded and broken; lining_force: of the lining that `lining` names thrust (compression positive), shear force and moment (sagging positive) at the node next to each of angles_deg, or without it the largest of each and the largest use of its strength; convergence: how far the wall of the opening that `excavation` names has moved inwards; the others: of one block that a "
         "selector chooses; …_load: what acts on it from one source, applied_load by stage.force, water_load by water; velocities are those of half a step before"},
    {.key = "over", .members = {one_of(&MonitorSpec::over, {{"one", Aggregate::one}, {"sum", Aggregate::sum}, {"mean", Aggregate::mean}})},
     .example = "\"mean\"",
     .meaning = "of the blocks that the selector chooses; one: it chooses exactly one; sum, mean: over all that are not "
         "excavated, those apart that an excavation parts from them"},
    {.key = "joint", .members = {in(&MonitorSpec::joint, name)}, .example = "\"A\"",
     .meaning = "joint of contact_force and whole_bonds"},
    {.key = "bolts", .members = {in(&MonitorSpec::bolts, name)}, .example = "\"roof\"",
     .meaning = "bolts of bolt_force"},
    {.key = "lining", .members = {in(&MonitorSpec::lining, name)}, .example = "\"shell\"",
     .meaning = "lining of lining_force"},
    {.key = "water", .members = {in(&MonitorSpec::water, name)}, .example = "\"lake\"",
     .meaning = "water of level: its elevation, that of each point of a table, at the scene's middle of a plane; or its pressure"},
    {.key = "excavation", .members = {in(&MonitorSpec::excavation, name)}, .example = "\"tunnel\"",
     .meaning = "opening of convergence, by name: a cylinder, in the plane also a box"},
    {.key = "angles_deg", .members = {in(&MonitorSpec::angles, numbers)}, .unit = "deg", .range = {-360, 360},
     .example = "[0, 180]",
     .meaning = "of convergence: the points where rays from the opening's centre meet the rock, counter-clockwise from the "
         "x axis; in space across the middle of the axis, as a fan's. A point moves with its block, which is told when the opening has been taken out; with over = \"sum\" two "
         "opposite points give the closure, with \"one\" each point has a column"},
    {.key = "since", .members = {in(&MonitorSpec::since, name)}, .example = "\"stress\"",
     .meaning = "displacement, rotation and convergence are counted from the end of this stage, and are 0 until then; "
         "without it, and without since_start, from the start"},
    {.key = "since_start", .members = {in(&MonitorSpec::since_start, name)}, .example = "\"dig\"",
     .meaning = "likewise from the start of this stage, before it digs or changes anything; this or since"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
