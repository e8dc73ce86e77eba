// SPDX-License-Identifier: MIT
#include "log/mcap_chunk.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/text.hpp"
#include "log/compression.hpp"
#include "log/mcap_reader.hpp"

namespace hallway::log {
namespace {

[[noreturn]] void bad(std::string cause) {
  throw Error(ErrorCode::kBadInput, std::move(cause));
}

std::string decompress(const McapChunk& chunk) {
  if (chunk.compression == "zstd") return decompress_zstd(chunk.records, chunk.uncompressed_size);
  if (!chunk.compression.empty()) {
    bad(fmt::format("a chunk compressed by \"{}\", which is not read", printable(chunk.compression)));
  }
  if (chunk.records.size() != chunk.uncompressed_size) bad("a chunk of another size than it says");
  return std::string(chunk.records);
}

}  // namespace

std::string unpack_chunk(std::string_view content) {
  const auto chunk = parse_record<McapChunk>(content);
  if (chunk.uncompressed_size > kMaxMcapRecordBytes) {
    bad(fmt::format("a chunk of {} bytes; at most {} are read", chunk.uncompressed_size,
                    kMaxMcapRecordBytes));
  }
  std::string records = decompress(chunk);
  if (chunk.uncompressed_crc != 0 && chunk.uncompressed_crc != crc32(records))
    bad("a chunk whose check sum is wrong");
  return records;
}

std::optional<McapChunkRecord> next_chunk_record(std::string_view records, std::size_t& at) {
  const std::string_view rest = records.substr(at);
  if (rest.size() < kMcapRecordHead) bad("a chunk that ends within a record");
  const McapRecordHead head = parse_record<McapRecordHead>(rest);
  if (head.length > rest.size() - kMcapRecordHead) bad("a chunk with a record that is longer than the chunk");
  at += kMcapRecordHead + head.length;
  if (is_foreign(head.op)) return std::nullopt;
  if (head.op != McapOp::kSchema && head.op != McapOp::kChannel && head.op != McapOp::kMessage) {
    bad(fmt::format("a chunk with a record of kind {}", fmt::underlying(head.op)));
  }
  return McapChunkRecord{head.op, rest.substr(kMcapRecordHead, head.length)};
}

}  // namespace hallway::log
