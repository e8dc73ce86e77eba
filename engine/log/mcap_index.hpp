// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <vector>

#include "log/byte_io.hpp"
#include "log/mcap_records.hpp"

namespace hallway::log {

/// What the summary of a log says of it.
struct McapIndex {
  McapStatistics statistics;
  std::map<std::uint16_t, McapSchema> schemas;
  std::map<std::uint16_t, McapChannel> channels;
  std::vector<McapChunkIndex> chunks;
  std::vector<McapAttachmentIndex> attachments;
  std::vector<McapMetadataIndex> metadata;
};

/// Reads the summary from the end of a log, and nothing else. Throws Error{kBadInput} if there is none, or it is damaged: an
/// unfinished log has none, and McapReader reads it all the same.
McapIndex read_mcap_index(const ByteInput& input);

/// The content of the record that an index says stands there. Throws Error{kBadInput} if it does not.
std::string read_indexed_record(const ByteInput& input, McapOp op, std::uint64_t offset,
                                std::uint64_t length);

/// Takes a message of a chunk; its data live until it returns.
using McapMessageSink = std::function<void(const McapMessage&)>;

/// Gives the messages of one chunk of the index, in the order of the file. Throws Error{kBadInput} if the chunk is damaged or not
/// where the index says; nothing of it was given then, unless it has no check sum.
void read_indexed_chunk(const ByteInput& input, const McapChunkIndex& chunk, const McapMessageSink& sink);

}  // namespace hallway::log
