// results.json, history.csv and files.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/fingerprint.hpp"
#include "core/base/version.hpp"
#include "core/output/atomic_file.hpp"
#include "core/output/history_csv.hpp"
#include "core/output/json_parts.hpp"
#include "core/output/results_json.hpp"
#include "core/testing/temporary_folder.hpp"

namespace voussoir::output_test {
namespace {

namespace fs = std::filesystem;

Results some_results() {
  Results results;
  results.outcome = Outcome::incomplete;
  results.message = "no bracket";
  results.values = {{"critical_friction", {33.35 + 1e-14, "deg", 0.01, "bisection"}}, {"height", {0.1, "m", {}, ""}}};
  results.stages.push_back({"settle", "settle", "equilibrium", true, 100, 0.5, 1e-3, 1e-7});
  results.counters.steps = 123'456'789'012;
  results.energy.flows[Source::gravity] = 12;
  results.energy.flows[Source::local_damping] = 1;
  results.energy.flows[Source::dashpots] = 2;
  results.energy.largest_energy = 12;
  results.energy.worst_error = 3;
  results.warnings = {"late doubt"};
  results.state_hash = fingerprint("state");
  results.seconds = 1.5;
  return results;
}

TEST(ResultsJson, ContainsTheResultsOfTheRun) {
  const Results results = some_results();
  RunRecord record;
  record.title = "a \"wedge\"";
  record.input_hash = fingerprint("scene");
  record.features = {{"fast_arithmetic", true}};
  const auto json = nlohmann::json::parse(results_json(results, record));
  EXPECT_EQ(json["schema_version"], results_schema_version);
  EXPECT_EQ(json["title"], "a \"wedge\"");
  EXPECT_EQ(json["input_hash"], record.input_hash);
  EXPECT_EQ(json["program"]["commit"], commit());
  EXPECT_EQ(json["program"]["features"]["fast_arithmetic"], true);
  EXPECT_EQ(json["status"], "incomplete");
  EXPECT_EQ(json["message"], "no bracket");
  EXPECT_EQ(json["values"]["critical_friction"]["value"].get<double>(), 33.35 + 1e-14);
  EXPECT_EQ(json["values"]["critical_friction"]["error_bar"], 0.01);
  EXPECT_EQ(json["values"]["critical_friction"]["unit"], "deg");
  EXPECT_EQ(json["values"]["critical_friction"]["rule"], "bisection");
  EXPECT_FALSE(json["values"]["height"].contains("error_bar"));
  EXPECT_EQ(json["stages"][0]["ended"], "equilibrium");
  EXPECT_EQ(json["counters"]["steps"], 123'456'789'012);
  EXPECT_EQ(json["energy"]["potential"], -12);
  EXPECT_EQ(json["stages"][0]["relaxed"], true);
  EXPECT_EQ(json["energy"]["damping"], 3);
  EXPECT_EQ(json["energy"]["relative_energy_error"], 0.25);
  EXPECT_EQ(json["warnings"].back(), "late doubt");
  EXPECT_EQ(json["state_hash"], results.state_hash);
  EXPECT_EQ(json["timing"]["seconds"], 1.5);
}

TEST(ResultsJson, NamesItsOriginsOnce) {
  RunRecord record;
  EXPECT_TRUE(add_origin(record.origins, {"program", math_functions_hash(), false}));
  EXPECT_FALSE(add_origin(record.origins, {"program", math_functions_hash(), false}));
  EXPECT_TRUE(add_origin(record.origins, {"program", "of another processor", true}));
  const auto json = nlohmann::json::parse(results_json(some_results(), record));
  EXPECT_EQ(json["program"]["origins"].size(), 2u);
  EXPECT_EQ(origins_of(json["program"]["origins"]), record.origins);
}

TEST(ResultsJson, NamesTheNumbersItCannotRepresent) {
  Results results = some_results();
  results.values[1].second.value = std::numeric_limits<double>::quiet_NaN();
  results.stages[0].time = std::numeric_limits<double>::infinity();
  const auto json = nlohmann::json::parse(results_json(results, {}));
  EXPECT_TRUE(json["values"]["height"]["value"].is_null());
  EXPECT_TRUE(json["stages"][0]["time_s"].is_null());
  EXPECT_EQ(json["message"], "no bracket; height is not a finite number; stage settle.time_s is not a finite number");
}

TEST(ResultsJson, StatesWhyAStageHasNoMeasureOfEquilibrium) {
  Results results = some_results();
  const auto stage = [&](double unbalanced) {
    results.stages[0].unbalanced = unbalanced;
    const auto json = nlohmann::json::parse(results_json(results, {}));
    EXPECT_EQ(json["message"], "no bracket") << unbalanced;
    return json["stages"][0];
  };
  EXPECT_EQ(stage(1e-7)["unbalanced"], 1e-7);
  EXPECT_FALSE(stage(1e-7).contains("unbalanced_note"));
  EXPECT_TRUE(stage(std::numeric_limits<double>::infinity())["unbalanced"].is_null());
  EXPECT_EQ(stage(std::numeric_limits<double>::infinity())["unbalanced_note"], "no contact has a force");
  EXPECT_TRUE(stage(-1)["unbalanced"].is_null());
  EXPECT_EQ(stage(-1)["unbalanced_note"], "equilibrium was not sought");
}

TEST(HistoryCsv, NumbersReadBackExactly) {
  History history;
  history.columns = {"time_s", "wedge, displacement_x_m"};
  history.rows = {{0.1, 1.0 / 3}, {1, std::nan("")}, {1e-300, -5e20}};
  EXPECT_EQ(history_csv(history), "time_s,\"wedge, displacement_x_m\"\n0.1,0.3333333333333333\n1,\n1e-300,-5e+20\n");
}

TEST(Fingerprint, IsFnv1a) {
  // from the authors' published test suite
  EXPECT_EQ(fingerprint(""), "fnv1a64:cbf29ce484222325");
  EXPECT_EQ(fingerprint("a"), "fnv1a64:af63dc4c8601ec8c");
  EXPECT_EQ(fingerprint("foobar"), "fnv1a64:85944171f73967e8");
}

// ---- files --------------------------------------------------------------------------------------------------------

TEST(WriteFile, ReplacesCompleteFilesAndNamesFailures) {
  const TemporaryFolder folder;
  const fs::path file = folder.path / "file";
  write_file(file, "first");
  write_file(file, "second");
  EXPECT_EQ(read(file), "second");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), {}), 1) << "no temporary file is left";
  try {
    write_file(file / "below_a_file", "x");
    FAIL() << "a file is not a folder";
  } catch (const OutputError& error) {
    EXPECT_NE(std::string(error.what()).find("below_a_file': Not a directory"), std::string::npos) << error.what();
  }
  EXPECT_THROW(prepare_folder(file), OutputError);
  EXPECT_THROW(prepare_folder(file / "deeper"), OutputError);
}

}  // namespace
}  // namespace voussoir::output_test
