// results.json: everything a simulation found, with units, in a form that any language reads.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/output/origin.hpp"
#include "core/output/results.hpp"

namespace voussoir {

inline constexpr int results_schema_version = 1;

// One answer of those that `[accuracy] error` asks for, until the last is accurate enough.
struct AccuracyRound {
  std::vector<std::string> settings;  // overrides of the scene that it was found with
  std::string told;                   // how far its values are known, and what was made finer then
  long long contact_evaluations = 0;  // those of its budget included
};
nlohmann::ordered_json rounds_json(const std::vector<AccuracyRound>& rounds);

// what results.json says besides the results themselves
struct RunRecord {
  std::string title;
  int dimension = 3;
  std::string input_hash;                              // fingerprint of the canonical effective scene
  std::vector<std::pair<std::string, bool>> features;  // parts built in: glpk, fast_arithmetic
  std::vector<std::string> warnings;                   // what looked implausible before the run
  int threads = 1;
  std::vector<AccuracyRound> rounds = {};
  std::vector<Origin> origins = {};  // of all that had a part in it
};

// "done", "incomplete", "failed"
std::string outcome_name(Outcome outcome);

// Energies in J (2-D: J per metre): now kinetic, elastic, potential; until now lost to friction and damping, put in by
// external work, unexplained; `closure` is the largest unexplained of the run over its largest energy
// (core/base/energy.hpp). Numbers have the digits to be read back exactly. JSON knows no NaN: a number that is not
// finite becomes null and the message says which. What depends on the machine stands under `timing` (seconds, threads)
// and `program` (of `origins` the C library's functions) alone: the rest is the same for the same input and origin.
std::string results_json(const Results& results, const RunRecord& record);

// throws OutputError
void write_results_json(const std::filesystem::path& path, const Results& results, const RunRecord& record);

}  // namespace voussoir
