// The variations of an error budget: their overrides, and the remaining error that follows from a shift.
#pragma once

#include <functional>
#include <optional>
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
  double most_left = 0;         // of several together: the largest factor of any of them; 0: by order

  std::vector<std::string> overrides() const { return by(refined); }
  // f^p / (f^p - 1) of a shift (Richardson), in the unit of the shift
  double left_by(double shift) const;
};

// The kind of a result, which decides what its error consists of. Without a search: the change of all values. By
// displacement: a search whose trials fail by displacement, or in which bodies turn and no fit was found. Judged by the
// strength that their motion requires: bodies slide, or turn.
enum class ResultKind { no_search, by_displacement, slides, turns };

// of the searches of a scene with these results; of several that of the first in the order of the enumeration
ResultKind kind_of(const LoadedScene& scene, const Results& results);

// The variations: some by themselves; those that rarely shift a result first together. If these shift a result that the
// required strength does not judge, the first of them and the others are varied apart, without a search each by itself.
struct Variations {
  std::vector<Variation> alone, together;
};

Variations variations_of(const LoadedScene& scene, ResultKind kind);

// The only variation of the error bar of a search without a budget: stiffness and increments at once. Nothing if no
// stiffness is assumed, or if it does not tell the error of this kind.
std::optional<Variation> stiffness_of_bar(const LoadedScene& scene, ResultKind kind);

// several together, named by their names
Variation at_once(const std::vector<Variation>& variations);

// The error left by a shift under one factor of refinement and a further shift under the same factor again, by the
// order that they show, at most the given one; nothing if the shifts do not converge.
std::optional<double> left_by_measured_order(double shift, double further, double factor, double order);

// the part of a bar due to an error left: with the margin for an extrapolation
double part_of(double left);

// a stage that searches, and the path of its keys
struct Search {
  const ReducePlan& plan;
  const StagePlan& stage;
  std::string path;
  std::string value;  // the name of its value in Results

  bool angle() const { return plan.searched == Searched::friction; }
  double tolerance() const;  // deg or 1
};
std::vector<Search> searches_of(const LoadedScene& scene);

// an override of one key
std::string set(const std::string& path, std::string_view key, double value);

// whether a table states `key = true`
bool states(const Node& table, std::string_view key);

}  // namespace voussoir
