// Shared by the cases' tests: run a scene of the case's folder, read its results, write data for figures.
#pragma once

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/base/run_scene.hpp"
#include "verification/case_report.hpp"

namespace voussoir::cases {

// integrated contact for every joint that allows it: constant stiffness per area, no bond
inline const std::string whole_faces = "contact.face=integrated";

// a number as --set takes it
inline std::string text(double number) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.15g", number);
  return buffer;
}

// Runs <case>/<scene> and demands that it reached its goals.
inline SceneRun run(const std::string& scene, const std::vector<std::string>& overrides = {}, int threads = 1) {
  SceneRun done = run_scene(std::filesystem::path(VOUSSOIR_CASE_DIR) / scene, overrides, threads);
  if (done.results.outcome != Outcome::done) throw std::runtime_error(scene + ": " + done.results.message);
  return done;
}

inline double value(const SceneRun& run, const std::string& name) {
  const Value* v = run.results.find(name);
  if (!v) throw std::out_of_range("no value " + name);
  return v->value;
}

inline verification::Cost cost(const SceneRun& run) {
  return {run.results.counters.contact_evaluations, run.results.seconds};
}

// a column of the history, over the rows of one stage (numbered from 1; 0: all)
inline std::vector<double> column(const SceneRun& run, const std::string& name, int stage = 0) {
  const History& h = run.results.history;
  const auto found = std::find(h.columns.begin(), h.columns.end(), name);
  if (found == h.columns.end()) throw std::out_of_range("no column " + name);
  const auto place = found - h.columns.begin();
  const auto stage_place = std::find(h.columns.begin(), h.columns.end(), "stage") - h.columns.begin();
  std::vector<double> values;
  for (const std::vector<double>& row : h.rows)
    if (stage == 0 || row[stage_place] == stage) values.push_back(row[place]);
  return values;
}

// the vertices of a part in the plane along its boundary, the first again at the end: a closed line to draw
inline std::vector<int> closed_ring(const Polytope<2>& part) {
  std::vector<int> ring = boundary_ring(part);
  ring.push_back(ring.front());
  return ring;
}

// A CSV file in the case's output folder, for its figure. All columns have the same length.
inline void write_csv(const std::string& case_name, const std::string& file, const std::vector<std::string>& header,
                      const std::vector<std::vector<double>>& columns) {
  std::ofstream out(verification::case_output(case_name) / file);
  out.precision(12);
  for (std::size_t k = 0; k < header.size(); ++k)
    out << (k ? "," : "") << header[k];
  out << '\n';
  for (std::size_t r = 0; r < columns.front().size(); ++r) {
    for (std::size_t k = 0; k < columns.size(); ++k)
      out << (k ? "," : "") << columns[k][r];
    out << '\n';
  }
  if (!out) throw std::runtime_error("cannot write " + file);
}

}  // namespace voussoir::cases
