// `voussoir limit`: results with their proofs and drawings, factors of safety and of loads.
#include <cmath>
#include <numbers>

#include "app/testing/program.hpp"

namespace voussoir::limit_test {
namespace {

using namespace program;

TEST_F(Program, LimitFindsProvesAndDraws) {
  const std::string slump = "'" + (fs::path(VOUSSOIR_SOURCE_DIR) / "cases/slump/scene.toml").string() + "' ";
  const Ended ended = run("limit " + slump + "--out out");
  EXPECT_EQ(ended.code, 0) << ended.err;
  for (const char* part :
       {"critical_friction 15.335", "7 of 21 free blocks move", "without dilation", "forces and mechanism differ by"})
    EXPECT_NE(ended.out.find(part), std::string::npos) << part << "\n" << ended.out;
  for (const char* name : {"limit.svg", "blocks.vtp", "mechanism.vtp", "forces.vtp"})
    EXPECT_TRUE(fs::exists(folder_ / "out" / name)) << name;
  const nlohmann::json json = results("out");
  EXPECT_NEAR(json["values"]["critical_friction"]["value"].get<double>(), 15.335, 0.001);
  EXPECT_EQ(json["mechanism"]["moving"].size(), 7u);
  EXPECT_EQ(json["interfaces"].size(), 42u);
  expect_one_line(run("limit " + slump + "--out out"), 2, "--overwrite");

  // a load's factor, and searches without a result
  const std::string weaker = slump + "--set joint_properties.rock.friction_deg=20 --overwrite --out out ";
  EXPECT_EQ(run("limit " + weaker + "--load left").code, 0);
  EXPECT_GT(results("out")["values"]["collapse_factor"]["value"], 0);
  const Ended any = run("limit " + squares_ + "--out any");
  EXPECT_EQ(any.code, 0);
  EXPECT_NE(any.out.find("are stable without friction"), std::string::npos) << any.out;
  EXPECT_EQ(results("any")["status"], "done");
  EXPECT_EQ(results("any")["values"]["critical_friction"]["value"], 0);
  const std::string changed = "--overwrite --out any --set stage.settle.friction_deg=10";
  expect_one_line(run("limit " + squares_ + changed), 0, "before its first stage");

  // a block that leans out over its base topples at any friction: another message, another value, another exit code
  write("leaning.toml",
        "dimension = 2\ngravity = [0, -10]\ndensity = 2000\n"
        "blocks = [{ name = \"base\", box = { min = [0, -1], max = [1, 0] }, fixed = true },\n"
        "          { name = \"leaning\", vertices = [[0, 0], [1, 0], [4, 3], [3, 3]] }]\n"
        "joint_properties = [{ name = \"r\", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 30 }]\n"
        "stage = [{ name = \"s\", kind = \"settle\" }]\n");
  const Ended none = run("limit leaning.toml --out none");
  EXPECT_EQ(none.code, 1);
  EXPECT_NE(none.out.find("no friction up to 89 degrees is enough"), std::string::npos) << none.out;
  EXPECT_EQ(results("none")["status"], "incomplete");
  EXPECT_FALSE(results("none")["values"].contains("critical_friction"));
  EXPECT_NEAR(results("none")["values"]["friction_not_enough"]["value"].get<double>(), 89, 1e-9);
  expect_one_line(run("limit " + cubes_ + "--load left --out bad"), 2, "dimension = 3");
  expect_one_line(run("limit " + slump + "--load east --out bad"), 2, "dimension = 2");
  expect_one_line(run("limit " + slump + "--friction roc --out bad"), 2, "there are: rock");
  EXPECT_FALSE(fs::exists(folder_ / "bad"));
}

// A slab on a plane that dips by 0.7 rad, 4 m by 1 m, 80 kN/m: its bolt, straight down the plane's normal, presses it
// on.
TEST_F(Program, LimitCountsBoltsUpToTheirYield) {
  const auto bolted_by = [](const std::string& keys) {
    return "dimension = 2\ngravity = [6.44217687237691, -7.648421872844885]\ndensity = 2000\n"
           "blocks = [{ name = \"floor\", box = { min = [-9, -3], max = [9, 0] }, fixed = true },\n"
           "          { name = \"slab\", box = { min = [-2, 0], max = [2, 1] } }]\n"
           "joint_properties = [{ name = \"rock\", normal_stiffness = 1e9, shear_stiffness = 1e9, friction_deg = 35 "
           "}]\n"
           "bolts = [{ name = \"pin\", from = [0, 0.5], to = [0, -2], yield = 15e3, " +
           keys + " }]\nstage = [{ name = \"s\", kind = \"settle\", install = [\"pin\"] }]\n";
  };
  write("bolted.toml", bolted_by("stiffness = 1e8"));
  const double normal = 80e3 * std::cos(0.7), shear = 80e3 * std::sin(0.7),
               friction = std::tan(35 * std::numbers::pi / 180);
  const auto value = [&](const char* name) { return results("out")["values"][name]["value"].get<double>(); };
  const Ended ended = run("limit bolted.toml --with-dilation --out out");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("bolts act up to their yield"), std::string::npos) << ended.out;
  EXPECT_NEAR(value("critical_friction_lower_bound"), std::atan(shear / (normal + 15e3)) * 180 / std::numbers::pi,
              2e-6);
  const nlohmann::json bolt = results("out")["bolts"].at(0);
  EXPECT_EQ(bolt["name"], "pin");
  EXPECT_NEAR(bolt["tension_N"].get<double>(), 15e3, 1);

