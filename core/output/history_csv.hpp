// history.csv: the monitors over time. One header line, the unit at the end of each column's name; every number has the
// fewest digits that read back to the same number. Columns:
//   time_s                 simulated time
//   stage                  from 1
//   trial                  if a stage searches: 0 on the path to the result, whose time never goes back, or the
//                          number, from 1, of the trial that ended here and was undone
//   friction_<name>_deg    friction angle in force of each joint property whose friction a stage reduces or states
//   <monitor>_<quantity>…  quantities of the monitors (core/output/monitor.hpp)
#pragma once

#include <filesystem>
#include <string>

#include "core/output/results.hpp"

namespace voussoir {

// a number that is not finite leaves its cell empty
std::string history_csv(const History& history);

// throws OutputError
void write_history_csv(const std::filesystem::path& path, const History& history);

}  // namespace voussoir
