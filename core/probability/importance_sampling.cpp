#include "core/probability/importance_sampling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/joint_sets/portable_math.hpp"
#include "core/joint_sets/random_stream.hpp"
#include "core/probability/nearest_point.hpp"

namespace voussoir {
namespace {

constexpr int least_failed = 50;
constexpr double deviations_of_interval = 1.96;  // 95 %
constexpr double largest_exponent = 700;         // of portable::exp

// φ/h: the reciprocal of the mean of exp(u·c - |c|²/2) over the points c, the largest term taken out
double weight_of(const StandardPoint& u, const std::vector<DesignPoint>& points) {
  std::vector<double> exponents;
  for (const DesignPoint& point : points)
    exponents.push_back(dot(u, point.u) - dot(point.u, point.u) / 2);
  const double top = *std::ranges::max_element(exponents);
  double sum = 0;
  for (const double exponent : exponents)
    if (exponent - top > -largest_exponent) sum += portable::exp(exponent - top);
  return portable::exp(std::clamp(-top, -largest_exponent, largest_exponent)) * static_cast<double>(points.size()) /
         sum;
}

// of the rows of one point
struct Share {
  int rows = 0;
  double sum = 0, squares = 0;

  double mean() const { return sum / rows; }
  double variance_of_mean() const { return std::max(0.0, squares - sum * sum / rows) / (rows - 1.0) / rows; }
};

// The mean over the points of the means of their rows: free of bias although the last batch is not even.
void estimate(const std::vector<Share>& shares, SamplingEstimate& found) {
  double probability = 0, variance = 0;
  for (const Share& share : shares) {
    probability += share.mean();
    variance += share.variance_of_mean();
  }
  const double count = static_cast<double>(shares.size());
  found.probability = probability / count;
  found.error = std::sqrt(variance) / count;
  if (found.probability > 0) {
    const double width = std::min(deviations_of_interval * found.error / found.probability, largest_exponent);
    found.low = found.probability * portable::exp(-width);
    found.high = std::min(1.0, found.probability * portable::exp(width));
  }
}

}  // namespace

SamplingEstimate sample_by_importance(const LimitFunction& limit, const std::vector<DesignPoint>& points,
                                      const SamplingRequest& request) {
  SamplingEstimate found;
  std::vector<Share> shares(points.size());
  const int least_rows = 2 * static_cast<int>(points.size());  // for a variance of each share
  while (found.rows < request.most_rows && !found.reached) {
    const int rows =
        std::min(std::max(request.batch, found.rows == 0 ? least_rows : 1), request.most_rows - found.rows);
    std::vector<StandardPoint> batch;
    for (int k = found.rows; k < found.rows + rows; ++k) {
      RandomStream stream(request.seed, fmt::format("row {}", k));
      batch.push_back(points[static_cast<std::size_t>(k) % points.size()].u);
      for (double& part : batch.back())
        part += stream.normal();
    }
    const std::vector<StateAnswer> answers = limit(batch);
    for (std::size_t k = 0; k < batch.size(); ++k) {
      const bool answered = answers[k].g.has_value(), failed = answered && *answers[k].g <= 0;
      const double weight = weight_of(batch[k], points);
      Share& share = shares[static_cast<std::size_t>(found.rows) % points.size()];
      ++share.rows;
      if (failed) {
        share.sum += weight;
        share.squares += weight * weight;
      }
      ++found.rows;
      found.failed += failed;
      found.unanswered += !answered;
      found.history.push_back({std::move(batch[k]), weight, failed, answered});
    }
    if (found.rows < least_rows) break;
    estimate(shares, found);
    found.reached = found.failed >= least_failed && found.error <= request.target * found.probability;
  }
  return found;
}

}  // namespace voussoir
