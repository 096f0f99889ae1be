// A good scene, and mistakes in it with the reports that they must cause.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "core/scene/read_stages.hpp"
#include "core/scene/scene.hpp"
#include "text/plain_text.hpp"

namespace voussoir::bad_scenes {

inline const std::string good_scene = R"(title = "Two blocks on an incline"
dimension = 3
gravity = [0, 0, -9.81]
density = 2600
[domain]
box = { min = [-2, -2, -2], max = [2, 2, 2] }
[[joints]]
name = "A"
dip = 30
dip_direction = 90
point = [0, 0, 0]
[[joints]]
name = "B"
dip = 90
dip_direction = 0
point = [0, 0.5, 0]
properties = "rock"
[[joint_properties]]
name = "rock"
normal_stiffness = 1e9
shear_stiffness = 1e8
friction_deg = 40
[[blocks]]
name = "far"
box = { min = [10, 0, 0], max = [11, 1, 1] }
[[fix]]
below = ["A"]
[damping]
local = 0.7
[[stage]]
name = "settle"
kind = "settle"
[[stage]]
name = "reduce"
kind = "reduce"
from_deg = 40
to_deg = 5
tolerance_deg = 0.01
failure_displacement = 0.01
[[monitors]]
name = "slider"
quantities = ["displacement"]
above = ["A", "B"]
[[monitors]]
name = "on A"
joint = "A"
quantities = ["contact_force"]
)";

struct BadInput {
  const char* name;
  std::string from, to;  // replaced in the good scene; an empty `from` appends. #! marks the line of the error
  std::string key;       // the address and value as the error must show them
  std::string phrase;    // of the permitted values, or of the repair
};

inline void PrintTo(const BadInput& bad, std::ostream* out) {
  *out << bad.name;
}

inline std::string edited(const BadInput& bad) {
  std::string text = good_scene;
  if (bad.from.empty()) return text + bad.to;
  const std::size_t at = text.find(bad.from);
  EXPECT_NE(at, std::string::npos) << "the good scene has no " << bad.from;
  return at == std::string::npos ? text : text.replace(at, bad.from.size(), bad.to);
}

inline int marked_line(const std::string& text) {
  const std::size_t mark = text.find("#!");
  if (mark == std::string::npos) return 0;
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + mark, '\n'));
}

// The parts of an error must be those of its message.
inline void expect_parts(const SceneError& error) {
  const std::string message = error.what();
  EXPECT_EQ(error.file, "scene.toml") << message;
  const std::string place = error.file + (error.line > 0 ? ":" + std::to_string(error.line) : "") + ": ";
  EXPECT_TRUE(message.starts_with(place)) << message << "\nexpected place " << place;
  EXPECT_NE(message.find(one_line(error.key, 200)), std::string::npos) << message << "\nexpected key " << error.key;
}

// the error of reading and preparing a scene; empty without one
inline std::string complaint_about(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    const Scene scene = parse_scene(text, "scene.toml", overrides);
    require_stages(scene);
    scene.dimension == 2 ? void(prepare<2>(scene)) : void(prepare<3>(scene));
  } catch (const SceneError& error) {
    expect_parts(error);
    return error.what();
  }
  return "";
}

inline std::string by_name(const testing::TestParamInfo<BadInput>& info) {
  return info.param.name;
}

inline void expect_reported(const BadInput& bad) {
  const std::string text = edited(bad);
  const std::string message = complaint_about(text);
  ASSERT_NE(message, "") << "accepted";
  EXPECT_EQ(message.find_first_of("\n\r"), std::string::npos) << message;
  const int line = marked_line(text);
  EXPECT_TRUE(message.starts_with("scene.toml:" + (line ? std::to_string(line) + ": " : "")))
      << message << "\nexpected line " << line;
  EXPECT_NE(message.find(bad.key), std::string::npos) << message;
  EXPECT_NE(message.find(bad.phrase), std::string::npos) << message;
}

}  // namespace voussoir::bad_scenes
