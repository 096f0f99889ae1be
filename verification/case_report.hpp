#pragma once
// The report of a case's test: each check is asserted with GoogleTest and becomes a row of the verdict table.
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "verification/comparison/comparison.hpp"
#include "verification/row.hpp"

namespace voussoir::verification {

// Folder for the data files (CSV for the figures, …) of this run; created if it does not exist.
// <VOUSSOIR_CASE_OUTPUT>/<case>, by default <build>/cases/<case>.
std::filesystem::path case_output(const std::string& case_name);

// Collects the rows of one test and writes them to <VOUSSOIR_VERDICTS>/<case>.json, by default <build>/verdicts.
// Several tests and programs may report on one case: rows are merged by quantity. With VOUSSOIR_FRESH set, as CTest
// does for a case's own entry, the first report of a process discards the rows of earlier runs.
class CaseReport {
 public:
  // `promised` names quantities that must have been recorded by the end: a check that is silently left out is a
  // failure.
  explicit CaseReport(std::string case_name, std::vector<std::string> promised = {});
  ~CaseReport();
  CaseReport(const CaseReport&) = delete;
  CaseReport& operator=(const CaseReport&) = delete;

  // Judges, asserts and keeps a row; returns whether it passed. Throws std::invalid_argument for an incomplete check
  // and for a quantity that this case has already recorded in this process. File and line are the caller's, for the
  // failure message (clang 14 has no std::source_location with this standard library).
  bool record(const Check& check, double computed, Cost cost = {}, const char* file = __builtin_FILE(),
              int line = __builtin_LINE());

  // A number without a target: shown in the manual, never judged.
  void report(const std::string& quantity, const std::string& unit, double value, const std::string& note,
              Cost cost = {});

  // The same for a time, or a ratio of times, measured by a clock: it is not compared with earlier versions.
  void report_time(const std::string& quantity, const std::string& unit, double value, const std::string& note);

  // The reference value of this case's study: <case_output>/reference.json.
  void reference(const std::string& quantity, double value, const std::string& unit);

  // Writes the rows so far, marked as unfinished; the destructor writes them all and removes the mark.
  void write();

 private:
  void add(Row row);
  std::string missing_promise() const;
  std::string failure_outside_checks() const;

  std::string case_name_;
  std::vector<std::string> promised_;
  std::vector<Row> rows_;
  std::set<std::string> recorded_;
  std::string test_;
  int exceptions_at_start_ = 0;
};

}  // namespace voussoir::verification
