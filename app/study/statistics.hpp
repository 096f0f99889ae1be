// Statistics of a sample of results.
#pragma once

#include <optional>
#include <vector>

namespace voussoir {

struct Share {
  int of = 0, count = 0;     // count of `of`
  double low = 0, high = 1;  // confidence interval of the underlying share
};

inline constexpr double sample_confidence = 0.95;

// The interval of Clopper & Pearson (1934): at least the fraction `confidence` of such intervals contains the true
// share. 0 <= count <= of, of > 0.
Share share_with_interval(int count, int of, double confidence = sample_confidence);

// The same if some of the others may belong to those counted: an interval that contains the share with at least
// `confidence`, whichever of them do.
Share share_with_undecided(int count, int undecided, int of, double confidence = sample_confidence);

struct Bin {
  double from = 0, to = 0;
  int count = 0;
};
// bins of equal width over all results; their number is about the root of the number of results, at most 40
std::vector<Bin> histogram_of(const std::vector<double>& results);

}  // namespace voussoir
