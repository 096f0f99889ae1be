#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/import/formats.hpp"

namespace voussoir {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(const std::string& path, const std::string& reason) {
  throw FileFault(0, 0, (path.empty() ? "" : path + ": ") + reason);
}

// a member of an object; nothing where there is none, or null
const json* member(const json& object, const char* name) {
  if (!object.is_object()) return nullptr;
  const auto at = object.find(name);
  return at == object.end() || at->is_null() ? nullptr : &*at;
}

std::string type_of(const json& object) {
  const json* type = member(object, "type");
  return type && type->is_string() ? type->get<std::string>() : "";
}

class TracesReader {
 public:
  explicit TracesReader(const Vector<3>& shift) : shift_(shift.head<2>()) {}

  ImportedJoints read(const json& file) {
    const std::string type = type_of(file);
    if (type == "FeatureCollection")
      collection(file);
    else if (type == "Feature")
      feature(file, "");
    else
      geometry(file, "", {0, "trace-1", ""});
    reference_system(file);
    return joints_.finish();
  }

 private:
  void collection(const json& file) {
    const json* features = member(file, "features");
    if (!features || !features->is_array()) refuse("features", "must be a list; is it a GeoJSON?");
    for (const json& one : *features)
      feature(one, fmt::format("features.{}", ++count_));
  }
  void feature(const json& one, const std::string& path) {
    const json* drawn = member(one, "geometry");
    if (!drawn) return joints_.drop(0, "a feature without a geometry");
    Origin origin{0, fmt::format("trace-{}", std::max(count_, 1LL)), ""};
    if (const json* properties = member(one, "properties"))
      if (const json* set = member(*properties, "set"))
        if (set->is_string() || set->is_number()) origin.set = set->is_string() ? set->get<std::string>() : set->dump();
    geometry(*drawn, path.empty() ? "geometry" : path + ".geometry", origin);
  }
  void geometry(const json& drawn, const std::string& path, const Origin& origin) {
    const std::string type = type_of(drawn);
    if (type.empty()) refuse(path, "has no type; is it a GeoJSON?");
    const json* coordinates = member(drawn, "coordinates");
    if (type != "LineString" && type != "MultiLineString")
      return joints_.drop(0, "a geometry " + shown(type) + ", no LineString");
    if (!coordinates || !coordinates->is_array()) refuse(path + ".coordinates", "must be a list of points");
    if (type == "LineString") return line(*coordinates, path + ".coordinates", origin);
    for (std::size_t k = 0; k < coordinates->size(); ++k)
      line((*coordinates)[k], fmt::format("{}.coordinates.{}", path, k + 1), origin);
  }
  void line(const json& points, const std::string& path, const Origin& origin) {
    if (!points.is_array()) refuse(path, "must be a list of points");
    if (points.size() < 2) return joints_.drop(0, "a line of fewer than two points");
    Vector<2> before = point(points[0], path + ".1");
    if (points.size() > 2) ++bent_;
    for (std::size_t k = 1; k < points.size(); ++k) {
      const Vector<2> next = point(points[k], fmt::format("{}.{}", path, k + 1));
      joints_.trace(origin, before, next);
      before = next;
    }
  }
  // a third coordinate is height above the plane, which a trace has none of
  Vector<2> point(const json& numbers, const std::string& path) {
    if (!numbers.is_array() || numbers.size() < 2 || !numbers[0].is_number() || !numbers[1].is_number())
      refuse(path, "a point is a list of two numbers; write for example [12.5, 3]");
    Vector<2> p;
    for (int k = 0; k < 2; ++k) {
      p[k] = numbers[k].get<double>();
      try {
        refuse_far_coordinate(p[k], 0, 0);
      } catch (const FileFault& fault) {
        refuse(path, fault.what());
      }
    }
    return p + shift_;
  }
  void reference_system(const json& file) {
    if (bent_ > 0) joints_.remark(fmt::format("{} lines are bent: each of their stretches is a joint", bent_));
    const json* system = member(file, "crs");
    const std::string name = system ? system->dump(-1, ' ', true) : "";
    if (name.find("CRS84") != std::string::npos || name.find("4326") != std::string::npos)
      refuse("crs", "is longitude and latitude in degrees; write the file in a projected system, in m");
    if (!system)
      joints_.remark("the file names no reference system (crs): coordinates were taken as m, so look at the box");
  }

  Vector<2> shift_;
  long long count_ = 0, bent_ = 0;
  JointCollector joints_{2};
};

}  // namespace

ImportedJoints read_traces(std::string_view text, const Vector<3>& shift) {
  for (LineReader lines(text); lines.next();) {  // refuses what is no plain text
  }
  json file;
  try {
    file = json::parse(text);
  } catch (const json::parse_error& error) {
    const std::string_view before = text.substr(0, std::min(error.byte, text.size()));
    throw FileFault(static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1, 0,
                    "is no JSON from here on; is the file cut off, or a bracket or comma lost?");
  } catch (const json::out_of_range&) {
    throw FileFault(0, 0, "holds a number too large for any coordinate; is it in m?");
  }
  return TracesReader(shift).read(file);
}

}  // namespace voussoir
