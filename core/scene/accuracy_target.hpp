// [accuracy] error: the largest error bar of a scene's search result, "1 %" of it or "0.1 deg".
#pragma once

#include <cmath>
#include <optional>
#include <string_view>

#include "core/scene/node.hpp"

namespace voussoir {

struct AccuracyTarget {
  double size = 0;        // 1 or deg
  bool relative = false;  // to the value

  double allowed(double value) const { return relative ? size * std::abs(value) : size; }
};

// nothing if the text is no such target
std::optional<AccuracyTarget> accuracy_target(std::string_view text);

// Of a tree that check_keys has accepted: nothing if it states none or `budget = false`. Throws SceneError if the text
// is no target, or if no search of the scene can be refined to it.
std::optional<AccuracyTarget> accuracy_target(const Node& scene);

}  // namespace voussoir
