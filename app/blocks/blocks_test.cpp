// `voussoir blocks`: the table, the files, loads and refusals.
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/testing/program.hpp"
#include "core/testing/dxf_drawing.hpp"
#include "text/angle.hpp"
#include "text/csv_table.hpp"

namespace voussoir::blocks_test {
namespace {

using namespace program;

std::string quoted(const char* scene) {
  return "'" + (fs::path(VOUSSOIR_SOURCE_DIR) / scene).string() + "' ";
}

// cells of a column by rows
std::vector<std::string> column(const fs::path& file, const std::string& name) {
  const std::string text = read(file);
  CsvReader reader(text);
  const std::size_t place = reader.find(name).value();
  std::vector<std::string> cells;
  for (CsvRow row; reader.next(row);)
    cells.push_back(row.cells[place].text);
  return cells;
}

TEST_F(Program, BlocksNamesABlockThatNeedsNoFrictionButTopples) {
  write("lean.toml", R"(dimension = 2
gravity = [0, -9.81]
density = 2600
blocks = [
  { name = "floor", box = { min = [-2, -1], max = [9, 0] }, fixed = true },
  { name = "leans", vertices = [[0, 0], [1, 0], [3, 1], [2, 1]] },
  { name = "stands", vertices = [[5, 0], [6, 0], [6.5, 1], [5.5, 1]] },
]
[[joint_properties]]
name = "rock"
normal_stiffness = 1e9
shear_stiffness = 1e9
friction_deg = 40
[[stage]]
name = "settle"
kind = "settle"
)");
  const Ended ended = run("blocks lean.toml --out out");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("stable without friction as they slide, but with moments below 1.5: 0 (at most 0)\n"),
            std::string::npos)
      << ended.out;
  EXPECT_EQ(column(folder_ / "out/blocks_verdicts.csv", "factor_moments"), (std::vector<std::string>{"0", "inf"}));
}

TEST_F(Program, BlocksFindsThePairOfTheTutorial) {
  const Ended ended =
      run("blocks " + quoted("examples/tutorial/slope.toml") + "--out out --required 1.3 --dxf --section 90/90/-3/0/0");
  EXPECT_EQ(ended.code, 0) << ended.err;
  for (const char* part : {"stage \"safety\": clay 29 deg, rough 41 deg", "38.0/169.1   1.0694  68.4 (-5.1/003.1)",
                           "lower than its blocks", "least factor 1.0694 (cluster 2+5)", "elastic shear closes B1"})
    EXPECT_NE(ended.out.find(part), std::string::npos) << part << "\n" << ended.out;
  EXPECT_TRUE(fs::exists(folder_ / "out/blocks.vtp"));
  const std::string map = read(folder_ / "out/key_blocks.geojson");
  EXPECT_NE(map.find("\"blocks\": \"2+5\""), std::string::npos);
  EXPECT_EQ(map.find("\"blocks\": \"2\""), std::string::npos) << "its factor is 23";
  const fs::path table = folder_ / "out/blocks_verdicts.csv";
  const std::vector<test::DxfEntity> drawing = test::read_drawing(read(folder_ / "out/blocks.dxf"));
  EXPECT_NEAR(volume_on(drawing, "KEY_BLOCKS"), std::stod(column(table, "volume_m3").at(2)), 1e-9);
  const std::vector<test::DxfEntity> section = test::read_drawing(read(folder_ / "out/section.dxf"));
  EXPECT_FALSE(points_on(section, "POLYLINE", "KEY_BLOCKS").empty());
  EXPECT_FALSE(points_on(section, "POLYLINE", "FIXED_BLOCKS").empty());
  EXPECT_EQ(column(table, "blocks"), (std::vector<std::string>{"2", "5", "2 5"}));
  EXPECT_EQ(column(table, "joints"), (std::vector<std::string>{"A1;A2", "A2;B1", "A1;B1"}));
  EXPECT_NEAR(std::stod(column(table, "factor").at(2)), 1.069448089900, 1e-11);
  EXPECT_EQ(column(table, "type"), (std::vector<std::string>{"II", "I", "I"}));
  expect_one_line(run("blocks " + quoted("examples/tutorial/slope.toml") + "--out out"), 2, "--overwrite");
  // a goal, another strength, and a factor that it reaches
  const std::string again = "blocks " + quoted("examples/tutorial/slope.toml") + "--out out --overwrite ";
  EXPECT_EQ(run(again + "--fail-below 1.1").code, 1);
  EXPECT_EQ(run(again + "--fail-below 1.05").code, 0);
  EXPECT_EQ(run(again + "--strength-of weight").code, 0);
  EXPECT_GT(std::stod(column(table, "factor").at(1)), 4);
  EXPECT_EQ(column(table, "factor").size(), 2u) << "with equal friction no pair is lower than its blocks";
}

TEST_F(Program, BlocksInAnEarthquakeAndWithABolt) {
  const std::string scene = "blocks " + quoted("examples/tutorial/slope.toml") + "--overwrite --out out ";
  const fs::path table = folder_ / "out/blocks_verdicts.csv";
  ASSERT_EQ(run(scene + "--seismic 0.1 --bolt 10/3 --required 1.3").code, 0);
  const double worst = std::stod(column(table, "factor_worst").at(2)),
               along = std::stod(column(table, "factor_own_trend").at(2));
  EXPECT_LE(worst, along);
  EXPECT_LT(along, 1.069448);
  EXPECT_NEAR(std::stod(column(table, "factor").at(2)), 1.069448089900, 1e-11) << "verdicts are those without it";
  const double critical = std::stod(column(table, "critical_coefficient").at(2));
  EXPECT_GT(std::stod(column(table, "bolt_force_N").at(2)), 68401.198);
  // in the worst direction, as part of every verdict
  const std::string trend = column(table, "worst_trend_deg").at(2);
  ASSERT_EQ(run(scene + "--seismic 0.1/" + trend).code, 0);
  EXPECT_NEAR(std::stod(column(table, "factor").at(2)), worst, 1e-9);
  EXPECT_EQ(run(scene + "--fail-below 1 --seismic " + std::to_string(1.01 * critical)).code, 0);
  EXPECT_EQ(run(scene + "--seismic 0.1/150 --seismic-vertical 0.05").code, 0);
  expect_one_line(run(scene + "--seismic 0.1/"), 2, "for example 0.12 or 0.12/180");
  expect_one_line(run(scene + "--seismic 0.1/400"), 2, "from 0 to 360");
  expect_one_line(run(scene + "--seismic 11"), 2, "from 0 to 10");
  expect_one_line(run(scene + "--seismic-vertical -0.1"), 2, "vertical seismic coefficient -0.1 is not from 0 to 10");
  expect_one_line(run(scene + "--required nan"), 2, "required factor of safety nan");
  EXPECT_EQ(run(scene + "--seismic 0.1/360").code, 0);
  expect_one_line(run(scene + "--bolt 10"), 2, "plunge/trend");
  expect_one_line(run(scene + "--bolt 95/10"), 2, "from -90 to 90");
}

// closed form 0.841: cohesion counts, and water on both faces
TEST_F(Program, BlocksInThePlane) {
  const Ended ended = run("blocks " + quoted("examples/wet_slope.toml") + "--out out");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("joint 38 deg and 20 kPa"), std::string::npos) << ended.out;
  EXPECT_NEAR(std::stod(column(folder_ / "out/blocks_verdicts.csv", "factor").at(0)), 0.841, 5e-4);
  EXPECT_LT(std::stod(column(folder_ / "out/blocks_verdicts.csv", "critical_water").at(0)), 1);
  EXPECT_EQ(column(folder_ / "out/blocks_verdicts.csv", "critical_level_m").at(0), "") << "its surface slopes";
}

