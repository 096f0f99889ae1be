// Error budgets as users see them: the variations, the parts of the bar, measured stiffness, and runs without a
// budget.
#include <gtest/gtest.h>

#include <cmath>

#include "app/testing/program.hpp"

namespace voussoir {
namespace {

const std::string incline = R"(preset = "thesis"
dimension = 2
density = 2000
gravity = [0, -10]
[domain]
box = { min = [-1, -1], max = [1, 1] }
[[joints]]
name = "A"
dip = 30
dip_direction = 90
point = [0, 0]
[[joint_properties]]
name = "rock"
normal_stiffness = 1e8
shear_stiffness = 1e7
friction_deg = 60
sub_contacts = 4
[[fix]]
below = ["A"]
[output]
frames = false
)";

const std::string search = R"([[stage]]
name = "settle"
kind = "settle"
[[stage]]
name = "critical"
kind = "reduce"
from_deg = 60
to_deg = 10
tolerance_deg = 0.1
)";

class Budget : public program::Program {
 protected:
  void run_well(const std::string& arguments) const {
    const Ended ended = run(arguments);
    ASSERT_EQ(ended.code, 0) << arguments << ": " << ended.err;
  }
  nlohmann::json value(const std::string& where, const std::string& name) const {
    return results(where)["values"][name];
  }
};

// by itself or together with others
bool is_varied(const nlohmann::json& value, const std::string& name) {
  for (const auto& line : value["budget"])
    if (line["varied"].get<std::string>().find(name) != std::string::npos) return true;
  return false;
}

// the block slides at the friction angle that equals the dip: the closed form
TEST_F(Budget, CoversTheClosedFormAndListsItsParts) {
  write("plane.toml", incline + search);
  run_well("run plane.toml --budget --out b");
  const nlohmann::json angle = value("b", "critical_friction");
  const double found = angle["value"], bar = angle["error_bar"], bracket = angle["bracket"];
  EXPECT_EQ(angle["covers"], "budget");
  EXPECT_LE(std::abs(found - 30), bar);
  EXPECT_LT(bracket, bar);
  EXPECT_LT(bar, 1);
  for (const char* name : {"normal stiffness", "shear stiffness", "failure displacement", "ramp", "time step"})
    EXPECT_TRUE(is_varied(angle, name)) << name;
  // the rule: each line by its order, the largest first
  double squares = bracket * bracket, before = 1e300;
  for (const auto& line : angle["budget"]) {
    const double left = line["left"], shift = line["shift"];
    if (line["varied"] == "shear stiffness") {
      EXPECT_NEAR(left, 1.5 * shift, 1e-12);
    }
    if (line["varied"] == "normal stiffness") {
      EXPECT_NEAR(left, -shift / (std::pow(4, 0.75) - 1), 1e-12);
    }
    EXPECT_LE(std::abs(left), before);
    before = std::abs(left);
    squares += 1.25 * 1.25 * left * left;
  }
  EXPECT_GE(bar * bar, squares * (1 - 1e-9));
  EXPECT_LE(bar * bar, (squares + 4 * bracket * bracket) * (1 + 1e-9)) << "and the brackets of the others";
  EXPECT_GT(results("b")["budget"]["contact_evaluations"], 0);
  // the same if the scene requests it, and if the folder is used again
  write("asks.toml", incline + search + "[accuracy]\nbudget = true\n");
  run_well("run asks.toml --out c --quiet");
  EXPECT_EQ(value("c", "critical_friction"), angle);
  run_well("run plane.toml --budget --out b --overwrite --quiet");
  EXPECT_EQ(value("b", "critical_friction"), angle);
}

// the second search has the name of its stage; each is varied near its own result
TEST_F(Budget, OfTwoSearchesCoversBoth) {
  std::string again = search;
  again.replace(again.find("\"critical\""), 10, "\"again\"");
  write("twice.toml", incline + search + again.substr(again.find("[[stage]]", 1)));
  run_well("run twice.toml --budget --out b --quiet");
  for (const char* name : {"critical_friction", "again_critical_friction"}) {
    const nlohmann::json angle = value("b", name);
    EXPECT_EQ(angle["covers"], "budget") << name;
    EXPECT_LE(std::abs(angle["value"].get<double>() - 30), angle["error_bar"].get<double>()) << name;
    EXPECT_TRUE(is_varied(angle, "normal stiffness")) << name;
  }
}

TEST_F(Budget, WithoutOneTheBarIsNamedSearchBracket) {
  write("plane.toml", incline + search);
  const Ended ended = run("run plane.toml --out b");
  EXPECT_NE(ended.out.find("(search bracket only; --budget adds the model's errors)"), std::string::npos) << ended.out;
  const nlohmann::json angle = value("b", "critical_friction");
  EXPECT_EQ(angle["covers"], "bracket");
  EXPECT_FALSE(angle.contains("budget"));
  EXPECT_FALSE(results("b").contains("budget"));
  EXPECT_FALSE(program::fs::exists(folder_ / "b/budget"));
}

