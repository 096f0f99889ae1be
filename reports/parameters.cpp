#include "reports/parameters.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <sstream>
#include <stdexcept>

#include "reports/html.hpp"
#include "verification/verdict_file.hpp"

namespace voussoir::reports {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_joints = 8;  // a table of more would hide the other parameters

struct Key {
  std::string unit, meaning;
};

// the cells of a row of a table in markdown
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream row(line.substr(1));
  for (std::string cell; std::getline(row, cell, '|');) {
    const std::size_t first = cell.find_first_not_of(' '), last = cell.find_last_not_of(' ');
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last + 1 - first));
  }
  return cells;
}

// keys of `voussoir docs` by "heading`key", the first clause of their meaning
std::map<std::string, Key> read_keys(const fs::path& file) {
  std::map<std::string, Key> keys;
  if (!fs::exists(file)) return keys;
  std::istringstream lines(verification::read_text(file));
  std::string heading;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("## ")) heading = line.substr(3);
    if (!line.starts_with("| `")) continue;
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() >= 5) keys[heading + cells[0]] = {cells[2], cells[4].substr(0, cells[4].find_first_of(";.:"))};
  }
  return keys;
}

// a number, a list of numbers, true or a text; empty for tables and lists of other things
std::string value_of(const toml::node& node) {
  if (const auto number = node.value_exact<std::int64_t>()) return fmt::format("{}", *number);
  if (const auto number = node.value_exact<double>()) return fmt::format("{:g}", *number);
  if (const auto truth = node.value_exact<bool>()) return *truth ? "true" : "false";
  if (const auto text = node.value_exact<std::string>()) return *text;
  if (!node.is_array()) return {};
  std::string list;
  for (const toml::node& item : *node.as_array()) {
    const std::string text = item.is_number() ? value_of(item) : "";
    if (text.empty()) return {};
    list += (list.empty() ? "" : ", ") + text;
  }
  return list;
}

toml::table* of_name(toml::array& list, const std::string& name) {
  for (toml::node& node : list)
    if (toml::table* table = node.as_table(); table && (*table)["name"].value_or(std::string()) == name) return table;
  return nullptr;
}

// `over` in `scene`: tables of a list by their names, as a scene with `base` is read
void lay(const toml::table& over, toml::table& scene) {
  for (const auto& [key, node] : over) {
    toml::array* list = scene[key].as_array();
    const toml::array* more = node.as_array();
    if (!list || !more || !list->is_array_of_tables() || !more->is_array_of_tables()) {
      scene.insert_or_assign(key, node);
      continue;
    }
    for (const toml::node& entry : *more)
      if (toml::table* known = of_name(*list, (*entry.as_table())["name"].value_or(std::string())))
        lay(*entry.as_table(), *known);
      else
        list->push_back(*entry.as_table());
  }
}

toml::table read_scene(const fs::path& file) {
  try {
    const toml::table scene = toml::parse_file(file.string());
    const auto base = scene["base"].value<std::string>();
    if (!base) return scene;
    toml::table whole = read_scene(file.parent_path() / *base);
    lay(scene, whole);
    return whole;
  } catch (const toml::parse_error& problem) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), problem.description()));
  }
}

struct Rows {
  std::map<std::string, Key> keys;
  std::string html = {};

  void add(const std::string& heading, const std::string& of, const toml::table& table,
           std::initializer_list<std::string_view> only = {}) {
    for (const auto& [key, node] : table) {
      const std::string name(key.str());
      if (only.size() ? std::find(only.begin(), only.end(), name) == only.end() : name == "name") continue;
      const std::string value = value_of(node);
      if (value.empty()) continue;
      const auto found = keys.find(heading + "`" + name + "`");
      const Key known = found == keys.end() ? Key{} : found->second;
      html += fmt::format(
          "<tr><td>{}</td><td><code>{}</code></td><td class=\"number\">{}</td><td>{}</td><td>{}</td></tr>\n",
          escape(of), escape(name), escape(value), escape(known.unit), escape(known.meaning));
    }
  }

  void add_all(const toml::table& scene, const char* list, const char* kind) {
    const toml::array* tables = scene[list].as_array();
    if (!tables) return;
    for (const toml::node& node : *tables)
      if (const toml::table* table = node.as_table())
        add(fmt::format("`[[{}]]`", list), fmt::format("{} {}", kind, (*table)["name"].value_or("")), *table);
  }
};

}  // namespace

std::string parameter_table(const fs::path& scene_file, const fs::path& keys) {
  if (!fs::exists(scene_file)) return {};
  const toml::table scene = read_scene(scene_file);
  Rows rows{read_keys(keys)};
  rows.add("The top of the file", "scene", scene, {"gravity", "density"});
  if (const toml::array* joints = scene["joints"].as_array(); joints && joints->size() <= most_joints)
    rows.add_all(scene, "joints", "joint");
  rows.add_all(scene, "joint_properties", "properties");
  if (rows.html.empty()) return {};
  return "<h3>Parameters</h3>\n<div class=\"scroll\"><table class=\"parameters\"><thead><tr><th>of</th><th>key</th>"
         "<th class=\"number\">value</th><th>unit</th><th>meaning</th></tr></thead><tbody>\n" +
         rows.html +
         fmt::format(
             "</tbody></table></div>\n<p class=\"quiet\">As <code>{}</code> states them; its stages may change "
             "them.</p>\n",
             escape(scene_file.filename().string()));
}

}  // namespace voussoir::reports
