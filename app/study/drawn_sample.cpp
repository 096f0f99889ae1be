#include "app/study/drawn_sample.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "app/base/interruption.hpp"
#include "app/base/progress_line.hpp"
#include "app/study/blocks_answers.hpp"
#include "app/study/parallel_rows.hpp"
#include "text/csv_table.hpp"

namespace voussoir {
namespace {

constexpr int rows_at_once = 256;  // that a thread takes
constexpr int rows_between_looks = 20'000;
constexpr std::size_t most_written = 100'000;

struct DrawnRow {
  std::vector<double> values;
  BlocksAnswer answer;
};

// rows first..first + count, from 1
std::vector<DrawnRow> rows_from(const BlocksAnswers& answers, const DrawnKeys& drawn, int first, int count) {
  std::vector<DrawnRow> rows(static_cast<std::size_t>(count));
  each_row_in_parallel(
      count,
      [&](int k) {
        rows[k].values = drawn.row(first + k);
        rows[k].answer = answers.answer(rows[k].values, first + k);
      },
      rows_at_once);
  return rows;
}

std::string header_of(const StudyPlan& plan, const Sweep& sample) {
  std::vector<std::string> header{"row"};
  for (const TiedKey& key : sample.with)
    header.push_back(with_unit(key.key, key.unit));
  header.insert(header.end(), {plan.quantity, "error_bar", "result_unit", "status"});
  if (sample.fails) header.emplace_back("fails");
  header.emplace_back("mode");
  return csv_line(header) + "\n";
}

// which columns are drawn for each joint or set, so that a row has no one value
std::vector<bool> shared_columns(const DrawnKeys& drawn) {
  std::vector<bool> shared;
  for (const DrawnKey& key : drawn.keys)
    shared.insert(shared.end(), key.components(), key.per == DrawnPer::property);
  return shared;
}

std::string line_of(const Sweep& sample, const std::vector<bool>& shared, const std::string& unit, int number,
                    const DrawnRow& row) {
  std::string line = std::to_string(number);
  for (std::size_t k = 0; k < row.values.size(); ++k)
    line += shared[k] ? fmt::format(",{}", row.values[k]) : ",";
  line += fmt::format(",{},,{},{}", csv_cell(row.answer.value), csv_cell(unit),
                      csv_cell(row.answer.value ? "ok" : status_text(row.answer)));
  if (sample.fails)
    line += !row.answer.value                                                             ? ","
            : sample.fails->verdict(*row.answer.value, std::nullopt) == RowVerdict::fails ? ",yes"
                                                                                          : ",no";
  return line + "," + csv_cell(row.answer.mode) + "\n";
}

}  // namespace

std::optional<DrawnSample> draw_sample(const StudyPlan& plan, const Sweep& sample, bool quiet) {
  const DrawnKeys& keys = *sample.drawn;
  BlocksAnswers answers(sample.scene, sample.overrides, sample.other->options, plan.quantity);
  answers.vary(keys);
  DrawnSample drawn{.csv = header_of(plan, sample)};
  drawn.divides = answers.divides();
  SampleFound& found = drawn.found;
  found.rows = static_cast<std::size_t>(keys.rows);
  found.unit = answers.unit();
  found.without = WithoutResult{};
  const std::vector<bool> shared = shared_columns(keys);
  note_interruptions();
  StatusLine progress(!quiet);
  const auto began = std::chrono::steady_clock::now();
  for (int first = 1; first <= keys.rows; first += rows_between_looks) {
    const std::vector<DrawnRow> rows =
        rows_from(answers, keys, first, std::min(rows_between_looks, keys.rows - first + 1));
    if (interruption()) return std::nullopt;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const int number = first + static_cast<int>(k);
      const BlocksAnswer& answer = rows[k].answer;
      if (static_cast<std::size_t>(number) <= most_written)
        drawn.csv += line_of(sample, shared, found.unit, number, rows[k]);
      if (answer.value) {
        found.add(sample, *answer.value, std::nullopt);
        continue;
      }
      found.without->no_block += answer.end == RowEnd::no_block;
      found.without->nothing_moves += answer.end == RowEnd::nothing_moves;
      found.without->undecided += answer.end == RowEnd::undecided;
      found.without->refused += answer.end == RowEnd::refused;
    }
    const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    const double done = static_cast<double>(std::min(keys.rows, first + rows_between_looks - 1));
    if (progress.is_due())
      progress.show(fmt::format("sample '{}': {:.0f} of {} rows, about {} left", sample.name, done, keys.rows,
                                duration_text(took / done * (keys.rows - done))));
  }
  progress.clear();
  found.conclude(sample);
  return drawn;
}

}  // namespace voussoir
