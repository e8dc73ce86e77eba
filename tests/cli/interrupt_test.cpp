// SPDX-License-Identifier: MIT
// A run that is asked to stop ends in good order.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/small_world.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;

/// Starts a run far too long for the test, waits until it has written some of its log, and sends it a signal.
Ended stop_long_run(const SmallWorld& world, int signal) {
  Process process(
      {hallway_program(), "run", world.scenario(), "--out", world.out(), "--steps", "10000000", "--quiet"});
  const fs::path log = world.out() + ".part-" + std::to_string(process.pid()) + "/run.mcap";
  const auto is_written = [&log] {
    std::error_code none;
    const std::uintmax_t size = fs::file_size(log, none);
    return !none && size > 100'000;
  };
  for (int i = 0; i < 12'000 && !is_written(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_TRUE(is_written()) << "the run wrote nothing within two minutes";
  ::kill(process.pid(), signal);
  return process.wait();
}

TEST(Interrupt, CtrlCKeepsWhatWasDone) {
  const SmallWorld world;
  EXPECT_EQ(stop_long_run(world, SIGINT).status, 130);
  const auto manifest = nlohmann::ordered_json::parse(read_file(fs::path(world.out()) / "run.json"));
  EXPECT_EQ(manifest.at("stopped_early"), true);
  EXPECT_GT(manifest.at("iterations").get<int>(), 0);
}

TEST(Interrupt, TerminationHasItsOwnStatus) {
  const SmallWorld world;
  EXPECT_EQ(stop_long_run(world, SIGTERM).status, 143);
  EXPECT_TRUE(fs::exists(fs::path(world.out()) / "metrics.json"));
}

}  // namespace
}  // namespace hallway::test
