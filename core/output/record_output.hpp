// Records as results show them: their measures, and their response spectra.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/settings.hpp"
#include "core/load/record_measures.hpp"
#include "core/output/results.hpp"

namespace voussoir {

inline constexpr const char* record_spectra_file = "record_spectra.csv";
inline constexpr const char* monitor_spectra_file = "monitor_spectra.csv";

struct RecordRow {
  int number = 1;  // by stage, then by move
  std::string stage;
  std::vector<double> direction;
  std::shared_ptr<const GroundMotion> motion;
  RecordMeasures measures;
};

// every record that the stages prescribe
std::vector<RecordRow> record_rows(const std::vector<StagePlan>& stages);

// The response at 5 % of critical damping, a row for each record and period; empty if no record has accelerations.
// Columns: record, file, period_s, frequency_hz, displacement_m (largest relative to the ground),
// pseudo_velocity_m_per_s, pseudo_acceleration_m_per_s2.
std::string record_spectra_csv(const std::vector<RecordRow>& rows);

// The same of the velocities that monitors have along the axes in stages with records, linear between the rows of the
// history: periods below two of its longest intervals are left out. Empty without such monitors. Columns: stage, column
// (of the history), then as above from period_s on.
std::string monitor_spectra_csv(const History& history, const std::vector<StagePlan>& stages);

}  // namespace voussoir
