// SPDX-License-Identifier: MIT
#include "log/mcap_reader.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "log/compression.hpp"
#include "log/mcap_chunk.hpp"

namespace hallway::log {
namespace {

[[noreturn]] void bad_log(std::string cause) {
  throw Error(ErrorCode::kBadInput, std::move(cause));
}

void demand(bool condition, const char* cause) {
  if (!condition) bad_log(cause);
}

}  // namespace

McapReader::McapReader(const ByteInput& input) : input_(input) {
  if (input.size() >= kMcapMagic.size()) input.read(0, kMcapMagic.size(), content_);
  demand(content_ == kMcapMagic, "is no MCAP file: it does not begin with the bytes of one");
  crc_ = crc32(content_);
  at_ = kMcapMagic.size();
}

const McapItem* McapReader::next() {
  try {
    while (section_ != Section::kEnd && !damage_) {
      if (step()) return &item_;
    }
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kBadInput) throw;
    damage_ = McapDamage{record_, error.message()};
  }
  return nullptr;
}

bool McapReader::step() {
  return chunk_at_ < chunk_.size() ? read_from_chunk() : read_from_file();
}

bool McapReader::read_from_chunk() {
  const auto record = next_chunk_record(chunk_, chunk_at_);
  return record && take_content(record->op, record->content);
}

bool McapReader::read_from_file() {
  record_ = at_;
  const std::uint64_t left = input_.size() - at_;
  demand(left > 0, "the file ends without its footer");
  demand(left >= kMcapRecordHead, "the file ends within a record");
  input_.read(at_, kMcapRecordHead, head_);
  const McapRecordHead head = parse_record<McapRecordHead>(head_);
  if (head.length > left - kMcapRecordHead) {
    bad_log(fmt::format("a record of kind {} and {} bytes, of which {} are there", fmt::underlying(head.op),
                        head.length, left - kMcapRecordHead));
  }
  if (head.length > kMaxMcapRecordBytes) {
    bad_log(fmt::format("a record of {} bytes; at most {} are read", head.length, kMaxMcapRecordBytes));
  }
  input_.read(at_ + kMcapRecordHead, head.length, content_);
  at_ += kMcapRecordHead + head.length;
  if (section_ == Section::kData) return take_data(head.op);
  take_summary(head.op);
  return false;
}

bool McapReader::take_data(McapOp op) {
  const bool first = record_ == kMcapMagic.size();
  demand(first == (op == McapOp::kHeader), "a header that is not at the start");
  if (op == McapOp::kDataEnd) {
    end_data();
    return false;
  }
  crc_ = crc32(content_, crc32(head_, crc_));
  if (op == McapOp::kMessageIndex) {
    check_message_index();
    return false;
  }
  after_chunk_ = op == McapOp::kChunk;
  if (op == McapOp::kMessage && chunks_ > 0) bad_log("a message outside of the chunks");
  if (after_chunk_) {
    open_chunk();
    return false;
  }
  if (op == McapOp::kHeader) {
    header_ = parse_record<McapHeader>(content_);
    return false;
  }
  return !is_foreign(op) && take_content(op, content_);
}

bool McapReader::take_content(McapOp op, std::string_view content) {
  switch (op) {
    case McapOp::kSchema:
      return add_schema(content);
    case McapOp::kChannel:
      return add_channel(content);
    case McapOp::kMessage:
      add_message(content);
      return true;
    case McapOp::kAttachment:
      item_ = parse_record<McapAttachment>(content);
      ++attachments_;
      return true;
    case McapOp::kMetadata:
      if (content.size() > kMaxMcapFactBytes) bad_log(fmt::format("metadata of {} bytes", content.size()));
      item_ = parse_record<McapMetadata>(content);
      ++metadata_;
      return true;
    default:
      bad_log(fmt::format("a record of kind {} among the data", fmt::underlying(op)));
  }
}

void McapReader::count_facts(std::string_view content) {
  fact_bytes_ += content.size();
  if (fact_bytes_ > kMaxMcapFactBytes) {
    bad_log(fmt::format("more than {} bytes of schemas and channels", kMaxMcapFactBytes));
  }
}

bool McapReader::add_schema(std::string_view content) {
  if (content.size() > kMaxMcapFactBytes) bad_log(fmt::format("a schema of {} bytes", content.size()));
  const auto& schema = item_.emplace<McapSchema>(parse_record<McapSchema>(content));
  if (schema.id == 0) return false;  // to be ignored, says the format
  const auto [known, is_new] = schemas_.emplace(schema.id, schema);
  if (is_new) count_facts(content);
  if (known->second != schema) bad_log(fmt::format("schema {} a second time, and another one", schema.id));
  return is_new;
}

