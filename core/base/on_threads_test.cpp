// Work shared out among threads: every piece once, with any exceptions and from any caller.
#include "core/base/on_threads.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>

namespace voussoir::on_threads_test {
namespace {

TEST(OnThreads, EveryPieceIsDoneOnce) {
  for (const int threads : {1, 2, 3, 8})
    for (const int count : {0, 1, 2, 7, 64, 100'000}) {
      std::vector<std::atomic<int>> done(count);
      on_threads(threads, count, [&](int i) { ++done[i]; });
      for (int i = 0; i < count; ++i)
        ASSERT_EQ(done[i], 1) << i << " of " << count << " on " << threads;
    }
}

// a finished piece is visible in the next round, round after round
TEST(OnThreads, RoundFollowsRound) {
  std::vector<int> numbers(64, 0);
  for (int round = 0; round < 20'000; ++round)
    on_threads(4, 64, [&](int i) { ++numbers[i]; });
  for (const int n : numbers)
    EXPECT_EQ(n, 20'000);
}

TEST(OnThreads, TheFirstFailureIsRethrownAndTheTeamStaysUsable) {
  for (int round = 0; round < 100; ++round) {
    std::string what;
    try {
      on_threads(3, 96, [](int i) {
        if (i % 32 == 7) throw std::runtime_error(std::to_string(i));
      });
    } catch (const std::runtime_error& e) {
      what = e.what();
    }
    ASSERT_EQ(what, "7");
  }
}

// within a piece, and from several threads at once
TEST(OnThreads, AThreadThatFindsTheTeamBusyWorksAlone) {
  std::atomic<int> done = 0;
  const auto nested = [&] { on_threads(2, 16, [&](int) { on_threads(2, 16, [&](int) { ++done; }); }); };
  std::thread other(nested);
  nested();
  other.join();
  EXPECT_EQ(done, 2 * 16 * 16);
}

}  // namespace
}  // namespace voussoir::on_threads_test
