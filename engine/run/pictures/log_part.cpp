// SPDX-License-Identifier: MIT
#include "run/pictures/log_part.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "log/mcap_index.hpp"
#include "log/mcap_reader.hpp"
#include "log/unfinished_input.hpp"

namespace hallway::run {
namespace {

/// Gives the messages from one log time to another, of a log with an index.
void read_part(const log::ByteInput& input, const log::McapIndex& index, std::int64_t from_ns,
               std::int64_t to_ns, const MessageSink& sink) {
  for (const log::McapChunkIndex& chunk : index.chunks) {
    if (std::cmp_less(chunk.end_time_ns, from_ns) || std::cmp_greater(chunk.start_time_ns, to_ns)) continue;
    log::read_indexed_chunk(input, chunk, [&](const log::McapMessage& message) {
      if (std::cmp_less(message.log_time_ns, from_ns) || std::cmp_greater(message.log_time_ns, to_ns)) return;
      if (const auto channel = index.channels.find(message.channel_id); channel != index.channels.end())
        sink(channel->second, message);
    });
  }
}

std::optional<log::McapIndex> index_of(const log::ByteInput& input) {
  try {
    return log::read_mcap_index(input);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kBadInput) throw;
    return std::nullopt;
  }
}

void read_in_order(const log::ByteInput& input, std::int64_t from_ns, std::int64_t to_ns,
                   const MessageSink& sink) {
  log::McapReader reader(input);
  while (const log::McapItem* item = reader.next()) {
    const auto* message = std::get_if<log::McapMessage>(item);
    if (message == nullptr || std::cmp_less(message->log_time_ns, from_ns)) continue;
    if (std::cmp_greater(message->log_time_ns, to_ns)) break;
    sink(reader.channels().at(message->channel_id), *message);
  }
}

}  // namespace

void read_messages(const std::filesystem::path& file, std::int64_t from_ns, std::int64_t to_ns,
                   const MessageSink& sink) {
  const log::UnfinishedInput input(file);
  if (const auto index = index_of(input)) return read_part(input, *index, from_ns, to_ns, sink);
  read_in_order(input, from_ns, to_ns, sink);
}

void read_topic(const std::filesystem::path& file, std::string_view topic, const MessageSink& sink) {
  constexpr std::int64_t kEnd_ns = std::numeric_limits<std::int64_t>::max();
  const MessageSink of_topic = [&](const log::McapChannel& channel, const log::McapMessage& message) {
    if (channel.topic == topic) sink(channel, message);
  };
  const log::UnfinishedInput input(file);
  const auto index = index_of(input);
  if (!index) return read_in_order(input, 0, kEnd_ns, of_topic);
  const bool is_there =
      std::ranges::any_of(index->channels, [&](const auto& entry) { return entry.second.topic == topic; });
  if (is_there) read_part(input, *index, 0, kEnd_ns, of_topic);
}

}  // namespace hallway::run
