// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <functional>
#include <thread>

#include "robot/gate.hpp"

namespace hallway::robot {

/// A thread that looks at a gate's time and at whether the program shall end, and stops the robot for either, whatever the other threads are
/// doing.
class Watchdog {
 public:
  /// @param stop  whether the program shall end; asked when wake() was counted up, and at times. Must not block
  Watchdog(Gate& gate, std::function<bool()> stop);
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  /// An eventfd: counted up, it makes the watchdog look at once. Signal handlers may do that.
  int wake() const { return wake_; }

 private:
  void run();

  Gate& gate_;
  std::function<bool()> stop_;
  int wake_;
  std::atomic<bool> over_{false};
  std::thread thread_;
};

}  // namespace hallway::robot
