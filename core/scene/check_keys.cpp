// Checks a scene's tree against the key table.
#include <algorithm>
#include <cmath>
#include <set>

#include "core/scene/keys.hpp"

namespace voussoir {
namespace {

// planes or corners of one block, every three of which are tried
constexpr std::size_t most_corners = 200;

// so many intersecting joints make more blocks than any memory holds
constexpr std::size_t most_stated_joints = 10000;

struct Checker {
  int dimension;

  void table(const Node& node, const Groups& groups, const std::string& path) const;
  void tables(const KeyRow& row, const Node& node, const std::string& path) const;
  void value(const KeyRow& row, const Node& node, const std::string& path) const;
  void number(const KeyRow& row, const Node& node, const std::string& path) const;
  void numbers(const KeyRow& row, const Node& node, const std::string& path, std::size_t count) const;
  void points(const KeyRow& row, const Node& node, const std::string& path) const;
  void list(const KeyRow& row, const Node& node, const std::string& path) const;
  void words(const KeyRow& row, const Node& node, const std::string& path,
             const std::vector<std::string_view>& allowed) const;
  void axes(const KeyRow& row, const Node& node, const std::string& path) const;
};

std::string quoted_list(const std::vector<std::string_view>& words) {
  std::string text;
  for (const std::string_view word : words)
    text += (text.empty() ? "\"" : ", \"") + std::string(word) + "\"";
  return text;
}

std::string example_of(const KeyRow& row) {
  if (row.example.empty()) return "";
  return "; write for example " + std::string(row.key) + " = " + std::string(row.example);
}

std::string repair_of(const KeyRow& row) {
  return row.repair.empty() ? example_of(row) : "; " + std::string(row.repair);
}

// examples are for 3-D scenes; in 2-D only the number of entries is reported
std::string vector_rule(const KeyRow& row, std::size_t count) {
  std::string rule =
      "must be " + (count == 1 ? std::string("one number") : "a list of " + std::to_string(count) + " numbers");
  if (!row.unit.empty()) rule += " in " + std::string(row.unit);
  if (count == 1) return rule + " because dimension = 2; write for example " + std::string(row.key) + " = 0.5";
  rule += count == 2 ? " (x, y) because dimension = 2" : " (x, y, z) because dimension = 3";
  const char* const upwards = count == 2 ? "[0, 1]" : "[0, 0, 1]";
  const char* const downwards = count == 2 ? "[0, -9.81]" : "[0, 0, -9.81]";
  return rule + "; write for example " + std::string(row.key) + " = " + (row.key == "gravity" ? downwards : upwards);
}

// the repair of a list that is too long
std::string fewer(const KeyRow& row) {
  if (row.table == "blocks") return "divide the block into parts";
  if (row.table == "domain") return "leave out those that bound nothing, or divide the domain";
  if (row.table == "excavations" || row.table == "region") return "divide the excavation";
  if (row.key == "table")
    return "leave out points that are on the straight line between their neighbours, or nearly so";
  return "leave out those that are close to one another";
}

const Node* text_of(const Node& table, std::string_view key) {
  const Node* node = table.find(key);
  return node && node->kind == Node::Kind::text ? node : nullptr;
}

bool holds(const Node& table, const Groups& groups, const Condition& condition);

}  // namespace

bool key_applies(const Node& table, const Groups& groups, const KeyRow& row) {
  return holds(table, groups, row.when) && holds(table, groups, row.and_when);
}

namespace {

bool holds(const Node& table, const Groups& groups, const Condition& condition) {
  if (condition.key.empty()) return true;
  const KeyRow* decisive = find_row(groups, condition.key);
  if (!decisive || !key_applies(table, groups, *decisive)) return false;
  const Node* stated = text_of(table, condition.key);
  const std::string word = stated ? '"' + stated->text + '"' : std::string(decisive->default_value);
  std::string_view allowed = condition.value;
  while (true) {
    const std::size_t bar = allowed.find('|');
    if (word == '"' + std::string(allowed.substr(0, bar)) + '"') return true;
    if (bar == std::string_view::npos) return false;
    allowed.remove_prefix(bar + 1);
  }
}

// keys that scenes of earlier versions may hold
constexpr std::pair<std::string_view, std::string_view> former_keys[] = {
    {"contact.centre", "has left the program together with Ipopt: Newton's method finds every centre; remove the line"},
    {"contact.lp",
     "has left the program together with GLPK, which core/solvers/outside_solvers_test.cpp keeps as the reference of "
     "its "
     "decisions; remove the line"}};

[[noreturn]] void refuse_unknown(const Node& node, const Groups& groups, const std::string& path,
                                 std::string_view key) {
  if (const std::string_view why = former_key(path); !why.empty()) refuse(node, path, std::string(why));
  std::string rule = "no such key; ";
  const std::vector<std::string> known = keys_of(groups);
  if (const std::string near = nearest(key, known); !near.empty()) {
    rule += "did you mean '" + near + "'? ";
  } else {
    for (const KeyRow& row : key_rows())
      if (row.key == key)
        rule += "it belongs to " +
                (row.table.empty() ? "the top of the file" : "a table of '" + std::string(row.table) + "'") + "; ";
  }
  refuse(node, path, rule + "allowed here: " + listed(known));
}

// names the outermost condition that fails; one that is not stated at all is reported as missing later
void refuse_inapplicable(const Node& table, const Groups& groups, const KeyRow& row, const Node& node,
                         const std::string& path) {
  const Condition& failing = holds(table, groups, row.when) ? row.and_when : row.when;
  const KeyRow& decisive = *find_row(groups, failing.key);
  if (!key_applies(table, groups, decisive)) return refuse_inapplicable(table, groups, decisive, node, path);
  const Node* stated = text_of(table, failing.key);
  if (!stated && decisive.default_value.empty()) return;
  std::string values = "\"" + std::string(failing.value) + "\"";
  if (const std::size_t bar = values.find('|'); bar != std::string::npos) values.replace(bar, 1, "\" or \"");
  const std::string found =
      stated ? '"' + one_line(stated->text, 40) + '"' : std::string(decisive.default_value) + " (the default)";
  refuse(node, path,
         "applies only if " + std::string(failing.key) + " = " + values + ", which here is " + found +
             "; remove it or change " + std::string(failing.key));
}

// in the order of the file, so that the first mistake is reported first
std::vector<const Member*> by_line(const Node& table) {
  std::vector<const Member*> members;
  for (const Member& member : table.members)
    members.push_back(&member);
  std::stable_sort(members.begin(), members.end(),
                   [](const Member* a, const Member* b) { return a->value.place.line < b->value.place.line; });
  return members;
}

void Checker::table(const Node& node, const Groups& groups, const std::string& path) const {
  if (node.kind != Node::Kind::table)
    refuse(node, path,
           "must be a table; write [" + path + "] on a line of its own, or " + path +
               " = { … }; allowed in it: " + listed(keys_of(groups)));
  for (const Member* member : by_line(node)) {
    const std::string here = key_path(path, member->key);
    const KeyRow* row = find_row(groups, member->key);
    if (!row) refuse_unknown(member->value, groups, here, member->key);
    if (!key_applies(node, groups, *row)) refuse_inapplicable(node, groups, *row, member->value, here);
    value(*row, member->value, here);
  }
  for (const KeyRow& row : key_rows()) {
    const bool belongs = std::find(groups.begin(), groups.end(), row.table) != groups.end();
    if (!row.required || !belongs || node.find(row.key) || find_row(groups, row.key) != &row) continue;
    if (key_applies(node, groups, row))
      refuse(
          {&node, path}, row.key,
          std::string(row.meaning) + "; write for example " + std::string(row.key) + " = " + std::string(row.example));
  }
}

void Checker::tables(const KeyRow& row, const Node& node, const std::string& path) const {
  const bool of_tables =
      node.kind == Node::Kind::list && std::all_of(node.items.begin(), node.items.end(),
                                                   [](const Node& item) { return item.kind == Node::Kind::table; });
  if (!of_tables)
    refuse(node, path, "must be a list of tables; write [[" + path + "]] with two brackets on a line of its own");
  if (row.key == "planes" && node.items.size() > most_corners)
    refuse(node, path, "must have at most " + std::to_string(most_corners) + " planes; " + fewer(row));
  if (row.key == "joints" && node.items.size() > most_stated_joints)
    refuse(node, path, "must have at most " + std::to_string(most_stated_joints) + " joints; divide the scene");
  std::set<std::string> names;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const Node& item = node.items[i];
    table(item, row.holds, item_path(path, item, i));
    const Node* name = text_of(item, "name");
    if (name && !names.insert(name->text).second)
      refuse(*name, item_path(path, item, i) + ".name", "must be unique in " + path + "; give this table another name");
  }
}

void Checker::number(const KeyRow& row, const Node& node, const std::string& path) const {
  const std::string unit = row.unit.empty() || row.unit == "1" ? "" : " in " + std::string(row.unit);
  const bool whole = row.type == KeyType::integer;
  const std::string what = whole ? "must be a whole number" : "must be a number";
  if (!node.is_number()) refuse(node, path, what + unit + ", without quotes" + example_of(row));
  if (!node.decimal) refuse(node, path, "must be written as a decimal number" + example_of(row));
  if (!std::isfinite(node.number)) refuse(node, path, "must be a finite number" + unit + example_of(row));
  if (whole && node.number != std::floor(node.number)) refuse(node, path, what + example_of(row));
  // powers of such a number underflow, and no quantity of a scene is so small
  constexpr double least_magnitude = 1e-100;
  if (node.number != 0 && std::abs(node.number) < least_magnitude)
    refuse(node, path, "is smaller than any quantity of a scene but not zero; write 0, or correct the exponent");
  if (!row.range.holds(node.number)) refuse(node, path, "must " + range_text(row) + repair_of(row));
}

void Checker::numbers(const KeyRow& row, const Node& node, const std::string& path, std::size_t count) const {
  if (node.kind == Node::Kind::list && count > 1 && node.items.size() > count)
    refuse(node, path, vector_rule(row, count) + "; decimals are written with a point, 9.81, not 9,81");
  if (node.kind != Node::Kind::list || node.items.size() != count) refuse(node, path, vector_rule(row, count));
  for (const Node& item : node.items) {
    if (!item.is_number()) refuse(item, path, vector_rule(row, count));
    number(row, item, path);
  }
}

void Checker::points(const KeyRow& row, const Node& node, const std::string& path) const {
  if (node.kind != Node::Kind::list) refuse(node, path, "must be a list of points" + example_of(row));
  if (node.items.size() > most_corners)
    refuse(node, path, "must have at most " + std::to_string(most_corners) + " points; " + fewer(row));
  for (std::size_t i = 0; i < node.items.size(); ++i)
    numbers(row, node.items[i], path + "." + std::to_string(i + 1), dimension);
}

void Checker::list(const KeyRow& row, const Node& node, const std::string& path) const {
  if (node.kind != Node::Kind::list || node.items.empty())
    refuse(node, path, "must be a list of numbers" + example_of(row));
  for (std::size_t i = 0; i < node.items.size(); ++i)
    number(row, node.items[i], path + "." + std::to_string(i + 1));
}

void Checker::words(const KeyRow& row, const Node& node, const std::string& path,
                    const std::vector<std::string_view>& allowed) const {
  const std::string what =
      allowed.empty() ? "a name or a list of names" : "one or several (as a list) of " + quoted_list(allowed);
  const bool one = node.kind == Node::Kind::text;
  if (!one && (node.kind != Node::Kind::list || node.items.empty()))
    refuse(node, path, "must be " + what + example_of(row));
  std::set<std::string> seen;
  for (const Node& item : one ? std::vector<Node>{node} : node.items) {
    const bool known = item.kind == Node::Kind::text &&
                       (allowed.empty() || std::find(allowed.begin(), allowed.end(), item.text) != allowed.end());
    if (!known) {
      const std::string near = nearest(item.text, {allowed.begin(), allowed.end()});
      refuse(item, path, "must be " + what + (near.empty() ? example_of(row) : "; did you mean \"" + near + "\"?"));
    }
    if (!seen.insert(item.text).second) refuse(item, path, "appears twice in the list; remove one");
  }
}

void Checker::axes(const KeyRow& row, const Node& node, const std::string& path) const {
  if (node.kind == Node::Kind::boolean) return;
  if (dimension == 2 && row.key == "rotation")
    refuse(node, path, "must be true or false because a 2-D block has one rotation; write rotation = true");
  if (node.kind != Node::Kind::list && node.kind != Node::Kind::text)
    refuse(node, path, "must be true or a list of axes" + example_of(row));
  words(row, node, path,
        dimension == 2 ? std::vector<std::string_view>{"x", "y"} : std::vector<std::string_view>{"x", "y", "z"});
}

void check_text(const KeyRow& row, const Node& node, const std::string& path) {
  if (node.kind != Node::Kind::text) refuse(node, path, "must be a text in double quotes" + example_of(row));
  if (row.type == KeyType::choice) {
    if (std::find(row.choices.begin(), row.choices.end(), node.text) != row.choices.end()) return;
    const std::string near = nearest(node.text, {row.choices.begin(), row.choices.end()});
    refuse(node, path,
           "must be one of " + quoted_list(row.choices) +
               (near.empty() ? example_of(row) : "; did you mean \"" + near + "\"?"));
  }
  constexpr std::size_t longest_text = 1000;  // bytes; a name or a title is one line
  if (node.text.size() > longest_text) refuse(node, path, "must be at most 1000 characters long; shorten it");
  if (row.type != KeyType::name) return;
  if (node.text.empty()) refuse(node, path, "must not be empty" + example_of(row));
  if (node.text.find_first_of(".=") != std::string::npos)
    refuse(node, path, "must not contain '.' or '=', so that --set can address it; write '-' or a space instead");
}

void Checker::value(const KeyRow& row, const Node& node, const std::string& path) const {
  switch (row.type) {
    case KeyType::boolean:
      if (node.kind != Node::Kind::boolean)
        refuse(node, path, "must be true or false, without quotes" + example_of(row));
      return;
    case KeyType::integer:
    case KeyType::number:
      return number(row, node, path);
    case KeyType::text:
    case KeyType::name:
    case KeyType::choice:
      return check_text(row, node, path);
    case KeyType::vector:
      return numbers(row, node, path, dimension);
    case KeyType::spin:
      if (dimension == 3) return numbers(row, node, path, 3);
      if (!node.is_number()) refuse(node, path, vector_rule(row, 1));
      return number(row, node, path);
    case KeyType::axes:
      return axes(row, node, path);
    case KeyType::names:
      return words(row, node, path, {});
    case KeyType::choices:
      return words(row, node, path, row.choices);
    case KeyType::points:
      return points(row, node, path);
    case KeyType::numbers:
      return list(row, node, path);
    case KeyType::surface:
      return dimension == 2 ? points(row, node, path) : table(node, row.holds, path);
    case KeyType::table:
      return table(node, row.holds, path);
    case KeyType::tables:
      return tables(row, node, path);
  }
}

// after a number; a ratio needs none
std::string unit_of(const KeyRow& row) {
  return row.unit.empty() || row.unit == "1" ? "" : " " + std::string(row.unit);
}

std::string plain(double number) {
  Node node;
  node.kind = Node::Kind::number;
  node.number = number;
  return value_text(node);
}

}  // namespace

