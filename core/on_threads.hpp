// The core's loops over bodies and contacts, on as many threads as the settings say. Who does what changes no result:
// every piece writes to its own place.
#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <vector>

namespace voussoir {

// a team of threads costs as much as some hundred bodies or contacts
inline constexpr int too_few_for_a_team = 1000;

inline int team(int threads, std::size_t pieces) {
  return pieces < too_few_for_a_team ? 1 : threads;
}

// work(i) for each i below `count`; of what it throws, one exception continues when all are done
template <class Work>
void on_threads(int threads, int count, const Work& work) {
  if (threads == 1 || count < 2) {
    for (int i = 0; i < count; ++i)
      work(i);
    return;
  }
  std::exception_ptr failure;
#pragma omp parallel for num_threads(threads) schedule(static)
  for (int i = 0; i < count; ++i) {
    try {
      work(i);
    } catch (...) {
#pragma omp critical
      if (!failure) failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
}

// the same for pieces as light as one body or one contact
template <class Work>
void each_on_threads(int threads, std::size_t count, const Work& work) {
  on_threads(team(threads, count), static_cast<int>(count), work);
}

// Sums over light pieces: work(i, sum) for those of each group, the groups' sums in their order. Groups are of a fixed
// size, so that no sum depends on the number of threads. What it gives holds until its next use.
template <class Sum, class Work>
const std::vector<Sum>& sums_in_groups(int threads, std::size_t count, const Work& work) {
  constexpr std::size_t together = 256;
  static thread_local std::vector<Sum> own;
  std::vector<Sum>& sums = own;  // this thread's, filled by all
  sums.resize((count + together - 1) / together);
  on_threads(team(threads, count), static_cast<int>(sums.size()), [&](int group) {
    Sum sum{};
    for (std::size_t i = group * together; i < std::min(count, (group + 1) * together); ++i)
      work(static_cast<int>(i), sum);
    sums[group] = sum;
  });
  return sums;
}

}  // namespace voussoir
