// What supports carry at the end of a stage, in a line for each name: from the rows of bolts.csv and lining.csv.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/output/results.hpp"

namespace voussoir {

// the bolts of a name; forces of one bolt, also in the plane
struct BoltsCarry {
  std::string name;
  int bolts = 0;
  double force = 0;                          // N, tension positive: the one of largest size, along a bolt
  int bolt = 0, joint = 0;                   // that has it; joint 0 is its plate
  double shear = 0;                          // N, largest across a bolt
  std::optional<double> use{};               // largest force over yield
  int yielded = 0, broken = 0, slipped = 0;  // bolts, each counted once; slip of their bond to the rock
};

// forces per metre of tunnel
struct LiningCarries {
  std::string name;
  double thrust = 0, moment = 0;  // N, compression positive; N m, sagging positive: those of largest size
  int thrust_node = 0, moment_node = 0;
  double pressure = 0;          // Pa, largest of the rock
  std::optional<double> use{};  // largest utilisation of the section's strength
};

struct SupportsCarry {
  std::vector<BoltsCarry> bolts;
  std::vector<LiningCarries> linings;
};

// at the end of a stage, counted from 1
SupportsCarry supports_carry(const Results& results, int stage);

// "bolts roof: 4 bolts, at most 51.2 kN (bolt 2, joint 1), 92 % of yield; 1 has yielded"
std::string text_of(const BoltsCarry& bolts);
// "lining shell: thrust 312 kN/m (node 5), moment -12.1 kN m/m (node 9), rock pressure 84.0 kPa, 45 % of its strength"
std::string text_of(const LiningCarries& lining);

}  // namespace voussoir
