#include "app/study/drawn_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "app/study/keys.hpp"
#include "core/base/bad_input.hpp"
#include "core/joint_sets/portable_math.hpp"
#include "core/probability/latin_hypercube.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

constexpr const char* rule_of_drawn_key = "must be a key of the scene as after --set, e.g. \"time.fraction\"";

// the range of the seed of a joint set
constexpr double seeds = 1e15;

constexpr std::pair<std::string_view, Law> laws[] = {{"normal", Law::normal},           {"lognormal", Law::lognormal},
                                                     {"uniform", Law::uniform},         {"triangular", Law::triangular},
                                                     {"exponential", Law::exponential}, {"seed", Law::seed}};

// ---- reading ------------------------------------------------------------------------------------------------------

double required(const Subject& table, const char* name, std::string_view law) {
  const std::optional<double> number = number_of(table, name);
  if (!number) refuse(table, name, fmt::format("must be a number if law = \"{}\"", law));
  return *number;
}

void refuse_others(const Subject& table, std::string_view law, std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (table.node->find(name)) refuse(table, name, fmt::format("is no number of law = \"{}\"", law));
}

PoleScatter read_pole(const Subject& table, const std::string& key) {
  refuse_others(table, "fisher", {"mean", "deviation", "mode", "least", "most"});
  const std::size_t dot = key.rfind('.');
  if (dot == std::string::npos || key.substr(0, dot) != "joints")
    refuse(table, "key",
           "must name a joint if law = \"fisher\", e.g. \"joints.A\": its dip and dip direction are drawn");
  const PoleScatter pole{required(table, "dip", "fisher"), required(table, "dip_direction", "fisher"),
                         required(table, "concentration", "fisher")};
  if (!(pole.dip >= 0 && pole.dip <= 90)) refuse(table, "dip", "must be from 0 to 90");
  if (!(pole.dip_direction >= 0 && pole.dip_direction <= 360)) refuse(table, "dip_direction", "must be from 0 to 360");
  if (!(pole.concentration > 0 && pole.concentration <= 1e8))
    refuse(table, "concentration", "must be above 0, at most 1e8");
  return pole;
}

void read_law(const Subject& table, const std::string& word, Distribution& key) {
  if (key.law == Law::seed) {
    refuse_others(table, word, {"mean", "deviation", "mode", "least", "most"});
    return;
  }
  if (key.law == Law::uniform || key.law == Law::triangular) {
    refuse_others(table, word, {"mean", "deviation"});
    key.least = required(table, "least", word);
    key.most = required(table, "most", word);
  } else {
    key.mean = required(table, "mean", word);
    if (key.law == Law::exponential)
      refuse_others(table, word, {"deviation"});
    else
      key.deviation = required(table, "deviation", word);
    key.least = number_of(table, "least").value_or(key.least);
    key.most = number_of(table, "most").value_or(key.most);
    if (key.deviation < 0) refuse(table, "deviation", "must not be below 0");
  }
  if (!(key.most > key.least)) refuse(table, "most", "must be above least");
  if (key.law == Law::triangular)
    key.mode = required(table, "mode", word);
  else
    refuse_others(table, word, {"mode"});
  if (key.law == Law::triangular && (key.mode < key.least || key.mode > key.most))
    refuse(table, "mode", "must be between least and most");
  if (key.law == Law::exponential && !(key.mean > 0)) refuse(table, "mean", "must be above 0 if law = \"exponential\"");
  if (key.law == Law::lognormal && !(key.mean > 0 && key.deviation <= 100 * key.mean))
    refuse(table, "mean", "must be above 0, and at least a hundredth of the deviation, if law = \"lognormal\"");
}

DrawnPer read_per(const Subject& table, const std::string& key) {
  if (!table.node->find("per")) return DrawnPer::property;
  const std::string rule = "must be one of \"property\", \"set\", \"joint\"";
  const std::string& word = text_of(table, "per", rule);
  if (word != "property" && word != "set" && word != "joint") refuse(table, "per", rule);
  if (!key.starts_with("joint_properties."))
    refuse(table, "per", "is for keys of joint_properties: it says which joints share a draw");
  return word == "joint" ? DrawnPer::joint : word == "set" ? DrawnPer::set : DrawnPer::property;
}

DrawnKey read_key(const Subject& table) {
  refuse_unknown_keys(table, "sample.keys");
  DrawnKey key;
  key.key = text_of(table, "key", rule_of_drawn_key);
  if (table.node->find("unit")) key.unit = text_of(table, "unit", "must be a text, e.g. \"deg\"");
  std::string rule = "must be one of \"fisher\"";
  for (const auto& law : laws)
    rule += fmt::format(", \"{}\"", law.first);
  const std::string& word = text_of(table, "law", rule);
  if (word == "fisher") {
    key.pole = read_pole(table, key.key);
  } else {
    refuse_others(table, word, {"dip", "dip_direction", "concentration"});
    const auto law = std::ranges::find(laws, word, &std::pair<std::string_view, Law>::first);
    if (law == std::end(laws)) refuse(table, "law", rule);
    key.law.law = law->second;
    read_law(table, word, key.law);
  }
  key.per = read_per(table, key.key);
  return key;
}

