#include "core/scene/read_motion.hpp"

#include <algorithm>
#include <functional>

#include "core/scene/keys.hpp"

namespace voussoir {

MotionSpec read_motion(const Subject& table) {
  MotionSpec motion;
  read_keys(*table.node, "motion", motion);
  return motion;
}

TimeFactor read_factor(const Subject& table) {
  TimeFactor factor;
  read_keys(*table.node, "factor", factor);
  if (factor.times.size() != factor.factors.size())
    refuse(table, factor.times.size() < factor.factors.size() ? "times_s" : "factors",
           "does not match the " + std::to_string(std::max(factor.times.size(), factor.factors.size())) +
               " entries of the other; times_s "
               "and factors need the same number of entries");
  if (std::adjacent_find(factor.times.begin(), factor.times.end(), std::greater_equal<>()) != factor.times.end())
    refuse(table, "times_s", "must be ascending; put the times in order, each once, with their factors");
  if (factor.phase != 0 && factor.frequency == 0)
    refuse(table, "phase_deg", "is stated without frequency_hz; state the frequency or remove the phase");
  return factor;
}

void refuse_beside_records(const Subject& table) {
  for (const char* key : {"velocity", "angular_velocity", "times_s", "factors", "frequency_hz", "phase_deg"})
    if (table.node->find(key))
      refuse(table, key, "is stated together with factor, records that give the velocity; remove one of the two");
}

}  // namespace voussoir
