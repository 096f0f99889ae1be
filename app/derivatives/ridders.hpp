// The derivative of an answer that may have kinks and jumps, by differences with extrapolation and an error bar.
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace voussoir {

// An answer, and which of its smooth pieces it belongs to: mechanism and shape of the blocks that give it.
struct PieceAnswer {
  std::optional<double> value;
  std::string piece;   // equal texts: the same formula
  std::string words;   // the piece for people: "block 5 slides on A, B"
  std::string reason;  // why there is no value
};

// the answer at a distance from the base, in the unit of the key
using AnswerAt = std::function<PieceAnswer(double distance)>;

struct DifferenceRequest {
  PieceAnswer base{};    // with a value
  double step = 1;       // the first
  double below = 1e300;  // how far the key may go down
  double above = 1e300;  // and up
  double bar = 0;        // of one answer
  int levels = 6;        // of the extrapolation, at least 2
  int bisections = 12;   // of the distance at which a piece ends
};

// what ends the piece of the base on a side
struct PieceEnd {
  double distance = 0;  // at most; the unit of the key
  std::string words;
};

struct SideDerivative {
  std::optional<double> value;
  double bar = 0;
  std::string words;            // of its piece, if it is not that of the base
  std::optional<PieceEnd> end;  // if the piece of the base ends there
};

struct Derivative {
  std::optional<double> value;  // none: see `below` and `above`
  double bar = 0;
  bool still = false;           // the answer does not move by more than its bar
  bool kink = false;            // both sides have a derivative, and they differ
  bool one_side = false;        // the value is that of one side
  SideDerivative below, above;  // if `value` is not from both sides
  int answers = 0;              // that were asked for
};

// Central differences over h, h/2, h/4, … with Richardson's extrapolation and the entry of the table with the smallest
// error (C. J. F. Ridders, Accurate computation of F'(x) and F'(x) F''(x), Adv. Eng. Software 4, 1982). The bar is the
// difference to the neighbours in the table and the bars of the answers as the extrapolation adds them. All answers
// must belong to the base's piece: otherwise h is halved, at most three times, and then each side has a table of its
// own, over quotients with the base (powers of h instead of h²). A side whose piece is another one counts if it meets
// the base's value: a kink.
Derivative differentiate(const AnswerAt& answer, const DifferenceRequest& request);

}  // namespace voussoir
