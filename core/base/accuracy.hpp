// Settings by requested accuracy: the only table behind `[accuracy] level` in a scene. It promises relative errors of
// the quantities that the cases' studies (cases/*/study.toml) compare with exact references; `make reports` fails when
// a study finds a level that misses its promise.
#pragma once

#include <array>
#include <string_view>

namespace voussoir {

inline constexpr std::array<std::string_view, 3> accuracy_levels{"fast", "balanced", "reference"};
inline constexpr std::array<double, 3> accuracy_promises{0.05, 0.01, 0.001};

// deg: below this critical angle, a level's final bracket is a larger fraction of the angle than the level promises
inline constexpr double least_promised_angle = 15;

// A value that a level sets if the scene does not state the key. The number of contact points of a joint face is not
// among them: it changes the joint's resistance, not the accuracy of its computation.
struct LevelSetting {
  std::string_view table, key;   // of a scene; table "stage": every stage in which the key means something
  std::array<double, 3> values;  // for each level
  bool with_dashpots = false;    // only in scenes that state a viscous ratio above 0
  std::string_view study;        // cases whose studies measured it
};

inline constexpr LevelSetting level_settings[] = {
    // the error is up to half the bracket; for critical angles from least_promised_angle on
    {"stage", "tolerance_deg", {0.5, 0.1, 0.01}, false, "wedge, roofwedge, incline, slump"},
    // the error is up to half a step
    {"stage", "step_deg", {0.5, 0.1, 0.02}, false, "wedge, roofwedge"},
    // the load that friction sheds must be followed slowly enough
    {"stage", "ramp_steps", {100, 100, 500}, false, "wedge, roofwedge"},
    // near failure a slow slide must not pass as equilibrium
    {"equilibrium", "unbalanced", {1e-5, 1e-5, 1e-6}, false, "column, edge_contact, wedge"},
    // a dashpot's force uses the velocity of half a step before: an error of first order
    {"time", "fraction", {0.1, 0.02, 0.002}, true, "bounce"},
    {"time", "fraction", {0.2, 0.1, 0.05}, false, "shaking, incline"},
};

}  // namespace voussoir
