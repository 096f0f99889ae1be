// [[joint_sets]]
#include "core/scene/keys/tables.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable joint_set_keys() {
  return {"joint_sets", {
    {.key = "name", .members = {in(&JointSet::name, name)}, .example = "\"bedding\"", .required = true,
     .meaning = "unique among the sets; its joints are bedding-1, bedding-2, …"},
    {.key = "dip", .members = {degrees(&PlaneSpec::dip)}, .unit = "deg", .range = dip_range,
     .plausible = plausible_dip, .example = "30", .required = true,
     .meaning = "dip of the mean plane, below the horizontal", .repair = dip_repair, .mistake = angle_mistake},
    {.key = "dip_direction", .members = {degrees(&PlaneSpec::dip_direction)}, .unit = "deg", .range = direction_range,
     .plausible = plausible_direction, .example = "90", .no_default = true,
     .meaning = dip_direction_meaning, .repair = direction_repair, .mistake = angle_mistake},
    {.key = "spacing", .members = {in(&JointSet::spacing)}, .unit = "m", .range = positive, .plausible = {0.05, 500},
     .example = "2",
     .meaning = "mean distance between joints along the normal of the mean plane; either this or intensity",
     .mistake = "was it given in mm?"},
    {.key = "intensity", .members = {in(&JointSet::intensity)}, .unit = "1/m", .range = positive,
     .plausible = {0.01, 20}, .example = "0.5",
     .meaning = "area of joints per volume, P32 (2-D: length per area, P21); either this or spacing"},
    {.key = "scatter", .members = {one_of(&JointSet::scatter,
         {{"none", Scatter::none}, {"fisher", Scatter::fisher}, {"normal", Scatter::normal}})},
     .example = "\"normal\"",
     .meaning = "distribution of the orientation; fisher: of the poles about the mean (3-D); normal: of dip and dip direction, each by "
         "itself"},
    {.key = "fisher_constant", .members = {in(&JointSet::fisher_constant)}, .unit = "1", .range = {1e-3, 1e6},
     .plausible = {3, 1000}, .example = "100", .required = true, .when = {"scatter", "fisher"},
     .meaning = "half of the poles lie within acos(1 + ln(0.5)/constant) of the mean: 6.7 degrees for 100"},
    {.key = "dip_deviation_deg", .members = {degrees(&JointSet::dip_deviation)}, .unit = "deg", .range = {0, 30},
     .plausible = plausible_scatter, .example = "5", .required = true, .when = {"scatter", "normal"},
     .meaning = "standard deviation of the dip (2-D: of the trace's angle)"},
    {.key = "dip_direction_deviation_deg", .members = {degrees(&JointSet::dip_direction_deviation)}, .unit = "deg",
     .range = {0, 30}, .plausible = plausible_scatter, .example = "5", .when = {"scatter", "normal"},
     .meaning = "standard deviation of the dip direction; 3-D only"},
    {.key = "size", .members = {one_of(&JointSet::size_law,
         {{"persistent", SizeLaw::persistent}, {"constant", SizeLaw::constant},
          {"exponential", SizeLaw::exponential}, {"lognormal", SizeLaw::lognormal}})},
     .example = "\"persistent\"",
     .meaning = "law of the extent along the strike (2-D: of the trace); persistent: joints never end",
     .breaks = "joints of all sizes also enter the domain from outside, as in unbounded rock: there is no edge effect"},
    {.key = "size_mean", .members = {in(&JointSet::size_mean)}, .unit = "m", .range = size_range,
     .plausible = {0.1, 1000}, .example = "5", .required = true, .when = {"size", "constant|exponential|lognormal"},
     .meaning = "mean of the size (not of its logarithm): the full extent along the strike"},
    {.key = "size_deviation", .members = {in(&JointSet::size_deviation)}, .unit = "m", .range = size_range,
     .plausible = {0.02, 500}, .example = "1", .required = true, .when = {"size", "lognormal"},
     .meaning = "standard deviation of the size (not of its logarithm)"},
    {.key = "shape", .members = {one_of(&JointSet::shape,
         {{"ellipse", OutlineForm::ellipse}, {"rectangle", OutlineForm::rectangle}})},
     .example = "\"rectangle\"", .when = {"size", "constant|exponential|lognormal"},
     .meaning = "outline of finite joints; 3-D only"},
    {.key = "elongation", .members = {in(&JointSet::elongation)}, .unit = "1", .range = {0.01, 100}, .example = "0.5",
     .when = {"size", "constant|exponential|lognormal"},
     .meaning = "extent down the dip over extent along the strike; 1: discs and squares; 3-D only"},
    {.key = "persistence", .members = {in(&JointSet::persistence)}, .unit = "1", .range = {0, 1, true},
     .plausible = {0.01, 1}, .example = "0.6", .when = {"size", "constant|exponential|lognormal"},
     .meaning = "with spacing: the spacing is that of planes, and this fraction of their area is joint (Einstein et al. 1983); 1: the "
         "spacing is that of the joints along the mean normal"},
    {.key = "arrangement", .members = {one_of(&JointSet::arrangement,
         {{"poisson", Arrangement::poisson}, {"equal", Arrangement::equal}})},
     .example = "\"equal\"", .when = {"size", "persistent"},
     .meaning = "poisson: random positions, exponential spacings; equal: equal spacings from a random position, or with one joint through "
         "`point`"},
    {.key = "point", .members = {in(&JointSet::point)}, .unit = "m", .range = sane, .example = "[0, 0, 2]",
     .when = {"arrangement", "equal"},
     .meaning = "one joint of the set passes through it, the others are at equal distances from it; only without scatter"},
    {.key = "seed", .members = {in(&JointSet::seed)}, .range = {0, 1e15}, .example = "7",
     .meaning = "another seed gives another sample; sets of different names are independent even with the same seed"},
    {.key = "within", .type = table, .holds = {"region"},
     .meaning = "subdomain to which its joints are confined, as in [[joints]]"},
    {.key = "properties", .members = {in(&JointSetSpec::properties, name)}, .example = "\"rock\"",
     .meaning = "as in [[joints]]"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
