// Scenes with a table for every key, and the place in them at which a value of a key can be set, from the key table.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/scene/keys.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/toml_text.hpp"

namespace voussoir::every_key {

inline const std::string everything = R"(dimension = 3
density = 2000
[domain]
box = { min = [-1, -1, -1], max = [1, 1, 1] }
[[domain.planes]]
dip = 0
point = [0, 0, 0.9]
keep = "below"
[[joints]]
name = "A"
dip = 0
point = [0, 0, 0]
properties = "rock"
[[joints]]
name = "ellipse"
dip = 90
dip_direction = 90
point = [0.2, 0, 0]
shape = "ellipse"
length = 5
width = 5
properties = "rock"
[[joints]]
name = "polygon"
dip = 0
point = [0, 0, 0.5]
shape = "polygon"
corners = [[-0.5, -0.5, 0.5], [0.6, -0.5, 0.5], [0.5, 0.7, 0.5]]
properties = "rock"
[[joints]]
name = "boundary"
dip = 0
point = [0, 0, -0.8]
kind = "boundary"
fixed_side = "below"
properties = "rock"
[[excavations]]
name = "tunnel"
cylinder = { from = [0.3, -2, -0.3], to = [0.3, 2, -0.3], radius = 0.2 }
outline = true
smallest_piece = 0.06
[[joint_sets]]
name = "plain"
dip = 30
dip_direction = 90
intensity = 1e-9
[[joint_sets]]
name = "equal"
dip = 30
dip_direction = 90
arrangement = "equal"
intensity = 1e-9
[[joint_sets]]
name = "fisher"
dip = 30
dip_direction = 90
scatter = "fisher"
fisher_constant = 100
intensity = 1e-9
[[joint_sets]]
name = "finite"
dip = 30
dip_direction = 90
scatter = "normal"
dip_deviation_deg = 5
size = "lognormal"
size_mean = 5
size_deviation = 1
spacing = 1e9
[[joint_properties]]
name = "rock"
normal_stiffness = 1e9
shear_stiffness = 1e8
friction_deg = 30
[[joint_properties]]
name = "linear"
normal_stiffness = 4e9
normal_law = "linear"
normal_growth = 1e4
shear_stiffness = 1e8
shear_law = "linear"
shear_growth = 1e4
friction_deg = 30
friction_law = "hardening"
hardening_slip_m = 1e-6
cohesion = 1e5
cohesion_law = "softening"
cohesion_slip_m = 1e-3
[[joint_properties]]
name = "power"
normal_stiffness = 2e6
normal_law = "power"
normal_exponent = 0.75
shear_stiffness = 2e6
shear_law = "power"
shear_exponent = 0.7
friction_deg = 30
friction_law = "softening"
softening_drop = 0.1
softening_slip_m = 0.1
dilation_law = "falling"
dilation_deg = 8
dilation_decay_m = 0.002
[[joint_properties]]
name = "hyperbolic"
normal_stiffness = 1e10
normal_law = "hyperbolic"
maximum_closure_m = 2e-4
shear_stiffness = 4e9
friction_deg = 30
dilation_law = "constant"
dilation_deg = 8
dilation_until_m = 0.004
[[joint_properties]]
name = "rough"
normal_stiffness = 1e10
shear_stiffness = 4e9
friction_deg = 26
friction_law = "barton_bandis"
jrc = 10
jcs = 50e6
block_length_m = 0.5
sample_length_m = 0.1
[[blocks]]
name = "by planes"
planes = [{ normal = [1, 0, 0], offset = 11 }, { normal = [-2, 0, 0], offset = -20 },
          { normal = [0, 1, 0], offset = 1 }, { normal = [0, -1, 0], offset = 1 },
          { normal = [0, 0, 1], point = [0, 0, 1] }, { normal = [0, 0, -1], offset = 0 }]
[[blocks]]
name = "by vertices"
vertices = [[20, 0, 0], [21, 0, 0], [20, 1, 0], [20, 0, 1]]
[[blocks]]
name = "stone"
box = { min = [30, 0, 0], max = [31, 1, 1] }
[[repeat]]
blocks = ["stone"]
count = 2
shift = [0, 0, 5]
turn_deg = 12
about = [30, 0, 0]
axis = [0, 1, 0]
[[water]]
name = "lake"
level = 0.2
faces = "outer"
[[water]]
name = "seep"
faces = ["ellipse"]
table = { point = [0, 0, 0.1], dip = 5, dip_direction = 90 }
[[water]]
name = "grout"
faces = ["polygon"]
pressure = 1000
[[bolts]]
name = "roof"
fan = { centre = [0.1, -0.5, 0], axis = [0, 1, 0], from_deg = 45, to_deg = 135, spacing_deg = 45, length = 1 }
repeat = [{ step = [0, 0.5, 0], count = 3 }]
stiffness = 2e8
[[bolts]]
name = "dowel"
from = [0.3, 0.1, -0.9]
to = [0.3, 0.1, 0.9]
stiffness = 2e8
dowel_stiffness = 1e7
[[bolts]]
name = "anchor"
kind = "end_anchored"
from = [0.1, 0.1, -0.9]
to = [0.1, 0.1, 0.9]
axial_stiffness = 1e8
yield = 1e5
[[bolts]]
name = "bar"
kind = "grouted"
from = [0.2, 0.2, -0.9]
to = [0.2, 0.2, 0.9]
axial_stiffness = 1e8
bond_stiffness = 5e8
plate = "spring"
plate_stiffness = 1e8
[[bolts]]
name = "plain bar"
kind = "grouted"
from = [0.2, 0.3, -0.9]
to = [0.2, 0.3, 0.9]
axial_stiffness = 1e8
bond_stiffness = 5e8
[[fix]]
below = ["A"]
[[restrain]]
bodies = ["by vertices"]
rotation = true
[[initial_velocity]]
bodies = ["by planes"]
velocity = [1, 0, 0]
[contact]
[damping]
[time]
[equilibrium]
[slicing]
[accuracy]
[[stage]]
name = "settle"
kind = "settle"
statics = "adaptive"
static_increments = 4
damping = {}
fix = [{ bodies = ["by planes"] }]
water = [{ name = "lake", level = 0.1, duration_s = 5 }]
excavate = ["tunnel"]
install = ["roof", "anchor", "dowel", "bar", "plain bar"]
excavation_forces = { remaining = 0.5, duration_s = 1 }
[[stage]]
name = "run"
kind = "run"
duration_s = 1
damping = { local = 0 }
water = [{ name = "lake", level = 0.2, rate = 1 }]
release = [{ bodies = ["by planes"] }]
remove = [{ bodies = ["by vertices"] }]
move = [{ bodies = ["by planes"], velocity = [1, 0, 0], frequency_hz = 1 }]
friction = [{ name = "rock", friction_deg = 35 }, { name = "rough", friction_deg = 40 }]
boundary = [{ bodies = ["by vertices"], stress = [1, 1, 0, 0, 0, 0], in_situ = { surface = 0.5, k0 = 0.5, k0_y = 0.6, unit_weight = 2e4 } }]
force = [{ name = "push", bodies = ["by planes"], force = [1, 0, 0], point = [10.5, 0, 0.5] }]
[[stage]]
name = "bisection"
kind = "reduce"
from_deg = 60
to_deg = 5
tolerance_deg = 0.01
[[stage]]
name = "steps"
kind = "reduce"
method = "steps"
from_deg = 60
to_deg = 5
step_deg = 0.5
[[stage]]
name = "factor"
kind = "reduce"
search = "factor"
friction_deg = 30
from_factor = 0.8
to_factor = 2
tolerance_factor = 0.02
[[stage]]
name = "factor_steps"
kind = "reduce"
search = "factor"
friction_deg = 30
method = "steps"
from_factor = 0.8
to_factor = 2
step_factor = 0.02
[[stage]]
name = "rate"
kind = "reduce"
method = "rate"
from_deg = 60
to_deg = 5
rate_deg_per_s = 0.1
[[stage]]
name = "two_rates"
kind = "reduce"
method = "two_rates"
from_deg = 60
to_deg = 5
rate_deg_per_s = 0.1
slower_rate_deg_per_s = 0.025
[[monitors]]
name = "body"
quantities = ["displacement"]
above = ["A"]
inside = [0.1, 0.1, 0.1]
[[monitors]]
name = "joint"
quantities = ["contact_force"]
joint = "A"
[[monitors]]
name = "bolts"
quantities = ["bolt_force"]
bolts = "roof"
[[monitors]]
name = "lake"
quantities = ["level"]
water = "lake"
[[monitors]]
name = "wall"
quantities = ["convergence"]
excavation = "tunnel"
angles_deg = [90]
since = "settle"
[output]
)";

