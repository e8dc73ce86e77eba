// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "robot/gate.hpp"

namespace hallway::robot {

/// Points of time at equal distances from a beginning: a late step does not move those after it.
class Schedule {
 public:
  /// @param period  above 0
  Schedule(Clock::time_point begin, Clock::duration period) : begin_(begin), period_(period) {}

  /// The next point: the one after the last that was given, or the first that is not past.
  Clock::time_point next(Clock::time_point now);

 private:
  Clock::time_point begin_;
  Clock::duration period_;
  std::int64_t index_ = -1;
};

/// Sleeps until then, by the monotonic clock. A signal does not end it early.
void sleep_until(Clock::time_point then);

}  // namespace hallway::robot