TEST_F(Program, BlocksOfABench) {
  const Ended ended = run("blocks " + quoted("cases/slicing/bench.toml") + "--out out --frictionless");
  EXPECT_EQ(ended.code, 0) << ended.err;
  for (const char* part :
       {"1543", "6 blocks", "8 blocks, 0.702957 m3, in 3 rounds of 6, 1, 1", "446 blocks, 85.8596 m3", "27 blocks",
        "6886 pairs of free neighbours, 55 move as one, none lower"})
    EXPECT_NE(ended.out.find(part), std::string::npos) << part << "\n" << ended.out;
}

// the tunnel opens its roof: the wedge falls, and two bolts of 150 kN hold 48.15 kN
TEST_F(Program, BlocksAfterAStageWithBolts) {
  const std::string scene = "blocks " + quoted("examples/bolted_roof.toml") + "--overwrite --out out ";
  const fs::path table = folder_ / "out/blocks_verdicts.csv";
  ASSERT_EQ(run(scene + "--after tunnel").code, 0);
  EXPECT_EQ(column(table, "verdict").at(0), "falls");
  EXPECT_EQ(column(table, "bolts").at(0), "roof-1;roof-2");
  EXPECT_NEAR(std::stod(column(table, "factor").at(0)), 300 / 48.15, 1e-2);
  EXPECT_NEAR(std::stod(column(table, "factor_passive").at(0)), 300 / 48.15, 1e-2);
  ASSERT_EQ(run(scene + "--after rock").code, 0);
  EXPECT_EQ(column(table, "verdict").at(0), "enclosed") << "by the rock of the tunnel";
}

