// The variations of an error budget: their overrides, and the remaining error that follows from a shift.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/base/run_scene.hpp"
#include "core/scene/node.hpp"

namespace voussoir {

struct Variation {
  std::string name, change;  // "stiffness", "4 times"
  double refined = 1;        // factor of refinement over the scene; below 1: coarser
  double order = 0;          // order of the error; 0: not known, and the shift itself is the remaining error
  std::function<std::vector<std::string>(double)> by = {};  // overrides that refine it by this factor
  std::string refined_by = {};  // name of another variation whose refinement by the same factor reduces this error
  bool sensitivity = false;     // measured: reported, but no error

  std::vector<std::string> overrides() const { return by(refined); }
  // f^p / (f^p - 1) of a shift (Richardson), in the unit of the shift
  double left_by(double shift) const;
};

// The variations: some by themselves; those that rarely shift a result first together. If these shift a result, the
// first of them and the others together; if the others shift it, each by itself.
struct Variations {
  std::vector<Variation> alone, together;
};

Variations variations_of(const LoadedScene& scene);

// several together, named by their number
Variation at_once(const std::vector<Variation>& variations);

// the contribution of a line to the square of a bar, its unit squared
double square_of(const BudgetLine& line);

// a stage that searches, and the path of its keys
struct Search {
  const ReducePlan& plan;
  std::string path;
  std::string value;  // the name of its value in Results

  bool angle() const { return plan.searched == Searched::friction; }
};
std::vector<Search> searches_of(const LoadedScene& scene);

// an override of one key
std::string set(const std::string& path, std::string_view key, double value);

// whether a table states `key = true`
bool states(const Node& table, std::string_view key);

}  // namespace voussoir
