// A row of the key table names the member that holds its key's value. Reader, type, choices and default follow.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include "core/scene/key_row.hpp"
#include "text/angle.hpp"

namespace voussoir::keys {

// ---- a checked value, into a member ---------------------------------------------------------------------------------

inline void take(const Node& node, bool& target) {
  target = node.boolean;
}
inline void take(const Node& node, double& target) {
  target = node.number;
}
template <std::integral T>
void take(const Node& node, T& target) {
  target = static_cast<T>(node.number);
}
inline void take(const Node& node, std::string& target) {
  target = node.text;
}

// axes: true, one of "x", "y", "z", or a list of them
inline void take(const Node& node, std::array<bool, 3>& axes) {
  axes.fill(node.kind == Node::Kind::boolean && node.boolean);
  if (node.kind == Node::Kind::text) axes[node.text[0] - 'x'] = true;
  for (const Node& axis : node.items)
    axes[axis.text[0] - 'x'] = true;
}

// one number counts as a vector of one, a spin in 2-D, and one name as a list of one
template <class T>
void take(const Node& node, std::vector<T>& target) {
  target.clear();
  if (node.kind != Node::Kind::list) take(node, target.emplace_back());
  for (const Node& item : node.items)
    take(item, target.emplace_back());
}

template <class T>
void take(const Node& node, std::optional<T>& target) {
  take(node, target.emplace());
}

// ---- a member's value as TOML; empty if it has none -----------------------------------------------------------------

std::string toml_text(double value);

std::string degrees_text(double radians);

inline std::string toml_text(bool value) {
  return value ? "true" : "false";
}
inline std::string toml_text(std::integral auto value) {
  return std::to_string(value);
}
inline std::string toml_text(const std::string& value) {
  return value.empty() ? "" : '"' + value + '"';
}

template <class T>
std::string toml_text(const std::vector<T>& values) {
  std::string text;
  for (const T& value : values)
    text += (text.empty() ? "[" : ", ") + toml_text(value);
  return text.empty() ? "" : text + "]";
}

inline std::string toml_text(const std::array<bool, 3>& axes) {
  if (axes[0] && axes[1] && axes[2]) return "true";
  std::vector<std::string> names;
  for (std::size_t k = 0; k < axes.size(); ++k)
    if (axes[k]) names.emplace_back(1, "xyz"[k]);
  return toml_text(names);
}

template <class T>
std::string toml_text(const std::optional<T>& value) {
  return value ? toml_text(*value) : "";
}

// ---- the parts of a row
// ----------------------------------------------------------------------------------------------

template <class Owner, class T, class Take, class Text>
KeyMember key_member(T Owner::*at, KeyType type, Take take, Text text) {
  return {.owner = &typeid(Owner),
          .type = type,
          .take = [=](const Node& value, void* owner) { take(value, static_cast<Owner*>(owner)->*at); },
          .text = [=](const void* owner) { return text(static_cast<const Owner*>(owner)->*at); },
          .default_value = text(Owner{}.*at)};
}

constexpr KeyType type_of(const bool*) {
  return KeyType::boolean;
}
template <std::integral T>
constexpr KeyType type_of(const T*) {
  return KeyType::integer;
}
constexpr KeyType type_of(const double*) {
  return KeyType::number;
}
constexpr KeyType type_of(const std::string*) {
  return KeyType::text;
}
constexpr KeyType type_of(const std::vector<double>*) {
  return KeyType::vector;
}
constexpr KeyType type_of(const std::vector<std::string>*) {
  return KeyType::names;
}
constexpr KeyType type_of(const std::vector<std::vector<double>>*) {
  return KeyType::points;
}
constexpr KeyType type_of(const std::array<bool, 3>*) {
  return KeyType::axes;
}
template <class T>
constexpr KeyType type_of(const std::optional<T>*) {
  return type_of(static_cast<const T*>(nullptr));
}

// the value as written; its type follows from the member's unless a text is a name, or a vector is a spin or numbers
template <class Owner, class T>
KeyMember in(T Owner::*at, KeyType type = type_of(static_cast<const T*>(nullptr))) {
  return key_member(
      at, type, [](const Node& value, T& target) { take(value, target); },
      [](const T& value) { return toml_text(value); });
}

// degrees in the file, radians in the member
template <class Owner, class T>
KeyMember degrees(T Owner::*at) {
  return key_member(
      at, KeyType::number, [](const Node& value, T& target) { target = value.number * degree; },
      [](std::optional<double> radians) { return radians ? degrees_text(*radians) : ""; });
}

template <class T>
using Words = std::vector<std::pair<std::string_view, T>>;

template <class T>
std::vector<std::string_view> choices_of(const Words<T>& words) {
  std::vector<std::string_view> choices;
  for (const auto& [word, meaning] : words)
    choices.push_back(word);
  return choices;
}

// every other word has been refused by the table
template <class T>
T meaning_of(const Words<T>& words, std::string_view text) {
  return std::find_if(words.begin(), words.end(), [&](const auto& word) { return word.first == text; })->second;
}

template <class T>
std::string word_for(const Words<T>& words, T value) {
  const auto at = std::find_if(words.begin(), words.end(), [&](const auto& word) { return word.second == value; });
  return at == words.end() ? "" : std::string(at->first);
}

// one of several words; if several mean the same value, the first is shown
template <class Owner, class T>
KeyMember one_of(T Owner::*at, const std::type_identity_t<Words<T>>& words) {
  KeyMember made = key_member(
      at, KeyType::choice, [=](const Node& value, T& target) { target = meaning_of(words, value.text); },
      [=](const T& value) { return toml_text(word_for(words, value)); });
  made.choices = choices_of(words);
  return made;
}

// one of several words, each for an alternative of a variant, in its order
template <class Owner, class... T>
KeyMember alternative(std::variant<T...> Owner::*at, const std::array<std::string_view, sizeof...(T)>& words) {
  KeyMember made = key_member(
      at, KeyType::choice,
      [=](const Node& value, std::variant<T...>& target) {
        std::size_t k = 0;
        ((words[k++] == value.text ? void(target = T{}) : void()), ...);
      },
      [=](const std::variant<T...>& value) { return toml_text(std::string(words[value.index()])); });
  made.choices.assign(words.begin(), words.end());
  return made;
}

// a list of given words
template <class Owner, class T>
KeyMember some_of(std::vector<T> Owner::*at, const std::type_identity_t<Words<T>>& words) {
  KeyMember made = key_member(
      at, KeyType::choices,
      [=](const Node& value, std::vector<T>& target) {
        target.clear();
        if (value.kind == Node::Kind::text) target.push_back(meaning_of(words, value.text));
        for (const Node& item : value.items)
          target.push_back(meaning_of(words, item.text));
      },
      [=](const std::vector<T>& values) {
        std::vector<std::string> found;
        for (const T& value : values)
          found.push_back(word_for(words, value));
        return toml_text(found);
      });
  made.choices = choices_of(words);
  return made;
}

// a table whose keys, those of one group, are all read into one struct
template <class Owner, class T>
KeyMember group(T Owner::*at, std::string_view name) {
  KeyMember made = key_member(
      at, KeyType::table, [=](const Node& value, T& target) { read_keys(value, name, target); },
      [](const T&) { return std::string(); });
  made.holds = {name};
  return made;
}

}  // namespace voussoir::keys
