#include "app/study/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/study/statistics.hpp"
#include "core/joint_sets/statistics.hpp"
#include "text/csv_table.hpp"

namespace voussoir {
namespace {

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() || unit == "1" ? name : fmt::format("{} ({})", name, unit);
}

std::string unit_of(const std::vector<StudyRow>& rows) {
  for (const StudyRow& row : rows)
    if (row.result) return row.result_unit;
  return "";
}

std::string fails_text(const Fails& fails) {
  return fmt::format("{} {:g}", fails.below ? "below" : "above", fails.limit);
}

std::optional<RowVerdict> verdict_on(const Sweep& sweep, const StudyRow& row) {
  if (!sweep.fails || !row.result) return std::nullopt;
  return sweep.fails->verdict(*row.result, row.error_bar);
}

struct Verdicts {
  int failed = 0, standing = 0, undecided = 0;
  bool at_limit = false;  // some stable results are equal to the limit
};

Verdicts verdicts_on(const Sweep& sweep, const std::vector<StudyRow>& rows) {
  Verdicts verdicts;
  for (const StudyRow& row : rows)
    if (const std::optional<RowVerdict> verdict = verdict_on(sweep, row)) {
      verdicts.failed += *verdict == RowVerdict::fails;
      verdicts.standing += *verdict == RowVerdict::stands;
      verdicts.undecided += *verdict == RowVerdict::undecided;
      verdicts.at_limit = verdicts.at_limit || (*verdict == RowVerdict::stands && *row.result == sweep.fails->limit);
    }
  return verdicts;
}

// "5 of them below 1, 24 above, 1 within its error bar of 1"
std::string verdicts_text(const Fails& fails, const Verdicts& verdicts) {
  std::string text = fmt::format("{} of them {}, {} {}{}", verdicts.failed, fails_text(fails), verdicts.standing,
                                 verdicts.at_limit ? "at or " : "", fails.below ? "above" : "below");
  if (verdicts.undecided > 0)
    text += fmt::format(", {} within {} of {:g}", verdicts.undecided,
                        verdicts.undecided == 1 ? "its error bar" : "their error bars", fails.limit);
  return text;
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
  return grid.fails ? line + ", " + verdicts_text(*grid.fails, verdicts_on(grid, rows)) : line;
}

// ---- samples

struct SampleFound {
  std::vector<double> results;
  Moments moments;
  Verdicts verdicts;
  std::optional<Share> failed;
};

SampleFound found_by(const Sweep& sample, const std::vector<StudyRow>& rows) {
  SampleFound found;
  for (const StudyRow& row : rows)
    if (row.result) found.results.push_back(*row.result);
  if (found.results.empty()) return found;
  found.moments = moments_of(found.results);
  found.verdicts = verdicts_on(sample, rows);
  if (sample.fails)
    found.failed =
        share_with_undecided(found.verdicts.failed, found.verdicts.undecided, static_cast<int>(found.results.size()));
  return found;
}

double share_of(int count, const Share& all) {
  return static_cast<double>(count) / all.of;
}

std::string sample_json(const StudyPlan& plan, const Sweep& sample, const SampleFound& found,
                        const std::vector<StudyRow>& rows) {
  nlohmann::ordered_json json = {{"schema", "voussoir.sample"},
                                 {"schema_version", 1},
                                 {"name", sample.name},
                                 {"quantity", plan.quantity},
                                 {"unit", unit_of(rows)},
                                 {"rows", rows.size()},
                                 {"without_result", rows.size() - found.results.size()}};
  if (!found.results.empty()) {
    json["mean"] = found.moments.mean.value;
    json["mean_error"] = found.moments.mean.error;
    json["deviation"] = found.moments.deviation;
    json["smallest"] = *std::min_element(found.results.begin(), found.results.end());
    json["largest"] = *std::max_element(found.results.begin(), found.results.end());
  }
  if (found.failed)
    json["failed"] = {{sample.fails->below ? "below" : "above", sample.fails->limit},
                      {"count", found.failed->count},
                      {"standing", found.verdicts.standing},
                      {"undecided", found.verdicts.undecided},
                      {"share", share_of(found.failed->count, *found.failed)},
                      {"share_with_undecided", share_of(found.failed->count + found.verdicts.undecided, *found.failed)},
                      {"low", found.failed->low},
                      {"high", found.failed->high},
                      {"confidence", sample_confidence},
                      {"interval", "Clopper-Pearson"}};
  for (const Bin& bin : histogram_of(found.results))
    json["histogram"].push_back({{"from", bin.from}, {"to", bin.to}, {"count", bin.count}});
  return json.dump(2) + "\n";
}

std::string sample_line(const Sweep& sample, const SampleFound& found, const std::vector<StudyRow>& rows) {
  std::string line =
      fmt::format("sample '{}': {} of {} rows have a result", sample.name, found.results.size(), rows.size());
  if (found.results.empty()) return line;
  const std::string unit = unit_of(rows);
  line += fmt::format(", mean {:.6g}, deviation {:.4g}{}", found.moments.mean.value, found.moments.deviation,
                      unit.empty() || unit == "1" ? "" : " " + unit);
  if (!found.failed) return line;
  const Share& failed = *found.failed;
  line +=
      fmt::format("; {}: {:.4g}", verdicts_text(*sample.fails, found.verdicts), 100 * share_of(failed.count, failed));
  if (found.verdicts.undecided > 0)
    line += fmt::format(" to {:.4g}", 100 * share_of(failed.count + found.verdicts.undecided, failed));
  return line + fmt::format(" %, with 95 % confidence {:.4g} to {:.4g} %", 100 * failed.low, 100 * failed.high);
}

}  // namespace

std::vector<std::string> finding_names(const StudyPlan& plan) {
  std::vector<std::string> names;
  int grids = 0, samples = 0;
  for (const Sweep& sweep : plan.sweeps) {
    if (sweep.varied == Varied::grid) {
      ++grids;
      for (const char* kind : {"csv", "json"})
        names.push_back(fmt::format("grid_{}.{}", grids, kind));
    }
    if (sweep.varied == Varied::sample) {
      ++samples;
      for (const char* kind : {"csv", "json"})
        names.push_back(fmt::format("sample_{}.{}", samples, kind));
    }
  }
  return names;
}

Findings findings_of(const StudyPlan& plan, const std::vector<StudyRow>& all) {
  Findings findings;
  std::vector<std::string> contents;
  std::size_t first = 0;
  for (const Sweep& sweep : plan.sweeps) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
    const std::vector<StudyRow> rows(begin, begin + static_cast<std::ptrdiff_t>(sweep.values.size()));
    first += sweep.values.size() + (sweep.power ? sweep.values.size() - 1 : 0);
    if (sweep.varied == Varied::one_key) continue;
    contents.push_back(table(plan, sweep, rows));
    if (sweep.varied == Varied::grid) {
      contents.push_back(grid_json(plan, sweep, rows));
      findings.lines.push_back(grid_line(sweep, rows));
      continue;
    }
    const SampleFound found = found_by(sweep, rows);
    contents.push_back(sample_json(plan, sweep, found, rows));
    findings.lines.push_back(sample_line(sweep, found, rows));
  }
  const std::vector<std::string> names = finding_names(plan);
  for (std::size_t k = 0; k < names.size(); ++k)
    findings.files.emplace_back(names[k], contents[k]);
  return findings;
}

}  // namespace voussoir
