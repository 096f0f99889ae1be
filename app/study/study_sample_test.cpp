// [[grid]] and [[sample]] of a study: draws and statistics, and their independence of order and process.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <random>

#include "app/study/plan.hpp"
#include "app/study/statistics.hpp"
#include "app/testing/program.hpp"

namespace voussoir::study_sample_test {
namespace {

using namespace program;

// ---- statistics ---------------------------------------------------------------------------------------------------

// P(at most k of n), summed
double at_most(int k, int n, double p) {
  double sum = 0;
  for (int i = 0; i <= k; ++i)
    sum += std::exp(std::lgamma(n + 1) - std::lgamma(i + 1) - std::lgamma(n - i + 1) + i * std::log(p) +
                    (n - i) * std::log1p(-p));
  return sum;
}

// at the ends of the interval the count has a probability of 2.5 % on either side
TEST(ShareFailed, HasTheIntervalOfClopperAndPearson) {
  for (const auto& [count, of] : {std::pair{1, 5}, {3, 20}, {37, 200}, {199, 200}, {500, 1000}}) {
    const Share share = share_with_interval(count, of);
    EXPECT_NEAR(1 - at_most(count - 1, of, share.low), 0.025, 1e-9) << count << " of " << of;
    EXPECT_NEAR(at_most(count, of, share.high), 0.025, 1e-9) << count << " of " << of;
  }
  const Share none = share_with_interval(0, 20), all = share_with_interval(20, 20);
  EXPECT_EQ(none.low, 0);
  EXPECT_NEAR(none.high, 1 - std::pow(0.025, 1.0 / 20), 1e-12);
  EXPECT_EQ(all.high, 1);
  EXPECT_NEAR(all.low, std::pow(0.025, 1.0 / 20), 1e-12);
  EXPECT_LT(share_with_interval(3, 20, 0.5).high, share_with_interval(3, 20, 0.99).high);
}

TEST(Histogram, HoldsEveryResultOnce) {
  const std::vector<double> results{1, 2, 3, 4, 5, 6, 7, 8, 9};
  const std::vector<Bin> bins = histogram_of(results);
  ASSERT_EQ(bins.size(), 3u);
  for (const Bin& bin : bins)
    EXPECT_EQ(bin.count, 3);
  EXPECT_EQ(bins.front().from, 1);
  EXPECT_NEAR(bins.back().to, 9, 1e-14);
  ASSERT_EQ(histogram_of({2, 2}).size(), 1u);
  EXPECT_EQ(histogram_of({2, 2})[0].count, 2);
  EXPECT_TRUE(histogram_of({}).empty());
}

// ---- draws --------------------------------------------------------------------------------------------------------

class StudySample : public Program {
 protected:
  StudySample() { write("scene.toml", read(scenes / "two_cubes.toml")); }

  std::vector<double> drawn(const std::string& law, int rows, int seed = 1) const {
    write("drawn.toml", fmt::format("scene = \"scene.toml\"\nquantity = \"x\"\n[[sample]]\nname = \"a\"\nrows = {}\n"
                                    "seed = {}\nkeys = [{{ key = \"density\", {} }}]\n",
                                    rows, seed, law));
    const StudyPlan plan = read_study_plan(folder_ / "drawn.toml");
    std::vector<double> numbers;
    for (const std::string& value : plan.sweeps.back().with[0].values)
      numbers.push_back(std::stod(value));
    return numbers;
  }

  // largest distance of the empirical distribution from the stated one, times the root of the number of draws
  static double kolmogorov(std::vector<double> numbers, const std::function<double(double)>& law) {
    std::sort(numbers.begin(), numbers.end());
    const auto n = static_cast<double>(numbers.size());
    double distance = 0;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const double at = law(numbers[k]), below = static_cast<double>(k) / n;
      distance = std::max({distance, at - below, below + 1 / n - at});
    }
    return distance * std::sqrt(n);
  }

