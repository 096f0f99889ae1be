#include "core/scene/overrides.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>

#include "core/scene/keys.hpp"
#include "core/scene/renamed_keys.hpp"
#include "core/scene/toml_text.hpp"

namespace voussoir {
namespace {

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

std::vector<std::string> segments_of(std::string_view path) {
  std::vector<std::string> segments;
  while (true) {
    const std::size_t dot = path.find('.');
    segments.push_back(trimmed(path.substr(0, dot)));
    if (dot == std::string_view::npos) return segments;
    path.remove_prefix(dot + 1);
  }
}

[[noreturn]] void fail(const Place& place, const std::string& path, const std::string& rule) {
  refuse(place, one_line(path, 200) + ": " + rule, path);
}

// a table of a list, by name or else by number from 1
Node& find_item(Node* list, const std::string& name, const std::string& path, const Place& place) {
  if (!list || list->kind != Node::Kind::list || list->items.empty())
    fail(place, path, "the scene has no such tables; write [[" + path + "]] in the file");
  std::vector<std::string> names;
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    const std::string full = item_path(path, list->items[i], i);
    names.push_back(full.substr(path.size() + 1));
    const Node* stated = list->items[i].find("name");
    if (stated && stated->kind == Node::Kind::text && stated->text == name) return list->items[i];
  }
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error == std::errc{} && end == name.data() + name.size() && number >= 1 && number <= names.size())
    return list->items[number - 1];
  fail(place, key_path(path, name), "no table of this name; " + suggestion(name, names));
}

// The table that holds the path's last key, created if the file does not state it.
struct Target {
  Node* table;
  std::string path, keys;  // of the table: its address, and the same without the names of a list's tables
  std::string key;
};

Target find_target(Node& scene, const std::vector<std::string>& segments, const Place& place) {
  Node* table = &scene;
  Groups groups{""};
  std::string path, keys;
  for (std::size_t i = 0;; ++i) {
    if (table->kind != Node::Kind::table) fail(place, path, "the file states no table here; correct the file first");
    const KeyRow* row = find_row(groups, segments[i]);
    const std::string holder = path;
    path = key_path(path, segments[i]);
    if (const std::string_view why = former_key(path); !row && !why.empty()) fail(place, path, std::string(why));
    if (!row) fail(place, path, "no such key; " + suggestion(segments[i], keys_of(groups)));
    if (row->table.empty() && (row->key == "base" || row->key == "joints_file" || row->key == "blocks_file"))
      fail(place, path,
           "cannot be set, because overrides apply to the scene after its files have been read; write it in a file");
    if (i + 1 == segments.size()) return {table, holder, keys, segments[i]};
    keys = key_path(keys, segments[i]);

    Node* next = table->find(row->key);
    if (row->type == KeyType::table || row->type == KeyType::surface) {
      if (!next) {
        Node empty;
        empty.place = place;
        next = &table->set(row->key, empty);
      }
      table = next;
    } else if (row->type == KeyType::tables) {
      table = &find_item(next, segments[++i], path, place);
      path = key_path(path, segments[i]);
      if (i + 1 == segments.size())
        fail(place, path, "this is a table; name one of its keys: " + listed(keys_of(row->holds)));
    } else {
      fail(place, path, "this is a value and has no keys; write " + path + "=…");
    }
    groups = row->holds;
  }
}

}  // namespace

void apply_override(Node& scene, const std::string& text, const std::string& file, std::vector<std::string>& renamed) {
  const Place place{std::make_shared<const std::string>(file), 0,
                    std::make_shared<const std::string>(one_line(text, 120))};
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) fail(place, trimmed(text), "has no '='; write for example --set joints.A.dip=65");
  const std::vector<std::string> stated = segments_of(std::string_view(text).substr(0, equals));
  const std::vector<std::string> segments = with_present_names(stated);
  if (segments != stated)
    renamed.push_back(
        fmt::format("{}: {} is now {}", place_text(place), fmt::join(stated, "."), fmt::join(segments, ".")));
  const Target target = find_target(scene, segments, place);

  // of a table, some keys may now belong beside it: it replaces the one that was there, and they what was beside it
  Node changed;
  changed.place = place;
  changed.set(target.key, parse_toml_value(trimmed(std::string_view(text).substr(equals + 1)), place));
  take_present_names(changed, target.keys, target.path, renamed);
  std::erase_if(target.table->members, [&](const Member& member) { return member.key == target.key; });
  for (Member& member : changed.members)
    target.table->set(member.key, std::move(member.value));
}

}  // namespace voussoir
