#include "core/output/record_output.hpp"

#include <nlohmann/json.hpp>

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

}  // namespace

std::vector<RecordRow> record_rows(const std::vector<StagePlan>& stages) {
  std::vector<RecordRow> rows;
  for (const StagePlan& stage : stages) {
    const auto add = [&](const std::vector<RecordedMotion>& records) {
      for (const RecordedMotion& record : records)
        rows.push_back({static_cast<int>(rows.size()) + 1, stage.name, record.direction, record.motion,
                        measures_of(*record.motion)});
    };
    for (const MovePlan& move : stage.change.move)
      add(move.records);
    for (const BoundaryPlan& boundary : stage.change.boundary)
      if (boundary.quiet) add(boundary.quiet->records);
  }
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
    for (const ResponseOrdinate& r : response_spectrum(*row.motion, usual_periods(row.motion->interval)))
      text += csv_line({csv_cell(static_cast<double>(row.number)), row.motion->name, csv_cell(r.period),
                        csv_cell(1 / r.period), csv_cell(r.displacement), csv_cell(r.pseudo_velocity),
                        csv_cell(r.pseudo_acceleration)}) +
              "\n";
  if (text.empty()) return text;
  return csv_line({"record", "file", "period_s", "frequency_hz", "displacement_m", "pseudo_velocity_m_per_s",
                   "pseudo_acceleration_m_per_s2"}) +
         "\n" + text;
}

}  // namespace voussoir
