// SPDX-License-Identifier: MIT
#include "robot/watchdog.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "base/error.hpp"

namespace hallway::robot {
namespace {

/// Longest sleep: nothing rests on it, but a wake-up that was missed.
constexpr std::chrono::seconds kLongestSleep{1};

timespec time_until(Clock::time_point then, Clock::time_point now) {
  const auto left = std::clamp<Clock::duration>(then - now, Clock::duration::zero(), kLongestSleep);
  const auto whole = std::chrono::duration_cast<std::chrono::seconds>(left);
  return {.tv_sec = whole.count(),
          .tv_nsec = std::chrono::duration_cast<std::chrono::nanoseconds>(left - whole).count()};
}

}  // namespace

Watchdog::Watchdog(Gate& gate, std::function<bool()> stop)
    : gate_(gate), stop_(std::move(stop)), wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (wake_ < 0) {
    throw Error(ErrorCode::kIo, "no eventfd for the watchdog: " + std::generic_category().message(errno));
  }
  thread_ = std::thread([this] { run(); });
}

Watchdog::~Watchdog() {
  over_ = true;
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(wake_, &one, sizeof one);
  thread_.join();
  ::close(wake_);
}

void Watchdog::run() {
  bool told = false;
  while (!over_) {
    if (!told && stop_()) {
      told = true;
      try {
        gate_.end("the host was asked to end");
      } catch (...) {  // what the driver says then, it says to the loop too, which ends now
      }
    }
    const Clock::time_point now = Clock::now();
    const Clock::time_point next = gate_.watch(now);
    // 1 s at most: the largest time_point is no duration from now.
    const timespec wait = time_until(std::min(next, now + kLongestSleep), now);
    pollfd descriptor{.fd = wake_, .events = POLLIN, .revents = 0};
    if (::ppoll(&descriptor, 1, &wait, nullptr) == 1) {
      std::uint64_t count = 0;
      [[maybe_unused]] const ssize_t size = ::read(wake_, &count, sizeof count);
    }
  }
}

}  // namespace hallway::robot
