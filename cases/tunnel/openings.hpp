// The 24 unsupported openings of Boon (2013), table 5.1: run, named, drawn.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "app/base/run_scene.hpp"
#include "reference/tunnel/mechanism.hpp"

namespace voussoir::cases {

// a row of the table; its mechanisms as the issue of the table abbreviates them (NOTES.md)
struct OpeningRow {
  int number = 0;
  std::array<int, 3> dips{};  // deg, to the right; negative: to the left
  int friction = 0;           // deg
  char first = 0, second = 0;
};

const std::vector<OpeningRow>& opening_rows();

struct Opening {
  OpeningRow row;
  std::vector<reference::JointSet> sets;
  std::vector<reference::Mechanism> found;  // by place
  double above_springline = 0;              // m2 lost there
  double farthest = 0;                      // m
  long long evaluations = 0;
  double seconds = 0;

  const reference::Mechanism& at(reference::Place place) const { return found[static_cast<int>(place)]; }
  double lost_area() const;  // m2
};

// The scene of a row in `seed`'s draw of its joints, followed for `seconds` after the excavation.
LoadedScene opening_scene(const OpeningRow& row, int seed, double seconds, const std::vector<std::string>& more = {});

// Excavates it. If `file` is not empty its blocks are written for a figure, in <file>_left.csv and <file>_lost.csv.
Opening dig(const OpeningRow& row, const LoadedScene& scene, const std::string& file = "");
Opening dig(const OpeningRow& row, int seed, double seconds, const std::string& file = "",
            const std::vector<std::string>& more = {});

// "wedge 85E/65W", "slide 25W", ...
std::string words(const Opening& opening, reference::Place place);

// the entry of table 5.1, in the same words: in the roof; second mechanism
std::string published(const OpeningRow& row);

inline constexpr double minor_area = 1;  // m2: a wall that loses less has no mechanism of its own

// Whether the result agrees with the thesis: in the roof, and in the second mechanism. By place, and by kind of
// mechanism.
struct Agreement {
  bool roof_kind = false, second_place = false, second_kind = false;
};
Agreement agreement(const Opening& opening);

// all letters of the table, and whether the result agrees with two of them
inline constexpr const char *first_letters = "WSTm", *second_letters = "-s2wrtb";
Agreement agreement(const Opening& opening, char first, char second);

}  // namespace voussoir::cases
