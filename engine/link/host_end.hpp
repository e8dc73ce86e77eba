// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/sample.h>

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

#include "host/samples/frame_bytes.hpp"
#include "link/host_session.hpp"

namespace hallway::link {

/// The host's side of a session with a robot, with a thread that listens from beginning to end: a robot that asks is told at once, whatever the
/// caller is doing.
class HostEnd {
 public:
  /// Says hello. Keeps a reference to `wire`; parameters as of HostSession.
  HostEnd(Wire& wire, const Address& robot, std::uint64_t nonce, std::chrono::milliseconds give_up,
          std::uint8_t newest = kNewestVersion);
  /// Without a word to the robot.
  ~HostEnd();
  HostEnd(const HostEnd&) = delete;
  HostEnd& operator=(const HostEnd&) = delete;

  /// Waits for the robot to say who it is. Throws Error{kIo} if it does not, or Error{kBadInput}.
  const Description& describe();

  enum class Found { kNothing, kFrame, kEnd };
  struct Reading {
    Found found = Found::kNothing;
    const hw_frame_t* frame = nullptr;  ///< of kFrame; valid until the next read()
  };
  /// Waits for a frame, `wait` at most. Only after describe(). In real time a frame whose bytes are none, or whose time lies before that of the one
  /// before, is counted and passed over; in lock-step that is an Error{kBadInput}. Throws Error{kIo} if the robot is silent for too long or
  /// was started anew.
  Reading read(std::chrono::nanoseconds wait);
  /// Sends an answer. May be called by another thread while one is in read(), or in none.
  void answer(const Answer& answer);
  /// Says bye, and waits a little for the robot to have heard it.
  void leave();

  HostCounters counters() const;
  /// The version of the protocol that the session has; only after describe().
  std::uint8_t version() const;
  /// Frames that came whole and were none.
  std::uint64_t bad_frames() const { return bad_frames_; }

 private:
  void listen();
  bool bad_frame(const std::string& cause);
  bool take_frame(std::uint64_t sequence);
  void check_fault() const;

  Wire& wire_;
  mutable std::mutex mutex_;
  std::condition_variable news_;
  HostSession session_;     ///< under mutex_
  bool stop_ = false;       ///< under mutex_
  std::string broken_;      ///< under mutex_: what ended the thread
  bool lock_step_ = false;  ///< from here on: of the caller alone
  Bytes bytes_;             ///< of the frame that was read last
  host::FrameReader reader_;
  const hw_frame_t* frame_ = nullptr;
  std::int64_t t_ns_ = INT64_MIN;  ///< of that frame
  std::uint64_t bad_frames_ = 0;
  std::thread thread_;
};

}  // namespace hallway::link
