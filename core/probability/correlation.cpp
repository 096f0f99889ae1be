#include "core/probability/correlation.hpp"

#include <algorithm>
#include <cmath>

#include "core/joint_sets/portable_math.hpp"
#include "core/probability/normal.hpp"
#include "core/probability/quadrature.hpp"

namespace voussoir {
namespace {

constexpr double reach_of_normals = 8.5;  // φ is 1e-16 there
constexpr int nodes_of_normals = 16;
constexpr double widest_panel = 1.5;
constexpr double root_within = 1e-13;
constexpr int most_halvings = 100;

// of the correlation matrix; below, it counts as not positive definite
constexpr double least_pivot = 1e-10;

// the coefficient of variation, or 0 of a normal law; none: no closed form
std::optional<double> variation_of(const Distribution& d) {
  if (d.is_cut()) return std::nullopt;
  if (d.law == Law::normal) return 0;
  if (d.law == Law::lognormal) return d.deviation / d.mean;
  return std::nullopt;
}

double log_of_one_more(double x) {
  return log_of_one_less(-x);
}

// values of mean 0 and deviation 1
struct StandardisedLaw {
  Distribution law;
  TwoMoments moments;

  explicit StandardisedLaw(const Distribution& of) : law(of), moments(moments_of_cut(of)) {}
  double at(double z) const { return (value_at(law, z) - moments.mean) / moments.deviation; }

