// A row of a table of derivatives, by its key: a missing one is a failure of the test.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "app/derivatives/derivative_table.hpp"

namespace voussoir {

inline const DerivativeRow& row_of(const DerivativeTable& table, const std::string& key) {
  for (const DerivativeRow& row : table.rows)
    if (row.key.key == key) return row;
  ADD_FAILURE() << key << " is not in the table";
  static const DerivativeRow none{};
  return none;
}

}  // namespace voussoir
