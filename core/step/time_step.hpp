// The stable time step (core/README.md, "The step").
#pragma once

#include <optional>

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

struct TimeStepEstimate {
  double limit = 0;  // s: 2/sqrt(λ) with damping accounted for; infinity when no contact is near
  double step = 0;   // s: what the settings make of it; 0 when neither a contact nor the settings give one
};

// an area may grow by this factor before the step must be estimated again: `step` leaves room for it
inline constexpr double area_margin = 1.1;

// Steps between two looks at every body's stiffness. They see what got softer, while contacts that got stiffer ask for
// it themselves. A look costs as much as some steps, so a hundredth of them.
inline constexpr int steps_between_looks = 100;

// λ = max over free bodies of λ_max(M⁻¹ Σ f J^T K J) over the body's 3 or 6 freedoms, lever arms included; f = 2 where
// both bodies are free: between 1/√2 and 1 of the true limit. λ_max is taken by a bound: where several modes of a body
// are equally stiff, the limit comes out shorter by up to 3 %, mostly by less than 0.1 %. Contacts that touch count
// with their area; pairs that are near each other (contact/nearness) but do not touch, with the smaller of the two
// parts' largest faces at the lever arm of the body's radius, so that a first impact is safe. Notes each contact's
// rated area and each body's stiffest frequency.
template <int Dim>
TimeStepEstimate estimate_time_step(const Model<Dim>& model, const Settings& settings, const DampingSettings& damping,
                                    const BodiesState<Dim>& bodies, const LoadsState<Dim>& loads,
                                    ContactsState<Dim>& contacts, TimeStep& time_step);

// The same, again only for bodies at a contact that is stiffer than it was rated, or new; the others keep their
// frequency. In a pile some contact grows at nearly every step, but few do. Nothing when none has grown; every body
// when there is no estimate yet.
template <int Dim>
std::optional<TimeStepEstimate> renew_time_step(const Model<Dim>& model, const Settings& settings,
                                                const DampingSettings& damping, const BodiesState<Dim>& bodies,
                                                const LoadsState<Dim>& loads, ContactsState<Dim>& contacts,
                                                TimeStep& time_step);

// throws std::domain_error when nothing has determined the step allowed
void demand_time_step(const TimeStep& time_step);

}  // namespace voussoir
