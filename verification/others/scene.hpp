// What every adapter of a C++ engine shares: the scene that the harness writes, the rows it expects, and the loop
// between.
//
// Scenes come from standard input as lines of words, each ended by `end` (scene.py writes them), so that one process
// runs many: starting an engine takes longer than the steps of a small scene. SI units. A pose is that of a block's
// principal axes at its centre of mass; vertices are in these axes; quaternions are w x y z; spins are about world
// axes. The rows are `time name x y z qw qx qy qz vx vy vz wx wy wz`; a scene's last line is `cpu SECONDS steps N`, the
// processor time of the steps alone, or `failed REASON`.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <iostream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace voussoir::others {

using Triple = std::array<double, 3>;
using Quaternion = std::array<double, 4>;  // w x y z

struct SceneFace {
  std::array<double, 4> plane{};  // outward normal n and offset d in the block's axes: n x <= d
  std::vector<unsigned> corners;  // vertices, counter-clockwise from outside
};

struct SceneBlock {
  std::string name;
  bool fixed = false;
  double mass = 0;  // kg
  Triple centre{}, moments{}, velocity{}, spin{};
  Quaternion turn{1, 0, 0, 0};
  std::vector<Triple> vertices;
  std::vector<SceneFace> faces;
  Triple box{};  // lengths along the axes; zero unless the block is a box
  bool is_box() const { return box[0] > 0; }
};

struct BlockMotion {
  Triple centre{}, velocity{}, spin{};
  Quaternion turn{};
};

// a vector of a block's axes in the world's; the quaternion has length 1
inline Triple turned(const Quaternion& q, const Triple& v) {
  const Triple t{2 * (q[2] * v[2] - q[3] * v[1]), 2 * (q[3] * v[0] - q[1] * v[2]), 2 * (q[1] * v[1] - q[2] * v[0])};
  return {v[0] + q[0] * t[0] + q[2] * t[2] - q[3] * t[1], v[1] + q[0] * t[1] + q[3] * t[0] - q[1] * t[2],
          v[2] + q[0] * t[2] + q[1] * t[1] - q[2] * t[0]};
}

inline Triple turned_back(const Quaternion& q, const Triple& v) {
  return turned({q[0], -q[1], -q[2], -q[3]}, v);
}

