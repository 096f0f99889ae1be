// The scenes of free fall, by a seed: regular polyhedra in random orientations on a jittered grid, in a box with walls.
// The case, its committed scene and the benchmark of full steps are made here.
#pragma once

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace voussoir::shapes {

inline const std::vector<std::string> regular_polyhedra{"tetrahedron", "cube", "octahedron", "dodecahedron",
                                                        "icosahedron"};

struct FallPlan {
  std::vector<int> kinds{0, 1, 2, 3, 4};  // in turn: places in `regular_polyhedra`
  int blocks = 200;
  int side = 6;         // blocks along each side of the box
  double pitch = 1.05;  // m between the places of the grid; a block's circumscribed sphere is 1 m wide
};

using Corner = Eigen::Vector3d;

// corners on the unit sphere
inline std::vector<Corner> regular_corners(int kind) {
  constexpr double golden = std::numbers::phi;
  std::vector<Corner> corners;
  const auto all_signs = [&](const Corner& p) {
    for (int s = 0; s < 8; ++s) {
      const Corner q(s & 1 ? -p[0] : p[0], s & 2 ? -p[1] : p[1], s & 4 ? -p[2] : p[2]);
      bool known = false;
      for (const Corner& c : corners)
        known = known || c == q;
      if (!known) corners.push_back(q);
    }
  };
  const auto all_turns = [&](const Corner& p) {
    all_signs(p);
    all_signs({p[1], p[2], p[0]});
    all_signs({p[2], p[0], p[1]});
  };
  if (kind == 0) corners = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  if (kind == 1 || kind == 3) all_signs({1, 1, 1});
  if (kind == 2) all_turns({1, 0, 0});
  if (kind == 3) all_turns({0, 1 / golden, golden});
  if (kind == 4) all_turns({0, 1, golden});
  for (Corner& c : corners)
    c.normalize();
  return corners;
}

inline std::string box_line(const std::string& name, const Corner& low, const Corner& high) {
  return fmt::format("  {{ name = \"{}\", fixed = true, box = {{ min = [{}, {}, {}], max = [{}, {}, {}] }} }},\n", name,
                     low[0], low[1], low[2], high[0], high[1], high[2]);
}

// The overrides of the scene for contacts whose force has a potential, and a time step that keeps their energy balance.
// Corners are four times as soft then, so the stiffness is four times as large, and blocks overlap more than potential
// particles, which are then not used, would permit.
inline constexpr double smoothing = 1e-3;
inline const std::vector<std::string> conservative_contacts{"contact.normal=multipliers",
                                                            "contact.point=central_path",
                                                            fmt::format("contact.smoothing={}", smoothing),
                                                            "contact.newton_tolerance=1e-3",
                                                            "contact.potential_radius=0.2",
                                                            "joint_properties.rock.normal_stiffness=1e8",
                                                            "joint_properties.rock.shear_stiffness=5e7",
                                                            "time.fraction=0.7"};

// the plate, four walls and the blocks, as TOML
inline std::string fall_blocks(const FallPlan& plan) {
  boost::random::mt19937_64 random(2013);
  const auto uniform = [&](double low, double high) {
    return boost::random::uniform_real_distribution<double>(low, high)(random);
  };
  const double width = plan.side * plan.pitch;
  const int layers = (plan.blocks + plan.side * plan.side - 1) / (plan.side * plan.side);
  const double top = (layers + 1) * plan.pitch;
  std::string text = "blocks = [\n";
  text += box_line("plate", {-1, -1, -1}, {width + 1, width + 1, 0});
  text += box_line("west", {-1, -1, 0}, {0, width + 1, top});
  text += box_line("east", {width, -1, 0}, {width + 1, width + 1, top});
  text += box_line("south", {0, -1, 0}, {width, 0, top});
  text += box_line("north", {0, width, 0}, {width, width + 1, top});
  for (int i = 0; i < plan.blocks; ++i) {
    const int kind = plan.kinds[static_cast<std::size_t>(i) % plan.kinds.size()];
    const double jitter = 0.5 * (plan.pitch - 1) * 0.9;  // no two circumscribed spheres meet
    Corner centre;
    const int place[] = {i % plan.side, i / plan.side % plan.side, i / plan.side / plan.side};
    for (int k = 0; k < 3; ++k)
      centre[k] = (place[k] + 0.5) * plan.pitch + uniform(-jitter, jitter);
    // a random point of the unit ball in four dimensions is a random orientation
    Eigen::Vector4d q;
    do {
      for (int k = 0; k < 4; ++k)
        q[k] = uniform(-1, 1);
    } while (q.squaredNorm() > 1 || q.squaredNorm() < 0.01);
    const Eigen::Quaterniond turn = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
    text += fmt::format("  {{ name = \"{}_{}\", vertices = [", regular_polyhedra[kind], i + 1);
    for (const Corner& c : regular_corners(kind)) {
      const Corner v = centre + 0.5 * (turn * c);
      text += fmt::format("[{}, {}, {}], ", v[0], v[1], v[2]);
    }
    text.resize(text.size() - 2);
    text += "] },\n";
  }
  return text + "]\n";
}

// The complete scene: two stages, `fall` without damping but that of the contacts, `rest` with local damping. NOTES.md
// of the case gives the reasons for the numbers.
inline std::string fall_scene(const FallPlan& plan, const std::string& title) {
  return fmt::format(R"(# Made by core/testing/fall_scene.hpp, which a test compares with this file.
title = "{}"
preset = "thesis"
dimension = 3
gravity = [0, 0, -9.81]        # m/s2
density = 2500                 # kg/m3

{}
[[joint_properties]]
name = "rock"
normal_stiffness = 2.5e7       # N/m: corners and edges have next to no area
shear_stiffness = 1.25e7       # N/m
friction_deg = 35
constant_stiffness = true

[contact]
potential_radius = 0.1         # of the smaller inscribed radius: above the largest overlap
skin = 0.2                     # of the smallest inscribed radius

[damping]
local = 0
viscous_ratio = 0.2            # of critical, at every contact

[equilibrium]
unbalanced = 0.5               # of the mean contact force: leaves less than 1e-6 of the energy of the drop

[time]
fraction = 1                   # of a limit that counts every near block as if it struck

[[stage]]                      # until the last block has come down
name = "fall"
kind = "run"
duration_s = 1.4

[[stage]]
name = "rest"
kind = "settle"
time_limit_s = 60
statics = "local"
damping = {{ local = 0.1 }}

[output]
frame_interval_s = 0.2
)",
                     title, fall_blocks(plan));
}

}  // namespace voussoir::shapes
