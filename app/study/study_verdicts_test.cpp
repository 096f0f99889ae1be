// Reports of a study on rows near its limit, on results that its runs did not write, and on keys without effect.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "app/study/findings.hpp"
#include "app/study/idle.hpp"
#include "app/study/plan.hpp"
#include "app/testing/planned_study.hpp"

namespace voussoir::study_verdicts_test {
namespace {

namespace fs = std::filesystem;

// ---- rows near the limit ------------------------------------------------------------------------------------------

// P(at most k of n), summed
double binomial_at_most(int k, int n, double p) {
  double sum = 0;
  for (int i = 0; i <= k; ++i)
    sum += std::exp(std::lgamma(n + 1) - std::lgamma(i + 1) - std::lgamma(n - i + 1) + i * std::log(p) +
                    (n - i) * std::log1p(-p));
  return sum;
}

struct Row {
  std::optional<double> result, bar;
};

StudyPlan plan_of(Varied varied, std::size_t rows, bool below, double limit) {
  StudyPlan plan;
  plan.quantity = "factor_of_safety";
  Sweep sweep{.varied = varied, .name = "some"};
  TiedKey a{"a", {}}, b{"b", {}};
  for (std::size_t k = 0; k < rows; ++k) {
    sweep.values.push_back(std::to_string(k + 1));
    a.values.push_back(std::to_string(k / 2));
    b.values.push_back(std::to_string(k % 2));
  }
  sweep.with = {a, b};
  sweep.counts = {rows / 2, 2};
  sweep.numbers.resize(rows);
  sweep.fails = Fails{below, limit};
  plan.sweeps = {sweep};
  return plan;
}

std::vector<StudyRow> table_rows(const std::vector<Row>& rows) {
  std::vector<StudyRow> table;
  for (const Row& row : rows) {
    StudyRow& line = table.emplace_back();
    line.curve = "some";
    line.result = row.result;
    line.error_bar = row.bar;
    line.result_unit = "1";
    if (!row.result) line.status = "failed: nothing";
  }
  return table;
}

std::string content(const Findings& findings, const std::string& name) {
  for (const auto& [file, text] : findings.files)
    if (file == name) return text;
  return "";
}

// whether the interval contains the limit, from its two ends alone
char judged(const Row& row, bool below, double limit) {
  if (!row.result) return '-';
  const double low = *row.result - row.bar.value_or(0), high = *row.result + row.bar.value_or(0);
  if (row.bar && low <= limit && limit <= high) return '?';
  if (below) return *row.result < limit ? 'f' : 's';
  return *row.result > limit ? 'f' : 's';
}

TEST(RowsNearTheLimit, AreNeitherFailedNorStable) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform;
  int undecided_in_all = 0;
  for (int k = 0; k < 300; ++k) {
    // halves and quarters, so that limits are also at ends of brackets
    const bool below = random() % 2 == 0;
    const double limit = 0.25 * static_cast<double>(random() % 5);
    std::vector<Row> rows(2 * (1 + random() % 12));
    for (Row& row : rows) {
      if (uniform(random) < 0.15) continue;
      row.result = uniform(random) < 0.5 ? 0.25 * static_cast<double>(random() % 7) : 1.5 * uniform(random);
      if (uniform(random) < 0.7) row.bar = uniform(random) < 0.5 ? 0.25 : 0.3 * uniform(random);
    }
    if (k == 0) rows = {{0.99902, 0.0068}, {0.9, 0.0068}}, rows.resize(2);
    const double at = k == 0 ? 1 : limit;
    std::string verdicts;
    for (const Row& row : rows)
      verdicts += judged(row, below, at);
    const auto count = [&](char c) { return static_cast<int>(std::ranges::count(verdicts, c)); };
    const int f = count('f'), s = count('s'), u = count('?'), n = f + s + u;
    undecided_in_all += u;

    const StudyPlan plan = plan_of(Varied::sample, rows.size(), below, at);
    const Findings findings = findings_of(plan, table_rows(rows));
    const auto json = nlohmann::json::parse(content(findings, "sample_1.json"));
    const std::string line = findings.lines.at(0);
    if (n == 0) {
      EXPECT_FALSE(json.contains("failed"));
      continue;
    }
    EXPECT_EQ(json["failed"]["count"], f);
    EXPECT_EQ(json["failed"]["standing"], s);
    EXPECT_EQ(json["failed"]["undecided"], u);
    EXPECT_NEAR(json["failed"]["share"].get<double>(), f / double(n), 1e-15);
    EXPECT_NEAR(json["failed"]["share_with_undecided"].get<double>(), (f + u) / double(n), 1e-15);
    // the interval's ends: at the lower as many as failed, at the upper all that may have, come up in 2.5 %
    const double low = json["failed"]["low"], high = json["failed"]["high"];
    if (f > 0) {
      EXPECT_NEAR(1 - binomial_at_most(f - 1, n, low), 0.025, 1e-9);
    } else {
      EXPECT_EQ(low, 0);
    }
    if (f + u < n) {
      EXPECT_NEAR(binomial_at_most(f + u, n, high), 0.025, 1e-9);
    } else {
      EXPECT_EQ(high, 1);
    }
    const std::string counted = fmt::format("; {} of them {} {:g}, {} ", f, below ? "below" : "above", at, s);
    EXPECT_NE(line.find(counted), std::string::npos) << line;
    EXPECT_EQ(line.find(fmt::format(", {} within {} of {:g}: ", u, u == 1 ? "its error bar" : "their error bars",
                                    at)) != std::string::npos,
              u > 0)
        << line;

    std::istringstream csv(content(findings, "sample_1.csv"));
    std::string text;
    std::getline(csv, text);
    for (const char verdict : verdicts) {
      std::getline(csv, text);
      const std::string cell = text.substr(text.rfind(',') + 1);
      EXPECT_EQ(cell, verdict == 'f' ? "yes" : verdict == 's' ? "no" : verdict == '?' ? "undecided" : "") << text;
    }

    // a grid's table has the same verdicts: its map draws a cross or a ring into these
    const Findings grid = findings_of(plan_of(Varied::grid, rows.size(), below, at), table_rows(rows));
    const std::string cells = content(grid, "grid_1.csv");
    const auto times = [&](const std::string& part) {
      int found = 0;
      for (std::size_t from = cells.find(part); from != std::string::npos; from = cells.find(part, from + 1))
        ++found;
      return found;
    };
    EXPECT_EQ(times(",undecided\n"), u);
    EXPECT_EQ(times(",yes\n"), f);
    EXPECT_EQ(times(",no\n"), s);
    EXPECT_NE(grid.lines.at(0).find(counted.substr(2)), std::string::npos) << grid.lines.at(0);
  }
  EXPECT_GT(undecided_in_all, 100);
}

// ---- results that a run did not write -----------------------------------------------------------------------------

class StudyResults : public PlannedStudy {
 protected:
  // a study of few rows, done
  std::string done(const std::string& plan) const {
    write("study.toml", plan);
    const std::string out = planned("out");
    EXPECT_EQ(study({"run", out}).code, 0);
    EXPECT_EQ(study({"gather", out}).code, 0);
    return out;
  }
};

const char* const few_rows = R"(
scene = "scene.toml"
quantity = "top_displacement_z"
[[sweep]]
name = "density"
key = "density"
values = [1000, 1100, 1200]
)";

