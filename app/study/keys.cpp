#include "app/study/keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace voussoir {
namespace {

// every key of a study; "" is the top of the file
struct StudyKey {
  std::string_view table, key, value, meaning;
};

constexpr StudyKey study_keys[] = {
    {"", "scene", "text, required", "the scene's file, relative to the study"},
    {"", "quantity", "text, required",
     "a value of results.json, e.g. `\"critical_friction\"`; with `history` the name of the quantity taken"},
    {"", "history", "table", "takes the quantity from a column of history.csv instead"},
    {"", "set", "list of texts", "`\"key=value\"` as after --set, for every run"},
    {"", "limit", "table",
     "runs by `voussoir limit` instead of `voussoir run`; `{}` for the critical friction under gravity"},
    {"", "blocks", "table",
     "runs by `voussoir blocks`, in space or in the plane: `quantity` is `least_factor`, `volume_below_1`, "
     "`blocks_below_1` or `least_critical_coefficient`"},
    {"", "begin", "text",
     "a stage of the scene: runs that are the same up to its end begin with the last state of one shared run, which "
     "the study "
     "makes first"},
    {"", "sweep", "list of tables", "one setting that is changed, `[[sweep]]`; any number"},
    {"", "grid", "list of tables",
     "all combinations of the values of two or three keys, `[[grid]]`: a table and a map"},
    {"", "sample", "list of tables",
     "runs whose keys are drawn at random, `[[sample]]`: mean, deviation, histogram and fraction failed"},
    {"", "reliability", "list of tables",
     "reliability analyses, `[[reliability]]`: design points by FORM, and small probabilities by importance sampling, "
     "from "
     "some hundred answers"},
    {"history", "column", "text, required", "a column of history.csv, by its full name"},
    {"history", "take", "one of `\"largest\"` `\"smallest\"` `\"last\"`, required", "which of its numbers"},
    {"history", "unit", "text, required", "of that number, e.g. `\"N\"`"},
    {"sweep", "name", "text, required", "in the table and the figure"},
    {"sweep", "key", "text, required", "key of the scene as after --set, e.g. `\"time.fraction\"`"},
    {"sweep", "values", "list, required", "the values of the key, one run each"},
    {"sweep", "with", "list of tables", "further keys that change together with `key`, value by value"},
    {"sweep", "unit", "text", "of the values, e.g. `\"deg\"`"},
    {"sweep", "scene", "text", "another scene for this sweep"},
    {"sweep", "set", "list of texts", "`\"key=value\"` for every run of this sweep, after the study's own"},
    {"sweep", "extrapolate", "table",
     "adds the result that each two neighbouring runs give at a value of 0, if the error is proportional to a power of "
     "the value"},
    {"sweep", "limit", "table", "runs of this sweep by `voussoir limit`, instead of the study's own `limit`"},
    {"sweep", "blocks", "table", "likewise by `voussoir blocks`"},
    {"with", "key", "text, required", "key of the scene as after --set"},
    {"with", "values", "list, required", "its values, one for each of the sweep's values"},
    {"grid", "name", "text, required", "in the table and the figure"},
    {"grid", "keys", "list of tables, required", "two or three, each a key with its values; the last changes fastest"},
    {"grid", "fails", "table",
     "the results that count as failed; the map marks them, and with a ring those whose error bar contains the limit"},
    {"grid", "scene", "text", "another scene for this grid"},
    {"grid", "set", "list of texts", "`\"key=value\"` for every run of this grid, after the study's own"},
    {"grid", "limit", "table", "as of a sweep"},
    {"grid", "blocks", "table", "as of a sweep"},
    {"grid.keys", "key", "text, required", "key of the scene as after --set"},
    {"grid.keys", "values", "list, required", "its values, at least two"},
    {"grid.keys", "unit", "text", "of the values"},
    {"sample", "name", "text, required", "in the table and the figure"},
    {"sample", "rows", "number, required",
     "number of runs, 2 to 100,000, with `blocks` to 5,000,000; the first of them are those of a smaller sample, but "
     "for "
     "a Latin hypercube"},
    {"sample", "method", "one of `\"random\"` `\"latin\"`",
     "latin: a Latin hypercube, in which each key has one value in each of as many classes of equal probability as "
     "there "
     "are rows: closer means and deviations, hardly closer shares (default: random)"},
    {"sample", "correlation", "list of lists",
     "`[[\"key\", \"key\", number]]`: Pearson's correlation of two keys' values (Nataf's model); other keys are "
     "independent"},
    {"sample", "seed", "number",
     "another seed gives another sample; a value depends on seed, row and key only, so that samples of one seed can be "
     "compared row by row (default: 0)"},
    {"sample", "keys", "list of tables, required", "each a key with the distribution of its values"},
    {"sample", "fails", "table",
     "the results that count as failed; reported: their fraction with its 95 % confidence interval, and the number of "
     "results whose error bar contains the limit, which are neither failed nor stable"},
    {"sample", "scene", "text", "another scene for this sample"},
    {"sample", "set", "list of texts", "`\"key=value\"` for every run of this sample, after the study's own"},
    {"sample", "limit", "table", "as of a sweep"},
    {"sample", "blocks", "table", "as of a sweep"},
    {"sample.keys", "key", "text, required", "key of the scene as after --set"},
    {"sample.keys", "law",
     "one of `\"normal\"` `\"lognormal\"` `\"uniform\"` `\"triangular\"` `\"exponential\"` `\"fisher\"` `\"seed\"`, "
     "required",
     "fisher: of a joint's pole, `key` the joint, e.g. `\"joints.A\"`; seed: a whole number for the `seed` of a joint "
     "set"},
    {"sample.keys", "mean", "number",
     "of a normal, lognormal or exponential distribution before it is cut: of the value itself, not of its logarithm"},
    {"sample.keys", "deviation", "number",
     "of a normal or lognormal distribution: standard deviation of the value itself"},
    {"sample.keys", "mode", "number", "of a triangular distribution: the most likely value"},
    {"sample.keys", "least", "number",
     "of a uniform or triangular distribution its lower end; for the others values below it are drawn again"},
    {"sample.keys", "most", "number", "likewise the upper end"},
    {"sample.keys", "dip", "number", "of a Fisher distribution: dip of the mean plane, deg"},
    {"sample.keys", "dip_direction", "number", "likewise its dip direction, deg"},
    {"sample.keys", "concentration", "number",
     "Fisher's constant K; 0.63 of the poles lie within 81 deg/√K of the mean"},
    {"sample.keys", "per", "one of `\"property\"` `\"set\"` `\"joint\"`",
     "which joints share a draw of a friction angle or cohesion, with `blocks` (default: property, all of them)"},
    {"sample.keys", "unit", "text", "of the value"},
    {"reliability", "name", "text, required", "in the results"},
    {"reliability", "keys", "list of tables, required",
     "each a key with the distribution of its values, as of a sample, but for the laws and `per` that have no order"},
    {"reliability", "correlation", "list of lists", "as of a sample"},
    {"reliability", "fails", "table, required", "the results that count as failed"},
    {"reliability", "method", "one of `\"importance\"` `\"form\"`",
     "form: the design point and its first-order probability alone, not checked (default: importance)"},
    {"reliability", "target", "number",
     "standard error over probability at which importance sampling ends, 0.001 to 1 (default: 0.1)"},
    {"reliability", "most_rows", "number", "of importance sampling (default: 20,000)"},
    {"reliability", "seed", "number", "as of a sample"},
    {"reliability", "scene", "text", "another scene for this analysis"},
    {"reliability", "set", "list of texts", "`\"key=value\"` for every answer, after the study's own"},
    {"reliability", "limit", "table", "as of a sweep"},
    {"reliability", "blocks", "table", "as of a sweep: answers in microseconds, without files"},
    {"fails", "below", "number", "results below it count as failed, e.g. 1 for a factor of safety"},
    {"fails", "above", "number", "results above it count as failed; state this or below"},
    {"extrapolate", "power", "number, required", "the power, above 0, at most 10; 0.6666667 for a rate of reduction"},
    {"limit", "load",
     "one of `\"gravity\"` `\"applied\"` `\"left\"` `\"right\"` `\"east\"` `\"west\"` `\"north\"` `\"south\"` `\"up\"` "
     "`\"down\"`, or a direction such as `\"1,0,-0.5\"`",
     "as after `voussoir limit --load`"},
    {"limit", "friction", "list of texts", "names as after `--friction`"},
    {"limit", "factor", "true or false", "`--factor`"},
    {"limit", "joint", "list of texts", "names as after `--joint`"},
    {"limit", "cohesion", "true or false", "`--cohesion`"},
    {"limit", "with_dilation", "true or false",
     "`--with-dilation`: the bound alone. Without it the quantities are `…_least` and `…_largest`, and the plain name "
     "where "
     "they agree to 1 %"},
    {"limit", "decide", "true or false", "`--decide`: the plain name holds what runs on elastic joints find"},
    {"blocks", "strength_of", "text", "as after `voussoir blocks --strength-of`"},
    {"blocks", "after", "text", "`--after`"},
    {"blocks", "seismic", "text", "`--seismic`"},
};

// as --set takes it; a text in quotes, so that it is never read as a number
std::string override_text(const Node& value, const std::string& path) {
  switch (value.kind) {
    case Node::Kind::boolean:
      return value.boolean ? "true" : "false";
    case Node::Kind::integer:
      return fmt::format("{:.0f}", value.number);
    case Node::Kind::number:
      if (!std::isfinite(value.number)) refuse(value, path, "must be a finite number");
      return fmt::format("{}", value.number);
    case Node::Kind::text:
      if (value.text.find_first_of("\"\\\n") != std::string::npos)
        refuse(value, path, "must not contain quotes, backslashes or line breaks");
      return '"' + value.text + '"';
    default:
      refuse(value, path, "must be a number, a text, true or false");
  }
}

}  // namespace

