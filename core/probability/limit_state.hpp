// What fails, as a function of independent standard normals u.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace voussoir {

using StandardPoint = std::vector<double>;  // u, by key

struct StateAnswer {
  std::optional<double> g;  // > 0: stands; <= 0: fails; none: there is no answer at this point
  std::string mode;         // the mechanism's name; may be empty
};

// Answers of a batch of points, in their order: the caller may find them in parallel. The searches ask for as many
// points at once as they can.
using LimitFunction = std::function<std::vector<StateAnswer>(const std::vector<StandardPoint>&)>;

// a linearisation of g = 0: direction·u >= distance fails
struct FailedHalfSpace {
  StandardPoint direction;  // unit
  double distance = 0;
};

}  // namespace voussoir
