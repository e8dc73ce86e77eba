// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "log/mcap_reader.hpp"
#include "log/mcap_writer.hpp"

namespace hallway::log::test {

/// A small log with all kinds of records: two channels, `n` messages 0.1 s apart on the first and every third on the second.
inline std::string small_log(const McapWriterOptions& options = {}, std::uint32_t n = 30) {
  StringOutput out;
  McapWriter writer(out, {.profile = "x-test", .library = "test"}, options);
  writer.add(McapMetadata{.name = "facts", .entries = {{"b", "2"}, {"a", ""}}});
  writer.add(McapSchema{.id = 1, .name = "thing", .encoding = "x-thing", .data = "ab"});
  writer.add(
      McapChannel{.id = 7, .schema_id = 1, .topic = "/a", .encoding = "x-thing", .metadata = {{"k", "v"}}});
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint64_t t = 100'000'000ull * i;
    const std::string data = "message " + std::to_string(i);
    writer.add(McapMessage{
        .channel_id = 7, .sequence = i, .log_time_ns = t, .publish_time_ns = t + 1, .data = data});
    if (i == 3)
      writer.add(McapChannel{.id = 2, .schema_id = 0, .topic = "/b", .encoding = "json", .metadata = {}});
    if (i == 9) writer.add(McapAttachment{1, 2, "note.txt", "text/plain", "a note"});
    if (i % 3 != 0 || i < 3) continue;
    writer.add(
        McapMessage{.channel_id = 2, .sequence = i, .log_time_ns = t, .publish_time_ns = t, .data = "{}"});
  }
  writer.finish();
  return out.text();
}

/// What a log gives, as texts that can be compared, and how its reading ended.
struct ReadBack {
  std::vector<std::string> items;
  std::size_t messages = 0;
  std::optional<McapDamage> damage;
};

inline std::string text_of(const McapSchema& s) {
  return "schema " + std::to_string(s.id) + s.name + s.encoding + s.data;
}
inline std::string text_of(const McapChannel& c) {
  std::string text = "channel " + std::to_string(c.id) + c.topic + c.encoding + std::to_string(c.schema_id);
  for (const auto& [key, value] : c.metadata) text += key + "=" + value;
  return text;
}
inline std::string text_of(const McapMessage& m) {
  return "message " + std::to_string(m.channel_id) + " " + std::to_string(m.sequence) + " " +
         std::to_string(m.log_time_ns) + " " + std::to_string(m.publish_time_ns) + " " + std::string(m.data);
}
inline std::string text_of(const McapAttachment& a) {
  return "attachment " + a.name + a.media_type + std::to_string(a.log_time_ns) +
         std::to_string(a.create_time_ns) + std::string(a.data);
}
inline std::string text_of(const McapMetadata& m) {
  std::string text = "metadata " + m.name;
  for (const auto& [key, value] : m.entries) text += key + "=" + value;
  return text;
}

/// Reads all of a log. Throws what McapReader's constructor throws.
inline ReadBack read_back(const std::string& bytes) {
  const MemoryInput input(bytes);
  McapReader reader(input);
  ReadBack result;
  while (const McapItem* item = reader.next()) {
    result.items.push_back(std::visit([](const auto& record) { return text_of(record); }, *item));
    if (std::holds_alternative<McapMessage>(*item)) ++result.messages;
  }
  result.damage = reader.damage();
  return result;
}

}  // namespace hallway::log::test
