// Random wedges in a flat roof, held by the stress on their joints.
#include <fmt/format.h>

#include "cases/calibration/drawn_scenes.hpp"
#include "cases/roofwedge/random_wedge.hpp"

namespace voussoir::cases {
namespace {

constexpr double duration = 0.02;  // s, in which the stress is applied

}  // namespace

DrawnScene draw_roof_wedge(Draws& draws) {
  const bool symmetric = between(draws, 0, 1) < 0.5;
  const DrawnRoofWedge drawn = random_roof_wedge(draws, symmetric);
  const reference::RoofWedge& wedge = drawn.wedge;
  std::string text = fmt::format(
      "dimension = 3\ngravity = [0, 0, {0}]\ndensity = {1}\n[domain]\n"
      "box = {{ min = [{2}, {2}, 0], max = [{3}, {3}, {4}] }}\n",
      -wedge.gravity, wedge.density, -roof_half_width, roof_half_width, 2 * wedge.height);
  std::string moves;
  const std::array<RoofMove, 3> rock = roof_moves(wedge);
  for (int i = 0; i < 3; ++i) {
    const char joint = static_cast<char>('A' + i);
    text += fmt::format(
        "[[joints]]\nname = \"{0}\"\ndip = {1:.17g}\ndip_direction = {2:.17g}\npoint = [0, 0, {3}]\n"
        "[[fix]]\nabove = [\"{0}\"]\n",
        joint, wedge.planes[i].dip / degree, wedge.planes[i].dip_direction / degree, wedge.height);
    moves += fmt::format("[[stage.move]]\nname = \"{}\"\ninside = {}\nvelocity = {}\n", joint, list_of(rock[i].inside),
                         list_of(rock[i].way / duration));
  }
  // the stiffness is part of the problem: it holds the stress
  text += joint_lines("rock", {wedge.normal_stiffness, wedge.shear_stiffness}, 60) + "measured = true\n" +
          "[[restrain]]\nbelow = [\"A\", \"B\", \"C\"]\nrotation = true\n" +
          fmt::format(
              "[[stage]]\nname = \"stress\"\nkind = \"run\"\nduration_s = {0}\ngravity_ramp_s = {0}\n"
              "damping = {{ local = 0.7 }}\n",
              duration) +
          moves +
          "[[stage]]\nname = \"settle\"\nkind = \"settle\"\n[[stage]]\nname = \"critical\"\nkind = \"reduce\"\n"
          "from_deg = 60\nto_deg = 10\ntolerance_deg = 0.02\n";
  return {fmt::format("{}symmetric, K0 {:.2f}, {:.2g} and {:.2g} Pa/m", symmetric ? "" : "a", drawn.k0,
                      wedge.normal_stiffness, wedge.shear_stiffness),
          text, friction_angle, drawn.truth};
}

}  // namespace voussoir::cases