TEST_F(Program, BlocksCountsTheZonesOfAFace) {
  const std::string scene = "blocks " + quoted("examples/tutorial/slope.toml") + "--out out --kinematics ";
  expect_one_line(run(scene), 2, "needs --face");
  expect_one_line(run(scene + "--face 70"), 2, "dip/dip direction");
  expect_one_line(run(scene + "--face 70/170"), 2, "friction from 29 to 41 deg");
  const Ended ended = run(scene + "--face 70/170 --friction 29");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("kinematic analysis of 4 joints: face 70/170, friction 29 deg"), std::string::npos)
      << ended.out;
  EXPECT_NE(ended.out.find("stereonets: voussoir report out\n"), std::string::npos) << ended.out;
  const nlohmann::json drawn = nlohmann::json::parse(read(folder_ / "out/kinematics.json"));
  EXPECT_EQ(drawn.at("joints").size(), 4u);
  EXPECT_EQ(drawn.at("joints").at(0).at("set"), "J1");
  EXPECT_NEAR(drawn.at("joints").at(0).at("normal").at(2).get<double>(), std::cos(46 * degree), 1e-12);
  EXPECT_EQ(drawn.at("counts").size(), 14u);
  // degrees as stated: not what is left of 58 in radians, 57.99999999999999
  ASSERT_EQ(run(scene + "--overwrite --face 58/170.3 --friction 30").code, 0);
  const nlohmann::json stated = nlohmann::json::parse(read(folder_ / "out/kinematics.json"));
  EXPECT_EQ(stated.at("face_dip_deg"), 58);
  EXPECT_EQ(stated.at("face_direction_deg"), 170.3);
  EXPECT_EQ(stated.at("friction_deg"), 30);
  EXPECT_EQ(stated.at("limits_deg").at("flexural_toppling"), 30);
  ASSERT_EQ(run(scene + "--overwrite --face 70/170 --friction 29").code, 0);
  const fs::path table = folder_ / "out/kinematic_pairs.csv";
  EXPECT_EQ(column(table, "motion").size(), column(table, "factor").size());
  const std::vector<std::string> first = column(table, "joint_a"), second = column(table, "joint_b");
  for (std::size_t k = 0; k < first.size(); ++k)
    if (first[k] == "A1" && second[k] == "B1")
      EXPECT_NEAR(std::stod(column(table, "line_plunge_deg")[k]), 37.960792, 1e-5);
  EXPECT_NE(std::find(first.begin(), first.end(), "A1"), first.end());
  expect_one_line(
      run("blocks " + quoted("examples/wet_slope.toml") + "--out out --overwrite --kinematics --face 70/90"), 2,
      "directions in space");
  expect_one_line(run("blocks " + quoted("examples/tutorial/slope.toml") + "--out out --overwrite --face 70/170"), 2,
                  "belong to --kinematics");
}

TEST_F(Program, BlocksShowsItsVerdictsInAPage) {
  write("names.toml",
        "dimension = 3\ngravity = [0, 0, -10]\ndensity = 2000\n"
        "domain = { box = { min = [0, 0, 0], max = [2, 2, 2] } }\n"
        "joint_properties = [{ name = \"r\", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 30 }]\n"
        "joints = [{ name = \"</script><b>\", dip = 45, dip_direction = 90, point = [1, 1, 1] }]\n"
        "fix = [{ below = [\"</script><b>\"] }]\n");
  const std::string scene = "blocks names.toml --out out --overwrite ";
  const Ended ended = run(scene + "--view");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_TRUE(ended.out.ends_with("results: out\npage: out/view.html\n")) << ended.out;
  const std::string html = read(folder_ / "out/view.html"), data = read(folder_ / "out/view.bin");
  EXPECT_NE(html.find("<!doctype html>"), std::string::npos);
  EXPECT_EQ(html.find("</script><b>"), std::string::npos) << "no text of a scene is part of a page";
  for (const char* part : {"as sliced, strength of joint_properties", "It is fixed.",
                           "It slides on one face (</script><b>) towards 45.0/090.0 (plunge/trend), type I: factor of "
                           "safety 0.5774; force for 1.5: "})
    EXPECT_NE(data.find(part), std::string::npos) << part;
  EXPECT_EQ(run(scene).code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "out/view.html")) << "its verdicts would be older than the table";
  expect_one_line(run(scene + "--view --kinematics --face 70/90"), 2, "leave out one of the two");
}

