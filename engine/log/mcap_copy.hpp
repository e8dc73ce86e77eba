// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>

#include "log/mcap_reader.hpp"
#include "log/mcap_writer.hpp"

namespace hallway::log {

/// How a copy of a log went.
struct McapCopy {
  std::uint64_t messages = 0;        ///< written
  std::uint64_t left_out = 0;        ///< read, but not wanted
  std::optional<McapDamage> damage;  ///< where the reading stopped; everything before it is in the copy
};

/// Whether a message is to be copied.
using McapFilter = std::function<bool(const McapChannel&, const McapMessage&)>;

/// Writes what can be read of a log, up to its end or the first damage, as a whole log with an index; with `wanted` only
/// those messages. Schemas, channels, attachments and metadata are copied always.
/// Throws Error{kBadInput} if `input` is no MCAP file at all, Error{kIo}.
McapCopy copy_mcap(const ByteInput& input, ByteOutput& output, const McapFilter& wanted = {});

/// A part of a log.
struct McapSpan {
  std::uint64_t from_ns = 0;         ///< first log time
  std::uint64_t to_ns = UINT64_MAX;  ///< last log time
  /// Channels whose messages are of the whole log: they are copied whatever their time.
  std::function<bool(const McapChannel&)> is_of_whole_log;
  McapFilter wanted;  ///< which of the messages within the time
};

/// Copies a part of a log as copy_mcap() does. A log with an index is read no further than is needed: damage elsewhere is not
/// noticed, and damage within the part ends the copy there.
McapCopy copy_mcap_span(const ByteInput& input, ByteOutput& output, const McapSpan& span);

}  // namespace hallway::log
