// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hallway::log {

// The records of the MCAP container, version 0 (https://mcap.dev/spec): what they hold, and their bytes. Whole numbers
// are little-endian; a text is its length (u32) and its bytes.

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
constexpr bool is_foreign(std::uint8_t op) {
  return op > static_cast<std::uint8_t>(McapOp::kDataEnd);
}

/// Bytes before a record's content: its kind and the length of the content.
inline constexpr std::uint64_t kMcapRecordHead = 9;
/// Bytes of a footer's content.
inline constexpr std::uint64_t kMcapFooterBytes = 20;

using McapEntries = std::vector<std::pair<std::string, std::string>>;

struct McapHeader {
  std::string profile;  ///< what the file promises of its channels
  std::string library;  ///< which program wrote it
  bool operator==(const McapHeader&) const = default;
};

struct McapFooter {
  std::uint64_t summary_start = 0;         ///< 0: there is no summary
  std::uint64_t summary_offset_start = 0;  ///< 0: there are no summary offsets
  std::uint32_t summary_crc = 0;           ///< 0: not known
};

/// How the messages of channels look.
struct McapSchema {
  std::uint16_t id = 0;  ///< not 0
  std::string name;
  std::string encoding;
  std::string data;
  bool operator==(const McapSchema&) const = default;
};

/// A stream of messages.
struct McapChannel {
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;  ///< 0: none
  std::string topic;
  std::string encoding;  ///< of the messages
  McapEntries metadata;
  bool operator==(const McapChannel&) const = default;
};

struct McapMessage {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time_ns = 0;
  std::uint64_t publish_time_ns = 0;
  std::string_view data;
};

struct McapChunk {
  std::uint64_t start_time_ns = 0;
  std::uint64_t end_time_ns = 0;
  std::uint64_t uncompressed_size = 0;
  std::uint32_t uncompressed_crc = 0;  ///< 0: not known
  std::string compression;             ///< "zstd", "lz4" or "" for none
  std::string_view records;
};

/// Where the messages of one channel stand in a chunk.
struct McapMessageIndex {
  std::uint16_t channel_id = 0;
  std::vector<std::pair<std::uint64_t, std::uint64_t>>
      entries;  ///< log time, offset in the uncompressed records
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
};

/// A file within the log.
struct McapAttachment {
  std::uint64_t log_time_ns = 0;
  std::uint64_t create_time_ns = 0;
  std::string name;
  std::string media_type;
  std::string_view data;
};

struct McapAttachmentIndex {
  std::uint64_t offset = 0;
  std::uint64_t length = 0;  ///< with its head
  std::uint64_t log_time_ns = 0;
  std::uint64_t create_time_ns = 0;
  std::uint64_t data_size = 0;
  std::string name;
  std::string media_type;
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
};

/// Named facts.
struct McapMetadata {
  std::string name;
  McapEntries entries;
  bool operator==(const McapMetadata&) const = default;
};

struct McapMetadataIndex {
  std::uint64_t offset = 0;
  std::uint64_t length = 0;  ///< with its head
  std::string name;
};

struct McapSummaryOffset {
  McapOp group = McapOp::kSchema;
  std::uint64_t start = 0;
  std::uint64_t length = 0;
};

struct McapDataEnd {
  std::uint32_t data_crc = 0;  ///< of everything before this record; 0: not known
};

/// Each appends a whole record to `out`. A text of 4 GiB or more throws Error{kInternal}.
void append_record(std::string& out, const McapHeader& header);
void append_record(std::string& out, const McapFooter& footer);
void append_record(std::string& out, const McapSchema& schema);
void append_record(std::string& out, const McapChannel& channel);
void append_record(std::string& out, const McapMessage& message);
void append_record(std::string& out, const McapChunk& chunk);
void append_record(std::string& out, const McapMessageIndex& index);
void append_record(std::string& out, const McapChunkIndex& index);
void append_record(std::string& out, const McapAttachment& attachment);
void append_record(std::string& out, const McapAttachmentIndex& index);
void append_record(std::string& out, const McapStatistics& statistics);
void append_record(std::string& out, const McapMetadata& metadata);
void append_record(std::string& out, const McapMetadataIndex& index);
void append_record(std::string& out, const McapSummaryOffset& offset);
void append_record(std::string& out, const McapDataEnd& end);

/// Each reads the content of a record, without its head; `data` and `records` lead into `content`. Fields that a later
/// version may have added at the end are passed over. Throws Error{kBadInput} with the cause alone; an attachment whose
/// CRC is given and wrong is such a cause.
void parse_record(std::string_view content, McapHeader& header);
void parse_record(std::string_view content, McapFooter& footer);
void parse_record(std::string_view content, McapSchema& schema);
void parse_record(std::string_view content, McapChannel& channel);
void parse_record(std::string_view content, McapMessage& message);
void parse_record(std::string_view content, McapChunk& chunk);
void parse_record(std::string_view content, McapMessageIndex& index);
void parse_record(std::string_view content, McapAttachment& attachment);
void parse_record(std::string_view content, McapStatistics& statistics);
void parse_record(std::string_view content, McapChunkIndex& index);
void parse_record(std::string_view content, McapAttachmentIndex& index);
void parse_record(std::string_view content, McapMetadataIndex& index);
void parse_record(std::string_view content, McapMetadata& metadata);
void parse_record(std::string_view content, McapDataEnd& end);

/// The head of a record, from its 9 bytes.
struct McapRecordHead {
  std::uint8_t op = 0;
  std::uint64_t length = 0;  ///< of the content
};
McapRecordHead parse_record_head(std::string_view head);

}  // namespace hallway::log
