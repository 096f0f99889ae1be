// Blocks in the plane for the tests of limit analysis.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "core/limit/limit.hpp"
#include "core/scene/scene.hpp"

namespace voussoir::limit_models {

using Points = std::vector<Vector<2>>;

struct TestBlock {
  std::string name;
  Points corners;
  bool fixed = false;
  std::string part_of = {};
};

inline Points box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

inline Points turned(Points points, double angle) {
  for (Vector<2>& p : points)
    p = matrix(Rotation<2>{angle}) * p;
  return points;
}

inline std::string text_of(const std::vector<TestBlock>& blocks, double friction_deg) {
  std::ostringstream text;
  text.precision(17);
  text << "dimension = 2\ngravity = [0, -10]\ndensity = 2000\n[[joint_properties]]\nname = \"rock\"\n"
       << "normal_stiffness = 1e9\nshear_stiffness = 1e9\nfriction_deg = " << friction_deg << '\n';
  for (const TestBlock& block : blocks) {
    text << "[[blocks]]\nname = \"" << block.name << "\"\n";
    if (block.fixed) text << "fixed = true\n";
    if (!block.part_of.empty()) text << "part_of = \"" << block.part_of << "\"\n";
    const char* separator = "vertices = [";
    for (const Vector<2>& p : block.corners) {
      text << separator << "[" << p[0] << ", " << p[1] << "]";
      separator = ", ";
    }
    text << "]\n";
  }
  text << "[[stage]]\nname = \"settle\"\nkind = \"settle\"\n";
  return text.str();
}

inline Model<2> model_of(const std::vector<TestBlock>& blocks, double friction_deg = 30) {
  return prepare<2>(parse_scene(text_of(blocks, friction_deg), "test.toml")).model;
}

// a block `width` by `height` on a fixed plate that dips by `slope`
inline Model<2> block_on_plate(double width, double height, double slope, double friction_deg = 30) {
  return model_of({{"plate", turned(box(-3, -1, 3, 0), slope), true},
                   {"block", turned(box(-width / 2, 0, width / 2, height), slope)}},
                  friction_deg);
}

// with weights of its gravity
inline CornerAssembly<2> assembly_of(const Model<2>& model, bool bonded = false) {
  const double gravity = model.gravity.norm();
  return corner_assembly(model, gravity > 0 ? gravity : 1, bonded);
}

inline CriticalStrength<2> critical_friction(const Model<2>& model, const std::vector<std::string>& properties = {}) {
  const CornerAssembly<2> assembly = assembly_of(model);
  return find_critical_friction(assembly, loads_of_acceleration(model, model.gravity), faces_of(assembly, properties));
}

inline CriticalStrength<2> factor_of_safety(const Model<2>& model, const std::vector<std::string>& properties = {},
                                            bool bonded = false) {
  const CornerAssembly<2> assembly = assembly_of(model, bonded);
  return find_factor_of_safety(assembly, loads_of_acceleration(model, model.gravity), faces_of(assembly, properties));
}

}  // namespace voussoir::limit_models
