// unit.contact_report: the reader of the contact benchmark's results, on an excerpt of a run and on made-up times.
#include "benchmarks/contact_report.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "benchmarks/method_names.hpp"

namespace voussoir::benchmarks {
namespace {

// as Google Benchmark writes it: in the order in which interleaved benchmarks ended, statistics of each
const char* const excerpt = R"({
  "context": {"date": "2026-11-21T10:43:23+00:00", "num_cpus": 2, "mhz_per_cpu": 2445, "commit": "c8a9515"},
  "benchmarks": [
    {"name": "cube/touch/libccd GJK+EPA/overlap/manual_time/threads:1_mean", "family_index": 7,
     "run_name": "cube/touch/libccd GJK+EPA/overlap/manual_time/threads:1", "run_type": "aggregate", "repetitions": 3,
     "threads": 1, "aggregate_name": "mean", "aggregate_unit": "time", "iterations": 3, "real_time": 9.9e6,
     "cpu_time": 9.9e6, "time_unit": "ns", "pairs": 1000.0, "planes": 12.0, "vertices": 8.0, "wrong": 3.0,
     "label": "decision point normal overlap"},
    {"name": "cube/touch/libccd GJK+EPA/overlap/manual_time/threads:1_median", "family_index": 7,
     "run_name": "cube/touch/libccd GJK+EPA/overlap/manual_time/threads:1", "run_type": "aggregate", "repetitions": 3,
     "threads": 1, "aggregate_name": "median", "aggregate_unit": "time", "iterations": 3, "real_time": 2.0e6,
     "cpu_time": 2.1e6, "time_unit": "ns", "pairs": 1000.0, "planes": 12.0, "vertices": 8.0, "wrong": 3.0,
     "label": "decision point normal overlap"},
    {"name": "cube/touch/voussoir batched warm 1 %/overlap/manual_time/threads:1_median", "family_index": 2,
     "run_name": "cube/touch/voussoir batched warm 1 %/overlap/manual_time/threads:1", "run_type": "aggregate",
     "repetitions": 3, "threads": 1, "aggregate_name": "median", "aggregate_unit": "time", "iterations": 3,
     "real_time": 1.0e5, "cpu_time": 1.1e5, "time_unit": "ns", "pairs": 1000.0, "planes": 12.0, "vertices": 8.0,
     "newton": 2.5, "label": "decision certificate point normal overlap"}
  ]})";

std::string entry(int index, const std::string& name, double ns, double planes, const std::string& delivers) {
  return fmt::format(
      "{{\"name\": \"{0}_median\", \"run_name\": \"{0}/manual_time/threads:1\", \"family_index\": {1}, "
      "\"aggregate_name\": \"median\", \"repetitions\": 9, \"time_unit\": \"ns\", \"real_time\": {2}, \"pairs\": 100, "
      "\"planes\": {3}, \"vertices\": {3}, \"label\": \"{4}\"}}",
      name, index, 100 * ns, planes, delivers);
}