  // where the slope of `at` has a corner
  void add_corner(std::vector<double>& ends) const {
    if (law.law == Law::triangular && law.mode > law.least && law.mode < law.most)
      ends.push_back(standard_at(law, law.mode));
    if (law.law == Law::uniform) ends.push_back(0);  // the tail it is computed from
  }
};

// ∫ φ f over from..to, in panels that end at the corners
template <typename Function>
double normal_mean(double from, double to, std::vector<double> ends, const Function& f) {
  static const GaussLegendreRule rule = gauss_legendre(nodes_of_normals);
  std::erase_if(ends, [&](double z) { return z <= from || z >= to; });
  ends.insert(ends.end(), {from, to});
  std::ranges::sort(ends);
  double sum = 0;
  for (std::size_t k = 1; k < ends.size(); ++k) {
    const double width = ends[k] - ends[k - 1];
    if (width > 0)
      sum += integral(rule, ends[k - 1], ends[k], static_cast<int>(std::ceil(width / widest_panel)),
                      [&](double z) { return normal_density(z) * f(z); });
  }
  return sum;
}

// the correlation of the values of normals of correlation `sign` 1 or -1
double extreme_correlation(const StandardisedLaw& a, const StandardisedLaw& b, double sign) {
  std::vector<double> corners, of_b;
  a.add_corner(corners);
  b.add_corner(of_b);
  for (const double z : of_b)
    corners.push_back(sign * z);
  return normal_mean(-reach_of_normals, reach_of_normals, corners, [&](double z) { return a.at(z) * b.at(sign * z); });
}

// ∫∫ x_a(z_a) x_b(r z_a + √(1 - r²) w) φ(z_a) φ(w)
double correlation_of_values(const StandardisedLaw& a, const StandardisedLaw& b, double r) {
  const double root = std::sqrt((1 - r) * (1 + r));
  if (root == 0) return extreme_correlation(a, b, r);
  std::vector<double> corners, of_b;
  a.add_corner(corners);
  b.add_corner(of_b);
  if (r != 0)
    for (const double z : of_b)
      corners.push_back(z / r);
  return normal_mean(-reach_of_normals, reach_of_normals, corners, [&](double z) {
    std::vector<double> inner;
    for (const double corner : of_b)
      inner.push_back((corner - r * z) / root);
    return a.at(z) *
           normal_mean(-reach_of_normals, reach_of_normals, inner, [&](double w) { return b.at(r * z + root * w); });
  });
}

// the correlations of the normals among `chosen` keys
std::vector<std::vector<double>> matrix_of(const std::vector<std::size_t>& chosen,
                                           const std::vector<CorrelatedPair>& pairs) {
  const std::size_t n = chosen.size();
  std::vector<std::vector<double>> matrix(n, std::vector<double>(n, 0));
  const auto place = [&](std::size_t key) {
    return static_cast<std::size_t>(std::ranges::find(chosen, key) - chosen.begin());
  };
  for (std::size_t k = 0; k < n; ++k)
    matrix[k][k] = 1;
  for (const CorrelatedPair& pair : pairs)
    if (const std::size_t a = place(pair.a), b = place(pair.b); a < n && b < n)
      matrix[a][b] = matrix[b][a] = pair.of_normals;
  return matrix;
}

// in place; false: not positive definite
bool decompose(std::vector<std::vector<double>>& matrix) {
  for (std::size_t row = 0; row < matrix.size(); ++row) {
    for (std::size_t column = 0; column <= row; ++column) {
      double rest = matrix[row][column];
      for (std::size_t k = 0; k < column; ++k)
        rest -= matrix[row][k] * matrix[column][k];
      if (column < row)
        matrix[row][column] = rest / matrix[column][column];
      else if (rest > least_pivot)
        matrix[row][row] = std::sqrt(rest);
      else
        return false;
    }
    std::fill(matrix[row].begin() + static_cast<std::ptrdiff_t>(row) + 1, matrix[row].end(), 0);
  }
  return true;
}

bool contradict(const std::vector<std::size_t>& chosen, const std::vector<CorrelatedPair>& pairs) {
  auto matrix = matrix_of(chosen, pairs);
  return !decompose(matrix);
}

}  // namespace

CorrelationRange reachable_correlation(const Distribution& a, const Distribution& b) {
  const auto variation_a = variation_of(a), variation_b = variation_of(b);
  if (!variation_a || !variation_b) {
    const StandardisedLaw of_a(a), of_b(b);
    return {extreme_correlation(of_a, of_b, -1), extreme_correlation(of_a, of_b, 1)};
  }
  if (*variation_a == 0 && *variation_b == 0) return {-1, 1};
  const double square_a = *variation_a * *variation_a, square_b = *variation_b * *variation_b;
  if (*variation_a == 0 || *variation_b == 0) {
    const double most = std::sqrt(log_of_one_more(square_a + square_b) / (square_a + square_b));
    return {-most, most};
  }
  const double product = std::sqrt(log_of_one_more(square_a) * log_of_one_more(square_b));
  const double scale = *variation_a * *variation_b;
  return {-one_less_exp(product) / scale, -one_less_exp(-product) / scale};
}

double correlation_of_normals(const Distribution& a, const Distribution& b, double of_values) {
  const auto variation_a = variation_of(a), variation_b = variation_of(b);
  if (variation_a && variation_b) {
    const double square_a = *variation_a * *variation_a, square_b = *variation_b * *variation_b;
    if (square_a == 0 && square_b == 0) return of_values;
    const double rho = square_a == 0 || square_b == 0
                           ? of_values * std::sqrt((square_a + square_b) / log_of_one_more(square_a + square_b))
                           : log_of_one_more(of_values * *variation_a * *variation_b) /
                                 std::sqrt(log_of_one_more(square_a) * log_of_one_more(square_b));
    return std::clamp(rho, -1.0, 1.0);
  }
  if (of_values == 0) return 0;
  const StandardisedLaw of_a(a), of_b(b);
  // the correlation rises with that of the normals and has its sign: false position between 0 and 1 or -1, where the
  // end that stays is given half its weight (Illinois)
  double near = 0, far = of_values > 0 ? 1 : -1;
  double off_near = -of_values, off_far = extreme_correlation(of_a, of_b, far) - of_values;
  if (off_far * far <= 0) return far;
  for (int k = 0; k < most_halvings && std::abs(far - near) > root_within; ++k) {
    const double r = far - off_far * (far - near) / (off_far - off_near);
    const double off = correlation_of_values(of_a, of_b, r) - of_values;
    if (std::abs(off) <= root_within) return r;
    if ((off > 0) == (off_far > 0)) {
      off_near /= 2;
    } else {
      near = far;
      off_near = off_far;
    }
    far = r;
    off_far = off;
  }
  return far;
}

std::optional<std::vector<std::vector<double>>> cholesky_factor(std::size_t keys,
                                                                const std::vector<CorrelatedPair>& pairs) {
  std::vector<std::size_t> all(keys);
  for (std::size_t k = 0; k < keys; ++k)
    all[k] = k;
  auto matrix = matrix_of(all, pairs);
  if (!decompose(matrix)) return std::nullopt;
  return matrix;
}

std::vector<std::size_t> inconsistent_keys(std::size_t keys, const std::vector<CorrelatedPair>& pairs) {
  std::vector<std::size_t> chosen;
  for (std::size_t key = 0; key < keys; ++key)
    if (std::ranges::any_of(pairs, [&](const CorrelatedPair& pair) { return pair.a == key || pair.b == key; }))
      chosen.push_back(key);
  if (!contradict(chosen, pairs)) return {};
  // three keys are the usual circle: they are looked for first
  for (std::size_t a = 0; a < chosen.size(); ++a)
    for (std::size_t b = a + 1; b < chosen.size(); ++b) {
      if (const std::vector two{chosen[a], chosen[b]}; contradict(two, pairs)) return two;
    }
  for (std::size_t a = 0; a < chosen.size(); ++a)
    for (std::size_t b = a + 1; b < chosen.size(); ++b)
      for (std::size_t c = b + 1; c < chosen.size(); ++c)
        if (const std::vector three{chosen[a], chosen[b], chosen[c]}; contradict(three, pairs)) return three;
  for (std::size_t k = chosen.size(); k-- > 0;) {
    std::vector<std::size_t> fewer = chosen;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
    if (contradict(fewer, pairs)) chosen = fewer;
  }
  return chosen;
}

}  // namespace voussoir
