#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "app/import/formats.hpp"
#include "app/import/units.hpp"
#include "core/base/floating_point_traps.hpp"

namespace voussoir {
namespace {

using nlohmann::json;

// counts the lines that the parser has read
struct LineCounter {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  reference operator*() const { return *at; }
  LineCounter& operator++() {
    *line += *at == '\n';
    ++at;
    return *this;
  }
  bool operator==(const LineCounter& other) const { return at == other.at; }
  bool operator!=(const LineCounter& other) const { return at != other.at; }

  const char* at;
  int* line;
};

struct GeoJson {
  json root;
  std::vector<int> lines;  // the line of each object of the list `features`
};

GeoJson parse(std::string_view text) {
  GeoJson file;
  int line = 1;
  bool in_features = false;
  const auto note_lines = [&](int depth, json::parse_event_t event, json& value) {
    if (event == json::parse_event_t::key && depth == 1) in_features = value == "features";
    if (event == json::parse_event_t::object_start && depth == 2 && in_features) file.lines.push_back(line);
    return true;
  };
  try {
    const WithoutTraps no_traps;  // the library refuses a number that is too large
    file.root = json::parse(LineCounter{text.data(), &line}, LineCounter{text.data() + text.size(), &line}, note_lines);
  } catch (const json::parse_error&) {
    throw FileFault(line, 0, "is no JSON from here on; is the file truncated, or a bracket or comma lost?");
  } catch (const json::out_of_range&) {
    throw FileFault(line, 0, "has a number too large for a coordinate; is it in m?");
  }
  return file;
}

// a member of an object; nothing if it is missing or null
const json* member(const json& object, const char* name) {
  if (!object.is_object()) return nullptr;
  const auto at = object.find(name);
  return at == object.end() || at->is_null() ? nullptr : &*at;
}

std::string type_of(const json& object) {
  const json* type = member(object, "type");
  return type && type->is_string() ? type->get<std::string>() : "";
}

// the text that names a reference system: {"properties": {"name": …}}, as links, or by number as files of 2008 do
std::string name_of(const json& system) {
  const json* properties = member(system, "properties");
  for (const char* key : {"name", "href", "code"})
    if (const json* value = properties ? member(*properties, key) : nullptr)
      if (value->is_string() || value->is_number_integer()) {
        const std::string text = value->is_string() ? value->get<std::string>() : value->dump();
        return key == std::string_view("code") ? type_of(system) + ":" + text : text;
      }
  return system.dump(-1, ' ', true);
}

class TracesReader {
 public:
  TracesReader(const Vector<3>& shift, const std::vector<int>& lines) : place_(shift), lines_(lines) {}

  ImportedJoints read(const json& file) {
    const json* system = member(file, "crs");
    if (system) place_.reference_system(name_of(*system), 1);
    const std::string type = type_of(file);
    if (type == "FeatureCollection")
      collection(file);
    else if (type == "Feature")
      feature(file);
    else
      geometry(file, {1, "trace-1", ""});
    if (bent_ > 0) joints_.remark(fmt::format("{} lines are bent: each of their segments is a joint", bent_));
    place_.tell(joints_);
    if (!system && may_be_degrees_)
      joints_.warn(
          "the file names no reference system (crs), and all its coordinates are within 180 and 90, as longitude and "
          "latitude are; if they are degrees, write the file in a projected system, in m");
    return joints_.finish();
  }

 private:
  [[noreturn]] void refuse(const std::string& what, const std::string& reason) const {
    throw FileFault(line_, 0, what + ": " + reason);
  }
  void collection(const json& file) {
    const json* features = member(file, "features");
    if (!features || !features->is_array()) refuse("features", "must be a list; is it a GeoJSON?");
    std::size_t objects = 0;
    for (const json& one : *features) {
      if (one.is_object() && objects < lines_.size()) line_ = lines_[objects++];
      ++count_;
      feature(one);
    }
    line_ = 1;
  }
  void feature(const json& one) {
    const json* drawn = member(one, "geometry");
    if (!drawn) return joints_.drop(line_, "a feature without a geometry");
    JointSource origin{line_, fmt::format("trace-{}", std::max(count_, 1LL)), ""};
    if (const json* properties = member(one, "properties"))
      if (const json* set = member(*properties, "set"))
        if (set->is_string() || set->is_number()) origin.set = set->is_string() ? set->get<std::string>() : set->dump();
    geometry(*drawn, origin);
  }
  void geometry(const json& drawn, const JointSource& origin) {
    const std::string type = type_of(drawn);
    if (type.empty()) refuse("geometry", "has no type; is it a GeoJSON?");
    const json* coordinates = member(drawn, "coordinates");
    if (type != "LineString" && type != "MultiLineString")
      return joints_.drop(line_, "a geometry " + shown(type) + ", no LineString");
    if (!coordinates || !coordinates->is_array()) refuse("coordinates", "must be a list of points");
    if (type == "LineString") return line(*coordinates, "coordinates", origin);
    for (std::size_t k = 0; k < coordinates->size(); ++k)
      line((*coordinates)[k], fmt::format("coordinates.{}", k + 1), origin);
  }
  void line(const json& points, const std::string& path, const JointSource& origin) {
    if (!points.is_array()) refuse(path, "must be a list of points");
    if (points.size() < 2) return joints_.drop(line_, "a line of fewer than two points");
    Vector<2> before = point(points[0], path + ".1");
    if (points.size() > 2) ++bent_;
    for (std::size_t k = 1; k < points.size(); ++k) {
      const Vector<2> next = point(points[k], fmt::format("{}.{}", path, k + 1));
      joints_.trace(origin, before, next);
      before = next;
    }
  }
  // a third coordinate is the height above the plane, which a trace does not have
  Vector<2> point(const json& numbers, const std::string& path) {
    if (!numbers.is_array() || numbers.size() < 2 || !numbers[0].is_number() || !numbers[1].is_number())
      refuse(path, "a point is a list of two numbers; write for example [12.5, 3]");
    Vector<2> p;
    for (int k = 0; k < 2; ++k) {
      p[k] = numbers[k].get<double>();
      refuse_far_coordinate(p[k], line_, 0);
    }
    may_be_degrees_ = may_be_degrees_ && std::abs(p[0]) <= 180 && std::abs(p[1]) <= 90;
    return place_({p[0], p[1], 0}, line_).head<2>();
  }
  FilePlacement place_;
  const std::vector<int>& lines_;
  int line_ = 1;  // of the current feature
  long long count_ = 0, bent_ = 0;
  bool may_be_degrees_ = true;  // every coordinate so far
  JointCollector joints_{2};
};

}  // namespace

ImportedJoints read_traces(std::string_view text, const Vector<3>& shift) {
  for (LineReader lines(text); lines.next();) {  // refuses characters that are no plain text
  }
  const GeoJson file = parse(text);
  return TracesReader(shift, file.lines).read(file.root);
}

}  // namespace voussoir
