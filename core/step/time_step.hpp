// The stable time step (core/README.md, "The step").
#pragma once

#include <optional>

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

struct TimeStepEstimate {
  double limit = 0;  // s: 2/sqrt(λ) with damping accounted for; infinity when no contact is near
  double step = 0;   // s: by the settings; 0 if neither a contact nor the settings give one
};

// an area may grow by this factor before the step must be estimated again: `step` has this margin
inline constexpr double area_margin = 1.1;

// Steps between two updates of every body's stiffness. Updates detect softening, while stiffer contacts trigger one
// themselves. An update costs as much as some steps, so it is made once in this number.
inline constexpr int steps_between_looks = 100;

// λ = max over free bodies of λ_max(M⁻¹ Σ f J^T K J) over the body's 3 or 6 freedoms, lever arms included; f = 2 if
// both bodies are free: between 1/√2 and 1 of the true limit. λ_max is replaced by an upper bound: if several modes of
// a body are equally stiff, the limit is too short by up to 3 %, mostly by less than 0.1 %. Contacts that touch count
// with their area; pairs that are near each other (contact/nearness) but do not touch, with the smaller of the two
// parts' largest faces at the lever arm of the body's radius, so that a first impact is safe. Notes each contact's
// rated area and each body's stiffest frequency.
template <int Dim>
TimeStepEstimate estimate_time_step(const Model<Dim>& model, const Settings& settings, const DampingSettings& damping,
                                    const BodiesState<Dim>& bodies, const LoadsState<Dim>& loads,
                                    ContactsState<Dim>& contacts, TimeStep& time_step);

// The same, only for bodies at a contact that is stiffer than its rating, or new; the others keep their frequency. In a
// pile a few contacts grow at nearly every step. Nothing if none has grown; every body if there is no estimate yet.
template <int Dim>
std::optional<TimeStepEstimate> renew_time_step(const Model<Dim>& model, const Settings& settings,
                                                const DampingSettings& damping, const BodiesState<Dim>& bodies,
                                                const LoadsState<Dim>& loads, ContactsState<Dim>& contacts,
                                                TimeStep& time_step);

// throws std::domain_error if nothing determines the allowed step
void demand_time_step(const TimeStep& time_step);

}  // namespace voussoir