// Shape k takes f·2^k ns with a factor f for each method: every ratio of means is a ratio of factors.
std::string made_up_run(bool with_ipopt) {
  struct Timed {
    std::string state, method, stage;
    double factor;
    const char* delivers;
  };
  std::vector<Timed> list = {
      {"separated", batched_warm, "decision", 10, "decision certificate"},
      {"separated", ccd_gjk, "decision", 130, "decision"},
      {"touch", batched_warm, "overlap", 50, "decision certificate point normal overlap"},
      {"touch", single_warm, "overlap", 100, "decision certificate point normal overlap"},
      {"touch", single_cold, "overlap", 400, "decision certificate point normal overlap"},
      {"touch", own_lp, "lp", 100, "decision"},
      {"touch", own_lp_warm, "lp", 125, "decision"},
      {"touch", own_centre, "centre", 200, "point"},
      {"touch", glpk_dual_cold, "lp", 4000, "decision"},
      {"touch", glpk_primal, "lp", 5000, "decision"},
      {"touch", glpk_dual_warm, "lp", 2500, "decision"},
      {"touch", ccd_epa, "overlap", 800, "decision point normal overlap"},
      {"solid", solid_centre, "centre", 100, "point"},
      {"solid", solid_lp_and_centre, "centre", 50, "point"},
      {"solid", solid_centroid, "centre", 300, "point"},
      {"plane", batched_warm, "overlap", 100, "decision certificate point normal overlap"},
      {"plane", batched_warm_2d, "overlap", 30, "decision certificate point normal overlap"},
      {"plane", batched_warm, "area", 120, "decision certificate point normal overlap area"},
      {"plane", batched_warm_2d, "area", 50, "decision certificate point normal overlap area"},
  };
  if (with_ipopt) list.push_back({"touch", ipopt_centre, "centre", 1e6, "point"});
  std::vector<std::string> shapes(std::begin(regular_shapes), std::end(regular_shapes));
  shapes.push_back("joint-cut block");
  std::string text;
  int index = 0;
  for (std::size_t k = 0; k < shapes.size(); ++k)
    for (const Timed& t : list)
      text += (text.empty() ? "" : ",") + entry(index++, shapes[k] + "/" + t.state + "/" + t.method + "/" + t.stage,
                                                t.factor * (1 << k), 10.0 + 5 * ((k + 2) % 6), t.delivers);
  return "{\"context\": {}, \"benchmarks\": [" + text + "]}";
}

std::vector<std::vector<std::string>> fields(const std::string& csv) {
  std::vector<std::vector<std::string>> table;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    table.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');)
      table.back().push_back(cell);
  }
  return table;
}

// the line of a markdown table that begins with some text, without blanks
std::string table_line(const std::string& text, const std::string& start) {
  const std::size_t at = text.find("| " + start);
  if (at == std::string::npos) return {};
  std::string line = text.substr(at, text.find('\n', at) - at);
  std::erase(line, ' ');
  return line;
}

TEST(ContactReport, ReadsTheMediansOfARun) {
  const Report report = read_report(excerpt);
  ASSERT_EQ(report.rows.size(), 2u);
  const Row &ours = report.rows[0], &peer = report.rows[1];
  EXPECT_EQ(ours.method, batched_warm);
  EXPECT_DOUBLE_EQ(ours.median_ns, 100);
  EXPECT_DOUBLE_EQ(ours.newton, 2.5);
  EXPECT_EQ(peer.shape, "cube");
  EXPECT_EQ(peer.state, "touch");
  EXPECT_EQ(peer.stage, "overlap");
  EXPECT_EQ(peer.delivers, "decision point normal overlap");
  EXPECT_DOUBLE_EQ(peer.median_ns, 2000);
  EXPECT_DOUBLE_EQ(peer.ratio_to_ours, 20);
  EXPECT_EQ(peer.wrong, 3);
  EXPECT_EQ(own_wrong_decisions(report), 0);
  EXPECT_NE(report.origin.find("medians of 3"), std::string::npos);
}