bool McapReader::add_channel(std::string_view content) {
  if (content.size() > kMaxMcapFactBytes) bad_log(fmt::format("a channel of {} bytes", content.size()));
  const auto& channel = item_.emplace<McapChannel>(parse_record<McapChannel>(content));
  if (channel.schema_id != 0 && !schemas_.contains(channel.schema_id)) {
    bad_log(fmt::format("channel {} with schema {}, which is not known", channel.id, channel.schema_id));
  }
  const auto [known, is_new] = channels_.emplace(channel.id, channel);
  if (is_new) count_facts(content);
  if (known->second != channel) bad_log(fmt::format("channel {} a second time, and another one", channel.id));
  counts_.emplace(channel.id, 0);
  return is_new;
}

void McapReader::add_message(std::string_view content) {
  const auto& message = item_.emplace<McapMessage>(parse_record<McapMessage>(content));
  const auto count = counts_.find(message.channel_id);
  if (count == counts_.end())
    bad_log(fmt::format("a message of channel {}, which is not known", message.channel_id));
  ++count->second;
  ++chunk_counts_[message.channel_id];
}

/// An index is not needed to read on. But where one stands without its chunk, the chunk before it was not recognized.
void McapReader::check_message_index() const {
  demand(after_chunk_, "a message index that does not follow a chunk");
  const auto index = parse_record<McapMessageIndex>(content_);
  const auto count = chunk_counts_.find(index.channel_id);
  const std::uint64_t there = count == chunk_counts_.end() ? 0 : count->second;
  if (index.entries.size() != there) {
    bad_log(fmt::format("an index of {} messages of channel {}; its chunk has {}", index.entries.size(),
                        index.channel_id, there));
  }
}

void McapReader::open_chunk() {
  chunk_.clear();
  chunk_at_ = 0;
  chunk_counts_.clear();
  chunk_ = unpack_chunk(content_);
  ++chunks_;
}

void McapReader::end_data() {
  section_ = Section::kSummary;
  summary_start_ = at_;
  const auto end = parse_record<McapDataEnd>(content_);
  demand(end.data_crc == 0 || end.data_crc == crc_,
         "the check sum of all data is wrong, though each chunk's is right");
  crc_ = 0;
}

void McapReader::take_summary(McapOp op) {
  if (op == McapOp::kFooter) {
    check_footer(head_);
    section_ = Section::kEnd;
    return;
  }
  crc_ = crc32(content_, crc32(head_, crc_));
  switch (op) {
    case McapOp::kStatistics:
      check_statistics(content_);
      return;
    case McapOp::kSchema:
    case McapOp::kChannel:
    case McapOp::kChunkIndex:
    case McapOp::kAttachmentIndex:
    case McapOp::kMetadataIndex:
    case McapOp::kSummaryOffset:
      return;
    default:
      if (!is_foreign(op)) bad_log(fmt::format("a record of kind {} in the summary", fmt::underlying(op)));
  }
}

std::uint64_t McapReader::messages() const {
  std::uint64_t sum = 0;
  for (const auto& [channel, count] : counts_) sum += count;
  return sum;
}

void McapReader::check_statistics(std::string_view content) const {
  const auto said = parse_record<McapStatistics>(content);
  const auto compare = [](const char* what, std::uint64_t claimed, std::uint64_t there) {
    if (claimed != there)
      bad_log(fmt::format("the statistics speak of {} {}; there are {}", claimed, what, there));
  };
  compare("messages", said.messages, messages());
  compare("chunks", said.chunks, chunks_);
  compare("attachments", said.attachments, attachments_);
  compare("metadata records", said.metadata, metadata_);
}

void McapReader::check_footer(std::string_view head) {
  const auto footer = parse_record<McapFooter>(content_);
  const std::string_view covered =
      std::string_view(content_).substr(0, content_.size() - sizeof footer.summary_crc);
  crc_ = crc32(covered, crc32(head, crc_));
  demand(footer.summary_crc == 0 || footer.summary_crc == crc_, "the check sum of the summary is wrong");
  const std::uint64_t start = record_ == summary_start_ ? 0 : summary_start_;
  if (footer.summary_start != start && footer.summary_start != summary_start_) {
    bad_log(fmt::format("the footer says that the summary begins at byte {}", footer.summary_start));
  }
  record_ = at_;
  const std::uint64_t left = input_.size() - at_;
  if (left >= kMcapMagic.size()) input_.read(at_, kMcapMagic.size(), content_);
  demand(left >= kMcapMagic.size() && content_ == kMcapMagic,
         "the file does not end with the bytes of an MCAP file");
  record_ += kMcapMagic.size();
  demand(left == kMcapMagic.size(), "bytes after the end of the log");
}

}  // namespace hallway::log
