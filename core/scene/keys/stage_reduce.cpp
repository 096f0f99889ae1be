// [[stage]]: keys of the kind reduce.
#include "core/base/settings.hpp"
#include "core/scene/keys/tables.hpp"

namespace voussoir::keys {
namespace {

// Two levels of a search this far apart still differ by a hundred rounding errors or more, so that bisection and steps
// terminate.
constexpr Range tolerance_range{1e-10, 90}, factor_tolerance_range{1e-10, 1000};

}  // namespace

// clang-format off
KeyTable stage_reduce_keys() {
  return {"stage", {
    {.key = "method", .members = {one_of(&ReducePlan::method,
         {{"bisection", ReductionMethod::bisection}, {"steps", ReductionMethod::steps},
          {"rate", ReductionMethod::rate}, {"two_rates", ReductionMethod::two_rates}})},
     .example = "\"steps\"", .when = {"kind", "reduce"},
     .meaning = "bisection: halve the bracket, each trial from the last stable state; steps: reduce in steps, each to equilibrium; rate: "
         "reduce continuously; two_rates: the same at two rates from one equilibrium, extrapolated to zero rate"},
    {.key = "search", .members = {one_of(&ReducePlan::searched,
         {{"friction", Searched::friction}, {"factor", Searched::factor}})},
     .example = "\"factor\"", .when = {"kind", "reduce"},
     .meaning = "friction: the critical friction angle, the same for all the properties; factor: the factor of safety F, by which tan φ "
         "and cohesion of the properties are divided (a bonded joint of area A supports cA/F + tan φ/F times its normal force, its tensile "
         "strength is unchanged), by bisection or in steps. φ is the friction angle that this stage states, else that of the "
         "joint_properties, never one that an earlier stage has set: if one has, and this stage states none, the scene is refused"},
    {.key = "joint_properties", .members = {in(&ReducePlan::properties)}, .example = "[\"rock\"]",
     .when = {"kind", "reduce"},
     .meaning = "the properties whose strength is reduced; all without it"},
    {.key = "from_deg", .members = {degrees(&ReducePlan::from)}, .unit = "deg", .range = friction_range,
     .plausible = plausible_friction, .example = "60", .required = true, .when = {"search", "friction"},
     .meaning = "friction angle at the start; the model must be stable there", .mistake = friction_mistake},
    {.key = "to_deg", .members = {degrees(&ReducePlan::to)}, .unit = "deg", .range = friction_range,
     .plausible = {1, 85}, .example = "5", .required = true, .when = {"search", "friction"},
     .meaning = "friction angle at which the search ends", .mistake = friction_mistake},
    {.key = "tolerance_deg", .members = {degrees(&ReducePlan::tolerance)}, .unit = "deg", .range = tolerance_range,
     .plausible = {5e-4, 5}, .example = "0.01", .required = true, .when = {"method", "bisection"},
     .and_when = {"search", "friction"},
     .meaning = "largest width of the bracket at the end"},
    {.key = "step_deg", .members = {degrees(&ReducePlan::step)}, .unit = "deg", .range = tolerance_range,
     .plausible = {0.02, 5}, .example = "0.5", .required = true, .when = {"method", "steps"},
     .and_when = {"search", "friction"},
     .meaning = "decrement"},
    {.key = "from_factor", .members = {in(&FactorPlan::from)}, .unit = "1", .range = factor_range,
     .plausible = plausible_strength, .example = "0.5", .required = true, .when = {"search", "factor"},
     .meaning = "factor at the start; the model must be stable there: below 1 if it is unstable at its own strength"},
    {.key = "to_factor", .members = {in(&FactorPlan::to)}, .unit = "1", .range = factor_range,
     .plausible = plausible_strength, .example = "3", .required = true, .when = {"search", "factor"},
     .meaning = "factor at which the search ends"},
    {.key = "tolerance_factor", .members = {in(&FactorPlan::tolerance)}, .unit = "1", .range = factor_tolerance_range,
     .plausible = {5e-5, 0.5}, .example = "0.001", .required = true, .when = {"method", "bisection"},
     .and_when = {"search", "factor"},
     .meaning = "largest width of the bracket at the end"},
    {.key = "step_factor", .members = {in(&FactorPlan::step)}, .unit = "1", .range = factor_tolerance_range,
     .plausible = {1e-3, 0.5}, .example = "0.01", .required = true, .when = {"method", "steps"},
     .and_when = {"search", "factor"},
     .meaning = "increment"},
    {.key = "rate_deg_per_s", .members = {degrees(&ReducePlan::rate)}, .unit = "deg/s", .range = {0, 1e6, true},
     .plausible = {1e-3, 1}, .example = "0.025", .required = true, .when = {"method", "rate|two_rates"},
     .meaning = "speed of reduction; two_rates: the faster one",
     .breaks = "too fast: failure is found late; the error grows with the power 2/3 of the rate"},
    {.key = "slower_rate_deg_per_s", .members = {degrees(&ReducePlan::slower_rate)}, .unit = "deg/s",
     .range = {0, 1e6, true}, .plausible = {1e-3, 1}, .example = "0.02", .required = true,
     .when = {"method", "two_rates"},
     .meaning = "the slower speed of reduction",
     .breaks = "close to the faster one: the extrapolation magnifies small differences"},
    {.key = "failure_displacement", .members = {in(&ReducePlan::failure_displacement)}, .unit = "m",
     .range = not_negative, .plausible = {.low = 1e-4, .high = 30, .or_zero = true}, .example = "0.01",
     .when = {"kind", "reduce"},
     .meaning = "a block that has moved this far since the search began (rate, two_rates: since the reduction began) has failed; 0: a "
         "tenth of the smallest inscribed radius of the free blocks, or the longest slip over which the strength of a joint changes, if that is "
         "more: softening_slip_m, cohesion_slip_m, twice the slip at the peak of Barton and Bandis' table",
     .breaks = "must exceed the elastic settlement; too large: trials take a long time", .mistake = "was it given in mm?"},
    {.key = "failure_criterion", .members = {one_of(&ReducePlan::criterion,
         {{"required_strength", FailureCriterion::required_strength}, {"displacement", FailureCriterion::displacement}})},
     .example = "\"displacement\"", .when = {"kind", "reduce"},
     .meaning = "required_strength: a trial has failed when the strength that its own motion requires falls in a straight "
         "line after ten elastic displacements, and the result is this strength at no displacement (bisection; a stated "
         "failure_displacement takes its place); displacement: when a block has moved by failure_displacement"},
    {.key = "failure_fraction", .members = {in(&ReducePlan::failure_fraction)}, .unit = "1", .range = {0, 1},
     .plausible = {.low = 0.005, .high = 0.9, .or_zero = true}, .example = "0.1", .when = {"kind", "reduce"},
     .meaning = "fraction of the mass of all free blocks that must have moved by failure_displacement, so that a single loose block does "
         "not end the search, and may keep moving while the others are in equilibrium. 0: any block",
     .breaks = "too large: a failure of fewer blocks is never found"},
    {.key = "ramp_steps", .members = {in(&ReducePlan::ramp_steps)}, .unit = "steps", .range = count,
     .plausible = {20, 1e5}, .example = "2000", .when = {"method", "bisection|steps|two_rates"},
     .meaning = "number of steps in which a trial reduces the strength; two_rates: before the slower one",
     .breaks = "too few: the sudden change causes failure by inertia"},
    {.key = "follow_steps", .members = {in(&ReducePlan::follow_steps)}, .unit = "steps", .range = not_negative,
     .plausible = {.low = 1000, .high = 1e7, .or_zero = true}, .example = "100000", .when = {"method", "bisection"},
     .meaning = "number of steps in which the last failed trial is followed beyond its failure, to report after which displacement it "
         "comes to rest again; 0: it is not followed",
     .breaks = "a slide without end costs all of them"},
  }};
}
// clang-format on

}  // namespace voussoir::keys
