// Reads the results of bench_contact (Google Benchmark's JSON, medians of repetitions): one flat table, the ratios to
// our kernel, the data of two figures.
#pragma once

#include <string>
#include <vector>

namespace voussoir::benchmarks {

// a method on the pairs of one shape and state
struct Row {
  std::string shape, state, method, stage;
  double median_ns = 0;             // of one pair
  double ratio_to_ours = 0;         // over `batched_warm` on the same pairs, see reference_stage
  std::string delivers;             // words of `answers` in contact_tables.cpp
  int wrong = 0, pairs = 0;         // wrong decisions, and the number of pairs
  double planes = 0, vertices = 0;  // of both parts; of the second: means over the pairs
  double newton = 0, pivots = 0, lp_solves = 0, areas = 0;  // of our kernel, per pair
};

struct Report {
  std::vector<Row> rows;  // shape by shape, state by state
  std::string origin;     // a sentence: when, which commit, how many repetitions
};

// Throws std::runtime_error if the text is not such JSON, has no medians, a row is not finite or positive, or our own
// row of a ratio is missing.
Report read_report(const std::string& json_text);

// wrong decisions of our kernel
int own_wrong_decisions(const Report& report);

// The denominator of the ratios: our kernel, batched and warm, up to the overlap if the parts overlap and up to the
// decision if they do not; for a single polyhedron our analytic centre from a feasible start.
const char* reference_method(const std::string& state);
const char* reference_stage(const std::string& state);

// the row, or null
const Row* find_row(const Report& report, const std::string& shape, const std::string& state, const std::string& method,
                    const std::string& stage);

// shape,state,method,stage,median_ns,ratio_to_ours,delivers,wrong,pairs,planes,vertices,newton,pivots,lp_solves,areas
std::string flat_csv(const Report& report);

// Fig. 4.9: shape,planes, then µs of touching pairs. Fig. 4.10: shape,vertices, then µs. Empty if a method is missing.
std::string planes_csv(const Report& report);
std::string vertices_csv(const Report& report);

// Markdown that is also readable in a terminal: our times against their targets, the ratios with the quantities that
// each peer does not deliver, and all times state by state.
std::string summary_tables(const Report& report);
std::string time_tables(const Report& report);

inline constexpr const char* regular_shapes[] = {"tetrahedron", "cube", "octahedron", "dodecahedron", "icosahedron"};

}  // namespace voussoir::benchmarks
