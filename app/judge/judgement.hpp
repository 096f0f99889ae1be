// Answers of codes against references: one rule for all, verification/comparison.
#pragma once

#include <string>
#include <vector>

#include "app/judge/answer_file.hpp"

namespace voussoir {

enum class JudgedAs { passed, failed, not_run, cannot_state, not_asked, faulty };

std::string_view name_of(JudgedAs verdict);  // "passed", "FAILED", "not run", "cannot state", "not asked", "faulty"

// One question, judged for one code.
struct JudgedRow {
  std::string problem, quantity, unit, code, note;
  JudgedAs verdict = JudgedAs::not_run;
  std::optional<double> value, seconds;
  std::optional<double> lower, upper, tolerance;  // tolerance: at the end that is nearer
  std::optional<double> error;                    // from the nearer end of the interval; 0 within it
  std::string because;
};

struct Judgement {
  std::vector<JudgedRow> rows;      // by problem, question, code
  std::vector<std::string> codes;   // in order of appearance
  std::vector<std::string> faults;  // file:line: reason, a line each
  std::vector<std::string> notes;   // files that were handed in unfilled
};

// The rows of one answer, in the order of the references. Every question of the references has a row: "not run" if the
// answer has none or an empty value. Questions that the references do not have, other units, and questions answered
// twice are faults.
void judge_answer(const AnswerFile& answer, const ReferenceFile& reference, Judgement& judgement);

// every question has a row for every code, "not run" where a code handed in no file; sorted
void complete(Judgement& judgement);

}  // namespace voussoir
