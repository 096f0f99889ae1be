// A supported opening of the program, and the linear network of the same blocks (reference/tunnel/network.hpp).
#pragma once

#include <string>
#include <vector>

#include "app/base/run_scene.hpp"
#include "reference/tunnel/blocks.hpp"

namespace voussoir::cases {

// the end of a stage
struct StageEnd {
  Model<2> model;
  State<2> state;
};

struct SupportedRun {
  SceneRun run;
  std::vector<StageEnd> ends;  // by stage

  const StageEnd& before() const { return ends[ends.size() - 2]; }  // the last stage installs the supports
  const StageEnd& after() const { return ends.back(); }
};

// Runs <case>/<scene>, whose last stage installs the supports, with the end of each stage kept. Throws
// std::runtime_error if a stage misses its goal.
SupportedRun run_supported(const std::string& scene, const std::vector<std::string>& overrides = {});

// Changes by the last stage, of the program or of the network: increments from the state before. All supports of the
// network are linear, so its forces are increments too.
struct Increment {
  std::vector<double> convergence;  // m, of the wall towards the centre, every degree
  std::vector<double> bolts;        // N, by bolt and joint from the collar
  std::vector<double> thrust;       // N, by node of the lining
  std::vector<double> moment;       // N m
  double mean_convergence = 0;      // m, over the wall
};

struct Twins {
  reference::network::Network network;
  Increment program, linear;
  // For each spring of a bolt of the program, the network's between the same two blocks; -1 if it has none: bolts cross
  // the blocks in their current positions in the one and as cut in the other.
  std::vector<int> twin_of_spring;
};

// The network of the blocks of the run as cut, on joints of `cells` points between them, with the run's bolts and
// lining, loaded by the share of the excavation forces that the last stage released.
Twins twins(const SupportedRun& run, int cells);

}  // namespace voussoir::cases
