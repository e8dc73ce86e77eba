// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "host/samples/carried_samples.hpp"
#include "link/assembly.hpp"
#include "link/frame_inbox.hpp"

namespace hallway::link {

/// Real time: the newest frame that is whole counts, and the robot is told nothing. Holds two frames that are not whole yet, since fragments may
/// overtake each other, and one that is. Of a frame that came whole and was not read before the next one, the samples of which none may be missed go
/// into that.
class NewestFrames final : public FrameInbox {
 public:
  FrameReply take(const Datagram& fragment) override;
  std::optional<std::uint64_t> next(Bytes& frame) override;
  void answered(std::uint64_t) override {}

 private:
  Assembly* assembly_for(const Header& header);
  void finish(Assembly& whole);

  std::array<Assembly, 2> assemblies_;
  std::optional<std::uint64_t> newest_;     ///< that came whole
  std::uint64_t given_up_ = 0;              ///< incomplete ones since, which had to make room
  std::optional<std::uint64_t> waiting_{};  ///< to be read; ready_ holds it
  Bytes ready_;
  Bytes overtaken_;
  host::CarriedSamples carried_;
};

}  // namespace hallway::link