// a cube of 1 m on a plane of 45 degrees: σ = ρ g h cos 45°
TEST_F(Program, BlocksFollowTheEnvelopeOfBartonAndBandis) {
  write("cube.toml",
        "dimension = 3\ngravity = [7.0710678118654755, 0, -7.0710678118654755]\ndensity = 2000\n"
        "blocks = [{ name = \"base\", box = { min = [-2, -2, -1], max = [2, 2, 0] }, fixed = true },\n"
        "          { name = \"cube\", box = { min = [0, 0, 0], max = [1, 1, 1] } }]\n"
        "joint_properties = [{ name = \"r\", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 26, "
        "friction_law = \"barton_bandis\", jrc = 7, jcs = 40e6 }]\n");
  const Ended ended = run("blocks cube.toml --out out");
  EXPECT_EQ(ended.code, 0) << ended.err;
  const double stress = 20000 * std::sqrt(0.5);
  const double factor = std::tan((26 + 7 * std::log10(40e6 / stress)) * degree);
  EXPECT_NEAR(std::stod(column(folder_ / "out/blocks_verdicts.csv", "factor").at(0)), factor, 1e-9);
  const nlohmann::json face =
      nlohmann::json::parse(read(folder_ / "out/blocks_verdicts.json"))["verdicts"][0]["faces"][0];
  EXPECT_NEAR(face["tan_friction"].get<double>(), factor, 1e-9);  // on 45 degrees
  for (const char* part : {"roughness (JRC 7, JCS 40 MPa)", "peak envelope"})
    EXPECT_NE(ended.out.find(part), std::string::npos) << part << "\n" << ended.out;
}

// c A + W cos ψ tan φ = W sin ψ of one slab, whatever friction a stage states
TEST_F(Program, BackAnalysisOfASlabIsItsStraightLine) {
  std::string scene = read(fs::path(VOUSSOIR_SOURCE_DIR) / "cases/reliability/slab.toml");
  scene +=
      "\n[[stage]]\nname = \"safety\"\nkind = \"reduce\"\nsearch = \"factor\"\nfriction_deg = 30\nfrom_factor = 0.5\n"
      "to_factor = 2\ntolerance_factor = 0.01\n";
  write("slab.toml", scene);
  const Ended ended = run("blocks slab.toml --back-analysis joint --out out");
  ASSERT_EQ(ended.code, 0) << ended.err;
  const double dip = 32 * degree, weight = 2650 * 9.81 * 4.5 * 10;
  const std::vector<std::string> frictions = column(folder_ / "out/back_analysis.csv", "friction_deg"),
                                 cohesions = column(folder_ / "out/back_analysis.csv", "cohesion_Pa");
  ASSERT_EQ(frictions.size(), 11u);
  for (std::size_t k = 0; k < frictions.size(); ++k)
    EXPECT_NEAR(std::stod(cohesions[k]),
                weight / 10 * (std::sin(dip) - std::cos(dip) * std::tan(std::stod(frictions[k]) * degree)), 1e-3)
        << frictions[k];
  const nlohmann::json values = results("out")["values"];
  EXPECT_NEAR(values["critical_friction"]["value"].get<double>(), 32, 1e-8);
  EXPECT_NEAR(values["cohesion_without_friction"]["value"].get<double>(), weight / 10 * std::sin(dip), 1e-3);

  expect_one_line(run("blocks slab.toml --back-analysis jont --out bad"), 2, "did you mean 'joint'");
  expect_one_line(run("blocks slab.toml --back-analysis joint --view --out bad"), 2, "leave out one of the two");
}

TEST_F(Program, BlocksRefusesWhatItCannotJudge) {
  expect_one_line(run("blocks " + quoted("examples/tutorial/slope.toml") + "--out out --strength-of wait"), 2,
                  "there are: weight, safety");
  expect_one_line(run("blocks " + quoted("examples/tutorial/slope.toml") + "--out out --after wait"), 2,
                  "--after wait");
  write("fixed.toml",
        "dimension = 3\ngravity = [0, 0, -10]\ndensity = 2000\n"
        "blocks = [{ name = \"base\", box = { min = [0, 0, -1], max = [1, 1, 0] }, fixed = true }]\n"
        "joint_properties = [{ name = \"r\", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 30 }]\n");
  expect_one_line(run("blocks fixed.toml --out out"), 2, "no block is free to move");
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace voussoir::blocks_test