// A settlement is the overlap: with an assumed stiffness all of it is an error, with a measured one it is the
// result.
TEST_F(Budget, TakesAMeasuredStiffnessForPhysics) {
  run_well("run " + cubes_ + "--budget --out chosen --quiet");
  const nlohmann::json chosen = value("chosen", "top_displacement_z");
  const double settled = chosen["value"];
  EXPECT_LT(settled, 0);
  EXPECT_GE(chosen["error_bar"].get<double>(), std::abs(settled));
  EXPECT_LT(chosen["error_bar"].get<double>(), 1.5 * std::abs(settled));
  run_well("run " + cubes_ + "--budget --out measured --quiet --set joint_properties.rock.measured=true");
  const nlohmann::json measured = value("measured", "top_displacement_z");
  EXPECT_LT(measured["error_bar"].get<double>(), 0.01 * std::abs(settled));
  bool told = false;
  for (const auto& line : measured["budget"])
    if (line["sensitivity"]) {
      told = true;
      EXPECT_EQ(line["varied"], "stiffness of rock");
      EXPECT_NEAR(line["shift"].get<double>(), settled / 1.1 - settled, 1e-3 * std::abs(settled));
    }
  EXPECT_TRUE(told);
}

// refined until its bar is as requested: by brackets first, whose widths are known without cost, then by a budget
TEST_F(Budget, ARequestedErrorIsReached) {
  write("plane.toml", incline + search);
  run_well("run plane.toml --quiet --out b --set 'accuracy.error=\"0.02 deg\"'");
  const nlohmann::json angle = value("b", "critical_friction");
  EXPECT_LE(angle["error_bar"].get<double>(), 0.02);
  EXPECT_LE(std::abs(angle["value"].get<double>() - 30), angle["error_bar"].get<double>());
  EXPECT_EQ(angle["covers"], "budget");
  const nlohmann::json rounds = results("b")["accuracy"];
  ASSERT_GE(rounds.size(), 2u);
  EXPECT_TRUE(rounds[0]["settings"].empty());
  EXPECT_NE(rounds[0]["told"].get<std::string>().find("by brackets alone"), std::string::npos) << rounds;
  EXPECT_EQ(rounds.back()["told"], "as asked");
  EXPECT_FALSE(rounds.back()["settings"].empty());
  // a target that is met takes one round, and settings that the scene leaves out are set
  std::string loose = search;
  loose.erase(loose.find("tolerance_deg"), std::string("tolerance_deg = 0.1\n").size());
  write("loose.toml", incline + loose + "[accuracy]\nerror = \"5 %\"\n");
  run_well("run loose.toml --quiet --out c");
  EXPECT_EQ(results("c")["accuracy"].size(), 1u);
  EXPECT_LE(value("c", "critical_friction")["error_bar"].get<double>(), 1.5);
  run_well("run loose.toml --quiet --out d --set accuracy.budget=false");
  EXPECT_EQ(value("d", "critical_friction")["covers"], "bracket");
}

TEST_F(Budget, AnInvalidErrorRequestIsRefused) {
  write("plane.toml", incline + search);
  for (const char* text : {"", "3", "1 percent", "0 %", "-1 deg", "60 %", "nan %", "50 deg"})
    expect_one_line(run(fmt::format("run plane.toml --out b --set 'accuracy.error=\"{}\"'", text)), 2,
                    "accuracy.error");
  const std::string asked = "[accuracy]\nerror = \"0.1 deg\"\n";
  write("settles.toml", incline + search.substr(0, search.find("[[stage]]", 1)) + asked);
  expect_one_line(run("run settles.toml --out b"), 2, "there is none");
  std::string steps = search;
  steps.replace(steps.find("tolerance_deg = 0.1"), 19, "method = \"steps\"\nstep_deg = 1");
  write("steps.toml", incline + steps + asked);
  expect_one_line(run("run steps.toml --out b"), 2, "which stage.critical does not state");
}

TEST_F(Budget, ItsOptionsAreChecked) {
  write("plane.toml", incline + search + "[accuracy]\nbudget = 3\n");
  expect_one_line(run("run plane.toml --out b"), 2, "accuracy.budget");
  write("bare.toml", incline + search + "[accuracy]\n");
  run_well("run bare.toml --out b --quiet");
  run_well("check plane.toml --set accuracy.budget=true");
  expect_one_line(run("run bare.toml --budget --until settle --out c"), 2, "--until: a budget's runs");
  expect_one_line(run("run bare.toml --budget --begin b --out c"), 2, "--begin: a budget's runs");
}

}  // namespace
}  // namespace voussoir
