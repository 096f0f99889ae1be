#include "app/study/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "text/csv_table.hpp"

namespace voussoir {
namespace {

StudyRow row_of(int number, const Sweep& sweep, const std::string& value, const RunFound& found) {
  StudyRow row;
  row.row = number;
  row.curve = sweep.name;
  row.key = sweep.key;
  row.value = shown_value(value);
  row.unit = sweep.unit;
  row.status = found.status;
  row.contact_evaluations = found.contact_evaluations;
  row.steps = found.steps;
  row.seconds = found.seconds;
  if (found.result) {
    row.result = found.result->value;
    row.error_bar = found.result->error_bar;
    row.result_unit = found.result->unit;
    row.divides = found.result->divides;
  }
  return row;
}

// Two results and result = limit + constant · value^power give the limit at value 0. Its error bar is its distance
// from the nearer of the two; once there is an extrapolation from coarser runs, its distance from that. Its cost is
// that of both runs.
StudyRow extrapolate(const Sweep& sweep, const StudyRow& first, double a, const StudyRow& second, double b) {
  StudyRow row;
  row.curve = sweep.name + " (extrapolated)";
  row.key = sweep.key;
  row.unit = sweep.unit;
  row.value = fmt::format("extrapolated {}->{}", first.value, second.value);
  row.contact_evaluations = first.contact_evaluations + second.contact_evaluations;
  row.steps = first.steps + second.steps;
  row.seconds = first.seconds + second.seconds;
  if (!first.result || !second.result) {
    row.status = "a run to extrapolate from has no result";
    return row;
  }
  const double pa = std::pow(a, *sweep.power), pb = std::pow(b, *sweep.power);
  row.result = (*second.result * pa - *first.result * pb) / (pa - pb);
  row.error_bar = std::min(std::abs(*row.result - *first.result), std::abs(*row.result - *second.result));
  row.result_unit = second.result_unit;
  return row;
}

void add_extrapolations(const Sweep& sweep, std::vector<StudyRow>& rows) {
  const std::size_t first = rows.size() - sweep.values.size();
  std::optional<double> coarser;
  for (std::size_t k = 0; k + 1 < sweep.values.size(); ++k) {
    StudyRow row = extrapolate(sweep, rows[first + k], *sweep.numbers[k], rows[first + k + 1], *sweep.numbers[k + 1]);
    if (row.result && coarser) row.error_bar = std::abs(*row.result - *coarser);
    coarser = row.result;
    rows.push_back(row);
  }
}

}  // namespace

std::vector<StudyRow> table_of(const StudyPlan& plan, const std::function<RunFound(int row)>& found) {
  std::vector<StudyRow> rows;
  int row = 0;
  for (const Sweep& sweep : plan.sweeps) {
    for (const std::string& value : sweep.values) {
      ++row;
      rows.push_back(row_of(row, sweep, value, found(row)));
    }
    if (sweep.power) add_extrapolations(sweep, rows);
  }
  return rows;
}

std::string study_csv(const StudyPlan& plan, const std::vector<StudyRow>& rows) {
  std::string text =
      "sweep,key,value,unit,quantity,result,error_bar,result_unit,status,contact_evaluations,steps,seconds\n";
  for (const StudyRow& row : rows)
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{:.3f}\n", csv_cell(row.curve), csv_cell(row.key),
                        csv_cell(row.value), csv_cell(row.unit), csv_cell(plan.quantity), csv_cell(row.result),
                        csv_cell(row.error_bar), csv_cell(row.result_unit), csv_cell(row.status),
                        row.contact_evaluations, row.steps, row.seconds);
  return text;
}

}  // namespace voussoir
