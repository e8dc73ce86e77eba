// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <variant>

#include "log/byte_io.hpp"
#include "log/mcap_records.hpp"

namespace hallway::log {

/// Largest record, and largest chunk when uncompressed, that is read, in bytes. Memory is taken as far as the file or the
/// compressed data really go, never by a number in the file.
inline constexpr std::uint64_t kMaxMcapRecordBytes = 256u << 20;

/// Most bytes of schemas and channels, which are kept while a log is read, and of one metadata record.
inline constexpr std::uint64_t kMaxMcapFactBytes = 16u << 20;

/// Where an MCAP file stops being what it should be.
struct McapDamage {
  std::uint64_t offset = 0;  ///< byte of the record or part that is wrong, from the start of the file
  std::string cause;         ///< what is wrong there, safe to print
};

/// What a reader gives, one after the other. Schemas and channels come once, before they are needed.
using McapItem = std::variant<McapSchema, McapChannel, McapMessage, McapAttachment, McapMetadata>;

/// Reads an MCAP file from its start to its end, or to the first damage. Every byte is looked at: all check sums that the
/// file has are compared, and the summary is checked too. A chunk with a wrong check sum gives nothing. The format allows
/// messages beside chunks; here they count as damage once there was a chunk, because a record whose kind was
/// flipped looks like one and no check sum of its own would tell.
class McapReader {
 public:
  /// Keeps a reference to `input`. Throws Error{kBadInput} if it does not begin as an MCAP file does, Error{kIo}.
  explicit McapReader(const ByteInput& input);
  McapReader(const McapReader&) = delete;
  McapReader& operator=(const McapReader&) = delete;

  /// Known once next() was called, empty before.
  const McapHeader& header() const { return header_; }
  /// The next item, null at the end or at damage. Valid until the next call. Throws Error{kIo}.
  const McapItem* next();
  /// What was found to be wrong; asked after next() gave null. Everything given before stands.
  const std::optional<McapDamage>& damage() const { return damage_; }
  /// Whether the end of the data was reached: what is damaged is at most the summary, or one check sum of the whole.
  bool all_data_read() const { return section_ != Section::kData; }

  /// The channels given so far.
  const std::map<std::uint16_t, McapChannel>& channels() const { return channels_; }
  std::uint64_t chunks() const { return chunks_; }
  /// Where in the file the record stands that the last item came from: itself or its chunk.
  std::uint64_t position() const { return record_; }
  std::uint64_t size() const { return input_.size(); }

 private:
  enum class Section { kData, kSummary, kEnd };

  bool step();
  bool read_from_chunk();
  bool read_from_file();
  bool take_data(McapOp op);
  void take_summary(McapOp op);
  bool take_content(McapOp op, std::string_view content);
  bool add_schema(std::string_view content);
  bool add_channel(std::string_view content);
  void add_message(std::string_view content);
  void open_chunk();
  void check_message_index() const;
  void end_data();
  void check_statistics(std::string_view content) const;
  void check_footer(std::string_view head);
  void count_facts(std::string_view content);
  std::uint64_t messages() const;

  const ByteInput& input_;
  Section section_ = Section::kData;
  std::uint64_t at_ = 0;      ///< in the file: where the next record begins
  std::uint64_t record_ = 0;  ///< in the file: where the one at hand begins, for messages
  std::uint32_t crc_ = 0;     ///< of the data, or of the summary, so far
  std::string head_;
  std::string content_;  ///< of the record at hand
  std::string chunk_;    ///< uncompressed records
  std::size_t chunk_at_ = 0;
  std::uint64_t summary_start_ = 0;
  McapHeader header_;
  McapItem item_;
  std::map<std::uint16_t, McapSchema> schemas_;
  std::map<std::uint16_t, McapChannel> channels_;
  std::map<std::uint16_t, std::uint64_t> counts_;
  std::map<std::uint16_t, std::uint64_t> chunk_counts_;  ///< messages of the last chunk
  bool after_chunk_ = false;  ///< nothing but message indices came since the last chunk
  std::uint64_t chunks_ = 0;
  std::uint64_t attachments_ = 0;
  std::uint64_t metadata_ = 0;
  std::uint64_t fact_bytes_ = 0;
  std::optional<McapDamage> damage_;
};

}  // namespace hallway::log
