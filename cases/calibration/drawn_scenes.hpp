// Scenes drawn at random, whose critical strength is known from a closed form or a path of equilibria: one kind of
// failure each, by a stranger's scene, which states no numerical setting but the tolerance of its search.
#pragma once

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <cmath>
#include <string>
#include <vector>

namespace voussoir::cases {

inline constexpr double gravity = 9.81;  // m/s2

using Draws = boost::random::mt19937_64;

inline double between(Draws& draws, double low, double high) {
  return boost::random::uniform_real_distribution<double>(low, high)(draws);
}

// uniform in the logarithm
inline double power_between(Draws& draws, double low, double high) {
  return std::pow(10, between(draws, std::log10(low), std::log10(high)));
}

struct DrawnScene {
  std::string label, text;  // text: of its scene.toml
  std::string value;        // that its search finds
  double truth = 0;         // deg or 1
};

inline const std::string friction_angle = "critical_friction", factor = "factor_of_safety";

struct SceneKind {
  std::string name;  // "wedges"
  std::string source;
  DrawnScene (*draw)(Draws&);  // the next one that is neither near a change of mode nor beyond its search's range
  int few;                     // scenes of every build
  bool has_error = true;       // false: found to rounding and the criterion of equilibrium, which no bar is made for
};

// joints' stiffnesses, Pa/m: the shear stiffness is a tenth of the normal one to all of it
struct JointStiffness {
  double normal = 0, shear = 0;
};
JointStiffness draw_stiffness(Draws& draws, double low, double high);

// lines of a scene.toml
std::string joint_lines(const std::string& name, const JointStiffness& stiffness, double friction_deg);
std::string stage_lines(const std::string& settle, const std::string& search);

// blocks that slide: sliding.cpp
DrawnScene draw_wedge(Draws& draws);
DrawnScene draw_plane_failure(Draws& draws);
DrawnScene draw_rounded_block(Draws& draws);
DrawnScene draw_bolted_block(Draws& draws);
DrawnScene draw_inclined_block(Draws& draws);

DrawnScene draw_roof_wedge(Draws& draws);  // roof.cpp

// blocks that turn: turning.cpp
DrawnScene draw_columns(Draws& draws);
DrawnScene draw_slope(Draws& draws);

}  // namespace voussoir::cases
