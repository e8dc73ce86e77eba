// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "link/datagram.hpp"

namespace hallway::link {

/// What became of the frames of a session, and of their datagrams.
struct FrameCounters {
  std::uint64_t frames = 0;      ///< that came whole
  std::uint64_t lost = 0;        ///< passed over: a later one came whole before them
  std::uint64_t incomplete = 0;  ///< of the lost, those of which something came
  std::uint64_t skipped = 0;     ///< came whole, and were not read before the next one
  std::uint64_t late = 0;        ///< datagrams of frames that no longer count
  std::uint64_t duplicates = 0;  ///< datagrams that had come before
  std::uint64_t misfits = 0;     ///< datagrams that contradict others of their frame, or come out of turn
};

/// What the robot shall hear about a datagram of a frame.
struct FrameReply {
  enum class Kind { kNothing, kMissing, kAnswer };
  Kind kind = Kind::kNothing;
  std::vector<bool> missing{};  ///< kMissing: of each fragment
};

/// Takes the datagrams of frames and gives frames.
class FrameInbox {
 public:
  FrameInbox() = default;
  virtual ~FrameInbox() = default;
  FrameInbox(const FrameInbox&) = delete;
  FrameInbox& operator=(const FrameInbox&) = delete;

  /// Takes a fragment of a frame.
  virtual FrameReply take(const Datagram& fragment) = 0;
  /// Moves the next frame into `frame`. @return its sequence number; empty if there is none
  virtual std::optional<std::uint64_t> next(Bytes& frame) = 0;
  /// The host has answered the frame of that number.
  virtual void answered(std::uint64_t sequence) = 0;
  const FrameCounters& counters() const { return counters_; }

 protected:
  FrameCounters counters_;
};

}  // namespace hallway::link
