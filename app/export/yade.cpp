#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "app/export/formats.hpp"
#include "core/base/bad_input.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

constexpr double rounding_radius = 0.1;  // r, of a block's inscribed radius: far from its corners

// of the critical step of a block on its largest face: as in YADE's examples
constexpr double step_fraction = 0.1;

std::string python_text(const std::string& name) {
  std::string text = "'";
  for (const char c : name)
    text += c == '\'' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return text + "'";
}

const JointProperties& only_properties(const ExportedScene& scene) {
  const Model<3>& model = *scene.model;
  if (scene.properties.size() != 1) {
    std::vector<std::string> names;
    for (const int p : scene.properties)
      names.push_back(model.properties[p].name);
    throw BadInput(
        fmt::format("contacts have {} joint_properties ({}), and the text for YADE has one stiffness and friction "
                    "for all; give "
                    "all joints the same",
                    names.size(), listed(names)));
  }
  const JointProperties& p = model.properties[scene.properties.front()];
  if (p.tension > 0 || p.cohesion > 0)
    throw BadInput(
        fmt::format("joint_properties.{} has tension or cohesion, which the text for YADE cannot express; remove "
                    "them, or export for 3DEC",
                    p.name));
  return p;
}

double area_of(const Polytope<3>& part, std::size_t face) {
  const std::vector<int>& loop = part.loops[face];
  Vector<3> twice = Vector<3>::Zero();
  for (std::size_t k = 1; k + 1 < loop.size(); ++k)
    twice +=
        (part.vertices[loop[k]] - part.vertices[loop[0]]).cross(part.vertices[loop[k + 1]] - part.vertices[loop[0]]);
  return twice.norm() / 2;
}

// s: the stiffest block on its largest face
double time_step(const Model<3>& model, double normal_stiffness) {
  double step = std::numeric_limits<double>::infinity();
  for (const Body<3>& body : model.bodies)
    for (std::size_t f = 0; f < body.parts[0].loops.size(); ++f)
      step = std::min(step, std::sqrt(body.mass / (normal_stiffness * area_of(body.parts[0], f))));
  return step_fraction * step;
}

std::string blocked(const Body<3>& body) {
  std::string text;
  for (int k = 0; k < 3; ++k)
    if (!body.free_translation[k]) text += "xyz"[k];
  for (int k = 0; k < 3; ++k)
    if (!body.free_rotation[k]) text += "XYZ"[k];
  return text;
}

// name, material, centroid, planes relative to it, r, whether it is fixed, blocked degrees of freedom
std::string block_text(const Body<3>& body, std::size_t b, const Vector<3>& origin, const std::string& material) {
  const std::string name = body.name.empty() ? fmt::format("block-{}", b) : body.name;
  if (body.parts.size() > 1)
    throw BadInput(
        fmt::format("block {} is one body of {} convex parts, which the text for YADE cannot express; leave out their "
                    "connection "
                    "(part_of, construction joints, outlines, slicing.ends = \"healed\")",
                    name, body.parts.size()));
  const Vector<3> place = origin + body.reference;
  std::string planes;
  for (const HalfSpace<3>& face : body.parts[0].faces)
    planes += fmt::format("{}({}, {}, {}, {})", planes.empty() ? "" : ", ", face.normal[0] + 0.0, face.normal[1] + 0.0,
                          face.normal[2] + 0.0, face.offset);  // of two zeros the positive one
  return fmt::format("block({}, '{}', ({}, {}, {}), [{}], {}, {}, '{}')\n", python_text(name), material, place[0],
                     place[1], place[2], planes, rounding_radius * body.size, body.fixed ? "True" : "False",
                     blocked(body));
}

constexpr const char* functions = R"(
def block(name, material, centroid, planes, r, fixed, blocked):
    """A block of half-spaces n x <= d about its centroid; PotentialBlock takes d less its radius r."""
    body = Body()
    body.mask = 1
    body.aspherical = True
    body.shape = PotentialBlock(
        k=0.0, r=r, R=0.0, a=[p[0] for p in planes], b=[p[1] for p in planes], c=[p[2] for p in planes],
        d=[p[3] - r for p in planes], isBoundary=fixed, AabbMinMax=True, fixedNormal=False, id=len(O.bodies))
    utils._commonBodySetup(body, body.shape.volume, body.shape.inertia, material=material, pos=centroid, fixed=fixed)
    body.state.pos = centroid
    body.state.ori = body.shape.orientation
    if not fixed:
        body.state.blockedDOFs = blocked
    names[O.bodies.append(body)] = name

)";

}  // namespace

std::string yade_text(const ExportedScene& scene) {
  const Model<3>& model = *scene.model;
  const JointProperties& p = only_properties(scene);
  std::map<double, std::string> materials;  // by density
  std::string materials_text, blocks;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<3>& body = model.bodies[b];
    // to twelve digits: the same rock has volumes that round differently
    const std::string density = fmt::format("{:.12g}", body.mass / body.parts[0].mass.volume);
    const auto [at, first] = materials.try_emplace(std::stod(density), fmt::format("rock{}", materials.size() + 1));
    if (first)
      materials_text += fmt::format(
          "O.materials.append(FrictMat(young=-1, poisson=-1, frictionAngle=radians({}), density={}, label='{}'))\n",
          to_degrees(p.friction), density, at->second);
    blocks += block_text(body, b, model.origin, at->second);
  }

  std::string text = "# -*- encoding=utf-8 -*-\n" + export_head(scene, "YADE with PotentialBlock", "#");
  text += "from math import radians\nfrom yade import utils\n\n";
  text += fmt::format("# {}: stiffness in Pa/m times the contact's area\n", p.name);
  text += fmt::format(
      "O.engines = [\n    ForceResetter(),\n    InsertionSortCollider([PotentialBlock2AABB()], verletDist=0),\n"
      "    InteractionLoop(\n        [Ig2_PB_PB_ScGeom()],\n        [Ip2_FrictMat_FrictMat_KnKsPBPhys(kn_i={0}, "
      "ks_i={1}, Knormal={0}, Kshear={1}, viscousDamping=0)],\n        [Law2_SCG_KnKsPBPhys_KnKsPBLaw(label='law')]),\n"
      "    NewtonIntegrator(damping=0, exactAsphericalRot=True, gravity=[{2}, {3}, {4}]),\n]\n",
      p.normal_stiffness, p.shear_stiffness, model.gravity[0], model.gravity[1], model.gravity[2]);
  text += materials_text + "names = {}\n" + functions + blocks;
  return text +
         fmt::format("\n# a tenth of the step that the lightest block on its largest face would allow\nO.dt = {}\n",
                     time_step(model, p.normal_stiffness));
}

}  // namespace voussoir
