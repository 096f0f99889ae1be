// The kinds of supports. Each room that does something of its own with them has a table with a row for each:
// support_table.hpp in core/scene, core/stage, core/step and core/output.
#pragma once

#include <cstddef>

namespace voussoir {

enum class SupportKind { bolt, grouted_bolt, lining };
inline constexpr std::size_t support_kinds = 3;

// whether a table has a row for each kind, in their order
template <class Table>
constexpr bool has_each_kind(const Table& table) {
  std::size_t next = 0;
  for (const auto& row : table)
    if (static_cast<std::size_t>(row.kind) != next++) return false;
  return next == support_kinds;
}

}  // namespace voussoir
