// SPDX-License-Identifier: MIT
#include "base/shared_memory.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

#include "support/errors.hpp"

namespace hallway {
namespace {

constexpr std::size_t kBytes = 1 << 20;

TEST(SharedMemory, BothSeeWhatOneWrites) {
  const SharedMemory mine("test", kBytes, SharedMemory::Writers::kBoth);
  const SharedMemory theirs(::dup(mine.descriptor()), true);
  ASSERT_EQ(theirs.bytes().size(), kBytes);
  EXPECT_TRUE(std::ranges::all_of(theirs.bytes(), [](std::byte b) { return b == std::byte{0}; }));
  mine.bytes()[kBytes - 1] = std::byte{1};
  theirs.bytes()[0] = std::byte{2};
  EXPECT_EQ(theirs.bytes()[kBytes - 1], std::byte{1});
  EXPECT_EQ(mine.bytes()[0], std::byte{2});
}

TEST(SharedMemory, ItsSizeNeverChanges) {
  const SharedMemory memory("test", kBytes, SharedMemory::Writers::kBoth);
  EXPECT_NE(::ftruncate(memory.descriptor(), 0), 0);
  EXPECT_NE(::ftruncate(memory.descriptor(), 2 * kBytes), 0);
  EXPECT_EQ(::lseek(memory.descriptor(), 0, SEEK_END), static_cast<off_t>(kBytes));
}

TEST(SharedMemory, WhatTheCreatorAloneWritesCannotBeMappedForWriting) {
  const SharedMemory memory("test", kBytes, SharedMemory::Writers::kCreator);
  memory.bytes()[5] = std::byte{5};
  const SharedMemory reader(::dup(memory.descriptor()), false);
  EXPECT_EQ(reader.bytes()[5], std::byte{5});
  const auto error = test::error_of([&] { const SharedMemory writer(::dup(memory.descriptor()), true); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kIo);
}

TEST(SharedMemory, TakesNoMemoryWhereNobodyWrites) {
  const SharedMemory memory("test", std::size_t{64} << 30, SharedMemory::Writers::kBoth);
  memory.bytes().back() = std::byte{1};
  EXPECT_EQ(memory.bytes().back(), std::byte{1});
}

TEST(Futex, WakesTheOneWhoWaits) {
  FutexWord word{0};
  std::thread waker([&] {
    word = 1;
    futex_wake(word);
  });
  while (word == 0) futex_wait(word, 0, std::chrono::seconds(100));
  waker.join();
  EXPECT_EQ(word, 1u);
}

// Of these two the test is that they return: one that slept would be ended by ctest.
TEST(Futex, DoesNotSleepWhereTheWordHasChanged) {
  const FutexWord word{7};
  const auto begin = std::chrono::steady_clock::now();
  futex_wait(word, 6, std::chrono::hours(24));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::hours(12));  // it slept not at all
}

TEST(Futex, EndsAtItsLimit) {
  const FutexWord word{7};
  futex_wait(word, 7, std::chrono::milliseconds(1));
  EXPECT_EQ(word.load(), 7u);  // nothing woke it: that this line is reached is what counts
}

}  // namespace
}  // namespace hallway
