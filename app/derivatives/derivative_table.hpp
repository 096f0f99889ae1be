// What moves an answer: its derivative by every number of the scene that moves it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/derivatives/moving_keys.hpp"
#include "app/derivatives/ridders.hpp"

namespace voussoir {

// the answer of the scene with further overrides; may throw SceneError and BadInput, which count as no value
using AnswerWith = std::function<PieceAnswer(const std::vector<std::string>& overrides)>;

struct DifferentiatedAnswer {
  std::string name{}, unit{};  // "least_factor", "1"
  double bar = 0;              // of one answer
  double length = 1;           // m, of the blocks that give it
  int levels = 6;              // of the extrapolation
  int bisections = 12;         // of the distance to another mechanism
};

// a key that moves the answer, or by which there is no derivative
struct DerivativeRow {
  MovingKey key{};
  Derivative derivative{};  // by the key's unit
  double change = 0;        // of the answer by the usual change, the larger one at a kink; with its sign
  bool refused = false;     // neither side has a derivative
  std::string remark{};     // what happens at a kink or beside it; why there is none
};

// of a stable trial of a run's search: singular values of the tangent, over its scale
struct TrialTangent {
  double level = 0;  // in the answer's unit
  double smallest = 0, second = 0;
};

// with which a collapse begins; of all blocks the largest displacement is 1
struct BlockAtCollapse {
  std::string block;
  std::vector<double> displacement, rotation;  // rotation in rad per that
};

struct DerivativeTable {
  DifferentiatedAnswer answer{};
  PieceAnswer base{};
  std::vector<DerivativeRow> rows{};  // by the change, largest first; then those without a derivative
  std::vector<std::string> still{};   // keys that do not move it
  int answers = 0;                    // that were asked for
  bool unfinished = false;            // the hook ended it
  std::vector<TrialTangent> way{};    // of a run's search, towards the collapse
  std::vector<BlockAtCollapse> motion{};  // likewise
};

// called with the number of keys that are done and of all; false ends the table, without the key before it
using KeyHook = std::function<bool(std::size_t done, std::size_t all)>;

// into the order that DerivativeTable::rows has
void sort_rows(DerivativeTable& table);

// Without a value of `base` the table is empty.
DerivativeTable derivative_table(const std::vector<MovingKey>& keys, const PieceAnswer& base,
                                 const DifferentiatedAnswer& answer, const AnswerWith& answer_with,
                                 const KeyHook& hook = {});

}  // namespace voussoir
