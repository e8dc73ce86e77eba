// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <set>

#include "log/byte_io.hpp"
#include "log/mcap_records.hpp"

namespace hallway::log {

/// How a log is cut into chunks.
struct McapWriterOptions {
  bool compress = true;                          ///< chunks, with Zstandard
  std::uint64_t chunk_bytes = 1u << 20;          ///< a chunk with this many bytes before compression ends
  std::uint64_t chunk_time_ns = 1'000'000'000u;  ///< and before it would span more than this of log time
};

/// A chunk ends where the log time changes, so that what belongs to one moment is kept or lost together; but one with this
/// many times McapWriterOptions::chunk_bytes ends anyway.
inline constexpr std::uint64_t kMaxChunkFactor = 16;

/// Largest message or attachment that is written and read, in bytes.
inline constexpr std::uint64_t kMaxMcapMessageBytes = 128u << 20;

/// Writes an MCAP file: chunks with their check sums and message indices, then a summary with statistics and an index of
/// all chunks. A chunk reaches the output as soon as it ends: what is lost when the program is killed is the chunk under way
/// and the summary, which copy_mcap() makes again. The same calls give the same bytes.
class McapWriter {
 public:
  /// Writes the head of the file. Keeps a reference to `output`. Throws Error{kIo}, as all that write do.
  McapWriter(ByteOutput& output, const McapHeader& header, const McapWriterOptions& options = {});
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  /// Makes a schema known. Throws Error{kInternal} if its id is 0 or is in use.
  void add(const McapSchema& schema);
  /// Makes a channel known. Throws Error{kInternal} if its id is in use or its schema is not known.
  void add(const McapChannel& channel);
  /// Adds a message. Throws Error{kInternal} if its channel is not known, Error{kBadInput} if it is too large.
  void add(const McapMessage& message);
  /// Adds an attachment, at once. Throws Error{kBadInput} if it is too large.
  void add(const McapAttachment& attachment);
  /// Adds facts, at once.
  void add(const McapMetadata& metadata);

  /// Has the output keep what is in the chunk under way (ByteOutput::keep), so that it is not lost if the program ends before the chunk does: as
  /// small chunks of their own, which follow what was written.
  void keep_chunk();
  /// Ends the chunk under way, if there is one.
  void end_chunk();
  /// Writes what is left and the summary, and closes the output. Nothing can be added after it.
  void finish();

 private:
  struct OpenChunk {
    std::string records;
    std::map<std::uint16_t, McapMessageIndex> indices;
    std::uint64_t start_time_ns = 0;
    std::uint64_t end_time_ns = 0;
    std::uint64_t last_time_ns = 0;
    std::uint64_t messages = 0;
    std::size_t kept = 0;  ///< bytes of `records` that the output keeps
  };

  void write(std::string_view bytes);
  bool ends_before(const McapMessage& message) const;
  void count(const McapMessage& message);
  std::string chunk_record(std::string_view records, const char* compression, std::string_view packed) const;
  template <typename Record>
  void write_group(const std::vector<Record>& records);

  ByteOutput& output_;
  McapWriterOptions options_;
  std::uint64_t at_ = 0;   ///< bytes written
  std::uint32_t crc_ = 0;  ///< of what was written, from the start or from the summary's
  OpenChunk chunk_;
  std::map<std::uint16_t, McapSchema> schemas_;
  std::map<std::uint16_t, McapChannel> channels_;
  std::map<std::uint16_t, std::uint64_t> channel_messages_;
  std::vector<McapChunkIndex> chunk_indices_;
  std::vector<McapAttachmentIndex> attachment_indices_;
  std::vector<McapMetadataIndex> metadata_indices_;
  std::vector<McapSummaryOffset> groups_;
  McapStatistics statistics_;
};

}  // namespace hallway::log
