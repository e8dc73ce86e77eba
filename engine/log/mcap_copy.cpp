// SPDX-License-Identifier: MIT
#include "log/mcap_copy.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "log/mcap_index.hpp"

namespace hallway::log {
namespace {

/// The index of a log, if it has a whole one.
std::optional<McapIndex> index_of(const ByteInput& input) {
  try {
    return read_mcap_index(input);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kBadInput) throw;
    return std::nullopt;
  }
}

bool is_wanted(const McapSpan& span, const McapChannel& channel, const McapMessage& message) {
  if (span.is_of_whole_log(channel)) return true;
  return message.log_time_ns >= span.from_ns && message.log_time_ns <= span.to_ns &&
         span.wanted(channel, message);
}

/// Copies what a span needs, by the index.
class SpanCopier {
 public:
  SpanCopier(const ByteInput& input, const McapIndex& index, McapWriter& writer)
      : input_(input), index_(index), writer_(writer) {}

  void copy_facts() {
    for (const auto& [id, schema] : index_.schemas) writer_.add(schema);
    for (const auto& [id, channel] : index_.channels) writer_.add(channel);
    for (const McapMetadataIndex& at : index_.metadata) {
      writer_.add(
          parse_record<McapMetadata>(read_indexed_record(input_, McapOp::kMetadata, at.offset, at.length)));
    }
    for (const McapAttachmentIndex& at : index_.attachments) {
      const std::string content = read_indexed_record(input_, McapOp::kAttachment, at.offset, at.length);
      writer_.add(parse_record<McapAttachment>(content));
    }
  }

  McapCopy copy_messages(const McapSpan& span) {
    McapCopy copy;
    std::uint64_t offset = 0;
    try {
      for (const McapChunkIndex& chunk : index_.chunks) {
        offset = chunk.offset;
        if (!is_needed(chunk, span)) continue;
        read_indexed_chunk(input_, chunk, [&](const McapMessage& message) { take(message, span, copy); });
      }
    } catch (const Error& error) {
      if (error.code() != ErrorCode::kBadInput) throw;
      copy.damage = McapDamage{offset, error.message()};
    }
    copy.left_out = index_.statistics.messages - std::min(copy.messages, index_.statistics.messages);
    return copy;
  }

 private:
  bool is_needed(const McapChunkIndex& chunk, const McapSpan& span) const {
    if (chunk.start_time_ns <= span.to_ns && chunk.end_time_ns >= span.from_ns) return true;
    return std::ranges::any_of(chunk.message_indices, [&](const auto& entry) {
      const auto channel = index_.channels.find(entry.first);
      return channel != index_.channels.end() && span.is_of_whole_log(channel->second);
    });
  }

  void take(const McapMessage& message, const McapSpan& span, McapCopy& copy) {
    const auto channel = index_.channels.find(message.channel_id);
    if (channel == index_.channels.end())
      throw Error(ErrorCode::kBadInput, "a message of a channel that the index does not know");
    if (!is_wanted(span, channel->second, message)) return;
    writer_.add(message);
    ++copy.messages;
  }

  const ByteInput& input_;
  const McapIndex& index_;
  McapWriter& writer_;
};

}  // namespace

McapCopy copy_mcap(const ByteInput& input, ByteOutput& output, const McapFilter& wanted) {
  McapReader reader(input);
  // Nothing is written before the header is known, which is read with the first item.
  const McapItem* item = reader.next();
  McapWriter writer(output, reader.header());
  McapCopy copy;
  for (; item != nullptr; item = reader.next()) {
    const auto* message = std::get_if<McapMessage>(item);
    if (message != nullptr && wanted && !wanted(reader.channels().at(message->channel_id), *message)) {
      ++copy.left_out;
      continue;
    }
    if (message != nullptr) ++copy.messages;
    std::visit([&](const auto& record) { writer.add(record); }, *item);
  }
  writer.finish();
  copy.damage = reader.damage();
  return copy;
}

McapCopy copy_mcap_span(const ByteInput& input, ByteOutput& output, const McapSpan& span) {
  const std::optional<McapIndex> index = index_of(input);
  if (!index) {
    return copy_mcap(input, output, [&span](const McapChannel& channel, const McapMessage& message) {
      return is_wanted(span, channel, message);
    });
  }
  McapReader reader(input);
  reader.next();  // with the first item the header is known
  McapWriter writer(output, reader.header());
  SpanCopier copier(input, *index, writer);
  copier.copy_facts();
  const McapCopy copy = copier.copy_messages(span);
  writer.finish();
  return copy;
}

}  // namespace hallway::log