  // along any direction: up the plane, against gravity's own part and friction
  ASSERT_EQ(run("limit bolted.toml --load -2,0 --with-dilation --overwrite --out out").code, 0);
  EXPECT_NEAR(value("collapse_factor_upper_bound"), (shear + friction * (normal + 15e3)) / 80e3, 1e-7);

  expect_one_line(run("limit bolted.toml --load 1,0,0 --out bad"), 2, "dimension = 2");
  for (const char* load : {"0,0", "1", "1,,0", "1,0,0,0", "1,x", "nan,1", "1e400,0", "sideways"})
    expect_one_line(run(std::string("limit bolted.toml --out bad --load ") + load), 2, "a direction such as");
  expect_one_line(run("limit bolted.toml --load right --proof --out bad"), 2, "bolts");
  EXPECT_FALSE(fs::exists(folder_ / "bad"));
  // a grouted bar holds as much, as long as its bond does
  write("grouted.toml", bolted_by("kind = \"grouted\", axial_stiffness = 1e8, bond_stiffness = 1e8"));
  EXPECT_EQ(run("limit grouted.toml --load -2,0 --with-dilation --overwrite --out out").code, 0);
  EXPECT_NEAR(value("collapse_factor_upper_bound"), (shear + friction * (normal + 15e3)) / 80e3, 1e-7);

