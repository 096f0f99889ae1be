#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "app/base/dip_angles.hpp"
#include "app/export/formats.hpp"
#include "core/base/bad_input.hpp"

namespace voussoir {
namespace {

// of the smallest block's inscribed radius: the distance from a joint's plane, or a block's centroid, that is selected
constexpr double nearness = 1e-3;

double smallest_block(const Model<3>& model) {
  double size = model.bodies.front().size;
  for (const Body<3>& body : model.bodies)
    size = std::min(size, body.size);
  return size;
}

std::string point_text(const Vector<3>& p) {
  return fmt::format("{},{},{}", p[0], p[1], p[2]);
}

// a name between quotes of the data file; the part before '=' in a group's name is its slot
std::string slot_name(std::string name) {
  std::ranges::replace(name, '\'', '_');
  std::ranges::replace(name, '=', '_');
  return "'" + name + "'";
}

std::string name_of(const Body<3>& body, std::size_t b) {
  return body.name.empty() ? fmt::format("block-{}", b) : body.name;
}

// faces clockwise seen from outside, as 3DEC wants them
std::string polyhedron(const Polytope<3>& part, const Vector<3>& place) {
  std::string text = "block create polyhedron &\n";
  for (std::size_t f = 0; f < part.loops.size(); ++f) {
    text += "  face";
    for (auto v = part.loops[f].rbegin(); v != part.loops[f].rend(); ++v)
      text += " " + point_text(place + part.vertices[*v]);
    text += f + 1 < part.loops.size() ? " &\n" : "\n";
  }
  return text;
}

// blocks are selected by their centroid
std::string range_of(const Vector<3>& centroid, double within) {
  std::string text = " range";
  for (int k = 0; k < 3; ++k)
    text += fmt::format(" position-{} {} {}", "xyz"[k], centroid[k] - within, centroid[k] + within);
  return text + "\n";
}

// properties of every contact
std::string elastic_friction(const JointProperties& p) {
  std::string text = fmt::format("property stiffness-normal {} stiffness-shear {} friction {}", p.normal_stiffness,
                                 p.shear_stiffness, to_degrees(p.friction));
  if (p.laws.dilation == DilationLaw::constant)
    text += fmt::format(" dilation {} dilation-zero {}", to_degrees(p.dilation), p.dilation_until);
  return text;
}

std::string properties_text(const JointProperties& p) {
  return fmt::format("block contact {} cohesion {} tension {}", elastic_friction(p), p.cohesion, p.tension);
}

// Contacts that form later have the most common properties without their bond, as here. 3DEC has no stiffness of its
// own for them, and in large strain does not cycle without one.
std::string later_contacts(const JointProperties& common) {
  return fmt::format(
      "; contacts that form later\nblock contact material-table default jmodel mohr\n"
      "block contact material-table default {}\n",
      elastic_friction(common));
}

double density(const Body<3>& body) {
  double volume = 0;
  for (const Polytope<3>& part : body.parts)
    volume += part.mass.volume;
  return body.mass / volume;
}

std::string blocks_text(const Model<3>& model, double within) {
  std::string text;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<3>& body = model.bodies[b];
    if (body.parts.size() > 1 && !body.fixed)
      throw BadInput(fmt::format(
          "block {} is one body of {} convex parts, which the text for 3DEC cannot express for a block that moves; "
          "leave out "
          "their connection (part_of, construction joints, outlines, slicing.ends = \"healed\"), or fix it",
          name_of(body, b), body.parts.size()));
    const Vector<3> place = model.origin + body.reference;
    text += fmt::format("; {}\n", name_of(body, b));
    for (const Polytope<3>& part : body.parts) {
      text += polyhedron(part, place);
      const std::string range = range_of(place + part.mass.centroid, within);
      text += "block group " + slot_name(name_of(body, b)) + range;
      text += fmt::format("block property density {:.12g}", density(body)) + range;
      if (body.fixed) text += "block fix" + range;
    }
  }
  return text;
}

std::string joints_text(const ExportedScene& scene, double within) {
  const Model<3>& model = *scene.model;
  if (scene.properties.empty()) return "";
  const JointProperties& common = model.properties[scene.properties.front()];
  std::string text = "block contact generate-subcontacts\nblock contact jmodel assign mohr\n";
  text += fmt::format("; {}\n{}\n", common.name, properties_text(common)) + later_contacts(common);
  for (const int j : scene.joints) {
    const Joint<3>& joint = model.joints[j];
    const JointProperties& own = model.properties[joint.properties];
    const Vector<3> point = model.origin + joint.plane.offset * joint.plane.normal;
    const DipAndDirection angles = angles_of(joint.plane.normal);
    text += fmt::format("; joint {}: dip {:.6g} dip-direction {:.6g} origin {}, {}\n", joint.name, angles.dip,
                        angles.direction, point_text(point), own.name);
    if (joint.properties != scene.properties.front())
      text += fmt::format("{} range plane normal {} origin {} distance {}\n", properties_text(own),
                          point_text(joint.plane.normal), point_text(point), within);
  }
  return text;
}

// restrained degrees of freedom of blocks that are not fixed
void add_restraints(ExportedScene& scene) {
  int restrained = 0;
  for (const Body<3>& body : scene.model->bodies)
    restrained += !body.fixed && !(std::ranges::count(body.free_translation, true) == 3 &&
                                   std::ranges::count(body.free_rotation, true) == 3);
  if (restrained > 0) scene.left_out.push_back(fmt::format("restraints of {} blocks, which here are free", restrained));
}

}  // namespace

std::string three_dec_text(const ExportedScene& stated) {
  ExportedScene scene = stated;
  add_restraints(scene);
  const Model<3>& model = *scene.model;
  const double within = nearness * smallest_block(model);
  std::string text =
      export_head(scene, "3DEC 7", ";",
                  "It was NOT run in 3DEC 7: neither its syntax nor its results were checked by that program.");
  text += "model new\nmodel large-strain on\n";
  text += blocks_text(model, within);
  text += fmt::format("model gravity {} {} {}\n", model.gravity[0], model.gravity[1], model.gravity[2]);
  return text + joints_text(scene, within);
}

}  // namespace voussoir
