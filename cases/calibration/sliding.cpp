// Random blocks that slide: wedges, plane failures with water, bolted blocks, blocks free to turn, rounded blocks.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "cases/calibration/drawn_scenes.hpp"
#include "reference/small/bolts.hpp"
#include "reference/water/wet_slopes.hpp"
#include "reference/wedge/wedge.hpp"
#include "text/angle.hpp"

namespace voussoir::cases {
namespace {

// deg: answers beyond are drawn again
constexpr double least_angle = 8, largest_angle = 70;

bool is_searched(double angle_deg) {
  return angle_deg > least_angle && angle_deg < largest_angle;
}

// x down the slope, y out of it: gravity is inclined instead of the slope
std::string inclined_gravity(double slope) {
  return fmt::format("dimension = 2\ngravity = [{:.17g}, {:.17g}]\n", gravity * std::sin(slope),
                     -gravity * std::cos(slope));
}

// a base below y = 0 and a block of a length and height above it, in the middle
std::string block_on_base(double length, double height, double gap = 0) {
  return fmt::format(
      "[[blocks]]\nname = \"base\"\nbox = {{ min = [{:.17g}, {:.17g}], max = [{:.17g}, 0] }}\nfixed = true\n"
      "[[blocks]]\nname = \"block\"\nbox = {{ min = [{:.17g}, {:.17g}], max = [{:.17g}, {:.17g}] }}\n",
      -length, -height - 1, length, -0.5 * length, gap, 0.5 * length, gap + height);
}

const std::string friction_search =
    "from_deg = 80\nto_deg = 3\n"
    "tolerance_deg = 0.02\n";

std::string friction_search_of(const std::string& joint) {
  return friction_search + fmt::format("joint_properties = [\"{}\"]\n", joint);
}

// of a factor that divides a friction angle and the cohesion that the joint_properties state
std::string factor_search(const std::string& joint, double friction_deg) {
  return fmt::format(
      "search = \"factor\"\njoint_properties = [\"{0}\"]\nfriction = [{{ name = \"{0}\", friction_deg = {1:.17g} }}]\n"
      "from_factor = 0.2\nto_factor = 6\ntolerance_factor = 0.002\n",
      joint, friction_deg);
}

}  // namespace

JointStiffness draw_stiffness(Draws& draws, double low, double high) {
  const double normal = power_between(draws, low, high);
  return {normal, normal * power_between(draws, 0.1, 1)};
}

std::string joint_lines(const std::string& name, const JointStiffness& stiffness, double friction_deg) {
  return fmt::format(
      "[[joint_properties]]\nname = \"{}\"\nnormal_stiffness = {:.17g}\nshear_stiffness = {:.17g}\n"
      "friction_deg = {:.17g}\n",
      name, stiffness.normal, stiffness.shear, friction_deg);
}

std::string stage_lines(const std::string& settle, const std::string& search) {
  return "[[stage]]\nname = \"settle\"\nkind = \"settle\"\ngravity_ramp_s = 0.5\n" + settle +
         "[[stage]]\nname = \"critical\"\nkind = \"reduce\"\n" + search;
}

// 1 to 10 m high, on both planes or on one, on 10 MPa/m to 3 GPa/m
DrawnScene draw_wedge(Draws& draws) {
  while (true) {
    reference::Wedge w;
    for (reference::WedgePlane* plane : {&w.a, &w.b}) {
      plane->dip = between(draws, 20, 80) * degree;
      plane->dip_direction = between(draws, 0, 360) * degree;
    }
    const double height = power_between(draws, 1, 10), density = between(draws, 2000, 2800);
    const JointStiffness stiffness = draw_stiffness(draws, 1e7, 3e9);
    const std::optional<double> critical = reference::critical_friction(w);
    if (!critical || !is_searched(*critical / degree) || !reference::classify_wedge(w).non_degenerate) continue;
    const reference::WedgeSolution solution = reference::solve_wedge(w);

    // in a face that dips steeply along the line of intersection the line daylights
    std::string text = fmt::format(
        "dimension = 3\ngravity = [0, 0, {0}]\ndensity = {1:.17g}\n[domain]\n"
        "box = {{ min = [{2:.17g}, {2:.17g}, {2:.17g}], max = [{3:.17g}, {3:.17g}, 0] }}\n",
        -gravity, density, -4 * height, 4 * height);
    const auto at = fmt::format("point = [0, 0, {:.17g}]", -height);
    text += fmt::format("planes = [{{ dip = {:.17g}, dip_direction = {:.17g}, {}, keep = \"below\" }}]\n",
                        std::min(85.0, solution.line_plunge / degree + 30), solution.line_trend / degree, at);
    for (const auto& [name, plane] : {std::pair{"A", w.a}, std::pair{"B", w.b}})
      text += fmt::format("[[joints]]\nname = \"{}\"\ndip = {:.17g}\ndip_direction = {:.17g}\n{}\n", name,
                          plane.dip / degree, plane.dip_direction / degree, at);
    text +=
        "[[fix]]\nbelow = [\"A\"]\n[[fix]]\nbelow = [\"B\"]\n[[restrain]]\nabove = [\"A\", \"B\"]\nrotation = true\n" +
        joint_lines("rock", stiffness, 85) + stage_lines("", friction_search);
    return {fmt::format("on {}, {:.1f} m, {:.2g} Pa/m", reference::describe(solution.mode), height, stiffness.normal),
            text, friction_angle, *critical / degree};
  }
}

// 10 to 40 m high, crack 0.3 full to full, on 1 to 30 GPa/m; friction alone, or the factor of friction and cohesion
DrawnScene draw_plane_failure(Draws& draws) {
  while (true) {
    reference::PlaneFailure slope;
    slope.height = between(draws, 10, 40);
    slope.face = between(draws, 50, 75) * degree;
    slope.joint = between(draws, 22, 48) * degree;
    slope.crack_distance = between(draws, 0.1, 0.35) * slope.height;
    slope.unit_weight = between(draws, 24e3, 28e3);
    const double fill = between(draws, 0.3, 1), cohesion = between(draws, 5e3, 60e3),
                 friction_deg = between(draws, 28, 45);
    const bool by_factor = between(draws, 0, 1) < 0.5;
    const JointStiffness stiffness = draw_stiffness(draws, 1e9, 3e10);
    double truth = 0;
    try {
      slope.water_in_crack = fill * reference::forces_of(slope).crack_depth;
      if (slope.joint > slope.face - 10 * degree || slope.water_in_crack < 0.05 * slope.height) continue;
      if (!is_searched(reference::critical_friction(slope) / degree)) continue;
      if (by_factor) {
        slope.cohesion = cohesion;
        slope.friction_angle = friction_deg * degree;
      }
      truth = by_factor ? reference::factor_of_safety(slope) : reference::critical_friction(slope) / degree;
    } catch (const std::invalid_argument&) {  // no block, or no angle holds it
      continue;
    }
    if (by_factor && (truth < 0.4 || truth > 4)) continue;

    const double back = slope.height / std::tan(slope.face) + slope.crack_distance;
    std::string text = fmt::format(
        "dimension = 2\ngravity = [0, {}]\ndensity = {:.17g}\n[domain]\n"
        "box = {{ min = [{:.17g}, {:.17g}], max = [{:.17g}, {:.17g}] }}\n",
        -gravity, slope.unit_weight / gravity, -0.2 * slope.height, -0.3 * slope.height, back + 0.4 * slope.height,
        slope.height);
    text += fmt::format(
        "planes = [{{ dip = {:.17g}, dip_direction = 270, point = [0, 0], keep = \"below\" }}]\n"
        "[[joints]]\nname = \"joint\"\ndip = {:.17g}\ndip_direction = 270\npoint = [0, 0]\nproperties = \"joint\"\n"
        "[[joints]]\nname = \"crack\"\ndip = 90\ndip_direction = 90\npoint = [{:.17g}, 0]\nproperties = \"crack\"\n",
        slope.face / degree, slope.joint / degree, back);
    text += joint_lines("joint", stiffness, by_factor ? friction_deg : 80);
    if (by_factor) text += fmt::format("cohesion = {:.17g}\n", cohesion);
    text += joint_lines("crack", stiffness, 10);
    text +=
        "[[fix]]\nbelow = [\"joint\"]\n[[fix]]\nabove = [\"crack\"]\n"
        "[[restrain]]\nabove = [\"joint\"]\nbelow = [\"crack\"]\nrotation = true\n";
    text += fmt::format(
        "[[water]]\nname = \"rain\"\ntable = [[0, 0], [{:.17g}, {:.17g}]]\nfaces = [\"joint\", \"crack\"]\n", back,
        back * std::tan(slope.joint) + slope.water_in_crack);
    text += by_factor ? stage_lines("friction = [{ name = \"joint\", friction_deg = 80 }]\n",
                                    factor_search("joint", friction_deg))
                      : stage_lines("", friction_search_of("joint"));
    return {fmt::format("{:.0f} m, face {:.0f}, joint {:.0f}, crack {:.2f} full, {:.2g} Pa/m{}", slope.height,
                        slope.face / degree, slope.joint / degree, fill, stiffness.normal,
                        by_factor ? fmt::format(", cohesion {:.0f} Pa", cohesion) : ""),
            text, by_factor ? factor : friction_angle, truth};
  }
}

// A bolt that yields at 5 to 35 % of the block's weight, 15 to 60 degrees to the joint, on 0.3 to 30 GPa/m; anchors as
// by default. It yields before it has turned: within a tenth of a degree or so.
DrawnScene draw_bolted_block(Draws& draws) {
  while (true) {
    const double length = between(draws, 2, 5), height = between(draws, 0.15, 0.5) * length,
                 slope = between(draws, 25, 55) * degree, density = between(draws, 2200, 2800),
                 angle = between(draws, 15, 60) * degree;
    const double weight = density * gravity * length * height, force = between(draws, 0.05, 0.35) * weight;
    const double stiffness = force / power_between(draws, 2e-5, 2e-4);
    const JointStiffness joints = draw_stiffness(draws, 3e8, 3e10);
    const double critical = reference::bolted_block_friction(weight, slope, force, angle) / degree;
    if (!is_searched(critical)) continue;

    // from its head in the block through the middle of the joint, up the slope into the base
    const double reach = 0.6 * std::min(height / std::sin(angle), 0.5 * length / std::cos(angle));
    const double x = reach * std::cos(angle), y = reach * std::sin(angle);
    const std::string text =
        inclined_gravity(slope) + fmt::format("density = {:.17g}\n", density) + block_on_base(length, height) +
        joint_lines("rock", joints, 80) + "[[restrain]]\nbodies = [\"block\"]\nrotation = true\n" +
        fmt::format(
            "[[bolts]]\nname = \"bolt\"\nfrom = [{:.17g}, {:.17g}]\nto = [{:.17g}, {:.17g}]\nstiffness = {:.17g}\n"
            "yield = {:.17g}\n",
            x, y, -x, -y, stiffness, force) +
        stage_lines("install = [\"bolt\"]\n", friction_search);
    return {fmt::format("{:.1f} x {:.1f} m on {:.0f} deg, bolt {:.2f} of the weight at {:.0f} deg, {:.2g} Pa/m", length,
                        height, slope / degree, force / weight, angle / degree, joints.normal),
            text, friction_angle, critical};
  }
}

// Free to turn, but far from toppling: the joint is pressed unevenly, so that the block tilts. On 0.1 to 10 GPa/m.
DrawnScene draw_inclined_block(Draws& draws) {
  while (true) {
    const double length = between(draws, 1, 5), slenderness = between(draws, 0.2, 1.5),
                 slope = between(draws, 12, 55) * degree, density = between(draws, 2000, 2800);
    const JointStiffness joints = draw_stiffness(draws, 1e8, 1e10);
    // the weight acts within the middle third of the joint
    if (slenderness * std::tan(slope) > 1.0 / 3) continue;
    const std::string text = inclined_gravity(slope) + fmt::format("density = {:.17g}\n", density) +
                             block_on_base(length, slenderness * length) + joint_lines("rock", joints, 80) +
                             stage_lines("", friction_search);
    return {fmt::format("{:.1f} x {:.1f} m on {:.0f} deg, {:.2g} Pa/m", length, slenderness * length, slope / degree,
                        joints.normal),
            text, friction_angle, slope / degree};
  }
}

// A potential particle that does not turn, its faces a corner radius outside their planes, on 10 MN/m to 10 GN/m.
DrawnScene draw_rounded_block(Draws& draws) {
  const double length = between(draws, 0.5, 3), height = between(draws, 0.3, 1) * length,
               slope = between(draws, 12, 55) * degree, density = between(draws, 2000, 2800),
               radius = between(draws, 0.05, 0.4) * height, sphericity = power_between(draws, 0.003, 0.3);
  const JointStiffness joints = draw_stiffness(draws, 1e7, 1e10);
  const std::string text =
      inclined_gravity(slope) + fmt::format("density = {:.17g}\n", density) + block_on_base(length, height, radius) +
      fmt::format("shape = \"potential\"\ncorner_radius = {:.17g}\nsphericity = {:.17g}\n", radius, sphericity) +
      joint_lines("rock", joints, 80) + "constant_stiffness = true\n" +
      "[[restrain]]\nbodies = [\"block\"]\nrotation = true\n" + stage_lines("", friction_search);
  return {fmt::format("{:.1f} x {:.1f} m, r {:.2f} m, k {:.3f}, on {:.0f} deg, {:.2g} N/m", length, height, radius,
                      sphericity, slope / degree, joints.normal),
          text, friction_angle, slope / degree};
}

}  // namespace voussoir::cases
