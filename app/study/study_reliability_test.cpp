// Samples and reliability analyses whose rows are judged in one process: their laws, what they share, what they refuse.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/study/search_trial.hpp"
#include "app/testing/program.hpp"
#include "core/joint_sets/statistics.hpp"

namespace voussoir::study_reliability_test {
namespace {

using namespace program;
using nlohmann::json;

double phi(double z) {
  return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

// a cube on a slope of 45 degrees, drawn level: its factor is the tangent of the friction angle
const char* const cube = R"(dimension = 3
gravity = [7.0710678118654755, 0, -7.0710678118654755]
density = 2000
blocks = [{ name = "base", box = { min = [-2, -2, -1], max = [2, 2, 0] }, fixed = true },
          { name = "cube", box = { min = [0, 0, 0], max = [1, 1, 1] } }]
joint_properties = [{ name = "r", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 50 }]
)";

std::string plan_of(const std::string& table, const std::string& scene = "cube.toml") {
  return fmt::format("scene = \"{}\"\nblocks = {{}}\nquantity = \"least_factor\"\n{}", scene, table);
}

const std::string friction =
    "{ key = \"joint_properties.r.friction_deg\", law = \"normal\", mean = 50, deviation = 2, unit = \"deg\" }";

class StudyReliability : public Program {
 protected:
  StudyReliability() { write("cube.toml", cube); }

