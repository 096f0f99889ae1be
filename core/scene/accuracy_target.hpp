// [accuracy] error: how wide the error bar of what a scene searches may be, "1 %" of it or "0.1 deg".
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

// nothing where the text is no such target
std::optional<AccuracyTarget> accuracy_target(std::string_view text);

// Of a tree that check_keys has seen: nothing where it states none or `budget = false`. Throws SceneError where the
// text is none, and where no search of the scene can be refined to it.
std::optional<AccuracyTarget> accuracy_target(const Node& scene);

}  // namespace voussoir
