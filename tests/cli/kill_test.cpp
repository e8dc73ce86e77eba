// SPDX-License-Identifier: MIT
// Runs that are killed at random moments: what had been recorded is there.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <random>
#include <thread>

#include "cli/small_world.hpp"
#include "log/mcap_index.hpp"
#include "log/mcap_reader.hpp"
#include "support/long_mode.hpp"
#include "support/marked_processes.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// All messages of a log that is not damaged, each as one text.
std::vector<std::string> messages_of(const fs::path& path) {
  const log::FileInput input(path);
  log::McapReader reader(input);
  std::vector<std::string> messages;
  while (const log::McapItem* item = reader.next()) {
    const auto* message = std::get_if<log::McapMessage>(item);
    if (message == nullptr) continue;
    messages.push_back(reader.channels().at(message->channel_id).topic + " " +
                       std::to_string(message->sequence) + " " + std::to_string(message->log_time_ns) + " " +
                       std::string(message->data));
  }
  EXPECT_FALSE(reader.damage()) << reader.damage()->cause;
  return messages;
}

class Killed : public testing::Test {
 protected:
  /// A run that nobody disturbs.
  void SetUp() override {
    mark_processes();
    const Clock::time_point begin = Clock::now();
    ASSERT_EQ(Process(arguments(world_.out())).wait().status, 0);
    took_ = Clock::now() - begin;
    const fs::path log = fs::path(world_.out()) / "run.mcap";
    bytes_ = read_file(log);
    messages_ = messages_of(log);
    const log::FileInput input(log);
    for (const log::McapChunkIndex& chunk : log::read_mcap_index(input).chunks) {
      std::size_t n = 0;
      log::read_indexed_chunk(input, chunk, [&](const auto&) { ++n; });
      chunks_.emplace_back(chunk.offset + chunk.length, n);
    }
    ASSERT_GT(chunks_.size(), 20u);
  }

  std::vector<std::string> arguments(const std::string& out) const {
    return {hallway_program(), "run", world_.scenario(), "--steps", "500", "--quiet", "--out", out};
  }

  /// How many messages are in chunks that stand whole in the first `size` bytes.
  std::size_t messages_in(std::uint64_t size) const {
    std::size_t sum = 0;
    for (const auto& [end, n] : chunks_) sum += end <= size ? n : 0;
    return sum;
  }

  /// Looks at what a killed run has left. @return whether it had come to record anything
  bool look_at(const fs::path& left) const {
    std::error_code none;
    if (!fs::exists(left / "run.mcap", none) || fs::file_size(left / "run.mcap") < 100) return false;
    const std::string raw = read_file(left / "run.mcap");
    EXPECT_TRUE(std::string_view(bytes_).starts_with(raw)) << "what is written never changes";
    const fs::path mended = left / "mended.mcap";
    const Ended ended = hallway({"log", "recover", left, "--out", mended});
    EXPECT_EQ(ended.status, 0) << ended.err;
    if (ended.status != 0) return true;
    const std::vector<std::string> kept = messages_of(mended);
    EXPECT_GE(kept.size(), messages_in(raw.size()));
    EXPECT_LE(kept.size(), messages_.size());
    EXPECT_TRUE(kept.size() <= messages_.size() && std::equal(kept.begin(), kept.end(), messages_.begin()));
    return !kept.empty();
  }

  SmallWorld world_;
  Clock::duration took_{};
  std::string bytes_;
  std::vector<std::string> messages_;
  std::vector<std::pair<std::uint64_t, std::size_t>> chunks_;  ///< where each ends, and its messages
};

TEST_F(Killed, ARunLeavesAllThatItHadWritten) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int recorded = 0;
  for (int i = 0; i < sized(20, 100); ++i) {
    const fs::path out = world_.out("killed-" + std::to_string(i));
    Process process(arguments(out));
    std::this_thread::sleep_for(took_ * share(random));
    ::kill(process.pid(), SIGKILL);
    const int status = process.wait().status;
    if (status == 0) {
      EXPECT_TRUE(read_file(out / "run.mcap") == bytes_) << "it was faster";
      continue;
    }
    EXPECT_EQ(status, 128 + SIGKILL);
    const fs::path left = out.string() + ".part-" + std::to_string(process.pid());
    // It may have come to give its folder the final name.
    recorded += look_at(fs::exists(out) ? out : left) ? 1 : 0;
    std::error_code none;
    fs::remove_all(left, none);
  }
  EXPECT_GT(recorded, 0) << "none was killed while it ran: nothing was tried";
  EXPECT_EQ(lasting_processes(), std::vector<std::string>{}) << "a plugin's process outlives its host";
}

}  // namespace
}  // namespace hallway::test
