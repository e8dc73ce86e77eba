// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

namespace hallway::robot {

/// How long a command holds when no new one comes, in the time of the frames.
class CommandTimeout {
 public:
  /// @param limit_ns  0: until the next command
  explicit CommandTimeout(std::int64_t limit_ns) : limit_ns_(limit_ns) {}

  /// The robot obeys a command from the answer to the frame of this time on.
  void obey(std::int64_t t_ns) { since_ns_ = t_ns; }
  /// The robot was stopped by something else: no command holds.
  void forget() { since_ns_.reset(); }
  /// Whether the answer to the frame of this time, which has no command, is the first that stops the robot. No command holds after it.
  bool expires(std::int64_t t_ns) {
    if (limit_ns_ <= 0 || !since_ns_ || t_ns - *since_ns_ < limit_ns_) return false;
    since_ns_.reset();
    ++count_;
    return true;
  }
  /// How often one has expired.
  std::uint64_t count() const { return count_; }

 private:
  std::int64_t limit_ns_;
  std::optional<std::int64_t> since_ns_;
  std::uint64_t count_ = 0;
};

}  // namespace hallway::robot
