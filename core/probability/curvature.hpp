// Second-order reliability: the curvature of g = 0 at the design point corrects Φ(-β).
#pragma once

#include <optional>
#include <vector>

#include "core/probability/design_point.hpp"

namespace voussoir {

struct SecondOrder {
  double breitung = 0;      // Φ(-β) Π (1 + β κ)^(-1/2) (Breitung 1984)
  double hohenbichler = 0;  // the same with φ(β)/Φ(-β) in place of β in the brackets (Hohenbichler & Rackwitz 1988)
  std::vector<double> curvatures;  // κ, ascending; > 0: g = 0 bends away from the medians
  int evaluations = 0;
};

// The Hessian in the plane across u* by differences over `step`, in one batch: 3 points for the slope along u*, and
// 2 (n - 1) + 2 (n - 1)(n - 2) in the plane. None at a kink, without an answer, or where a bracket is not positive. Of
// a reversed point, with the same -g, the probabilities are those to stand.
std::optional<SecondOrder> second_order(const LimitFunction& g, const DesignPoint& point, double step);

}  // namespace voussoir
