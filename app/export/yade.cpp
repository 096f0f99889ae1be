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

// name, material, vertices, whether it is fixed, blocked degrees of freedom
std::string block_text(const Body<3>& body, std::size_t b, const Vector<3>& origin, const std::string& material) {
  const std::string name = body.name.empty() ? fmt::format("block-{}", b) : body.name;
  if (body.parts.size() > 1)
    throw BadInput(
        fmt::format("block {} is one body of {} convex parts, which the text for YADE cannot express; leave out their "
                    "connection "
                    "(part_of, construction joints, outlines, slicing.ends = \"healed\")",
                    name, body.parts.size()));
  std::string vertices;
  for (const Vector<3>& v : body.parts[0].vertices) {
    const Vector<3> at = origin + (body.reference + v);
    vertices += fmt::format("{}({}, {}, {})", vertices.empty() ? "" : ", ", at[0] + 0.0, at[1] + 0.0, at[2] + 0.0);
  }
  return fmt::format("block({}, {}, [{}], {}, '{}')\n", python_text(name), material, vertices,
                     body.fixed ? "True" : "False", blocked(body));
}

constexpr const char* functions = R"(
def block(name, material, vertices, fixed, blocked):
    body = polyhedra_utils.polyhedra(material, v=vertices, fixed=fixed)
    if not fixed:
        body.state.blockedDOFs = blocked
    names[O.bodies.append(body)] = name

)";

}  // namespace

// YADE's volumetric law: the overlap's volume times kn is the area integral of kn times the overlap, moment included. A
// contact of two bodies has half of their `young`, and ks = poisson kn for any area.
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
          "{0} = PolyhedraMat(young={1}, poisson={2}, frictionAngle=radians({3}), density={4}, label='{0}')\n"
          "O.materials.append({0})\n",
          at->second, 2 * p.normal_stiffness, p.shear_stiffness / p.normal_stiffness, to_degrees(p.friction), density);
    blocks += block_text(body, b, model.origin, at->second);
  }

  std::string text =
      "# -*- encoding=utf-8 -*-\n" + export_head(scene, "YADE with Polyhedra, which Debian's package has", "#",
                                                 "Texts of this form were run in YADE 2023.02a; this one was not.");
  text += "from math import radians\nfrom yade import polyhedra_utils\n\n";
  text += fmt::format(
      "# {}: normal stiffness in Pa/m over each contact; the shear stiffness of each contact is that of 1 m2\n",
      p.name);
  text += fmt::format(
      "O.engines = [\n    ForceResetter(),\n    InsertionSortCollider([Bo1_Polyhedra_Aabb()]),\n"
      "    InteractionLoop(\n        [Ig2_Polyhedra_Polyhedra_PolyhedraGeom()],\n"
      "        [Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys()],\n"
      "        [Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()]),\n"
      "    NewtonIntegrator(damping=0, exactAsphericalRot=True, gravity=[{}, {}, {}]),\n]\n",
      model.gravity[0], model.gravity[1], model.gravity[2]);
  text += materials_text + "names = {}\n" + functions + blocks;
  return text +
         fmt::format("\n# a tenth of the step that the lightest block on its largest face would allow\nO.dt = {}\n",
                     time_step(model, p.normal_stiffness));
}

}  // namespace voussoir