void refuse_unknown_keys(const Subject& table, std::string_view kind) {
  std::vector<std::string> known;
  for (const StudyKey& row : study_keys)
    if (row.table == kind) known.emplace_back(row.key);
  for (const Member& member : table.node->members)
    if (std::find(known.begin(), known.end(), member.key) == known.end())
      refuse(member.value, key_path(table.path, member.key), "no such key; " + suggestion(member.key, known));
}

const std::string& text_of(const Subject& table, const char* key, const std::string& rule) {
  const Node* node = table.node->find(key);
  if (!node || node->kind != Node::Kind::text || node->text.empty()) refuse(table, key, rule);
  return node->text;
}

std::vector<std::string> texts_of(const Subject& table, const char* key, const std::string& rule) {
  std::vector<std::string> texts;
  const Node* list = table.node->find(key);
  if (!list) return texts;
  if (list->kind != Node::Kind::list) refuse(table, key, rule);
  for (const Node& item : list->items) {
    if (item.kind != Node::Kind::text) refuse(item, key_path(table.path, key), rule);
    texts.push_back(item.text);
  }
  return texts;
}

std::vector<std::string> read_overrides(const Subject& table) {
  return texts_of(table, "set", "must be a list of texts \"key=value\"");
}

std::vector<std::string> read_values(const Subject& table) {
  const Node* list = table.node->find("values");
  if (!list || list->kind != Node::Kind::list || list->items.empty())
    refuse(table, "values", "must be a list of at least one value, e.g. values = [1.0, 0.1, 0.01]");
  std::vector<std::string> values;
  for (std::size_t k = 0; k < list->items.size(); ++k)
    values.push_back(override_text(list->items[k], fmt::format("{}.{}", key_path(table.path, "values"), k + 1)));
  return values;
}