const KeyRow* find_row(const Groups& groups, std::string_view key) {
  for (const std::string_view group : groups)
    for (const KeyRow& row : key_rows(group))
      if (row.key == key) return &row;
  return nullptr;
}

std::vector<std::string> keys_of(const Groups& groups) {
  std::vector<std::string> keys;
  for (const std::string_view group : groups)
    for (const KeyRow& row : key_rows(group))
      keys.emplace_back(row.key);
  return keys;
}

bool Range::holds(double x) const {
  if (or_zero && x == 0) return true;
  return (above_low ? x > low : x >= low) && (below_high ? x < high : x <= high);
}

std::string range_text(const KeyRow& row) {
  const Range& r = row.range;
  const std::string unit = unit_of(row);
  if (!r.above_low && !r.below_high) return "lie between " + plain(r.low) + " and " + plain(r.high) + unit;
  return (r.above_low ? "be greater than " : "be at least ") + plain(r.low) +
         (r.below_high ? " and less than " : " and at most ") + plain(r.high) + unit;
}

std::string plausible_text(const KeyRow& row) {
  const Range& r = row.plausible;
  const bool lowest = std::isinf(r.low), highest = std::isinf(r.high);
  if (lowest && highest) return "";
  const std::string zero = r.or_zero ? "0 or " : "";
  if (lowest) return zero + "at most " + plain(r.high) + unit_of(row);
  if (highest) return zero + (r.above_low ? "more than " : "at least ") + plain(r.low) + unit_of(row);
  return zero + (r.above_low ? "more than " : "") + plain(r.low) + " to " + plain(r.high) + unit_of(row);
}

int scene_dimension(const Node& scene) {
  const KeyRow& row = *find_row({""}, "dimension");
  const Node* stated = scene.find(row.key);
  if (!stated) refuse({&scene, ""}, row.key, std::string(row.meaning) + "; " + std::string(row.repair));
  Checker{3}.value(row, *stated, std::string(row.key));
  return static_cast<int>(stated->number);
}

std::string_view former_key(std::string_view path) {
  for (const auto& [former, why] : former_keys)
    if (path == former) return why;
  return {};
}

void check_keys(const Node& scene) {
  require_plain_text(scene, "");
  Checker{scene_dimension(scene)}.table(scene, {""}, "");
}

}  // namespace voussoir
