// `voussoir slice` with its report and its formats, as users see it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/testing/program.hpp"

namespace voussoir::slice_report_test {
namespace {

using namespace program;

const std::string head = R"(title = "two sets & a bed"
density = 2600
joint_properties = [{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 30 }]
stage = [{ name = "settle", kind = "settle" }]
)";

const std::string in_space = "dimension = 3\ndomain = { box = { min = [0, 0, 0], max = [10, 10, 10] } }\n" + head +
                             R"([[joints]]
name = "bed"
dip = 0
point = [0, 0, 5]
[[joint_sets]]
name = "A"
dip = 80
dip_direction = 110
spacing = 2
scatter = "fisher"
fisher_constant = 100
[[joint_sets]]
name = "B"
dip = 85
dip_direction = 10
spacing = 2.5
arrangement = "equal"
)";

class SliceReport : public Program {
 protected:
  nlohmann::json joints_of(const std::string& folder) const {
    return nlohmann::json::parse(read(folder_ / folder / "joints.json"));
  }
};

// of a set the row with this quantity
nlohmann::json row_of(const nlohmann::json& set, const std::string& quantity) {
  for (const nlohmann::json& row : set.at("rows"))
    if (row.at("quantity") == quantity) return row;
  return nullptr;
}

// a cumulative curve rises to the whole
void expect_cumulative(const nlohmann::json& curve) {
  ASSERT_FALSE(curve.empty());
  double value = 0, share = 0;
  for (const nlohmann::json& point : curve) {
    EXPECT_GE(point.at(0).get<double>(), value);
    EXPECT_GE(point.at(1).get<double>(), share);
    value = point.at(0), share = point.at(1);
  }
  EXPECT_NEAR(share, 100, 1e-9);
}

TEST_F(SliceReport, WritesTablesPageAndFormats) {
  write("scene.toml", in_space);
  const Ended ended = run("slice scene.toml --out out --report --planes --stl --obj");
  ASSERT_EQ(ended.code, 0) << ended.err;
  for (const char* part :
       {"# Joints of two sets & a bed", "## A", "## B", "## Blocks", "P32", "P10", "Fisher's constant"})
    EXPECT_NE(ended.out.find(part), std::string::npos) << part;
  const nlohmann::json joints = joints_of("out");
  EXPECT_EQ(joints["title"], "Joints of two sets & a bed");
  ASSERT_EQ(joints["sets"].size(), 3u);
  for (const nlohmann::json& set : joints["sets"]) {
    for (const nlohmann::json& normal : set["normals"])
      EXPECT_NEAR(std::hypot(normal[0].get<double>(), normal[1].get<double>(), normal[2].get<double>()), 1, 1e-6);
    if (set["drawn"]) expect_cumulative(set["spacings_m"]);
  }
  expect_cumulative(joints["blocks"]["by_number"]);
  expect_cumulative(joints["blocks"]["by_size"]);

  // the page has the text of a scene as data only, and is made again from the folder
  const std::string page = read(folder_ / "out/report.html");
  EXPECT_TRUE(page.starts_with("<!doctype html>"));
  EXPECT_EQ(page.find("two sets"), std::string::npos);
  ASSERT_EQ(run("report out").code, 0);
  EXPECT_EQ(read(folder_ / "out/report.html"), page);

  // read back: the same blocks from the table of joints, from planes, and from vertices
  const std::string blocks = read(folder_ / "out/blocks.csv");
  const std::string base = in_space.substr(0, in_space.find("[[joints]]"));
  fs::copy_file(folder_ / "out/joints.csv", folder_ / "joints.csv");
  write("joints.toml", "joints_file = \"joints.csv\"\n" + base);
  ASSERT_EQ(run("slice joints.toml --out joints").code, 0);
  EXPECT_EQ(read(folder_ / "joints/blocks.csv"), blocks);
  const std::string without_domain = "dimension = 3\n" + head;
  for (const char* name : {"block_planes.csv", "blocks.obj", "blocks.stl"}) {
    fs::copy_file(folder_ / "out" / name, folder_ / name);
    write("blocks.toml", fmt::format("blocks_file = \"{}\"\n", name) + without_domain);
    const Ended back = run("slice blocks.toml --out back --overwrite");
    ASSERT_EQ(back.code, 0) << name << back.err;
    const auto ours = lines_of(blocks), theirs = lines_of(read(folder_ / "back/blocks.csv"));
    ASSERT_EQ(theirs.size(), ours.size()) << name;
    for (std::size_t i = 1; i < ours.size(); ++i) {
      // columns: body, name, volume, faces, …
      const auto cells = [](const std::string& line) {
        std::istringstream stream(line);
        std::vector<std::string> all;
        for (std::string cell; std::getline(stream, cell, ',');)
          all.push_back(cell);
        return all;
      };
      EXPECT_NEAR(std::stod(cells(theirs[i])[2]), std::stod(cells(ours[i])[2]), 1e-11 * 1000) << name;
      EXPECT_EQ(cells(theirs[i])[3], cells(ours[i])[3]) << name;
    }
  }
}

