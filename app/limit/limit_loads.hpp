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

// gravity, applied, and the directions that have a name: in the plane left and right, in space the others
std::vector<std::string> named_limit_loads();

// One of these, or a direction as two or three numbers, "1,0,-0.5"; none: it is neither.
std::optional<LimitLoad> limit_load(const std::string& text);

// what it takes, for messages
std::string limit_load_rule();

}  // namespace voussoir
