// One key of a scene: what the table of keys (keys.hpp) says of it.
#pragma once

#include <limits>
#include <string_view>
#include <vector>

namespace voussoir {

enum class KeyType {
  boolean,
  integer,
  number,
  text,
  name,     // a text without '.' and '=', so that --set can address it
  choice,   // one of KeyRow::choices
  vector,   // as many numbers as the scene has dimensions
  spin,     // 2-D a number, 3-D three numbers
  axes,     // true, or a list of "x", "y", "z"
  names,    // a list of texts
  choices,  // a list of some of KeyRow::choices
  points,   // a list of vectors
  numbers,  // a list of numbers
  table,
  tables  // [[key]]: a list of tables
};

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool above_low = false;   // low itself is refused
  bool below_high = false;  // high itself is refused
  bool or_zero = false;     // zero lies in it, although it lies below low

  bool holds(double x) const;
};

// the key means something only where another key of its table has this value
struct Condition {
  std::string_view key, value;
};

struct KeyRow {
  std::string_view table{};  // the group of keys it belongs to, of which it is a row; "" is the top of the file
  std::string_view key{};
  KeyType type = KeyType::number;
  std::string_view unit{};
  Range range{};      // anything else is refused; of vectors, each entry
  Range plausible{};  // anything else is legal but more likely a mistake: a warning; of vectors, the length
  std::string_view default_value{};  // as TOML; empty: none
  std::string_view example{};        // a value as TOML
  bool required = false;             // where its condition holds
  Condition when{};
  std::vector<std::string_view> choices{};
  std::vector<std::string_view> holds{};  // table, tables: the groups of keys inside
  std::string_view meaning{};
  std::string_view repair{};   // what to do about a value out of range; may be empty
  std::string_view breaks{};   // what goes wrong with a badly chosen value; may be empty
  std::string_view mistake{};  // the likely one where a value is not plausible, as a question; may be empty
};

}  // namespace voussoir
