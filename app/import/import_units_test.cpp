// `voussoir import`: entities that a drawing hides are no joints, and lengths are in the unit that the file states.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "app/import/formats.hpp"
#include "app/import/reference_systems.hpp"
#include "app/testing/program.hpp"
#include "core/testing/shapes.hpp"
#include "text/angle.hpp"

namespace voussoir::import_units_test {
namespace {

using namespace program;

const Vector<3> at_origin = Vector<3>::Zero();

std::string stored(const std::string& name) {
  return read(scenes / "import" / name);
}

std::size_t dropped_for(const ImportedJoints& found, const std::string& part) {
  return std::count_if(found.dropped.begin(), found.dropped.end(),
                       [&](const Dropped& dropped) { return dropped.reason.find(part) != std::string::npos; });
}

bool tells(const ImportedJoints& found, const std::string& part) {
  return std::any_of(found.remarks.begin(), found.remarks.end(),
                     [&](const std::string& remark) { return remark.find(part) != std::string::npos; });
}

template <class Read>
void expect_refusal(const Read& read, std::string_view text, const std::string& part) {
  SCOPED_TRACE(part);
  try {
    read(text, at_origin);
    ADD_FAILURE() << "read without an error";
  } catch (const FileFault& fault) {
    EXPECT_NE(std::string(fault.what()).find(part), std::string::npos) << fault.what();
  }
}

double area_of(const JointRow& joint) {
  const auto corner = [&](std::size_t k) { return Vector<3>(joint.corners[k].data()); };
  Vector<3> sum = Vector<3>::Zero();
  for (std::size_t k = 1; k + 1 < joint.corners.size(); ++k)
    sum += (corner(k) - corner(0)).cross(corner(k + 1) - corner(0));
  return sum.norm() / 2;
}

// ---- drawings

std::string drawing(const std::string& entities, const std::string& tables = "", const std::string& header = "") {
  const auto section = [](const std::string& name, const std::string& content) {
    return content.empty() ? "" : "0\nSECTION\n2\n" + name + "\n" + content + "0\nENDSEC\n";
  };
  return section("HEADER", header) + section("TABLES", tables) + section("ENTITIES", entities) + "0\nEOF\n";
}

std::string in_units(int code) {
  return fmt::format("9\n$INSUNITS\n70\n{}\n", code);
}

std::string layer_table(const std::string& name, int flags, int colour) {
  return fmt::format("0\nLAYER\n2\n{}\n70\n{}\n62\n{}\n6\nCONTINUOUS\n", name, flags, colour);
}

using Outline = std::vector<std::array<double, 3>>;  // x, y, bulge

std::string light_polyline(const std::string& common, const Outline& outline, bool is_closed) {
  std::string text = fmt::format("0\nLWPOLYLINE\n{}90\n{}\n70\n{}\n", common, outline.size(), is_closed ? 1 : 0);
  for (const auto& [x, y, bulge] : outline)
    text += fmt::format("10\n{}\n20\n{}\n42\n{}\n", x, y, bulge);
  return text;
}

std::string old_polyline(const std::string& common, const Outline& outline, bool is_closed, int flags_of_vertex = 0) {
  std::string text = fmt::format("0\nPOLYLINE\n{}66\n1\n70\n{}\n10\n0\n20\n0\n30\n0\n", common, is_closed ? 1 : 0);
  for (const auto& [x, y, bulge] : outline)
    text += fmt::format("0\nVERTEX\n{}10\n{}\n20\n{}\n30\n0\n42\n{}\n70\n{}\n", common, x, y, bulge, flags_of_vertex);
  return text + "0\nSEQEND\n";
}

std::string triangle_face(const std::string& common) {
  return "0\n3DFACE\n" + common + "10\n0\n20\n0\n30\n0\n11\n4\n21\n0\n31\n0\n12\n4\n22\n4\n32\n2\n";
}

TEST(ImportDrawing, TheFilesThatWereMisread) {
  for (const auto& [file, reason] : {std::pair{"paper_space.dxf", "paper space"},
                                     {"layer_frozen.dxf", "on the layer 'HIDDEN', which is frozen"},
                                     {"open_lwpolyline.dxf", "open"}}) {
    const ImportedJoints found = read_dxf(stored(file), at_origin);
    EXPECT_EQ(found.joints.size(), 1u) << file;
    EXPECT_EQ(found.dropped.size(), 1u) << file;
    EXPECT_EQ(dropped_for(found, reason), 1u) << file;
  }
  const ImportedJoints circle = read_dxf(stored("circle_of_two_arcs.dxf"), at_origin);
  ASSERT_EQ(circle.joints.size(), 1u);
  EXPECT_NEAR(area_of(circle.joints[0]), 4 * std::numbers::pi, 4 * std::numbers::pi * 5e-4);  // 120 chords
  const ImportedJoints flat = read_dxf(stored("flat_polyline_with_heights.dxf"), at_origin);
  EXPECT_TRUE(tells(flat, "4 vertices of flat polylines have their own heights, which differ by up to 14 m"));
}

// Random drawings: an entity that is hidden for any reason, or bounds no face, is counted by its reason and is no
// joint.
TEST(ImportDrawing, WhatIsHiddenOrOpenIsNoJoint) {
  shapes::Random random(11);
  const auto one_of = [&](int count) { return shapes::integer(random, 0, count - 1); };
  for (int trial = 0; trial < 200; ++trial) {
    std::map<std::string, std::size_t> expected;
    std::size_t joints = 1;
    std::string entities = triangle_face("8\nplain\n");
    for (int k = 0; k < 12; ++k) {
      const char* const layers[] = {"plain", "ICE", "ice", "dark"};
      const int layer = one_of(4), paper = one_of(4) == 0, invisible = one_of(4) == 0, kind = one_of(4);
      const bool open = one_of(2) == 0, returns = one_of(2) == 0;
      const std::string common =
          fmt::format("8\n{}\n{}{}", layers[layer], paper ? "67\n1\n" : "67\n0\n", invisible ? "60\n1\n" : "");
      Outline square{{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}};
      if (returns) square.push_back(square.front());
      std::string reason = paper                      ? "paper space"
                           : invisible                ? "invisible"
                           : layer == 1 || layer == 2 ? "frozen"
                           : layer == 3               ? "switched off"
                                                      : "";
      if (kind == 0)
        entities += triangle_face(common);
      else if (kind == 1)
        entities += light_polyline(common, square, !open);
      else
        entities += old_polyline(common, square, !open, kind == 3 ? 16 : 0);
      if (reason.empty() && kind == 3) {
        expected["control point"] += square.size();
        reason = open ? "an open" : "fewer than three corners";
      }
      if (reason.empty() && kind > 0 && open && !returns) reason = "an open";
      reason.empty() ? ++joints : ++expected[reason];
    }
    const std::string tables = layer_table("plain", 0, 7) + layer_table("ice", 1, 7) + layer_table("dark", 4, -3);
    const ImportedJoints found = read_dxf(drawing(entities, tables), at_origin);
    EXPECT_EQ(found.joints.size(), joints);
    std::size_t dropped = 0;
    for (const auto& [reason, count] : expected) {
      EXPECT_EQ(dropped_for(found, reason), count) << reason;
      dropped += count;
    }
    EXPECT_EQ(found.dropped.size(), dropped);
  }
}

// The area within arcs: of the corners' polygon and of a circular segment over each side, r² (angle - sin angle) / 2.
TEST(ImportDrawing, ArcsAreArcs) {
  shapes::Random random(12);
  for (int trial = 0; trial < 200; ++trial) {
    // corners on a circle, so that bulges outwards of less than the circle's own leave the outline convex
    const int sides = 2 + trial % 5;
    const double radius = shapes::power_of_ten(random, -1, 2),
                 share = trial % 3 == 0 ? 1 : shapes::uniform(random, 0, 1);
    std::vector<double> angles;
    double sum = 0;
    for (int k = 0; k < sides; ++k)
      sum += angles.emplace_back(shapes::uniform(random, 1, 2));
    Outline outline;
    double place = 0, area = 0, sectors = 0;
    for (double& angle : angles) {
      angle *= 2 * std::numbers::pi / sum;
      const double arc = share * angle, chord = 2 * radius * std::sin(angle / 2);
      outline.push_back({radius * std::cos(place), radius * std::sin(place), std::tan(arc / 4)});
      area += radius * radius * std::sin(angle) / 2;  // the triangle to the centre
      const double own_radius = arc > 1e-6 ? chord / 2 / std::sin(arc / 2) : 0;
      area += own_radius * own_radius * (arc - std::sin(arc)) / 2;
      sectors += own_radius * own_radius * arc / 2;
      place += angle;
    }
    if (sides == 2 && share < 0.1) continue;  // hardly a face
    for (const std::string& entity : {light_polyline("", outline, true), old_polyline("", outline, true)}) {
      const ImportedJoints found = read_dxf(drawing(entity), at_origin);
      ASSERT_EQ(found.joints.size(), 1u);
      EXPECT_EQ(dropped_for(found, "corners"), 0u);
      // chords of at most 3 degrees leave out 1 - sin 3° / 3° of the sectors above them
      const double chord = 3 * degree, left_out = sectors * (1 - std::sin(chord) / chord);
      EXPECT_LE(area_of(found.joints[0]), area * (1 + 1e-9));
      EXPECT_GE(area_of(found.joints[0]), area * (1 - 1e-9) - left_out) << sides << " " << share;
      EXPECT_TRUE(tells(found, "arcs of polylines were taken as chords"));
    }
  }
}

TEST(ImportDrawing, ItsUnitIsConverted) {
  const std::map<int, double> metres{{1, 0.0254}, {2, 0.3048},  {3, 1609.344}, {4, 0.001},           {5, 0.01},
                                     {7, 1000},   {10, 0.9144}, {14, 0.1},     {21, 0.3048006096012}};
  const std::string square = light_polyline("", {{0, 0, 0}, {300, 0, 0}, {300, 200, 0}, {0, 200, 0}}, true);
  for (const auto& [code, unit] : metres) {
    const ImportedJoints found = read_dxf(drawing(square, "", in_units(code)), {7, 0, 0});
    EXPECT_NEAR(area_of(found.joints[0]), 6e4 * unit * unit, 6e4 * unit * unit * 1e-9) << code;
    EXPECT_NEAR(found.joints[0].point[0], 7 + 150 * unit, 150 * unit * 1e-9) << "the shift is in m";
    EXPECT_TRUE(tells(found, fmt::format("$INSUNITS {}: ", code)));
  }
  const ImportedJoints in_metres = read_dxf(drawing(square, "", in_units(6)), at_origin);
  EXPECT_FALSE(tells(in_metres, "unit") || tells(in_metres, "INSUNITS"));
  for (const std::string& header : {std::string(), in_units(0)}) {
    const ImportedJoints none = read_dxf(drawing(square, "", header), at_origin);
    EXPECT_EQ(area_of(none.joints[0]), area_of(in_metres.joints[0]));
    EXPECT_TRUE(tells(none, "states no unit of length"));
  }
  for (const int code : {18, 20, 25, -1, 99})
    expect_refusal(read_dxf, drawing(square, "", in_units(code)), fmt::format("$INSUNITS = '{}'", code));
}

// ---- fractures

// keys and values with any blanks around `=`
std::string fractures(const std::string& equals, const std::string& unit, const std::string& more = "",
                      const std::string& set = "2", const std::string& name = "\"NS steep\"") {
  return fmt::format(
      "BEGIN FORMAT\n  Format{0}Ascii\n  Length_Unit{0}{1}\n  XAxis{0}East\n  No_Fractures{0}1\n{2}END FORMAT\n"
      "BEGIN SETS\n  Set1{0}\"bedding\"\n  Set2{0}{4}\nEND SETS\n"
      "BEGIN FRACTURE\n  1 4 {3} 1e-12\n  1 0 0 0\n  2 4 0 0\n  3 4 4 2\n  4 0 4 2\n  0 0 -0.447213595 0.894427191\n"
      "END FRACTURE\n",
      equals, unit, more, set, name);
}

TEST(ImportFractures, BlanksAroundAnEqualsSignChangeNothing) {
  const std::map<std::string, double> metres{{"Meter", 1},         {"metres", 1},   {"m", 1},     {"Feet", 0.3048},
                                             {"FOOT", 0.3048},     {"ft", 0.3048},  {"cm", 0.01}, {"Kilometers", 1000},
                                             {"\"Feet\"", 0.3048}, {"inch", 0.0254}};
  const double area = 4 * std::hypot(4, 2);  // of the file's own unit
  for (const std::string equals : {"=", " =", "= ", "    =    ", "\t=\t"}) {
    for (const auto& [name, unit] : metres) {
      const ImportedJoints found = read_fab(fractures(equals, name), at_origin);
      EXPECT_NEAR(area_of(found.joints[0]), area * unit * unit, area * unit * unit * 1e-9) << equals << name;
      EXPECT_EQ(tells(found, "were converted to m"), unit != 1) << name;
    }
    expect_refusal(read_fab, fractures(equals, "Furlong"), "Length_Unit = 'Furlong'");
    expect_refusal(read_fab, fractures(equals, "Meter", "  Format" + equals + "Binary\n"), "Format = 'Binary'");
    expect_refusal(read_fab, fractures(equals, "Meter", "  XAxis" + equals + "North\n"), "XAxis = 'North'");
    expect_refusal(read_fab, fractures(equals, "Meter", "  No_Fractures" + equals + "2\n"), "No_Fractures = 2");
    for (const char* set : {"2", "2.0", "2.000000e+00"})
      EXPECT_EQ(read_fab(fractures(equals, "Meter", "", set), at_origin).joints[0].set, "NS steep") << set;
    EXPECT_EQ(read_fab(fractures(equals, "Meter", "", "2.0", "NS_steep"), at_origin).joints[0].set, "NS_steep");
    EXPECT_EQ(read_fab(fractures(equals, "Meter", "", "3.0"), at_origin).joints[0].set, "set-3");
  }
  const ImportedJoints found = read_fab(stored("feet_without_blanks.fab"), at_origin);
  EXPECT_NEAR(area_of(found.joints[0]), area * 0.3048 * 0.3048, 1e-9);
  EXPECT_EQ(found.joints[0].set, "NS steep");
  EXPECT_TRUE(tells(found, "Length_Unit = 'Feet': coordinates in feet (0.3048 m) were converted to m"));
  std::string no_unit = fractures("=", "Meter");
  no_unit.erase(no_unit.find("  Length_Unit"), no_unit.find("  XAxis") - no_unit.find("  Length_Unit"));
  EXPECT_TRUE(tells(read_fab(no_unit, at_origin), "states no unit of length"));
}

// ---- traces

std::string traces_in(const std::string& crs, double from = 1000) {
  return fmt::format(
      "{{\"type\": \"FeatureCollection\", {}\"features\": [\n{{\"type\": \"Feature\", \"geometry\": {{\"type\": "
      "\"LineString\", \"coordinates\": [[{}, 0], [{}, 30]]}}}}]}}",
      crs, from, from + 40);
}

std::vector<std::string> spellings(const std::string& authority, int code) {
  const auto named = [](const std::string& name) {
    return "\"crs\": {\"type\": \"name\", \"properties\": {\"name\": \"" + name + "\"}}, ";
  };
  std::string lower = authority;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return {named(fmt::format("urn:ogc:def:crs:{}::{}", authority, code)),
          named(fmt::format("urn:ogc:def:crs:{}:6.9:{}", authority, code)),
          named(fmt::format("{}:{}", authority, code)),
          named(fmt::format("{}:{}", lower, code)),
          named(fmt::format("http://www.opengis.net/def/crs/{}/0/{}", authority, code)),
          named(fmt::format("urn:ogc:def:crs,crs:{}::{},crs:EPSG::5701", authority, code)),
          fmt::format("\"crs\": {{\"type\": \"{}\", \"properties\": {{\"code\": {}}}}}, ", authority, code),
          fmt::format("\"crs\": {{\"type\": \"link\", \"properties\": {{\"href\": "
                      "\"http://spatialreference.org/ref/{}/{}/proj4/\", \"type\": \"proj4\"}}}}, ",
                      lower, code)};
}

// Systems and units as EPSG's registry and ESRI's list publish them, one or two of every kind and unit.
TEST(ImportTraces, ReferenceSystemsAreKnownByNumber) {
  struct System {
    const char* authority;
    int code;
    double metres;  // 0: degrees
  };
  const System systems[] = {{"EPSG", 4326, 0},
                            {"EPSG", 4258, 0},
                            {"EPSG", 4269, 0},
                            {"EPSG", 4283, 0},
                            {"EPSG", 4149, 0},
                            {"EPSG", 4979, 0},
                            {"EPSG", 4267, 0},
                            {"EPSG", 7844, 0},
                            {"EPSG", 9057, 0},
                            {"EPSG", 4807, 0},
                            {"EPSG", 25832, 1},
                            {"EPSG", 2056, 1},
                            {"EPSG", 21781, 1},
                            {"EPSG", 27700, 1},
                            {"EPSG", 3857, 1},
                            {"EPSG", 32633, 1},
                            {"EPSG", 31467, 1},
                            {"EPSG", 2263, 1200.0 / 3937},
                            {"EPSG", 2229, 1200.0 / 3937},
                            {"EPSG", 2222, 0.3048},
                            {"EPSG", 2277, 1200.0 / 3937},
                            {"EPSG", 27291, 0.914398414616029},
                            {"EPSG", 3167, 20.116756},
                            {"EPSG", 24371, 0.9143985307444},
                            {"EPSG", 3407, 0.3047972654},
                            {"EPSG", 3366, 1},
                            {"EPSG", 2314, 0.3047972654},
                            {"EPSG", 6318, 0},
                            {"ESRI", 102643, 1200.0 / 3937},
                            {"ESRI", 102100, 1},
                            {"ESRI", 104199, 0}};
  for (const System& system : systems)
    for (const std::string& crs : spellings(system.authority, system.code)) {
      SCOPED_TRACE(crs);
      if (system.metres == 0) {
        expect_refusal(read_traces, traces_in(crs), "longitude and latitude in degrees");
        continue;
      }
      const ImportedJoints found = read_traces(traces_in(crs), at_origin);
      EXPECT_NEAR(found.joints[0].extents[0], 50 * system.metres, 50 * system.metres * 1e-9);
      EXPECT_EQ(tells(found, "were converted to m"), system.metres != 1);
      EXPECT_TRUE(found.warnings.empty());
    }
  expect_refusal(read_traces, stored("traces_degrees.geojson"), "EPSG:4258 is longitude and latitude in degrees");
  expect_refusal(read_traces, traces_in(spellings("EPSG", 4978)[0]), "centre of the earth");
  for (const char* name : {"urn:ogc:def:crs:OGC:1.3:CRS84", "urn:ogc:def:crs:OGC::CRS83"})
    expect_refusal(
        read_traces,
        traces_in(fmt::format("\"crs\": {{\"type\": \"name\", \"properties\": {{\"name\": \"{}\"}}}}, ", name)),
        "degrees");
  for (const char* name : {"EPSG:99999", "EPSG:", "WGS 84", "mine grid", "IGNF:LAMB93"})
    expect_refusal(
        read_traces,
        traces_in(fmt::format("\"crs\": {{\"type\": \"name\", \"properties\": {{\"name\": \"{}\"}}}}, ", name)),
        "unit is not known");
}

// all systems that EPSG lists as geographic in two dimensions are in degrees, and no number is in two groups
TEST(ImportTraces, NoSystemHasTwoUnits) {
  std::map<std::pair<std::string_view, long long>, int> seen;
  std::map<SystemKind, int> count;
  for (std::size_t g = 0; g < system_group_count; ++g) {
    std::istringstream words{std::string(system_groups[g].codes)};
    for (std::string word; words >> word;) {
      const std::size_t dash = word.find('-');
      const long long first = std::stoll(word),
                      last = dash == std::string::npos ? first : std::stoll(word.substr(dash + 1));
      for (long long code = first; code <= last; ++code) {
        EXPECT_EQ(++seen[std::pair(system_groups[g].authority, code)], 1) << code;
        ++count[system_groups[g].kind];
        EXPECT_EQ(reference_system(system_groups[g].authority, code), &system_groups[g]) << code;
      }
    }
  }
  EXPECT_GT(count[SystemKind::geographic], 1300);
  EXPECT_GT(count[SystemKind::projected], 7000);
  EXPECT_EQ(reference_system("EPSG", 0), nullptr);
  EXPECT_EQ(reference_system("OGC", 4326), nullptr);
}

TEST(ImportTraces, WithoutASystemDegreesAreSuspected) {
  shapes::Random random(13);
  for (int trial = 0; trial < 100; ++trial) {
    const double from = shapes::power_of_ten(random, 0, 4) * (trial % 2 ? 1 : -1);
    const bool may_be_degrees = std::abs(from) <= 180 && std::abs(from + 40) <= 180;
    const ImportedJoints found = read_traces(traces_in("", from), {1e6, 1e6, 0});
    EXPECT_TRUE(tells(found, "states no unit of length"));
    EXPECT_EQ(found.warnings.size(), may_be_degrees ? 1u : 0u) << from;
  }
}

class ImportWarns : public Program {};

TEST_F(ImportWarns, OfDegreesAndPrintsZeroAsZero) {
  write("t.geojson", traces_in("", 8));
  const Ended ended = run("import t.geojson --as traces --out joints.csv");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.err.find("voussoir: warning: t.geojson: the file names no reference system"), std::string::npos)
      << ended.err;
  // corners of a tilted plane come back as 0 within rounding
  shapes::Random random(14);
  for (int trial = 0; trial < 10; ++trial) {
    const double a = shapes::uniform(random, 1, 9), b = shapes::uniform(random, 1, 9);
    write("t.dxf",
          drawing(fmt::format("0\n3DFACE\n10\n0\n20\n0\n30\n0\n11\n{0}\n21\n0\n31\n0\n12\n{0}\n22\n{1}\n32\n{2}"
                              "\n13\n0\n23\n{1}\n33\n{2}\n",
                              a, b, a + b)));
    const Ended drawn = run("import t.dxf --as dxf --out joints.csv --overwrite");
    EXPECT_EQ(drawn.code, 0) << drawn.err;
    EXPECT_NE(drawn.out.find("box: x 0 to "), std::string::npos) << drawn.out;
    EXPECT_NE(drawn.out.find(", y 0 to "), std::string::npos) << drawn.out;
    EXPECT_NE(drawn.out.find(", z 0 to "), std::string::npos) << drawn.out;
    EXPECT_NE(drawn.out.find("out of plane: at most 0 m"), std::string::npos) << drawn.out;
  }
}

}  // namespace
}  // namespace voussoir::import_units_test
