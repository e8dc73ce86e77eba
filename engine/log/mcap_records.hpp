// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "log/mcap_fields.hpp"

namespace hallway::log {

// The records of the MCAP container, version 0 (https://mcap.dev/spec): what they hold, and their bytes.

/// What an MCAP file begins and ends with.
inline constexpr std::string_view kMcapMagic{"\x89MCAP0\r\n", 8};

/// Kinds of records.
enum class McapOp : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kAttachment = 0x09,
  kAttachmentIndex = 0x0A,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

/// Records that a later version may have added, or that are a program's own.
constexpr bool is_foreign(McapOp op) {
  return op > McapOp::kDataEnd;
}

/// Bytes before a record's content: its kind and the length of the content.
inline constexpr std::uint64_t kMcapRecordHead = 9;
/// Bytes of a footer's content.
inline constexpr std::uint64_t kMcapFooterBytes = 20;

using McapEntries = std::vector<std::pair<std::string, std::string>>;

struct McapHeader {
  std::string profile;  ///< what the file promises of its channels
  std::string library;  ///< which program wrote it
  static constexpr McapOp kOp = McapOp::kHeader;
  static constexpr auto kFields = std::tuple(&McapHeader::profile, &McapHeader::library);
  bool operator==(const McapHeader&) const = default;
};

struct McapFooter {
  std::uint64_t summary_start = 0;         ///< 0: there is no summary
  std::uint64_t summary_offset_start = 0;  ///< 0: there are no summary offsets
  std::uint32_t summary_crc = 0;           ///< 0: not known
  static constexpr McapOp kOp = McapOp::kFooter;
  static constexpr auto kFields =
      std::tuple(&McapFooter::summary_start, &McapFooter::summary_offset_start, &McapFooter::summary_crc);
};

/// How the messages of channels look.
struct McapSchema {
  std::uint16_t id = 0;  ///< not 0
  std::string name;
  std::string encoding;
  std::string data;
  static constexpr McapOp kOp = McapOp::kSchema;
  static constexpr auto kFields =
      std::tuple(&McapSchema::id, &McapSchema::name, &McapSchema::encoding, &McapSchema::data);
  bool operator==(const McapSchema&) const = default;
};

/// A stream of messages.
struct McapChannel {
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;  ///< 0: none
  std::string topic;
  std::string encoding;  ///< of the messages
  McapEntries metadata;
  static constexpr McapOp kOp = McapOp::kChannel;
  static constexpr auto kFields = std::tuple(&McapChannel::id, &McapChannel::schema_id, &McapChannel::topic,
                                             &McapChannel::encoding, &McapChannel::metadata);
  bool operator==(const McapChannel&) const = default;
};

struct McapMessage {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time_ns = 0;
  std::uint64_t publish_time_ns = 0;
  std::string_view data;
  static constexpr McapOp kOp = McapOp::kMessage;
  static constexpr auto kFields =
      std::tuple(&McapMessage::channel_id, &McapMessage::sequence, &McapMessage::log_time_ns,
                 &McapMessage::publish_time_ns, McapRest{&McapMessage::data});
};

struct McapChunk {
  std::uint64_t start_time_ns = 0;
  std::uint64_t end_time_ns = 0;
  std::uint64_t uncompressed_size = 0;
  std::uint32_t uncompressed_crc = 0;  ///< 0: not known
  std::string compression;             ///< "zstd", "lz4" or "" for none
  std::string_view records;
  static constexpr McapOp kOp = McapOp::kChunk;
  static constexpr auto kFields =
      std::tuple(&McapChunk::start_time_ns, &McapChunk::end_time_ns, &McapChunk::uncompressed_size,
                 &McapChunk::uncompressed_crc, &McapChunk::compression, &McapChunk::records);
};

/// Where the messages of one channel stand in a chunk.
struct McapMessageIndex {
  std::uint16_t channel_id = 0;
  std::vector<std::pair<std::uint64_t, std::uint64_t>>
      entries;  ///< log time, offset in the uncompressed records
  static constexpr McapOp kOp = McapOp::kMessageIndex;
  static constexpr auto kFields = std::tuple(&McapMessageIndex::channel_id, &McapMessageIndex::entries);
};

struct McapChunkIndex {
  std::uint64_t start_time_ns = 0;
  std::uint64_t end_time_ns = 0;
  std::uint64_t offset = 0;
  std::uint64_t length = 0;                                              ///< with its head
  std::vector<std::pair<std::uint16_t, std::uint64_t>> message_indices;  ///< channel, offset in the file
  std::uint64_t message_indices_length = 0;
  std::string compression;
  std::uint64_t compressed_size = 0;
  std::uint64_t uncompressed_size = 0;
  static constexpr McapOp kOp = McapOp::kChunkIndex;
  static constexpr auto kFields = std::tuple(
      &McapChunkIndex::start_time_ns, &McapChunkIndex::end_time_ns, &McapChunkIndex::offset,
      &McapChunkIndex::length, &McapChunkIndex::message_indices, &McapChunkIndex::message_indices_length,
      &McapChunkIndex::compression, &McapChunkIndex::compressed_size, &McapChunkIndex::uncompressed_size);
};

/// A file within the log.
struct McapAttachment {
  std::uint64_t log_time_ns = 0;
  std::uint64_t create_time_ns = 0;
  std::string name;
  std::string media_type;
  std::string_view data;
  static constexpr McapOp kOp = McapOp::kAttachment;
  static constexpr auto kFields =
      std::tuple(&McapAttachment::log_time_ns, &McapAttachment::create_time_ns, &McapAttachment::name,
                 &McapAttachment::media_type, &McapAttachment::data);
};

struct McapAttachmentIndex {
  std::uint64_t offset = 0;
  std::uint64_t length = 0;  ///< with its head
  std::uint64_t log_time_ns = 0;
  std::uint64_t create_time_ns = 0;
  std::uint64_t data_size = 0;
  std::string name;
  std::string media_type;
  static constexpr McapOp kOp = McapOp::kAttachmentIndex;
  static constexpr auto kFields = std::tuple(
      &McapAttachmentIndex::offset, &McapAttachmentIndex::length, &McapAttachmentIndex::log_time_ns,
      &McapAttachmentIndex::create_time_ns, &McapAttachmentIndex::data_size, &McapAttachmentIndex::name,
      &McapAttachmentIndex::media_type);
};

struct McapStatistics {
  std::uint64_t messages = 0;
  std::uint16_t schemas = 0;
  std::uint32_t channels = 0;
  std::uint32_t attachments = 0;
  std::uint32_t metadata = 0;
  std::uint32_t chunks = 0;
  std::uint64_t start_time_ns = 0;
  std::uint64_t end_time_ns = 0;
  std::vector<std::pair<std::uint16_t, std::uint64_t>> channel_messages;
  static constexpr McapOp kOp = McapOp::kStatistics;
  static constexpr auto kFields = std::tuple(
      &McapStatistics::messages, &McapStatistics::schemas, &McapStatistics::channels,
      &McapStatistics::attachments, &McapStatistics::metadata, &McapStatistics::chunks,
      &McapStatistics::start_time_ns, &McapStatistics::end_time_ns, &McapStatistics::channel_messages);
};

/// Named facts.
struct McapMetadata {
  std::string name;
  McapEntries entries;
  static constexpr McapOp kOp = McapOp::kMetadata;
  static constexpr auto kFields = std::tuple(&McapMetadata::name, &McapMetadata::entries);
  bool operator==(const McapMetadata&) const = default;
};

struct McapMetadataIndex {
  std::uint64_t offset = 0;
  std::uint64_t length = 0;  ///< with its head
  std::string name;
  static constexpr McapOp kOp = McapOp::kMetadataIndex;
  static constexpr auto kFields =
      std::tuple(&McapMetadataIndex::offset, &McapMetadataIndex::length, &McapMetadataIndex::name);
};

struct McapSummaryOffset {
  McapOp group = McapOp::kSchema;
  std::uint64_t start = 0;
  std::uint64_t length = 0;
  static constexpr McapOp kOp = McapOp::kSummaryOffset;
  static constexpr auto kFields =
      std::tuple(&McapSummaryOffset::group, &McapSummaryOffset::start, &McapSummaryOffset::length);
};

struct McapDataEnd {
  std::uint32_t data_crc = 0;  ///< of everything before this record; 0: not known
  static constexpr McapOp kOp = McapOp::kDataEnd;
  static constexpr auto kFields = std::tuple(&McapDataEnd::data_crc);
};

/// What stands before a record's content.
struct McapRecordHead {
  McapOp op = McapOp::kHeader;
  std::uint64_t length = 0;  ///< of the content
  static constexpr auto kFields = std::tuple(&McapRecordHead::op, &McapRecordHead::length);
};

/// Appends a whole record to `out`. A text of 4 GiB or more throws Error{kInternal}.
template <typename Record>
void append_record(std::string& out, const Record& record) {
  McapFieldWriter to(out);
  to.put(Record::kOp);
  to.put_sized<std::uint64_t>([&] { to.put_fields(record); });
}
/// With its check sum.
void append_record(std::string& out, const McapAttachment& attachment);

/// Throws Error{kBadInput} for a record that ends too early.
[[noreturn]] void refuse_record(const BadBytes& bad);

/// Reads the content of a record, without its head, or a head; `data` and `records` lead into `content`. Fields that a later version may have
/// added at the end are passed over. Throws Error{kBadInput} with the cause alone; an attachment whose CRC is given and wrong, and a footer of
/// another length, are such a cause.
template <typename Record>
Record parse_record(std::string_view content) {
  Record record;
  try {
    McapFieldReader(content).get_fields(record);
  } catch (const BadBytes& bad) {
    refuse_record(bad);
  }
  return record;
}
template <>
McapFooter parse_record(std::string_view content);
template <>
McapAttachment parse_record(std::string_view content);

}  // namespace hallway::log