// ---- correlation --------------------------------------------------------------------------------------------------

std::optional<std::size_t> place_of(const DrawnKeys& drawn, const std::string& name) {
  for (std::size_t k = 0; k < drawn.keys.size(); ++k)
    if (drawn.keys[k].key == name) return k;
  return std::nullopt;
}

std::size_t component_of(const DrawnKeys& drawn, std::size_t key) {
  std::size_t component = 0;
  for (std::size_t k = 0; k < key; ++k)
    component += drawn.keys[k].components();
  return component;
}

std::size_t key_of_pair(const Subject& table, const DrawnKeys& drawn, const Node& item) {
  const std::string rule = "must be a list of [\"key\", \"key\", number], the keys among those drawn";
  if (item.kind != Node::Kind::text) refuse(table, "correlation", rule);
  const std::optional<std::size_t> place = place_of(drawn, item.text);
  if (!place) refuse(table, "correlation", fmt::format("names '{}', which is not drawn", item.text));
  const DrawnKey& key = drawn.keys[*place];
  if (key.pole || key.law.law == Law::seed)
    refuse(table, "correlation", fmt::format("names '{}', whose law has no order to correlate", item.text));
  if (key.per != DrawnPer::property)
    refuse(table, "correlation",
           fmt::format("names '{}', which is drawn for each {}; leave out one of the two", item.text,
                       key.per == DrawnPer::set ? "set" : "joint"));
  return *place;
}

void read_correlation(const Subject& table, DrawnKeys& drawn) {
  const Node* list = table.node->find("correlation");
  if (!list) return;
  const std::string rule = "must be a list of [\"key\", \"key\", number], the keys among those drawn";
  if (list->kind != Node::Kind::list || list->items.empty()) refuse(table, "correlation", rule);
  for (const Node& item : list->items) {
    if (item.kind != Node::Kind::list || item.items.size() != 3 || !item.items[2].is_number())
      refuse(table, "correlation", rule);
    const std::size_t a = key_of_pair(table, drawn, item.items[0]), b = key_of_pair(table, drawn, item.items[1]);
    const std::string names = fmt::format("'{}' and '{}'", drawn.keys[a].key, drawn.keys[b].key);
    const double stated = item.items[2].number;
    if (a == b) refuse(table, "correlation", fmt::format("is of {} with itself, which is 1", drawn.keys[a].key));
    if (!(std::abs(stated) <= 1)) refuse(table, "correlation", fmt::format("of {} must be from -1 to 1", names));
    const std::size_t first = component_of(drawn, std::min(a, b)), second = component_of(drawn, std::max(a, b));
    for (const CorrelatedPair& other : drawn.correlated)
      if (other.a == first && other.b == second)
        refuse(table, "correlation", fmt::format("of {} is stated twice", names));
    const Distribution &law_a = drawn.keys[a].law, &law_b = drawn.keys[b].law;
    if (law_a.deviation == 0 && (law_a.law == Law::normal || law_a.law == Law::lognormal))
      refuse(table, "correlation", fmt::format("names '{}', whose deviation is 0", drawn.keys[a].key));
    if (law_b.deviation == 0 && (law_b.law == Law::normal || law_b.law == Law::lognormal))
      refuse(table, "correlation", fmt::format("names '{}', whose deviation is 0", drawn.keys[b].key));
    const CorrelationRange range = reachable_correlation(law_a, law_b);
    if (stated < range.least || stated > range.most)
      refuse(table, "correlation",
             fmt::format("of {} cannot be {:g} between these laws: {:.4f} to {:.4f} can be had", names, stated,
                         range.least, range.most));
    drawn.correlated.push_back({first, second, stated, correlation_of_normals(law_a, law_b, stated)});
  }
  const std::optional<std::vector<std::vector<double>>> factor = cholesky_factor(drawn.components(), drawn.correlated);
  if (!factor) {
    std::vector<std::string> names;
    for (const std::size_t component : inconsistent_keys(drawn.components(), drawn.correlated))
      for (std::size_t k = 0; k < drawn.keys.size(); ++k)
        if (component_of(drawn, k) == component) names.push_back(drawn.keys[k].key);
    refuse(table, "correlation",
           fmt::format("of {} contradict each other: no numbers can be correlated so; bring them nearer to 0",
                       fmt::join(names, ", ")));
  }
  drawn.factor = *factor;
}