// joints of a table are judged by its column `set`, and never called drawn
TEST_F(SliceReport, ReportsListedJointsByTheirSet) {
  std::string table = "name,set,x_m,y_m,z_m,dip_deg,dip_direction_deg\n";
  for (int k = 0; k < 6; ++k)
    table += fmt::format("b{0},bedding,5,5,{1},{2},{3}\n", k, 1 + 1.5 * k, 10 + (k % 2 ? 2 : -2), 90);
  for (int k = 0; k < 4; ++k)
    table += fmt::format("s{0},steep,{1},5,5,90,{2}\n", k, 2 + 2 * k, k % 2 ? 270 : 90);
  table += "single,,5,5,5,45,200\n";
  write("joints.csv", table);
  write("scene.toml",
        "joints_file = \"joints.csv\"\ndimension = 3\ndomain = { box = { min = [0, 0, 0], max = [10, 10, 10] } }\n" +
            head);
  Ended ended = run("slice scene.toml --out out --report");
  ASSERT_EQ(ended.code, 0) << ended.err;
  std::string report = ended.out;
  EXPECT_EQ(report.find("Drawn"), std::string::npos) << report;
  EXPECT_NE(report.find("were not drawn at random"), std::string::npos) << report;
  for (const char* part :
       {"## bedding (stated)", "| joints | 1 | 6 |", "| mean dip | deg | 10 |", "| mean dip direction | deg | 90 |",
        "## steep (stated)", "| joints | 1 | 4 |", "| mean dip | deg | 90 |", "1 joint is stated without a set"})
    EXPECT_NE(report.find(part), std::string::npos) << part << "\n" << report;
  // four squares of 100 m2 in 1000 m3; on every scanline at 2 m
  EXPECT_NE(report.find("| P32, area per volume | 1/m | 0.4 |"), std::string::npos) << report;
  EXPECT_NE(report.find("| spacing along the mean normal | m | 2 |"), std::string::npos) << report;
  const nlohmann::json sets = joints_of("out")["sets"];
  const std::pair<const char*, std::size_t> counts[] = {{"bedding", 6}, {"steep", 4}, {"", 1}};
  ASSERT_EQ(sets.size(), std::size(counts));
  for (std::size_t k = 0; k < sets.size(); ++k) {
    EXPECT_EQ(sets[k]["name"], counts[k].first);
    EXPECT_EQ(sets[k]["drawn"], false);
    EXPECT_EQ(sets[k]["normals"].size(), counts[k].second) << counts[k].first;
  }
  EXPECT_NEAR(row_of(sets[1], "P32, area per volume")["measured"].get<double>(), 0.4, 1e-12);
  EXPECT_NEAR(row_of(sets[0], "mean dip")["measured"].get<double>(), 10, 0.1);

  // together with drawn sets, each is named by its kind
  write("both.toml",
        "base = \"scene.toml\"\n[[joint_sets]]\nname = \"bedding\"\ndip = 30\ndip_direction = 10\nspacing = 3\n");
  ended = run("slice both.toml --out both --report");
  ASSERT_EQ(ended.code, 0) << ended.err;
  report = ended.out;
  for (const char* part : {"Drawn in unbounded rock", "## bedding (stated)", "## bedding\n"})
    EXPECT_NE(report.find(part), std::string::npos) << part;
  const nlohmann::json both = joints_of("both")["sets"];
  ASSERT_EQ(both.size(), 4u);
  EXPECT_EQ(both[0]["name"], both[2]["name"]);
  EXPECT_NE(both[0]["drawn"], both[2]["drawn"]);
}

TEST_F(SliceReport, ReportsFiniteJoints) {
  write("scene.toml", "dimension = 2\ndomain = { box = { min = [0, 0], max = [10, 10] } }\n" + head +
                          "[[joint_sets]]\nname = \"A\"\ndip = 30\ndip_direction = 270\nintensity = 3\nsize = "
                          "\"lognormal\"\nsize_mean = 2\nsize_deviation = 1\n");
  const Ended ended = run("slice scene.toml --out out --report");
  ASSERT_EQ(ended.code, 0) << ended.err;
  const nlohmann::json set = joints_of("out").at("sets").at(0);
  EXPECT_EQ(row_of(set, "mean size of these")["stated"], 2);
  EXPECT_GT(row_of(set, "mean size of these")["error"].get<double>(), 0);
  EXPECT_TRUE(row_of(set, "P32, area per volume").is_null() && row_of(set, "P21, length per area").is_object());
  EXPECT_NE(read(folder_ / "out/joints.csv").find(",trace,"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder_ / "out/blocks.csv"));
  expect_one_line(run("slice " + squares_ + "--out out --stl"), 2, "dimension = 2");
}

}  // namespace
}  // namespace voussoir::slice_report_test
