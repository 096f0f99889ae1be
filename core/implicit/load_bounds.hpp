// What the loads of a model allow an implicit step.
#pragma once

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// s: 1/40 of the shortest period of a prescribed motion, an entering wave or a force, 1/20 of the shortest interval of
// their tables, the interval of a record; infinity: nothing changes
template <int Dim>
double step_of_loads(const Model<Dim>& model);

// The same of motions and entering waves that a stage states.
double step_of_loads(const Change& change);

// s: the next time at which a table of the loads bends, or a record has a value
template <int Dim>
double next_bend(const Model<Dim>& model, const Schedule& schedule);

// s: the next time at which the scene asks for output; infinity: it states no interval
double next_output(const TimeSettings& time, double now);

}  // namespace voussoir
