// [contact]
#include "core/base/settings.hpp"
#include "core/scene/keys/tables.hpp"

namespace voussoir::keys {

// clang-format off
KeyTable contact_keys() {
  return {"contact", {
    {.key = "point", .members = {one_of(&ContactSettings::point,
         {{"analytic_centre", ContactPoint::analytic_centre}, {"centroid", ContactPoint::centroid},
          {"chebyshev", ContactPoint::chebyshev}, {"central_path", ContactPoint::central_path}})},
     .example = "\"central_path\"",
     .meaning = "point of the overlap at which the contact force acts: analytic centre, centroid, centre of the largest inscribed ball, or "
         "a smooth point of the central path",
     .breaks = "the centroid costs more; the Chebyshev point is cheaper but jumps"},
    {.key = "normal", .members = {one_of(&ContactSettings::normal,
         {{"potential", ContactNormal::potential}, {"multipliers", ContactNormal::multipliers}})},
     .example = "\"multipliers\"",
     .meaning = "contact normal and overlap: from potential particles, as published, or from the multipliers of the linear program, which "
         "with point = \"central_path\" and constant_stiffness conserve energy but are softer at edges. Between bodies of shape = "
         "\"potential\" multipliers give the conservative overlap",
     .breaks = "potential loses or creates energy when edges slide; multipliers cost more; with chebyshev, the contact point of faces "
         "jumps from corner to corner"},
    {.key = "smoothing", .members = {in(&ContactSettings::smoothing)}, .unit = "1", .range = {0, 1e-2, true},
     .plausible = {1e-5, 3e-3}, .example = "1e-3",
     .meaning = "parameter of point = \"central_path\", times the smaller inscribed radius",
     .breaks = "too small: the force jumps from corner to corner; too large: overlaps grow, by some 10 to 30 times its value"},
    {.key = "overlap", .members = {one_of(&ContactSettings::overlap,
         {{"closed_form", OverlapSearch::closed_form}, {"bracketing", OverlapSearch::bracketing}})},
     .example = "\"bracketing\"",
     .meaning = "search for the two ends of the overlap along the normal",
     .breaks = "bracketing is slow, a reference only"},
    {.key = "face", .members = {one_of(&ContactSettings::face,
         {{"point", ContactFace::point}, {"integrated", ContactFace::integrated}})},
     .example = "\"integrated\"",
     .meaning = "contact of a joint of constant stiffness per area; point: one contact point, or the sub_contacts of its joint_properties; "
         "integrated: the stress integrated over the face: no normal is chosen, force and moment have a potential, faces resist twist",
     .breaks = "integrated costs more if corners and edges touch; joints with other laws or bonds keep their contact points"},
    {.key = "tolerance", .members = {in(&ContactSettings::tolerance)}, .unit = "1", .range = {0, 1e-3},
     .plausible = {.low = 1e-14, .high = 5e-11, .or_zero = true}, .example = "1e-12",
     .meaning = "two blocks touch when they overlap by more than this times the smaller inscribed radius, and by more than the rounding "
         "error (at most 64 ulp of the pair's size)",
     .breaks = "below 1e-14 it is less than rounding; far above, contacts are found late"},
    {.key = "potential_radius", .members = {in(&ContactSettings::potential_radius)}, .unit = "1",
     .range = {0, 1, true}, .plausible = {1e-3, 0.2}, .example = "0.01",
     .meaning = "rounding of edges for the contact normal, times the smaller inscribed radius",
     .breaks = "must exceed the overlap; large values tilt the normal of face contacts near an edge"},
    {.key = "newton_tolerance", .members = {in(&ContactSettings::newton_tolerance)}, .unit = "1",
     .range = {0, 0.1, true}, .plausible = {1e-10, 1e-3}, .example = "1e-8",
     .meaning = "the search for the centre stops when the Newton decrement is below this",
     .breaks = "1e-3 leaves an error of 1e-6 of the overlap, 1e-5 one of 1e-9; 0.1 leaves visible noise"},
    {.key = "newton_limit", .members = {in(&ContactSettings::newton_limit)}, .unit = "1", .range = {1, 1e6},
     .plausible = {20, 1e4}, .example = "400",
     .meaning = "largest number of iterations of that search",
     .breaks = "a search that needs more ends the run as failed"},
    {.key = "skin", .members = {in(&ContactSettings::skin)}, .unit = "1", .range = {0, 100, true},
     .plausible = {0.01, 2}, .example = "0.2",
     .meaning = "blocks closer than this times the smallest inscribed radius are kept in the list of neighbours",
     .breaks = "changes the cost, never the result"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
