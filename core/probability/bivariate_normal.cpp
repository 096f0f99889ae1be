// Φ₂ as ∫ φ(x) Φ((b - ρ x)/√(1 - ρ²)) dx up to a: the integrand is positive, so that small probabilities keep their
// digits, and its logarithm is concave with a second derivative of at most -1, so that its width is known.
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/joint_sets/portable_math.hpp"
#include "core/probability/normal.hpp"
#include "core/probability/quadrature.hpp"

namespace voussoir {
namespace {

constexpr double widest = 9.5;     // beyond it the integrand is below exp(-widest²/2) of its largest value
constexpr double negligible = 45;  // in the logarithm
constexpr int bisections = 60, panels_of_part = 6, nodes_of_panel = 16;
constexpr double transition = 8;  // half the width over which Φ rises from 0 to 1

struct BivariateIntegrand {
  double b, correlation, root;  // √(1 - ρ²)

  double inner(double x) const { return (b - correlation * x) / root; }
  double value(double x) const { return normal_density(x) * normal_probability(inner(x)); }
  double log_value(double x) const { return -x * x / 2 + log_normal_probability(inner(x)); }  // but for a constant
  // of the logarithm
  double slope(double x) const {
    const double t = inner(x);
    const double hazard = t > -30 ? normal_density(t) / normal_probability(t) : -t - 1 / t;
    return -x - correlation / root * hazard;
  }
};

// where a condition that holds at `yes` and not at `no` ends
template <typename Condition>
double boundary(double yes, double no, const Condition& holds) {
  for (int k = 0; k < bisections; ++k) {
    const double middle = (yes + no) / 2;
    (holds(middle) ? yes : no) = middle;
  }
  return (yes + no) / 2;
}

}  // namespace

double bivariate_normal_probability(double a, double b, double correlation) {
  const double square = (1 - correlation) * (1 + correlation);
  if (square <= 0) {
    if (correlation > 0) return normal_probability(std::min(a, b));
    if (a + b <= 0) return 0;
    return a > 0 ? normal_probability(b) - normal_probability(-a) : normal_probability(a) - normal_probability(-b);
  }
  const BivariateIntegrand integrand{b, correlation, std::sqrt(square)};
  const double far = widest + std::abs(a) + std::abs(b);
  double peak = a;
  if (integrand.slope(a) < 0) peak = boundary(-far, a, [&](double x) { return integrand.slope(x) >= 0; });
  const double least = integrand.log_value(peak) - negligible;
  const auto counts = [&](double x) { return integrand.log_value(x) >= least; };
  const double from = counts(peak - widest) ? peak - widest : boundary(peak, peak - widest, counts);
  double to = std::min(a, peak + widest);
  if (!counts(to)) to = boundary(peak, to, counts);

  std::vector<double> ends{from, peak, to};
  if (correlation != 0)
    for (const double side : {-transition, 0.0, transition}) {
      const double x = (b + side * integrand.root) / correlation;
      if (x > from && x < to) ends.push_back(x);
    }
  std::ranges::sort(ends);
  static const GaussLegendreRule rule = gauss_legendre(nodes_of_panel);
  double sum = 0;
  for (std::size_t k = 1; k < ends.size(); ++k)
    if (ends[k] > ends[k - 1])
      sum += integral(rule, ends[k - 1], ends[k], panels_of_part, [&](double x) { return integrand.value(x); });
  return std::min(sum, 1.0);
}

}  // namespace voussoir
