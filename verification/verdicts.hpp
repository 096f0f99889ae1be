#pragma once
// All verdicts of one build, printed by the summary and shown in the manual.
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "verification/verdict_file.hpp"

namespace voussoir::verification {

enum class CaseState { run, not_run, not_modelled };

struct CaseStatus {
  std::string name;
  CaseState state = CaseState::not_run;
};

// Something that failed without a row of its own: an unreadable file, an exception, rows of a case that is not listed.
struct Failure {
  std::string case_name;
  std::string message;
};

// The difference of a row from the same row of an earlier version (verification/history.hpp).
struct Moved {
  std::string case_name;
  std::string quantity;
  std::string unit;
  double before = 0.0, now = 0.0;
  long long evaluations_before = 0, evaluations_now = 0;
  bool value = false, cost = false;  // whether value or cost has moved
  bool gone = false;                 // the row no longer exists
  bool announced = false;            // announced in the changelog
};

struct Verdicts {
  std::string commit;
  std::vector<CaseStatus> cases;  // in the order of the list
  std::vector<Row> rows;          // by case in the same order
  std::vector<Failure> failures;
  std::string compared_with;  // the version that `moved` is against; empty when there is none
  std::vector<Moved> moved;
};

struct Counts {
  int passed = 0;
  int failed = 0;  // rows and failures without a row
  int reported = 0;
  int not_run = 0;
};

// The lists come from CMake, never from the files that happen to exist; a file outside both lists is a failure.
Verdicts collect(const std::filesystem::path& folder, const std::vector<std::string>& cases,
                 const std::vector<std::string>& not_modelled, const std::string& commit);

Counts count(const Verdicts& verdicts);

// False when anything failed, a case did not run, or nothing was checked.
bool all_good(const Verdicts& verdicts);

// The row's move since that version; null if it did not move.
const Moved* move_of(const Verdicts& verdicts, const Row& row);

// Its text in a table: "", "was 33.4", "42 evaluations more", …
std::string show_moved(const Moved* moved);

// Whether the changelog announces all moves.
bool all_announced(const Verdicts& verdicts);

// "12 checks passed, 0 failed, 1 case not run", and the number of moved rows, if any
std::string one_line(const Verdicts& verdicts);

std::string verdict_markdown(const Verdicts& verdicts);
std::string verdict_csv(const Verdicts& verdicts);
nlohmann::json verdict_json(const Verdicts& verdicts);

// Reads the output of verdict_json; throws std::runtime_error when it is not that.
Verdicts verdicts_from_json(const nlohmann::json& text);

// The tables, in this order: verification is never mixed with validation.
struct VerdictGroup {
  std::string title;
  std::string explanation;
  std::vector<Kind> kinds;
};
const std::vector<VerdictGroup>& verdict_groups();
bool belongs_to(const Row& row, const VerdictGroup& group);

std::string_view name_of(CaseState state);  // "run", "not run", "not yet modelled"

// Six significant digits, "nan" and "inf" as words.
std::string show(double value);

// "33.4", for a one-sided check "≤ 33.4".
std::string show_expected(const Check& check);

}  // namespace voussoir::verification
