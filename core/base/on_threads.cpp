#include "core/base/on_threads.hpp"

#include <atomic>
#include <deque>
#include <exception>
#include <limits>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <utility>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace voussoir {
namespace {

// Looks for work before a thread falls asleep, some 20 to 80 µs: longer than the work of a step between two of its
// loops, too short for another program to miss.
constexpr int looks = 2000;

// takes of pieces by each thread: few, since they share a counter; many enough that the last is soon done
constexpr int takes = 16;

void pause() {
#if defined(__x86_64__)
  _mm_pause();
#endif
}

template <class Condition>
void wait_a_moment(const Condition& condition) {
  for (int i = 0; i < looks && !condition(); ++i)
    pause();
}

// the pieces that one thread begins with; others take some of them when theirs are done
struct alignas(64) Part {
  std::atomic<int> next = 0;
  int last = 0;
};

class Team {
 public:
  // false: it is at work already
  bool share_out(int threads, int count, const PieceWork& pieces) {
    if (at_work_.test_and_set(std::memory_order_acquire)) return false;
    // no other thread is inside: the following is this thread's alone until the gate opens
    members_ = 1 + enlist(std::min(threads, count) - 1);
    pieces_ = pieces;
    grain_ = std::max(1, count / (takes * members_));
    for (int k = 0; k < members_; ++k) {
      parts_[k].next.store(static_cast<int>(static_cast<long long>(count) * k / members_), std::memory_order_relaxed);
      parts_[k].last = static_cast<int>(static_cast<long long>(count) * (k + 1) / members_);
    }
    failure_ = nullptr;
    first_failed_ = std::numeric_limits<int>::max();

    inside_.store(gate_open, std::memory_order_release);
    round_.fetch_add(1);
    round_.notify_all();
    work(0);
    // threads that have not come by now are not needed
    inside_.fetch_and(~gate_open);
    wait_a_moment([&] { return inside_.load(std::memory_order_acquire) == 0; });
    for (unsigned others; (others = inside_.load(std::memory_order_acquire)) != 0;)
      inside_.wait(others);
    const std::exception_ptr failure = std::exchange(failure_, nullptr);
    at_work_.clear(std::memory_order_release);
    if (failure) std::rethrow_exception(failure);
    return true;
  }

 private:
  static constexpr unsigned gate_open = 1u << 31;

  std::atomic_flag at_work_;
  std::atomic<unsigned> round_ = 0;
  std::atomic<unsigned> inside_ = 0;  // how many others are at work, and gate_open while they may come
  int enlisted_ = 0;                  // other threads that there are
  // of the work under way
  int members_ = 1, grain_ = 1;
  PieceWork pieces_{};
  std::deque<Part> parts_ = std::deque<Part>(1);
  std::mutex failing_;
  std::exception_ptr failure_;
  int first_failed_ = 0;

  // how many others there are to help, of so many wanted
  int enlist(int wanted) {
    try {
      for (; enlisted_ < wanted; ++enlisted_) {
        if (static_cast<int>(parts_.size()) <= enlisted_ + 1) parts_.emplace_back();
        std::thread([this, id = enlisted_ + 1] { serve(id); }).detach();
      }
    } catch (const std::system_error&) {  // the system has no more
    } catch (const std::bad_alloc&) {
    }
    return std::min(enlisted_, wanted);
  }

  void serve(int id) {
    unsigned seen = 0;
    while (true) {
      wait_a_moment([&] { return round_.load(std::memory_order_relaxed) != seen; });
      round_.wait(seen);
      seen = round_.load(std::memory_order_relaxed);
      unsigned others = inside_.load(std::memory_order_relaxed);
      while ((others & gate_open) != 0 && !inside_.compare_exchange_weak(others, others + 1)) {
      }
      if ((others & gate_open) == 0) continue;
      if (id < members_) work(id);
      if (inside_.fetch_sub(1) == 1) inside_.notify_one();
    }
  }

  void work(int id) {
    for (int k = 0; k < members_; ++k) {
      Part& part = parts_[(id + k) % members_];
      for (int first; (first = part.next.fetch_add(grain_, std::memory_order_relaxed)) < part.last;)
        try {
          pieces_.call(pieces_.work, first, std::min(first + grain_, part.last));
        } catch (...) {
          const std::lock_guard lock(failing_);
          if (first < first_failed_) {
            first_failed_ = first;
            failure_ = std::current_exception();
          }
        }
    }
  }
};

}  // namespace

void share_out(int threads, int count, const PieceWork& pieces) {
  static Team& the_team = *new Team;  // its threads outlive every static
  if (!the_team.share_out(threads, count, pieces)) pieces.call(pieces.work, 0, count);
}

}  // namespace voussoir
