// The sweep over the map: every cell contains the worst verdict of its instances, for each kernel.
#pragma once

#include <map>

#include "cases/robustness/instances.hpp"

namespace voussoir::atlas {

struct Grid {
  std::array<std::vector<double>, axes> values;  // of each axis
  std::vector<double> depths;
  int instances = 1;  // in each cell
};

struct Tally {
  long long correct = 0, warned = 0, refused = 0, wrong = 0;
  double worst_fraction = 0;         // of the promised error, among the right results
  std::vector<std::string> reasons;  // of the first wrong results

  void add(const Judgement& judgement, const std::string& where);
  long long answers() const { return correct + warned + refused + wrong; }
};

// one line of the figure's data
struct Cell {
  Place place;
  std::array<Verdict, kernels> worst{};
};

struct Atlas {
  std::vector<Cell> cells;
  std::array<Tally, kernels> tallies;
};

// every kernel's result for one seeded instance
Judgements judge_instance(const Place& place, int instance);

Atlas sweep(const Grid& grid);

}  // namespace voussoir::atlas
