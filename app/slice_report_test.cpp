// `voussoir slice` with its report and its formats, as users meet it.
#include <gtest/gtest.h>

#include "app/testing/program.hpp"

namespace voussoir {
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
}  // namespace voussoir