const char* const few_histories = R"(
scene = "scene.toml"
quantity = "deepest"
history = { column = "top_displacement_z_m", take = "smallest", unit = "m" }
[[sweep]]
name = "density"
key = "density"
values = [1000, 1100, 1200]
)";

TEST_F(StudyResults, AChangedValueIsRefusedWithItsRow) {
  const std::string out = done(few_rows), whole = table("out");
  const fs::path results = run_of("out", 3) / "results.json";
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(read(results));
  json["values"]["top_displacement_z"]["value"] = -99;
  std::ofstream(results) << json.dump(2);
  const Ended gathered = study({"gather", out});
  expect_one_line(
      gathered, 2,
      "row 3 (density: density = 1100): '" + results.string() + "' differs from the file that its run wrote");
  EXPECT_NE(gathered.err.find("'voussoir study run " + out + " --rows 3'"), std::string::npos) << gathered.err;
  EXPECT_EQ(table("out"), whole) << "nothing was written";
  EXPECT_NE(study({"status", out}).out.find("row 3 (density: density = 1100): '"), std::string::npos);
  const Ended again = study({"run", out, "--rows", "3"});
  EXPECT_NE(again.out.find("1 different runs, 0 of them kept"), std::string::npos) << again.out;
  EXPECT_EQ(study({"gather", out}).code, 0);
  EXPECT_EQ(table("out"), whole);
}