std::vector<Subject> tables_of(const Subject& table, const char* key) {
  const Node* list = table.node->find(key);
  if (!list) return {};
  const std::string rule = fmt::format("must be a list of tables, e.g. {} = [{{ key = …, values = … }}]", key);
  if (list->kind != Node::Kind::list || list->items.empty()) refuse(table, key, rule);
  for (const Node& item : list->items)
    if (item.kind != Node::Kind::table) refuse(item, key_path(table.path, key), rule);
  return children(table, key);
}

std::optional<double> number_of(const Subject& table, const char* key) {
  const Node* node = table.node->find(key);
  if (!node) return std::nullopt;
  if (!node->is_number() || !(std::abs(node->number) <= largest_study_number))
    refuse(table, key, "must be a number, at most 1e15");
  return node->number;
}

std::string study_documentation() {
  std::string text = R"(
# Studies

`voussoir study study.toml --out folder` runs a scene as it is and with one setting changed at a time, with
every combination of some, or with settings drawn at random. In parts, for many processes and machines: `voussoir study plan
study.toml --out folder`, then `voussoir study run folder` any number of times, with `--rows` or `--chunk`, `voussoir study
status folder`, and `voussoir study gather folder`.

```toml
scene = "scene.toml"
quantity = "critical_friction"

[[sweep]]
name = "time step"
key = "time.fraction"
values = [0.2, 0.1, 0.05]
```

| table | key | value | meaning |
|---|---|---|---|
)";
  for (const StudyKey& row : study_keys)
    text += fmt::format("| {} | `{}` | {} | {} |\n", row.table.empty() ? "the top of the file" : row.table, row.key,
                        row.value, row.meaning);
  return text;
}

}  // namespace voussoir
