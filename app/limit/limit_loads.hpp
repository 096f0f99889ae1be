// The loads whose factor `voussoir limit` seeks, also in studies.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace voussoir {

struct LimitLoad {
  enum class Kind { gravity, applied, acceleration };
  Kind kind = Kind::gravity;
  std::string name;               // as it is asked for
  std::vector<double> direction;  // of an acceleration, unit: two numbers in the plane, three in space
};

// gravity, applied, a direction by its name (in the plane left or right, in space east, west, north, south, up or
// down), or as two or three numbers, "1,0,-0.5"; none: it is none of these
std::optional<LimitLoad> limit_load(const std::string& text);

// what it takes, for messages
extern const char* const limit_load_rule;

}  // namespace voussoir
