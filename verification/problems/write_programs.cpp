#include "verification/problems/write_programs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace voussoir::problems {
namespace {

constexpr int gravity_steps = 20;  // in which a data file lets gravity grow

// what a user changes from trial to trial
std::string trial_text(const Problem& p, const std::string& comment) {
  if (!p.search) return {};
  const Search& s = *p.search;
  std::string text = fmt::format(
      "{} SEARCH {}: bisect between {:g} and {:g} to {:g}, fails at the {} end; each trial runs "
      "this file from the beginning with\n",
      comment, s.parameter, s.lower, s.upper, s.tolerance, s.fails_at_upper ? "upper" : "lower");
  switch (s.kind) {
    case SearchKind::friction:
      return text + comment + " the value as friction of the joint\n";
    case SearchKind::tension:
      return text + comment + " the value as tensile strength of the joint\n";
    case SearchKind::gravity_direction:
      return text + comment + " gravity turned by the value from -z towards +x: 9.81 (sin, 0, -cos)\n";
    case SearchKind::vertices:
      return text + fmt::format("{} corners of another thickness (blocks.json, search.acts); here {:g} m\n", comment,
                                s.nominal);
  }
  return text;
}

const JointOf* joint_of(const Problem& p) {
  return p.joints.empty() ? nullptr : &p.joints.front();
}

// the near end of a prism: corners in x and z, clockwise as UDEC wants them
std::vector<Point> section_clockwise(const Solid& block) {
  const auto near_face = std::max_element(block.faces.begin(), block.faces.end(),
                                          [](const Face& a, const Face& b) { return -a.normal[1] < -b.normal[1]; });
  std::vector<Point> corners;
  for (auto c = near_face->corners.rbegin(); c != near_face->corners.rend(); ++c)
    corners.push_back(block.vertices[*c]);
  return corners;
}

// whole numbers of equal parts in which gravity grows, then the rest of the time
std::string udec_stages(const Problem& p) {
  std::string text;
  double time = 0;
  for (std::size_t k = 0; k < p.gravity.size(); ++k) {
    const GravityAt& next = p.gravity[k];
    if (k == 0) {
      text += fmt::format("gravity {:.17g} {:.17g}\n", next.gravity[0] + 0.0, next.gravity[2] + 0.0);
      continue;
    }
    const GravityAt& before = p.gravity[k - 1];
    for (int i = 1; i <= gravity_steps; ++i) {
      const Point g = before.gravity + (i - 0.5) / gravity_steps * (next.gravity - before.gravity);
      text += fmt::format("gravity {:.17g} {:.17g}\ncycle time {:g}\n", g[0] + 0.0, g[2] + 0.0,
                          (next.time - before.time) / gravity_steps);
    }
    text += fmt::format("gravity {:.17g} {:.17g}\n", next.gravity[0] + 0.0, next.gravity[2] + 0.0);
    time = next.time;
  }
  if (p.criterion)
    for (const double t : p.criterion->times) {
      text += fmt::format("cycle time {:g}\nprint block\n", t - time);
      time = t;
    }
  if (p.duration > time) text += fmt::format("cycle time {:g}\nprint block\n", p.duration - time);
  return text;
}

std::string toml_vector(const Point& v, int dimension) {
  return dimension == 2 ? fmt::format("[{:.17g}, {:.17g}]", v[0] + 0.0, v[2] + 0.0)
                        : fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v[0] + 0.0, v[1] + 0.0, v[2] + 0.0);
}

std::string toml_block(const Solid& b, int dimension) {
  std::string corners;
  std::vector<Point> list = b.vertices;
  if (dimension == 2) {
    list = section_clockwise(b);
    std::reverse(list.begin(), list.end());
  }
  for (const Point& v : list)
    corners += (corners.empty() ? "" : ", ") + toml_vector(v, dimension);
  std::string text =
      fmt::format("[[blocks]]\nname = \"{}\"\ndensity = {:.17g}\nvertices = [{}]\n", b.name, b.density, corners);
  if (b.fixed) text += "fixed = true\n";
  if (b.velocity.norm() > 0) text += "velocity = " + toml_vector(b.velocity, dimension) + "\n";
  if (b.spin.norm() > 0) text += "angular_velocity = " + toml_vector(b.spin, dimension) + "\n";
  return text + "\n";
}

