// Ranges and phrases that rows of several key tables share.
#pragma once

#include "core/scene/key_row.hpp"

namespace voussoir::keys {

// lengths and the like: far beyond any rock mass, but their squares are still finite
inline constexpr Range sane{-1e12, 1e12};
inline constexpr Range positive{0, 1e12, true};
inline constexpr Range not_negative{0, 1e12};
inline constexpr Range size_range{1e-6, 1e12};  // third moments of a lognormal law are still finite
inline constexpr Range fraction{0, 1, false, true};
inline constexpr Range stiffness{0, 1e20, true};
inline constexpr Range dip_range{0, 90};
inline constexpr Range direction_range{0, 360};
inline constexpr Range friction_range{0, 90, false, true};
inline constexpr Range count{1, 1e15};
inline constexpr Range factor_range{0, 1000, true};

// usual values of rock and its models: a value outside gives a warning before a run
inline constexpr Range plausible_density{500, 8000};
inline constexpr Range plausible_length{0.05, 1000};
inline constexpr Range plausible_stiffness{1e6, 1e12};
inline constexpr Range plausible_dip{.low = 1.6, .high = 90, .or_zero = true};  // 90 degrees are 1.57 radians
inline constexpr Range plausible_direction{.low = 0.1, .high = 360, .or_zero = true};
inline constexpr Range plausible_scatter{.low = 0.5, .high = 30, .or_zero = true};
inline constexpr Range plausible_friction{
    .low = 1.6, .high = 89.9, .or_zero = true};  // up to angles at which nothing slips
inline constexpr Range plausible_speed{.low = 1e-9, .high = 100, .above_low = true, .or_zero = true};  // 3 cm a year
inline constexpr Range plausible_factor{.low = 0.01, .high = 200, .or_zero = true};                    // a centrifuge
inline constexpr Range plausible_strength{0.05, 50};
inline constexpr Range plausible_ramp{.low = 0.01, .high = 100, .or_zero = true};

inline constexpr std::string_view dip_repair =
    "measure the dip downwards from the horizontal; dip_direction gives the side";
inline constexpr std::string_view direction_repair = "clockwise from north (y): 0 north, 90 east, 180 south, 270 west";
inline constexpr std::string_view dip_direction_meaning =
    "direction in which the plane dips, clockwise from north (y); in 2-D 90 (to the right) or 270 (to the left); "
    "may be left out if dip = 0";

inline constexpr std::string_view density_mistake = "was it given in g/cm³ or t/m³?";
inline constexpr std::string_view stiffness_mistake = "was it given in MPa/m or GPa/m?";
inline constexpr std::string_view angle_mistake = "was it given in radians?";
inline constexpr std::string_view friction_mistake = "was it given in radians, or as its tangent?";

}  // namespace voussoir::keys
