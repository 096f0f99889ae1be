// A unit of length and its length in metres.
#pragma once

#include <string_view>

namespace voussoir {

struct LengthUnit {
  std::string_view name;
  double metres = 1;
};

}  // namespace voussoir
