// SPDX-License-Identifier: MIT
// The log that a run writes, as Foxglove's own reader sees it.
#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "cli/small_world.hpp"
#include "log/compression.hpp"
#include "log/mcap_copy.hpp"
#include "node/packages.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;

/// "TOPIC MESSAGES BYTES CRC" of each channel with messages, as our reader finds them.
std::vector<std::string> channel_lines(const fs::path& file) {
  struct Counts {
    std::uint64_t messages = 0;
    std::uint64_t bytes = 0;
    std::uint32_t crc = 0;
  };
  std::map<std::string, Counts> channels;
  const log::FileInput input(file);
  log::McapReader reader(input);
  while (const log::McapItem* item = reader.next()) {
    const auto* message = std::get_if<log::McapMessage>(item);
    if (message == nullptr) continue;
    Counts& counts = channels[reader.channels().at(message->channel_id).topic];
    ++counts.messages;
    counts.bytes += message->data.size();
    counts.crc = log::crc32(message->data, counts.crc);
  }
  EXPECT_FALSE(reader.damage());
  std::vector<std::string> lines;
  for (const auto& [topic, c] : channels) {
    lines.push_back(topic + " " + std::to_string(c.messages) + " " + std::to_string(c.bytes) + " " +
                    std::to_string(c.crc));
  }
  return lines;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(McapReader, FindsInARunsLogWhatWeFind) {
  HALLWAY_NODE_PACKAGE_OR_SKIP(packages, "@mcap/core");
  const SmallWorld world;
  ASSERT_EQ(world.run({"--quiet"}).status, 0);
  const fs::path file = fs::path(world.out()) / "run.mcap";
  const Ended ended = run_node(packages, "read_mcap.js", file);
  ASSERT_EQ(ended.status, 0) << ended.out << ended.err;
  std::vector<std::string> expected = channel_lines(file);
  EXPECT_EQ(expected.size(), 8u) << "all channels have messages";
  expected.emplace_back("metadata hallway.run format,manifest");
  EXPECT_EQ(lines_of(ended.out), expected);
}

TEST(McapReader, ReadsARecoveredLog) {
  HALLWAY_NODE_PACKAGE_OR_SKIP(packages, "@mcap/core");
  const SmallWorld world;
  ASSERT_EQ(world.run({"--quiet"}).status, 0);
  const std::string whole = read_file(fs::path(world.out()) / "run.mcap");
  const fs::path cut = world.folder().write("cut.mcap", whole.substr(0, whole.size() / 2));
  EXPECT_NE(run_node(packages, "read_mcap.js", cut).status, 0);
  const fs::path mended = world.folder() / "mended.mcap";
  ASSERT_EQ(hallway({"log", "recover", cut, "--out", mended}).status, 0);
  const Ended ended = run_node(packages, "read_mcap.js", mended);
  ASSERT_EQ(ended.status, 0) << ended.out << ended.err;
  EXPECT_NE(ended.out.find("/hallway/frame"), std::string::npos);
}

TEST(McapReader, FindsAWrongByte) {
  HALLWAY_NODE_PACKAGE_OR_SKIP(packages, "@mcap/core");
  const SmallWorld world;
  ASSERT_EQ(world.run({"--quiet"}).status, 0);
  std::string bytes = read_file(fs::path(world.out()) / "run.mcap");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  EXPECT_NE(run_node(packages, "read_mcap.js", world.folder().write("wrong.mcap", bytes)).status, 0);
}

}  // namespace
}  // namespace hallway::test
