// SPDX-License-Identifier: MIT
#include "pvs/rank_window.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace hallway::pvs {
namespace {

TEST(RankWindow, HandsOutEachRankOnceWithWhatItUsesFinished) {
  constexpr std::size_t kCount = 2'000;
  constexpr std::size_t kWindow = 5;
  RankWindow window(kCount, kWindow);
  std::vector<int> result(kCount, 0);  // not atomic: the window alone orders writing and reading
  std::atomic<int> wrong = 0;
  const auto work = [&] {
    for (std::size_t rank = window.claim(); rank < kCount; rank = window.claim()) {
      for (std::size_t used = 0; used < window.usable(rank); ++used) wrong += result[used] != 1;
      ++result[rank];
      window.finish(rank);
    }
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(result, std::vector<int>(kCount, 1));
}

TEST(RankWindow, StopEndsTheWorkAlsoOfThoseThatWait) {
  RankWindow window(100, 1);
  EXPECT_EQ(window.claim(), 0u);
  EXPECT_EQ(window.claim(), 1u);  // uses no rank: one rank before its own may be under way
  std::thread waits([&] { EXPECT_EQ(window.claim(), 100u); });
  window.stop();
  waits.join();
  EXPECT_EQ(window.claim(), 100u);
}

}  // namespace
}  // namespace hallway::pvs