  std::vector<std::string> table(const std::string& file) const { return lines_of(read(folder_ / file)); }
};

// 1.95: exceeded by one of a thousand samples of the distribution itself
TEST_F(StudySample, DrawsFollowTheirLaws) {
  constexpr int rows = 20'000;
  const auto normal = [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); };
  EXPECT_LT(kolmogorov(drawn("law = \"normal\", mean = 40, deviation = 3", rows),
                       [&](double x) { return normal((x - 40) / 3); }),
            1.95);
  const double variance = std::log(1 + 0.25);  // of the logarithm, if the deviation is half the mean
  EXPECT_LT(kolmogorov(drawn("law = \"lognormal\", mean = 8, deviation = 4", rows),
                       [&](double x) { return normal((std::log(x / 8) + variance / 2) / std::sqrt(variance)); }),
            1.95);
  EXPECT_LT(kolmogorov(drawn("law = \"uniform\", least = -2, most = 6", rows), [](double x) { return (x + 2) / 8; }),
            1.95);
  EXPECT_LT(kolmogorov(drawn("law = \"triangular\", least = 0, mode = 1, most = 4", rows),
                       [](double x) { return x < 1 ? x * x / 4 : 1 - (4 - x) * (4 - x) / 12; }),
            1.95);
  EXPECT_LT(kolmogorov(drawn("law = \"triangular\", least = 0, mode = 0, most = 4", rows),
                       [](double x) { return 1 - (4 - x) * (4 - x) / 16; }),
            1.95);
  const double below = normal(-1), above = normal(2);
  EXPECT_LT(kolmogorov(drawn("law = \"normal\", mean = 40, deviation = 3, least = 37, most = 46", rows),
                       [&](double x) { return (normal((x - 40) / 3) - below) / (above - below); }),
            1.95);
  EXPECT_LT(kolmogorov(drawn("law = \"seed\"", rows), [](double x) { return x / 1e15; }), 1.95);
  for (const double seed : drawn("law = \"seed\"", 100))
    EXPECT_EQ(seed, std::floor(seed));
}

TEST_F(StudySample, ARowDependsOnSeedRowAndKeyAlone) {
  const std::string law = "law = \"normal\", mean = 40, deviation = 3";
  const std::vector<double> all = drawn(law, 100), few = drawn(law, 10), other = drawn(law, 100, 2);
  EXPECT_TRUE(std::equal(few.begin(), few.end(), all.begin()));
  for (std::size_t k = 0; k < all.size(); ++k)
    EXPECT_NE(all[k], other[k]);
  // the same on every platform
  EXPECT_EQ(fmt::format("{} {}", all[0], all[99]), "41.25250829412459 41.06394523518532");
  double products = 0;
  for (std::size_t k = 0; k + 1 < all.size(); ++k)
    products += (all[k] - 40) * (all[k + 1] - 40) / 9;
  EXPECT_LT(std::abs(products) / std::sqrt(99.0), 4) << "neighbouring rows are independent";
}

const char* const sample = R"(
scene = "scene.toml"
quantity = "top_displacement_z"
[[sample]]
name = "stiffness and density"
rows = 24
seed = 5
fails = { below = -2e-4 }
keys = [{ key = "joint_properties.rock.normal_stiffness", law = "lognormal", mean = 1e8, deviation = 3e7, unit = "Pa/m" },
        { key = "density", law = "uniform", least = 1800, most = 2200 }]
)";

// roughness as a sampled key: each row has the factor of its own envelope, on 45 degrees
TEST_F(StudySample, DrawsRoughness) {
  write("cube.toml",
        "dimension = 3\ngravity = [7.0710678118654755, 0, -7.0710678118654755]\ndensity = 2000\n"
        "blocks = [{ name = \"base\", box = { min = [-2, -2, -1], max = [2, 2, 0] }, fixed = true },\n"
        "          { name = \"cube\", box = { min = [0, 0, 0], max = [1, 1, 1] } }]\n"
        "joint_properties = [{ name = \"r\", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 26, "
        "friction_law = \"barton_bandis\", jrc = 7, jcs = 40e6 }]\n");
  write("study.toml",
        "scene = \"cube.toml\"\nblocks = {}\nquantity = \"least_factor\"\n[[sample]]\nname = \"rough\"\nrows = 12\n"
        "keys = [{ key = \"joint_properties.r.jrc\", law = \"uniform\", least = 4, most = 12 }]\n");
  const Ended ended = run("study study.toml --out out");
  ASSERT_EQ(ended.code, 0) << ended.err;
  const std::vector<std::string> rows = table("out/sample_1.csv");
  ASSERT_EQ(rows.size(), 13u);
  for (std::size_t k = 1; k < rows.size(); ++k) {
    double row = 0, jrc = 0, factor = 0;
    ASSERT_EQ(std::sscanf(rows[k].c_str(), "%lf,%lf,%lf", &row, &jrc, &factor), 3) << rows[k];
    EXPECT_NEAR(factor, std::tan((26 + jrc * std::log10(40e6 / (20000 * std::sqrt(0.5)))) * std::numbers::pi / 180),
                1e-9 * factor);
  }
}

