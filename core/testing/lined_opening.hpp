// A lined opening in jointed rock, for tests.
#pragma once

#include <string>
#include <vector>

#include "core/stage/install_linings.hpp"
#include "core/testing/whole_runs.hpp"

namespace voussoir::lined_opening {

// A twelve-sided opening in three blocks, whose middle joint crosses the outline; the rock is held at its sides.
inline const std::string rock = R"(
dimension = 2
gravity = [0, -10]
density = 2500
domain = { box = { min = [-12, -12], max = [12, 12] } }
equilibrium = { unbalanced = 1e-9 }
joint_properties = [{ name = "bed", normal_stiffness = 1e9, shear_stiffness = 5e8, friction_deg = 40, sub_contacts = 2 },
                    { name = "contact", normal_stiffness = 1e9, shear_stiffness = 5e8, friction_deg = 30 }]
[[excavations]]
name = "tunnel"
outline = true
cylinder = { from = [0, 0], radius = 3, sides = 12 }
[[joints]]
name = "left"
dip = 60
dip_direction = 90
point = [-1, 2]
properties = "bed"
[[joints]]
name = "right"
dip = 70
dip_direction = 270
point = [0.8, 2]
properties = "bed"
)";
inline const std::string shell = R"(
[[linings]]
name = "shell"
excavation = "tunnel"
joint_properties = "contact"
nodes = 48
thickness = 0.2
young_modulus = 20e9
)";
inline const std::string held =
    "[[fix]]\nside = [\"left\"]\n[[fix]]\nside = [\"right\"]\n[[fix]]\nside = [\"bottom\"]\n";

inline std::string stage(const std::string& name, const std::string& more) {
  return "[[stage]]\nname = \"" + name + "\"\nkind = \"settle\"\n" + more + "\n";
}
inline const std::string dig =
    stage("weight", "gravity_ramp_s = 1") +
    stage("dig", "excavate = [\"tunnel\"]\nexcavation_forces = { remaining = 0.5, duration_s = 1 }") +
    stage("line", "install = [\"shell\"]\nexcavation_forces = { remaining = 0, duration_s = 1 }");

// The state in which the lining of `rock` has just been cast.
struct Cast {
  Prepared<2> scene;
  Model<2> model;
  State<2> state;

  explicit Cast(const std::string& text = rock + held + shell +
                                          stage("dig", "excavate = [\"tunnel\"]\ninstall = [\"shell\"]"))
      : scene(scene_of(text)) {
    model = apply(scene.model, scene.stages.front().change);
    state = scene.state;
    add_bodies(model, state.bodies, state.contacts, state.loads, state.time_step);
    install_linings(model, scene.stages.front().change.install, state);
    cache_poses(model, 1, state.bodies);
  }
  const Lining& lining() const { return model.linings.front(); }
  int body(int node) const { return lining().first_body + node; }
};

}  // namespace voussoir::lined_opening
