#include "core/scene/renamed_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

#include "core/scene/keys.hpp"

namespace voussoir {
namespace {

using Keys = std::span<const std::string>;

std::vector<std::string> keys_of_path(std::string_view path) {
  std::vector<std::string> keys;
  for (std::size_t dot = path.find('.'); dot != path.npos; dot = path.find('.')) {
    keys.emplace_back(path.substr(0, dot));
    path.remove_prefix(dot + 1);
  }
  keys.emplace_back(path);
  return keys;
}

const Node* value_at(const Node& table, Keys path) {
  const Node* node = &table;
  for (const std::string& key : path)
    if (node) node = node->find(key);
  return node;
}

void erase(Node& table, std::string_view key) {
  std::erase_if(table.members, [&](const Member& member) { return member.key == key; });
}

// A table that this empties is erased with the value.
Node taken_from(Node& table, Keys path) {
  Node& inner = *table.find(path.front());
  Node value = path.size() == 1 ? inner : taken_from(inner, path.subspan(1));
  if (path.size() == 1 || inner.members.empty()) erase(table, path.front());
  return value;
}

void put_into(Node& table, Keys path, Node value) {
  if (path.size() == 1) {
    table.set(path.front(), std::move(value));
    return;
  }
  if (!table.find(path.front())) {
    Node empty;
    empty.place = value.place;
    table.set(path.front(), std::move(empty));
  }
  put_into(*table.find(path.front()), path.subspan(1), std::move(value));
}

std::string text_of(const std::string& table, Keys path) {
  std::string text = table;
  for (const std::string& key : path)
    text = key_path(text, key);
  return text;
}

[[noreturn]] void refuse_both(const Node& earlier, const Node& present, const std::string& path, Keys from, Keys to) {
  const std::string line = present.place.line > 0 ? fmt::format(" in line {}", present.place.line) : "";
  const std::string name = text_of(path, from);
  refuse(earlier, name,
         fmt::format("is the earlier name of {}, which is stated too{}; remove {}", text_of(path, to), line, name));
}

// Moves the value at `from` to `to`, in every table of a list on the way that both paths begin with.
void move_value(Node& table, Keys from, Keys to, const std::string& path, std::vector<std::string>* met) {
  if (table.kind != Node::Kind::table) return;
  if (from.front() == to.front()) {
    Node* inner = table.find(from.front());
    if (!inner) return;
    const std::string here = key_path(path, from.front());
    move_value(*inner, from.subspan(1), to.subspan(1), here, met);
    for (std::size_t k = 0; k < inner->items.size(); ++k)
      move_value(inner->items[k], from.subspan(1), to.subspan(1), item_path(here, inner->items[k], k), met);
    return;
  }
  const Node* earlier = value_at(table, from);
  if (!earlier) return;
  if (const Node* present = value_at(table, to)) refuse_both(*earlier, *present, path, from, to);
  if (met)
    met->push_back(fmt::format("{}: {} is now {}", place_text(earlier->place), one_line(text_of(path, from), 200),
                               one_line(text_of(path, to), 200)));
  put_into(table, to, taken_from(table, from));
}

std::size_t common_length(Keys a, Keys b) {
  return static_cast<std::size_t>(std::ranges::mismatch(a, b).in1 - a.begin());
}

}  // namespace

void take_present_names(Node& table, const std::string& keys, const std::string& path, std::vector<std::string>& met) {
  const std::vector<std::string> above = keys.empty() ? std::vector<std::string>() : keys_of_path(keys);
  for (const RenamedKey& row : renamed_keys) {
    const std::vector<std::string> from = keys_of_path(row.earlier), to = keys_of_path(row.present);
    if (common_length(above, from) < above.size() || common_length(above, to) < above.size()) continue;
    if (from.size() == above.size() || to.size() == above.size()) continue;
    move_value(table, Keys(from).subspan(above.size()), Keys(to).subspan(above.size()), path, &met);
  }
}

std::vector<std::string> with_present_names(std::vector<std::string> segments) {
  Groups groups{""};
  std::string keys;
  std::vector<std::size_t> places;  // of the keys among the segments
  for (std::size_t i = 0; i < segments.size(); ++i) {
    keys = key_path(keys, segments[i]);
    places.push_back(i);
    const auto row = std::ranges::find(renamed_keys, keys, &RenamedKey::earlier);
    if (row != std::end(renamed_keys)) {
      const std::vector<std::string> from = keys_of_path(row->earlier), to = keys_of_path(row->present);
      const std::size_t common = common_length(from, to);
      segments.erase(segments.begin() + static_cast<std::ptrdiff_t>(places[common]),
                     segments.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      segments.insert(segments.begin() + static_cast<std::ptrdiff_t>(places[common]),
                      to.begin() + static_cast<std::ptrdiff_t>(common), to.end());
      return with_present_names(std::move(segments));
    }
    const KeyRow* known = find_row(groups, segments[i]);
    if (!known) break;
    groups = known->holds;
    if (known->type == KeyType::tables) ++i;
  }
  return segments;
}

Node with_earliest_names(Node scene) {
  for (auto row = std::rbegin(renamed_keys); row != std::rend(renamed_keys); ++row) {
    const std::vector<std::string> from = keys_of_path(row->present), to = keys_of_path(row->earlier);
    move_value(scene, from, to, "", nullptr);
  }
  return scene;
}

}  // namespace voussoir
