#include "benchmarks/judge/judge_tables.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace voussoir::benchmarks {
namespace {

using Line = std::vector<std::string>;

// every column as wide as its widest cell
std::string table(const std::vector<Line>& lines) {
  std::vector<std::size_t> widths(lines[0].size(), 3);
  for (const Line& line : lines)
    for (std::size_t k = 0; k < line.size(); ++k)
      widths[k] = std::max(widths[k], line[k].size());
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t k = 0; k < widths.size(); ++k)
      text +=
          k < 2 ? fmt::format("| {:<{}} ", lines[i][k], widths[k]) : fmt::format("| {:>{}} ", lines[i][k], widths[k]);
    text += "|\n";
    if (i > 0) continue;
    for (std::size_t k = 0; k < widths.size(); ++k)
      text += fmt::format("|{:-<{}}{}", "", widths[k] + 1, k < 2 ? "-" : ":");
    text += "|\n";
  }
  return text;
}

std::string wrong_of(int wrong, int given, int contacts) {
  if (contacts == 0) return "";
  return given == 0 ? "not given" : std::to_string(wrong);
}

std::string size_of_worst(double worst, int given) {
  return given == 0 ? "" : fmt::format("{:.2g}", worst);
}

// a field of a comma-separated file
std::string quoted(std::string text) {
  for (std::size_t at = text.find('"'); at != std::string::npos; at = text.find('"', at + 2))
    text.insert(at, 1, '"');
  return '"' + text + '"';
}

}  // namespace

std::string verdict_sentence(const std::string& kernel, const std::vector<Verdict>& verdicts) {
  const Verdict sum = sum_of(verdicts);
  if (sum.errors() == 0) return fmt::format("{}: no error in {} pairs\n", kernel, sum.pairs);
  return fmt::format(
      "{}: {} pairs, wrong: {} decisions, {} points, {} normals, {} overlaps; {} answers unusable. The first: {}\n",
      kernel, sum.pairs, sum.decisions, sum.points, sum.normals, sum.overlaps, sum.unusable, sum.first_error);
}

std::string verdict_table(const std::vector<Verdict>& verdicts) {
  std::vector<Line> lines{{"shape", "state", "pairs", "decisions", "unusable", "points", "normals", "overlaps",
                           "worst point, m", "normal, rad", "overlap, m"}};
  for (const Verdict& v : verdicts)
    lines.push_back({v.shape, v.state, std::to_string(v.pairs), std::to_string(v.decisions), std::to_string(v.unusable),
                     wrong_of(v.points, v.points_given, v.contacts), wrong_of(v.normals, v.normals_given, v.contacts),
                     wrong_of(v.overlaps, v.overlaps_given, v.contacts), size_of_worst(v.worst_point, v.points_given),
                     size_of_worst(v.worst_normal, v.normals_given), size_of_worst(v.worst_overlap, v.overlaps_given)});
  return table(lines);
}

// a column for each method
std::string time_table(const std::vector<KernelTime>& times) {
  const auto column_of = [](const KernelTime& t) { return t.method + ", " + t.delivers; };
  Line columns;
  for (const KernelTime& t : times)
    if (std::find(columns.begin(), columns.end(), column_of(t)) == columns.end()) columns.push_back(column_of(t));
  std::vector<Line> lines{{"shape", "state"}};
  lines[0].insert(lines[0].end(), columns.begin(), columns.end());
  for (const KernelTime& t : times) {
    if (lines.back()[0] != t.shape || lines.back()[1] != t.state) {
      lines.emplace_back(columns.size() + 2);
      lines.back()[0] = t.shape;
      lines.back()[1] = t.state;
    }
    const auto place = std::find(columns.begin(), columns.end(), column_of(t)) - columns.begin();
    lines.back()[static_cast<std::size_t>(place) + 2] =
        t.wrong == 0 ? fmt::format("{:.0f}", t.median_ns) : fmt::format("{:.0f} ({} wrong)", t.median_ns, t.wrong);
  }
  return table(lines);
}

std::string verdict_csv(const std::string& kernel, const std::vector<Verdict>& verdicts) {
  std::string text =
      "kernel,shape,state,pairs,wrong_decisions,unusable,wrong_points,wrong_normals,wrong_overlaps,worst_point_m,"
      "worst_normal_rad,worst_overlap_m,first_error\n";
  for (const Verdict& v : verdicts)
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", quoted(kernel), v.shape, v.state, v.pairs,
                        v.decisions, v.unusable, v.points, v.normals, v.overlaps, v.worst_point, v.worst_normal,
                        v.worst_overlap, quoted(v.first_error));
  return text;
}

std::string time_csv(const std::vector<KernelTime>& times) {
  std::string text = "shape,state,method,delivers,median_ns,wrong,pairs\n";
  for (const KernelTime& t : times)
    text += fmt::format("{},{},{},{},{:.1f},{},{}\n", t.shape, t.state, quoted(t.method), t.delivers, t.median_ns,
                        t.wrong, t.pairs);
  return text;
}

}  // namespace voussoir::benchmarks