// bytes of results and histories changed, cut or removed at random: never a number that no run wrote
TEST_F(StudyResults, ChangedBytesAreNeverAccepted) {
  std::mt19937 random(22);
  for (const char* plan : {few_rows, few_histories}) {
    const std::string out = done(plan), whole = table("out");
    const fs::path run = run_of("out", 2);
    const std::string name = plan == few_rows ? "results.json" : "history.csv", bytes = read(run / name);
    for (int k = 0; k < 12; ++k) {
      std::string other = bytes;
      if (k % 3 == 0)
        other[random() % other.size()] ^= static_cast<char>(1 << (random() % 7));
      else if (k % 3 == 1)
        other.resize(random() % other.size());
      else
        other.insert(random() % other.size(), "7");
      std::ofstream(run / name, std::ios::binary) << other;
      const Ended gathered = study({"gather", out});
      ASSERT_TRUE(gathered.code == 1 || gathered.code == 2) << gathered.out << gathered.err;
      const std::string told = gathered.code == 1 ? gathered.out : gathered.err;
      EXPECT_NE(told.find((run / name).string()), std::string::npos) << told;
      EXPECT_NE(told.find("row 2 (density: density = 1000)"), std::string::npos) << told;
      EXPECT_NE(told.find(fmt::format("'voussoir study run {} --rows 2'", out)), std::string::npos) << told;
      EXPECT_EQ(told.find("-99"), std::string::npos);
    }
    EXPECT_NE(study({"status", out}).out.find("not run: 2\n"), std::string::npos) << study({"status", out}).out;
    EXPECT_EQ(study({"run", out}).code, 0);
    EXPECT_EQ(study({"gather", out}).code, 0);
    EXPECT_EQ(table("out"), whole) << "repeated";
    fs::remove_all(out);
  }
}

TEST_F(StudyResults, TruncatedFilesAndHashesAreRepeated) {
  const std::string out = done(few_rows), whole = table("out");
  const fs::path run = run_of("out", 4);
  const std::string results = read(run / "results.json");
  for (const char* name : {"results.json", "results.hash"}) {
    std::ofstream(run / name) << "{";
    const Ended gathered = study({"gather", out});
    EXPECT_EQ(gathered.code, 1);
    EXPECT_NE(gathered.out.find(fmt::format("row 4 (density: density = 1200): '{}' is damaged", (run / name).string())),
              std::string::npos)
        << gathered.out;
    EXPECT_NE(gathered.out.find("not run: 4; run them with"), std::string::npos) << gathered.out;
    EXPECT_EQ(study({"run", out}).code, 0);
    EXPECT_EQ(study({"gather", out}).code, 0);
    EXPECT_EQ(table("out"), whole);
  }
  fs::remove(run / "results.hash");
  EXPECT_NE(study({"gather", out}).out.find("results.hash' is missing"), std::string::npos);
  // the same in one command
  EXPECT_EQ(study({at("study.toml"), "--out", out}).code, 0);
  EXPECT_EQ(table("out"), whole);
  std::ofstream(run / "results.json") << results;
  EXPECT_EQ(study({"gather", out}).code, 2) << "of another run: its seconds differ from the hashed ones";
}

// of two copies the intact one counts; a changed copy is refused nevertheless
TEST_F(StudyResults, OfTwoCopiesTheIntactOneCounts) {
  const std::string first = done(few_rows), whole = table("out"), second = at("second");
  fs::copy(first, second, fs::copy_options::recursive);
  std::ofstream(run_of("out", 2) / "results.json") << "";
  EXPECT_EQ(study({"gather", first}).code, 1);
  EXPECT_EQ(study({"gather", first, second}).code, 0);
  EXPECT_EQ(table("out"), whole);
  const fs::path results = run_of("second", 2) / "results.json";
  std::string text = read(results);
  std::ofstream(results) << text << " ";
  expect_one_line(study({"gather", first, second}), 2, results.string());
}

// ---- keys that nothing uses ---------------------------------------------------------------------------------------

