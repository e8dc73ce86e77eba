// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "log/compression.hpp"
#include "log/mcap_chunk.hpp"
#include "log/mcap_copy.hpp"
#include "log/mcap_index.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"
#include "unit/log/mcap_fixtures.hpp"

namespace hallway::log {
namespace {

using test::read_back;
using test::ReadBack;
using test::small_log;

constexpr std::uint32_t kMessages = 30;
/// Messages of both channels of a whole small_log().
constexpr std::size_t kAllMessages = 39;

bool begins_with(const std::vector<std::string>& whole, const std::vector<std::string>& part) {
  return part.size() <= whole.size() && std::equal(part.begin(), part.end(), whole.begin());
}

/// The items of one kind, in their order.
std::vector<std::string> only(const ReadBack& log, const std::string& kind) {
  std::vector<std::string> found;
  for (const std::string& item : log.items) {
    if (item.starts_with(kind)) found.push_back(item);
  }
  return found;
}

TEST(Crc32, IsThatOfZip) {
  EXPECT_EQ(crc32("123456789"), 0xCBF43926u);  // the check value of CRC-32/ISO-HDLC
  EXPECT_EQ(crc32("6789", crc32("12345")), 0xCBF43926u);
}

TEST(Zstd, GivesBackWhatWasCompressedAndNothingElse) {
  std::string text(10'000'000, 'x');
  for (std::size_t i = 0; i < text.size(); i += 7) text[i] = static_cast<char>(i * i);
  const std::string packed = compress_zstd(text);
  EXPECT_LT(packed.size(), text.size());
  EXPECT_EQ(decompress_zstd(packed, text.size()), text);
  EXPECT_EQ(decompress_zstd(compress_zstd(""), 0), "");
  EXPECT_TRUE(hallway::test::error_of([&] { decompress_zstd(packed, text.size() - 1); }));
  EXPECT_TRUE(hallway::test::error_of([&] { decompress_zstd(packed, text.size() + 1); }));
  EXPECT_TRUE(
      hallway::test::error_of([&] { decompress_zstd(packed.substr(0, packed.size() / 2), text.size()); }));
  EXPECT_TRUE(hallway::test::error_of([&] { decompress_zstd("no frame", 8); }));
}

TEST(Mcap, GivesBackWhatWasWritten) {
  for (const bool compress : {true, false}) {
    const ReadBack log = read_back(small_log({.compress = compress}));
    EXPECT_FALSE(log.damage) << log.damage->cause;
    EXPECT_EQ(log.messages, kAllMessages);
    ASSERT_EQ(only(log, "message 7").size(), kMessages);
    EXPECT_EQ(only(log, "message 7")[2], "message 7 2 200000000 200000001 message 2");
    EXPECT_EQ(only(log, "message 2")[0], "message 2 3 300000000 300000000 {}");
    EXPECT_EQ(only(log, "metadata"), std::vector<std::string>{"metadata factsb=2a="});
    EXPECT_EQ(only(log, "attachment"), std::vector<std::string>{"attachment note.txttext/plain12a note"});
    EXPECT_EQ(only(log, "schema"), std::vector<std::string>{"schema 1thingx-thingab"});
    EXPECT_EQ(only(log, "channel").size(), 2u);
  }
}

TEST(Mcap, SameCallsSameBytes) {
  EXPECT_EQ(small_log(), small_log());
}

TEST(Mcap, AnEmptyLogIsWhole) {
  StringOutput out;
  McapWriter(out, {.profile = "", .library = ""}).finish();
  const ReadBack log = read_back(out.text());
  EXPECT_FALSE(log.damage) << log.damage->cause;
  EXPECT_TRUE(log.items.empty());
}

TEST(Mcap, AChunkSpansASecondAtMostAndKeepsAMomentTogether) {
  const std::string bytes = small_log({.chunk_bytes = 30, .chunk_time_ns = 1'000'000'000});
  const MemoryInput input(bytes);
  McapReader each_moment(input);
  while (each_moment.next() != nullptr) continue;
  EXPECT_EQ(each_moment.chunks(), kMessages) << "one for each time, though two channels share some";
  const std::string by_time = small_log({.chunk_bytes = 1 << 20, .chunk_time_ns = 1'000'000'000});
  const MemoryInput seconds(by_time);
  McapReader each_second(seconds);
  while (each_second.next() != nullptr) continue;
  EXPECT_EQ(each_second.chunks(), 3u) << "3 s of log time";
}

TEST(Mcap, AMessageThatIsALittleLateEndsNoChunk) {
  StringOutput out;
  McapWriter writer(out, {}, {.chunk_bytes = 30, .chunk_time_ns = 1'000'000'000});
  writer.add(McapChannel{.id = 1, .schema_id = 0, .topic = "a", .encoding = "", .metadata = {}});
  const std::string data(100, 'x');
  constexpr std::uint64_t kTenth_ns = 100'000'000;
  for (std::uint64_t moment = 1; moment <= 5; ++moment) {
    for (const std::uint64_t before : {std::uint64_t{0}, kTenth_ns / 2, kTenth_ns / 4, std::uint64_t{0}})
      writer.add(McapMessage{.channel_id = 1, .log_time_ns = moment * kTenth_ns - before, .data = data});
  }
  writer.finish();
  const MemoryInput input(out.text());
  McapReader reader(input);
  while (reader.next() != nullptr) continue;
  EXPECT_FALSE(reader.damage());
  EXPECT_EQ(reader.chunks(), 5u) << "one for each moment, with what is late in it";
}

TEST(Mcap, WhatIsNoMcapFileIsAnErrorAndNotDamage) {
  for (const std::string text : {"", "\x89", "iteration,x,y,z\n0,1,2,3\n", "\x89MCAP1\r\n"}) {
    const auto error = hallway::test::error_of([&] { read_back(text); });
    ASSERT_TRUE(error) << text;
    EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  }
}

TEST(Mcap, EveryFlippedBitIsFound) {
  for (const bool compress : {true, false}) {
    const McapWriterOptions options{.compress = compress, .chunk_bytes = 100};
    const std::string whole = small_log(options, 6);
    const ReadBack good = read_back(whole);
    ASSERT_FALSE(good.damage);
    for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
      std::string bytes = whole;
      bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << (bit % 8)));
      const auto error = hallway::test::error_of([&] {
        const ReadBack log = read_back(bytes);
        EXPECT_TRUE(log.damage) << "bit " << bit;
        EXPECT_TRUE(begins_with(only(good, "message"), only(log, "message"))) << "bit " << bit;
      });
      if (error) {
        EXPECT_LT(bit, 8 * kMcapMagic.size()) << error->what();
      }
    }
  }
}

TEST(Mcap, CutAtAnyByteGivesTheChunksBeforeTheCut) {
  const std::string whole = small_log({.chunk_bytes = 100}, 12);
  const ReadBack good = read_back(whole);
  std::size_t before = 0;
  for (std::size_t size = kMcapMagic.size(); size < whole.size(); ++size) {
    const ReadBack log = read_back(whole.substr(0, size));
    ASSERT_TRUE(log.damage) << size;
    EXPECT_LE(log.damage->offset, size);
    EXPECT_TRUE(begins_with(good.items, log.items)) << size;
    EXPECT_GE(log.items.size(), before) << "more bytes, no fewer items";
    before = log.items.size();
  }
  EXPECT_EQ(before, good.items.size());
}

TEST(Mcap, ACopyOfADamagedLogIsWholeAndHasWhatWasBeforeTheDamage) {
  const std::string whole = small_log({.chunk_bytes = 100}, 12);
  for (std::size_t size = kMcapMagic.size(); size <= whole.size(); size += 5) {
    const std::string cut = whole.substr(0, size);
    const ReadBack kept = read_back(cut);
    const MemoryInput input(cut);
    StringOutput out;
    const McapCopy copy = copy_mcap(input, out);
    EXPECT_EQ(copy.damage.has_value(), kept.damage.has_value());
    EXPECT_EQ(copy.messages, kept.messages);
    const ReadBack again = read_back(out.text());
    EXPECT_FALSE(again.damage) << size << ": " << again.damage->cause;
    EXPECT_EQ(only(again, "message"), only(kept, "message"));
    EXPECT_EQ(again.items.size(), kept.items.size());
  }
}

/// Messages 9 to 20 of channel /a, and all of channel /b.
McapSpan middle() {
  return {.from_ns = 900'000'000,
          .to_ns = 2'000'000'000,
          .is_of_whole_log = [](const McapChannel& channel) { return channel.topic == "/b"; },
          .wanted = [](const McapChannel&, const McapMessage&) { return true; }};
}

TEST(Mcap, ASpanIsTheSameByTheIndexAndWithoutIt) {
  const std::string whole = small_log({.chunk_bytes = 100});
  const std::string without = whole.substr(0, whole.size() - kMcapMagic.size());
  for (const std::string& bytes : {whole, without}) {
    const MemoryInput input(bytes);
    StringOutput out;
    const McapCopy copy = copy_mcap_span(input, out, middle());
    EXPECT_EQ(copy.messages, 12u + 9u);
    EXPECT_EQ(copy.left_out, kAllMessages - copy.messages);
    EXPECT_EQ(copy.damage.has_value(), bytes == without);
    const ReadBack part = read_back(out.text());
    EXPECT_FALSE(part.damage);
    EXPECT_EQ(only(part, "message 7").size(), 12u);
    EXPECT_EQ(only(part, "message 7").front(), "message 7 9 900000000 900000001 message 9");
    EXPECT_EQ(only(part, "message 2").size(), 9u);
    EXPECT_EQ(only(part, "attachment").size(), 1u);
    EXPECT_EQ(only(part, "metadata").size(), 1u);
  }
}

TEST(Mcap, DamageWithinASpanEndsItsCopyThere) {
  std::string bytes = small_log({.compress = false, .chunk_bytes = 100});
  const std::size_t at = bytes.find("message 15");
  bytes[at] = 'M';
  const MemoryInput input(bytes);
  StringOutput out;
  const McapCopy copy = copy_mcap_span(input, out, middle());
  ASSERT_TRUE(copy.damage);
  EXPECT_LT(copy.damage->offset, at);
  const ReadBack part = read_back(out.text());
  EXPECT_FALSE(part.damage);
  ASSERT_FALSE(only(part, "message 7").empty());
  EXPECT_EQ(only(part, "message 7").front(), "message 7 9 900000000 900000001 message 9");
  EXPECT_LE(only(part, "message 7").size(), 6u);
}

TEST(Mcap, ASizeThatLiesTakesNoMemory) {
  // A chunk of a few bytes that says it holds 200 MiB: the reader stops at what is really there.
  StringOutput out;
  out.write(kMcapMagic);
  std::string records;
  append_record(records, McapHeader{});
  const std::string packed = compress_zstd("x");
  append_record(records, McapChunk{0, 0, 200u << 20, 0, "zstd", packed});
  out.write(records);
  const ReadBack log = read_back(out.text());
  ASSERT_TRUE(log.damage);
  EXPECT_EQ(log.damage->cause, "zstd: 1 bytes instead of 209715200");
  // A record that says it is as long as the address space.
  std::string endless(kMcapMagic);
  append_record(endless, McapHeader{});
  endless += std::string("\x06\xff\xff\xff\xff\xff\xff\xff\xff", 9);
  EXPECT_NE(read_back(endless).damage->cause.find("of which 0 are there"), std::string::npos);
}

TEST(Mcap, StatisticsThatDoNotMatchAreDamage) {
  std::string bytes(kMcapMagic);
  append_record(bytes, McapHeader{});
  append_record(bytes, McapDataEnd{});
  McapStatistics wrong;
  wrong.messages = 3;
  const std::uint64_t summary = bytes.size();
  append_record(bytes, wrong);
  append_record(bytes, McapFooter{.summary_start = summary});
  bytes += kMcapMagic;
  const ReadBack log = read_back(bytes);
  ASSERT_TRUE(log.damage);
  EXPECT_EQ(log.damage->cause, "the statistics speak of 3 messages; there are 0");
  EXPECT_EQ(log.damage->offset, summary);
}

TEST(McapIndex, GivesTheSameMessagesAsReadingOn) {
  for (const bool compress : {true, false}) {
    const std::string bytes = small_log({.compress = compress, .chunk_bytes = 100});
    const MemoryInput input(bytes);
    const McapIndex index = read_mcap_index(input);
    std::vector<std::string> messages;
    for (const McapChunkIndex& chunk : index.chunks) {
      std::uint64_t in_chunk = 0;
      read_indexed_chunk(input, chunk, [&](const McapMessage& message) {
        EXPECT_GE(message.log_time_ns, chunk.start_time_ns);
        EXPECT_LE(message.log_time_ns, chunk.end_time_ns);
        messages.push_back(test::text_of(message));
        ++in_chunk;
      });
      EXPECT_GT(in_chunk, 0u);
    }
    EXPECT_EQ(messages, only(read_back(bytes), "message"));
    EXPECT_EQ(index.statistics.messages, kAllMessages);
    EXPECT_EQ(index.statistics.chunks, index.chunks.size());
    EXPECT_EQ(index.statistics.start_time_ns, 0u);
    EXPECT_EQ(index.statistics.end_time_ns, 2'900'000'000u);
    EXPECT_EQ(index.channels.at(7).topic, "/a");
    EXPECT_EQ(index.schemas.at(1).name, "thing");
    ASSERT_EQ(index.metadata.size(), 1u);
    ASSERT_EQ(index.attachments.size(), 1u);
    // The offsets lead to the records themselves.
    const auto facts = parse_record<McapMetadata>(std::string_view(bytes).substr(
        index.metadata[0].offset + kMcapRecordHead, index.metadata[0].length - kMcapRecordHead));
    EXPECT_EQ(facts.name, "facts");
    const auto note = parse_record<McapAttachment>(std::string_view(bytes).substr(
        index.attachments[0].offset + kMcapRecordHead, index.attachments[0].length - kMcapRecordHead));
    EXPECT_EQ(note.data, "a note");
    EXPECT_EQ(index.attachments[0].data_size, note.data.size());
  }
}

TEST(McapIndex, EachMessageStandsWhereItsChunksIndexSays) {
  const std::string bytes = small_log({.compress = false, .chunk_bytes = 100});
  const MemoryInput input(bytes);
  std::size_t found = 0;
  for (const McapChunkIndex& chunk : read_mcap_index(input).chunks) {
    const auto unpacked = parse_record<McapChunk>(
        std::string_view(bytes).substr(chunk.offset + kMcapRecordHead, chunk.length - kMcapRecordHead));
    for (const auto& [channel, offset] : chunk.message_indices) {
      const McapRecordHead head = parse_record<McapRecordHead>(std::string_view(bytes).substr(offset));
      EXPECT_EQ(head.op, McapOp::kMessageIndex);
      const auto messages = parse_record<McapMessageIndex>(
          std::string_view(bytes).substr(offset + kMcapRecordHead, head.length));
      EXPECT_EQ(messages.channel_id, channel);
      for (const auto& [t_ns, at] : messages.entries) {
        std::size_t place = at;
        const auto record = next_chunk_record(unpacked.records, place);
        ASSERT_TRUE(record);
        ASSERT_EQ(record->op, McapOp::kMessage);
        const auto message = parse_record<McapMessage>(record->content);
        EXPECT_EQ(message.log_time_ns, t_ns);
        EXPECT_EQ(message.channel_id, channel);
        ++found;
      }
    }
  }
  EXPECT_EQ(found, kAllMessages);
}

TEST(McapIndex, ADamagedIndexIsAnError) {
  const std::string whole = small_log({.chunk_bytes = 100}, 6);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::string cut = whole.substr(0, size);
    EXPECT_TRUE(hallway::test::error_of([&] { read_mcap_index(MemoryInput(cut)); })) << size;
  }
  const std::size_t summary = whole.rfind("/a") - 100;
  for (std::size_t bit = 8 * summary; bit < 8 * whole.size(); ++bit) {
    std::string bytes = whole;
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << (bit % 8)));
    const MemoryInput input(bytes);
    const auto error = hallway::test::error_of([&] {
      for (const McapChunkIndex& chunk : read_mcap_index(input).chunks)
        read_indexed_chunk(input, chunk, [](const auto&) {});
    });
    if (error) {
      EXPECT_EQ(error->code(), ErrorCode::kBadInput);
    }
  }
}

TEST(FileOutput, WhatWasWrittenStandsBeforeItIsClosed) {
  const hallway::test::TempFolder folder;
  const auto path = folder / "a.mcap";
  FileOutput out(path);
  McapWriter writer(out, {.profile = "", .library = ""}, {.chunk_bytes = 1});
  writer.add(McapChannel{.id = 1, .schema_id = 0, .topic = "/a", .encoding = "json", .metadata = {}});
  for (std::uint64_t t = 0; t < 5; ++t) writer.add(McapMessage{1, 0, t, t, "{}"});
  EXPECT_EQ(read_back(read_file(path)).messages, 4u) << "all but the chunk under way";
  const FileInput input(path);
  EXPECT_EQ(input.size(), std::filesystem::file_size(path));
  EXPECT_TRUE(hallway::test::error_of([&] { FileOutput again(path); })) << "is there already";
}

}  // namespace
}  // namespace hallway::log
