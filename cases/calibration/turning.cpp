// Random blocks that turn: columns on a stepped base, slumps of layers.
#include <fmt/format.h>

#include <algorithm>
#include <boost/random/uniform_int_distribution.hpp>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "cases/calibration/drawn_scenes.hpp"
#include "cases/slump/layered_scene.hpp"
#include "reference/slump/elastoplastic.hpp"
#include "reference/small/toppling.hpp"
#include "text/angle.hpp"

namespace voussoir::cases {
namespace {

int whole_between(Draws& draws, int low, int high) {
  return boost::random::uniform_int_distribution<int>(low, high)(draws);
}

// each on a step of its own, whose riser leans back, so that it supports no column from behind
std::string blocks_of(const reference::SteppedColumns& slope) {
  std::string text;
  const double t = slope.thickness, depth = 0.5 * t;
  for (int n = 1; n <= slope.columns; ++n) {
    const double left = (n - 1) * t, foot = n * slope.step;
    text += fmt::format(
        "[[blocks]]\nname = \"column {}\"\nbox = {{ min = [{:.17g}, {:.17g}], max = [{:.17g}, {:.17g}] }}\n", n, left,
        foot, left + t, foot + slope.height(n));
    text += fmt::format(
        "[[blocks]]\nname = \"step {}\"\nvertices = [[{:.17g}, {:.17g}], [{:.17g}, {:.17g}], [{:.17g}, {:.17g}], "
        "[{:.17g}, {:.17g}]]\nfixed = true\n",
        n, left + 0.1 * t, -depth, left + 1.1 * t, -depth, left + t, foot, left, foot);
  }
  return text;
}

// nothing if the reference does not find it, as of a slope that needs no friction
std::optional<double> found_collapse(const reference::LayeredSlope& slope) {
  try {
    return collapse_of(slope);
  } catch (const std::runtime_error&) {
    return {};
  }
}

}  // namespace

// Three to eight columns on a base that dips by 25 to 35 degrees. The lowest is squat, so that it slides, as the
// reference assumes; the highest are at least twice as high as thick and topple. On 5 to 50 GPa/m, along joints as
// across: on soft shear springs slender columns lean too far before the friction of their sides acts as it assumes.
DrawnScene draw_columns(Draws& draws) {
  while (true) {
    reference::SteppedColumns slope;
    slope.crest = whole_between(draws, 3, 6);
    slope.columns = slope.crest + whole_between(draws, 0, 2);
    slope.thickness = between(draws, 2, 10);
    slope.step = between(draws, 0.05, 0.2) * slope.thickness;
    slope.base_dip = between(draws, 25, 35) * degree;
    const double rise = between(draws, 0.5, 1) * slope.thickness, fall = between(draws, 0.3, 0.8) * slope.thickness;
    slope.shortening_below = rise + slope.step;
    slope.shortening_above = fall - slope.step;
    const double stiffness = draw_stiffness(draws, 5e9, 5e10).normal;
    if (slope.height(slope.crest) < 2 * slope.thickness || fall < slope.step) continue;
    const double critical = reference::stepped_columns_friction(slope) / degree;
    // else all slide, or no friction holds them
    if (critical < slope.base_dip / degree + 2 || critical > 43) continue;
    const std::string text = fmt::format("dimension = 2\ngravity = [{:.17g}, {:.17g}]\ndensity = 2500\n",
                                         -gravity * std::sin(slope.base_dip), -gravity * std::cos(slope.base_dip)) +
                             blocks_of(slope) + joint_lines("rock", {stiffness, stiffness}, 60) +
                             stage_lines("", "from_deg = 60\nto_deg = 10\ntolerance_deg = 0.1\n");
    return {fmt::format("{} columns, crest {}, {:.1f} m thick, base {:.0f} deg, {:.2g} Pa/m", slope.columns,
                        slope.crest, slope.thickness, slope.base_dip / degree, stiffness),
            text, friction_angle, critical};
  }
}

// 15 to 40 m high, face and bedding of the same dip, one to three layers, on 5 to 20 GPa/m
DrawnScene draw_slope(Draws& draws) {
  while (true) {
    reference::LayeredSlope slope;
    slope.dip = between(draws, 50, 70) * degree;
    slope.base_dip = between(draws, -5, 8) * degree;
    slope.thickness = between(draws, 2, 6);
    slope.spacing = between(draws, 5, 15);
    slope.height = between(draws, 15, 40);
    slope.layers = whole_between(draws, 1, 3);
    slope.density = 2500;
    slope.gravity = gravity;
    slope.normal_stiffness = slope.shear_stiffness = power_between(draws, 5e9, 20e9);
    if (has_slivers(slope)) continue;
    const std::optional<double> truth = found_collapse(slope);
    if (!truth || *truth < 4 || *truth > 50) continue;
    const std::string label = fmt::format(
        "dip {:.2f}, base {:.2f}, {} x {:.2f} m, spacing {:.2f} m, height {:.2f} m, {:.2g} Pa/m", slope.dip / degree,
        slope.base_dip / degree, slope.layers, slope.thickness, slope.spacing, slope.height, slope.normal_stiffness);
    return {label, layered_scene_text(slope, label, {"", "", "tolerance_deg = 0.05\n"}), friction_angle, *truth};
  }
}

}  // namespace voussoir::cases
