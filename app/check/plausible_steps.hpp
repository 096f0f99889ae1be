// How long the ramps of a stage take, limits that end it before, and the time step that is stated.
#pragma once

#include <string>
#include <vector>

#include "app/check/forecast.hpp"

namespace voussoir {

// s: how long gravity, waters and relief loads of a stage change: rest waits for the longest. Forces and motions change
// in stages of kind run alone, whose duration is stated.
double ramp_of(const StagePlan& stage);

// Limits of steps within which neither the ramps nor rest can be reached.
void judge_limits(const StagePlan& stage, const Settings& settings, const StageForecast& forecast,
                  std::vector<std::string>& warnings);

// beside the stability limit
void judge_stated_step(const TimeSettings& time, Plausibility& result);

}  // namespace voussoir
