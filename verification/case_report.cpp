#include "verification/case_report.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <exception>
#include <map>
#include <stdexcept>
#include <utility>

#include "verification/verdict_file.hpp"

namespace voussoir::verification {
namespace {

namespace fs = std::filesystem;

fs::path folder(const char* variable, const char* name_in_build) {
  const char* chosen = std::getenv(variable);
  return chosen && *chosen ? fs::path(chosen) : fs::path(VOUSSOIR_BUILD_DIR) / name_in_build;
}

fs::path verdict_path(const std::string& case_name) {
  return folder("VOUSSOIR_VERDICTS", "verdicts") / (case_name + ".json");
}

// written at every build, so that no source is compiled again when only the commit has changed
std::string current_commit() {
  try {
    std::string commit = read_text(fs::path(VOUSSOIR_BUILD_DIR) / "commit.txt");
    while (!commit.empty() && std::isspace(static_cast<unsigned char>(commit.back())))
      commit.pop_back();
    return commit.empty() ? "unknown" : commit;
  } catch (const std::runtime_error&) {
    return "unknown";
  }
}

std::string current_test() {
  const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
  return info ? fmt::format("{}.{}", info->test_suite_name(), info->name()) : "outside any test";
}

// is in the file until the report is destroyed: a crash or a timeout leaves it there
constexpr const char* unfinished = "stopped before its end";

// true once per case and process, when rows of earlier runs are to be discarded
bool first_of_a_fresh_run(const std::string& case_name) {
  static std::set<std::string> started;
  const char* fresh = std::getenv("VOUSSOIR_FRESH");
  return started.insert(case_name).second && fresh && *fresh;
}

// the test that recorded a quantity: the same test may do so again (--gtest_repeat), another would hide the first
std::map<std::pair<std::string, std::string>, std::string>& recorder_of() {
  static std::map<std::pair<std::string, std::string>, std::string> recorders;
  return recorders;
}

std::string describe(const Row& row) {
  const Check& check = row.check;
  const char* sign = check.tolerance.bound == Bound::at_most    ? "at most "
                     : check.tolerance.bound == Bound::at_least ? "at least "
                                                                : "";
  // fmt compares the number that it prints: under floating-point traps a NaN would end the program unreported
  const std::string computed = std::isnan(row.computed) ? "nan" : fmt::format("{:.9g}", row.computed);
  return fmt::format("{}: {} = {} {}, expected {}{:.9g} within {:.3g} (margin {:.3g}; {}; because {})", row.case_name,
                     check.quantity, computed, check.unit, sign, check.expected, width(check.expected, check.tolerance),
                     margin(row.computed, check), check.source, check.because);
}

}  // namespace

fs::path case_output(const std::string& case_name) {
  const fs::path path = folder("VOUSSOIR_CASE_OUTPUT", "cases") / case_name;
  fs::create_directories(path);
  return path;
}

CaseReport::CaseReport(std::string case_name, std::vector<std::string> promised)
    : case_name_(std::move(case_name)),
      promised_(std::move(promised)),
      test_(current_test()),
      exceptions_at_start_(std::uncaught_exceptions()) {
  // after a later crash the case must count as not run, not have the rows of an earlier run
  if (first_of_a_fresh_run(case_name_)) {
    fs::remove(verdict_path(case_name_));
    fs::remove(case_output(case_name_) / "reference.json");
  }
  write();
}

CaseReport::~CaseReport() {
  try {
    if (std::uncaught_exceptions() == exceptions_at_start_ && !missing_promise().empty())
      ADD_FAILURE() << case_name_ << ": " << missing_promise();
    merge_into_case_file(verdict_path(case_name_), case_name_, rows_, test_, failure_outside_checks());
  } catch (const std::exception& problem) {
    ADD_FAILURE() << "the verdict rows of " << case_name_ << " could not be written: " << problem.what();
  }
}

bool CaseReport::record(const Check& check, double computed, Cost cost, const char* file, int line) {
  require_complete(check);
  Row row{case_name_, check, computed, cost, current_commit()};
  const bool good = passed(row);
  if (!good) ADD_FAILURE_AT(file, line) << describe(row);
  add(std::move(row));
  return good;
}

void CaseReport::report(const std::string& quantity, const std::string& unit, double value, const std::string& note,
                        Cost cost) {
  if (quantity.empty() || unit.empty() || note.empty())
    throw std::invalid_argument("a reported number needs quantity, unit and a note on why it is shown");
  const Check shown{quantity, unit, Kind::reported, "this run", 0.0, {}, note};
  add({case_name_, shown, value, cost, current_commit()});
}

void CaseReport::report_time(const std::string& quantity, const std::string& unit, double value,
                             const std::string& note) {
  report(quantity, unit, value, note);
  rows_.back().check.by_the_clock = true;
}

void CaseReport::reference(const std::string& quantity, double value, const std::string& unit) {
  if (quantity.empty() || unit.empty() || !std::isfinite(value))
    throw std::invalid_argument("a reference number needs a quantity, a unit and a finite value");
  update_json(case_output(case_name_) / "reference.json", [&](nlohmann::json& file) {
    file[quantity] = {{"value", value}, {"unit", unit}};
  });
}

void CaseReport::write() {
  merge_into_case_file(verdict_path(case_name_), case_name_, rows_, test_, unfinished);
}

void CaseReport::add(Row row) {
  const std::string& quantity = row.check.quantity;
  std::string& recorder = recorder_of()[{case_name_, quantity}];
  if (recorded_.contains(quantity) || (!recorder.empty() && recorder != test_))
    throw std::invalid_argument(
        fmt::format("case {}: '{}' is recorded twice; the second row would hide the first: give each its own quantity",
                    case_name_, quantity));
  recorder = test_;
  recorded_.insert(quantity);
  rows_.push_back(std::move(row));
}

std::string CaseReport::missing_promise() const {
  for (const std::string& quantity : promised_)
    if (!recorded_.contains(quantity)) return fmt::format("the promised check '{}' was not recorded", quantity);
  return {};
}

// failures in this test that no failed row reports: the summary must not be greener than CTest
std::string CaseReport::failure_outside_checks() const {
  if (std::uncaught_exceptions() > exceptions_at_start_) return "stopped by an exception";
  if (const std::string missing = missing_promise(); !missing.empty()) return missing;
  bool all_passed = true;
  for (const Row& row : rows_)
    all_passed = all_passed && passed(row);
  if (all_passed && testing::UnitTest::GetInstance()->current_test_info() && testing::Test::HasFailure())
    return "an assertion failed that is not a recorded check";
  return {};
}

}  // namespace voussoir::verification
