// Oedometer tests of the rock mass of a draw: oedometer.toml and oedometer_across.toml.
#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "cases/case_tools.hpp"

namespace voussoir::cases {

constexpr double oedometer_pressure = 662175;  // Pa, as the scenes state it
constexpr double width_m = 70, height_m = 60;  // of the rock mass

using Overrides = std::vector<std::string>;

struct Moduli {
  double shear = 0, poisson = 0;  // Pa, 1
  verification::Cost cost;
};

// Eqs 5.12 and 5.13
inline Moduli moduli(const SceneRun& test, double stress, double strain) {
  return {(oedometer_pressure - stress) / (2 * strain), stress / (oedometer_pressure + stress), cost(test)};
}

inline Moduli pressed_down(const Overrides& settings, double side = 0) {
  Overrides all = settings;
  if (side > 0)
    for (const auto& [end, at] : {std::pair("min", -side / 2), {"max", side / 2}})
      all.push_back(fmt::format("domain.box.{}=[{},{}]", end, at, at));
  const SceneRun test = run("oedometer.toml", all);
  const double height = side > 0 ? side : height_m;
  return moduli(test, -value(test, "wall_sum_contact_load_x") / height,
                -value(test, "plate_mean_displacement_y") / height);
}

inline Moduli pressed_across(const Overrides& settings) {
  const SceneRun test = run("oedometer_across.toml", settings);
  return moduli(test, -value(test, "wall_sum_contact_load_y") / width_m,
                -value(test, "plate_mean_displacement_x") / width_m);
}

// the rock mass of another seed of its joints
inline Overrides draw(int seed, Overrides settings = {}) {
  for (const char set : {'A', 'B', 'C'})
    settings.push_back(fmt::format("joint_sets.{}.seed={}", set, seed));
  return settings;
}

}  // namespace voussoir::cases
