// SPDX-License-Identifier: MIT
#include "log/mcap_writer.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "log/compression.hpp"

namespace hallway::log {
namespace {

void require(bool condition, const char* text) {
  if (!condition) throw Error(ErrorCode::kInternal, text);
}

void demand_size(std::uint64_t size, const char* what) {
  if (size <= kMaxMcapMessageBytes) return;
  throw Error(ErrorCode::kBadInput,
              fmt::format("{} of {} bytes; a log takes {}", what, size, kMaxMcapMessageBytes));
}

template <typename T>
std::vector<T> values_of(const std::map<std::uint16_t, T>& items) {
  std::vector<T> values;
  for (const auto& [id, value] : items) values.push_back(value);
  return values;
}

}  // namespace

McapWriter::McapWriter(ByteOutput& output, const McapHeader& header, const McapWriterOptions& options)
    : output_(output), options_(options) {
  std::string head(kMcapMagic);
  append_record(head, header);
  write(head);
}

void McapWriter::write(std::string_view bytes) {
  output_.write(bytes);
  chunk_.kept = 0;
  at_ += bytes.size();
  crc_ = crc32(bytes, crc_);
}

void McapWriter::add(const McapSchema& schema) {
  require(schema.id != 0 && !schemas_.contains(schema.id), "a schema whose id cannot be used");
  append_record(chunk_.records, schema);
  schemas_.emplace(schema.id, schema);
}

void McapWriter::add(const McapChannel& channel) {
  require(!channels_.contains(channel.id), "a channel whose id is in use");
  require(channel.schema_id == 0 || schemas_.contains(channel.schema_id),
          "a channel whose schema is not known");
  append_record(chunk_.records, channel);
  channels_.emplace(channel.id, channel);
  channel_messages_.emplace(channel.id, 0);
}

void McapWriter::add(const McapMessage& message) {
  require(channels_.contains(message.channel_id), "a message whose channel is not known");
  demand_size(message.data.size(), "a message");
  if (ends_before(message)) end_chunk();
  count(message);
  chunk_.indices[message.channel_id].channel_id = message.channel_id;
  chunk_.indices[message.channel_id].entries.emplace_back(message.log_time_ns, chunk_.records.size());
  append_record(chunk_.records, message);
}

bool McapWriter::ends_before(const McapMessage& message) const {
  if (chunk_.messages == 0) return false;
  if (chunk_.records.size() >= kMaxChunkFactor * options_.chunk_bytes) return true;
  // What is a little late belongs to the moment before it: a frame and its truth stay together.
  const bool is_late = message.log_time_ns <= chunk_.end_time_ns &&
                       chunk_.end_time_ns - message.log_time_ns < options_.chunk_time_ns;
  if (message.log_time_ns == chunk_.last_time_ns || is_late) return false;
  const auto [low, high] = std::minmax(message.log_time_ns, chunk_.start_time_ns);
  return chunk_.records.size() >= options_.chunk_bytes || high - low >= options_.chunk_time_ns;
}

void McapWriter::count(const McapMessage& message) {
  const std::uint64_t t = message.log_time_ns;
  chunk_.start_time_ns = chunk_.messages == 0 ? t : std::min(chunk_.start_time_ns, t);
  chunk_.end_time_ns = std::max(chunk_.end_time_ns, t);
  chunk_.last_time_ns = t;
  statistics_.start_time_ns = statistics_.messages == 0 ? t : std::min(statistics_.start_time_ns, t);
  statistics_.end_time_ns = std::max(statistics_.end_time_ns, t);
  ++chunk_.messages;
  ++statistics_.messages;
  ++channel_messages_[message.channel_id];
}

void McapWriter::add(const McapAttachment& attachment) {
  demand_size(attachment.data.size(), "an attachment");
  std::string record;
  append_record(record, attachment);
  attachment_indices_.push_back({.offset = at_,
                                 .length = record.size(),
                                 .log_time_ns = attachment.log_time_ns,
                                 .create_time_ns = attachment.create_time_ns,
                                 .data_size = attachment.data.size(),
                                 .name = attachment.name,
                                 .media_type = attachment.media_type});
  write(record);
}

void McapWriter::add(const McapMetadata& metadata) {
  std::string record;
  append_record(record, metadata);
  metadata_indices_.push_back({.offset = at_, .length = record.size(), .name = metadata.name});
  write(record);
}

std::string McapWriter::chunk_record(std::string_view records, const char* compression,
                                     std::string_view packed) const {
  std::string record;
  append_record(record, McapChunk{.start_time_ns = chunk_.start_time_ns,
                                  .end_time_ns = chunk_.end_time_ns,
                                  .uncompressed_size = records.size(),
                                  .uncompressed_crc = crc32(records),
                                  .compression = compression,
                                  .records = packed});
  return record;
}

void McapWriter::keep_chunk() {
  const std::string_view records = std::string_view(chunk_.records).substr(chunk_.kept);
  if (records.empty()) return;
  output_.keep(chunk_record(records, "", records));
  chunk_.kept = chunk_.records.size();
}

void McapWriter::end_chunk() {
  if (chunk_.records.empty()) return;
  const std::string packed = options_.compress ? compress_zstd(chunk_.records) : chunk_.records;
  const char* compression = options_.compress ? "zstd" : "";
  std::string bytes = chunk_record(chunk_.records, compression, packed);
  McapChunkIndex index{.start_time_ns = chunk_.start_time_ns,
                       .end_time_ns = chunk_.end_time_ns,
                       .offset = at_,
                       .length = bytes.size(),
                       .message_indices = {},
                       .message_indices_length = 0,
                       .compression = compression,
                       .compressed_size = packed.size(),
                       .uncompressed_size = chunk_.records.size()};
  for (auto& [channel, messages] : chunk_.indices) {
    index.message_indices.emplace_back(channel, at_ + bytes.size());
    std::ranges::sort(messages.entries);
    append_record(bytes, messages);
  }
  index.message_indices_length = bytes.size() - index.length;
  chunk_indices_.push_back(std::move(index));
  chunk_ = {};
  write(bytes);
}

template <typename Record>
void McapWriter::write_group(const std::vector<Record>& records) {
  if (records.empty()) return;
  std::string bytes;
  for (const auto& record : records) append_record(bytes, record);
  groups_.push_back({.group = Record::kOp, .start = at_, .length = bytes.size()});
  write(bytes);
}

void McapWriter::finish() {
  end_chunk();
  std::string end;
  append_record(end, McapDataEnd{.data_crc = crc_});
  write(end);
  crc_ = 0;
  McapFooter footer{.summary_start = at_};
  statistics_.schemas = static_cast<std::uint16_t>(schemas_.size());
  statistics_.channels = static_cast<std::uint32_t>(channels_.size());
  statistics_.attachments = static_cast<std::uint32_t>(attachment_indices_.size());
  statistics_.metadata = static_cast<std::uint32_t>(metadata_indices_.size());
  statistics_.chunks = static_cast<std::uint32_t>(chunk_indices_.size());
  statistics_.channel_messages.assign(channel_messages_.begin(), channel_messages_.end());
  write_group(values_of(schemas_));
  write_group(values_of(channels_));
  write_group(std::vector{statistics_});
  write_group(chunk_indices_);
  write_group(attachment_indices_);
  write_group(metadata_indices_);
  footer.summary_offset_start = at_;
  std::string tail;
  for (const McapSummaryOffset& group : groups_) append_record(tail, group);
  append_record(tail, footer);
  tail.resize(tail.size() - sizeof footer.summary_crc);  // covered is all but the check sum itself
  footer.summary_crc = crc32(tail, crc_);
  ByteAppender(tail).put(footer.summary_crc);
  tail += kMcapMagic;
  write(tail);
  output_.close();
}

}  // namespace hallway::log
