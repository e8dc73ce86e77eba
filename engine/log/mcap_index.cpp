// SPDX-License-Identifier: MIT
#include "log/mcap_index.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "log/compression.hpp"
#include "log/mcap_chunk.hpp"
#include "log/mcap_reader.hpp"

namespace hallway::log {
namespace {

constexpr std::uint64_t kFooterRecord = kMcapRecordHead + kMcapFooterBytes;
constexpr std::uint64_t kTail = kFooterRecord + kMcapMagic.size();

[[noreturn]] void bad_index(std::string cause) {
  throw Error(ErrorCode::kBadInput, std::move(cause));
}

/// The summary with the footer behind it, without the footer's last field.
std::string read_summary(const ByteInput& input) {
  std::string tail;
  if (input.size() < kTail + kMcapMagic.size()) bad_index("is too short for a log with an index");
  input.read(input.size() - kTail, kTail, tail);
  const McapRecordHead head = parse_record_head(std::string_view(tail).substr(0, kMcapRecordHead));
  if (!tail.ends_with(kMcapMagic) || static_cast<McapOp>(head.op) != McapOp::kFooter ||
      head.length != kMcapFooterBytes) {
    bad_index("does not end as a log does: it has no index");
  }
  McapFooter footer;
  parse_record(std::string_view(tail).substr(kMcapRecordHead, kMcapFooterBytes), footer);
  const std::uint64_t footer_at = input.size() - kTail;
  if (footer.summary_start < kMcapMagic.size() || footer.summary_start > footer_at) bad_index("has no index");
  const std::uint64_t size = footer_at - footer.summary_start;
  if (size > kMaxMcapRecordBytes) bad_index(fmt::format("has an index of {} bytes", size));
  std::string summary;
  input.read(footer.summary_start, size + kFooterRecord - sizeof footer.summary_crc, summary);
  if (footer.summary_crc != 0 && footer.summary_crc != crc32(summary))
    bad_index("has an index whose check sum is wrong");
  summary.resize(size);
  return summary;
}

template <typename Record>
Record parsed(std::string_view content) {
  Record record;
  parse_record(content, record);
  return record;
}

void take(McapOp op, std::string_view content, McapIndex& index) {
  switch (op) {
    case McapOp::kSchema: {
      auto schema = parsed<McapSchema>(content);
      if (schema.id != 0) index.schemas.emplace(schema.id, std::move(schema));
      return;
    }
    case McapOp::kChannel: {
      auto channel = parsed<McapChannel>(content);
      index.channels.emplace(channel.id, std::move(channel));
      return;
    }
    case McapOp::kStatistics:
      index.statistics = parsed<McapStatistics>(content);
      return;
    case McapOp::kChunkIndex:
      index.chunks.push_back(parsed<McapChunkIndex>(content));
      return;
    case McapOp::kAttachmentIndex:
      index.attachments.push_back(parsed<McapAttachmentIndex>(content));
      return;
    case McapOp::kMetadataIndex:
      index.metadata.push_back(parsed<McapMetadataIndex>(content));
      return;
    default:
      return;  // summary offsets, and what a later version may have added
  }
}

}  // namespace

McapIndex read_mcap_index(const ByteInput& input) {
  const std::string summary = read_summary(input);
  McapIndex index;
  std::string_view rest = summary;
  while (!rest.empty()) {
    if (rest.size() < kMcapRecordHead) bad_index("has an index that ends within a record");
    const McapRecordHead head = parse_record_head(rest.substr(0, kMcapRecordHead));
    rest.remove_prefix(kMcapRecordHead);
    if (head.length > rest.size()) bad_index("has an index that ends within a record");
    take(static_cast<McapOp>(head.op), rest.substr(0, head.length), index);
    rest.remove_prefix(head.length);
  }
  for (const auto& [id, channel] : index.channels) {
    if (channel.schema_id == 0 || index.schemas.contains(channel.schema_id)) continue;
    bad_index(fmt::format("has an index in which schema {} of channel {} is missing", channel.schema_id, id));
  }
  return index;
}

std::string read_indexed_record(const ByteInput& input, McapOp op, std::uint64_t offset,
                                std::uint64_t length) {
  const bool there = offset <= input.size() && length <= input.size() - offset;
  if (!there || length < kMcapRecordHead || length - kMcapRecordHead > kMaxMcapRecordBytes) {
    bad_index(fmt::format("an index of a record of {} bytes at byte {}", length, offset));
  }
  std::string record;
  input.read(offset, length, record);
  const McapRecordHead head = parse_record_head(std::string_view(record).substr(0, kMcapRecordHead));
  if (static_cast<McapOp>(head.op) != op || head.length != length - kMcapRecordHead) {
    bad_index(fmt::format("at byte {} stands another record than the index says", offset));
  }
  return record.substr(kMcapRecordHead);
}

void read_indexed_chunk(const ByteInput& input, const McapChunkIndex& chunk, const McapMessageSink& sink) {
  const std::string records =
      unpack_chunk(read_indexed_record(input, McapOp::kChunk, chunk.offset, chunk.length));
  for (std::size_t at = 0; at < records.size();) {
    const auto item = next_chunk_record(records, at);
    if (item && item->op == McapOp::kMessage) sink(parsed<McapMessage>(item->content));
  }
}

}  // namespace hallway::log
