// The searched quantity, from a stable to a failed level, and its names in messages: a friction angle decreases, a
// factor increases.
#pragma once

#include <string>
#include <vector>

#include "core/base/settings.hpp"
#include "core/model/schedule.hpp"

namespace voussoir {

// tan φ of a friction angle, or the inverse of a factor: in it the strength that a motion requires is a sum
double strength_of(Searched searched, double level);

// the level at which the reduced properties, one at least, are now
double level_in_force(Searched searched, const std::vector<int>& properties, const Schedule& schedule);

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

  double strength(double level) const { return strength_of(searched, level); }
  double level_of(double strength) const;
};

Levels levels_of(const ReducePlan& plan);

}  // namespace voussoir
