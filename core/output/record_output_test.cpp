// Records in results.json and the table of response spectra.
#include "core/output/record_output.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/load/ground_motion.hpp"
#include "core/output/json_parts.hpp"
#include "text/csv_table.hpp"

namespace voussoir::record_output_test {
namespace {

std::vector<StagePlan> stages_with(MotionQuantity quantity) {
  GroundMotion motion = make_ground_motion(quantity, 0.1, {0, 2, -1, 0}, {.pad = 0.5});
  motion.name = "a, b.at2";
  StagePlan stage;
  stage.name = "shake";
  MovePlan move;
  move.records = {{{0, 1}, std::make_shared<const GroundMotion>(motion)}};
  stage.change.move = {move};
  return {StagePlan{}, stage};
}

TEST(RecordOutput, HasTheMeasuresOfEveryRecord) {
  const std::vector<RecordRow> rows = record_rows(stages_with(MotionQuantity::acceleration));
  ASSERT_EQ(rows.size(), 1u);
  const nlohmann::ordered_json json = records_json(rows);
  EXPECT_EQ(json[0]["stage"], "shake");
  EXPECT_EQ(json[0]["file"], "a, b.at2");
  EXPECT_EQ(json[0]["pga_m_per_s2"], 2);
  EXPECT_EQ(json[0]["values"], 4);
  EXPECT_EQ(json[0]["begins_s"], 0.5);
  EXPECT_NEAR(json[0]["end_velocity_m_per_s"].get<double>(), 0.1, 1e-15);  // 0.1 + 0.05 - 0.05
  EXPECT_NEAR(json[0]["cav_m_per_s"].get<double>(), 0.1 + 0.1 * 5 / 6 + 0.05, 1e-15);
  // a displacement has no acceleration
  const nlohmann::ordered_json displacement = records_json(record_rows(stages_with(MotionQuantity::displacement)));
  EXPECT_FALSE(displacement[0].contains("pga_m_per_s2"));
  EXPECT_EQ(displacement[0]["pgd_m"], 2);
}

TEST(RecordOutput, SpectraAreATableThatReadsBack) {
  const CsvTable table = parse_csv(record_spectra_csv(record_rows(stages_with(MotionQuantity::acceleration))));
  ASSERT_GT(table.rows.size(), 30u);
  for (const CsvRow& row : table.rows) {
    EXPECT_EQ(table.text(row, "file"), "a, b.at2");
    EXPECT_NEAR(*table.number(row, "period_s") * *table.number(row, "frequency_hz"), 1, 1e-12);
    EXPECT_GT(*table.number(row, "displacement_m"), 0);
  }
  EXPECT_TRUE(record_spectra_csv(record_rows(stages_with(MotionQuantity::displacement))).empty());
}

}  // namespace
}  // namespace voussoir::record_output_test
