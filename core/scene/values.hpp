// Takes checked values out of a scene's tree; a key that is not stated leaves the target as it is.
#pragma once

#include <array>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/node.hpp"

namespace voussoir {

inline void take(const Node& node, bool& target) {
  target = node.boolean;
}
inline void take(const Node& node, double& target) {
  target = node.number;
}
inline void take(const Node& node, int& target) {
  target = static_cast<int>(node.number);
}
inline void take(const Node& node, long long& target) {
  target = static_cast<long long>(node.number);
}
inline void take(const Node& node, std::string& target) {
  target = node.text;
}

// one number counts as a vector of one: a spin in 2-D
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

template <class T>
void read(const Subject& table, std::string_view key, T& target) {
  if (const Node* node = table.node->find(key)) take(*node, target);
}

inline constexpr double radians_per_degree = std::numbers::pi / 180;

inline void read_degrees(const Subject& table, std::string_view key, double& target) {
  if (const Node* node = table.node->find(key)) target = node->number * radians_per_degree;
}

// true, or a list of "x", "y", "z"
inline void read_axes(const Subject& subject, std::string_view key, std::array<bool, 3>& axes) {
  const Node* node = subject.node->find(key);
  if (!node) return;
  if (node->kind == Node::Kind::boolean) axes.fill(node->boolean);
  for (const Node& axis : node->items)
    axes[axis.text[0] - 'x'] = true;
}

// a table, or the tables of a list, with their addresses
inline std::optional<Subject> child(const Subject& table, std::string_view key) {
  const Node* node = table.node->find(key);
  if (!node) return {};
  return Subject{node, key_path(table.path, key)};
}

inline std::vector<Subject> children(const Subject& table, std::string_view key) {
  std::vector<Subject> all;
  const Node* list = table.node->find(key);
  const std::string path = key_path(table.path, key);
  for (std::size_t i = 0; list && i < list->items.size(); ++i)
    all.push_back({&list->items[i], item_path(path, list->items[i], i)});
  return all;
}

}  // namespace voussoir
