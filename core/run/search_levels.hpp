// The searched quantity, from a stable to a failed level, and its names in messages: a friction angle decreases, a
// factor increases.
#pragma once

#include <string>

#include "core/base/settings.hpp"

namespace voussoir {

struct Levels {
  Searched searched;
  double from, to, tolerance, step;  // rad or 1
  double direction;                  // of failure
  double unit;                       // of a level in messages
  const char *symbol, *name;         // of that unit; of the keys
  const char *start, *end;           // repairs of a search in the wrong place
  const char *towards, *one;

  // "33.4 deg"
  std::string text(double level) const;
  // the one of two that is nearer to stability
  double safer(double a, double b) const;

  // tan φ, or the inverse of a factor: in it the strength that a motion requires is a sum, and a search goes down
  double strength(double level) const;
  double level_of(double strength) const;
};

Levels levels_of(const ReducePlan& plan);

}  // namespace voussoir
