// SPDX-License-Identifier: MIT
#include "robot/schedule.hpp"

#include <time.h>

#include <algorithm>
#include <cerrno>

namespace hallway::robot {

Clock::time_point Schedule::next(Clock::time_point now) {
  const std::int64_t past = (now - begin_ + period_ - Clock::duration(1)) / period_;
  index_ = std::max(index_ + 1, past);
  return begin_ + index_ * period_;
}

void sleep_until(Clock::time_point then) {
  using std::chrono::nanoseconds;
  const std::int64_t ns = std::chrono::duration_cast<nanoseconds>(then.time_since_epoch()).count();
  const timespec at{.tv_sec = ns / 1'000'000'000, .tv_nsec = ns % 1'000'000'000};
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, nullptr) == EINTR) {
  }
}

}  // namespace hallway::robot
