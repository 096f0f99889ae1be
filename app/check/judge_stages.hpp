// Warnings about the stages' damping, durations, limits and time steps, and about the intervals of output, before a
// run.
#pragma once

#include <string>
#include <vector>

#include "app/check/forecast.hpp"
#include "core/model/prepared.hpp"

namespace voussoir {

// `overlap`, `smallest`, m: of a free block under its own weight, and its inscribed radius
void judge_stage(const StagePlan& stage, const Settings& settings, double overlap, double smallest,
                 std::vector<std::string>& warnings);

// a stated time step against the stability limit, s
void judge_stated_step(const TimeSettings& time, double limit, std::vector<std::string>& warnings);

// Intervals that no stage reaches, if all stages state their duration: the duration of a stage that seeks equilibrium,
// and its fictitious time, are not known before.
void judge_intervals(const std::vector<StagePlan>& stages, const OutputPlan& output,
                     std::vector<std::string>& warnings);

// Steps, limits and times of all stages against their forecast.
template <int Dim>
void judge_durations(const Prepared<Dim>& prepared, const Model<Dim>& model, const Forecast& forecast,
                     std::vector<std::string>& warnings);

}  // namespace voussoir
