// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "log/mcap_reader.hpp"
#include "log/mcap_writer.hpp"
#include "run/feed/run.hpp"

namespace hallway::run {

/// How copy_with_foxglove() went.
struct FoxgloveCopy {
  std::uint32_t frames = 0;  ///< copied and shown
  std::optional<log::McapDamage>
      damage{};  ///< where the reading stopped; what stands before it is in the copy
};

/// Copies a log and adds what shows it in Foxglove (foxglove/view.hpp). All that stands in `input` stays as it is, but for such a
/// view that it has already: that one is made anew. The same log gives the same bytes, and the log of a run the bytes that the run itself would have
/// written with a view, but for what plugins logged and how they failed, which no other channel has.
/// Reads up to the end or the first damage: of the file, or of a message that is not what its channel promises.
/// Throws Error{kBadInput} if `input` is no MCAP file, has no frames of Hallway or leaves no ids for more channels, Error{kIo}.
/// @param pictures  PNG files of the run, in the order in which they are added
FoxgloveCopy copy_with_foxglove(const log::ByteInput& input, log::ByteOutput& output,
                                std::span<const Attachment> pictures);

}  // namespace hallway::run