inline Triple minus(const Triple& a, const Triple& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline std::ostream& operator<<(std::ostream& out, const Triple& a) {
  return out << a[0] << ' ' << a[1] << ' ' << a[2];
}

// A bonded face between a free and a fixed block, as four springs at its radii of gyration: together they have the
// face's stiffness in compression, shear and bending. It breaks where its edge does.
struct SceneWeld {
  std::size_t block = 0, fixed = 0;
  double normal_stiffness = 0, shear_stiffness = 0;  // N/m, of one spring
  double area = 0, strength = 0;                     // m2, Pa
  Triple normal{};                                   // out of the fixed block
  std::array<Triple, 4> points{};  // world; on the low (0) or high (1) side of the face's two axes: 00, 01, 10, 11
  std::array<Triple, 4> own{};     // the same from the block's centre, in its axes

  // The greatest tensile stress of the face, Pa, is that of a linear field whose forces and moments are those of the
  // springs; a radius of gyration of a rectangle is 1 / root 3 of half its edge.
  bool breaks(const BlockMotion& now) const {
    std::array<double, 4> tension{};
    for (int k = 0; k < 4; ++k) {
      const Triple arm = turned(now.turn, own[k]);
      for (int axis = 0; axis < 3; ++axis)
        tension[k] += normal_stiffness * normal[axis] * (now.centre[axis] + arm[axis] - points[k][axis]);
    }
    for (int corner = 0; corner < 4; ++corner) {
      double force = 0;
      for (int k = 0; k < 4; ++k) {
        const int sides = ((corner ^ k) & 1 ? -1 : 1) + ((corner ^ k) & 2 ? -1 : 1);
        force += tension[k] * (1 + std::sqrt(3.0) * sides);
      }
      if (force > strength * area) return true;
    }
    return false;
  }
};

// a row of a table whose first column is time: linear between rows, the last one held
template <std::size_t Columns>
std::array<double, Columns> row_at(const std::vector<std::array<double, Columns>>& table, double time) {
  std::size_t i = 0;
  while (i + 1 < table.size() && table[i + 1][0] <= time)
    ++i;
  std::array<double, Columns> row = table.at(i);
  if (i + 1 == table.size() || time < row[0]) return row;
  const double share = (time - row[0]) / (table[i + 1][0] - row[0]);
  for (std::size_t k = 0; k < Columns; ++k)
    row[k] += share * (table[i + 1][k] - row[k]);
  return row;
}

struct EngineScene {
  double duration = 0, output = 0.01, friction = 0;  // s, s, coefficient
  std::vector<std::array<double, 4>> gravity;        // time and vector, linear between rows, the last one held
  std::vector<SceneBlock> blocks;
  std::vector<SceneWeld> welds;
  std::map<std::string, std::array<double, 6>>
      forces;                                 // full force on a block, and moment about its centre, world axes
  std::vector<std::array<double, 2>> shares;  // time and share of the full forces, as gravity

  // a setting of the engine; its value if the scene does not state it
  double setting(const std::string& key, double otherwise) const {
    used.insert(key);
    const auto found = settings.find(key);
    return found == settings.end() ? otherwise : found->second;
  }

  Triple gravity_at(double moment) const {
    const auto row = row_at(gravity, moment);
    return {row[1], row[2], row[3]};
  }

  // three numbers of force and three of moment at present, or nothing
  std::optional<std::array<double, 6>> force_on(std::size_t block) const {
    const auto found = forces.find(blocks[block].name);
    if (found == forces.end()) return std::nullopt;
    std::array<double, 6> force = found->second;
    for (double& x : force)
      x *= row_at(shares, time)[1];
    return force;
  }

  // a misspelt setting would leave the engine as it comes, and the sweep would praise the wrong value
  void refuse_unused_settings() const {
    for (const auto& [key, value] : settings)
      if (!used.contains(key)) throw std::runtime_error("this adapter has no setting " + key);
  }

  std::map<std::string, double> settings;
  double time = 0;  // at the end of the present step
  mutable std::set<std::string> used;
};

template <class Numbers>
void read_numbers(std::istringstream& line, Numbers& numbers) {
  for (double& x : numbers)
    if (!(line >> x)) throw std::runtime_error("a number is missing in: " + line.str());
}

inline void read_block_line(const std::string& word, std::istringstream& line, SceneBlock& block) {
  if (word == "velocity") {
    read_numbers(line, block.velocity);
  } else if (word == "spin") {
    read_numbers(line, block.spin);
  } else if (word == "box") {
    read_numbers(line, block.box);
  } else if (word == "vertex") {
    read_numbers(line, block.vertices.emplace_back());
  } else if (word == "face") {
    SceneFace& face = block.faces.emplace_back();
    read_numbers(line, face.plane);
    for (unsigned corner; line >> corner;)
      face.corners.push_back(corner);
  } else if (word != "density") {  // follows from mass and shape
    throw std::runtime_error("unknown word " + word);
  }
}

inline void read_weld(std::istringstream& line, const std::vector<SceneBlock>& blocks, SceneWeld& weld) {
  for (std::size_t* index : {&weld.block, &weld.fixed}) {
    std::string name;
    line >> name;
    *index = std::ranges::find(blocks, name, &SceneBlock::name) - blocks.begin();
    if (*index == blocks.size()) throw std::runtime_error("no block above this line has the name " + name);
  }
  line >> weld.normal_stiffness >> weld.shear_stiffness >> weld.area >> weld.strength;
  read_numbers(line, weld.normal);
  for (int k = 0; k < 4; ++k) {
    read_numbers(line, weld.points[k]);
    weld.own[k] = turned_back(blocks[weld.block].turn, minus(weld.points[k], blocks[weld.block].centre));
  }
}

// false: no further scene. Throws std::runtime_error for a line that it does not know.
inline bool read_scene(std::istream& in, EngineScene& scene) {
  for (std::string text, word, kind; std::getline(in, text);) {
    std::istringstream line(text);
    if (!(line >> word)) continue;
    if (word == "end") return true;
    if (word == "setting") {
      line >> kind >> scene.settings[kind];
    } else if (word == "duration") {
      line >> scene.duration;
    } else if (word == "output") {
      line >> scene.output;
    } else if (word == "friction") {
      line >> scene.friction;
    } else if (word == "gravity") {
      read_numbers(line, scene.gravity.emplace_back());
    } else if (word == "force") {
      line >> kind;
      read_numbers(line, scene.forces[kind]);
    } else if (word == "weld") {
      read_weld(line, scene.blocks, scene.welds.emplace_back());
    } else if (word == "share") {
      read_numbers(line, scene.shares.emplace_back());
    } else if (word == "block") {
      SceneBlock& block = scene.blocks.emplace_back();
      line >> block.name >> kind >> block.mass;
      block.fixed = kind == "fixed";
      read_numbers(line, block.centre);
      read_numbers(line, block.turn);
      read_numbers(line, block.moments);
    } else if (!scene.blocks.empty()) {
      read_block_line(word, line, scene.blocks.back());
    }
  }
  return false;
}

template <class World>
void print_rows(const EngineScene& scene, World& world, double time) {
  for (std::size_t i = 0; i < scene.blocks.size(); ++i) {
    if (scene.blocks[i].fixed) continue;
    const BlockMotion m = world.motion(i);
    std::printf("%.9g %s", time, scene.blocks[i].name.c_str());
    for (const auto& part : {m.centre, Triple{m.turn[0], m.turn[1], m.turn[2]}})
      std::printf(" %.17g %.17g %.17g", part[0], part[1], part[2]);
    std::printf(" %.17g", m.turn[3]);
    for (const auto& part : {m.velocity, m.spin})
      std::printf(" %.12g %.12g %.12g", part[0], part[1], part[2]);
    std::printf("\n");
  }
}

// A World is made from a scene, `step(gravity)` advances it by the setting dt, `motion(i)` is that of block i.
template <class World>
void run_scene(EngineScene& scene) {
  World world(scene);
  scene.refuse_unused_settings();
  const double step = scene.setting("dt", 0.002);
  const long steps = std::lround(scene.duration / step);
  const long every = std::max(1L, std::lround(scene.output / step));
  std::clock_t spent = 0;
  print_rows(scene, world, 0);
  for (long i = 1; i <= steps; ++i) {
    scene.time = i * step;
    const Triple gravity = scene.gravity_at(scene.time);
    const std::clock_t begun = std::clock();
    world.step(gravity);
    spent += std::clock() - begun;
    if (i % every == 0 || i == steps) print_rows(scene, world, scene.time);
  }
  std::printf("cpu %.6f steps %ld\n", static_cast<double>(spent) / CLOCKS_PER_SEC, steps);
}

// the main function of an adapter
template <class World>
int run_scenes() {
  while (true) {
    EngineScene scene;
    try {
      if (!read_scene(std::cin, scene)) return 0;
      run_scene<World>(scene);
    } catch (const std::exception& error) {
      std::printf("failed %s\n", error.what());
    }
    std::fflush(stdout);
  }
}

}  // namespace voussoir::others