// the tables and keys of the plane alone
inline const std::string in_the_plane = R"(dimension = 2
density = 2000
domain = { box = { min = [-9, -9], max = [9, 9] } }
[[joint_properties]]
name = "rock"
normal_stiffness = 1e9
shear_stiffness = 1e8
friction_deg = 35
[[excavations]]
name = "tunnel"
outline = true
cylinder = { from = [0, 0], radius = 3, sides = 12 }
[[joints]]
name = "A"
dip = 30
dip_direction = 90
point = [0, 0]
[[joints]]
name = "B"
dip = 60
dip_direction = 270
point = [0, 0]
[[linings]]
name = "shell"
excavation = "tunnel"
joint_properties = "rock"
nodes = 60
from_deg = 0
to_deg = 300
thickness = 0.3
young_modulus = 20e9
compressive_strength = 30e6
tensile_strength = 3e6
[[fix]]
side = ["left"]
[[stage]]
name = "settle"
kind = "settle"
excavate = ["tunnel"]
install = ["shell"]
[[monitors]]
name = "crown"
quantities = ["lining_force"]
lining = "shell"
)";

// the keys that blocks of half-spaces alone cannot state, or that exclude other keys of `everything`
inline const std::string of_particles = R"(dimension = 3
density = 2000
[[joint_properties]]
name = "rock"
normal_stiffness = 1e9
shear_stiffness = 1e8
friction_deg = 35
constant_stiffness = true
[[blocks]]
name = "rounded"
shape = "potential"
box = { min = [9.1, -0.9, 0.1], max = [10.9, 0.9, 1.9] }
corner_radius = 0.1
sphericity = 0.05
sphere_radius = 2
centre = [10, 0.1, 1]
[[blocks]]
name = "ball"
shape = "potential"
sphericity = 1
sphere_radius = 1
centre = [15, 0, 1]
[[stage]]
name = "settle"
kind = "settle"
[[stage]]
name = "shake"
kind = "run"
duration_s = 50
[[stage.move]]
bodies = ["ball"]
[[stage.move.factor]]
record = "record.at2"
direction = [0, 1, 0]
samples = { values = [0, 0.1, 0, -0.1, 0], interval_s = 10, unit = "g", quantity = "acceleration", component = "UP" }
)";

