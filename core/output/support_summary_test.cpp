#include "core/output/support_summary.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/output/results_json.hpp"

namespace voussoir::support_summary_test {
namespace {

// two bolts in the second stage: one has yielded at two joints, the other is held by its plate
Results supported() {
  Results results;
  results.stages = {{.name = "dig", .kind = "settle"}, {.name = "line", .kind = "settle"}};
  const auto bolt = [&](int stage, int number, int joint, double force, double plastic) {
    BoltRow row;
    row.stage = stage;
    row.bolts = "roof";
    row.bolt = number;
    row.joint = joint;
    row.force = force;
    row.plastic = plastic;
    row.use = std::abs(force) / 60e3;
    results.bolts.push_back(row);
  };
  bolt(1, 1, 1, 80e3, 0);
  bolt(2, 1, 1, 60e3, 1e-3);
  bolt(2, 1, 2, -30e3, 1e-4);
  bolt(2, 2, 0, 12e3, 0);
  results.bolts[2].shear = 5e3;
  for (int node = 1; node <= 3; ++node) {
    LiningRow row;
    row.stage = 2;
    row.lining = "shell";
    row.node = node;
    row.forces.thrust = 100e3 * node;
    row.forces.moment = node == 2 ? -7e3 : 1e3 * node;
    row.pressure = 20e3 * node;
    row.use = 0.1 * node;
    results.linings.push_back(row);
  }
  return results;
}

TEST(SupportSummary, CountsEachBoltOnce) {
  const Results results = supported();
  const SupportsCarry first = supports_carry(results, 1), second = supports_carry(results, 2);
  ASSERT_EQ(first.bolts.size(), 1u);
  EXPECT_TRUE(first.linings.empty());
  EXPECT_EQ(text_of(first.bolts[0]), "bolts roof: 1 bolt, at most 80 kN (bolt 1, joint 1), 133 % of yield");
  ASSERT_EQ(second.bolts.size(), 1u);
  EXPECT_EQ(second.bolts[0].bolts, 2);
  EXPECT_EQ(second.bolts[0].yielded, 1);
  EXPECT_EQ(text_of(second.bolts[0]),
            "bolts roof: 2 bolts, at most 60 kN (bolt 1, joint 1), 5 kN across, 100 % of yield; 1 has yielded");
  ASSERT_EQ(second.linings.size(), 1u);
  EXPECT_EQ(text_of(second.linings[0]),
            "lining shell: thrust 300 kN/m (node 3), moment -7 kN m/m (node 2), rock pressure 60 kPa, 30 % of its "
            "strength");
  EXPECT_TRUE(supports_carry(results, 3).bolts.empty());
}

TEST(SupportSummary, IsInTheResultsOfItsStage) {
  const nlohmann::json json = nlohmann::json::parse(results_json(supported(), {}));
  ASSERT_EQ(json["stages"].size(), 2u);
  EXPECT_EQ(json["stages"][0]["bolts"][0]["force_N"], 80e3);
  EXPECT_FALSE(json["stages"][0].contains("linings"));
  EXPECT_EQ(json["stages"][1]["bolts"][0]["yielded"], 1);
  EXPECT_EQ(json["stages"][1]["linings"][0]["moment_Nm_per_m"], -7e3);
}

}  // namespace
}  // namespace voussoir::support_summary_test