// ---- drawing ------------------------------------------------------------------------------------------------------

// Dip and dip direction of a pole drawn around its mean. P = 1 - exp(-(u1² + u2²)/2), cos θ = 1 + ln(1 - P (1 -
// exp(-2K)))/K, towards u1 horizontally and u2 upwards: smooth at the mean, without a seam at 360 degrees.
void draw_pole(const PoleScatter& pole, double u1, double u2, std::vector<double>& values) {
  const double radius2 = u1 * u1 + u2 * u2, left = portable::exp(-std::min(radius2 / 2, 700.0)),
               end = portable::exp(-std::min(2 * pole.concentration, 700.0));
  // 1 - P (1 - end) = left + end (1 - left)
  const double inside = left + end * (1 - left);
  const double less = -portable::log(inside) / pole.concentration;  // 1 - cos θ
  const double cosine = 1 - less, sine = std::sqrt(std::max(0.0, less * (2 - less)));
  const double radius = std::sqrt(radius2), across = radius > 0 ? u1 / radius : 0, up = radius > 0 ? u2 / radius : 0;
  const double dip = pole.dip * degree, direction = pole.dip_direction * degree;
  const double sin_dip = portable::sine(dip), cos_dip = portable::cosine(dip), sin_dir = portable::sine(direction),
               cos_dir = portable::cosine(direction);
  // the upward normal, a horizontal unit vector across it, and the third: east, north, up
  const double n[3] = {sin_dip * sin_dir, sin_dip * cos_dir, cos_dip}, h[3] = {-cos_dir, sin_dir, 0},
               t[3] = {n[1] * h[2] - n[2] * h[1], n[2] * h[0] - n[0] * h[2], n[0] * h[1] - n[1] * h[0]};
  double drawn[3];
  for (int i = 0; i < 3; ++i)
    drawn[i] = cosine * n[i] + sine * (across * h[i] + up * t[i]);
  if (drawn[2] < 0)
    for (double& component : drawn)
      component = -component;
  const double flat = std::sqrt(drawn[0] * drawn[0] + drawn[1] * drawn[1]);
  values.push_back(to_degrees(portable::angle(drawn[2], flat)));
  double trend = flat > 0 ? to_degrees(portable::angle(drawn[1], drawn[0])) : pole.dip_direction;
  if (trend < 0) trend += 360;
  values.push_back(trend);
}

}  // namespace

std::vector<std::string> DrawnKey::scene_keys() const {
  if (!pole) return {key};
  return {key + ".dip", key + ".dip_direction"};
}

std::size_t DrawnKeys::components() const {
  return component_of(*this, keys.size());
}

std::vector<std::string> DrawnKeys::scene_keys() const {
  std::vector<std::string> all;
  for (const DrawnKey& key : keys)
    for (std::string& name : key.scene_keys())
      all.push_back(std::move(name));
  return all;
}

std::vector<std::string> DrawnKeys::units() const {
  std::vector<std::string> all;
  for (const DrawnKey& key : keys)
    for (std::size_t k = 0; k < key.components(); ++k)
      all.push_back(key.pole ? "deg" : key.unit);
  return all;
}

std::vector<double> DrawnKeys::at(const StandardPoint& u) const {
  std::vector<double> values;
  for (std::size_t k = 0, component = 0; k < keys.size(); component += keys[k].components(), ++k) {
    const auto normal = [&](std::size_t c) {
      if (factor.empty()) return u[c];
      double z = 0;
      for (std::size_t j = 0; j <= c; ++j)
        z += factor[c][j] * u[j];
      return z;
    };
    if (keys[k].pole)
      draw_pole(*keys[k].pole, u[component], u[component + 1], values);
    else
      values.push_back(value_at(keys[k].law, normal(component)));
  }
  return values;
}

// Keys that are alone are drawn from a stream of their own, cut laws by drawing again; those with correlation, and
// poles, from standard normals of the same streams.
std::vector<double> DrawnKeys::row(int number) const {
  StandardPoint u;
  std::vector<std::optional<double>> drawn;
  for (const DrawnKey& key : keys) {
    if (latin) {
      for (std::size_t k = 0; k < key.components(); ++k)
        u.push_back(latin_columns[u.size()][static_cast<std::size_t>(number - 1)]);
      drawn.emplace_back();
      continue;
    }
    RandomStream stream(seed, fmt::format("row {} of {}", number, key.key));
    const auto in_pair = [&](const CorrelatedPair& pair) { return pair.a == u.size() || pair.b == u.size(); };
    if (key.pole || std::ranges::any_of(correlated, in_pair)) {
      for (std::size_t k = 0; k < key.components(); ++k)
        u.push_back(stream.normal());
      drawn.emplace_back();
    } else {
      u.push_back(0);
      drawn.push_back(draw(key.law, stream));
      if (!drawn.back())
        throw BadInput(
            fmt::format("{}: its law hardly ever gives a value from least to most; set them farther apart", key.key));
    }
  }
  std::vector<double> values = at(u);
  for (std::size_t k = 0, place = 0; k < keys.size(); place += keys[k].components(), ++k)
    if (drawn[k]) values[place] = *drawn[k];
  return values;
}

