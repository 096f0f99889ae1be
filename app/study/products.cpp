#include "app/study/products.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "app/study/keys.hpp"
#include "core/joint_sets/portable_math.hpp"
#include "core/joint_sets/random_stream.hpp"

namespace voussoir {
namespace {

constexpr const char* rule_of_key = "must be a key of the scene as after --set, e.g. \"time.fraction\"";

constexpr double most_rows = 100'000;

// the range of the seed of a joint set
constexpr double seeds = 1e15;

// of draws until a value is between the two ends; a distribution that needs more hardly ever gives such a value
constexpr int most_draws = 10'000;

std::optional<Fails> read_fails(const Subject& table) {
  const Node* node = table.node->find("fails");
  if (!node) return std::nullopt;
  const std::string rule = "must be a table { below = … } or { above = … }";
  if (node->kind != Node::Kind::table) refuse(table, "fails", rule);
  const Subject fails{node, key_path(table.path, "fails")};
  refuse_unknown_keys(fails, "fails");
  const std::optional<double> below = number_of(fails, "below"), above = number_of(fails, "above");
  if (below.has_value() == above.has_value()) refuse(table, "fails", rule);
  return Fails{below.has_value(), below ? *below : *above};
}

std::vector<Subject> keys_of(const Subject& table, const char* kind) {
  const std::vector<Subject> keys = tables_of(table, "keys");
  if (keys.empty()) refuse(table, "keys", "must be a list of tables, each with a key of the scene");
  for (const Subject& key : keys)
    refuse_unknown_keys(key, kind);
  return keys;
}

TiedKey named_key(const Subject& table) {
  TiedKey key{text_of(table, "key", rule_of_key), {}, ""};
  if (table.node->find("unit")) key.unit = text_of(table, "unit", "must be a text, e.g. \"deg\"");
  return key;
}

enum class Law { normal, lognormal, uniform, triangular, seed };

struct SampledKey {
  Law law = Law::normal;
  double mean = 0, deviation = 0, mode = 0;
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
};

SampledKey read_law(const Subject& table) {
  static constexpr std::pair<std::string_view, Law> laws[] = {{"normal", Law::normal},
                                                              {"lognormal", Law::lognormal},
                                                              {"uniform", Law::uniform},
                                                              {"triangular", Law::triangular},
                                                              {"seed", Law::seed}};
  const std::string rule = "must be one of \"normal\", \"lognormal\", \"uniform\", \"triangular\", \"seed\"";
  const std::string& word = text_of(table, "law", rule);
  SampledKey key;
  bool known = false;
  for (const auto& [name, law] : laws)
    if (name == word) {
      key.law = law;
      known = true;
    }
  if (!known) refuse(table, "law", rule);

  const auto required = [&](const char* name) {
    const std::optional<double> number = number_of(table, name);
    if (!number) refuse(table, name, fmt::format("must be a number if law = \"{}\"", word));
    return *number;
  };
  const auto refuse_others = [&](std::initializer_list<const char*> others) {
    for (const char* name : others)
      if (table.node->find(name)) refuse(table, name, fmt::format("is no number of law = \"{}\"", word));
  };
  const bool has_ends = key.law == Law::uniform || key.law == Law::triangular;
  if (key.law == Law::seed) {
    refuse_others({"mean", "deviation", "mode", "least", "most"});
    return key;
  }
  if (has_ends) {
    refuse_others({"mean", "deviation"});
    key.least = required("least");
    key.most = required("most");
  } else {
    key.mean = required("mean");
    key.deviation = required("deviation");
    key.least = number_of(table, "least").value_or(key.least);
    key.most = number_of(table, "most").value_or(key.most);
    if (key.deviation < 0) refuse(table, "deviation", "must not be below 0");
  }
  if (!(key.most > key.least)) refuse(table, "most", "must be above least");
  if (key.law == Law::triangular)
    key.mode = required("mode");
  else
    refuse_others({"mode"});
  if (key.law == Law::triangular && (key.mode < key.least || key.mode > key.most))
    refuse(table, "mode", "must be between least and most");
  if (key.law == Law::lognormal && !(key.mean > 0 && key.deviation <= 100 * key.mean))
    refuse(table, "mean", "must be above 0, and at least a hundredth of the deviation, if law = \"lognormal\"");
  return key;
}

double draw(const SampledKey& key, RandomStream& stream) {
  switch (key.law) {
    case Law::normal:
      return key.mean + key.deviation * stream.normal();
    case Law::lognormal: {
      const double ratio = key.deviation / key.mean, variance = portable::log(1 + ratio * ratio);
      return portable::exp(portable::log(key.mean) - variance / 2 + std::sqrt(variance) * stream.normal());
    }
    case Law::uniform:
      return key.least + (key.most - key.least) * stream.uniform();
    case Law::triangular: {
      const double u = stream.uniform(), width = key.most - key.least, left = key.mode - key.least;
      if (u * width < left) return key.least + std::sqrt(u * width * left);
      return key.most - std::sqrt((1 - u) * width * (key.most - key.mode));
    }
    case Law::seed:
      return std::floor(seeds * stream.uniform());
  }
  return 0;
}

double draw_between_ends(const SampledKey& key, RandomStream& stream, const Subject& table) {
  for (int k = 0; k < most_draws; ++k)
    if (const double value = draw(key, stream); value >= key.least && value <= key.most) return value;
  refuse(table, "law", "hardly ever gives a value from least to most; set them farther apart");
}

// a whole number under `key`, or nothing
std::optional<double> whole_number_of(const Subject& table, const char* key, double least, double most) {
  const Node* node = table.node->find(key);
  if (!node) return std::nullopt;
  if (node->kind != Node::Kind::integer || node->number < least || node->number > most)
    refuse(table, key, fmt::format("must be a whole number, {:.0f} to {:.0f}", least, most));
  return node->number;
}

}  // namespace

Sweep read_grid(const Subject& table) {
  refuse_unknown_keys(table, "grid");
  const std::vector<Subject> keys = keys_of(table, "grid.keys");
  if (keys.size() < 2 || keys.size() > 3) refuse(table, "keys", "must be two or three; one key alone is a [[sweep]]");
  Sweep grid;
  grid.varied = Varied::grid;
  std::vector<std::vector<std::string>> values;
  std::size_t count = 1;
  for (const Subject& key : keys) {
    grid.with.push_back(named_key(key));
    values.push_back(read_values(key));
    if (values.back().size() < 2) refuse(key, "values", "must be at least two");
    grid.counts.push_back(values.back().size());
    count *= values.back().size();
    grid.key += (grid.key.empty() ? "" : ", ") + grid.with.back().key;
  }
  if (static_cast<double>(count) > most_rows)
    refuse(table, "keys", fmt::format("make {} combinations; at most {:.0f} are taken", count, most_rows));
  for (std::size_t place = 0; place < count; ++place) {
    std::string label;
    for (std::size_t k = 0, left = count, at = place; k < keys.size(); ++k) {
      left /= grid.counts[k];
      const std::string& value = values[k][at / left];
      at %= left;
      grid.with[k].values.push_back(value);
      label += (label.empty() ? "" : ", ") + shown_value(value);
    }
    grid.values.push_back(label);
  }
  grid.numbers.resize(count);
  grid.fails = read_fails(table);
  return grid;
}

Sweep read_sample(const Subject& table) {
  refuse_unknown_keys(table, "sample");
  Sweep sample;
  sample.varied = Varied::sample;
  sample.key = "row of the sample";
  const std::optional<double> count = whole_number_of(table, "rows", 2, most_rows);
  if (!count) refuse(table, "rows", "must be the number of runs, e.g. rows = 200");
  const auto seed = static_cast<std::uint64_t>(whole_number_of(table, "seed", 0, seeds).value_or(0));
  for (int row = 1; row <= static_cast<int>(*count); ++row)
    sample.values.push_back(std::to_string(row));
  sample.numbers.resize(sample.values.size());
  for (const Subject& key : keys_of(table, "sample.keys")) {
    sample.with.push_back(named_key(key));
    TiedKey& drawn = sample.with.back();
    const SampledKey law = read_law(key);
    for (const std::string& row : sample.values) {
      RandomStream stream(seed, fmt::format("row {} of {}", row, drawn.key));
      drawn.values.push_back(fmt::format("{}", draw_between_ends(law, stream, key)));
    }
  }
  for (std::size_t k = 0; k < sample.with.size(); ++k)
    for (std::size_t j = 0; j < k; ++j)
      if (sample.with[j].key == sample.with[k].key) refuse(table, "keys", "must be different keys");
  sample.fails = read_fails(table);
  return sample;
}

}  // namespace voussoir