TEST_F(StudySample, IsTheSameInAnyOrderAndChunk) {
  write("study.toml", sample);
  const Ended whole = run("study study.toml --out whole");
  ASSERT_EQ(whole.code, 0) << whole.err;
  ASSERT_EQ(run("study plan study.toml --out out").code, 0);
  ASSERT_EQ(run("study run out --rows 20-25,3 --jobs 1").code, 0);
  ASSERT_EQ(run("study run out --chunk 2/3 --jobs 2").code, 0);
  EXPECT_EQ(run("study gather out").code, 1);
  EXPECT_LT(nlohmann::json::parse(read(folder_ / "out/sample_1.json"))["without_result"], 17);
  ASSERT_EQ(run("study run out --chunk 3/3").code, 0);
  ASSERT_EQ(run("study run out --chunk 1/3").code, 0);
  ASSERT_EQ(run("study gather out").code, 0);
  for (const char* name : {"sample_1.csv", "sample_1.json"})
    EXPECT_EQ(read(folder_ / "out" / name), read(folder_ / "whole" / name)) << name;

  // statics of one block: weight over stiffness, so that every row can be verified
  const std::vector<std::string> rows = table("whole/sample_1.csv");
  ASSERT_EQ(rows.size(), 25u);
  EXPECT_EQ(rows[0],
            "row,joint_properties.rock.normal_stiffness (Pa/m),density,top_displacement_z,error_bar,result_unit,status,"
            "fails");
  std::vector<double> results;
  int failed = 0;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    std::istringstream cells(rows[k]);
    std::string cell;
    double numbers[4];
    for (double& number : numbers) {
      std::getline(cells, cell, ',');
      number = std::stod(cell);
    }
    EXPECT_EQ(numbers[0], static_cast<double>(k));
    EXPECT_NEAR(numbers[3], -numbers[2] * 10 / numbers[1], 1e-4 * std::abs(numbers[3])) << rows[k];
    EXPECT_TRUE(rows[k].ends_with(numbers[3] < -2e-4 ? ",yes" : ",no")) << rows[k];
    failed += numbers[3] < -2e-4;
    results.push_back(numbers[3]);
  }
  ASSERT_GT(failed, 0);
  ASSERT_LT(failed, 24);
  const auto json = nlohmann::json::parse(read(folder_ / "whole/sample_1.json"));
  const double mean = std::accumulate(results.begin(), results.end(), 0.0) / 24;
  EXPECT_NEAR(json["mean"].get<double>(), mean, 1e-12);
  double squares = 0;
  for (const double result : results)
    squares += (result - mean) * (result - mean);
  EXPECT_NEAR(json["deviation"].get<double>(), std::sqrt(squares / 23), 1e-12);
  EXPECT_EQ(json["failed"]["count"], failed);
  EXPECT_EQ(json["failed"]["low"].get<double>(), share_with_interval(failed, 24).low);
  int counted = 0;
  for (const auto& bin : json["histogram"])
    counted += bin["count"].get<int>();
  EXPECT_EQ(counted, 24);
  EXPECT_NE(whole.out.find(fmt::format("; {} of them below -0.0002, ", failed)), std::string::npos) << whole.out;
}

TEST_F(StudySample, SeedsOfJointSetsAreDrawn) {
  write("study.toml", R"(
scene = "sets.toml"
quantity = "top_displacement_z"
[[sample]]
name = "seeds"
rows = 4
keys = [{ key = "joint_sets.cross.seed", law = "seed" }]
)");
  const std::string scene = read(scenes / "two_cubes.toml");
  write("sets.toml", scene.substr(0, scene.find("[[monitors]]")) +
                         "[[joint_sets]]\nname = \"cross\"\ndip = 90\ndip_direction = 90\nspacing = 2\n");
  const Ended ended = run("study plan study.toml --out out");
  ASSERT_EQ(ended.code, 0) << ended.err;
  std::set<std::string> hashes;
  for (const std::string& line : table("out/manifest.jsonl"))
    hashes.insert(nlohmann::json::parse(line)["hash"].get<std::string>());
  EXPECT_EQ(hashes.size(), 5u);
}

// ---- grids --------------------------------------------------------------------------------------------------------

const char* const grid = R"(
scene = "scene.toml"
quantity = "top_displacement_z"
[[grid]]
name = "stiffness over density"
fails = { below = -1.5e-4 }
keys = [{ key = "density", values = [1000, 2000], unit = "kg/m3" },
        { key = "joint_properties.rock.normal_stiffness", values = [1e8, 2e8, 4e8] }]
[[grid]]
name = "three"
keys = [{ key = "statics", values = ["local", "adaptive"] },
        { key = "density", values = [1000, 2000] },
        { key = "joint_properties.rock.normal_stiffness", values = [1e8, 2e8] }]
)";

