#include "benchmarks/contact_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "benchmarks/method_names.hpp"

namespace voussoir::benchmarks {
namespace {

using nlohmann::json;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

// a counter that is zero is left out
double finite(const json& entry, const char* key) {
  const double value = entry.value(key, 0.0);
  if (!std::isfinite(value))
    throw std::runtime_error(fmt::format("{}: {} is not finite", entry.at("name").get<std::string>(), key));
  return value;
}

Row read_row(const json& entry) {
  const std::string name = entry.at("run_name").get<std::string>();
  const std::vector<std::string> parts = split(name, '/');
  if (parts.size() < 4) throw std::runtime_error(fmt::format("{}: not shape/state/method/stage", name));
  if (entry.at("time_unit") != "ns") throw std::runtime_error(fmt::format("{}: not in ns", name));
  Row row;
  row.shape = parts[0];
  row.state = parts[1];
  row.method = parts[2];
  row.stage = parts[3];
  row.delivers = entry.at("label").get<std::string>();
  row.wrong = static_cast<int>(finite(entry, "wrong"));
  // each thread has its fraction of the pairs, and Google Benchmark has divided by their number already
  const int pairs_of_thread = static_cast<int>(finite(entry, "pairs"));
  row.pairs = pairs_of_thread * entry.value("threads", 1);
  row.median_ns = finite(entry, "real_time") / std::max(pairs_of_thread, 1);
  if (!(row.median_ns > 0)) throw std::runtime_error(fmt::format("{}: no time", name));
  row.planes = finite(entry, "planes");
  row.vertices = finite(entry, "vertices");
  row.newton = finite(entry, "newton");
  row.pivots = finite(entry, "pivots");
  row.lp_solves = finite(entry, "lp_solves");
  row.areas = finite(entry, "areas");
  return row;
}

std::string origin(const json& run, int repetitions) {
  const json& context = run.at("context");
  return fmt::format("Run of {}, commit `{}`, {} logical cores of {} MHz; medians of {} interleaved repetitions.",
                     context.value("date", "an unknown date"), context.value("commit", "unknown"),
                     context.value("num_cpus", 0), context.value("mhz_per_cpu", 0), repetitions);
}

// A figure's table: shapes in order of their abscissa, times in µs. A figure needs times of every method.
struct Column {
  const char *name, *method, *stage;
};

std::string figure_csv(const Report& report, const char* state, double Row::*abscissa, const char* abscissa_name,
                       const std::vector<Column>& columns) {
  std::vector<std::string> shapes(std::begin(regular_shapes), std::end(regular_shapes));
  shapes.push_back("joint-cut block");
  std::vector<std::pair<double, std::string>> lines;
  for (const std::string& shape : shapes) {
    std::string line;
    double at = 0;
    for (const Column& column : columns) {
      const Row* row = find_row(report, shape, state, column.method, column.stage);
      if (!row) return {};
      at = row->*abscissa;
      line += fmt::format(",{:.5g}", 1e-3 * row->median_ns);
    }
    lines.emplace_back(at, fmt::format("{},{:g}{}\n", shape, at, line));
  }
  std::sort(lines.begin(), lines.end());
  std::string text = fmt::format("shape,{}", abscissa_name);
  for (const Column& column : columns)
    text += fmt::format(",{}_us", column.name);
  text += '\n';
  for (const auto& line : lines)
    text += line.second;
  return text;
}

}  // namespace

const char* reference_method(const std::string& state) {
  return state == "solid" ? solid_centre : batched_warm;
}

const char* reference_stage(const std::string& state) {
  return state == "solid" ? "centre" : state == "separated" || state == "near" ? "decision" : "overlap";
}

const Row* find_row(const Report& report, const std::string& shape, const std::string& state, const std::string& method,
                    const std::string& stage) {
  for (const Row& row : report.rows)
    if (row.shape == shape && row.state == state && row.method == method && row.stage == stage) return &row;
  return nullptr;
}

Report read_report(const std::string& json_text) try {
  const json run = json::parse(json_text);
  Report report;
  int repetitions = 0;
  // interleaved benchmarks end in any order: back to the order in which they were registered
  std::map<int, Row> in_order;
  for (const json& entry : run.at("benchmarks")) {
    if (entry.value("aggregate_name", "") != "median") continue;
    in_order[entry.at("family_index").get<int>()] = read_row(entry);
    repetitions = entry.value("repetitions", 0);
  }
  for (const auto& [index, row] : in_order)
    report.rows.push_back(row);
  if (report.rows.empty()) throw std::runtime_error("the run has no medians: repeat the benchmarks at least twice");
  for (Row& row : report.rows) {
    const Row* ours = find_row(report, row.shape, row.state, reference_method(row.state), reference_stage(row.state));
    if (!ours)
      throw std::runtime_error(
          fmt::format("{}/{}: no row of {} to compare with", row.shape, row.state, reference_method(row.state)));
    row.ratio_to_ours = row.median_ns / ours->median_ns;
  }
  report.origin = origin(run, repetitions);
  return report;
} catch (const json::exception& problem) {
  throw std::runtime_error(fmt::format("not a run of Google Benchmark: {}", problem.what()));
}

int own_wrong_decisions(const Report& report) {
  int wrong = 0;
  for (const Row& row : report.rows)
    if (row.method.starts_with("voussoir")) wrong += row.wrong;
  return wrong;
}

std::string flat_csv(const Report& report) {
  std::string text =
      "shape,state,method,stage,median_ns,ratio_to_ours,delivers,wrong,pairs,planes,vertices,newton,pivots,lp_solves,"
      "areas\n";
  for (const Row& row : report.rows)
    text += fmt::format("{},{},{},{},{:.5g},{:.5g},{},{},{},{:g},{:g},{:g},{:g},{:g},{:g}\n", row.shape, row.state,
                        row.method, row.stage, row.median_ns, row.ratio_to_ours, row.delivers, row.wrong, row.pairs,
                        row.planes, row.vertices, row.newton, row.pivots, row.lp_solves, row.areas);
  return text;
}

std::string planes_csv(const Report& report) {
  return figure_csv(report, "touch", &Row::planes, "planes",
                    {{"own_lp", own_lp, "lp"},
                     {"glpk_cold", glpk_dual_cold, "lp"},
                     {"glpk_warm", glpk_dual_warm, "lp"},
                     {"own_centre", own_centre, "centre"},
                     {"ipopt", ipopt_centre, "centre"},
                     {"own_contact", batched_warm, "overlap"}});
}

std::string vertices_csv(const Report& report) {
  return figure_csv(report, "solid", &Row::vertices, "vertices",
                    {{"centre", solid_centre, "centre"},
                     {"lp_and_centre", solid_lp_and_centre, "centre"},
                     {"centroid", solid_centroid, "centre"}});
}

}  // namespace voussoir::benchmarks
