#include "app/study/statistics.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>

namespace voussoir {

Share share_with_interval(int count, int of, double confidence) {
  using Binomial = boost::math::binomial_distribution<>;
  const double tail = (1 - confidence) / 2;
  return {of, count, Binomial::find_lower_bound_on_p(of, count, tail),
          Binomial::find_upper_bound_on_p(of, count, tail)};
}

Share share_with_undecided(int count, int undecided, int of, double confidence) {
  return {of, count, share_with_interval(count, of, confidence).low,
          share_with_interval(count + undecided, of, confidence).high};
}

std::vector<Bin> histogram_of(const std::vector<double>& results) {
  if (results.empty()) return {};
  const auto [least, most] = std::minmax_element(results.begin(), results.end());
  const auto count = std::min<std::size_t>(40, static_cast<std::size_t>(std::ceil(std::sqrt(results.size()))));
  const double width = (*most - *least) / static_cast<double>(count);
  if (!(width > 0)) return {{*least, *most, static_cast<int>(results.size())}};
  std::vector<Bin> bins;
  for (std::size_t k = 0; k < count; ++k)
    bins.push_back({*least + width * static_cast<double>(k), *least + width * static_cast<double>(k + 1), 0});
  for (const double result : results)
    ++bins[std::min(count - 1, static_cast<std::size_t>((result - *least) / width))].count;
  return bins;
}

}  // namespace voussoir
