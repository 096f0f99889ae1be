// What an error budget varies in a scene: by which overrides, and what a shift then says is left open.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/base/run_scene.hpp"
#include "core/scene/node.hpp"

namespace voussoir {

struct Variation {
  std::string name, change;  // "stiffness", "4 times"
  double refined = 1;        // so many times finer than the scene; below 1: coarser
  double order = 0;          // the power of it that errors go with; 0: not known, and the shift itself is left
  std::function<std::vector<std::string>(double)> by = {};  // overrides that make it so many times finer
  std::string refined_by = {};  // another one's name: what it leaves open that one closes, by the same factor
  bool sensitivity = false;     // measured: told, but no error

  std::vector<std::string> overrides() const { return by(refined); }
  // f^p / (f^p - 1) of a shift (Richardson), in the unit of the shift
  double left_by(double shift) const;
};

// What is varied: each by itself, and what moves few answers together first. Where that moved something, the first of
// them and the others together; where these moved something, each by itself.
struct Variations {
  std::vector<Variation> alone, together;
};

Variations variations_of(const LoadedScene& scene);

// several at once, under the name of their number's
Variation at_once(const std::vector<Variation>& variations);

// what a line adds to the square of a bar, its unit squared
double square_of(const BudgetLine& line);

// a stage that searches, and the path of its keys
struct Search {
  const ReducePlan& plan;
  std::string path;
  std::string value;  // what it yields in Results

  bool angle() const { return plan.searched == Searched::friction; }
};
std::vector<Search> searches_of(const LoadedScene& scene);

// an override of one key
std::string set(const std::string& path, std::string_view key, double value);

// whether a table says `key = true`
bool states(const Node& table, std::string_view key);

}  // namespace voussoir