// sides that waves leave, which exclude later searches
inline const std::string of_waves = R"(dimension = 3
density = 2000
domain = { box = { min = [0, 0, 0], max = [1, 1, 3] } }
joint_properties = [{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 35 }]
joints = [{ name = "A", dip = 0, point = [0, 0, 1] }, { name = "B", dip = 0, point = [0, 0, 2] }]
[[stage]]
name = "waves"
kind = "run"
duration_s = 1
[[stage.boundary]]
side = ["bottom"]
quiet = { normal_impedance = 5e6, shear_impedance = 3e6, normal_stiffness = 1e9, shear_stiffness = 5e8, input = "upgoing", velocity = [1, 0, 0] }
[[stage.boundary]]
side = ["west"]
free_field = { normal_impedance = 5e6, shear_impedance = 3e6, normal_stiffness = 1e9, shear_stiffness = 5e8 }
)";

// a table of a scene, with the groups of keys that it may have
struct Holder {
  Subject table;
  Groups groups;
};

inline void add_holders(const Subject& table, const Groups& groups, std::vector<Holder>& holders) {
  holders.push_back({table, groups});
  for (const std::string_view group : groups)
    for (const KeyRow& row : key_rows(group)) {
      if (row.holds.empty() || !table.node->find(row.key)) continue;
      if (row.type == KeyType::tables)
        for (const Subject& inner : children(table, row.key))
          add_holders(inner, row.holds, holders);
      else
        add_holders(*child(table, row.key), row.holds, holders);
    }
}

// A scene with its tables as they are written, before copies are made.
struct Written {
  explicit Written(const std::string& scene)
      : text(scene), tree(parse_toml(scene, std::make_shared<const std::string>("scene.toml"))) {
    add_holders({&tree, ""}, {""}, holders);
  }

  const std::string& text;
  Node tree;
  std::vector<Holder> holders;
};

struct Home {
  const std::string* scene = nullptr;
  std::string address;  // of the key, as `--set` takes it
};

inline bool accepts(const Home& home, std::string_view value) {
  try {
    parse_scene(*home.scene, "scene.toml", {home.address + "=" + std::string(value)});
    return true;
  } catch (const SceneError&) {
    return false;
  }
}

// The first table that accepts this value of a row's key. Some values exclude all others: then the first table that
// states the key, or else may state it.
inline Home home_of(const KeyRow& row, std::string_view value) {
  static const std::array scenes{Written(everything), Written(in_the_plane), Written(of_particles), Written(of_waves)};
  Home stated, allowed;
  for (const Written& scene : scenes)
    for (const Holder& holder : scene.holders) {
      const Node& table = *holder.table.node;
      if (std::ranges::find(holder.groups, row.table) == holder.groups.end() || !key_applies(table, holder.groups, row))
        continue;
      const Home here{&scene.text, key_path(holder.table.path, row.key)};
      if (!value.empty() && accepts(here, value)) return here;
      if (!stated.scene && table.find(row.key)) stated = here;
      if (!allowed.scene) allowed = here;
    }
  if (!allowed.scene)
    throw std::logic_error("no scene of core/testing/every_key.hpp has a table for " +
                           key_path(std::string(row.table), row.key));
  return stated.scene ? stated : allowed;
}

inline const Home& home(const KeyRow& row, std::string_view value) {
  static std::map<std::pair<const KeyRow*, std::string>, Home> homes;
  Home& found = homes[{&row, std::string(value)}];
  if (!found.scene) found = home_of(row, value);
  return found;
}

// the scene in which a row's key can have its example, and the place
inline const std::string& scene_of(const KeyRow& row) {
  return *home(row, row.example).scene;
}
inline const std::string& address(const KeyRow& row) {
  return home(row, row.example).address;
}

}  // namespace voussoir::every_key