const char* const slope = R"(dimension = 2
gravity = [0, -9.81]
density = 2600
domain = { box = { min = [-2, -2], max = [2, 2] } }
[[joints]]
name = "plane"
dip = 20
dip_direction = 270
point = [0, 0]
properties = "rock"
[[joint_properties]]
name = "rock"
normal_stiffness = 1e9
shear_stiffness = 1e8
friction_deg = 40
cohesion = 5e3
bonds = "by_stage"
[[joint_properties]]
name = "spare"
normal_stiffness = 1e9
shear_stiffness = 1e8
friction_deg = 30
[[fix]]
below = ["plane"]
[[restrain]]
above = ["plane"]
rotation = true
[[stage]]
name = "settle"
kind = "settle"
friction = [{ name = "rock", friction_deg = 60 }]
[[stage]]
name = "safety"
kind = "reduce"
search = "factor"
joint_properties = ["rock"]
friction = [{ name = "rock", friction_deg = 40 }]
from_factor = 0.5
to_factor = 5
tolerance_factor = 0.05
failure_displacement = 0.002
)";

struct KeyOfStudy {
  std::string key, values;
  bool acts, acts_in_limit;
};

class StudyKeys : public PlannedStudy {
 protected:
  StudyKeys() { write("scene.toml", slope); }

  std::string sweep(const KeyOfStudy& key, const std::string& top = "") const {
    return "scene = \"scene.toml\"\nquantity = \"factor_of_safety\"\n" + top + "[[sweep]]\nname = \"one\"\nkey = \"" +
           key.key + "\"\nvalues = " + key.values + "\n";
  }
  std::vector<std::string> idle(const std::string& text) const {
    write("study.toml", text);
    return idle_keys(read_study_plan(at("study.toml")));
  }
};

TEST_F(StudyKeys, AreKnownToBeIdleBeforeAnyRun) {
  const KeyOfStudy keys[] = {
      {"joint_properties.rock.friction_deg", "[30, 35]", false, true},
      {"joint_properties.rock.cohesion", "[1e3, 2e3]", false, false},
      {"joint_properties.spare.friction_deg", "[30, 35]", false, false},
      {"joint_properties.spare.normal_stiffness", "[1e9, 2e9]", false, false},
      {"title", "[\"one\", \"two\"]", false, false},
      {"joint_properties.rock.normal_stiffness", "[1e9, 2e9]", true, false},
      {"stage.safety.friction.rock.friction_deg", "[30, 35]", true, false},
      {"stage.settle.friction.rock.friction_deg", "[50, 60]", true, false},
      {"joints.plane.dip", "[20, 25]", true, true},
      {"density", "[2600, 2700]", true, true},
      {"time.fraction", "[0.1, 0.2]", true, false},
  };
  for (const KeyOfStudy& key : keys) {
    EXPECT_EQ(idle(sweep(key)).size(), key.acts ? 0 : 1) << key.key;
    EXPECT_EQ(idle(sweep(key, "limit = { factor = true }\n")).size(), key.acts_in_limit ? 0 : 1) << key.key;
  }
  // the friction whose critical angle is sought does not act; cohesion does if requested, or if a stage bonds
  EXPECT_EQ(idle(sweep(keys[0], "limit = {}\n")).size(), 1u);
  EXPECT_EQ(idle(sweep(keys[0], "limit = { friction = [\"spare\"] }\n")).size(), 0u);
  EXPECT_EQ(idle(sweep(keys[1], "limit = { factor = true, cohesion = true }\n")).size(), 0u);
  EXPECT_EQ(idle(sweep(keys[1], "set = [\"stage.settle.bond=true\"]\n")).size(), 0u);
  const std::string as_sliced = "set = [\"joint_properties.rock.bonds=as_sliced\"]\n";
  EXPECT_EQ(idle(sweep(keys[1], as_sliced)).size(), 0u);
  EXPECT_EQ(idle(sweep(keys[1], as_sliced + "limit = { factor = true }\n")).size(), 0u);
  EXPECT_EQ(idle(sweep({"density", "[2600, 2600]", true, true})).size(), 0u) << "nothing is varied";
}

