// Scenes composed from pieces of text, and the output of `voussoir check` for them.
#pragma once

#include "app/testing/program.hpp"

namespace voussoir::program {

inline const std::string head_in_plane = "dimension = 2\ngravity = [0, -10]\ndensity = 2000\n";

inline const std::string rock_properties =
    "[[joint_properties]]\nname = \"rock\"\nnormal_stiffness = 1e9\nshear_stiffness = 1e8\nfriction_deg = 30\n";

inline const std::string settle_stage = "[[stage]]\nname = \"rest\"\nkind = \"settle\"\n";

// a square block in the plane
inline std::string box(const std::string& name, double x, double y, double size = 1) {
  return fmt::format("[[blocks]]\nname = \"{}\"\nbox = {{ min = [{}, {}], max = [{}, {}] }}\n", name, x, y, x + size,
                     y + size);
}

class CheckedScene : public Program {
 protected:
  std::string check(const std::string& scene, const std::string& more = "") const {
    write("scene.toml", scene);
    const Ended ended = run("check scene.toml " + more);
    EXPECT_EQ(ended.code, 0) << ended.err << scene;
    return ended.out;
  }
  void refused(const std::string& scene, const std::string& part) const {
    write("scene.toml", scene);
    expect_one_line(run("check scene.toml"), 2, part);
  }
};

}  // namespace voussoir::program
