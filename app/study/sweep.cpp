#include "app/study/sweep.hpp"

namespace voussoir {

std::string shown_value(const std::string& value) {
  return value.starts_with('"') ? value.substr(1, value.size() - 2) : value;
}

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() || unit == "1" ? name : name + " (" + unit + ")";
}

std::vector<std::string> overrides_of(const Sweep& sweep, std::size_t place) {
  std::vector<std::string> overrides = sweep.overrides;
  if (sweep.varied == Varied::one_key && !sweep.key.empty()) overrides.push_back(sweep.key + "=" + sweep.values[place]);
  for (const TiedKey& tied : sweep.with)
    overrides.push_back(tied.key + "=" + tied.values[place]);
  // frames cost time and are not needed here
  overrides.push_back("output.frames=false");
  overrides.push_back("output.view=false");
  return overrides;
}

}  // namespace voussoir
