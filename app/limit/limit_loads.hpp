// The loads whose factor `voussoir limit` seeks, also in studies.
#pragma once

#include <string>
#include <vector>

namespace voussoir {

enum class LimitLoad { gravity, applied, left, right, east, west, north, south, up, down };

// their names, in the enumeration's order
inline const std::vector<std::string> limit_loads{"gravity", "applied", "left",  "right", "east",
                                                  "west",    "north",   "south", "up",    "down"};

}  // namespace voussoir
