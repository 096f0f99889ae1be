#include "core/scene/node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <utility>

namespace voussoir {
namespace {

constexpr std::size_t longest_value = 60;

auto position(const std::vector<Member>& members, std::string_view key) {
  return std::lower_bound(members.begin(), members.end(), key,
                          [](const Member& m, std::string_view k) { return m.key < k; });
}

std::string number_text(double number) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, number).ptr;
  return {buffer, end};
}

std::string joined_values(const Node& node) {
  std::string text;
  for (const Node& item : node.items) {
    if (text.size() > longest_value) break;
    text += (text.empty() ? "" : ", ") + value_text(item);
  }
  for (const Member& member : node.members) {
    if (text.size() > longest_value) break;
    text += (text.empty() ? "" : ", ") + member.key + " = " + value_text(member.value);
  }
  return text;
}

// the number of letters to insert, drop, replace or swap with their neighbour (optimal string alignment)
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  std::iota(last.begin(), last.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) now[j] = std::min(now[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, now);
  }
  return last[b.size()];
}

}  // namespace

bool Node::is_list_of_tables() const {
  return kind == Kind::list && !items.empty() &&
         std::ranges::all_of(items, [](const Node& item) { return item.kind == Kind::table; });
}

const Node* Node::find(std::string_view key) const {
  const auto at = position(members, key);
  return at != members.end() && at->key == key ? &at->value : nullptr;
}

Node* Node::find(std::string_view key) {
  return const_cast<Node*>(std::as_const(*this).find(key));
}

Node& Node::set(std::string_view key, Node value) {
  if (Node* present = find(key)) return *present = std::move(value);
  return members.insert(position(members, key), {std::string(key), std::move(value)})->value;
}

std::string key_path(const std::string& table_path, std::string_view key) {
  return table_path.empty() ? std::string(key) : table_path + "." + std::string(key);
}

std::string name_of(const Node& table) {
  const Node* name = table.find("name");
  return name && name->kind == Node::Kind::text ? name->text : "";
}

std::string item_path(const std::string& list_path, const Node& item, std::size_t index) {
  const std::string name = name_of(item);
  return list_path + "." + (name.empty() ? std::to_string(index + 1) : one_line(name, longest_value));
}

std::optional<Subject> child(const Subject& table, std::string_view key) {
  const Node* node = table.node->find(key);
  if (!node) return {};
  return Subject{node, key_path(table.path, key)};
}

std::vector<Subject> children(const Subject& table, std::string_view key) {
  std::vector<Subject> all;
  const Node* list = table.node->find(key);
  const std::string path = key_path(table.path, key);
  for (std::size_t i = 0; list && i < list->items.size(); ++i)
    all.push_back({&list->items[i], item_path(path, list->items[i], i)});
  return all;
}

std::string value_text(const Node& node) {
  switch (node.kind) {
    case Node::Kind::boolean:
      return node.boolean ? "true" : "false";
    case Node::Kind::integer:
    case Node::Kind::number:
      return number_text(node.number);
    case Node::Kind::text:
      return '"' + one_line(node.text, longest_value) + '"';
    case Node::Kind::date:
      return "a date or time";
    case Node::Kind::list:
      return one_line("[" + joined_values(node) + "]", longest_value);
    case Node::Kind::table:
      return one_line("{ " + joined_values(node) + " }", longest_value);
  }
  return "";
}

std::string place_text(const Place& place) {
  std::string source = place.source ? *place.source : "scene";
  if (place.override_text) source += ": --set " + *place.override_text;
  return place.line > 0 ? source + ":" + std::to_string(place.line) : source;
}

std::string complaint(const Node& node, const std::string& path, const std::string& rule) {
  return place_text(node.place) + ": " + one_line(path, 200) + " = " + value_text(node) + ": " + rule;
}

std::string complaint(const Subject& table, std::string_view key, const std::string& rule) {
  const std::string path = key_path(table.path, key);
  if (const Node* value = table.node->find(key)) return complaint(*value, path, rule);
  return place_text(table.node->place) + ": " + one_line(path, 200) + " is missing: " + rule;
}

namespace {

SceneError error_at(const Place& place, const std::string& message, const std::string& key) {
  return SceneError(message, place.source ? *place.source : "", place.line, key);
}

}  // namespace

void refuse(const Place& place, const std::string& message, const std::string& key) {
  throw error_at(place, place_text(place) + ": " + message, key);
}

void refuse(const Node& node, const std::string& path, const std::string& rule) {
  throw error_at(node.place, complaint(node, path, rule), path);
}

void refuse(const Subject& table, std::string_view key, const std::string& rule) {
  const Node* value = table.node->find(key);
  throw error_at(value ? value->place : table.node->place, complaint(table, key, rule), key_path(table.path, key));
}

void require_plain_text(const Node& node, const std::string& path) {
  const auto require = [&](const Node& holder, std::string_view text, const std::string& at, const char* subject) {
    if (const auto fault = text_fault(text))
      refuse(holder, at,
             fmt::format("{} must not contain {}; write it in one line of plain text", subject, fault->what));
  };
  if (node.kind == Node::Kind::text) require(node, node.text, path, "it");
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const bool table = node.items[i].kind == Node::Kind::table;
    require_plain_text(node.items[i], table ? item_path(path, node.items[i], i) : path);
  }
  for (const Member& member : node.members) {
    const std::string here = key_path(path, member.key);
    require(member.value, member.key, here, "the key");
    require_plain_text(member.value, here);
  }
}

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    // a shortened word counts as one wrong letter, e.g. friction for friction_deg
    const bool begins = word.size() >= 3 && candidate.starts_with(word);
    const std::size_t distance = begins ? 1 : edit_distance(word.substr(0, 200), candidate);
    if (distance < least && distance < std::max(word.size(), candidate.size())) least = distance, best = candidate;
  }
  return best;
}

std::string listed(const std::vector<std::string>& words, const std::string& none) {
  constexpr std::size_t longest = 24;
  if (words.empty()) return none;
  std::string text;
  for (std::size_t i = 0; i < words.size() && i < longest; ++i)
    text += (i ? ", " : "") + one_line(words[i], longest_value);
  return words.size() > longest ? text + ", …" : text;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string near = nearest(word, candidates);
  return (near.empty() ? "" : "did you mean '" + near + "'? ") + "there are: " + listed(candidates);
}

}  // namespace voussoir