// Joints are bonded when they are first in compression: the free block is pressed against the fixed one by a thousandth
// of its weight, which ends with the stage.
std::string pressing_stage(const Problem& p) {
  const auto free = std::ranges::find_if(p.blocks, [](const Solid& b) { return !b.fixed; });
  const auto fixed = std::ranges::find_if(p.blocks, [](const Solid& b) { return b.fixed; });
  const Point push = 1e-3 * free->mass * p.gravity.back().gravity.norm() * (fixed->centre - free->centre).normalized();
  return fmt::format(
      "[[stage]]\nname = \"press\"\nkind = \"settle\"\ngravity_to = 0\nbond = true\n"
      "force = [{{ name = \"push\", bodies = [\"{}\"], force = {} }}]\n\n",
      free->name, toml_vector(push, p.dimension));
}

}  // namespace

std::string udec_text(const Problem& p) {
  const JointOf* joint = joint_of(p);
  double size = 1e300;
  for (const Solid& b : p.blocks)
    size = std::min(size, std::cbrt(b.mass / b.density));
  std::string text = fmt::format(
      "; {}\n; A data file in the grammar of UDEC 4 to 6 (command reference of UDEC). Its words were "
      "not\n; compared with the manual by any program, and it was not run. Units m, kg, s, Pa; x to the right, z of "
      "task.md is y here; 1 m deep. Stiff joints.\n",
      p.title);
  text += trial_text(p, ";");
  text += fmt::format("new\nround {:g}\nset ovtol {:g}\n", 1e-4 * size, 1e-2 * size);
  for (const Solid& b : p.blocks) {
    text += "; " + b.name + "\nblock";
    for (const Point& v : section_clockwise(b))
      text += fmt::format(" {:.17g},{:.17g}", v[0] + 0.0, v[2] + 0.0);
    text += "\n";
  }
  text += fmt::format("change mat=1\nprop mat=1 dens={:.17g}\n", p.blocks.front().density);
  if (joint)
    text += fmt::format(
        "change jmat=1 jcons=2\nset jmatdf=1 jcondf=2\nprop jmat=1 jkn={:g} jks={:g} jfric={:g} jcoh={:g} "
        "jten={:g}\n",
        joint->stiff.normal, joint->stiff.shear, joint->friction_deg, joint->cohesion, joint->tension);
  if (joint && joint->stated)
    text +=
        fmt::format("; stated joints: prop jmat=1 jkn={:g} jks={:g}\n", joint->stated->normal, joint->stated->shear);
  for (const Solid& b : p.blocks)
    if (b.fixed)
      text += fmt::format("fix range {0:.12g} {1:.12g} {2:.12g} {3:.12g}\n", b.centre[0] - 1e-3 * size,
                          b.centre[0] + 1e-3 * size, b.centre[2] - 1e-3 * size, b.centre[2] + 1e-3 * size);
  for (const GivenForce& f : p.forces)
    text += fmt::format(
        "; force at {:.9g},{:.9g} on {} that grows with gravity\nload {:.17g} {:.17g} range {:.9g} {:.9g} "
        "{:.9g} {:.9g}\n",
        f.point[0], f.point[2], f.block, f.force[0], f.force[2], f.point[0] - 0.01, f.point[0] + 0.01,
        f.point[2] - 0.01, f.point[2] + 0.01);
  text += "damp 0.1 1.0\n" + udec_stages(p);
  return text;
}

