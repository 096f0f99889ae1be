// Records in results.json and the table of response spectra.
#include "core/output/record_output.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/load/ground_motion.hpp"
#include "core/load/response_spectrum.hpp"
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

// A monitor that moves as the ground has the ground's spectrum, also if rows are missing where the velocity is linear.
TEST(RecordOutput, AMonitorOfTheGroundHasTheGroundsSpectrum) {
  std::vector<StagePlan> stages = stages_with(MotionQuantity::velocity);
  GroundMotion motion = make_ground_motion(MotionQuantity::velocity, 0.1, {0, 2, 1, 0, 0.5, 0}, {});
  stages[1].change.move[0].records[0].motion = std::make_shared<const GroundMotion>(motion);
  History history{{"time_s", "stage", "block_velocity_y_m_per_s", "block_angular_velocity_rad_per_s"}, {}};
  history.rows = {{5, 1, 7, 0}};
  for (const std::size_t k : {0, 1, 3, 4, 5})
    history.rows.push_back({5 + 0.1 * static_cast<double>(k), 2, motion.velocity[k], 1});
  const CsvTable table = parse_csv(monitor_spectra_csv(history, stages));
  const std::vector<double> periods = usual_periods(0.2);
  const std::vector<ResponseOrdinate> expected = response_spectrum(motion, periods);
  ASSERT_EQ(table.rows.size(), periods.size());
  for (std::size_t k = 0; k < periods.size(); ++k) {
    EXPECT_EQ(table.text(table.rows[k], "column"), "block_velocity_y_m_per_s");
    EXPECT_NEAR(*table.number(table.rows[k], "pseudo_velocity_m_per_s"), expected[k].pseudo_velocity,
                1e-9 * expected[k].pseudo_velocity);
  }
  EXPECT_TRUE(monitor_spectra_csv(history, {StagePlan{}, StagePlan{}}).empty());
}

}  // namespace
}  // namespace voussoir::record_output_test
