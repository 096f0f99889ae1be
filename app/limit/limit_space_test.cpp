// `voussoir limit` in space: numbers by closed forms, words that say what they bound, files, exit codes, bad input.
#include <cmath>
#include <numbers>

#include "app/testing/program.hpp"

namespace voussoir::limit_space_test {
namespace {

using namespace program;

class LimitSpace : public Program {
 protected:
  // a column of 0.5 x 1 x 2 m on a floor; `more` in the tables of the scene
  void write_column(const std::string& more = "") const {
    write("column.toml",
          "title = \"Column\"\ndimension = 3\ngravity = [0, 0, -10]\ndensity = 2000\n"
          "blocks = [{ name = \"floor\", box = { min = [-2, -2, -1], max = [2, 2, 0] }, fixed = true },\n"
          "          { name = \"column\", box = { min = [0, 0, 0], max = [0.5, 1, 2] } }]\n"
          "joint_properties = [{ name = \"r\", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 35 }]\n" +
              more + "[[stage]]\nname = \"push\"\nkind = \"settle\"\n");
  }
  Ended limit(const std::string& options) const { return run("limit column.toml --overwrite --out out " + options); }
  double value(const std::string& name) const { return results("out")["values"][name]["value"].get<double>(); }
};

TEST_F(LimitSpace, PushesAColumnInAnyDirection) {
  write_column();
  for (const auto& [direction, factor] : {std::pair("east", 0.25), {"west", 0.25}, {"north", 0.5}, {"south", 0.5}}) {
    const Ended ended = limit(std::string("--load ") + direction);
    EXPECT_EQ(ended.code, 0) << ended.out << ended.err;
    EXPECT_NEAR(value("collapse_factor"), factor, 1e-6) << direction;
    EXPECT_NEAR(value("collapse_factor_upper_bound"), factor, 1e-8) << direction;
    for (const char* part : {"Column - limit analysis", "joints that do not carry no more", "4 corners",
                             "1 of 1 free blocks", "for joints that dilate", direction})
      EXPECT_NE(ended.out.find(part), std::string::npos) << part << "\n" << ended.out;
    EXPECT_EQ(ended.out.find("proof"), std::string::npos) << ended.out;
  }
  const nlohmann::json json = results("out");
  EXPECT_EQ(json["status"], "done");
  EXPECT_NE(json["bound"].get<std::string>().find("upper bound"), std::string::npos);
  EXPECT_EQ(json["mechanism"]["moving"].size(), 1u);
  ASSERT_EQ(json["interfaces"].size(), 1u);
  double weight = 0;
  for (const nlohmann::json& corner : json["interfaces"][0]["corners"])
    weight += corner["normal_N"].get<double>();
  EXPECT_NEAR(weight, 20000, 1e-3);
  EXPECT_LT(json["evidence"]["gap"].get<double>(), 1e-8);
  for (const char* name : {"blocks.vtp", "mechanism.vtp", "forces.vtp"})
    EXPECT_TRUE(fs::exists(folder_ / "out" / name)) << name;
  EXPECT_FALSE(fs::exists(folder_ / "out/limit.svg"));

  EXPECT_EQ(limit("--load up").code, 0);
  EXPECT_NEAR(value("collapse_factor_upper_bound"), 1, 1e-8);
}

TEST_F(LimitSpace, SaysWhyThereIsNoNumber) {
  write_column();
  for (const char* load : {"down", "gravity"}) {
    const Ended any = limit(std::string("--load ") + load);
    EXPECT_EQ(any.code, 1) << any.out << any.err;
    EXPECT_NE(any.out.find("causes no collapse"), std::string::npos) << any.out;
    EXPECT_TRUE(results("out")["values"].empty());
    EXPECT_EQ(results("out")["status"], "incomplete");
  }
  const Ended level = limit("");
  EXPECT_EQ(level.code, 0);
  EXPECT_EQ(value("critical_friction"), 0);
  expect_one_line(limit("--load applied"), 2, "no stage applies a force");
  expect_one_line(limit("--load right"), 2, "east, west");
  expect_one_line(limit("--friction q"), 2, "there are: r");
  expect_one_line(limit("--set gravity=[0,0,0]"), 2, "[0, 0, -9.81]");
  expect_one_line(limit("--set blocks.column.fixed=true"), 2, "no block is free");
}

// the wedge's line plunges under its friction angle without dilation, 33.357°: with it, less friction is enough
TEST_F(LimitSpace, FindsFrictionAndFactorOfAWedge) {
  const std::string wedge = "'" + (fs::path(VOUSSOIR_SOURCE_DIR) / "cases/wedge/scene.toml").string() + "' ";
  const Ended friction = run("limit " + wedge + "--overwrite --out out");
  EXPECT_EQ(friction.code, 0) << friction.err;
  EXPECT_NEAR(value("critical_friction"), 33.357221409, 1e-3);
  EXPECT_NEAR(value("critical_friction_lower_bound"), 31.074313616, 3e-6);
  EXPECT_NE(friction.out.find("need as much friction or more"), std::string::npos) << friction.out;
  EXPECT_EQ(run("limit " + wedge + "--factor --overwrite --out out").code, 0);
  EXPECT_NEAR(value("factor_of_safety_upper_bound"),
              std::tan(85 * std::numbers::pi / 180) / std::tan(31.074313616 * std::numbers::pi / 180), 1e-4);
}

TEST_F(LimitSpace, CountsAppliedForcesAndCohesion) {
  write_column("");
  std::string text = read(folder_ / "column.toml");
  write("column.toml", text +
                           "[[stage.force]]\nname = \"rope\"\nbodies = [\"column\"]\nforce = [1000, 0, 0]\n"
                           "point = [0.25, 0.5, 0.2]\n");
  EXPECT_EQ(limit("--load applied").code, 0);
  EXPECT_NEAR(value("collapse_factor"), 20 * std::tan(35 * std::numbers::pi / 180), 1e-6);
  const std::string cohesive = "--set joint_properties.r.cohesion=1e4 --set joint_properties.r.tension=0 ";
  EXPECT_EQ(limit("--load applied --cohesion " + cohesive).code, 0);
  EXPECT_NEAR(value("collapse_factor"), 20 * std::tan(35 * std::numbers::pi / 180) + 5, 1e-6);
}

// of the column: both bounds, a file, and why there is none
TEST_F(LimitSpace, ProvesBounds) {
  write_column();
  const Ended east = limit("--load east --proof");
  EXPECT_EQ(east.code, 0) << east.out << east.err;
  const nlohmann::json proof = results("out")["proof"];
  EXPECT_GE(proof["proved_upper"].get<double>(), 0.25);
  EXPECT_LT(proof["proved_upper"].get<double>(), 0.25 + 1e-7);
  EXPECT_LE(proof["carried_if_joints_dilate"].get<double>(), 0.25);
  EXPECT_GT(proof["carried_if_joints_dilate"].get<double>(), 0.25 - 2e-6);
  EXPECT_EQ(proof["file"], "proof.json.gz");
  EXPECT_TRUE(fs::exists(folder_ / "out/proof.json.gz"));
  for (const char* part : {"proved: beyond it nothing stands", "in exact balance, if joints dilate: not safe"})
    EXPECT_NE(east.out.find(part), std::string::npos) << part << "\n" << east.out;

  const Ended any = limit("--load down --proof");
  EXPECT_EQ(any.code, 1);
  EXPECT_NE(any.out.find("not proved from above: every factor is supported"), std::string::npos) << any.out;
  EXPECT_FALSE(results("out")["proof"].contains("proved_upper"));
  EXPECT_FALSE(fs::exists(folder_ / "out/proof.json.gz"));
  expect_one_line(limit("--proof"), 2, "--load");
}

// the column alone topples; between walls that slip only, forces that nothing asks for may hold it
TEST_F(LimitSpace, AnswersForJointsThatDoNotDilate) {
  write_column();
  const Ended alone = limit("--load east");
  EXPECT_EQ(alone.code, 0) << alone.out << alone.err;
  EXPECT_NEAR(value("collapse_factor_least"), 0.25, 2e-7);
  EXPECT_NEAR(value("collapse_factor_largest"), 0.25, 1e-6);
  EXPECT_GE(results("out")["values"]["collapse_factor_least"]["error_bar"], 1e-6);
  for (const char* part : {"no lower mechanism", "rounds from loose joints"})
    EXPECT_NE(alone.out.find(part), std::string::npos) << part << "\n" << alone.out;
  EXPECT_EQ(alone.out.find("do not ask for"), std::string::npos) << alone.out;

  std::string text = read(folder_ / "column.toml");
  const std::string place = "{ name = \"column\"";
  text.insert(text.find(place),
              "{ name = \"south\", box = { min = [-0.75, -1, 0], max = [1.25, 0, 2] } },\n"
              "          { name = \"north\", box = { min = [-0.75, 1, 0], max = [1.25, 2, 2] } },\n          ");
  write("column.toml", text);
  const Ended between = limit("--load east");
  EXPECT_EQ(between.code, 1) << between.out << between.err;
  EXPECT_EQ(results("out")["status"], "done") << "both ends are found";
  EXPECT_FALSE(results("out")["values"].contains("collapse_factor"));
  EXPECT_NEAR(value("collapse_factor_least"), 0.25, 2e-7);
  EXPECT_GT(value("collapse_factor_largest"), 0.5);
  EXPECT_LE(value("collapse_factor_largest"), value("collapse_factor_upper_bound") + 1e-8);
  for (const char* part :
       {"held by forces that the loads do not ask for", "holds the mechanism's block between the two ends"})
    EXPECT_NE(between.out.find(part), std::string::npos) << part << "\n" << between.out;
  const nlohmann::json held = results("out")["without_dilation"]["held_by_self_stress"];
  ASSERT_EQ(held.size(), 1u);
  EXPECT_EQ(results("out")["mechanism"]["moving"][0]["body"], held[0]);
  EXPECT_TRUE(results("out")["without_dilation"]["converged"]);

  // runs on stiff joints decide: near the least, the largest is no answer
  const Ended decided = limit(
      "--load east --decide --set joint_properties.r.normal_stiffness=1e10 "
      "--set joint_properties.r.shear_stiffness=1e10");
  EXPECT_EQ(decided.code, 0) << decided.out << decided.err;
  EXPECT_GT(value("collapse_factor"), 0.2);
  EXPECT_LT(value("collapse_factor"), 0.25) << "elastic joints stay below rigid ones";
  EXPECT_NE(decided.out.find("with the scene's joint stiffness"), std::string::npos) << decided.out;

  // the bound alone
  EXPECT_EQ(limit("--load east --with-dilation").code, 0);
  EXPECT_FALSE(results("out")["values"].contains("collapse_factor_least"));
  EXPECT_GT(value("collapse_factor_upper_bound"), 0.5);
  expect_one_line(limit("--load east --with-dilation --decide"), 2, "--decide");

  // its friction under gravity, level: none
  EXPECT_EQ(limit("").code, 0);
  const std::size_t end = text.find("friction_deg = 35") + std::string("friction_deg = 35").size();
  write("column.toml",
        text.substr(0, end) + ", friction_law = \"barton_bandis\", jrc = 5, jcs = 40e6" + text.substr(end));
  const Ended rough = limit("--load east");
  EXPECT_EQ(rough.code, 0) << rough.out << rough.err;
  EXPECT_NE(rough.err.find("followed for joints that dilate"), std::string::npos) << rough.err;
  EXPECT_FALSE(results("out")["values"].contains("collapse_factor"));
}

// Barton and Bandis' envelope at the stress of the column, 40 kPa: F of the push is tan φ(σ) W over it
TEST_F(LimitSpace, FollowsTheEnvelopeOfBartonAndBandis) {
  write_column();
  const std::string text = read(folder_ / "column.toml");
  const std::size_t end = text.find("friction_deg = 35") + std::string("friction_deg = 35").size();
  write("column.toml",
        text.substr(0, end) + ", friction_law = \"barton_bandis\", jrc = 5, jcs = 40e6" + text.substr(end));
  expect_one_line(limit(""), 2, "seek the factor of safety by --factor");
  const Ended east = limit("--load east --set blocks.column.box.max=[2,1,0.25]");
  EXPECT_EQ(east.code, 0) << east.out << east.err;
  EXPECT_NEAR(value("collapse_factor_upper_bound"),
              std::tan((35 + 5 * std::log10(40e6 / 5e3)) * std::numbers::pi / 180), 2e-6);
  for (const char* part : {"peak envelope", "rounds until the answers of two agree", "slope of their envelope"})
    EXPECT_NE((east.out + east.err).find(part), std::string::npos) << part << east.out << east.err;
  EXPECT_TRUE(results("out")["evidence"]["envelope"]["agree"]);
}

}  // namespace
}  // namespace voussoir::limit_space_test
