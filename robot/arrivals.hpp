// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "host/samples/carried_samples.hpp"
#include "robot/gate.hpp"
#include "robot/intake.hpp"

namespace hallway::robot {

/// A frame that has come.
struct Arrival {
  TakenFrame frame;
  Clock::time_point came{};  ///< when the driver gave it
  std::string bytes;         ///< host/samples/frame_bytes.hpp, under the driver's number
};

/// The frames of a robot in the order in which they come. In real time a thread reads the driver, so that frames are stamped, and leave the driver, when
/// they come and not when the plugins have time; as many as `backlog` wait, and the oldest of more are dropped. Their samples of which none may be
/// missed go into the next frame. In lock-step the driver is read when a frame is asked for, and nothing waits.
class Arrivals {
 public:
  /// Keeps references. Reading begins.
  /// @param backlog  at least 1
  Arrivals(host::Driver& driver, const host::RobotInfo& robot, std::size_t backlog);
  ~Arrivals();
  Arrivals(const Arrivals&) = delete;
  Arrivals& operator=(const Arrivals&) = delete;

  /// Waits for a frame, `wait` at most. Takes what is in `arrival` and leaves memory to be used again. Throws what the driver throws, when the frames
  /// before are taken.
  /// @param newest  take the newest that is there, and drop the others
  /// @return whether there is one
  bool take(std::chrono::nanoseconds wait, bool newest, Arrival& arrival);
  /// Ends reading: the driver is this caller's again. What still waits counts as dropped.
  void stop();

  /// There will be no more frames.
  bool ended() const;
  IntakeCounts counts() const;
  /// Why the first frame was refused; empty where none was.
  std::string first_refusal() const;

 private:
  void read();
  bool read_one(Arrival& arrival);
  void add(Arrival& arrival);
  void drop_first(Arrival& heir);

  const host::RobotInfo& robot_;
  std::size_t backlog_;
  Intake intake_;  ///< of the reading thread, where there is one
  mutable std::mutex mutex_;
  std::condition_variable came_;
  std::deque<Arrival> waiting_;
  std::vector<std::string> spare_;  ///< memory to be used again
  std::uint64_t dropped_ = 0;
  host::CarriedSamples carried_;
  IntakeCounts counts_;  ///< of intake_
  std::string first_refusal_;
  bool ended_ = false;
  bool stopping_ = false;
  std::exception_ptr failure_;
  std::thread thread_;  ///< last: it uses all the others
};

}  // namespace hallway::robot
