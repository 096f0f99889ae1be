#include "core/run/search_levels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "text/angle.hpp"

namespace voussoir {

std::string Levels::text(double level) const {
  return fmt::format("{:.6g}{}", level / unit, symbol);
}

double Levels::safer(double a, double b) const {
  return direction < 0 ? std::max(a, b) : std::min(a, b);
}

double strength_of(Searched searched, double level) {
  return searched == Searched::friction ? std::tan(level) : 1 / level;
}

double level_in_force(Searched searched, const std::vector<int>& properties, const Schedule& schedule) {
  if (searched == Searched::friction) return schedule.friction[properties.front()];
  return schedule.strength_factor.empty() ? 1 : schedule.strength_factor[properties.front()];
}

double Levels::level_of(double strength) const {
  return searched == Searched::friction ? std::atan(strength) : 1 / strength;
}

Levels levels_of(const ReducePlan& plan) {
  if (plan.searched == Searched::friction)
    return {plan.searched, plan.from, plan.to,  plan.tolerance, plan.step, -1,     degree,
            " deg",        "deg",     "higher", "lower",        "down",    "angle"};
  const FactorPlan& f = plan.factor;
  return {plan.searched, f.from, f.to, f.tolerance, f.step, 1, 1, "", "factor", "lower", "higher", "up", "factor"};
}

}  // namespace voussoir