TEST_F(StudyKeys, OfGridsAndSamplesAreJudgedSeparately) {
  const std::string top = "scene = \"scene.toml\"\nquantity = \"factor_of_safety\"\n";
  const std::vector<std::string> grid = idle(
      top +
      "[[grid]]\nname = \"map\"\nkeys = [{ key = \"joint_properties.rock.friction_deg\", values = [30, 40] }, { key = "
      "\"joints.plane.dip\", values = [20, 25] }]\n");
  ASSERT_EQ(grid.size(), 1u);
  EXPECT_NE(grid[0].find("grid 'map': joint_properties.rock.friction_deg acts in no stage of '"), std::string::npos)
      << grid[0];
  EXPECT_EQ(
      idle(top +
           "[[sample]]\nname = \"drawn\"\nrows = 12\nkeys = [{ key = \"joint_properties.rock.friction_deg\", law = "
           "\"normal\", mean = 40, deviation = 2 }, { key = \"joint_properties.rock.cohesion\", law = \"uniform\", "
           "least = 1e3, most = 2e3 }]\n")
          .size(),
      2u);
}

// a sample that fails "with certainty": planned and gathered, and in one command
TEST_F(StudyKeys, AreWarnedOfWhenPlannedAndWhenGathered) {
  write(
      "study.toml",
      "scene = \"scene.toml\"\nquantity = \"factor_of_safety\"\n[[sample]]\nname = \"drawn\"\nrows = 3\nfails = { "
      "below "
      "= 5 }\nkeys = [{ key = \"joint_properties.rock.friction_deg\", law = \"normal\", mean = 40, deviation = 2 }]\n");
  const Ended plan = study({"plan", at("study.toml"), "--out", at("out")});
  expect_one_line(plan, 0, "warning: sample 'drawn': joint_properties.rock.friction_deg acts in no stage of '");
  EXPECT_EQ(study({"run", at("out")}).err, "");
  const Ended gathered = study({"gather", at("out")});
  EXPECT_EQ(gathered.code, 0) << gathered.err;
  EXPECT_NE(
      gathered.err.find("warning: sample 'drawn': the results do not depend on joint_properties.rock.friction_deg"),
      std::string::npos)
      << gathered.err;
  const Ended whole = study({at("study.toml"), "--out", at("whole")});
  EXPECT_EQ(whole.code, 0);
  EXPECT_NE(whole.err.find("acts in no stage"), std::string::npos) << whole.err;
  EXPECT_NE(whole.err.find("the results do not depend on"), std::string::npos) << whole.err;
  EXPECT_NE(whole.out.find("factor_of_safety divides tan φ and cohesion of 'rock'; not "), std::string::npos)
      << whole.out;
}

// results with a known spread and known bars, judged from their numbers alone
TEST(FlatResults, AreThoseThatDifferByLessThanTheirBars) {
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 200; ++k) {
    const std::size_t count = 4 + 2 * (random() % 8);
    const double spread = k % 4 == 0 ? 0 : std::pow(10, -4.0 + 4.0 * static_cast<double>(random() % 1000) / 1000),
                 bar = std::pow(10, -4.0 + 4.0 * static_cast<double>(random() % 1000) / 1000);
    std::vector<Row> rows(count);
    double sum = 0, squares = 0;
    for (Row& row : rows) {
      row = {1.3 + spread * normal(random), bar};
      sum += *row.result;
    }
    for (const Row& row : rows)
      squares += std::pow(*row.result - sum / static_cast<double>(count), 2);
    const double deviation = std::sqrt(squares / static_cast<double>(count - 1));
    for (const Varied varied : {Varied::sample, Varied::grid}) {
      const std::vector<std::string> lines = flat_results(plan_of(varied, count, true, 1), table_rows(rows));
      const bool flat = spread == 0, within = !flat && deviation < bar;
      ASSERT_EQ(lines.size(), flat || within ? 1u : 0u) << deviation << " " << bar;
      const std::string expected = flat ? "the results do not depend on a, b" : "is below their mean error bar";
      if (!lines.empty()) {
        EXPECT_NE(lines[0].find(expected), std::string::npos) << lines[0];
      }
    }
  }
}

// the results of a grid may be independent of one of its keys
TEST(FlatResults, AreFoundAlongAKeyOfAGrid) {
  std::vector<Row> rows;
  for (int k = 0; k < 8; ++k)
    rows.push_back({1.0 + k / 2, {}});
  const std::vector<std::string> lines = flat_results(plan_of(Varied::grid, 8, true, 1), table_rows(rows));
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines[0].find("grid 'some': the results do not depend on b"), std::string::npos) << lines[0];
}

}  // namespace
}  // namespace voussoir::study_verdicts_test
