#include "core/testing/limit_states.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace voussoir::limit_states {
namespace {

using Direction = std::array<double, 3>;
constexpr double degree = std::numbers::pi / 180;

Distribution normal_law(double mean, double deviation) {
  return {Law::normal, mean, deviation};
}

double dot(const Direction& a, const Direction& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Direction cross(const Direction& a, const Direction& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Direction pole(double dip, double direction) {
  const double d = dip * degree, b = direction * degree;
  return {std::sin(d) * std::sin(b), std::sin(d) * std::cos(b), std::cos(d)};
}

// weight 1; on both planes along their line, or on one where the other's normal force would pull
StateAnswer wedge_answer(const Direction& a, const Direction& b, double friction_a, double friction_b) {
  Direction line = cross(a, b);
  const double length = std::sqrt(dot(line, line)), c = dot(a, b), square = 1 - c * c;
  const double on_a = (a[2] - c * b[2]) / square, on_b = (b[2] - c * a[2]) / square;
  const double tan_a = std::tan(friction_a * degree), tan_b = std::tan(friction_b * degree);
  if (on_a >= 0 && on_b >= 0) return {(on_a * tan_a + on_b * tan_b) / std::abs(line[2] / length) - 1, "both"};
  const Direction& plane = on_b < 0 ? a : b;
  const double across = std::sqrt(std::max(0.0, 1 - plane[2] * plane[2]));
  return {plane[2] * (on_b < 0 ? tan_a : tan_b) / across - 1, on_b < 0 ? "A" : "B"};
}

// density ∝ exp(K cos θ): 1 - cos θ = -log(e^-q (1 - e^-2K) + e^-2K)/K, q = |u|²/2; the first normal points along
// z × mean pole, the second along mean pole × that
Direction scattered(const Direction& mean, double constant, double u, double v) {
  const double q = (u * u + v * v) / 2, end = std::exp(-2 * constant);
  const double lower = -std::log(std::exp(-q) * (1 - end) + end) / constant;
  const double theta = 2 * std::asin(std::sqrt(std::clamp(lower / 2, 0.0, 1.0)));
  const double horizontal = std::hypot(mean[0], mean[1]), radius = std::hypot(u, v);
  const Direction east{-mean[1] / horizontal, mean[0] / horizontal, 0}, up = cross(mean, east);
  Direction found = mean;
  if (radius > 0)
    for (std::size_t k = 0; k < 3; ++k)
      found[k] = std::cos(theta) * mean[k] + std::sin(theta) * (u * east[k] + v * up[k]) / radius;
  if (found[2] < 0)
    for (double& part : found)
      part = -part;
  return found;
}

}  // namespace

Values Problem::values_at(const StandardPoint& u) const {
  std::vector<CorrelatedPair> normals = pairs;
  for (CorrelatedPair& pair : normals)
    pair.of_normals = correlation_of_normals(laws[pair.a], laws[pair.b], pair.of_values);
  const auto factor = cholesky_factor(keys(), normals).value();
  Values x;
  for (std::size_t row = 0; row < keys(); ++row) {
    double z = 0;
    for (std::size_t k = 0; k <= row; ++k)
      z += factor[row][k] * u[k];
    x.push_back(value_at(laws[row], z));
  }
  return x;
}

LimitFunction Problem::function() const {
  std::vector<CorrelatedPair> normals = pairs;
  for (CorrelatedPair& pair : normals)
    pair.of_normals = correlation_of_normals(laws[pair.a], laws[pair.b], pair.of_values);
  const auto factor = cholesky_factor(keys(), normals).value();
  return [problem = *this, factor](const std::vector<StandardPoint>& points) {
    std::vector<StateAnswer> answers;
    for (const StandardPoint& u : points) {
      Values x;
      for (std::size_t row = 0; row < u.size(); ++row) {
        double z = 0;
        for (std::size_t k = 0; k <= row; ++k)
          z += factor[row][k] * u[k];
        x.push_back(value_at(problem.laws[row], z));
      }
      answers.push_back(problem.answer(x));
      ++*problem.evaluations;
    }
    return answers;
  };
}

Problem wedge(const Values& means, const Values& deviations, std::vector<CorrelatedPair> pairs) {
  Problem problem;
  for (std::size_t k = 0; k < means.size(); ++k)
    problem.laws.push_back(normal_law(means[k], deviations[k]));
  problem.pairs = std::move(pairs);
  problem.answer = [](const Values& x) { return wedge_answer(pole(x[0], x[1]), pole(x[2], x[3]), x[4], x[5]); };
  return problem;
}

Problem wedge_1() {
  return wedge({40, 130, 60, 220, 45, 45}, {2, 3, 2, 3, 2.5, 2.5});
}

Problem wedge_2() {
  return wedge({40, 130, 60, 220, 45, 45}, {2, 3, 2, 3, 2.5, 2.5}, {{4, 5, 0.7}});
}

Problem wedge_3() {
  return wedge({45, 105, 70, 235, 35, 30}, {3, 5, 3, 5, 3, 3});
}

Problem wedge_4() {
  return wedge({50, 160, 65, 220, 60, 60}, {2, 4, 2, 4, 2, 2});
}

Problem fisher_wedge(const Values& dips, const Values& constants, double friction, double deviation) {
  Problem problem;
  problem.laws.assign(5, normal_law(0, 1));
  const Direction a = pole(dips[0], dips[1]), b = pole(dips[2], dips[3]);
  problem.answer = [=](const Values& x) {
    const double drawn = friction + deviation * x[4];
    return wedge_answer(scattered(a, constants[0], x[0], x[1]), scattered(b, constants[1], x[2], x[3]), drawn, drawn);
  };
  return problem;
}

Problem sau_mau_ping(bool correlated) {
  Problem problem;
  const auto cut_exponential = [](double mean, double most) {
    return Distribution{Law::exponential, mean, 0, 0, 0, most};
  };
  problem.laws = {normal_law(10, 2), normal_law(35, 5), normal_law(14, 3), cut_exponential(0.5, 1),
                  cut_exponential(0.08, 0.16)};
  if (correlated) problem.pairs = {{0, 1, -0.5}, {2, 3, -0.5}};
  problem.answer = [](const Values& x) {
    constexpr double height = 60, face = 50 * degree, plane = 35 * degree, density = 2.6;  // m, t/m³; water 1 t/m³
    const double area = (height - x[2]) / std::sin(plane), water = x[3] * x[2], shake = x[4];
    const double part = x[2] / height;
    const double weight = density / 2 * height * height * ((1 - part * part) / std::tan(plane) - 1 / std::tan(face));
    const double uplift = water * area / 2, push = water * water / 2;
    const double normal = weight * (std::cos(plane) - shake * std::sin(plane)) - uplift - push * std::sin(plane);
    const double driving = weight * (std::sin(plane) + shake * std::cos(plane)) + push * std::cos(plane);
    return StateAnswer{(x[0] * area + normal * std::tan(x[1] * degree)) / driving - 1, ""};
  };
  return problem;
}

Problem slab(double driving, double effective_normal, double cohesion, double cohesion_deviation, double friction,
             double friction_deviation, int idle_keys) {
  Problem problem;
  problem.laws = {{Law::lognormal, cohesion, cohesion_deviation}, normal_law(friction, friction_deviation)};
  problem.laws.resize(static_cast<std::size_t>(2 + idle_keys), normal_law(0, 1));
  problem.answer = [=](const Values& x) {
    constexpr double length = 10.612605630259;  // m
    return StateAnswer{(x[0] * length + effective_normal * std::tan(x[1] * degree)) / driving - 1, ""};
  };
  return problem;
}

Problem dry_slab(double cohesion, double cohesion_deviation, double friction, double friction_deviation,
                 int idle_keys) {
  // 12 m high, face 65°, joint 32° to the crack 9 m behind the toe, 2600 kg/m³
  const double run = 9, height = 12, crest = height / std::tan(65 * degree), dip = 32 * degree;
  const double weight = 2600 * 9.81 * (crest * height / 2 + (run - crest) * height - run * run * std::tan(dip) / 2);
  return slab(weight * std::sin(dip), weight * std::cos(dip), cohesion, cohesion_deviation, friction,
              friction_deviation, idle_keys);
}

Problem gravity_block(double water, double water_deviation, double friction, double friction_deviation) {
  Problem problem;
  problem.laws = {normal_law(water, water_deviation), normal_law(friction, friction_deviation)};
  problem.answer = [](const Values& x) {
    constexpr double width = 4, height = 10, weight = 24000 * width * height, water_weight = 9810;  // m, N
    const double depth = std::max(x[0], 1e-3);
    const double slides =
        (weight - water_weight / 2 * depth * width) * std::tan(x[1] * degree) / (water_weight / 2 * depth * depth) - 1;
    const double tips = weight * width / 2 / (water_weight * depth * (depth * depth / 6 + width * width / 3)) - 1;
    return slides < tips ? StateAnswer{slides, "slides"} : StateAnswer{tips, "tips"};
  };
  return problem;
}

}  // namespace voussoir::limit_states
