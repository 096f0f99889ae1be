// The tables of the contact benchmark.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "benchmarks/contact_report.hpp"
#include "benchmarks/method_names.hpp"

namespace voussoir::benchmarks {
namespace {

// the quantities that a contact needs
constexpr const char* answers[] = {"decision", "certificate", "point", "normal", "overlap", "area"};

// ---- markdown -------------------------------------------------------------------------------------------------------

using Cells = std::vector<std::string>;

std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

// the first row is the header; the first column, and those after `numbers` of them, are text
std::string markdown(const std::vector<Cells>& table, std::size_t numbers) {
  std::vector<std::size_t> widths(table[0].size(), 3);
  for (const Cells& row : table)
    for (std::size_t k = 0; k < row.size(); ++k)
      widths[k] = std::max(widths[k], width(row[k]));
  std::string text;
  for (std::size_t r = 0; r < table.size(); ++r) {
    for (std::size_t k = 0; k < table[r].size(); ++k) {
      const std::string fill(widths[k] - width(table[r][k]), ' ');
      const bool right = k > 0 && k <= numbers;
      text += right ? "| " + fill + table[r][k] + " " : "| " + table[r][k] + fill + " ";
    }
    text += "|\n";
    if (r > 0) continue;
    for (std::size_t k = 0; k < widths.size(); ++k)
      text += "|" + std::string(widths[k] + 1, '-') + (k > 0 && k <= numbers ? ":" : "-");
    text += "|\n";
  }
  return text + "\n";
}

std::string time_text(std::optional<double> ns) {
  if (!ns) return "–";
  return *ns < 100 ? fmt::format("{:.1f}", *ns) : fmt::format("{:.0f}", *ns);
}

std::string ratio_text(std::optional<double> ratio, double required) {
  std::string text = !ratio ? "–" : *ratio < 10 ? fmt::format("{:.1f}", *ratio) : fmt::format("{:.0f}", *ratio);
  if (required > 0) text += fmt::format(" (≥ {:g}{})", required, ratio && *ratio < required ? ": missed" : "");
  return text;
}

// ---- figures over the five regular shapes ---------------------------------------------------------------------------

struct Source {
  const char *method, *stage;
};

// Geometric mean over the five of the fastest of some methods; nothing if one of the five is missing.
std::optional<double> regular_mean(const Report& report, const char* state, const std::vector<Source>& sources) {
  double sum = 0;
  for (const char* shape : regular_shapes) {
    double best = 0;
    for (const Source& source : sources)
      if (const Row* row = find_row(report, shape, state, source.method, source.stage))
        best = best > 0 ? std::min(best, row->median_ns) : row->median_ns;
    if (!(best > 0)) return std::nullopt;
    sum += std::log(best);
  }
  return std::exp(sum / std::size(regular_shapes));
}

std::optional<double> quotient(std::optional<double> a, std::optional<double> b) {
  return a && b ? std::optional(*a / *b) : std::nullopt;
}

std::string not_delivered(const std::string& delivers) {
  std::string text;
  for (const char* answer : answers)
    if (delivers.find(answer) == std::string::npos) text += (text.empty() ? "" : ", ") + std::string(answer);
  return text;
}

// ---- our times ------------------------------------------------------------------------------------------------------

struct OwnTime {
  const char* what;
  const char* state;
  Source source;
  const char* target;
};

// limits in nanoseconds of one core; batched in vectors of 256 (512) bits
constexpr OwnTime own_times[] = {
    {"overlapping, warm 1 %, all with area, single", "touch", {single_warm, "area"}, "≤ 280"},
    {"overlapping, warm 1 %, all with area, batched", "touch", {batched_warm, "area"}, "≤ 220 (160)"},
    {"overlapping, warm 1 %, without area, single", "touch", {single_warm, "overlap"}, ""},
    {"overlapping, warm 1 %, without area, batched", "touch", {batched_warm, "overlap"}, ""},
    {"overlap 1e-2, warm 1 %, without area, batched", "deep", {batched_warm, "overlap"}, ""},
    {"the same on the central path, single", "deep", {single_warm_path, "overlap"}, ""},
    {"the same on the central path, batched", "deep", {batched_warm_path, "overlap"}, ""},
    {"overlapping, warm 10 %, all with area, batched", "touch", {batched_warm_far, "area"}, ""},
    {"overlapping, cold, all with area, single", "touch", {single_cold, "area"}, "≤ 1000"},
    {"face on face, warm 1 %, all with area, batched", "face", {batched_warm, "area"}, ""},
    {"face on face, cold, all with area, single", "face", {single_cold, "area"}, ""},
    {"separated, cached, single", "separated", {single_warm, "decision"}, "≤ 20"},
    {"separated, cached, batched", "separated", {batched_warm, "decision"}, "≤ 20"},
    {"separated, cold, single", "separated", {single_cold, "decision"}, ""},
    {"gap 1e-4, cold, single", "near", {single_cold, "decision"}, ""},
    {"overlapping, warm 1 %, all with area, 2 threads", "touch", {batched_warm_threads, "area"}, ""},
};

std::string own_table(const Report& report) {
  std::vector<Cells> table = {{"our kernel, geometric mean of the five regular shapes", "ns", "target"}};
  for (const OwnTime& line : own_times)
    table.push_back({line.what, time_text(regular_mean(report, line.state, {line.source})), line.target});
  return markdown(table, 2);
}

// ---- ratios ---------------------------------------------------------------------------------------------------------

struct Comparison {
  const char* what;
  const char* state;
  std::vector<Source> peer;        // the fastest counts
  double batched, single;          // required ratio to our warm kernel; 0: none
  std::vector<Source> same_start;  // ours from the same start, for a fair comparison
  double same_start_required;
};

const std::vector<Comparison>& comparisons() {
  static const Source lp{own_lp, "lp"}, lp_warm{own_lp_warm, "lp"}, centre{own_centre, "centre"},
      contact{single_cold, "overlap"}, decision{single_cold, "decision"};
  static const std::vector<Comparison> list = {
      {"GLPK, its best warm form", "touch", {{glpk_dual_warm, "lp"}}, 40, 0, {lp_warm}, 0},
      {"GLPK, its best cold form", "touch", {{glpk_dual_cold, "lp"}, {glpk_primal, "lp"}}, 0, 0, {lp}, 35},
      {"Ipopt, slack form", "touch", {{ipopt_centre, "centre"}}, 5000, 0, {centre}, 0},
      {"libccd GJK+EPA", "touch", {{ccd_epa, "overlap"}}, 12, 7, {contact}, 0},
      {"libccd MPR", "touch", {{ccd_mpr, "overlap"}}, 0, 0, {contact}, 0},
      {"FCL collide with contact", "touch", {{fcl_contact, "overlap"}}, 12, 7, {contact}, 0},
      {"Bullet GjkEpa2, double", "touch", {{bullet_epa, "overlap"}}, 10, 6, {contact}, 0},
      {"hand clip and centroid", "touch", {{hand_clip, "point"}}, 0, 0, {contact}, 0},
      {"rejection: libccd GJK", "separated", {{ccd_gjk, "decision"}}, 14, 0, {decision}, 0},
      {"rejection: libccd MPR", "separated", {{ccd_mpr, "overlap"}}, 0, 0, {decision}, 0},
      {"rejection: FCL", "separated", {{fcl_contact, "overlap"}}, 0, 0, {decision}, 0},
      {"rejection: Bullet GjkEpa2", "separated", {{bullet_epa, "overlap"}}, 0, 0, {decision}, 0},
  };
  return list;
}

std::string lacks(const Report& report, const Comparison& line) {
  const Row* row = find_row(report, regular_shapes[0], line.state, line.peer[0].method, line.peer[0].stage);
  if (!row) return "not timed";
  // that parts are apart has no point
  return std::string(line.state) == "separated" ? "certificate" : not_delivered(row->delivers);
}

std::string ratio_table(const Report& report) {
  std::vector<Cells> table = {{"peer", "its ns", "÷ ours batched", "÷ ours single", "÷ ours, same start", "it lacks"}};
  for (const Comparison& line : comparisons()) {
    const std::optional<double> peer = regular_mean(report, line.state, line.peer);
    const char* stage = reference_stage(line.state);
    const auto over = [&](std::vector<Source> ours) { return quotient(peer, regular_mean(report, line.state, ours)); };
    table.push_back({line.what, time_text(peer), ratio_text(over({{batched_warm, stage}}), line.batched),
                     ratio_text(over({{single_warm, stage}}), line.single),
                     ratio_text(over(line.same_start), line.same_start_required), lacks(report, line)});
  }
  return markdown(table, 4);
}

// ---- the plane ------------------------------------------------------------------------------------------------------

constexpr double plane_gain = 2.5;  // required of the 2-D kernel over the 3-D kernel on the same scene

// nothing if the plane was not timed
std::string plane_table(const Report& report) {
  std::vector<Cells> table = {{"touching, warm 1 %, batched", "prisms in 3-D, ns", "polygons in 2-D, ns", "ratio"}};
  for (const auto& [shape, name] : {std::pair("cube", "squares"), std::pair("joint-cut block", "joint-cut polygons")})
    for (const auto& [stage, what] : {std::pair("overlap", "without area"), std::pair("area", "all with area")}) {
      const Row* prisms = find_row(report, shape, "plane", batched_warm, stage);
      const Row* polygons = find_row(report, shape, "plane", batched_warm_2d, stage);
      if (!prisms || !polygons) continue;
      table.push_back({fmt::format("{}, {}", name, what), time_text(prisms->median_ns), time_text(polygons->median_ns),
                       ratio_text(prisms->median_ns / polygons->median_ns, plane_gain)});
    }
  return table.size() > 1 ? "### Plane scenes\n\n" + markdown(table, 3) : "";
}

// ---- all times ------------------------------------------------------------------------------------------------------

std::string heading(const std::string& state) {
  if (state == "separated") return "Separated: 0.02 to 0.30 beyond touching";
  if (state == "near") return "Near: a gap of about 1e-4";
  if (state == "touch") return "Touching: LP optimum -0.5e-4";
  if (state == "face") return "Faces in contact: overlap 1e-4";
  if (state == "deep") return "Deep: LP optimum -0.5e-2";
  if (state == "plane") return "In the plane: prisms of thickness 1 side by side, and the same as polygons";
  return "A single polyhedron: its analytic centre and its centroid";
}

template <class Key>
std::vector<std::string> in_order(const Report& report, const std::string& state, Key key) {
  std::vector<std::string> list;
  for (const Row& row : report.rows) {
    const std::string name = key(row);
    if ((state.empty() || row.state == state) && std::find(list.begin(), list.end(), name) == list.end())
      list.push_back(name);
  }
  return list;
}

Cells state_line(const Report& report, const std::string& state, const std::vector<std::string>& shapes,
                 const std::string& method, const std::string& stage) {
  Cells line = {method + ", " + stage};
  int wrong = 0, pairs = 0;
  for (const std::string& shape : shapes) {
    const Row* row = find_row(report, shape, state, method, stage);
    line.push_back(time_text(row ? std::optional(row->median_ns) : std::nullopt));
    if (!row) continue;
    wrong += row->wrong;
    pairs += row->pairs;
  }
  const Source source{method.c_str(), stage.c_str()}, ours{reference_method(state), reference_stage(state)};
  const std::optional<double> mean = regular_mean(report, state.c_str(), {source});
  line.push_back(time_text(mean));
  line.push_back(ratio_text(quotient(mean, regular_mean(report, state.c_str(), {ours})), 0));
  line.push_back(fmt::format("{} of {}", wrong, pairs));
  return line;
}

std::string state_table(const Report& report, const std::string& state) {
  const std::vector<std::string> shapes = in_order(report, state, [](const Row& row) { return row.shape; });
  std::vector<Cells> table = {{"ns"}};
  table[0].insert(table[0].end(), shapes.begin(), shapes.end());
  for (const char* last : {"mean", "ratio", "wrong"})
    table[0].push_back(last);
  for (const std::string& line : in_order(report, state, [](const Row& row) { return row.method + '/' + row.stage; })) {
    const std::size_t cut = line.find('/');
    table.push_back(state_line(report, state, shapes, line.substr(0, cut), line.substr(cut + 1)));
  }
  return "### " + heading(state) + "\n\n" + markdown(table, shapes.size() + 3);
}

}  // namespace

std::string summary_tables(const Report& report) {
  return report.origin + "\n\n### Our kernel\n\n" + own_table(report) + "### Ratios\n\n" + ratio_table(report) +
         plane_table(report);
}

std::string time_tables(const Report& report) {
  std::string text;
  for (const std::string& state : in_order(report, "", [](const Row& row) { return row.state; }))
    text += state_table(report, state);
  return text;
}

}  // namespace voussoir::benchmarks