void make_latin(DrawnKeys& drawn) {
  drawn.latin = true;
  for (const DrawnKey& key : drawn.keys)
    for (std::size_t k = 0; k < key.components(); ++k)
      drawn.latin_columns.push_back(
          latin_column(drawn.rows, drawn.seed, key.pole ? fmt::format("{} {}", key.key, k + 1) : key.key));
}

DrawnKeys read_drawn_keys(const Subject& table) {
  DrawnKeys drawn;
  drawn.seed = static_cast<std::uint64_t>(whole_number_of(table, "seed", 0, seeds).value_or(0));
  const std::vector<Subject> keys = tables_of(table, "keys");
  if (keys.empty()) refuse(table, "keys", "must be a list of tables, each with a key of the scene");
  for (const Subject& key : keys) {
    drawn.keys.push_back(read_key(key));
    const Distribution& law = drawn.keys.back().law;
    // the end of a law that hardly ever gives a value between least and most is refused here, not in some row
    RandomStream stream(drawn.seed, "first");
    if (!drawn.keys.back().pole && !draw(law, stream))
      refuse(key, "law", "hardly ever gives a value from least to most; set them farther apart");
  }
  for (std::size_t k = 0; k < drawn.keys.size(); ++k)
    for (std::size_t j = 0; j < k; ++j)
      if (drawn.keys[j].key == drawn.keys[k].key) refuse(table, "keys", "must be different keys");
  read_correlation(table, drawn);
  return drawn;
}

std::string law_text(const DrawnKey& key) {
  if (key.pole)
    return fmt::format("fisher, dip {:g}, dip direction {:g}, concentration {:g}", key.pole->dip,
                       key.pole->dip_direction, key.pole->concentration);
  const Distribution& law = key.law;
  std::string text(std::ranges::find(laws, law.law, &std::pair<std::string_view, Law>::second)->first);
  const bool has_mean = law.law == Law::normal || law.law == Law::lognormal || law.law == Law::exponential;
  if (has_mean) text += fmt::format(", mean {:g}", law.mean);
  if (has_mean && law.law != Law::exponential) text += fmt::format(", deviation {:g}", law.deviation);
  if (law.law == Law::triangular) text += fmt::format(", mode {:g}", law.mode);
  if (std::isfinite(law.least)) text += fmt::format(", least {:g}", law.least);
  if (std::isfinite(law.most)) text += fmt::format(", most {:g}", law.most);
  if (has_mean && law.is_cut()) text += " (mean and deviation of the law before it is cut)";
  return text;
}

std::string short_name(const std::string& key) {
  constexpr std::string_view of_stage = ".friction.";
  if (const std::size_t at = key.find(of_stage); key.starts_with("stage.") && at != std::string::npos)
    return key.substr(at + of_stage.size());
  const std::size_t dot = key.find('.');
  return dot == std::string::npos ? key : key.substr(dot + 1);
}

std::string sharing_text(const DrawnKeys& drawn) {
  std::vector<std::string> parts;
  bool angles = false;
  for (const auto& [per, shared] : {std::pair{DrawnPer::property, "joints of the same properties share a draw"},
                                    {DrawnPer::set, "joints of the same set share a draw"},
                                    {DrawnPer::joint, "each joint has a draw of its own"}}) {
    std::vector<std::string> names;
    for (const DrawnKey& key : drawn.keys)
      if ((key.key.starts_with("joint_properties.") || key.key.ends_with("friction_deg")) && key.per == per) {
        names.push_back(short_name(key.key));
        angles |= key.key.ends_with("friction_deg");
      }
    if (!names.empty()) parts.push_back(fmt::format("{} ({})", shared, fmt::join(names, ", ")));
  }
  if (parts.empty()) return "";
  return fmt::format("{}{}", fmt::join(parts, "; "), angles ? "; angles are drawn, not their tangents" : "");
}

std::optional<double> whole_number_of(const Subject& table, const char* key, double least, double most) {
  const Node* node = table.node->find(key);
  if (!node) return std::nullopt;
  if (node->kind != Node::Kind::integer || node->number < least || node->number > most)
    refuse(table, key, fmt::format("must be a whole number, {:.0f} to {:.0f}", least, most));
  return node->number;
}

}  // namespace voussoir
