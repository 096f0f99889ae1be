// `--derivatives` of `voussoir blocks` and `voussoir limit`: table, files and refusals.
#include <nlohmann/json.hpp>

#include "app/testing/program.hpp"
#include "text/csv_table.hpp"

namespace voussoir::derivatives_test {
namespace {

using namespace program;

const fs::path root = VOUSSOIR_SOURCE_DIR;

TEST_F(Program, DerivativesOfBlocksAreInItsFiles) {
  const Ended ended =
      run(fmt::format("blocks '{}' --derivatives --out out", (root / "cases/wedge/scene.toml").string()));
  EXPECT_EQ(ended.code, 0) << ended.err;
  for (const char* part : {"what moves least_factor 17.3628 (block 1 slides on A, B)",
                           "all other keys of the scene held", "joints.A.dip", "do not move it: "})
    EXPECT_NE(ended.out.find(part), std::string::npos) << part << "\n" << ended.out;
  const nlohmann::json json = results("out");
  EXPECT_EQ(json["values"]["least_factor"]["unit"], "1");
  const nlohmann::json& derivatives = json["derivatives"];
  EXPECT_EQ(derivatives["of"], "least_factor");
  EXPECT_EQ(derivatives["value"], json["values"]["least_factor"]["value"]);
  ASSERT_EQ(derivatives["keys"].size(), 5u);
  EXPECT_EQ(derivatives["keys"][0]["key"], "joint_properties.rock.friction_deg");
  EXPECT_EQ(derivatives["keys"][0]["unit"], "1 per deg");
  const std::string text = read(folder_ / "out/derivatives.csv");
  CsvReader reader(text);
  int rows = 0;
  for (CsvRow row; reader.next(row); ++rows)
    EXPECT_EQ(row.cells[reader.find("key").value()].text, derivatives["keys"][rows]["key"].get<std::string>());
  EXPECT_EQ(rows, 5);
  const std::string figure = read(folder_ / "out/derivatives.svg");
  EXPECT_NE(figure.find("What moves the least factor, 17.363"), std::string::npos);
  EXPECT_TRUE(figure.ends_with("</svg>\n"));
}

TEST_F(Program, DerivativesOfLimitAreInItsFiles) {
  const Ended ended = run(
      fmt::format("limit '{}' --with-dilation --derivatives --out out", (root / "cases/support/slope.toml").string()));
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("what moves critical_friction_lower_bound 28.4672 deg (1 block moves)"), std::string::npos)
      << ended.out;
  EXPECT_EQ(results("out")["derivatives"]["unit"], "deg");
  EXPECT_TRUE(results("out")["derivatives"]["complete"].get<bool>());
  for (const char* name : {"derivatives.csv", "derivatives.svg"})
    EXPECT_TRUE(fs::exists(folder_ / "out" / name)) << name;
  // a run without the option removes them
  EXPECT_EQ(
      run(fmt::format("limit '{}' --with-dilation --out out --overwrite", (root / "cases/support/slope.toml").string()))
          .code,
      0);
  EXPECT_FALSE(fs::exists(folder_ / "out/derivatives.csv"));
}

TEST_F(Program, DerivativesNeedAFactor) {
  write("flat.toml", R"(dimension = 2
gravity = [0, -9.81]
density = 2000
domain = { box = { min = [-1, -1], max = [1, 1] } }
joints = [{ name = "bed", dip = 0, point = [0, 0] }]
joint_properties = [{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e9, friction_deg = 30 }]
fix = [{ below = ["bed"] }]
)");
  const Ended ended = run("blocks flat.toml --derivatives --out out");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("no factor, so no derivative"), std::string::npos) << ended.out;
  EXPECT_TRUE(results("out")["derivatives"]["message"].is_string());
  EXPECT_NE(read(folder_ / "out/derivatives.svg").find("no derivative"), std::string::npos);
}

TEST_F(Program, DerivativesAreRefusedWithoutAnAnswerOfTheirOwn) {
  const Ended kinematic = run(fmt::format("blocks '{}' --kinematics --face 70/182 --derivatives --out out",
                                          (root / "cases/wedge/scene.toml").string()));
  EXPECT_NE(kinematic.code, 0);
  EXPECT_NE(kinematic.err.find("--kinematics compares directions"), std::string::npos) << kinematic.err;
  const Ended decided =
      run(fmt::format("limit '{}' --decide --derivatives --out out", (root / "cases/support/slope.toml").string()));
  EXPECT_NE(decided.code, 0);
  EXPECT_NE(decided.err.find("--decide"), std::string::npos) << decided.err;
}

}  // namespace
}  // namespace voussoir::derivatives_test
