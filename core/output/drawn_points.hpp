// Points and names of frames (vtp.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/types.hpp"
#include "core/output/vtp.hpp"

namespace voussoir {

inline std::array<double, 3> in_space(const Vector<2>& v) {
  return {v[0], v[1], 0};
}
inline std::array<double, 3> in_space(const Vector<3>& v) {
  return {v[0], v[1], v[2]};
}

template <int Dim>
void append(DataArray& array, const Vector<Dim>& v) {
  const std::array<double, 3> components = in_space(v);
  array.values.insert(array.values.end(), components.begin(), components.end());
}

template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& list) {
  std::vector<std::string> names;
  for (const Named& item : list)
    names.push_back(item.name);
  return names;
}

// nothing if there is no array of this name
inline const std::vector<double>* values_of(const std::vector<DataArray>& arrays, std::string_view name) {
  const auto found = std::ranges::find(arrays, name, &DataArray::name);
  return found == arrays.end() ? nullptr : &found->values;
}

}  // namespace voussoir
