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

inline const std::vector<std::string> named_limit_loads{"gravity", "applied", "left",  "right", "east",
                                                        "west",    "north",   "south", "up",    "down"};

// One of these (in the plane left or right, in space the others), or a direction as two or three numbers, "1,0,-0.5";
// none: it is neither.
std::optional<LimitLoad> limit_load(const std::string& text);

// what it takes, for messages
extern const char* const limit_load_rule;

}  // namespace voussoir
