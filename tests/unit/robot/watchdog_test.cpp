// SPDX-License-Identifier: MIT
#include "robot/watchdog.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <condition_variable>

namespace hallway::robot {
namespace {

using std::chrono::milliseconds;

/// Remembers the statuses that were written, and lets a test wait for them.
class Statuses {
 public:
  void add(const hw_answer_t& answer) {
    const std::lock_guard lock(mutex_);
    statuses_.push_back(answer.status);
    changed_.notify_all();
  }
  bool wait_for(std::uint32_t status) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(120), [&] {
      return std::find(statuses_.begin(), statuses_.end(), status) != statuses_.end();
    });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::uint32_t> statuses_;
};

TEST(Watchdog, StopsTheRobotWhileNobodyElseDoesAnything) {
  Statuses statuses;
  Gate gate([&](const hw_answer_t& answer) { statuses.add(answer); }, milliseconds(20), Clock::now());
  const Watchdog watchdog(gate, [] { return false; });
  gate.frame_came(0, 0, Clock::now());
  EXPECT_TRUE(statuses.wait_for(HW_ANSWER_LATE));
}

TEST(Watchdog, EndsWhenItIsWokenAndAskedTo) {
  Statuses statuses;
  std::atomic<bool> stop{false};
  Gate gate([&](const hw_answer_t& answer) { statuses.add(answer); }, milliseconds(0), Clock::now());
  const Watchdog watchdog(gate, [&] { return stop.load(); });
  stop = true;
  const std::uint64_t one = 1;
  ASSERT_EQ(::write(watchdog.wake(), &one, sizeof one), static_cast<ssize_t>(sizeof one));
  EXPECT_TRUE(statuses.wait_for(HW_ANSWER_END));
}

TEST(Watchdog, OfARobotThatIsAnsweredInTimeStopsNothing) {
  std::atomic<int> moved{0}, stopped{0};
  Gate gate([&](const hw_answer_t& answer) { ++(answer.status == HW_ANSWER_DONE ? moved : stopped); },
            std::chrono::seconds(60), Clock::now());
  {
    const Watchdog watchdog(gate, [] { return false; });
    for (std::uint64_t i = 0; i < 1000; ++i) {
      gate.frame_came(i, 0, Clock::now());
      gate.answer({}, Clock::now());
    }
  }
  EXPECT_EQ(moved, 1000);
  EXPECT_EQ(stopped, 0);
}

}  // namespace
}  // namespace hallway::robot