  // a slab that does not open as it slides stretches no bolt across its joint: the pin pulls, pushes or does neither
  const Ended either = run("limit bolted.toml --overwrite --out out");
  EXPECT_EQ(either.code, 1) << either.out << either.err;
  const auto held_by = [&](double pull) { return std::atan(shear / (normal + pull)) * 180 / std::numbers::pi; };
  EXPECT_NEAR(value("critical_friction_least"), held_by(15e3), 2e-4);
  EXPECT_NEAR(value("critical_friction_largest"), held_by(-15e3), 2e-4);
  EXPECT_TRUE(results("out")["without_dilation"]["converged"]);
}

// with friction alone the factor of safety is the ratio of the tangents; cohesion adds to it if requested
TEST_F(Program, LimitFindsTheFactorOfSafety) {
  const std::string slump = "'" + (fs::path(VOUSSOIR_SOURCE_DIR) / "cases/slump/scene.toml").string() +
                            "' --set joint_properties.rock.friction_deg=30 --overwrite --out out ";
  const auto factor = [&](const std::string& options) {
    const Ended ended = run("limit " + slump + "--factor " + options);
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_NE(ended.out.find("factor_of_safety "), std::string::npos) << ended.out;
    const nlohmann::json values = results("out")["values"], &value = values["factor_of_safety"],
                         &bound = values["factor_of_safety_upper_bound"];
    EXPECT_LT(bound["error_bar"].get<double>(), 1e-6);
    EXPECT_NEAR(value["value"].get<double>(), bound["value"].get<double>(), value["error_bar"].get<double>());
    return bound["value"].get<double>();
  };
  const double degree = std::numbers::pi / 180, friction = factor("");
  EXPECT_NEAR(friction, std::tan(30 * degree) / std::tan(15.335 * degree), 1e-3);
  EXPECT_EQ(factor("--joint rock"), friction);
  EXPECT_EQ(factor("--set joint_properties.rock.cohesion=1e4"), friction) << "left out unless requested";
  EXPECT_GT(factor("--cohesion --set joint_properties.rock.cohesion=1e4"), friction * 1.01);
  expect_one_line(run("limit " + slump + "--factor --joint roc"), 2, "--joint roc: no joint_properties of this name");
  expect_one_line(run("limit " + slump + "--factor --load left"), 2, "--load");
  expect_one_line(run("limit " + slump + "--factor --friction rock"), 2, "--friction");
  expect_one_line(run("limit " + slump + "--joint rock"), 2, "--factor");
}

// under water a block has its buoyant weight: this leaves friction's part of the factor and raises that of cohesion
TEST_F(Program, LimitCountsWater) {
  write("plane.toml", R"(
dimension = 2
gravity = [0, -10]
density = 2000
domain = { box = { min = [-2, -3], max = [2, 3] } }
joints = [{ name = "A", dip = 20, dip_direction = 90, point = [0, -1] }]
joint_properties = [{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 40, cohesion = 1e3 }]
water = [{ name = "lake", level = 5 }]
fix = [{ below = ["A"] }]
stage = [{ name = "settle", kind = "settle" }]
)");
  const double dip = 20 * std::numbers::pi / 180, friction = std::tan(2 * dip) / std::tan(dip);
  const double weight = 4 * 4 * (2000 * 10 - 9810), cohesion = 1e3 * 4 / std::cos(dip) / (weight * std::sin(dip));
  const auto factor = [&](const std::string& options) {
    EXPECT_EQ(run("limit plane.toml --factor --overwrite --out out " + options).code, 0);
    return results("out")["values"]["factor_of_safety_upper_bound"]["value"].get<double>();
  };
  EXPECT_NEAR(factor(""), friction + cohesion, 1e-6) << "what is stated acts";
  EXPECT_NEAR(factor("--set joint_properties.rock.bonds=by_stage"), friction, 1e-6);
  EXPECT_NEAR(factor("--cohesion --set joint_properties.rock.bonds=by_stage"), friction + cohesion, 1e-6);
  EXPECT_NEAR(factor("--set preset=thesis"), friction, 1e-6);
}

TEST_F(Program, LimitFindsTheFactorOfAppliedForces) {
  // a column of 1 x 3 m and 75 kN/m, pushed at 2 m: it tips at 75 kN / 4
  const std::string column =
      "dimension = 2\ngravity = [0, -10]\ndensity = 2500\n"
      "blocks = [{ name = \"ground\", box = { min = [-3, -1], max = [3, 0] }, fixed = true },\n"
      "          { name = \"column\", box = { min = [-0.5, 0], max = [0.5, 3] } }]\n"
      "joint_properties = [{ name = \"r\", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 30 }]\n"
      "[[stage]]\nname = \"settle\"\nkind = \"settle\"\n";
  const std::string push =
      "[[stage]]\nname = \"push\"\nkind = \"run\"\nduration_s = 1\n"
      "[[stage.force]]\nname = \"rope\"\nbodies = [\"column\"]\nforce = [1e4, 0]\npoint = [0, 2]\n";
  write("column.toml", column + push);
  const Ended found = run("limit column.toml --load applied --out found");
  EXPECT_EQ(found.code, 0) << found.err;
  EXPECT_EQ(found.err, "") << "nothing is left out";
  EXPECT_NE(found.out.find("multiple of the applied forces of stage 'push'"), std::string::npos) << found.out;
  EXPECT_NEAR(results("found")["values"]["collapse_factor_upper_bound"]["value"].get<double>(), 75e3 / 4 / 1e4, 1e-9);

  // forces that are left out, or treated otherwise than in a run, are reported
  expect_one_line(run("limit column.toml --load right --out right"), 0,
                  "forces of stage 'push' are left out: '--load applied'");
  EXPECT_NEAR(results("right")["values"]["collapse_factor_upper_bound"]["value"].get<double>(), 1.0 / 3, 1e-9);
  write("later.toml", column + push + "times_s = [0, 1]\nfactors = [0, 2]\n");
  expect_one_line(run("limit later.toml --load applied --out later"), 0,
                  "'rope' has a factor of time, which is taken as 1");
  EXPECT_NEAR(results("later")["values"]["collapse_factor_upper_bound"]["value"].get<double>(), 75e3 / 4 / 1e4, 1e-9);
  write("two.toml", column + push +
                        "[[stage]]\nname = \"more\"\nkind = \"settle\"\n[[stage.force]]\nname = \"rope\"\n"
                        "bodies = [\"column\"]\nforce = [2e4, 0]\n");
  expect_one_line(run("limit two.toml --load applied --out two"), 0,
                  "of stage 'more' are left out; those of stage 'push'");
  EXPECT_NEAR(results("two")["values"]["collapse_factor_upper_bound"]["value"].get<double>(), 75e3 / 4 / 1e4, 1e-9);

  // no force, one that does nothing, one that cannot tip it
  write("none.toml", column);
  expect_one_line(run("limit none.toml --load applied --out bad"), 2, "no stage applies a force");
  expect_one_line(run("limit column.toml --load applied --out bad --set stage.push.force.rope.force=[0,0]"), 2, "zero");
  EXPECT_FALSE(fs::exists(folder_ / "bad"));
  const Ended any = run("limit column.toml --load applied --out any --set stage.push.force.rope.force=[0,-1e4]");
  EXPECT_EQ(any.code, 1);
  EXPECT_NE(any.out.find("they press the blocks"), std::string::npos) << any.out;
}

}  // namespace
}  // namespace voussoir::limit_test
