// What a sample of results tells of what it was drawn from.
#pragma once

#include <optional>
#include <vector>

namespace voussoir {

struct Share {
  int of = 0, count = 0;     // count of `of`
  double low = 0, high = 1;  // of the share that they were drawn with
};

inline constexpr double sample_confidence = 0.95;

// The interval of Clopper & Pearson (1934): at least `confidence` of such intervals hold the true share, whatever it
// is. 0 <= count <= of, of > 0.
Share share_with_interval(int count, int of, double confidence = sample_confidence);

// The same where some of those that were not counted may belong to them: an interval that holds the share of at least
// `confidence`, whichever do.
Share share_with_undecided(int count, int undecided, int of, double confidence = sample_confidence);

struct Bin {
  double from = 0, to = 0;
  int count = 0;
};
// bins of equal width over all results, about the root of their number of them, at most 40
std::vector<Bin> histogram_of(const std::vector<double>& results);

}  // namespace voussoir
