#include "core/scene/keys/members.hpp"
#include "text/angle.hpp"

#include <charconv>
#include <cmath>

namespace voussoir::keys {

// the shortest text that reads back the same, as written by hand: 1e9 and 3e-4 for 1e+09 and 3e-04
std::string toml_text(double value) {
  char buffer[32];
  std::string text(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
  if (const std::size_t e = text.find('e'); e != std::string::npos) {
    if (text[e + 1] == '+') text.erase(e + 1, 1);
    const std::size_t digits = e + 1 + (text[e + 1] == '-');
    while (text[digits] == '0')
      text.erase(digits, 1);
  }
  return text;
}

// the division rounds: of the numbers nearby, the shortest that reads back the same
std::string degrees_text(double radians) {
  const double degrees = radians / degree;
  for (double scale = 1; scale <= 1e9; scale *= 10)
    if (const double rounded = std::round(degrees * scale) / scale; rounded * degree == radians)
      return toml_text(rounded);
  return toml_text(degrees);
}

}  // namespace voussoir::keys