std::string scene_text(const Problem& p) {
  const JointOf* joint = joint_of(p);
  const GravityAt& full = p.gravity.back();
  std::string text = fmt::format(
      "# A problem for any code, as a scene with its stiff joints: one trial of its search.\n"
      "title = \"{}\"\ndimension = {}\n",
      p.title, p.dimension);
  if (joint && joint->tension > 0) text += "contact = { face = \"point\" }\n";
  if (full.gravity.norm() > 0) text += "gravity = " + toml_vector(full.gravity, p.dimension) + "\n";
  text += "\n";
  for (const Solid& b : p.blocks)
    text += toml_block(b, p.dimension);
  if (joint) {
    text += fmt::format(
        "[[joint_properties]]\nname = \"default\"\nnormal_stiffness = {:.17g}\nshear_stiffness = {:.17g}\n"
        "friction_deg = {:.17g}\n",
        joint->stiff.normal, joint->stiff.shear, joint->friction_deg);
    if (joint->tension > 0)
      text += fmt::format("tension = {:.17g}\ncohesion = {:.17g}\nbonds = \"by_stage\"\nsub_contacts = 32\n",
                          joint->tension, joint->cohesion);
    text += "\n";
  }
  for (const Bolt& b : p.bolts)
    text +=
        fmt::format("[[bolts]]\nname = \"{}\"\nfrom = {}\nto = {}\nstiffness = {:.17g}\nyield = {:.17g}\n\n", b.name,
                    toml_vector(b.from, p.dimension), toml_vector(b.to, p.dimension), b.stiffness, b.yield_force);
  if (joint && joint->tension > 0) text += pressing_stage(p);
  text += fmt::format("[[stage]]\nname = \"trial\"\nkind = \"run\"\nduration_s = {:g}\n", p.duration);
  if (full.time > 0) text += fmt::format("gravity_ramp_s = {:g}\n", full.time);
  if (!p.bolts.empty()) text += "install = [\"" + p.bolts.front().name + "\"]\n";
  if (joint && joint->tension > 0) text += "gravity_to = 1\n";
  for (const Solid& b : p.blocks)
    if (!b.fixed && p.blocks.size() < 50)
      text += fmt::format(
          "\n[[monitors]]\nname = \"{0}\"\nbodies = [\"{0}\"]\nquantities = [\"displacement\", \"velocity\", "
          "\"rotation\", \"angular_velocity\"]\n",
          b.name);
  return text + fmt::format("\n[output]\nhistory_interval_s = {:g}\n", p.output);
}

std::string three_dec_stages(const Problem& p) {
  std::string text =
      "; stages of the problem: not run, and their words not compared with the manual\n" + trial_text(p, ";");
  for (const Solid& b : p.blocks) {
    if (b.velocity.norm() > 0)
      text += fmt::format("; initial velocity of {}: {:.17g},{:.17g},{:.17g} m/s\n", b.name, b.velocity[0],
                          b.velocity[1], b.velocity[2]);
    if (b.spin.norm() > 0)
      text += fmt::format("; initial angular velocity of {}: {:.17g},{:.17g},{:.17g} rad/s\n", b.name, b.spin[0],
                          b.spin[1], b.spin[2]);
  }
  for (std::size_t k = 1; k < p.gravity.size(); ++k)
    for (int i = 1; i <= gravity_steps; ++i) {
      const double fraction = (i - 0.5) / gravity_steps;
      const Point g = p.gravity[k - 1].gravity + fraction * (p.gravity[k].gravity - p.gravity[k - 1].gravity);
      text += fmt::format("model gravity {:.17g} {:.17g} {:.17g}\nmodel solve time {:g}\n", g[0] + 0.0, g[1] + 0.0,
                          g[2] + 0.0, (p.gravity[k].time - p.gravity[k - 1].time) / gravity_steps);
    }
  const Point g = p.gravity.back().gravity;
  return text + fmt::format("model gravity {:.17g} {:.17g} {:.17g}\nmodel solve time {:g}\n", g[0] + 0.0, g[1] + 0.0,
                            g[2] + 0.0, p.duration - p.gravity.back().time);
}

}  // namespace voussoir::problems
