#include "core/output/record_output.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

#include "core/load/response_spectrum.hpp"
#include "core/output/json_parts.hpp"
#include "text/csv_table.hpp"

namespace voussoir {
namespace {

nlohmann::ordered_json record_json(const RecordRow& row) {
  const GroundMotion& motion = *row.motion;
  const RecordMeasures& m = row.measures;
  nlohmann::ordered_json entry = {{"record", row.number},       {"stage", row.stage},       {"file", motion.name},
                                  {"direction", row.direction}, {"values", m.count},        {"interval_s", m.interval},
                                  {"duration_s", m.duration},   {"begins_s", motion.begins}};
  if (const auto& a = m.acceleration) {
    entry["pga_m_per_s2"] = a->peak;
    entry["arias_m_per_s"] = a->arias;
    entry["cav_m_per_s"] = a->cav;
    entry["significant_duration_s"] = a->significant;
    entry["significant_from_s"] = a->significant_from;
    entry["peak_frequency_hz"] = a->peak_frequency;
  }
  if (m.peak_velocity) entry["pgv_m_per_s"] = *m.peak_velocity;
  entry["pgd_m"] = m.peak_displacement;
  if (m.peak_velocity) {
    entry["end_velocity_m_per_s"] = m.end_velocity;
    entry["stated_end_velocity_m_per_s"] = motion.stated_end_velocity;
  }
  entry["end_displacement_m"] = m.end_displacement;
  entry["stated_end_displacement_m"] = motion.stated_end_displacement;
  entry["correction_over_peak"] = m.taken_off;
  return entry;
}

std::vector<RecordedMotion> records_of(const StagePlan& stage) {
  std::vector<RecordedMotion> all;
  const auto add = [&](const std::vector<RecordedMotion>& records) {
    all.insert(all.end(), records.begin(), records.end());
  };
  for (const MovePlan& move : stage.change.move)
    add(move.records);
  for (const BoundaryPlan& boundary : stage.change.boundary)
    if (boundary.quiet) add(boundary.quiet->records);
  return all;
}

std::string heading(std::vector<std::string> columns) {
  columns.insert(columns.end(), {"period_s", "frequency_hz", "displacement_m", "pseudo_velocity_m_per_s",
                                 "pseudo_acceleration_m_per_s2"});
  return csv_line(columns) + "\n";
}

std::string spectrum_lines(const std::vector<std::string>& of, const std::vector<LinearPiece>& pieces,
                           double interval) {
  std::string text;
  for (const ResponseOrdinate& r : response_spectrum(pieces, usual_periods(interval))) {
    std::vector<std::string> cells = of;
    for (const double value : {r.period, 1 / r.period, r.displacement, r.pseudo_velocity, r.pseudo_acceleration})
      cells.push_back(csv_cell(value));
    text += csv_line(cells) + "\n";
  }
  return text;
}

// "block_velocity_x_m_per_s"
bool is_velocity(const std::string& column) {
  return column.ends_with("_m_per_s") && column.find("_velocity_") != std::string::npos;
}

// a column's values between the rows of a stage, as accelerations
struct RowsOfStage {
  std::vector<LinearPiece> pieces;
  double longest = 0;  // s
};
RowsOfStage rows_of(const History& history, int stage, std::size_t column) {
  RowsOfStage found;
  const std::vector<double>* last = nullptr;
  for (const std::vector<double>& row : history.rows) {
    if (row[1] != stage) continue;
    if (last && row[0] > (*last)[0]) {
      const double time = row[0] - (*last)[0], constant = (row[column] - (*last)[column]) / time;
      found.pieces.push_back({time, constant, constant});
      found.longest = std::max(found.longest, time);
    }
    last = &row;
  }
  return found;
}

}  // namespace

std::vector<RecordRow> record_rows(const std::vector<StagePlan>& stages) {
  std::vector<RecordRow> rows;
  for (const StagePlan& stage : stages)
    for (const RecordedMotion& record : records_of(stage))
      rows.push_back({static_cast<int>(rows.size()) + 1, stage.name, record.direction, record.motion,
                      measures_of(*record.motion)});
  return rows;
}

nlohmann::ordered_json records_json(const std::vector<RecordRow>& rows) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const RecordRow& row : rows)
    list.push_back(record_json(row));
  return list;
}

std::string record_spectra_csv(const std::vector<RecordRow>& rows) {
  std::string text;
  for (const RecordRow& row : rows)
    text += spectrum_lines({csv_cell(static_cast<double>(row.number)), row.motion->name},
                           acceleration_pieces(*row.motion), row.motion->interval);
  return text.empty() ? text : heading({"record", "file"}) + text;
}

std::string monitor_spectra_csv(const History& history, const std::vector<StagePlan>& stages) {
  std::string text;
  for (std::size_t stage = 0; stage < stages.size(); ++stage) {
    if (records_of(stages[stage]).empty()) continue;
    for (std::size_t k = 2; k < history.columns.size(); ++k) {
      if (!is_velocity(history.columns[k])) continue;
      const RowsOfStage of = rows_of(history, static_cast<int>(stage) + 1, k);
      text += spectrum_lines({stages[stage].name, history.columns[k]}, of.pieces, of.longest);
    }
  }
  return text.empty() ? text : heading({"stage", "column"}) + text;
}

}  // namespace voussoir
