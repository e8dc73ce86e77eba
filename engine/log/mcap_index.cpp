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
  const McapRecordHead head = parse_record<McapRecordHead>(tail);
  if (!tail.ends_with(kMcapMagic) || head.op != McapOp::kFooter || head.length != kMcapFooterBytes) {
    bad_index("does not end as a log does: it has no index");
  }
  const auto footer =
      parse_record<McapFooter>(std::string_view(tail).substr(kMcapRecordHead, kMcapFooterBytes));
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

void take(McapOp op, std::string_view content, McapIndex& index) {
  switch (op) {
    case McapOp::kSchema: {
      auto schema = parse_record<McapSchema>(content);
      if (schema.id != 0) index.schemas.emplace(schema.id, std::move(schema));
      return;
    }
    case McapOp::kChannel: {
      auto channel = parse_record<McapChannel>(content);
      index.channels.emplace(channel.id, std::move(channel));
      return;
    }
    case McapOp::kStatistics:
      index.statistics = parse_record<McapStatistics>(content);
      return;
    case McapOp::kChunkIndex:
      index.chunks.push_back(parse_record<McapChunkIndex>(content));
      return;
    case McapOp::kAttachmentIndex:
      index.attachments.push_back(parse_record<McapAttachmentIndex>(content));
      return;
    case McapOp::kMetadataIndex:
      index.metadata.push_back(parse_record<McapMetadataIndex>(content));
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
    const McapRecordHead head = parse_record<McapRecordHead>(rest);
    rest.remove_prefix(kMcapRecordHead);
    if (head.length > rest.size()) bad_index("has an index that ends within a record");
    take(head.op, rest.substr(0, head.length), index);
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
  if (!lies_within(offset, length, input.size()) || length < kMcapRecordHead ||
      length - kMcapRecordHead > kMaxMcapRecordBytes) {
    bad_index(fmt::format("an index of a record of {} bytes at byte {}", length, offset));
  }
  std::string record;
  input.read(offset, length, record);
  const McapRecordHead head = parse_record<McapRecordHead>(record);
  if (head.op != op || head.length != length - kMcapRecordHead) {
    bad_index(fmt::format("at byte {} stands another record than the index says", offset));
  }
  return record.substr(kMcapRecordHead);
}

void read_indexed_chunk(const ByteInput& input, const McapChunkIndex& chunk, const McapMessageSink& sink) {
  const std::string records =
      unpack_chunk(read_indexed_record(input, McapOp::kChunk, chunk.offset, chunk.length));
  for (std::size_t at = 0; at < records.size();) {
    const auto item = next_chunk_record(records, at);
    if (item && item->op == McapOp::kMessage) sink(parse_record<McapMessage>(item->content));
  }
}

}  // namespace hallway::log