  // the numbers of a column of a table, from 0
  std::vector<double> column(const std::string& name, int place) const {
    std::vector<double> numbers;
    for (const std::string& line : lines_of(read(folder_ / name))) {
      std::istringstream cells(line);
      std::string cell;
      for (int k = 0; k <= place; ++k)
        std::getline(cells, cell, ',');
      char* end = nullptr;
      const double number = std::strtod(cell.c_str(), &end);
      if (end != cell.c_str()) numbers.push_back(number);
    }
    return numbers;
  }
  json findings(const std::string& name) const { return json::parse(read(folder_ / name)); }
  Ended study(const std::string& table, const std::string& out = "out") const {
    write("study.toml", plan_of(table));
    return run("study study.toml --out " + out);
  }
};

using StudyReliabilityLong = StudyReliability;

// ---- samples ------------------------------------------------------------------------------------------------------

// each row is what the program finds for its values, to the last bit
TEST_F(StudyReliability, ARowIsARunOfTheProgram) {
  const Ended ended = study("[[sample]]\nname = \"s\"\nrows = 5\nkeys = [" + friction + "]\n");
  ASSERT_EQ(ended.code, 0) << ended.err;
  const std::vector<std::string> rows = lines_of(read(folder_ / "out/sample_1.csv"));
  ASSERT_EQ(rows.size(), 6u);
  for (const std::size_t k : {1u, 4u}) {
    const std::string angle = rows[k].substr(2, rows[k].find(',', 2) - 2);
    ASSERT_EQ(run("blocks cube.toml --overwrite --out one --set joint_properties.r.friction_deg=" + angle).code, 0);
    const double factor = results("one")["values"]["least_factor"]["value"];
    EXPECT_NE(rows[k].find(fmt::format(",{},", factor)), std::string::npos) << rows[k] << " " << factor;
  }
  EXPECT_FALSE(fs::exists(folder_ / "out/runs") && std::distance(fs::directory_iterator(folder_ / "out/runs"), {}) > 1);
  EXPECT_NE(ended.out.find("least_factor divides tan(friction) and cohesion"), std::string::npos) << ended.out;
}

// one value in each class of equal probability
TEST_F(StudyReliability, ALatinHypercubeFillsItsClasses) {
  const Ended ended = study(
      "[[sample]]\nname = \"s\"\nmethod = \"latin\"\nrows = 400\nfails = { below = 1.1 }\nkeys = [" + friction + "]\n");
  ASSERT_EQ(ended.code, 0) << ended.err;
  std::vector<bool> filled(400, false);
  double sum = 0;
  for (const double angle : column("out/sample_1.csv", 1)) {
    filled.at(static_cast<std::size_t>(400 * phi((angle - 50) / 2))) = true;
    sum += angle;
  }
  EXPECT_EQ(std::ranges::count(filled, true), 400);
  EXPECT_NEAR(sum / 400, 50, 0.01) << "a tenth of the standard error of 400 independent rows";
  EXPECT_NE(ended.out.find("of independent rows; those of a Latin hypercube are at least as good"), std::string::npos);
}

TEST_F(StudyReliability, CorrelatedKeysAreCorrelated) {
  write("slab.toml", std::string(cube) + "");
  const Ended ended = study("[[sample]]\nname = \"s\"\nrows = 3000\nkeys = [" + friction +
                            ", { key = \"density\", law = \"lognormal\", mean = 2000, deviation = 400 }]\n"
                            "correlation = [[\"joint_properties.r.friction_deg\", \"density\", -0.6]]\n");
  ASSERT_EQ(ended.code, 0) << ended.err;
  const std::vector<double> a = column("out/sample_1.csv", 1), b = column("out/sample_1.csv", 2);
  ASSERT_EQ(a.size(), 3000u);
  const Moments of_a = moments_of(a), of_b = moments_of(b);
  double product = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    product += (a[k] - of_a.mean.value) * (b[k] - of_b.mean.value) / (of_a.deviation * of_b.deviation);
  EXPECT_NEAR(product / 3000, -0.6, 5 * (1 - 0.36) / std::sqrt(3000.0));
  EXPECT_NEAR(of_b.mean.value, 2000, 5 * 400 / std::sqrt(3000.0));
}

// two slabs on joints of one name of properties: one draw for both, or one for each
TEST_F(StudyReliability, JointsShareADrawOrNot) {
  std::string scene = read(fs::path(VOUSSOIR_SOURCE_DIR) / "cases/reliability/two_slabs.toml");
  for (std::size_t at = 0; (at = scene.find("properties = \"b\"", at)) != std::string::npos;)
    scene.replace(at, 16, "properties = \"a\"");
  write("slabs.toml", scene);
  constexpr int rows = 4000;
  const double p = phi((30.0 - 33) / 3);
  for (const auto& [per, expected] : {std::pair{"property", p}, {"joint", 1 - (1 - p) * (1 - p)}}) {
    write("study.toml",
          plan_of(fmt::format("[[sample]]\nname = \"s\"\nrows = {}\nfails = {{ below = 1 }}\nkeys = [{{ key = "
                              "\"joint_properties.a.friction_deg\", law = \"normal\", mean = 33, deviation = 3, per = "
                              "\"{}\" }}]\n",
                              rows, per),
                  "slabs.toml"));
    const Ended ended = run("study study.toml --overwrite --out out");
    ASSERT_EQ(ended.code, 0) << ended.err;
    const json failed = findings("out/sample_1.json")["failed"];
    EXPECT_NEAR(failed["share"].get<double>(), expected, 4 * std::sqrt(expected * (1 - expected) / rows)) << per;
    EXPECT_NE(ended.out.find(per == std::string("joint") ? "each joint has a draw of its own (a.friction_deg)"
                                                         : "joints of the same properties share a draw"),
              std::string::npos)
        << ended.out;
  }
}

TEST_F(StudyReliability, RowsInWhichNothingMovesAreNotSafe) {
  std::string level = cube;
  level.replace(level.find("7.0710678118654755, 0, -7.0710678118654755"), 42, "0, 0, -10");
  write("cube.toml", level);
  const Ended ended = study("[[sample]]\nname = \"s\"\nrows = 12\nfails = { below = 1 }\nkeys = [" + friction + "]\n");
  EXPECT_NE(ended.out.find("rows without a result: 12: in 12 no block can move"), std::string::npos) << ended.out;
  EXPECT_EQ(findings("out/sample_1.json")["without_result_by_reason"]["nothing_moves"], 12);
  EXPECT_FALSE(findings("out/sample_1.json").contains("failed"));
}

// poles drawn around a joint that dips to 359 degrees have no seam: their mean is the joint's
TEST_F(StudyReliability, PolesScatterAroundTheirMean) {
  write("wedge.toml", read(fs::path(VOUSSOIR_SOURCE_DIR) / "cases/reliability/wedge.toml"));
  constexpr int rows = 2000;
  constexpr double concentration = 50;
  write(
      "study.toml",
      plan_of(fmt::format("[[sample]]\nname = \"s\"\nrows = {}\nkeys = [{{ key = \"joints.A\", law = \"fisher\", dip = "
                          "80, dip_direction = 359, concentration = {} }}]\n",
                          rows, concentration),
              "wedge.toml"));
  const Ended ended = run("study study.toml --out out");
  ASSERT_EQ(ended.code, 0) << ended.err;
  const double d = std::numbers::pi / 180;
  const auto pole = [&](double dip, double direction) {
    return Vector<3>(std::sin(dip * d) * std::sin(direction * d), std::sin(dip * d) * std::cos(direction * d),
                     std::cos(dip * d));
  };
  const std::vector<double> dips = column("out/sample_1.csv", 1), directions = column("out/sample_1.csv", 2);
  ASSERT_EQ(dips.size(), static_cast<std::size_t>(rows));
  const Vector<3> mean = pole(80, 359);
  double cosine = 0;
  for (int k = 0; k < rows; ++k) {
    EXPECT_TRUE(dips[k] >= 0 && dips[k] <= 90 && directions[k] >= 0 && directions[k] <= 360);
    cosine += std::abs(mean.dot(pole(dips[k], directions[k]))) / rows;
  }
  // E cos = coth K - 1/K; its deviation is about 1/K
  EXPECT_NEAR(cosine, 1 / std::tanh(concentration) - 1 / concentration, 5 / concentration / std::sqrt(rows));
}

// ---- reliability --------------------------------------------------------------------------------------------------

const std::string analysis = "[[reliability]]\nname = \"r\"\nfails = { below = 1 }\nkeys = [" + friction + "]\n";

TEST_F(StudyReliability, AProbabilityOfOneKeyAndItsRepetition) {
  const Ended ended = study(analysis);
  ASSERT_EQ(ended.code, 0) << ended.err;
  const json found = findings("out/reliability_1.json");
  EXPECT_NEAR(found["beta"].get<double>(), 2.5, 1e-4);
  EXPECT_NEAR(found["first_order"]["probability"].get<double>(), phi(-2.5), 1e-5);
  EXPECT_LE(found["sampled"]["low"].get<double>(), phi(-2.5));
  EXPECT_GE(found["sampled"]["high"].get<double>(), phi(-2.5));
  EXPECT_EQ(found["design_points"][0]["mode"], "slides on (no joint)");
  EXPECT_EQ(found["variance_shares_at_medians"], (json{{"joint_properties.r.friction_deg", 1.0}}));
  const std::string first = read(folder_ / "out/reliability_1.csv");
  ASSERT_EQ(study(analysis, "again").code, 0);
  EXPECT_EQ(read(folder_ / "again/reliability_1.csv"), first);
}

TEST_F(StudyReliability, MediansThatFailHaveANegativeIndex) {
  std::string below = analysis;
  below.replace(below.find("mean = 50"), 9, "mean = 42");
  const Ended ended = study(below);
  ASSERT_EQ(ended.code, 0) << ended.err;
  const json found = findings("out/reliability_1.json");
  EXPECT_NEAR(found["beta"].get<double>(), -1.5, 1e-4);
  EXPECT_NEAR(found["sampled"]["probability"].get<double>(), phi(1.5), 0.03);
  EXPECT_LE(found["sampled"]["low"].get<double>(), found["sampled"]["high"].get<double>());
  EXPECT_NE(ended.out.find("the medians fail: beta is negative"), std::string::npos) << ended.out;
}

// runs are kept: the second analysis makes none, and finds the same
TEST_F(StudyReliability, RunsOfAnAnalysisAreKept) {
  write("study.toml",
        "scene = \"slab.toml\"\nquantity = \"factor_of_safety\"\nlimit = { factor = true }\n"
        "[[reliability]]\nname = \"r\"\nmethod = \"form\"\nfails = { below = 1 }\n"
        "keys = [{ key = \"joint_properties.joint.friction_deg\", law = \"normal\", mean = 38, deviation = 3 }]\n");
  write("slab.toml", read(fs::path(VOUSSOIR_SOURCE_DIR) / "cases/reliability/slab.toml"));
  const Ended first = run("study study.toml --out out");
  ASSERT_EQ(first.code, 0) << first.err;
  const fs::path runs = folder_ / "out/reliability_runs";
  const auto count = std::distance(fs::directory_iterator(runs), {});
  EXPECT_GT(count, 3);
  for (const auto& entry : fs::directory_iterator(runs))
    fs::last_write_time(entry.path() / "results.json", fs::file_time_type::min());
  const Ended second = run("study study.toml --out out");
  ASSERT_EQ(second.code, 0) << second.err;
  EXPECT_EQ(std::distance(fs::directory_iterator(runs), {}), count);
  for (const auto& entry : fs::directory_iterator(runs))
    EXPECT_EQ(fs::last_write_time(entry.path() / "results.json"), fs::file_time_type::min());
  EXPECT_EQ(second.out.substr(second.out.find("reliability 'r'")), first.out.substr(first.out.find("reliability 'r'")));
  EXPECT_NE(first.out.find("to first order; not checked"), std::string::npos) << first.out;
}

// ---- runs ---------------------------------------------------------------------------------------------------------

// the factor of the cube is sought by a run
const std::string searched = std::string(cube) + R"(statics = "newton"
restrain = [{ bodies = ["cube"], rotation = true }]
[[stage]]
name = "settle"
kind = "settle"
[[stage]]
name = "safety"
kind = "reduce"
search = "factor"
friction = [{ name = "r", friction_deg = 50 }]
from_factor = 0.5
to_factor = 3
tolerance_factor = 0.01
)";

// one trial at the limit says what a whole search would
TEST_F(StudyReliability, ATrialAtTheLimitStandsOrFails) {
  write("searched.toml", searched);
  const Fails below{.below = true, .limit = 1}, above{.below = false, .limit = 1};
  const Scene scene = read_scene((folder_ / "searched.toml").string(), {});
  EXPECT_TRUE(trial_at_limit(scene, "critical_friction", below).empty());
  EXPECT_TRUE(trial_at_limit(scene, "factor_of_safety", above).empty());
  EXPECT_TRUE(trial_at_limit(scene, "factor_of_safety", {.below = true, .limit = 0.4}).empty());
  std::string options;
  for (const std::string& text : trial_at_limit(scene, "factor_of_safety", below))
    options += " --set " + text;
  ASSERT_NE(options, "");
  for (const auto& [friction, fails] : {std::pair{44.5, true}, {45.5, false}}) {
    const std::string out = fmt::format("trial_{}", friction);
    run(fmt::format("run searched.toml --quiet --out {} --set stage.safety.friction.r.friction_deg={}{}", out, friction,
                    options));
    EXPECT_EQ(trial_failed(folder_ / out), fails) << friction;
  }
}

// 95 % and 12 % of the standard error
TEST_F(StudyReliabilityLong, OfRunsIsSampledByTrials) {
  write("searched.toml", searched);
  write("study.toml",
        "scene = \"searched.toml\"\nquantity = \"factor_of_safety\"\n"
        "[[reliability]]\nname = \"r\"\ntarget = 0.12\nfails = { below = 1 }\n"
        "keys = [{ key = \"stage.safety.friction.r.friction_deg\", law = \"normal\", mean = 50, deviation = 2 }]\n");
  const Ended ended = run("study study.toml --out out");
  ASSERT_EQ(ended.code, 0) << ended.err;
  const json found = findings("out/reliability_1.json");
  EXPECT_NEAR(found["beta"].get<double>(), 2.5, 0.02);
  const double p = found["sampled"]["probability"], error = found["sampled"]["standard_error"];
  EXPECT_NEAR(p, phi(-2.5), 3 * error);
  EXPECT_LE(error, 0.12 * p);
  EXPECT_NE(ended.out.find("both are single trials at the limit"), std::string::npos) << ended.out;
  EXPECT_NE(read(folder_ / "out/reliability_1.csv").find(",stands,"), std::string::npos);
}

TEST_F(StudyReliability, WhatHasNoAnswerIsRefused) {
  const auto refuse = [&](const std::string& from, const std::string& to, const std::string& part) {
    std::string text = analysis;
    ASSERT_NE(text.find(from), std::string::npos) << from;
    write("study.toml", plan_of(text.replace(text.find(from), from.size(), to)));
    expect_one_line(run("study study.toml --out bad"), 2, part);
    EXPECT_FALSE(fs::exists(folder_ / "bad")) << to;
  };
  const std::string one = "keys = [" + friction + "]", key = "joint_properties.r.friction_deg";
  refuse("fails = { below = 1 }\n", "", "what a failure is");
  refuse("law = \"normal\", mean = 50, deviation = 2", "law = \"seed\"", "has no order");
  refuse("deviation = 2", "deviation = 0", "does not scatter");
  refuse("deviation = 2", "deviation = 2, per = \"joint\"", "for samples with blocks");
  refuse("name = \"r\"", "name = \"r\"\nmethod = \"subset\"", "must be \"importance\" or \"form\"");
  refuse("name = \"r\"", "name = \"r\"\ntarget = 0", "must be from 0.001 to 1");
  refuse("law = \"normal\"", "law = \"fisher\"", "is no number of law = \"fisher\"");
  const std::string other = friction + ", { key = \"density\", law = \"lognormal\", mean = 2000, deviation = 2000 }";
  const auto with = [&](const std::string& pairs) { return "keys = [" + other + "]\ncorrelation = " + pairs; };
  refuse(one, with("[[\"" + key + "\", \"density\", 0.95]]"), "cannot be 0.95 between these laws: -0.8326 to 0.8326");
  refuse(one, with("[[\"" + key + "\", \"gravity\", 0.5]]"), "'gravity', which is not drawn");
  refuse(one, with("[[\"density\", \"density\", 0.5]]"), "with itself");
  refuse(one, with("[[\"density\", \"" + key + "\", 1.5]]"), "from -1 to 1");
  refuse(one, with("[[\"density\", \"" + key + "\", 0.5], [\"" + key + "\", \"density\", 0.4]]"), "stated twice");
  refuse(one, with("0.5"), "must be a list of");

  write("study.toml", "scene = \"cube.toml\"\nblocks = {}\nquantity = \"volume_below_1\"\n" + analysis);
  expect_one_line(run("study study.toml --out bad"), 2, "jumps from value to value");

  // an answer that no key moves, and a law that has strengths below zero
  Ended ended = study(
      "[[reliability]]\nname = \"r\"\nfails = { below = 1 }\nkeys = [{ key = \"density\", law = \"normal\", "
      "mean = 2000, deviation = 100 }]\n");
  EXPECT_EQ(ended.code, 1);
  EXPECT_NE(ended.out.find("no probability: "), std::string::npos) << ended.out;
  std::string wide = analysis;
  wide.replace(wide.find("below = 1 }"), 11, "below = -1e-9 }");
  ended = study(wide, "wide");
  EXPECT_EQ(ended.code, 1) << ended.out;
  EXPECT_NE(ended.out.find("use lognormal, or least = 0"), std::string::npos) << ended.out;
}

}  // namespace
}  // namespace voussoir::study_reliability_test
