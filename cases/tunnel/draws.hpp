// Several draws of the 24 openings: a row each, kept when completed, and how often they agree with the thesis.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "cases/tunnel/openings.hpp"

namespace voussoir::cases {

struct DrawRow {
  int number = 0, draw = 0;  // of the opening; seed of its three sets
  std::array<std::string, 4> words;
  std::array<double, 4> area{};               // m2 lost, by place
  std::string roof_kind;                      // letters of the table for the mechanism of the roof
  std::string second_place, second_kind;      // and for the second mechanism: place and kind
  double above_springline = 0, farthest = 0;  // m2 lost there; m
  long long evaluations = 0;
  std::string inputs;  // fingerprint of scene and program
};

DrawRow draw_row(const Opening& opening, int draw, const std::string& inputs);

// as a table, and back; throws FileFault
std::string draws_csv(const std::vector<DrawRow>& rows);
std::vector<DrawRow> read_draws(const std::string& csv);

// How many of the draws of an opening agree with table 5.1, or the expected number (see `by_chance`).
struct DrawsAgree {
  double draws = 0;
  double roof = 0, roof_kind = 0, roof_sets = 0;  // fails; by the same kind; of the same sets
  double second_place = 0, second_kind = 0;
};
DrawsAgree draws_agree(const std::vector<DrawRow>& rows, int number);

// Mean agreement of all draws if the mechanisms of the table were assigned to the openings at random: each draw is
// compared with those of the 23 others.
DrawsAgree by_chance(const std::vector<DrawRow>& rows);

// one line for each opening that has a row, and their sums, in Markdown
std::string agreement_table(const std::vector<DrawRow>& rows);

}  // namespace voussoir::cases