TEST_F(StudySample, AGridIsEveryCombination) {
  write("study.toml", grid);
  const Ended ended = run("study study.toml --out out");
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(
      ended.out.find("grid 'stiffness over density': 6 of 6 combinations have a result, 1 of them below -0.00015"),
      std::string::npos)
      << ended.out;
  const std::vector<std::string> rows = table("out/grid_1.csv");
  ASSERT_EQ(rows.size(), 7u);
  EXPECT_EQ(rows[0],
            "density (kg/m3),joint_properties.rock.normal_stiffness,top_displacement_z,error_bar,result_unit,status,"
            "fails");
  const double settlements[] = {-1e-4, -0.5e-4, -0.25e-4, -2e-4, -1e-4, -0.5e-4};
  for (std::size_t k = 0; k < 6; ++k) {
    const std::string keys = fmt::format("{},{}00000000,", k < 3 ? 1000 : 2000, 1 << k % 3);
    ASSERT_TRUE(rows[k + 1].starts_with(keys)) << rows[k + 1];
    EXPECT_NEAR(std::stod(rows[k + 1].substr(keys.size())), settlements[k], 1e-8);
    EXPECT_TRUE(rows[k + 1].ends_with(k == 3 ? ",m,ok,yes" : ",m,ok,no")) << rows[k + 1];
  }
  EXPECT_EQ(table("out/grid_2.csv").size(), 9u);
  const nlohmann::json axes = nlohmann::json::parse(read(folder_ / "out/grid_1.json"));
  EXPECT_EQ(axes["name"], "stiffness over density");
  EXPECT_EQ(axes["fails_below"], -1.5e-4);
  EXPECT_EQ(axes["unit"], "m");
  EXPECT_EQ(axes["keys"][0], (nlohmann::json{{"key", "density"}, {"unit", "kg/m3"}, {"values", {"1000", "2000"}}}));
  EXPECT_EQ(axes["keys"][1]["values"], (nlohmann::json{"100000000", "200000000", "400000000"}));
  const nlohmann::json three = nlohmann::json::parse(read(folder_ / "out/grid_2.json"));
  ASSERT_EQ(three["keys"].size(), 3u);
  EXPECT_EQ(three["keys"][0]["values"], (nlohmann::json{"local", "adaptive"}));
  const std::string csv = read(folder_ / "out/study.csv");
  EXPECT_NE(csv.find("three,\"statics, density, joint_properties.rock.normal_stiffness\",\"adaptive, 1000, "
                     "200000000\",,top_displacement_z,"),
            std::string::npos)
      << csv;

  // files that are no longer requested are removed
  std::string fewer = grid;
  write("study.toml", fewer.substr(0, fewer.find("[[grid]]\nname = \"three\"")));
  ASSERT_EQ(run("study study.toml --out out").code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "out/grid_2.csv"));
  EXPECT_TRUE(fs::exists(folder_ / "out/grid_1.csv"));
}

TEST_F(StudySample, BothAreReadStrictly) {
  const auto refuse = [&](std::string text, const std::string& from, const std::string& to, const std::string& part) {
    ASSERT_NE(text.find(from), std::string::npos) << from;
    write("study.toml", text.replace(text.find(from), from.size(), to));
    expect_one_line(run("study study.toml --out bad"), 2, part);
    EXPECT_FALSE(fs::exists(folder_ / "bad")) << to;
  };
  refuse(sample, "rows = 24", "rows = 1", "whole number, 2 to 5000000");
  refuse(sample, "rows = 24", "rows = 100001", "with blocks = {} up to 5000000");
  refuse(sample, "rows = 24", "", "rows");
  refuse(sample, "seed = 5", "seed = 1.5", "whole number");
  refuse(sample, "\"lognormal\"", "\"weibull\"", "must be one of");
  refuse(sample, "mean = 1e8, ", "", "must be a number if law = \"lognormal\"");
  refuse(sample, "mean = 1e8", "mean = -1", "must be above 0");
  refuse(sample, "deviation = 3e7", "deviation = -3", "below 0");
  refuse(sample, "most = 2200", "most = 1000", "must be above least");
  refuse(sample, "most = 2200", "most = 2200, mean = 3", "is no number of law");
  refuse(sample, "most = 2200", "most = 2200, mod = 3", "did you mean 'mode'");
  refuse(sample, "law = \"uniform\", least = 1800, most = 2200",
         "law = \"normal\", mean = 0, deviation = 1, least = 50", "hardly ever");
  refuse(sample, "\"density\"", "\"joint_properties.rock.normal_stiffness\"", "must be different keys");
  refuse(sample, "{ below = -2e-4 }", "{ below = 1, above = 2 }", "must be a table { below");
  refuse(sample, "{ below = -2e-4 }", "{}", "must be a table { below");
  refuse(sample, "\"density\"", "\"densty\"", "densty");
  refuse(grid, "values = [1000, 2000], ", "values = [1000], ", "at least two");
  refuse(grid, "[{ key = \"density\", values = [1000, 2000], unit = \"kg/m3\" },", "[", "two or three");
  refuse(grid, "[[grid]]", "[grid]", "");
}

}  // namespace
}  // namespace voussoir::study_sample_test
