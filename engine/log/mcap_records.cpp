// SPDX-License-Identifier: MIT
#include "log/mcap_records.hpp"

#include "log/compression.hpp"
#include "log/mcap_bytes.hpp"

namespace hallway::log {
namespace {

template <typename Fields>
void append(std::string& out, McapOp op, Fields fields) {
  McapByteWriter writer(out);
  writer.number(static_cast<std::uint8_t>(op));
  writer.prefixed<std::uint64_t>([&] { fields(writer); });
}

void append_entries(McapByteWriter& writer, const McapEntries& entries) {
  writer.prefixed<std::uint32_t>([&] {
    for (const auto& [key, value] : entries) {
      writer.text(key);
      writer.text(value);
    }
  });
}

/// A map from channels to numbers, or a list of pairs of numbers.
template <typename Pairs>
void append_pairs(McapByteWriter& writer, const Pairs& pairs) {
  writer.prefixed<std::uint32_t>([&] {
    for (const auto& [first, second] : pairs) {
      writer.number(first);
      writer.number(second);
    }
  });
}

/// A map from channels to numbers, or a list of pairs of numbers.
template <typename Pairs>
Pairs take_pairs(McapByteReader& reader) {
  McapByteReader list(reader.text());
  Pairs pairs;
  while (!list.empty()) {
    const auto first = list.number<typename Pairs::value_type::first_type>();
    pairs.emplace_back(first, list.number<typename Pairs::value_type::second_type>());
  }
  return pairs;
}

McapEntries take_entries(McapByteReader& reader) {
  McapByteReader list(reader.text());
  McapEntries entries;
  while (!list.empty()) {
    std::string key(list.text());
    entries.emplace_back(std::move(key), list.text());
  }
  return entries;
}

}  // namespace

void append_record(std::string& out, const McapHeader& header) {
  append(out, McapOp::kHeader, [&](McapByteWriter& to) {
    to.text(header.profile);
    to.text(header.library);
  });
}

void append_record(std::string& out, const McapFooter& footer) {
  append(out, McapOp::kFooter, [&](McapByteWriter& to) {
    to.number(footer.summary_start);
    to.number(footer.summary_offset_start);
    to.number(footer.summary_crc);
  });
}

void append_record(std::string& out, const McapSchema& schema) {
  append(out, McapOp::kSchema, [&](McapByteWriter& to) {
    to.number(schema.id);
    to.text(schema.name);
    to.text(schema.encoding);
    to.text(schema.data);
  });
}

void append_record(std::string& out, const McapChannel& channel) {
  append(out, McapOp::kChannel, [&](McapByteWriter& to) {
    to.number(channel.id);
    to.number(channel.schema_id);
    to.text(channel.topic);
    to.text(channel.encoding);
    append_entries(to, channel.metadata);
  });
}

void append_record(std::string& out, const McapMessage& message) {
  append(out, McapOp::kMessage, [&](McapByteWriter& to) {
    to.number(message.channel_id);
    to.number(message.sequence);
    to.number(message.log_time_ns);
    to.number(message.publish_time_ns);
    to.bytes(message.data);
  });
}

void append_record(std::string& out, const McapChunk& chunk) {
  append(out, McapOp::kChunk, [&](McapByteWriter& to) {
    to.number(chunk.start_time_ns);
    to.number(chunk.end_time_ns);
    to.number(chunk.uncompressed_size);
    to.number(chunk.uncompressed_crc);
    to.text(chunk.compression);
    to.number(static_cast<std::uint64_t>(chunk.records.size()));
    to.bytes(chunk.records);
  });
}

void append_record(std::string& out, const McapMessageIndex& index) {
  append(out, McapOp::kMessageIndex, [&](McapByteWriter& to) {
    to.number(index.channel_id);
    append_pairs(to, index.entries);
  });
}

void append_record(std::string& out, const McapChunkIndex& index) {
  append(out, McapOp::kChunkIndex, [&](McapByteWriter& to) {
    to.number(index.start_time_ns);
    to.number(index.end_time_ns);
    to.number(index.offset);
    to.number(index.length);
    append_pairs(to, index.message_indices);
    to.number(index.message_indices_length);
    to.text(index.compression);
    to.number(index.compressed_size);
    to.number(index.uncompressed_size);
  });
}

void append_record(std::string& out, const McapAttachment& attachment) {
  append(out, McapOp::kAttachment, [&](McapByteWriter& to) {
    const std::size_t begin = out.size();
    to.number(attachment.log_time_ns);
    to.number(attachment.create_time_ns);
    to.text(attachment.name);
    to.text(attachment.media_type);
    to.number(static_cast<std::uint64_t>(attachment.data.size()));
    to.bytes(attachment.data);
    to.number(crc32(std::string_view(out).substr(begin)));
  });
}

void append_record(std::string& out, const McapAttachmentIndex& index) {
  append(out, McapOp::kAttachmentIndex, [&](McapByteWriter& to) {
    to.number(index.offset);
    to.number(index.length);
    to.number(index.log_time_ns);
    to.number(index.create_time_ns);
    to.number(index.data_size);
    to.text(index.name);
    to.text(index.media_type);
  });
}

void append_record(std::string& out, const McapStatistics& statistics) {
  append(out, McapOp::kStatistics, [&](McapByteWriter& to) {
    to.number(statistics.messages);
    to.number(statistics.schemas);
    to.number(statistics.channels);
    to.number(statistics.attachments);
    to.number(statistics.metadata);
    to.number(statistics.chunks);
    to.number(statistics.start_time_ns);
    to.number(statistics.end_time_ns);
    append_pairs(to, statistics.channel_messages);
  });
}

void append_record(std::string& out, const McapMetadata& metadata) {
  append(out, McapOp::kMetadata, [&](McapByteWriter& to) {
    to.text(metadata.name);
    append_entries(to, metadata.entries);
  });
}

void append_record(std::string& out, const McapMetadataIndex& index) {
  append(out, McapOp::kMetadataIndex, [&](McapByteWriter& to) {
    to.number(index.offset);
    to.number(index.length);
    to.text(index.name);
  });
}

void append_record(std::string& out, const McapSummaryOffset& offset) {
  append(out, McapOp::kSummaryOffset, [&](McapByteWriter& to) {
    to.number(static_cast<std::uint8_t>(offset.group));
    to.number(offset.start);
    to.number(offset.length);
  });
}

void append_record(std::string& out, const McapDataEnd& end) {
  append(out, McapOp::kDataEnd, [&](McapByteWriter& to) { to.number(end.data_crc); });
}

void parse_record(std::string_view content, McapHeader& header) {
  McapByteReader from(content);
  header.profile = from.text();
  header.library = from.text();
}

void parse_record(std::string_view content, McapFooter& footer) {
  if (content.size() != kMcapFooterBytes) throw Error(ErrorCode::kBadInput, "a footer of a wrong length");
  McapByteReader from(content);
  footer.summary_start = from.number<std::uint64_t>();
  footer.summary_offset_start = from.number<std::uint64_t>();
  footer.summary_crc = from.number<std::uint32_t>();
}

void parse_record(std::string_view content, McapSchema& schema) {
  McapByteReader from(content);
  schema.id = from.number<std::uint16_t>();
  schema.name = from.text();
  schema.encoding = from.text();
  schema.data = from.text();
}

void parse_record(std::string_view content, McapChannel& channel) {
  McapByteReader from(content);
  channel.id = from.number<std::uint16_t>();
  channel.schema_id = from.number<std::uint16_t>();
  channel.topic = from.text();
  channel.encoding = from.text();
  channel.metadata = take_entries(from);
}

void parse_record(std::string_view content, McapMessage& message) {
  McapByteReader from(content);
  message.channel_id = from.number<std::uint16_t>();
  message.sequence = from.number<std::uint32_t>();
  message.log_time_ns = from.number<std::uint64_t>();
  message.publish_time_ns = from.number<std::uint64_t>();
  message.data = from.rest();
}

void parse_record(std::string_view content, McapChunk& chunk) {
  McapByteReader from(content);
  chunk.start_time_ns = from.number<std::uint64_t>();
  chunk.end_time_ns = from.number<std::uint64_t>();
  chunk.uncompressed_size = from.number<std::uint64_t>();
  chunk.uncompressed_crc = from.number<std::uint32_t>();
  chunk.compression = from.text();
  chunk.records = from.take(from.number<std::uint64_t>());
}

void parse_record(std::string_view content, McapMessageIndex& index) {
  McapByteReader from(content);
  index.channel_id = from.number<std::uint16_t>();
  index.entries = take_pairs<decltype(index.entries)>(from);
}

void parse_record(std::string_view content, McapAttachment& attachment) {
  McapByteReader from(content);
  attachment.log_time_ns = from.number<std::uint64_t>();
  attachment.create_time_ns = from.number<std::uint64_t>();
  attachment.name = from.text();
  attachment.media_type = from.text();
  attachment.data = from.take(from.number<std::uint64_t>());
  const std::size_t covered = static_cast<std::size_t>(attachment.data.end() - content.begin());
  const auto crc = from.number<std::uint32_t>();
  if (crc != 0 && crc != crc32(content.substr(0, covered))) {
    throw Error(ErrorCode::kBadInput, "an attachment whose check sum is wrong");
  }
}

void parse_record(std::string_view content, McapStatistics& statistics) {
  McapByteReader from(content);
  statistics.messages = from.number<std::uint64_t>();
  statistics.schemas = from.number<std::uint16_t>();
  statistics.channels = from.number<std::uint32_t>();
  statistics.attachments = from.number<std::uint32_t>();
  statistics.metadata = from.number<std::uint32_t>();
  statistics.chunks = from.number<std::uint32_t>();
  statistics.start_time_ns = from.number<std::uint64_t>();
  statistics.end_time_ns = from.number<std::uint64_t>();
  statistics.channel_messages = take_pairs<decltype(statistics.channel_messages)>(from);
}

void parse_record(std::string_view content, McapChunkIndex& index) {
  McapByteReader from(content);
  index.start_time_ns = from.number<std::uint64_t>();
  index.end_time_ns = from.number<std::uint64_t>();
  index.offset = from.number<std::uint64_t>();
  index.length = from.number<std::uint64_t>();
  index.message_indices = take_pairs<decltype(index.message_indices)>(from);
  index.message_indices_length = from.number<std::uint64_t>();
  index.compression = from.text();
  index.compressed_size = from.number<std::uint64_t>();
  index.uncompressed_size = from.number<std::uint64_t>();
}

void parse_record(std::string_view content, McapAttachmentIndex& index) {
  McapByteReader from(content);
  index.offset = from.number<std::uint64_t>();
  index.length = from.number<std::uint64_t>();
  index.log_time_ns = from.number<std::uint64_t>();
  index.create_time_ns = from.number<std::uint64_t>();
  index.data_size = from.number<std::uint64_t>();
  index.name = from.text();
  index.media_type = from.text();
}

void parse_record(std::string_view content, McapMetadataIndex& index) {
  McapByteReader from(content);
  index.offset = from.number<std::uint64_t>();
  index.length = from.number<std::uint64_t>();
  index.name = from.text();
}

void parse_record(std::string_view content, McapMetadata& metadata) {
  McapByteReader from(content);
  metadata.name = from.text();
  metadata.entries = take_entries(from);
}

void parse_record(std::string_view content, McapDataEnd& end) {
  end.data_crc = McapByteReader(content).number<std::uint32_t>();
}

McapRecordHead parse_record_head(std::string_view head) {
  McapByteReader from(head);
  McapRecordHead result;
  result.op = from.number<std::uint8_t>();
  result.length = from.number<std::uint64_t>();
  return result;
}

}  // namespace hallway::log
