// results.json: all results of a simulation, with units, in a format that any language reads.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/output/origin.hpp"
#include "core/output/record_output.hpp"
#include "core/output/results.hpp"

namespace voussoir {

// `schema_version` of results.json: another number if a reader of files must know of a change
inline constexpr int results_schema_version = 1;

// One round of `[accuracy] error`; the last one is accurate enough.
struct AccuracyRound {
  std::vector<std::string> settings;         // overrides of the scene in this round
  std::string told;                          // the accuracy of its values, and the settings refined afterwards
  long long contact_evaluations = 0;         // including those of its budget
  std::map<std::string, double> parts = {};  // of error bars: "critical_friction: stiffness"
};

// further contents of results.json besides the results
struct RunRecord {
  std::string title;
  int dimension = 3;
  std::string input_hash;                              // hash of the canonical effective scene
  std::vector<std::pair<std::string, bool>> features;  // parts built in: fast_arithmetic
  std::vector<std::string> warnings;                   // implausible values reported before the run
  int threads = 1;
  std::vector<AccuracyRound> rounds = {};
  std::vector<Origin> origins = {};  // of all programs that contributed
  std::vector<RecordRow> records = {};
};

// "done", "incomplete", "failed"
std::string outcome_name(Outcome outcome);

// Energies in J (2-D: J per metre): now kinetic, elastic, potential; until now lost to friction and damping, put in by
// external work, unexplained; `relative_energy_error` is the largest unexplained of the run over its largest
// energy (core/base/energy.hpp). Numbers have enough digits to be read back exactly. JSON has no NaN: a number that is
// not finite becomes null and the message names it. Entries that depend on the machine are only under `timing`
// (seconds, threads) and `program` (of `origins` the C library's functions): the rest is the same for the same input
// and origin.
std::string results_json(const Results& results, const RunRecord& record);

// throws OutputError
void write_results_json(const std::filesystem::path& path, const Results& results, const RunRecord& record);

}  // namespace voussoir
