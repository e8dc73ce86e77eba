// SPDX-License-Identifier: MIT
#include "base/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/random.hpp"

namespace hallway {
namespace {

using Chunks = std::set<std::pair<std::size_t, std::size_t>>;

Chunks chunks_of(std::size_t count, std::size_t grain, unsigned threads) {
  Chunks chunks;
  std::mutex mutex;
  parallel_for(count, grain, threads, [&](std::size_t begin, std::size_t end) {
    const std::lock_guard lock(mutex);
    chunks.emplace(begin, end);
  });
  return chunks;
}

/// What each item becomes, with chunk limits mixed in so that other chunks would show.
std::vector<double> work_result(unsigned threads) {
  std::vector<double> values(10'007);
  const Random random(5, 1);
  parallel_for(values.size(), 64, threads, [&](std::size_t begin, std::size_t end) {
    double sum = static_cast<double>(begin) / static_cast<double>(end);
    for (std::size_t i = begin; i < end; ++i) values[i] = sum += random.uniform(0, i);
  });
  return values;
}

/// Runs work of which the chunks beginning at 30 and 70 of 100 fail; gives the message that arrives. Where there are
/// threads to do so, the chunk that begins at `late` fails after the other one.
std::string first_failure(unsigned threads, std::size_t late) {
  std::atomic<bool> other_fails{false};
  try {
    parallel_for(100, 10, threads, [&](std::size_t begin, std::size_t) {
      if (begin != 30 && begin != 70) return;
      if (begin == late) {
        for (int i = 0; i < 100'000 && threads > 1 && !other_fails; ++i) std::this_thread::yield();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
      other_fails = true;
      throw std::runtime_error("chunk " + std::to_string(begin));
    });
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "nothing";
}

TEST(ParallelFor, CoversEveryItemOnce) {
  for (const std::size_t count : {1u, 2u, 63u, 64u, 65u, 1000u}) {
    for (const unsigned threads : {1u, 2u, 8u}) {
      std::vector<std::atomic<int>> visits(count);
      parallel_for(count, 64, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      });
      for (const auto& visit : visits) EXPECT_EQ(visit, 1);
    }
  }
}

TEST(ParallelFor, ChunksDependOnCountAndGrainAlone) {
  const Chunks expected{{0, 4}, {4, 8}, {8, 10}};
  for (unsigned threads = 1; threads <= 8; ++threads) EXPECT_EQ(chunks_of(10, 4, threads), expected);
}

TEST(ParallelFor, GivesTheSameBytesOnAnyNumberOfThreads) {
  const std::vector<double> alone = work_result(1);
  for (unsigned threads = 2; threads <= 8; ++threads) EXPECT_EQ(work_result(threads), alone) << threads;
}

TEST(ParallelFor, DoesNothingForNoItems) {
  EXPECT_TRUE(chunks_of(0, 4, 8).empty());
}

TEST(ParallelFor, TakesAGrainOfZeroAsOne) {
  EXPECT_EQ(chunks_of(3, 0, 2), (Chunks{{0, 1}, {1, 2}, {2, 3}}));
}

TEST(ParallelFor, TakesNoThreadsAsOne) {
  EXPECT_EQ(chunks_of(3, 2, 0), (Chunks{{0, 2}, {2, 3}}));
}

TEST(ParallelFor, TakesAGrainBeyondTheCount) {
  EXPECT_EQ(chunks_of(3, SIZE_MAX, 4), (Chunks{{0, 3}}));
}

TEST(ParallelFor, ThrowsTheFirstFailureInOrder) {
  for (const unsigned threads : {1u, 2u, 4u, 8u}) {
    EXPECT_EQ(first_failure(threads, 30), "chunk 30") << threads;
    EXPECT_EQ(first_failure(threads, 70), "chunk 30") << threads;
  }
}

TEST(ParallelFor, FinishesTheOtherChunksWhenOneFails) {
  for (const unsigned threads : {1u, 4u}) {
    std::atomic<int> done{0};
    EXPECT_THROW(parallel_for(100, 1, threads,
                              [&](std::size_t begin, std::size_t) {
                                if (begin == 5) throw std::runtime_error("5");
                                ++done;
                              }),
                 std::runtime_error);
    EXPECT_EQ(done, 99);
  }
}

TEST(ParallelFor, WorksAgainAfterAFailure) {
  EXPECT_THROW(parallel_for(10, 1, 4, [](std::size_t, std::size_t) { throw 1; }), int);
  EXPECT_EQ(chunks_of(10, 4, 4).size(), 3u);
}

TEST(ParallelFor, MayBeCalledInsideItself) {
  std::vector<std::vector<int>> table(20, std::vector<int>(50));
  parallel_for(table.size(), 1, 4, [&](std::size_t row, std::size_t) {
    parallel_for(table[row].size(), 7, 4, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) table[row][i] = static_cast<int>(row * 100 + i);
    });
  });
  for (std::size_t row = 0; row < table.size(); ++row) {
    for (std::size_t i = 0; i < table[row].size(); ++i)
      EXPECT_EQ(table[row][i], static_cast<int>(row * 100 + i));
  }
}

TEST(ParallelFor, CarriesAFailureOutOfANestedCall) {
  EXPECT_THROW(parallel_for(4, 1, 4,
                            [](std::size_t, std::size_t) {
                              parallel_for(4, 1, 4,
                                           [](std::size_t, std::size_t) { throw std::runtime_error("in"); });
                            }),
               std::runtime_error);
}

TEST(ParallelFor, MayBeCalledFromSeveralThreadsAtOnce) {
  std::vector<std::vector<int>> results(4, std::vector<int>(1000));
  std::vector<std::thread> callers;
  for (std::vector<int>& result : results) {
    callers.emplace_back([&result] {
      parallel_for(result.size(), 10, 3, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) result[i] = static_cast<int>(i);
      });
    });
  }
  for (std::thread& caller : callers) caller.join();
  for (const std::vector<int>& result : results) {
    for (std::size_t i = 0; i < result.size(); ++i) ASSERT_EQ(result[i], static_cast<int>(i));
  }
}

TEST(ParallelFor, RunsChunksOfOneCallAtTheSameTime) {
  // Each of two chunks waits for the other one: it ends only if both run at once.
  std::atomic<int> arrived{0};
  parallel_for(2, 1, 2, [&](std::size_t, std::size_t) {
    ++arrived;
    while (arrived < 2) std::this_thread::yield();
  });
  EXPECT_EQ(arrived, 2);
}

}  // namespace
}  // namespace hallway
