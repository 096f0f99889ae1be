// What is expected of a run: for each stage its time step, duration and steps, and the numbers of the scene as it
// begins.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/model/state.hpp"

namespace voussoir {

// How a number of steps is meant: how long many blocks take to rest nobody knows before, at which angle they fail
// neither.
enum class EstimateKind { about, at_least, at_most };

struct StageForecast {
  std::string name;
  double time_step = 0;  // s; 0 when no contact determines it; of a stage that relaxes, fictitious
  double duration = 0;   // s: expected; 0 when nothing tells
  double steps = 0;      // 0 when nothing tells
  EstimateKind reckoning = EstimateKind::about;
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

}  // namespace voussoir
