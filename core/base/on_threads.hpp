// The core's loops over bodies and contacts, on as many threads as the settings state. The assignment of work to
// threads changes no result: every piece writes to its own memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace voussoir {

// a team of threads costs as much as some hundred bodies or contacts
inline constexpr int too_few_for_a_team = 1000;

inline int team(int threads, std::size_t pieces) {
  return pieces < too_few_for_a_team ? 1 : threads;
}

// some pieces of work in a row: call(work, first, last) does those from first up to last
struct PieceWork {
  const void* work;
  void (*call)(const void* work, int first, int last);
};

// Does all pieces below `count`, this thread and up to `threads` - 1 others. An idle thread takes the next pieces: a
// thread delayed by another program delays no other, and the calling thread waits for none that has not begun. Threads
// wait asleep, after a moment in which the next loop may come. If the system provides no more threads, fewer do the
// work; within a piece, or while another thread has the team, the calling thread does it alone. The exception of the
// first piece that failed is rethrown when all are done.
void share_out(int threads, int count, const PieceWork& pieces);

// work(i) for each i below `count`
template <class Work>
void on_threads(int threads, int count, const Work& work) {
  if (threads == 1 || count < 2) {
    for (int i = 0; i < count; ++i)
      work(i);
    return;
  }
  share_out(threads, count, {&work, [](const void* of_all, int first, int last) {
                               for (int i = first; i < last; ++i)
                                 (*static_cast<const Work*>(of_all))(i);
                             }});
}

// the same for pieces as light as one body or one contact
template <class Work>
void each_on_threads(int threads, std::size_t count, const Work& work) {
  on_threads(team(threads, count), static_cast<int>(count), work);
}

// Pieces that are summed together: a fixed number, so that no sum depends on the number of threads.
inline constexpr std::size_t summed_together = 256;
constexpr std::size_t groups_of(std::size_t pieces) {
  return (pieces + summed_together - 1) / summed_together;
}

// Sums over light pieces: work(i, sum) for those of each group, the groups' sums in their order. The result is valid
// until the next call.
template <class Sum, class Work>
const std::vector<Sum>& sums_in_groups(int threads, std::size_t count, const Work& work) {
  static thread_local std::vector<Sum> own;
  std::vector<Sum>& sums = own;  // this thread's, filled by all
  sums.resize(groups_of(count));
  on_threads(team(threads, count), static_cast<int>(sums.size()), [&](int group) {
    Sum sum{};
    for (std::size_t i = group * summed_together; i < std::min(count, (group + 1) * summed_together); ++i)
      work(static_cast<int>(i), sum);
    sums[group] = sum;
  });
  return sums;
}

}  // namespace voussoir
