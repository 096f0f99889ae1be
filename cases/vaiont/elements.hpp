// Shared by the tests of the section by distinct elements: its settings for another spacing and another water level.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "app/limit/limit_analysis.hpp"
#include "cases/case_tools.hpp"

namespace voussoir::cases {

using Overrides = std::vector<std::string>;

constexpr double seat_m = 620;  // elevation

inline Overrides operator+(Overrides first, const Overrides& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

// cross joints and beds every `metres`, with the stiffness of the rock mass independent of the spacing (Boon 2013,
// Eqs 6.1 and 6.2, table 6.4)
inline Overrides spacing(double metres) {
  Overrides settings;
  for (const char* set : {"cross", "beds above the back", "beds above the middle", "beds above the seat"})
    settings.push_back(fmt::format("joint_sets.{}.spacing={}", set, metres));
  settings.push_back(fmt::format("joint_properties.rock.normal_stiffness={}", 7680e6 / metres));
  settings.push_back(fmt::format("joint_properties.rock.shear_stiffness={}", 3072e6 / metres));
  return settings;
}

inline Overrides water_above_the_seat(double metres) {
  return {fmt::format("water.reservoir.level={}", seat_m + metres)};
}

// deg: by rigid-block limit analysis of the same blocks
inline double by_limit_analysis(const std::string& scene, const Overrides& settings) {
  const LimitAnalysis<2> found =
      analyse_limit<2>(load_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / scene, settings),
                       {.properties = {"slide"}, .with_dilation = true});
  if (found.status != LimitStatus::found) throw std::runtime_error(scene + ": " + found.message);
  return found.values.front().second.value;
}

}  // namespace voussoir::cases
