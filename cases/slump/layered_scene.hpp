// The slumping slope's scene, for any layers.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "reference/slump/elastoplastic.hpp"
#include "text/angle.hpp"

namespace voussoir::cases {

inline void write_plane(std::ofstream& out, const std::string& kind, const std::string& name, double dip,
                        double direction, double x, double y) {
  if (dip < 0) {
    dip = -dip;
    direction = 360 - direction;
  }
  out << fmt::format("{}\nname = \"{}\"\ndip = {:.15g}\ndip_direction = {}\npoint = [{:.17g}, {:.17g}]\n", kind, name,
                     dip, direction, x, y);
}

// scene.toml with other numbers, in a file of its own, so that it can be run by itself
inline void write_layered_scene(const reference::LayeredSlope& slope, const std::string& title,
                                const std::filesystem::path& file) {
  std::ofstream out(file);
  const double dip = slope.dip / degree, base_dip = slope.base_dip / degree;
  const double layer = slope.thickness / std::sin(slope.dip), row = slope.spacing / std::cos(slope.base_dip);
  const double right = slope.height / std::tan(slope.dip) + slope.layers * layer + 10;
  out << fmt::format("title = \"{}\"\npreset = \"thesis\"\ndimension = 2\ngravity = [0, -{}]\ndensity = {}\n", title,
                     slope.gravity, slope.density);
  out << fmt::format("[domain]\nbox = {{ min = [-5, -20], max = [{:.17g}, {:.17g}] }}\n", right, slope.height);
  write_plane(out, "[[domain.planes]]", "face", dip, 270, 0, 0);
  out << "keep = \"below\"\n";
  write_plane(out, "[[joints]]", "base", base_dip, 90, 0, 0);
  write_plane(out, "[[joints]]", "back", dip, 270, slope.layers * layer, 0);
  for (int i = 1; i < slope.layers; ++i)
    write_plane(out, "[[joints]]", fmt::format("bedding {}", i), dip, 270, i * layer, 0);
  // the rows above the base, as far up as the top of the last layer
  const double last_top = slope.height + right * std::abs(std::tan(slope.base_dip));
  for (int i = 1; i * row < last_top; ++i)
    write_plane(out, "[[joints]]", fmt::format("cross {}", i), base_dip, 90, 0, i * row);
  out << fmt::format(
      "[[joint_properties]]\nname = \"rock\"\nnormal_stiffness = {:.17g}\nshear_stiffness = {:.17g}\n"
      "friction_deg = 60\nsub_contacts = 4\n",
      slope.normal_stiffness, slope.shear_stiffness);
  out << "[[fix]]\nbelow = [\"base\"]\n[[fix]]\nbelow = [\"back\"]\n"
         "[[stage]]\nname = \"settle\"\nkind = \"settle\"\ngravity_ramp_s = 0.5\n"
         "[[stage]]\nname = \"critical\"\nkind = \"reduce\"\nmethod = \"bisection\"\nfrom_deg = 60\nto_deg = 2\n"
         "tolerance_deg = 0.05\nfailure_displacement = 0.1\n";
  if (!out) throw std::runtime_error("cannot write " + file.string());
}

}  // namespace voussoir::cases
