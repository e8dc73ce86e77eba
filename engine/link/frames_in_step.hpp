// SPDX-License-Identifier: MIT
#pragma once

#include "link/assembly.hpp"
#include "link/frame_inbox.hpp"

namespace hallway::link {

/// Lock-step: every frame counts. The robot sends the next one when it has the answer to the last one, and asks what is missing until then.
class FramesInStep final : public FrameInbox {
 public:
  FrameReply take(const Datagram& fragment) override;
  std::optional<std::uint64_t> next(Bytes& frame) override;
  void answered(std::uint64_t sequence) override;

 private:
  enum class Last { kNone, kWhole, kRead, kAnswered };

  FrameReply about_last(const Datagram& fragment);
  FrameReply state_of(const Datagram& fragment) const;
  bool waits_for_answer() const { return last_ == Last::kWhole || last_ == Last::kRead; }

  Assembly assembly_;
  Last last_ = Last::kNone;      ///< what became of the last frame that came whole
  std::uint64_t sequence_ = 0;   ///< its number
  std::uint16_t fragments_ = 0;  ///< and of how many fragments it was
  Bytes ready_;
};

}  // namespace hallway::link
