// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "log/mcap_records.hpp"

namespace hallway::log {

/// The uncompressed records of a chunk, from the content of its record. Throws Error{kBadInput} if they are too many, are
/// compressed in a way that is not read, or have a wrong check sum.
std::string unpack_chunk(std::string_view content);

/// One record of a chunk.
struct McapChunkRecord {
  McapOp op = McapOp::kMessage;
  std::string_view content;
};

/// Takes the record at `at` and moves `at` behind it. Empty for a record of a kind that may be passed over. Throws
/// Error{kBadInput} if what stands there is no record of a chunk. `at` must be below records.size().
std::optional<McapChunkRecord> next_chunk_record(std::string_view records, std::size_t& at);

}  // namespace hallway::log
