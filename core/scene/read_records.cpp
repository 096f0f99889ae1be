#include "core/scene/read_records.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/exchange/record_file.hpp"
#include "core/scene/keys.hpp"
#include "core/scene/scene_text.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

// every `factor` below a node, whatever table may have it
template <class Visit>
void each_factor(Node& node, const Visit& visit) {
  for (Node& item : node.items)
    each_factor(item, visit);
  for (Member& member : node.members) {
    if (member.key == "factor") visit(member.value);
    if (member.key != "samples") each_factor(member.value, visit);
  }
}

Node numbers_node(const std::vector<double>& values, const Place& place) {
  Node list;
  list.kind = Node::Kind::list;
  list.place = place;
  list.items.reserve(values.size());
  for (const double value : values) {
    Node& item = list.items.emplace_back();
    item.kind = Node::Kind::number;
    item.place = place;
    item.number = value;
  }
  return list;
}

Node text_node(std::string_view text, const Place& place) {
  Node node;
  node.kind = Node::Kind::text;
  node.place = place;
  node.text = text;
  return node;
}

Node samples_node(const RecordFile& file, const Place& place) {
  Node samples;
  samples.place = place;
  samples.set("values", numbers_node(file.values, place));
  samples.set("interval_s", numbers_node({file.interval}, place).items.front());
  if (!file.unit.empty()) samples.set("unit", text_node(file.unit, place));
  if (file.quantity) samples.set("quantity", text_node(word_of(*file.quantity), place));
  if (!file.component.empty()) samples.set("component", text_node(one_line(file.component, 60), place));
  return samples;
}

bool is_number_or_absent(const Node* node) {
  return !node || (node->is_number() && node->number > 0);
}

// why the file is not read, before keys are checked: another kind of value, which that check refuses, or samples
bool is_to_be_read(const Node& record) {
  const Node* stated = record.find("record");
  if (!stated || stated->kind != Node::Kind::text) return false;
  if (!is_number_or_absent(record.find("interval_s")) || !is_number_or_absent(record.find("column"))) return false;
  const bool overridden =
      std::ranges::any_of(std::initializer_list<const char*>{"record", "interval_s", "column"}, [&](const char* key) {
        const Node* node = record.find(key);
        return node && node->place.override_text;
      });
  return overridden || !record.find("samples");
}

void read_one(Node& record, const std::string& scene_file, FilesRead& read) {
  const Node stated = *record.find("record");
  const std::string source = stated.place.source ? *stated.place.source : scene_file;
  const fs::path folder = fs::path(source == one_line(scene_file, 1000) ? scene_file : source).parent_path();
  const fs::path file = file_beside(stated, "record", folder);
  if (std::ranges::find(read.files, file) == read.files.end()) read.files.push_back(file);
  const std::string shown_name = printable((folder / fs::path(stated.text)).string());
  RecordLayout layout;
  if (const Node* interval = record.find("interval_s")) layout.interval = interval->number;
  if (const Node* column = record.find("column")) layout.column = static_cast<int>(std::min(column->number, 1e6));
  try {
    const RecordFile contents = read_record_file(file_text(file), layout);
    for (const FileRemark& remark : contents.remarks)
      read.remarks.push_back(fmt::format("{}:{}: {}", shown_name, remark.line, remark.text));
    record.set("samples", samples_node(contents, stated.place));
  } catch (const FileFault& fault) {
    std::string place = shown_name;
    for (const int number : {fault.line, fault.column})
      if (number > 0) place += ":" + std::to_string(number);
    throw SceneError(place + ": " + fault.what(), shown_name, fault.line);
  }
}

// the unit of the values and what they are, from the scene, the file and the unit's dimension
const RecordUnit& unit_of_record(RecordSpec& record) {
  const auto disagree = [&](const char* key, std::string_view file_says) {
    refuse(record.subject, key, fmt::format("but the file states {}; remove the key or correct the file", file_says));
  };
  const SamplesSpec& samples = record.samples;
  const RecordUnit* in_file = find_record_unit(samples.unit);
  const RecordUnit* stated = record.unit ? find_record_unit(*record.unit) : in_file;
  if (!stated)
    refuse(record.subject, "unit",
           "neither the scene nor the file states the unit of the values; write for example unit = \"g\", \"m/s2\" or "
           "\"cm/s\"");
  if (record.unit && in_file && (in_file->size != stated->size || in_file->quantity != stated->quantity))
    disagree("unit", samples.unit);
  if (record.quantity && samples.quantity && *record.quantity != *samples.quantity)
    disagree("quantity", word_of(*samples.quantity));
  record.resolved = record.quantity ? *record.quantity : samples.quantity.value_or(stated->quantity);
  if (stated->quantity != record.resolved)
    refuse(record.subject, "unit",
           fmt::format("{} is a unit of {}, and quantity = \"{}\"; state the unit of that, or the other quantity",
                       stated->word, word_of(stated->quantity), word_of(record.resolved)));
  return *stated;
}

