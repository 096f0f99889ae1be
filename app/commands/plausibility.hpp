// What follows from a scene's numbers before anything is run: time step, overlap under own weight, steps to expect, and
// what looks wrong. Estimates for people, within a factor of a few.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/run_scene.hpp"

namespace voussoir {

// How a number of steps is meant: how long many blocks take to rest nobody knows before, at which angle they fail
// neither.
enum class Reckoning { about, at_least, at_most };

const char* text_of(Reckoning reckoning);

struct StageForecast {
  std::string name;
  double time_step = 0;  // s; 0 when no contact determines it; of a stage that relaxes, fictitious
  double duration = 0;   // s: expected; 0 when nothing tells
  double steps = 0;      // 0 when nothing tells
  Reckoning reckoning = Reckoning::about;
};

struct Plausibility {
  int candidates = 0;              // pairs of parts near each other at the start
  int touching = 0;                // of them
  int most_candidates = 0;         // of one block
  std::string crowded;             // the block that has them
  double candidates_allowed = 0;   // pairs, beyond which a scene is refused
  double memory = 0;               // bytes that a run asks for, at most
  double step_limit = 0;           // s: stability limit; infinite when no contact is near
  double overlap = 0;              // m: largest over the free bodies, each carrying its own weight; 0 without gravity
  double overlap_fraction = 0;     // the same over the body's smallest inscribed radius
  std::optional<BondCount> bonds;  // as a stage would make them at the start, where one makes some
  std::vector<StageForecast> stages;
  std::vector<std::string> warnings;  // one line each, with the repair
};

// whether any stage comes to rest by Newton's method on the joints
bool asks_for_newton(const DampingSettings& damping, const std::vector<StagePlan>& stages);

// The scene's own warnings come first, then those that follow from the numbers.
Plausibility assess(const LoadedScene& scene);

}  // namespace voussoir
