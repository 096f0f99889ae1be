// The step's last line: where the loads take the bodies.
#pragma once

#include "core/model.hpp"
#include "core/settings.hpp"
#include "core/state.hpp"

namespace voussoir {

// gravity that grows lifts or lowers the potential energy of what has already moved: counted where it is
template <int Dim>
void add_gravity_ramp(const Model<Dim>& model, State<Dim>& state);

// a time step that today's contacts allow, then velocities, then positions
template <int Dim>
void move_bodies(const Model<Dim>& model, const Settings& settings, State<Dim>& state);

}  // namespace voussoir
