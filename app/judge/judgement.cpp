#include "app/judge/judgement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace voussoir {
namespace {

// the fault of a row that has an answer, or nothing
std::string fault_of(const AnswerRow& row, const ReferenceRow* asked, bool again) {
  if (!asked)
    return fmt::format("quantity = '{}': this problem does not ask it; copy the names of its answer.csv", row.quantity);
  if (again) return fmt::format("quantity = '{}': a second row; keep one", row.quantity);
  if (row.kind == AnswerKind::faulty) return row.fault;
  if (row.unit != asked->unit)
    return fmt::format("unit = '{}': '{}' is asked in {}; convert the value", row.unit, row.quantity, asked->unit);
  return {};
}

void compare(const AnswerRow& answer, const ProblemReference& reference, JudgedRow& row) {
  const double nearest = std::clamp(answer.value, reference.lower, reference.upper);
  row.value = answer.value;
  row.error = answer.value - nearest;
  row.tolerance = verification::width(nearest, reference.tolerance);
  row.verdict = verification::within(answer.value, nearest, reference.tolerance) ? JudgedAs::passed : JudgedAs::failed;
}

}  // namespace

std::string_view name_of(JudgedAs verdict) {
  switch (verdict) {
    case JudgedAs::passed:
      return "passed";
    case JudgedAs::failed:
      return "FAILED";
    case JudgedAs::not_run:
      return "not run";
    case JudgedAs::cannot_state:
      return "cannot state";
    case JudgedAs::not_asked:
      return "not asked";
    case JudgedAs::faulty:
      break;
  }
  return "faulty";
}

void judge_answer(const AnswerFile& answer, const ReferenceFile& reference, Judgement& judgement) {
  if (std::ranges::find(judgement.codes, answer.code) == judgement.codes.end()) judgement.codes.push_back(answer.code);
  std::map<std::string, const AnswerRow*> given;
  std::set<std::string> faulty;
  for (const AnswerRow& row : answer.rows) {
    const auto asked = std::ranges::find(reference.rows, row.quantity, &ReferenceRow::quantity);
    const std::string fault =
        fault_of(row, asked == reference.rows.end() ? nullptr : &*asked, given.contains(row.quantity));
    if (!fault.empty()) {
      judgement.faults.push_back(fmt::format("{}:{}: {}", answer.file.string(), row.line, fault));
      faulty.insert(row.quantity);
    }
    given.emplace(row.quantity, &row);
  }
  for (const ReferenceRow& asked : reference.rows) {
    JudgedRow row;
    row.problem = reference.problem;
    row.quantity = asked.quantity;
    row.unit = asked.unit;
    row.code = answer.code;
    const auto& right = answer.model == AnswerModel::rigid ? asked.rigid : asked.joints;
    if (right) {
      row.lower = right->lower;
      row.upper = right->upper;
      row.because = right->because;
    }
    if (const auto found = given.find(asked.quantity); faulty.contains(asked.quantity)) {
      row.verdict = JudgedAs::faulty;
    } else if (found != given.end()) {
      row.note = found->second->note;
      row.seconds = found->second->seconds;
      if (found->second->kind == AnswerKind::cannot_state)
        row.verdict = JudgedAs::cannot_state;
      else if (found->second->kind == AnswerKind::number && right)
        compare(*found->second, *right, row);
      else if (found->second->kind == AnswerKind::number)
        row.value = found->second->value;
    }
    // a model of which the question is not asked need not answer it
    if (!right && row.verdict == JudgedAs::not_run) row.verdict = JudgedAs::not_asked;
    judgement.rows.push_back(row);
  }
}

void complete(Judgement& judgement) {
  std::vector<std::pair<std::string, std::string>> questions;  // in order of appearance
  std::map<std::tuple<std::string, std::string, std::string>, JudgedRow> known;
  for (const JudgedRow& row : judgement.rows) {
    if (std::ranges::find(questions, std::pair(row.problem, row.quantity)) == questions.end())
      questions.emplace_back(row.problem, row.quantity);
    const auto [place, fresh] = known.emplace(std::tuple(row.problem, row.quantity, row.code), row);
    if (!fresh)
      judgement.faults.push_back(
          fmt::format("{}: two answers of '{}' to problem {}: judge one of them, or give the "
                      "codes different names",
                      row.quantity, row.code, row.problem));
  }
  std::ranges::stable_sort(questions, {}, &std::pair<std::string, std::string>::first);
  std::vector<JudgedRow> all;
  for (const auto& [problem, quantity] : questions)
    for (const std::string& code : judgement.codes) {
      const auto found = known.find(std::tuple(problem, quantity, code));
      if (found != known.end()) {
        all.push_back(found->second);
        continue;
      }
      JudgedRow missing;
      missing.problem = problem;
      missing.quantity = quantity;
      missing.code = code;
      all.push_back(missing);
    }
  // the unit of a question is that of any row of it
  std::map<std::pair<std::string, std::string>, std::string> units;
  for (const JudgedRow& row : all)
    if (!row.unit.empty()) units[{row.problem, row.quantity}] = row.unit;
  for (JudgedRow& row : all)
    row.unit = units[{row.problem, row.quantity}];
  std::set<std::string> once(judgement.faults.begin(), judgement.faults.end());
  judgement.faults.assign(once.begin(), once.end());
  judgement.rows = std::move(all);
}

}  // namespace voussoir
