// The key table as a page for users.
#include <algorithm>

#include "core/base/preset.hpp"
#include "core/scene/keys.hpp"
#include "core/scene/renamed_keys.hpp"
#include "core/scene/scene.hpp"

namespace voussoir {
namespace {

constexpr const char* introduction = R"(# Scene files

A scene is one TOML file with blocks, joints, stages and monitors. It states only the keys that it needs. Lengths are in
m, all units are SI, angles are in degrees. x points east, y north, z up; in 2-D x to the right, y up.

```toml
title = "Block on an incline"
dimension = 3
gravity = [0, 0, -9.81]
density = 2600

[domain]                      # a box, cut by the joints below
box = { min = [-2, -2, -2], max = [2, 2, 2] }

[[joints]]
name = "A"
dip = 30
dip_direction = 90
point = [0, 0, 0]

[[joint_properties]]
name = "rock"
normal_stiffness = 1e9        # Pa/m
shear_stiffness = 1e8
friction_deg = 40

[[fix]]
below = ["A"]

[[stage]]
name = "settle"
kind = "settle"

[[monitors]]
name = "slider"
above = ["A"]
quantities = ["displacement"]
```

Every key can be changed on the command line: `--set joints.A.dip=35`, `--set gravity=[0,0,-1.62]`. Tables of a list are
addressed by their name, or by their number from 1 if they have none (`--set fix.1.below=["B"]`). The value is written
as in the file; a word needs no quotes. Tables that [[repeat]] copies are addressed by their names, a copy by its own
(`--set blocks.stone-3.density=2500`). A key that the file does not state can be set as well. A name may therefore
contain any characters except '.' and '=', and is unique in its list. Every text is one line of UTF-8 without control
characters.

A value outside the allowed range of its key is refused. One outside its usual range is reported as a warning before the
run: usually its unit is wrong.

Blocks are chosen by selectors: by name, by the side of joints, by a point inside, by a side of the model or by a box,
never by number. A block is chosen if it satisfies every condition of the table.
)";

std::string type_text(const KeyRow& row) {
  switch (row.type) {
    case KeyType::boolean:
      return "true or false";
    case KeyType::integer:
      return "whole number";
    case KeyType::number:
      return "number";
    case KeyType::text:
      return "text";
    case KeyType::name:
      return "name";
    case KeyType::vector:
      return "2 or 3 numbers";
    case KeyType::spin:
      return "3 numbers; 2-D one";
    case KeyType::axes:
      return "true or a list of axes";
    case KeyType::names:
      return "name or list of names";
    case KeyType::points:
      return "list of points";
    case KeyType::numbers:
      return "list of numbers";
    case KeyType::surface:
      return "list of points; 3-D a table";
    case KeyType::table:
      return "table";
    case KeyType::tables:
      return "list of tables";
    case KeyType::choice:
    case KeyType::choices:
      break;
  }
  std::string text = row.type == KeyType::choice ? "one of" : "list of";
  for (const std::string_view choice : row.choices)
    text += " `\"" + std::string(choice) + "\"`";
  return text;
}

// ranges that only exclude absurd numbers would be noise
std::string allowed_text(const KeyRow& row) {
  const std::string plausible = plausible_text(row).empty() ? "" : "; usually " + plausible_text(row);
  const bool numeric = row.type == KeyType::number || row.type == KeyType::integer;
  if (!numeric) return type_text(row) + plausible;
  std::string range = range_text(row);
  for (const std::string_view verb : {"lie ", "be "})
    if (range.starts_with(verb)) range.erase(0, verb.size());
  return type_text(row) + ", " + range + plausible;
}

std::string_view scope_text(PresetScope scope) {
  switch (scope) {
    case PresetScope::everywhere:
      return "";
    case PresetScope::integrable_faces:
      return " if a joint can be integrated";
    case PresetScope::faces_by_points:
      return " for joints that cannot be integrated";
    case PresetScope::bonded_joints:
      return " for joints with tension or cohesion, but for interfaces of linings";
    case PresetScope::watched_searches:
      return " for bisections that state no displacement or fraction";
    case PresetScope::scenes_with_these:
      return " with such a bisection";
    case PresetScope::searches_by_steps:
      return " for other searches";
    case PresetScope::motions:
      return " for searches at a rate";
  }
  return "";
}

// what preset = "standard" sets, and the key's own default, which "thesis" leaves
std::string default_text(const KeyRow& row) {
  std::string own = row.required ? "required" : "";
  if (!row.default_value.empty()) own = "`" + std::string(row.default_value) + "`";
  for (const PresetSetting& setting : standard_settings) {
    if (setting.table != row.table || setting.key != row.key) continue;
    const auto* text = std::get_if<std::string_view>(&setting.value);
    const std::string value = text ? std::string(*text) : std::to_string(std::get<int>(setting.value));
    own = "`" + value + "`" + std::string(scope_text(setting.scope)) +
          (own.empty() ? "" : "; " + own + " otherwise, and with preset = \"thesis\"");
  }
  return own;
}

std::string when_text(const KeyRow& row) {
  std::string text;
  for (const Condition& condition : {row.when, row.and_when}) {
    if (condition.key.empty()) continue;
    std::string values = std::string(condition.value);
    if (const std::size_t bar = values.find('|'); bar != std::string::npos) values.replace(bar, 1, " or ");
    text += "(" + std::string(condition.key) + " " + values + ") ";
  }
  return text;
}

// a bar would end the cell
std::string within_a_table(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string row_text(const KeyRow& row) {
  std::string meaning = when_text(row) + std::string(row.meaning);
  if (!row.breaks.empty()) meaning += ". *" + std::string(row.breaks) + "*";
  if (!row.example.empty()) meaning += ". Example: `" + std::string(row.example) + "`";
  return "| `" + std::string(row.key) + "` | " + allowed_text(row) + " | " + std::string(row.unit) + " | " +
         default_text(row) + " | " + within_a_table(meaning) + " |\n";
}

// the tables that contain the keys of a group: [domain], [[stage.fix]]
std::string places_text(std::string_view group) {
  if (group.empty()) return "The top of the file";
  std::string places;
  for (const KeyRow& row : key_rows()) {
    if (std::find(row.holds.begin(), row.holds.end(), group) == row.holds.end()) continue;
    const std::string path = key_path(std::string(row.table), row.key);
    places += (places.empty() ? "" : ", ") + (row.type == KeyType::tables ? "`[[" + path + "]]`" : "`[" + path + "]`");
  }
  if (group == "selector") return "Selectors: in " + places;
  return places;
}

}  // namespace

std::string scene_documentation() {
  std::string text = introduction;
  std::string_view group = "none yet";
  for (const KeyRow& row : key_rows()) {
    if (row.table != group) {
      group = row.table;
      text += "\n## " + places_text(group) + "\n\n| key | value | unit | default | meaning |\n|---|---|---|---|---|\n";
    }
    text += row_text(row);
  }
  text +=
      "\n## Earlier names\n\nA key may be written by its earlier name; `voussoir check` names the present one.\n\n"
      "| earlier | present |\n|---|---|\n";
  for (const RenamedKey& row : renamed_keys)
    text += "| `" + std::string(row.earlier) + "` | `" + std::string(row.present) + "` |\n";
  return text;
}

}  // namespace voussoir
