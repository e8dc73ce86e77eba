// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/driver.h>

#include <chrono>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

namespace hallway::robot {

using Clock = std::chrono::steady_clock;

inline double milliseconds(Clock::duration duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

/// What a gate has let through and what not.
struct GateCounts {
  std::uint64_t trips = 0;         ///< how often the watchdog stopped the robot
  std::uint64_t late_answers = 0;  ///< that came, but after the watchdog's time
  Clock::duration worst_stop{};  ///< the longest from the frame (or the failure) to the command that stopped
};

/// The one way to the robot's wheels: all answers go through it, one at a time, and it decides whether they move the robot.
///
/// The robot is stopped when an answer is late, when no frame comes, when the pipeline fails and at the end; it moves again with the next
/// answer in time. Nothing here asks for the time: the callers say what time it is. Any thread may call.
class Gate {
 public:
  using Write = std::function<void(const hw_answer_t&)>;

  /// @param write  hands an answer to the driver; called with the gate locked, and must not wait
  /// @param limit  the watchdog's time; 0: the clock stops nothing
  Gate(Write write, Clock::duration limit, Clock::time_point now);

  /// A frame was read: an answer is due within the limit, and so is the frame after it.
  void frame_came(std::uint64_t sequence, std::int64_t t_ns, Clock::time_point now);
  /// The answer to that frame: in time it is handed on, late it stops the robot. `status`, `sequence` and `t_ns` of it are set here. @return whether
  /// it was in time
  bool answer(hw_answer_t answer, Clock::time_point now);
  /// The pipeline gives no answer to that frame.
  void fail(const std::string& message, Clock::time_point now);
  /// The host ends. Nothing is handed on after it.
  void end(const std::string& message);

  /// The watchdog's look: stops the robot if it is time. @return when to look again
  Clock::time_point watch(Clock::time_point now);

  GateCounts counts() const;
  /// What there is to say to people since the last call.
  std::vector<std::string> take_messages();
  /// Throws what a write threw that the watchdog made.
  void check() const;

 private:
  void write(hw_answer_t& answer, std::uint32_t status);
  /// Hands on an answer with a command that stops the robot instead of its own.
  void stop(hw_answer_t answer, std::uint32_t status, const std::string& message);
  void note_trip(const std::string& message);
  void note_stop(Clock::time_point since);

  Write write_;
  Clock::duration limit_;
  mutable std::mutex mutex_;
  std::uint64_t sequence_ = 0;
  std::int64_t t_ns_ = 0;
  Clock::time_point last_frame_;
  bool waiting_ = false;  ///< for the answer to the last frame
  bool late_ = false;     ///< the last frame's answer
  bool stopped_ = false;  ///< since the last answer in time
  bool ended_ = false;
  GateCounts counts_;
  std::vector<std::string> messages_;
  std::exception_ptr failure_;
};

}  // namespace hallway::robot