void check_baseline(const RecordSpec& record) {
  const Baseline baseline = record.treatment.baseline;
  if (baseline == Baseline::end && record.resolved != MotionQuantity::acceleration)
    refuse(record.subject, "baseline",
           fmt::format("\"end\" corrects accelerations, and quantity = \"{}\"; write \"none\"{}",
                       word_of(record.resolved), record.resolved == MotionQuantity::velocity ? " or \"mean\"" : ""));
  if (baseline == Baseline::mean && record.resolved == MotionQuantity::displacement)
    refuse(record.subject, "baseline", "\"mean\" corrects accelerations or velocities; write \"none\"");
}

std::vector<double> direction_of(const RecordSpec& record, int dimension) {
  if (record.direction && record.azimuth)
    refuse(record.subject, "azimuth_deg", "is stated together with direction; remove one of the two");
  if (record.azimuth) {
    if (dimension == 2)
      refuse(record.subject, "azimuth_deg", "needs dimension = 3; in 2-D write for example direction = [1, 0]");
    // 90 degrees are exactly x: its cosine in radians is rounding
    constexpr double rounding = 1e-15;
    const auto exact = [](double x) { return std::abs(x) < rounding ? 0 : x; };
    return {exact(std::sin(*record.azimuth)), exact(std::cos(*record.azimuth)), 0};
  }
  if (!record.direction)
    refuse(record.subject, "direction",
           fmt::format("nothing states along which direction positive values are; write for example {}",
                       dimension == 2 ? "direction = [1, 0]" : "direction = [1, 0, 0], or azimuth_deg = 270"));
  std::vector<double> direction = *record.direction;
  double square = 0;
  for (const double x : direction)
    square += x * x;
  constexpr double least_square = 1e-24;  // shorter ones are mistakes
  if (!(square > least_square))
    refuse(record.subject, "direction", "must not be zero; give the direction of positive values");
  for (double& x : direction)
    x /= std::sqrt(square);
  return direction;
}

}  // namespace

void list_records(Node& scene) {
  Node* stages = scene.find("stage");
  if (!stages) return;
  each_factor(*stages, [](Node& factor) {
    if (factor.kind != Node::Kind::table) return;
    Node list;
    list.kind = Node::Kind::list;
    list.place = factor.place;
    list.items.push_back(std::move(factor));
    factor = std::move(list);
  });
}

void read_record_files(Node& scene, const std::string& scene_file, FilesRead& read) {
  Node* stages = scene.find("stage");
  if (!stages) return;
  each_factor(*stages, [&](Node& factor) {
    for (Node& record : factor.items)
      if (record.kind == Node::Kind::table && is_to_be_read(record)) read_one(record, scene_file, read);
  });
}

std::vector<RecordSpec> read_records(const Subject& table) {
  std::vector<RecordSpec> records;
  for (const Subject& item : children(table, "factor")) {
    RecordSpec record;
    record.subject = item;
    read_keys(*item.node, "record", record);
    read_keys(*item.node, "record", record.treatment);
    record.treatment.scale = record.scale * (record.reversed ? -1 : 1) * unit_of_record(record).size;
    check_baseline(record);
    const ValueRange kept = values_kept(record.samples.values.size(), record.samples.interval, record.treatment);
    if (kept.end < kept.first + 2)
      refuse(item,
             item.node->find("to_s")     ? "to_s"
             : item.node->find("from_s") ? "from_s"
                                         : "record",
             fmt::format("leaves fewer than two values of a record of {} values that ends at {:g} s; take more of it",
                         record.samples.values.size(),
                         record.samples.interval * static_cast<double>(record.samples.values.size() - 1)));
    records.push_back(std::move(record));
  }
  return records;
}

RecordedMotion recorded_motion(const RecordSpec& record, int dimension) {
  GroundMotion motion =
      make_ground_motion(record.resolved, record.samples.interval, record.samples.values, record.treatment);
  motion.name = record.file;
  return {direction_of(record, dimension), std::make_shared<const GroundMotion>(std::move(motion))};
}

}  // namespace voussoir
