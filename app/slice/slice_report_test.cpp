// `voussoir slice` with its report and its formats, as users see it.
#include <gtest/gtest.h>

#include <map>

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

class SliceReport : public Program {};

TEST_F(SliceReport, WritesTablesFiguresAndFormats) {
  write("scene.toml", in_space);
  const Ended ended = run("slice scene.toml --out out --report --planes --stl --obj");
  ASSERT_EQ(ended.code, 0) << ended.err;
  const std::string report = read(folder_ / "out/report.md");
  EXPECT_NE(ended.out.find(report), std::string::npos);
  for (const char* part :
       {"# Joints of two sets & a bed", "## A", "## B", "## Blocks", "P32", "P10", "Fisher's constant"})
    EXPECT_NE(report.find(part), std::string::npos) << part;
  for (const char* name : {"out/stereonet.svg", "out/spacing.svg", "out/block_sizes.svg"}) {
    const std::string figure = read(folder_ / name);
    EXPECT_TRUE(figure.starts_with("<svg ") && figure.ends_with("</svg>\n")) << name;
    EXPECT_EQ(figure.find("nan"), std::string::npos) << name;
    EXPECT_EQ(figure.find("inf"), std::string::npos) << name;
  }

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

// how many poles of each colour a stereonet has
std::map<std::string, int> poles_of(const std::string& figure) {
  std::map<std::string, int> poles;
  for (const std::string& line : lines_of(figure))
    if (const std::size_t at = line.find("r=\"2\" fill=\""); at != std::string::npos) ++poles[line.substr(at + 12, 7)];
  return poles;
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
  std::string report = read(folder_ / "out/report.md");
  EXPECT_EQ(report.find("Drawn"), std::string::npos) << report;
  EXPECT_NE(report.find("were not drawn at random"), std::string::npos) << report;
  for (const char* part :
       {"## bedding (stated)", "| joints | 1 | 6 |", "| mean dip | deg | 10.0 |", "| mean dip direction | deg | 90.0 |",
        "## steep (stated)", "| joints | 1 | 4 |", "| mean dip | deg | 90.0 |", "1 joint is stated without a set"})
    EXPECT_NE(report.find(part), std::string::npos) << part << "\n" << report;
  // four squares of 100 m2 in 1000 m3; on every scanline at 2 m
  EXPECT_NE(report.find("| P32, area per volume | 1/m | 0.4 |"), std::string::npos) << report;
  EXPECT_NE(report.find("| spacing along the mean normal | m | 2 |"), std::string::npos) << report;
  std::string net = read(folder_ / "out/stereonet.svg");
  for (const char* part : {">bedding, stated (6)<", ">steep, stated (4)<", ">without a set (1)<"})
    EXPECT_NE(net.find(part), std::string::npos) << part;
  std::map<std::string, int> poles = poles_of(net);
  EXPECT_EQ(poles.size(), 3u);
  EXPECT_EQ(poles["#0072b2"], 6);
  EXPECT_EQ(poles["#d55e00"], 4);

  // together with drawn sets, each is named by its kind
  write("both.toml",
        "base = \"scene.toml\"\n[[joint_sets]]\nname = \"bedding\"\ndip = 30\ndip_direction = 10\nspacing = 3\n");
  ended = run("slice both.toml --out both --report");
  ASSERT_EQ(ended.code, 0) << ended.err;
  report = read(folder_ / "both/report.md");
  for (const char* part : {"Drawn in unbounded rock", "## bedding (stated)", "## bedding\n"})
    EXPECT_NE(report.find(part), std::string::npos) << part;
  EXPECT_EQ(poles_of(read(folder_ / "both/stereonet.svg")).size(), 4u);
}

TEST_F(SliceReport, ReportsFiniteJoints) {
  write("scene.toml", "dimension = 2\ndomain = { box = { min = [0, 0], max = [10, 10] } }\n" + head +
                          "[[joint_sets]]\nname = \"A\"\ndip = 30\ndip_direction = 270\nintensity = 3\nsize = "
                          "\"lognormal\"\nsize_mean = 2\nsize_deviation = 1\n");
  const Ended ended = run("slice scene.toml --out out --report");
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(read(folder_ / "out/report.md").find("mean size of these"), std::string::npos);
  EXPECT_NE(read(folder_ / "out/joints.csv").find(",trace,"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder_ / "out/blocks.csv"));
  expect_one_line(run("slice " + squares_ + "--out out --stl"), 2, "dimension = 2");
}

}  // namespace
}  // namespace voussoir::slice_report_test
