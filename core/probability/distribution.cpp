#include "core/probability/distribution.hpp"

#include <algorithm>
#include <cmath>

#include "core/joint_sets/portable_math.hpp"
#include "core/probability/normal.hpp"
#include "core/probability/quadrature.hpp"

namespace voussoir {
namespace {

// the range of the seed of a joint set
constexpr double seeds = 1e15;

// of draws until a value is between the two ends; a distribution that needs more hardly ever gives such a value
constexpr int most_draws = 10'000;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double farthest = 38;  // Φ(-38) is about the least double

// of a mean's integral over z, where φ is below 1e-18
constexpr double reach_of_mean = 9;
constexpr int panels_of_mean = 36, nodes_of_mean = 12;

// the normal law of which the lognormal's values are the exponentials
struct LogarithmLaw {
  double mean, deviation;
};

LogarithmLaw logarithm_of(const Distribution& d) {
  const double ratio = d.deviation / d.mean, variance = portable::log(1 + ratio * ratio);
  return {portable::log(d.mean) - variance / 2, std::sqrt(variance)};
}

double bounded_exp(double x) {
  return portable::exp(std::clamp(x, -700.0, 700.0));
}

// z of a probability p, q = 1 - p, from the smaller of them
double standard_of(double p, double q) {
  if (p <= 0) return -farthest;
  if (q <= 0) return farthest;
  return p < q ? normal_quantile(p) : -normal_quantile(q);
}

// z of x in the law before it is cut, normal or lognormal
double uncut_standard(const Distribution& d, double x) {
  if (std::isinf(x)) return x;
  if (d.law == Law::normal) return (x - d.mean) / d.deviation;
  const LogarithmLaw logarithm = logarithm_of(d);
  return x > 0 ? (portable::log(x) - logarithm.mean) / logarithm.deviation : -infinity;
}

double uncut_value(const Distribution& d, double z) {
  if (d.law == Law::normal) return d.mean + d.deviation * z;
  const LogarithmLaw logarithm = logarithm_of(d);
  return bounded_exp(logarithm.mean + logarithm.deviation * z);
}

// the standard normals between two others that carry the share p of them, q = 1 - p
double between_standards(double least, double most, double p, double q) {
  const double below = normal_probability(least) * q + normal_probability(most) * p;
  const double above = normal_probability(-least) * q + normal_probability(-most) * p;
  return std::clamp(standard_of(below, above), least, most);
}

// P(least < Z < most) from the nearer tail
double mass_between(double least, double most) {
  return least > 0 ? normal_probability(-least) - normal_probability(-most)
                   : normal_probability(most) - normal_probability(least);
}

// it begins at the lower end anew, with the same mean
double exponential_begin(const Distribution& d) {
  return std::max(d.least, 0.0);
}

double exponential_width(const Distribution& d) {
  return std::min((d.most - exponential_begin(d)) / d.mean, 700.0);
}

double exponential_value(const Distribution& d, double p, double q) {
  const double below = p * one_less_exp(exponential_width(d));
  const double gap =
      below < 0.5 ? -log_of_one_less(below) : -portable::log(q + p * portable::exp(-exponential_width(d)));
  return std::min(exponential_begin(d) + d.mean * gap, d.most);
}

double draw_uncut(const Distribution& d, RandomStream& stream) {
  switch (d.law) {
    case Law::normal:
      return d.mean + d.deviation * stream.normal();
    case Law::lognormal: {
      const LogarithmLaw logarithm = logarithm_of(d);
      return portable::exp(logarithm.mean + logarithm.deviation * stream.normal());
    }
    case Law::uniform:
      return d.least + (d.most - d.least) * stream.uniform();
    case Law::triangular: {
      const double u = stream.uniform(), width = d.most - d.least, left = d.mode - d.least;
      if (u * width < left) return d.least + std::sqrt(u * width * left);
      return d.most - std::sqrt((1 - u) * width * (d.most - d.mode));
    }
    case Law::exponential:
      return d.mean * stream.exponential();
    case Law::seed:
      return std::floor(seeds * stream.uniform());
  }
  return 0;
}

TwoMoments moments_by_quadrature(const Distribution& d) {
  const double reach = d.law == Law::lognormal ? reach_of_mean + 2 * logarithm_of(d).deviation : reach_of_mean;
  const GaussLegendreRule rule = gauss_legendre(nodes_of_mean);
  const auto mean_of = [&](const auto& f) {
    return integral(rule, -reach_of_mean, reach, panels_of_mean,
                    [&](double z) { return normal_density(z) * f(value_at(d, z)); });
  };
  const double mean = mean_of([](double x) { return x; });
  const double variance = mean_of([&](double x) { return (x - mean) * (x - mean); });
  return {mean, std::sqrt(variance)};
}

}  // namespace

bool Distribution::is_cut() const {
  switch (law) {
    case Law::normal:
      return least > -infinity || most < infinity;
    case Law::lognormal:
    case Law::exponential:
      return least > 0 || most < infinity;
    default:
      return false;
  }
}

double value_at(const Distribution& d, double z) {
  switch (d.law) {
    case Law::normal:
    case Law::lognormal: {
      if (!d.is_cut() || !(d.deviation > 0)) return uncut_value(d, z);
      const double among = between_standards(uncut_standard(d, d.least), uncut_standard(d, d.most),
                                             normal_probability(z), normal_probability(-z));
      return std::clamp(uncut_value(d, among), d.least, d.most);
    }
    case Law::uniform: {
      const double width = d.most - d.least;
      return z < 0 ? d.least + width * normal_probability(z) : d.most - width * normal_probability(-z);
    }
    case Law::triangular: {
      const double p = normal_probability(z), width = d.most - d.least, left = d.mode - d.least;
      if (p * width < left) return d.least + std::sqrt(p * width * left);
      return d.most - std::sqrt(normal_probability(-z) * width * (d.most - d.mode));
    }
    case Law::exponential:
      // beyond the least double the logarithm goes on
      if (!d.is_cut() && z > 0) return -d.mean * log_normal_probability(-z);
      return exponential_value(d, normal_probability(z), normal_probability(-z));
    case Law::seed:
      return std::min(std::floor(seeds * normal_probability(z)), seeds - 1);
  }
  return 0;
}

double standard_at(const Distribution& d, double x) {
  const double width = d.most - d.least;
  switch (d.law) {
    case Law::normal:
    case Law::lognormal: {
      const double z = uncut_standard(d, x);
      if (!d.is_cut()) return z;
      const double least = uncut_standard(d, d.least), most = uncut_standard(d, d.most);
      const double mass = mass_between(least, most);
      return standard_of(mass_between(least, z) / mass, mass_between(z, most) / mass);
    }
    case Law::uniform:
      return standard_of((x - d.least) / width, (d.most - x) / width);
    case Law::triangular: {
      const double left = x - d.least, right = d.most - x;
      if (x < d.mode) {
        const double p = left / width * (left / (d.mode - d.least));
        return standard_of(p, 1 - p);
      }
      const double q = d.most > d.mode ? right / width * (right / (d.most - d.mode)) : 0;
      return standard_of(1 - q, q);
    }
    case Law::exponential: {
      const double gap = (x - exponential_begin(d)) / d.mean, end = exponential_width(d);
      const double mass = one_less_exp(end);
      return standard_of(one_less_exp(gap) / mass, portable::exp(-gap) * one_less_exp(end - gap) / mass);
    }
    case Law::seed:
      return standard_of((x + 0.5) / seeds, (seeds - x - 0.5) / seeds);
  }
  return 0;
}

std::optional<double> draw(const Distribution& d, RandomStream& stream) {
  for (int k = 0; k < most_draws; ++k)
    if (const double value = draw_uncut(d, stream); value >= d.least && value <= d.most) return value;
  return std::nullopt;
}

TwoMoments moments_of_cut(const Distribution& d) {
  if (d.is_cut() && d.deviation > 0) return moments_by_quadrature(d);
  if (d.is_cut() && d.law == Law::exponential) return moments_by_quadrature(d);
  const double a = d.least, b = d.most, c = d.mode;
  switch (d.law) {
    case Law::normal:
    case Law::lognormal:
      return {d.mean, d.deviation};
    case Law::uniform:
      return {(a + b) / 2, (b - a) / std::sqrt(12.0)};
    case Law::triangular:
      return {(a + b + c) / 3, std::sqrt(((b - a) * (b - a) + (b - c) * (b - c) + (c - a) * (c - a)) / 36)};
    case Law::exponential:
      return {d.mean, d.mean};
    case Law::seed:
      return {(seeds - 1) / 2, seeds / std::sqrt(12.0)};
  }
  return {};
}

}  // namespace voussoir
