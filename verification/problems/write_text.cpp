#include "verification/problems/write_text.hpp"

#include <fmt/format.h>

#include "text/csv_table.hpp"

namespace voussoir::problems {
namespace {

constexpr std::size_t most_listed = 20;  // blocks; more are in blocks.json alone

std::string vector_text(const Point& p) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p[0] + 0.0, p[1] + 0.0, p[2] + 0.0);
}

std::string blocks_table(const Problem& p) {
  if (p.blocks.size() > most_listed)
    return fmt::format("{} blocks, listed in `blocks.json` and `blocks.obj`.\n", p.blocks.size());
  std::string text = "| block | | mass, kg | centre, m | moments about its axes, kg m² |\n|---|---|--:|---|---|\n";
  for (const Solid& b : p.blocks)
    text += fmt::format("| {} | {} | {:.6g} | {} | {:.6g}, {:.6g}, {:.6g} |\n", b.name, b.fixed ? "fixed" : "free",
                        b.mass, vector_text(b.centre), b.moments[0], b.moments[1], b.moments[2]);
  return text;
}

std::string stiffness_text(const Stiffness& s) {
  return fmt::format("kn = {:g}, ks = {:g} Pa/m", s.normal, s.shear);
}

std::string joints_list(const Problem& p) {
  if (p.joints.empty()) return "No joint: nothing touches.\n";
  std::string text;
  for (const JointOf& j : p.joints) {
    const std::string pair = j.first.empty() ? "all pairs of blocks" : fmt::format("{} and {}", j.first, j.second);
    text += fmt::format("- Joint of {}: friction angle {:g} deg", pair, j.friction_deg);
    if (p.search && p.search->kind == SearchKind::friction) text += " (sought: a trial replaces it)";
    text += fmt::format(", cohesion {:g} Pa, tensile strength {:g} Pa, restitution 0 at any speed.\n", j.cohesion,
                        j.tension);
    text += fmt::format("- Stiff joints: {}.{}\n", stiffness_text(j.stiff),
                        j.stated ? fmt::format(" Stated joints: {}.", stiffness_text(*j.stated)) : "");
  }
  return text;
}

std::string gravity_text(const Problem& p) {
  std::string text = "- Gravity, linear between these times and held after the last: ";
  for (std::size_t k = 0; k < p.gravity.size(); ++k)
    text += fmt::format("{}{} m/s² at {:g} s", k ? ", " : "", vector_text(p.gravity[k].gravity), p.gravity[k].time);
  return text + fmt::format(". Duration {:g} s.\n", p.duration);
}

std::string search_text(const Search& s) {
  return fmt::format("- Search: `{}` between {:g} and {:g}, until the bracket is {:g}; fails at the {} end.\n",
                     s.parameter, s.lower, s.upper, s.tolerance, s.fails_at_upper ? "upper" : "lower");
}

std::string given_text(const Problem& p) {
  std::string text = blocks_table(p) + "\n" + joints_list(p) + gravity_text(p);
  for (const Solid& b : p.blocks) {
    if (b.velocity.norm() > 0)
      text += fmt::format("- {} starts with the velocity {} m/s.\n", b.name, vector_text(b.velocity));
    if (b.spin.norm() > 0)
      text +=
          fmt::format("- {} starts with the angular velocity {} rad/s, in world axes.\n", b.name, vector_text(b.spin));
  }
  for (const Bolt& b : p.bolts)
    text += fmt::format("- Bolt from {} in {} to {} in {}: {:g} N/m, yields at {:g} N.\n", vector_text(b.from),
                        b.from_block, vector_text(b.to), b.to_block, b.stiffness, b.yield_force);
  for (const GivenForce& f : p.forces)
    text += fmt::format("- For codes without bolts: force {} N on {} at {} m.\n", vector_text(f.force), f.block,
                        vector_text(f.point));
  if (p.search) text += search_text(*p.search);
  return text + "- Blocks may touch at the start; they neither overlap nor leave gaps but for rounding.\n";
}

std::string asked_table(const Problem& p) {
  std::string text = "| quantity | unit | how |\n|---|---|---|\n";
  for (const Asked& a : p.asked)
    text += fmt::format("| {} | {} | {} |\n", a.quantity, a.unit, a.how);
  return text;
}

}  // namespace

std::string task_text(const Problem& p) {
  return fmt::format("# {}\n\n![Sketch with dimensions](sketch.svg)\n\n## What to model\n\n{}\n\n{}", p.title,
                     p.words.model,
                     p.dimension == 2 ? fmt::format("Plane: x to the right, z up; prisms of {:g} m along y. A code in "
                                                    "space may take the prisms, one in the plane their section.\n\n",
                                                    p.depth)
                                      : std::string()) +
         "## Given\n\nSI units, angles in deg, x east, y north, z up. Forces and displacements are positive along "
         "these "
         "axes, pressure on a joint is positive. `blocks.json` has every number to the last digit (corners, planes, "
         "mass, "
         "principal axes as quaternions w x y z).\n\n" +
         given_text(p) + "\n## Asked\n\n" + asked_table(p) + "\n## How it is measured\n\n" + p.words.measured +
         "\n\n## Protocol\n\n" + p.words.protocol +
         " Sleeping and other shortcuts off. If a shape has a skin or rounded edges, make them as small as the code "
         "allows and state them in `note`.\n\n## Which answers\n\n" +
         p.words.two_answers +
         "\n\nFill in `answer.csv`: a number, nothing (not run), or `cannot state` with the reason in `note`; seconds "
         "are "
         "processor time of the steps alone, of all trials together.\n\n## Tolerance\n\n" +
         p.words.tolerance + "\n";
}

std::string answer_text(const Problem& p) {
  std::string text =
      "# code: NAME VERSION\n# model: rigid | joint stiffness\n# setting: step, iterations, damping, shape\n"
      "quantity,unit,value,seconds,note\n";
  for (const Asked& a : p.asked)
    text += csv_line({a.quantity, a.unit, "", "", ""}) + "\n";
  return text;
}

}  // namespace voussoir::problems
