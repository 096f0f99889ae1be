// Settings by the accuracy that is asked for: the one table behind `[accuracy] level` in a scene. What it promises are
// relative errors of the quantities that the cases' studies (cases/*/study.toml) compare with exact references; `make
// reports` fails when a study finds a level that misses its promise.
#pragma once

#include <array>
#include <string_view>

namespace voussoir {

inline constexpr std::array<std::string_view, 3> accuracy_levels{"fast", "balanced", "reference"};
inline constexpr std::array<double, 3> accuracy_promises{0.05, 0.01, 0.001};

// deg: of a smaller critical angle, what a level leaves open is a larger fraction than it promises
inline constexpr double least_promised_angle = 15;

// What a level sets where the scene does not state the key itself. How many points carry a joint face is not among
// them: it decides what a joint resists, not how well it is computed.
struct LevelSetting {
  std::string_view table, key;   // of a scene; table "stage": every stage in which the key means something
  std::array<double, 3> values;  // for each level
  bool with_dashpots = false;    // only in scenes that state a viscous ratio above 0
  std::string_view study;        // cases whose studies measured it
};

inline constexpr LevelSetting level_settings[] = {
    // half the bracket is left open, of critical angles from least_promised_angle on
    {"stage", "tolerance_deg", {0.5, 0.1, 0.01}, false, "wedge, roofwedge, incline, slump"},
    // half a step is left open
    {"stage", "step_deg", {0.5, 0.1, 0.02}, false, "wedge, roofwedge"},
    // the load that friction sheds must be followed slowly enough
    {"stage", "ramp_steps", {100, 100, 500}, false, "wedge, roofwedge"},
    // near failure a slow slide must not pass as rest
    {"equilibrium", "unbalanced", {1e-5, 1e-5, 1e-6}, false, "column, edge_contact, wedge"},
    // a dashpot takes the velocity of half a step before: an error of first order
    {"time", "fraction", {0.1, 0.02, 0.002}, true, "bounce"},
    {"time", "fraction", {0.2, 0.1, 0.05}, false, "shaking, incline"},
};

}  // namespace voussoir
