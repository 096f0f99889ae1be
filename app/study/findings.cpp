#include "app/study/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/base/svg_figure.hpp"
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

// one for two keys, one for each value of the first for three
std::size_t maps_of(const Sweep& grid) {
  return grid.counts.size() == 3 ? grid.counts[0] : 1;
}

std::string map_name(const Sweep& grid, int number, std::size_t map) {
  return maps_of(grid) == 1 && grid.counts.size() == 2 ? fmt::format("grid_{}.svg", number)
                                                       : fmt::format("grid_{}_{}.svg", number, map + 1);
}

std::string map(const StudyPlan& plan, const Sweep& grid, const std::vector<StudyRow>& rows, std::size_t number) {
  const std::size_t last = grid.counts.size() - 1, nx = grid.counts[last], ny = grid.counts[last - 1];
  const std::size_t first = number * nx * ny;
  const auto label = [&](std::size_t key, std::size_t place) { return shown_value(grid.with[key].values[place]); };
  const auto title_of = [&](std::size_t key) { return with_unit(grid.with[key].key, grid.with[key].unit); };
  MapFigure figure;
  figure.title = grid.name;
  if (last == 2) figure.title += fmt::format(", {} = {}", title_of(0), label(0, first));
  figure.x_label = title_of(last);
  figure.y_label = title_of(last - 1);
  figure.value_label = with_unit(plan.quantity, unit_of(rows));
  if (grid.fails) figure.mark_label = "fails: " + fails_text(*grid.fails);
  if (grid.fails && verdicts_on(grid, rows).undecided > 0)
    figure.ring_label = fmt::format("within its error bar of {:g}", grid.fails->limit);
  for (std::size_t x = 0; x < nx; ++x)
    figure.x.push_back(label(last, first + x));
  for (std::size_t y = 0; y < ny; ++y)
    figure.y.push_back(label(last - 1, first + y * nx));
  for (std::size_t place = first; place < first + nx * ny; ++place) {
    figure.values.push_back(rows[place].result);
    const std::optional<RowVerdict> verdict = verdict_on(grid, rows[place]);
    figure.marks.push_back(verdict == RowVerdict::fails       ? MapMark::cross
                           : verdict == RowVerdict::undecided ? MapMark::ring
                                                              : MapMark::none);
  }
  return svg_map(figure);
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

std::string histogram(const StudyPlan& plan, const Sweep& sample, const SampleFound& found,
                      const std::vector<StudyRow>& rows) {
  Diagram diagram{sample.name, with_unit(plan.quantity, unit_of(rows)), "runs", false, {}};
  Curve curve{Curve::Kind::steps, fmt::format("{} runs", found.results.size()), {}};
  int highest = 0;
  for (const Bin& bin : histogram_of(found.results)) {
    curve.points.emplace_back(bin.from, bin.count);
    curve.points.emplace_back(bin.to, bin.count);
    highest = std::max(highest, bin.count);
  }
  diagram.curves.push_back(curve);
  if (sample.fails)
    diagram.curves.push_back({Curve::Kind::line,
                              "fails: " + fails_text(*sample.fails),
                              {{sample.fails->limit, 0}, {sample.fails->limit, highest}}});
  return svg(diagram);
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
      names.push_back(fmt::format("grid_{}.csv", ++grids));
      for (std::size_t map = 0; map < maps_of(sweep); ++map)
        names.push_back(map_name(sweep, grids, map));
    }
    if (sweep.varied == Varied::sample) {
      ++samples;
      for (const char* kind : {"csv", "json", "svg"})
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
      for (std::size_t number = 0; number < maps_of(sweep); ++number)
        contents.push_back(map(plan, sweep, rows, number));
      findings.lines.push_back(grid_line(sweep, rows));
      continue;
    }
    const SampleFound found = found_by(sweep, rows);
    contents.push_back(sample_json(plan, sweep, found, rows));
    contents.push_back(histogram(plan, sweep, found, rows));
    findings.lines.push_back(sample_line(sweep, found, rows));
  }
  const std::vector<std::string> names = finding_names(plan);
  for (std::size_t k = 0; k < names.size(); ++k)
    findings.files.emplace_back(names[k], contents[k]);
  return findings;
}

}  // namespace voussoir
