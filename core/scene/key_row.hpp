// One key of a scene: its row in the table of keys (keys.hpp).
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <typeinfo>
#include <vector>

#include "core/scene/node.hpp"

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
  axes,     // true, one of "x", "y", "z", or a list of them
  names,    // a list of texts, or one
  choices,  // a list of some of KeyRow::choices, or one
  points,   // a list of vectors
  numbers,  // a list of numbers
  surface,  // 2-D a list of vectors, 3-D a table
  table,
  tables  // [[key]]: a list of tables
};

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool above_low = false;   // low itself is refused
  bool below_high = false;  // high itself is refused
  bool or_zero = false;     // zero is in it, although it is below low

  bool holds(double x) const;
};

// the key applies only if another key of its table has this value, or one of several: "a|b"
struct Condition {
  std::string_view key, value;
};

// groups of keys that a table may contain
using Groups = std::vector<std::string_view>;

// The member of a plain struct, its owner, that holds the value of a key; made by keys/members.hpp.
struct KeyMember {
  const std::type_info* owner = nullptr;
  KeyType type = KeyType::number;
  std::function<void(const Node& value, void* owner)> take;  // a checked value
  std::function<std::string(const void* owner)> text;        // the value as TOML; empty: none
  std::string default_value{};                               // the text of a default-constructed owner
  std::vector<std::string_view> choices{};
  Groups holds{};
};

struct KeyRow {
  std::string_view table{};  // the group of keys it belongs to, of which it is a row; "" is the top of the file
  std::string_view key{};
  // The members that receive the value, one for each struct that may hold it: type, choices, default and a table's keys
  // follow from it. None if code reads the value by hand: then the row states them.
  std::vector<KeyMember> members{};
  KeyType type = KeyType::number;
  std::string_view unit{};
  Range range{};      // anything else is refused; of vectors, each entry
  Range plausible{};  // a value outside is legal but probably a mistake, and gives a warning; of vectors, the length
  std::string default_value{};   // as TOML; empty: none
  std::string_view example{};    // a value as TOML
  bool required = false;         // if its condition holds
  bool no_default = false;       // the initial value of its member is not a default
  Condition when{}, and_when{};  // both must hold if both are stated
  std::vector<std::string_view> choices{};
  Groups holds{};  // table, tables: the groups of keys inside
  std::string_view meaning{};
  std::string_view repair{};   // repair of a value out of range; may be empty
  std::string_view breaks{};   // consequence of a badly chosen value; may be empty
  std::string_view mistake{};  // the likely mistake if a value is not plausible, as a question; may be empty
};

// Reads a checked table into the members of `owner`, of this type, that the rows of a group name. Keys that it does not
// state leave their members unchanged.
void read_keys(const Node& table, std::string_view group, const std::type_info& type, void* owner);

template <class Owner>
void read_keys(const Node& table, std::string_view group, Owner& owner) {
  read_keys(table, group, typeid(Owner), &owner);
}

}  // namespace voussoir
