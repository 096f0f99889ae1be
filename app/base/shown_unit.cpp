#include "app/base/shown_unit.hpp"

#include <fmt/format.h>

namespace voussoir {

ShownUnit shown_unit(const std::string& si) {
  constexpr double kilo = 1e3;
  if (si == "1") return {1, ""};
  if (si == "Nm") return {kilo, "kN m"};  // as columns of history.csv name it
  for (const std::string unit : {"N", "Pa"})
    if (si == unit || si.starts_with(unit + "/") || si.starts_with(unit + " ")) return {kilo, "k" + si};
  return {1, si};
}

std::string after_value(const ShownUnit& unit) {
  return unit.name.empty() ? "" : " " + unit.name;
}

std::string quantity_text(double value, const std::string& si) {
  const ShownUnit shown = shown_unit(si);
  return fmt::format("{:g}{}", value / shown.size, after_value(shown));
}

}  // namespace voussoir
