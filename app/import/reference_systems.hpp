// The reference systems of EPSG and ESRI by number: their kind and the unit of their axes. There is no range of numbers
// for either; the table comes from PROJ's database, by reference_systems.sh.
#pragma once

#include <cstddef>
#include <iterator>
#include <string_view>

#include "app/import/length_unit.hpp"

namespace voussoir {

enum class SystemKind { projected, geographic, geocentric };

// systems of one kind and unit; geographic and geocentric ones have no unit in a plane
struct SystemGroup {
  std::string_view authority;
  SystemKind kind;
  LengthUnit unit;
  std::string_view codes;  // ascending, "3819 3824-3829": runs of numbers that are all systems
};

extern const SystemGroup system_groups[];
extern const std::size_t system_group_count;

// nothing if the table has no such number
const SystemGroup* reference_system(std::string_view authority, long long code);

}  // namespace voussoir
