// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/load/driver.hpp"
#include "host/samples/frame_bytes.hpp"

namespace hallway::robot {

/// What became of the frames that a driver gave.
struct IntakeCounts {
  std::uint64_t read = 0;     ///< that the driver gave
  std::uint64_t lost = 0;     ///< that are missing in the driver's sequence
  std::uint64_t dropped = 0;  ///< that were passed over for newer ones, or never got their turn
  std::uint64_t refused = 0;  ///< that are not as sample.h says
};

/// A frame as it was taken.
struct TakenFrame {
  std::uint64_t sequence = 0;  ///< the driver's
  std::int64_t t_ns = 0;
};

/// Takes frames from a driver, checks and copies them. One thread.
class Intake {
 public:
  /// Keeps references. In lock-step a frame that is not as sample.h says is an Error{kBadInput}, else it is refused and counted.
  Intake(host::Driver& driver, const host::RobotInfo& robot);

  /// Waits for a frame, `wait` at most. Its bytes (host/samples/frame_bytes.hpp, under the driver's number) replace `bytes`. Throws what the driver
  /// throws.
  /// @return nothing where there is no frame, or one that is refused
  std::optional<TakenFrame> take(std::chrono::nanoseconds wait, std::string& bytes);

  /// The driver has said that there are no more frames.
  bool ended() const { return ended_; }
  const IntakeCounts& counts() const { return counts_; }
  /// Why the first frame was refused; empty where none was.
  const std::string& first_refusal() const { return first_refusal_; }

 private:
  std::string problem_of(const hw_frame_t& frame) const;
  std::string problem_of(const hw_sample_t& sample) const;
  bool keep(const hw_frame_t& frame, std::string& bytes);
  void refuse(std::uint64_t sequence, const std::string& reason);

  host::Driver& driver_;
  const host::RobotInfo& robot_;
  host::FrameWriter writer_;
  bool ended_ = false;
  std::optional<TakenFrame> last_;
  IntakeCounts counts_;
  std::string first_refusal_;
};

}  // namespace hallway::robot
