// SPDX-License-Identifier: MIT
// A log whose program has ended before it closed it: what was kept is read, whatever the moment.
#include "log/unfinished_input.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "log/mcap_reader.hpp"
#include "log/mcap_writer.hpp"
#include "support/temp_folder.hpp"

namespace hallway::log {
namespace {

namespace fs = std::filesystem;

/// The texts of all messages that can be read.
std::vector<std::string> messages_of(const ByteInput& input) {
  std::vector<std::string> texts;
  McapReader reader(input);
  while (const McapItem* item = reader.next()) {
    if (const auto* message = std::get_if<McapMessage>(item)) texts.emplace_back(message->data);
  }
  return texts;
}

/// Both files as they stood at one moment, and how many messages had been kept or written by then.
struct Moment {
  std::string file;
  std::string tail;
  std::size_t safe = 0;
};

class UnfinishedLog : public testing::Test {
 protected:
  /// Writes a log of 40 messages, each kept, with a chunk for every few, and takes down every moment.
  void SetUp() override {
    FileOutput output(path());
    McapWriter writer(output, {.profile = "p", .library = "l"},
                      {.compress = true, .chunk_bytes = 1u << 20, .chunk_time_ns = 7});
    take_down(0);
    for (const std::uint16_t id : {std::uint16_t{1}, std::uint16_t{2}}) {
      writer.add(McapChannel{.id = id, .schema_id = 0, .topic = "t", .encoding = "x", .metadata = {}});
    }
    for (std::uint64_t i = 0; i < 40; ++i) {
      const std::string text = "message " + std::to_string(i);
      all_.push_back(text);
      writer.add(McapMessage{.channel_id = static_cast<std::uint16_t>(1 + i % 2),
                             .sequence = 0,
                             .log_time_ns = i,
                             .publish_time_ns = i,
                             .data = text});
      take_down(i);
      if (i == 20) writer.add(McapMetadata{.name = "in between", .entries = {}});
      writer.keep_chunk();
      take_down(i + 1);
    }
    writer.finish();
    EXPECT_FALSE(fs::exists(tail_path(path())));
  }
  fs::path path() const { return folder_ / "a.mcap"; }
  void take_down(std::size_t safe) {
    std::error_code none;
    const bool kept = fs::exists(tail_path(path()), none);
    moments_.push_back({read_file(path()), kept ? read_file(tail_path(path())) : "", safe});
  }
  std::vector<std::string> read_of(const std::string& file, const std::string& tail) const {
    const fs::path log = folder_ / "b.mcap";
    std::ofstream(log, std::ios::binary) << file;  // unlike TempFolder::write() without waiting for the disk
    std::ofstream(folder_ / "b.mcap.tail", std::ios::binary) << tail;
    return messages_of(UnfinishedInput(log));
  }
  void expect_prefix(const std::vector<std::string>& texts, std::size_t least) const {
    EXPECT_GE(texts.size(), least);
    ASSERT_LE(texts.size(), all_.size());
    EXPECT_TRUE(std::equal(texts.begin(), texts.end(), all_.begin()));
  }

  hallway::test::TempFolder folder_;
  std::vector<std::string> all_;
  std::vector<Moment> moments_;
};

TEST_F(UnfinishedLog, WhatWasKeptIsReadAtEveryMoment) {
  for (const Moment& moment : moments_) expect_prefix(read_of(moment.file, moment.tail), moment.safe);
}

TEST_F(UnfinishedLog, ATailThatIsCutAnywhereIsReadUpToTheCut) {
  const Moment& moment = moments_.at(13);
  ASSERT_GT(moment.tail.size(), 100u);
  for (std::size_t size = 0; size <= moment.tail.size(); ++size) {
    expect_prefix(read_of(moment.file, moment.tail.substr(0, size)), 0);
  }
}

TEST_F(UnfinishedLog, AChunkThatIsHalfWrittenLosesNothingThatWasKept) {
  for (std::size_t i = 1; i < moments_.size(); ++i) {
    const Moment& before = moments_[i - 1];
    const std::string& after = moments_[i].file;
    if (before.tail.empty()) continue;
    for (std::size_t size = before.file.size(); size <= after.size(); size += 5) {
      expect_prefix(read_of(after.substr(0, size), before.tail), before.safe);
    }
  }
}

TEST_F(UnfinishedLog, WhatIsNoTailIsNotRead) {
  const std::string whole = read_file(path());
  for (const std::string tail :
       {"", "x", "HWTAIL1\n", "HWTAIL1\n\xff\xff\xff\xff\xff\xff\xff\xff and more"}) {
    EXPECT_EQ(read_of(whole, tail), all_);
  }
  fs::create_directory(folder_ / "a.mcap.tail");
  EXPECT_EQ(messages_of(UnfinishedInput(path())), all_);
}

}  // namespace
}  // namespace hallway::log
