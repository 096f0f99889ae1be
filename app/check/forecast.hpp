// The forecast of a run: for each stage its time step, duration and steps, and the numbers of the scene at its start.
// Estimates for people, within a factor of a few.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/model/prepared.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// How a number of steps is meant: neither the time that many blocks need to reach equilibrium nor the angle at which
// they fail is known before the run.
enum class EstimateKind { about, at_least, at_most };

struct StageForecast {
  std::string name;
  double time_step = 0;  // s; 0 when no contact determines it; of a stage that relaxes, fictitious
  double duration = 0;   // s: expected; 0 if unknown
  double steps = 0;      // 0 if unknown
  EstimateKind kind = EstimateKind::about;
  // of true motion under prescribed motions: what they allow an implicit step, s; 0: there are none
  double load_step = 0;
  bool implicit = false;  // the stage takes implicit steps
  std::string damping;    // of true motion: what damps it; empty: the stage seeks equilibrium

  // evaluations of each contact by implicit steps that the loads hold
  double implicit_evaluations() const { return load_step > 0 ? evaluations_of_a_step * duration / load_step : 0; }
  static constexpr double evaluations_of_a_step =
      7.5;  // measured: three solutions of half a step, whose geometry is found again
};

struct Forecast {
  int candidates = 0;              // pairs of parts near each other at the start
  int touching = 0;                // of them
  int most_candidates = 0;         // of one block
  std::string crowded;             // the block that has them
  double candidates_allowed = 0;   // pairs; a scene with more is refused
  double memory = 0;               // bytes that a run asks for, at most
  double step_limit = 0;           // s: stability limit; infinite when no contact is near
  double overlap = 0;              // m: largest over the free bodies, each under its own weight; 0 without gravity
  double overlap_fraction = 0;     // the same over the body's smallest inscribed radius
  std::optional<BondCount> bonds;  // as a stage would make them at the start, if one makes some
  std::vector<StageForecast> stages;
};

// `model` and `state` as the first stage begins, near pairs, contacts and loads found; the estimate of the time step
// is left in it
template <int Dim>
Forecast forecast(const Prepared<Dim>& prepared, const Model<Dim>& model, State<Dim>& state);

const char* text_of(EstimateKind kind);

// inscribed radius of the smallest free block, m; 0 when none is free yet
template <int Dim>
double smallest_size(const Model<Dim>& model);

// a stage that relaxes from its first step on stops every body
bool relaxes(const StagePlan& stage, const StaticsSettings& statics);

// s: how long gravity, waters and relief loads of a stage change: equilibrium waits for the longest. Forces and motions
// change only in stages of kind run, whose duration is stated.
double ramp_of(const StagePlan& stage);

// whether any stage uses the implicit static solver (Newton-Raphson)
bool asks_for_newton(const StaticsSettings& statics, const std::vector<StagePlan>& stages);

}  // namespace voussoir
