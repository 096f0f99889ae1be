// The slumping slope's scene, for any layers.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "reference/slump/elastoplastic.hpp"
#include "text/angle.hpp"

namespace voussoir::cases {

// whether the top of a slope cuts blocks off to slivers: below a tenth of the largest
inline bool has_slivers(const reference::LayeredSlope& slope) {
  const std::vector<double> areas = reference::slope_block_areas(slope);
  return std::ranges::min(areas) < 0.1 * std::ranges::max(areas);
}

// deg: the friction at which blocks that do not dilate fall, to 0.0025; throws as the reference
inline double collapse_of(const reference::LayeredSlope& slope) {
  constexpr double bracket = 0.005;  // deg
  const reference::SlopeCollapse collapse = reference::elastoplastic_collapse(slope, bracket * degree);
  return 0.5 * (collapse.stands + collapse.collapses) / degree;
}

inline std::string plane_lines(const std::string& kind, const std::string& name, double dip, double direction, double x,
                               double y) {
  if (dip < 0) {
    dip = -dip;
    direction = 360 - direction;
  }
  return fmt::format("{}\nname = \"{}\"\ndip = {:.15g}\ndip_direction = {}\npoint = [{:.17g}, {:.17g}]\n", kind, name,
                     dip, direction, x, y);
}

// numerical settings: lines at a scene's top, of its joints, and of its search
struct LayeredSettings {
  std::string top, joints, search;
};

// scene.toml with other numbers
inline std::string layered_scene_text(const reference::LayeredSlope& slope, const std::string& title,
                                      const LayeredSettings& settings) {
  const double dip = slope.dip / degree, base_dip = slope.base_dip / degree;
  const double layer = slope.thickness / std::sin(slope.dip), row = slope.spacing / std::cos(slope.base_dip);
  const double right = slope.height / std::tan(slope.dip) + slope.layers * layer + 10;
  std::string text = fmt::format("title = \"{}\"\n{}dimension = 2\ngravity = [0, -{}]\ndensity = {}\n", title,
                                 settings.top, slope.gravity, slope.density);
  text += fmt::format("[domain]\nbox = {{ min = [-5, -20], max = [{:.17g}, {:.17g}] }}\n", right, slope.height);
  text += plane_lines("[[domain.planes]]", "face", dip, 270, 0, 0) + "keep = \"below\"\n";
  text += plane_lines("[[joints]]", "base", base_dip, 90, 0, 0);
  text += plane_lines("[[joints]]", "back", dip, 270, slope.layers * layer, 0);
  for (int i = 1; i < slope.layers; ++i)
    text += plane_lines("[[joints]]", fmt::format("bedding {}", i), dip, 270, i * layer, 0);
  // the rows above the base, as far up as the top of the last layer
  const double last_top = slope.height + right * std::abs(std::tan(slope.base_dip));
  for (int i = 1; i * row < last_top; ++i)
    text += plane_lines("[[joints]]", fmt::format("cross {}", i), base_dip, 90, 0, i * row);
  text += fmt::format(
      "[[joint_properties]]\nname = \"rock\"\nnormal_stiffness = {:.17g}\nshear_stiffness = {:.17g}\n"
      "friction_deg = 60\n{}",
      slope.normal_stiffness, slope.shear_stiffness, settings.joints);
  return text +
         "[[fix]]\nbelow = [\"base\"]\n[[fix]]\nbelow = [\"back\"]\n"
         "[[stage]]\nname = \"settle\"\nkind = \"settle\"\ngravity_ramp_s = 0.5\n"
         "[[stage]]\nname = \"critical\"\nkind = \"reduce\"\nmethod = \"bisection\"\nfrom_deg = 60\nto_deg = 2\n" +
         settings.search;
}

// in a file of its own, so that it can be run by itself
inline void write_layered_scene(const reference::LayeredSlope& slope, const std::string& title,
                                const std::filesystem::path& file) {
  std::ofstream out(file);
  out << layered_scene_text(
      slope, title,
      {"preset = \"thesis\"\n", "sub_contacts = 4\n", "tolerance_deg = 0.05\nfailure_displacement = 0.1\n"});
  if (!out) throw std::runtime_error("cannot write " + file.string());
}

}  // namespace voussoir::cases