// the excerpt with every occurrence of a text replaced
std::string altered(const std::string& from, const std::string& to) {
  std::string text = excerpt;
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

TEST(ContactReport, RefusesOtherFiles) {
  EXPECT_THROW(read_report("{"), std::runtime_error);
  EXPECT_THROW(read_report("{}"), std::runtime_error);
  EXPECT_THROW(read_report(altered("\"median\"", "\"mean\"")), std::runtime_error);
  EXPECT_THROW(read_report(altered("\"real_time\": 2.0e6", "\"real_time\": 0")), std::runtime_error);
  EXPECT_THROW(read_report(altered("\"real_time\": 2.0e6", "\"real_time\": nan")), std::runtime_error);
  EXPECT_THROW(read_report(altered("batched warm 1 %", "batched cold")), std::runtime_error);
  EXPECT_EQ(read_report(altered("\"threads\": 1", "\"threads\": 2")).rows[0].pairs, 2000);
  EXPECT_EQ(own_wrong_decisions(read_report(altered("\"newton\": 2.5", "\"wrong\": 2"))), 2);
}

TEST(ContactReport, WritesEveryMethodToTheFlatTable) {
  const auto table = fields(flat_csv(read_report(made_up_run(true))));
  const std::vector<std::string> first(table[0].begin(), table[0].begin() + 7);
  EXPECT_EQ(first,
            (std::vector<std::string>{"shape", "state", "method", "stage", "median_ns", "ratio_to_ours", "delivers"}));
  EXPECT_EQ(table.size(), 1u + 6 * 20);
  for (std::size_t i = 1; i < table.size(); ++i) {
    ASSERT_EQ(table[i].size(), table[0].size());
    EXPECT_GT(std::stod(table[i][4]), 0);
    EXPECT_TRUE(std::isfinite(std::stod(table[i][5])));
  }
  for (const char* method : {batched_warm, ccd_gjk, glpk_dual_warm, ipopt_centre, solid_centroid})
    EXPECT_EQ(std::count_if(table.begin(), table.end(),
                            [&](const auto& row) { return row[2] == method && row[0] == "icosahedron"; }),
              method == batched_warm ? 4 : 1)
        << method;
}

TEST(ContactReport, ComparesGeometricMeansWithRequirements) {
  const std::string text = summary_tables(read_report(made_up_run(true)));
  // 2^0 … 2^4: their mean is 4
  EXPECT_EQ(table_line(text, "GLPK, its best warm form"),
            "|GLPK,itsbestwarmform|10000|50(≥40)|25|20|certificate,point,normal,overlap,area|");
  EXPECT_EQ(table_line(text, "GLPK, its best cold form"),
            "|GLPK,itsbestcoldform|16000|80|40|40(≥35)|certificate,point,normal,overlap,area|");
  EXPECT_EQ(table_line(text, "libccd GJK+EPA"), "|libccdGJK+EPA|3200|16(≥12)|8.0(≥7)|2.0|certificate,area|");
  EXPECT_EQ(table_line(text, "rejection: libccd GJK"), "|rejection:libccdGJK|520|13(≥14:missed)|–|–|certificate|");
  EXPECT_EQ(table_line(text, "squares, without area"), "|squares,withoutarea|200|60.0|3.3(≥2.5)|");
  EXPECT_EQ(table_line(text, "squares, all with area"), "|squares,allwitharea|240|100|2.4(≥2.5:missed)|");
  EXPECT_EQ(table_line(text, "Bullet"), "|BulletGjkEpa2,double|–|–(≥10)|–(≥6)|–|nottimed|");
}

TEST(ContactReport, ShowsEveryMethodStateByState) {
  const std::string text = time_tables(read_report(made_up_run(true)));
  EXPECT_EQ(table_line(text, "libccd GJK+EPA"),
            "|libccdGJK+EPA,overlap|800|1600|3200|6400|12800|25600|3200|16|0of600|");
  EXPECT_EQ(text.find("nan"), std::string::npos);
}

TEST(ContactReport, MakesTheFiguresData) {
  const Report report = read_report(made_up_run(true));
  const auto planes = fields(planes_csv(report)), vertices = fields(vertices_csv(report));
  ASSERT_EQ(planes.size(), 7u);
  ASSERT_EQ(vertices.size(), 7u);
  EXPECT_EQ(planes[1][0], "icosahedron");  // sorted by their planes, not by their names
  for (std::size_t i = 2; i < planes.size(); ++i)
    EXPECT_LT(std::stod(planes[i - 1][1]), std::stod(planes[i][1]));
  EXPECT_EQ(vertices[1], (std::vector<std::string>{"icosahedron", "10", "1.6", "0.8", "4.8"}));
  // drawn by report.contact_planes and report.contact_vertices
  std::ofstream("contact_planes.csv") << planes_csv(report);
  std::ofstream("contact_vertices.csv") << vertices_csv(report);

  EXPECT_EQ(planes_csv(read_report(made_up_run(false))), "");
}

}  // namespace
}  // namespace voussoir::benchmarks
