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
  std::map<std::string, std::array<double, 6>>
      forces;                                 // full force on a block, and moment about its centre, world axes
  std::vector<std::array<double, 2>> shares;  // time and share of the full forces, as gravity

  // a setting of the engine; its value if the scene does not state it
  double setting(const std::string& key, double otherwise) const {
    used.insert(key);
    const auto found = settings.find(key);
    return found == settings.end() ? otherwise : found->second;
  }

  Triple gravity_at(double time) const {
    const auto row = row_at(gravity, time);
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
