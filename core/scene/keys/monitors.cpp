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
     .meaning = "contact_force: resultant over the contacts of the joint named by `joint`; whole_bonds: number of its intact bonds; level: "
         "of the water named by `water`; bolt_force: largest and mean force of the springs of the bolts named by `bolts`, per bolt, and "
         "the numbers of yielded and broken ones; lining_force: thrust (compression positive), shear force and moment (sagging positive) "
         "of the lining named by `lining`, at the node nearest to each of angles_deg, or without it the largest of each and the largest "
         "utilisation; convergence: inward displacement of the wall of the opening named by `excavation`; the others: of one block that a "
         "selector chooses; …_load: force on it from one source, applied_load from stage.force, water_load from water; velocities are "
         "those half a step earlier"},
    {.key = "over", .members = {one_of(&MonitorSpec::over, {{"one", Aggregate::one}, {"sum", Aggregate::sum}, {"mean", Aggregate::mean}})},
     .example = "\"mean\"",
     .meaning = "how the values of the chosen blocks are combined; one: the selector chooses exactly one block; sum, mean: over all that "
         "are not excavated, without the parts that an excavation cuts off them"},
    {.key = "joint", .members = {in(&MonitorSpec::joint, name)}, .example = "\"A\"",
     .meaning = "joint of contact_force and whole_bonds"},
    {.key = "bolts", .members = {in(&MonitorSpec::bolts, name)}, .example = "\"roof\"",
     .meaning = "bolts of bolt_force"},
    {.key = "lining", .members = {in(&MonitorSpec::lining, name)}, .example = "\"shell\"",
     .meaning = "lining of lining_force"},
    {.key = "water", .members = {in(&MonitorSpec::water, name)}, .example = "\"lake\"",
     .meaning = "water of level: its elevation (of a table that of each point, of a plane that at the middle of the scene), or its "
         "pressure"},
    {.key = "excavation", .members = {in(&MonitorSpec::excavation, name)}, .example = "\"tunnel\"",
     .meaning = "opening of convergence, by name: a cylinder, in 2-D also a box"},
    {.key = "angles_deg", .members = {in(&MonitorSpec::angles, numbers)}, .unit = "deg", .range = {-360, 360},
     .example = "[0, 180]",
     .meaning = "for convergence: directions of rays from the opening's centre to points of the rock wall, counter-clockwise from the x "
         "axis; in 3-D perpendicular to the axis at its middle, as for a fan. A point moves with its block, which is determined at the "
         "excavation of the opening; with over = \"sum\" two opposite points give the convergence of the diameter, with \"one\" each point "
         "has a column"},
    {.key = "since", .members = {in(&MonitorSpec::since, name)}, .example = "\"stress\"",
     .meaning = "displacement, rotation and convergence are measured from the end of this stage, and are 0 until then; without it, and "
         "without since_start, from the start of the run"},
    {.key = "since_start", .members = {in(&MonitorSpec::since_start, name)}, .example = "\"dig\"",
     .meaning = "likewise from the start of this stage, before its excavations and other changes; either this or since"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
