// The columns of a simulation's history: time, stage, trial, values that stages change, then the monitors.
#pragma once

#include <string>
#include <vector>

#include "core/model/prepared.hpp"
#include "core/output/monitor.hpp"

namespace voussoir {

// the joint properties to which a change gives a friction angle: indices in Model::properties, ascending
template <int Dim>
std::vector<int> properties_changed(const Model<Dim>& model, const Change& change);

// Columns: time_s, stage; trial if some stage searches by trials that are undone; friction_<name>_deg of all
// joint properties whose friction some stage changes; water_<name>_level_m of each water that some stage changes
// (monitor.hpp); strength_factor if some stage searches for a factor of safety; those of the monitors.
template <int Dim>
std::vector<std::string> history_columns(const Prepared<Dim>& scene);

// Their values; `stage` from 1, trial 0: the path to the result. `ends`: the stages from which monitors measure
// (monitor.hpp).
template <int Dim>
std::vector<double> history_row(const Prepared<Dim>& scene, const Model<Dim>& model, const State<Dim>& state, int stage,
                                int trial, const std::vector<StageEnd<Dim>>& ends = {});

}  // namespace voussoir
