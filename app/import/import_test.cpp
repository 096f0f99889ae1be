// `voussoir import`: joints of other programs' files as tables for slicing.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "app/import/formats.hpp"
#include "app/testing/program.hpp"
#include "text/angle.hpp"
#include "text/plain_text.hpp"

namespace voussoir::import_test {
namespace {

using namespace program;

const Vector<3> no_shift = Vector<3>::Zero();

std::string sample(const std::string& name) {
  return read(scenes / "import" / name);
}

std::string scene_of(int dimension, const std::string& low, const std::string& high) {
  return fmt::format(
      "dimension = {0}\ndensity = 2600\njoints_file = \"joints.csv\"\ndomain = {{ box = {{ min = {1}, max = {2} }} }}\n"
      "joint_properties = [{{ name = \"rock\", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 30 }}]\n"
      "stage = [{{ name = \"settle\", kind = \"settle\" }}]\n",
      dimension, low, high);
}

const std::string box_scene = scene_of(3, "[0, 0, 0]", "[10, 10, 10]");

std::vector<double> volumes(const std::string& blocks) {
  std::vector<double> all;
  const std::vector<std::string> lines = lines_of(blocks);
  for (std::size_t k = 1; k < lines.size(); ++k) {
    std::istringstream stream(lines[k]);
    std::string cell;
    for (int column = 0; column < 3; ++column)
      std::getline(stream, cell, ',');
    all.push_back(std::stod(cell));
  }
  return all;
}

// fractures as FracMan writes them: hexagons along a spiral, far beyond any symmetry
std::string network(int fractures) {
  std::string text =
      fmt::format("BEGIN FORMAT\n    Format = Ascii\n    No_Fractures = {}\nEND FORMAT\nBEGIN FRACTURE\n", fractures);
  for (int k = 1; k <= fractures; ++k) {
    const Vector<3> normal = Vector<3>(std::sin(0.7 * k), std::cos(1.1 * k), 1.2 + std::sin(0.3 * k)).normalized();
    const PlaneAxes<3> axes = plane_axes(normal);
    const Vector<3> centre(std::sin(1.3 * k) * 20, std::cos(0.9 * k) * 20, std::sin(2.1 * k) * 20);
    text += fmt::format("    {}    6    1    1e-006\n", k);
    for (int corner = 0; corner < 6; ++corner) {
      const double angle = 60 * degree * corner;
      const Vector<3> p = centre + axes * Vector<2>(4 * std::cos(angle), 4 * std::sin(angle));
      text += fmt::format("    {}    {:.10g}    {:.10g}    {:.10g}\n", corner + 1, p[0], p[1], p[2]);
    }
    text += fmt::format("    0    {:.10g}    {:.10g}    {:.10g}\n", normal[0], normal[1], normal[2]);
  }
  return text + "END FRACTURE\n";
}

class Import : public Program {
 protected:
  Ended import(const std::string& file, const std::string& arguments) const {
    return run(
        fmt::format("import '{}' --out joints.csv --overwrite {}", (scenes / "import" / file).string(), arguments));
  }
  std::string blocks(const std::string& scene) const {
    write("scene.toml", scene);
    const Ended sliced = run("slice scene.toml --out out --overwrite");
    EXPECT_EQ(sliced.code, 0) << sliced.err;
    return read(folder_ / "out/blocks.csv");
  }
};

void expect_plane(const JointRow& joint, double dip, double direction, double slack) {
  EXPECT_NEAR(*joint.dip_deg, dip, slack) << joint.name;
  EXPECT_NEAR(*joint.dip_direction_deg, direction, slack) << joint.name;
}

TEST(ImportFormats, FracturesAreWhereTheFileStates) {
  const ImportedJoints found = read_fab(sample("network.fab"), no_shift);
  ASSERT_EQ(found.joints.size(), 4u);
  const std::array<std::array<double, 2>, 4> planes{{{0, 0}, {4, 100}, {85, 95}, {88, 280}}};
  for (std::size_t k = 1; k < 4; ++k)
    expect_plane(found.joints[k], planes[k][0], planes[k][1], 1e-6);
  EXPECT_NEAR(*found.joints[0].dip_deg, 0, 1e-6);
  EXPECT_EQ(found.joints[0].set, "bedding");
  EXPECT_EQ(found.joints[3].set, "steep joints");
  EXPECT_EQ(found.joints[3].name, "fracture-4");
  EXPECT_EQ(found.joints[2].corners.size(), 5u);
  EXPECT_NEAR(found.joints[1].point[2], 6.5, 1e-8);
  for (const auto& distance : found.out_of_plane)
    EXPECT_LT(*distance, 1e-8);  // ten digits of coordinates below 20 m
  ASSERT_EQ(found.dropped.size(), 2u);
}

TEST(ImportFormats, DrawingsAreFittedByPlanes) {
  const ImportedJoints found = read_dxf(sample("drawing.dxf"), no_shift);
  ASSERT_EQ(found.joints.size(), 4u);
  expect_plane(found.joints[0], 2, 90, 1e-4);  // six decimals over 15 m
  EXPECT_EQ(found.joints[1].corners.size(), 3u);
  EXPECT_EQ(found.joints[0].set, "bedding");
  EXPECT_EQ(found.joints[2].set, "J-1");  // a layer J.1, whose point no name may hold
  // every other corner of a hexagon is raised by 20 mm, so that all deviate by 10 mm cos 85 from the mean plane
  EXPECT_NEAR(*found.out_of_plane[2], 0.01 * std::cos(85 * degree), 2e-6);
  // drawn in the plane x = 7
  expect_plane(found.joints[3], 90, 90, 1e-9);
  for (const std::vector<double>& corner : found.joints[3].corners)
    EXPECT_NEAR(corner[0], 7, 1e-12);
  EXPECT_EQ(found.dropped.size(), 2u);
}

TEST(ImportFormats, TracesAreSegments) {
  const ImportedJoints found = read_traces(sample("traces.geojson"), {10, 20, 0});
  ASSERT_EQ(found.joints.size(), 5u);
  EXPECT_NEAR(found.joints[0].extents[0], std::hypot(12, 0.5), 1e-12);
  EXPECT_NEAR(*found.joints[0].dip_deg, std::atan2(0.5, 12) / degree, 1e-12);
  EXPECT_EQ(*found.joints[0].dip_direction_deg, 270);
  EXPECT_EQ(found.joints[0].point, (std::vector<double>{15, 23.25}));
  EXPECT_EQ(found.joints[1].set, "2");
  EXPECT_EQ(found.joints[2].name, "trace-2-2");
  EXPECT_EQ(*found.joints[3].dip_deg, 90);
  EXPECT_EQ(found.dropped.size(), 3u);
}

TEST(ImportFormats, FacetsAreEllipsesOrTheirHulls) {
  const ImportedJoints found = read_facets(sample("facets.csv"), no_shift);
  ASSERT_EQ(found.joints.size(), 4u);
  expect_plane(found.joints[0], 40.3, 129.6,
               1e-3);  // from the normal's six digits, not from Dip and Dip dir. in whole degrees
  EXPECT_EQ(found.joints[0].set, "family-1");
  EXPECT_EQ(found.joints[0].corners.size(), 6u);  // of seven, one is a notch
  EXPECT_EQ(found.joints[1].shape, OutlineForm::ellipse);
  EXPECT_EQ(found.joints[1].extents, (std::vector<double>{18, 16}));
}

bool remarks(const ImportedJoints& found, const std::string& part) {
  return std::any_of(found.remarks.begin(), found.remarks.end(),
                     [&](const std::string& remark) { return remark.find(part) != std::string::npos; });
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(ImportFormats, ChangedDataAreReported) {
  const std::string drawing = sample("drawing.dxf");
  EXPECT_FALSE(remarks(read_dxf(drawing, no_shift), "$INSUNITS"));
  EXPECT_TRUE(
      remarks(read_dxf(replaced(drawing, "$INSUNITS\n 70\n6\n", "$INSUNITS\n 70\n4\n"), no_shift), "$INSUNITS 4"));
  EXPECT_TRUE(remarks(read_dxf(replaced(drawing, "-4.5\n", "-4.5\n 42\n0.5\n"), no_shift), "1 arcs"));
  const ImportedJoints mesh = read_dxf(replaced(drawing, " 70\n9\n", " 70\n64\n"), no_shift);
  EXPECT_EQ(mesh.joints.size(), 3u);
  ASSERT_EQ(mesh.dropped.size(), 3u);
  EXPECT_NE(mesh.dropped[0].reason.find("a mesh"), std::string::npos);

  const std::string fractures = sample("network.fab");
  EXPECT_FALSE(remarks(read_fab(fractures, no_shift), "stated normals"));
  EXPECT_TRUE(remarks(read_fab(replaced(fractures, "    0    0    0    1\n", "    0    1    0    0\n"), no_shift),
                      "1 stated normals"));
  EXPECT_TRUE(remarks(read_facets(sample("facets.csv"), no_shift), "2 outlines are not convex"));
}

// the least-squares plane of corners moved off a known plane by a pattern without a moment about it
TEST(ImportFormats, FittedPlaneLeavesNoMoment) {
  const Vector<3> normal = Vector<3>(0.3, -0.5, 0.8).normalized();
  const PlaneAxes<3> axes = plane_axes(normal);
  std::vector<Vector<3>> points;
  for (int x = -1; x <= 1; x += 2)
    for (int y = -1; y <= 1; y += 2)
      points.push_back(Vector<3>(1e6, -2e6, 500) + axes * Vector<2>(3 * x, 2 * y) + 0.1 * x * y * normal);
  const auto plane = fitted_plane(points);
  ASSERT_TRUE(plane);
  EXPECT_LT(plane->normal.cross(normal).norm(), 1e-8);  // coordinates are rounded to 1e-10 m
  EXPECT_FALSE(fitted_plane({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}));
  EXPECT_FALSE(fitted_plane({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}));
}

TEST(ImportFormats, WorkIsLinearInTheFileSize) {
  const auto work = [](int fractures) {
    const ImportedJoints found = read_fab(network(fractures), no_shift);
    EXPECT_EQ(found.joints.size(), static_cast<std::size_t>(fractures));
    return found.work;
  };
  EXPECT_EQ(work(1000), 7 * 1000);  // six corners and one name each
  EXPECT_EQ(work(2000), 7 * 2000);
}

TEST_F(Import, ThousandFracturesCutADomain) {
  write("network.fab", network(1000));
  const Ended ended = run("import network.fab --as fab --out joints.csv");
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("joints: 1000, 3-D"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("page: joints_report.html"), std::string::npos) << ended.out;
  EXPECT_TRUE(
      read(folder_ / "joints_report.html").starts_with("<!doctype html>"));  // poles: viewer/test/report_test.mjs
  const std::vector<double> parts = volumes(blocks(scene_of(3, "[-1, -1, -1]", "[1, 1, 1]")));
  EXPECT_GT(parts.size(), 1u);
  double sum = 0;
  for (const double volume : parts)
    sum += volume;
  EXPECT_NEAR(sum, 8, 1e-9);
}

TEST_F(Import, EveryFormatCuts) {
  for (const auto& [file, format, dimension] : {std::tuple{"facets.csv", "facets", 3},
                                                {"network.fab", "fab", 3},
                                                {"drawing.dxf", "dxf", 3},
                                                {"traces.geojson", "traces", 2}}) {
    const Ended ended = import(file, fmt::format("--as {}", format));
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_NE(ended.out.find("box: x "), std::string::npos) << ended.out;
    const auto parts = volumes(blocks(dimension == 3 ? box_scene : scene_of(2, "[0, 0]", "[10, 10]")));
    EXPECT_GE(parts.size(), 9u) << file;  // four joints, two and two across each other, leave nine blocks or more
  }
}

TEST_F(Import, GlobalShiftChangesNoBlock) {
  ASSERT_EQ(import("facets.csv", "--as facets").code, 0);
  const std::vector<double> local = volumes(blocks(box_scene));
  ASSERT_GT(local.size(), 4u);
  const auto expect_same = [&](const std::vector<double>& shifted, double slack) {
    ASSERT_EQ(shifted.size(), local.size());
    for (std::size_t k = 0; k < local.size(); ++k)
      EXPECT_NEAR(shifted[k], local[k], slack);
  };
  const Ended back = import("facets_shifted.csv", "--as facets --shift=-458000,-5210000,-900");
  ASSERT_EQ(back.code, 0) << back.err;
  EXPECT_NE(back.out.find("global shift 458000, 5210000, 900 m"), std::string::npos) << back.out;
  expect_same(volumes(blocks(box_scene)), 0);
  // in place: coordinates of 5e6 m are rounded to 1e-9 m, over faces of 300 m²
  ASSERT_EQ(import("facets_shifted.csv", "--as facets").code, 0);
  expect_same(volumes(blocks(scene_of(3, "[458000, 5210000, 900]", "[458010, 5210010, 910]"))), 1e-6);
}

TEST_F(Import, ReportListsDroppedEntities) {
  const Ended ended = import("network.fab", "--as fab");
  EXPECT_NE(ended.out.find("dropped: 2\n"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("  1 for a tessellated fracture"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("line 49"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("out of plane: at most "), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("bedding                         2      2.0"), std::string::npos) << ended.out;
}

TEST_F(Import, DamagedFilesAreRefusedInOneLine) {
  expect_one_line(import("facets_damaged.csv", "--as facets"), 2, "facets_damaged.csv:3: the row has 11 cells");
  expect_one_line(import("network_damaged.fab", "--as fab"), 2, "network_damaged.fab:25:5: number of the corner");
  expect_one_line(import("drawing_damaged.dxf", "--as dxf"), 2,
                  "drawing_damaged.dxf:21: '20.000000' is in the place of");
  expect_one_line(import("traces_damaged.geojson", "--as traces"), 2, "traces_damaged.geojson:7: is no JSON");
  EXPECT_TRUE(folder_is_empty());
  const auto traces = [&](const std::string& coordinates, const std::string& refusal) {
    write("file.geojson",
          "{\"type\": \"FeatureCollection\", \"features\": [\n{\"type\": \"Feature\", \"geometry\":\n"
          "{\"type\": \"LineString\", \"coordinates\": " +
              coordinates + "}}]}");
    expect_one_line(run("import file.geojson --as traces --out joints.csv"), 2, refusal);
    fs::remove(folder_ / "file.geojson");
  };
  traces("[[0, 0], [1]]", "file.geojson:2: coordinates.2: a point is a list of two numbers");
  traces("[[0, 0], [1e13, 0]]", "file.geojson:2: the coordinate exceeds 1e12 m");
  traces("[[0, 0], [1e400, 0]]", "file.geojson:3: has a number too large");
  traces("[[0, 0], [0, 0]]", "file.geojson:2: has no usable joint");
  EXPECT_TRUE(folder_is_empty());
  // a file of a different kind
  for (const char* format : {"facets", "fab", "dxf", "traces"})
    expect_one_line(run("import " + squares_ + "--out joints.csv --as " + format), 2, "two_squares.toml");
  expect_one_line(run("import none.fab --out joints.csv --as fab"), 2, "none.fab");
  expect_one_line(import("network.fab", "--as fab --shift=1,2"), 2, "--shift");
}

TEST_F(Import, EveryTruncationIsRefusedOrReported) {
  const auto ends_well = [](const std::string& text, const auto& read) {
    for (std::size_t length = 0; length < text.size(); length += 7) {
      try {
        read(std::string_view(text).substr(0, length), no_shift);
      } catch (const FileFault& fault) {
        EXPECT_FALSE(text_fault(fault.what())) << fault.what();
      }
    }
  };
  ends_well(sample("facets.csv"), read_facets);
  ends_well(sample("network.fab"), read_fab);
  ends_well(sample("drawing.dxf"), read_dxf);
  ends_well(sample("traces.geojson"), read_traces);
}

TEST_F(Import, ReplacesNothingUnasked) {
  write("joints.csv", "mine");
  const std::string file = "'" + (scenes / "import/network.fab").string() + "'";
  expect_one_line(run("import " + file + " --as fab --out joints.csv"), 2, "--overwrite");
  EXPECT_EQ(read(folder_ / "joints.csv"), "mine");
  write("own.fab", sample("network.fab"));
  expect_one_line(run("import own.fab --as fab --out own.fab --overwrite"), 2, "is read by this command");
  EXPECT_EQ(read(folder_ / "own.fab"), sample("network.fab"));
}

TEST(ImportFormats, NamesExchangedColumns) {
  std::string text = sample("facets.csv");
  text.replace(text.find("Dip dir."), 8, "Dip");
  text.replace(text.rfind(" Dip;", text.find('\n')), 5, " Dip dir.;");
  try {
    read_facets(text, no_shift);
    FAIL() << "accepted";
  } catch (const FileFault& fault) {
    EXPECT_EQ(fault.line, 2);
    EXPECT_NE(std::string(fault.what()).find("exchanged"), std::string::npos) << fault.what();
  }
}

}  // namespace
}  // namespace voussoir::import_test
