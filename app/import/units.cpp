#include "app/import/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "app/import/reference_systems.hpp"

namespace voussoir {
namespace {

constexpr double us_survey_foot = 1200.0 / 3937;  // m
constexpr int no_drawing_unit = 0;                // $INSUNITS

struct NamedUnit {
  int drawing_code;  // of $INSUNITS
  LengthUnit unit;
  std::array<std::string_view, 3> names;  // one of it, several, short
};
constexpr NamedUnit units[] = {
    {6, {"metres", 1}, {"METER", "METERS", "M"}},
    {6, {"metres", 1}, {"METRE", "METRES", "M"}},
    {1, {"inches", 0.0254}, {"INCH", "INCHES", "IN"}},
    {2, {"feet", 0.3048}, {"FOOT", "FEET", "FT"}},
    {3, {"miles", 1609.344}, {"MILE", "MILES", "MI"}},
    {4, {"millimetres", 1e-3}, {"MILLIMETER", "MILLIMETERS", "MM"}},
    {4, {"millimetres", 1e-3}, {"MILLIMETRE", "MILLIMETRES", "MM"}},
    {5, {"centimetres", 1e-2}, {"CENTIMETER", "CENTIMETERS", "CM"}},
    {5, {"centimetres", 1e-2}, {"CENTIMETRE", "CENTIMETRES", "CM"}},
    {7, {"kilometres", 1e3}, {"KILOMETER", "KILOMETERS", "KM"}},
    {7, {"kilometres", 1e3}, {"KILOMETRE", "KILOMETRES", "KM"}},
    {8, {"microinches", 0.0254e-6}, {"MICROINCH", "MICROINCHES", ""}},
    {9, {"mils", 0.0254e-3}, {"MIL", "MILS", ""}},
    {10, {"yards", 0.9144}, {"YARD", "YARDS", "YD"}},
    {13, {"micrometres", 1e-6}, {"MICRON", "MICRONS", "UM"}},
    {14, {"decimetres", 0.1}, {"DECIMETER", "DECIMETERS", "DM"}},
    {14, {"decimetres", 0.1}, {"DECIMETRE", "DECIMETRES", "DM"}},
    {15, {"decametres", 10}, {"DECAMETER", "DECAMETERS", ""}},
    {16, {"hectometres", 100}, {"HECTOMETER", "HECTOMETERS", ""}},
    {21, {"US survey feet", us_survey_foot}, {"US SURVEY FOOT", "US SURVEY FEET", "USFT"}},
    {22, {"US survey inches", us_survey_foot / 12}, {"US SURVEY INCH", "US SURVEY INCHES", ""}},
    {23, {"US survey yards", us_survey_foot * 3}, {"US SURVEY YARD", "US SURVEY YARDS", ""}},
    {24, {"US survey miles", us_survey_foot * 5280}, {"US SURVEY MILE", "US SURVEY MILES", ""}},
};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// the last whole number after the authority's name: EPSG:25832, urn:ogc:def:crs:EPSG:6.9:25832, …/ref/epsg/25832/proj4
std::optional<long long> code_behind(std::string_view text) {
  std::optional<long long> code;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of(":/#+,", at), text.size());
    const std::string_view word = text.substr(at, end - at);
    long long number = 0;
    const bool whole = !word.empty() && std::all_of(word.begin(), word.end(), is_digit) &&
                       std::from_chars(word.data(), word.data() + word.size(), number).ec == std::errc();
    if (whole) code = number;
    // a compound system of plane and heights names the plane first
    if (end < text.size() && (text[end] == ',' || text[end] == '+') && code) return code;
    at = end + 1;
  }
  return code;
}

[[noreturn]] void refuse_system(std::string_view crs, int line, const std::string& reason) {
  throw FileFault(line, 0, "crs = " + shown(crs) + ": " + reason);
}

constexpr const char* in_degrees = "is longitude and latitude in degrees; write the file in a projected system, in m";

}  // namespace

const SystemGroup* reference_system(std::string_view authority, long long code) {
  for (std::size_t g = 0; g < system_group_count; ++g) {
    const SystemGroup& group = system_groups[g];
    if (group.authority != authority) continue;
    const char* at = group.codes.data();
    const char* const end = at + group.codes.size();
    while (at < end) {
      long long first = 0;
      at = std::from_chars(at, end, first).ptr;
      long long last = first;
      if (at < end && *at == '-') at = std::from_chars(at + 1, end, last).ptr;
      ++at;  // the blank
      if (code >= first && code <= last) return &group;
    }
  }
  return nullptr;
}

void FilePlacement::state(const LengthUnit& unit, std::string where) {
  unit_ = unit;
  stated_ = std::move(where);
}

void FilePlacement::named_unit(const Word& name, std::string_view key) {
  const std::string wanted = upper_case(name.text);
  for (const NamedUnit& named : units)
    if (!wanted.empty() && std::find(named.names.begin(), named.names.end(), wanted) != named.names.end())
      return state(named.unit, fmt::format("{} = {}", key, shown(name.text)));
  throw FileFault(name.line, name.column,
                  fmt::format("{} = {}: an unknown unit of length; export the file in m", key, shown(name.text)));
}

void FilePlacement::drawing_unit(const Word& code) {
  const double number = number_of(code, "$INSUNITS");
  if (number == no_drawing_unit) return;
  for (const NamedUnit& named : units)
    if (named.drawing_code == number) return state(named.unit, fmt::format("$INSUNITS {:g}", number));
  throw FileFault(code.line, code.column,
                  fmt::format("$INSUNITS = {}: an unknown unit; write 6 and coordinates in m, or 0", shown(code.text)));
}

void FilePlacement::reference_system(std::string_view crs, int line) {
  const std::string text = upper_case(crs);
  for (const char* degrees : {"CRS84", "CRS83", "CRS27"})
    if (text.find(degrees) != std::string::npos) refuse_system(crs, line, in_degrees);
  // of a compound system the first is the plane's
  const std::size_t at = std::min(text.find("EPSG"), text.find("ESRI"));
  const std::string_view authority = std::string_view(text).substr(std::min(at, text.size()), 4);
  if (const auto code = code_behind(std::string_view(text).substr(std::min(at, text.size()) + authority.size()))) {
    const std::string name = fmt::format("{}:{}", authority, *code);
    const SystemGroup* const found = voussoir::reference_system(authority, *code);
    if (!found)
      refuse_system(
          crs, line,
          name +
              " is an unknown reference system, so that its unit is not known; name a projected system in m, or "
              "leave out crs if the coordinates are in m");
    if (found->kind == SystemKind::geographic) refuse_system(crs, line, name + " " + in_degrees);
    if (found->kind == SystemKind::geocentric)
      refuse_system(crs, line,
                    name + " is measured from the centre of the earth; write the file in a projected system, in m");
    return state(found->unit, "the reference system " + name);
  }
  refuse_system(crs, line,
                "names no system by its number (EPSG:25832), so that its unit is not known; name a projected system in "
                "m, or leave out crs if the coordinates are in m");
}

Vector<3> FilePlacement::operator()(const Vector<3>& point, int line) const {
  const Vector<3> place = unit_.metres * point + shift_;
  for (const double x : place)
    refuse_far_coordinate(x, line, 0);
  return place;
}

void FilePlacement::tell(JointCollector& joints) const {
  if (stated_.empty())
    joints.remark("the file states no unit of length: coordinates were taken as m; check the box");
  else if (unit_.metres != 1)
    joints.remark(fmt::format("{}: coordinates in {} ({} m) were converted to m; check the box", stated_, unit_.name,
                              unit_.metres));
}

}  // namespace voussoir
