#include "app/study/sample_findings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace voussoir {
namespace {

double share_of(int count, std::size_t of) {
  return static_cast<double>(count) / static_cast<double>(of);
}

const char* interval_of(const Sweep& sample) {
  return sample.drawn && sample.drawn->latin
             ? "Clopper-Pearson of independent rows; those of a Latin hypercube are at least as good"
             : "Clopper-Pearson";
}

// Rows without a factor are not safe: what they are is said, and the share of all rows that fail beside that of the
// rows that have one.
std::string without_line(const SampleFound& found) {
  const WithoutResult& without = *found.without;
  std::vector<std::string> parts;
  const auto tell = [&](std::size_t count, const char* what) {
    if (count > 0) parts.push_back(fmt::format("in {} {}", count, what));
  };
  tell(without.no_block, "no block forms");
  tell(without.nothing_moves, "no block can move");
  tell(without.undecided, "a projection found no end");
  tell(without.refused, "the scene is refused");
  std::string line = fmt::format("rows without a result: {}: {}", without.count(), fmt::join(parts, ", "));
  if (!found.failed) return line;
  const Share& failed = *found.failed;
  const Share all = share_with_undecided(failed.count, found.verdicts.undecided, static_cast<int>(found.rows));
  return line + fmt::format("; of all rows {:.4g} % fail (95 %: {:.4g} to {:.4g} %), of those with a result {:.4g} %",
                            100 * share_of(failed.count, found.rows), 100 * all.low, 100 * all.high,
                            100 * share_of(failed.count, found.results.size()));
}

}  // namespace

void RowVerdicts::add(const Fails& fails, double result, std::optional<double> error_bar) {
  const RowVerdict verdict = fails.verdict(result, error_bar);
  failed += verdict == RowVerdict::fails;
  standing += verdict == RowVerdict::stands;
  undecided += verdict == RowVerdict::undecided;
  at_limit = at_limit || (verdict == RowVerdict::stands && result == fails.limit);
}

std::string verdicts_text(const Fails& fails, const RowVerdicts& verdicts) {
  std::string text =
      fmt::format("{} of them {} {:g}, {} {}{}", verdicts.failed, fails.below ? "below" : "above", fails.limit,
                  verdicts.standing, verdicts.at_limit ? "at or " : "", fails.below ? "above" : "below");
  if (verdicts.undecided > 0)
    text += fmt::format(", {} within {} of {:g}", verdicts.undecided,
                        verdicts.undecided == 1 ? "its error bar" : "their error bars", fails.limit);
  return text;
}

void SampleFound::add(const Sweep& sample, double result, std::optional<double> error_bar) {
  results.push_back(result);
  if (sample.fails) verdicts.add(*sample.fails, result, error_bar);
}

void SampleFound::conclude(const Sweep& sample) {
  if (results.empty()) return;
  moments = moments_of(results);
  if (sample.fails)
    failed = share_with_undecided(verdicts.failed, verdicts.undecided, static_cast<int>(results.size()));
}

std::string sample_json(const StudyPlan& plan, const Sweep& sample, const SampleFound& found) {
  nlohmann::ordered_json json = {{"schema", "voussoir.sample"},
                                 {"schema_version", 1},
                                 {"name", sample.name},
                                 {"quantity", plan.quantity},
                                 {"unit", found.unit},
                                 {"rows", found.rows},
                                 {"without_result", found.rows - found.results.size()}};
  if (found.without)
    json["without_result_by_reason"] = {{"no_block", found.without->no_block},
                                        {"nothing_moves", found.without->nothing_moves},
                                        {"undecided", found.without->undecided},
                                        {"refused", found.without->refused}};
  if (sample.drawn) {
    json["method"] = sample.drawn->latin ? "latin" : "random";
    for (const DrawnKey& key : sample.drawn->keys)
      json["keys"].push_back({{"key", key.key}, {"law", law_text(key)}, {"unit", key.unit}});
    json["shared_draws"] = sharing_text(*sample.drawn);
  }
  if (!found.results.empty()) {
    json["mean"] = found.moments.mean.value;
    json["mean_error"] = found.moments.mean.error;
    json["deviation"] = found.moments.deviation;
    json["smallest"] = *std::min_element(found.results.begin(), found.results.end());
    json["largest"] = *std::max_element(found.results.begin(), found.results.end());
  }
  if (found.failed)
    json["failed"] = {
        {sample.fails->below ? "below" : "above", sample.fails->limit},
        {"count", found.failed->count},
        {"standing", found.verdicts.standing},
        {"undecided", found.verdicts.undecided},
        {"share", share_of(found.failed->count, found.results.size())},
        {"share_with_undecided", share_of(found.failed->count + found.verdicts.undecided, found.results.size())},
        {"share_of_all_rows", share_of(found.failed->count, found.rows)},
        {"low", found.failed->low},
        {"high", found.failed->high},
        {"confidence", sample_confidence},
        {"interval", interval_of(sample)}};
  for (const Bin& bin : histogram_of(found.results))
    json["histogram"].push_back({{"from", bin.from}, {"to", bin.to}, {"count", bin.count}});
  return json.dump(2) + "\n";
}

std::vector<std::string> sample_lines(const Sweep& sample, const SampleFound& found) {
  std::string line =
      fmt::format("sample '{}': {} of {} rows have a result", sample.name, found.results.size(), found.rows);
  if (!found.results.empty())
    line += fmt::format(", mean {:.6g}, deviation {:.4g}{}", found.moments.mean.value, found.moments.deviation,
                        found.unit.empty() || found.unit == "1" ? "" : " " + found.unit);
  if (found.failed) {
    const Share& failed = *found.failed;
    const std::size_t of = found.results.size();
    line += fmt::format("; {}: {:.4g}", verdicts_text(*sample.fails, found.verdicts), 100 * share_of(failed.count, of));
    if (found.verdicts.undecided > 0)
      line += fmt::format(" to {:.4g}", 100 * share_of(failed.count + found.verdicts.undecided, of));
    line += fmt::format(" %, with 95 % confidence {:.4g} to {:.4g} %", 100 * failed.low, 100 * failed.high);
    if (sample.drawn && sample.drawn->latin)
      line += " (of independent rows; those of a Latin hypercube are at least as good)";
  }
  std::vector<std::string> lines{line};
  if (found.without && found.without->count() > 0) lines.push_back(without_line(found));
  if (const std::string shared = sample.drawn ? sharing_text(*sample.drawn) : ""; found.failed && !shared.empty())
    lines.push_back("  " + shared);
  return lines;
}

}  // namespace voussoir
