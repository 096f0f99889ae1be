// Integrals by Gauss' rule, and the logarithm and exponential near 1, in portable arithmetic.
#pragma once

#include <vector>

namespace voussoir {

// log(1 - x), x < 1, and 1 - exp(-x), |x| <= 700, with all digits near x = 0
double log_of_one_less(double x);
double one_less_exp(double x);

// of `points` nodes on -1..1
struct GaussLegendreRule {
  std::vector<double> nodes, weights;
};
GaussLegendreRule gauss_legendre(int points);

// ∫ f over from..to in equal panels
template <typename Function>
double integral(const GaussLegendreRule& rule, double from, double to, int panels, const Function& f) {
  const double half = (to - from) / (2 * panels);
  double sum = 0;
  for (int panel = 0; panel < panels; ++panel) {
    const double middle = from + (2 * panel + 1) * half;
    for (std::size_t k = 0; k < rule.nodes.size(); ++k)
      sum += half * rule.weights[k] * f(middle + half * rule.nodes[k]);
  }
  return sum;
}

}  // namespace voussoir
