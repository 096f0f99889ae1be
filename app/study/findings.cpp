#include "app/study/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/study/drawn_sample.hpp"
#include "app/study/finding_names.hpp"
#include "app/study/reliability.hpp"
#include "app/study/sample_findings.hpp"
#include "text/csv_table.hpp"

namespace voussoir {
namespace {

std::string unit_of(const std::vector<StudyRow>& rows) {
  for (const StudyRow& row : rows)
    if (row.result) return row.result_unit;
  return "";
}

std::optional<RowVerdict> verdict_on(const Sweep& sweep, const StudyRow& row) {
  if (!sweep.fails || !row.result) return std::nullopt;
  return sweep.fails->verdict(*row.result, row.error_bar);
}

const char* fails_cell(const std::optional<RowVerdict>& verdict) {
  if (!verdict) return "";
  return *verdict == RowVerdict::undecided ? "undecided" : *verdict == RowVerdict::fails ? "yes" : "no";
}

// a column for every key, then the result
std::string table(const StudyPlan& plan, const Sweep& sweep, const std::vector<StudyRow>& rows) {
  std::vector<std::string> header;
  if (sweep.varied == Varied::sample) header.emplace_back("row");
  for (const TiedKey& key : sweep.with)
    header.push_back(with_unit(key.key, key.unit));
  header.insert(header.end(), {plan.quantity, "error_bar", "result_unit", "status"});
  if (sweep.fails) header.emplace_back("fails");
  std::string text = csv_line(header) + "\n";
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (sweep.varied == Varied::sample) text += sweep.values[k] + ",";
    for (const TiedKey& key : sweep.with)
      text += csv_cell(shown_value(key.values[k])) + ",";
    text += fmt::format("{},{},{},{}", csv_cell(rows[k].result), csv_cell(rows[k].error_bar),
                        csv_cell(rows[k].result_unit), csv_cell(rows[k].status));
    if (sweep.fails) text += fmt::format(",{}", fails_cell(verdict_on(sweep, rows[k])));
    text += "\n";
  }
  return text;
}

// ---- grids

// the axes of grid_N.csv, whose rows are every combination with the last key changing fastest
std::string grid_json(const StudyPlan& plan, const Sweep& grid, const std::vector<StudyRow>& rows) {
  nlohmann::ordered_json json = {{"schema", "voussoir.grid"},
                                 {"schema_version", 1},
                                 {"name", grid.name},
                                 {"quantity", plan.quantity},
                                 {"unit", unit_of(rows)}};
  if (grid.fails) json[grid.fails->below ? "fails_below" : "fails_above"] = grid.fails->limit;
  std::size_t repeated = rows.size();
  for (std::size_t k = 0; k < grid.with.size(); ++k) {
    repeated /= grid.counts[k];
    auto values = nlohmann::ordered_json::array();
    for (std::size_t place = 0; place < grid.counts[k]; ++place)
      values.push_back(shown_value(grid.with[k].values[place * repeated]));
    json["keys"].push_back({{"key", grid.with[k].key}, {"unit", grid.with[k].unit}, {"values", values}});
  }
  return json.dump(2) + "\n";
}

std::string grid_line(const Sweep& grid, const std::vector<StudyRow>& rows) {
  const auto results =
      std::count_if(rows.begin(), rows.end(), [](const StudyRow& row) { return row.result.has_value(); });
  std::string line = fmt::format("grid '{}': {} of {} combinations have a result", grid.name, results, rows.size());
  if (!grid.fails) return line;
  RowVerdicts verdicts;
  for (const StudyRow& row : rows)
    if (row.result) verdicts.add(*grid.fails, *row.result, row.error_bar);
  return line + ", " + verdicts_text(*grid.fails, verdicts);
}

SampleFound found_by(const Sweep& sample, const std::vector<StudyRow>& rows) {
  SampleFound found{.rows = rows.size(), .unit = unit_of(rows)};
  for (const StudyRow& row : rows)
    if (row.result) found.add(sample, *row.result, row.error_bar);
  found.conclude(sample);
  return found;
}

}  // namespace

Findings findings_of(const StudyPlan& plan, const std::vector<StudyRow>& all, const EvaluationsOf& evaluations,
                     bool quiet) {
  Findings findings;
  std::vector<std::string> contents;
  std::size_t first = 0;
  for (const Sweep& sweep : plan.sweeps) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
    const std::vector<StudyRow> rows(begin, begin + static_cast<std::ptrdiff_t>(sweep.values.size()));
    first += sweep.values.size() + (sweep.power ? sweep.values.size() - 1 : 0);
    if (sweep.varied == Varied::one_key) continue;
    if (sweep.varied == Varied::grid) {
      contents.push_back(table(plan, sweep, rows));
      contents.push_back(grid_json(plan, sweep, rows));
      findings.lines.push_back(grid_line(sweep, rows));
      continue;
    }
    if (sweep.varied == Varied::reliability) {
      try {
        const ReliabilityFound found = analyse_reliability(sweep, evaluations(sweep));
        contents.push_back(reliability_csv(plan, sweep, found));
        contents.push_back(reliability_json(plan, sweep, found));
        for (std::string& line : reliability_lines(sweep, found))
          findings.lines.push_back(std::move(line));
        findings.divides.push_back(found.rows.front().answer.divides);
        findings.failed |= !found.failure.empty();
      } catch (const EvaluationsInterrupted&) {
        findings.interrupted = true;
        return findings;
      }
      continue;
    }
    SampleFound found;
    if (sweep.is_drawn_in_process()) {
      std::optional<DrawnSample> drawn = draw_sample(plan, sweep, quiet);
      if (!drawn) {
        findings.interrupted = true;
        return findings;
      }
      contents.push_back(std::move(drawn->csv));
      found = std::move(drawn->found);
      findings.divides.push_back(drawn->divides);
    } else {
      contents.push_back(table(plan, sweep, rows));
      found = found_by(sweep, rows);
    }
    contents.push_back(sample_json(plan, sweep, found));
    for (std::string& line : sample_lines(sweep, found))
      findings.lines.push_back(std::move(line));
  }
  const std::vector<std::string> names = finding_names(plan);
  for (std::size_t k = 0; k < names.size(); ++k)
    findings.files.emplace_back(names[k], contents[k]);
  return findings;
}

}  // namespace voussoir
