// Rows that do not depend on each other, by all cores of this process.
#pragma once

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace voussoir {

// Calls `row` for 0 .. count - 1, each once, from several threads; returns when all are done. `row` must not throw.
template <class Row>
void each_row_in_parallel(int count, const Row& row, int rows_at_once = 1) {
  std::atomic<int> next = 0;
  const auto work = [&] {
    for (int begin = 0; (begin = next.fetch_add(rows_at_once)) < count;)
      for (int k = begin; k < std::min(count, begin + rows_at_once); ++k)
        row(k);
  };
  std::vector<std::jthread> threads;
  const int most = (count + rows_at_once - 1) / rows_at_once;
  for (int t = 1; t < std::min(most, static_cast<int>(std::thread::hardware_concurrency())); ++t)
    threads.emplace_back(work);
  work();
}

}  // namespace voussoir
