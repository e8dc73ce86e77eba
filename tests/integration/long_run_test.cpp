// SPDX-License-Identifier: MIT
// A plugin drives a robot for long: what the program holds does not grow with the steps, but for the index of the log.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "base/file.hpp"
#include "base/helper.hpp"
#include "log/drive_tables.hpp"
#include "log/observations.hpp"
#include "log/poses.hpp"
#include "log/tum.hpp"
#include "support/data.hpp"
#include "support/long_mode.hpp"
#include "support/process.hpp"
#include "support/temp_folder.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kBytesPerStep = 64;
constexpr std::uint64_t kBesides = 2 << 20;  // of buffers that fill late, and of the allocator

/// The largest resident memory of a process until now, in bytes; 0 of one that has ended.
std::uint64_t peak_of(pid_t pid) {
  std::ifstream status("/proc/" + std::to_string(pid) + "/status");
  std::string word;
  std::uint64_t kib = 0;
  while (status >> word) {
    if (word == "VmHWM:") status >> kib;
  }
  return kib * 1024;
}

std::size_t descriptors_of(pid_t pid) {
  std::error_code gone;
  const fs::directory_iterator all("/proc/" + std::to_string(pid) + "/fd", gone);
  return gone ? 0 : static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

std::uint64_t last_step(const fs::path& drive_table) {
  std::ifstream file(drive_table);
  std::string line, last;
  while (std::getline(file, line)) last = line;
  return last.empty() ? 0 : std::strtoull(last.c_str(), nullptr, 10);
}

/// A scenario of maps/ that is run for long.
struct Drive {
  std::string scenario;
  std::vector<std::string> files;  ///< that it names
  std::vector<std::string> options;
};

const Drive kWanderer{"office_drive.toml", {"office.map"}, {"--plugin", "wanderer"}};
/// In the process that is measured: the plugin's memory counts.
const Drive kFirstRobot{"cubicles_faults.toml", {"cubicles.map", "robots/first.map"}, {"--in-process"}};

/// The command of a run that no picture follows: a picture shows all of a run, which it reads at the end.
std::vector<std::string> command(const Drive& drive, std::uint64_t steps, const fs::path& folder) {
  const fs::path maps = source_folder() / "maps";
  std::string text = read_file(maps / drive.scenario);
  text.erase(text.find("[[picture]]"));
  for (const std::string& file : drive.files)
    text.replace(text.find("\"" + file), file.size() + 1, "\"" + (maps / file).string());
  std::ofstream(folder / "drive.toml") << text;
  std::vector<std::string> arguments{hallway_program(),     "run",   folder / "drive.toml", "--steps",
                                     std::to_string(steps), "--out", folder / "run",        "--quiet"};
  arguments.insert(arguments.end(), drive.options.begin(), drive.options.end());
  return arguments;
}

/// What a process held.
struct Held {
  std::uint64_t bytes = 0;      ///< at most
  std::size_t descriptors = 0;  ///< most of the time
};

Held drive_for(const Drive& drive, std::uint64_t steps) {
  const TempFolder folder;
  Process run(command(drive, steps, folder.path()));
  Held held;
  std::map<std::size_t, std::uint64_t> counts;  // of descriptors
  for (std::uint64_t peak = 1; peak > 0;) {  // a program that has ended and is not waited for has no memory
    held.bytes = std::max(held.bytes, peak);
    ++counts[descriptors_of(run.pid())];
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    peak = peak_of(run.pid());
  }
  held.descriptors =
      std::ranges::max_element(counts, {}, [](const auto& count) { return count.second; })->first;
  const Ended ended = run.wait();
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(last_step(folder / "run/drive.csv"), steps - 1);
  return held;
}

/// A run of `many` steps holds no more than one of `some`, but for the index of the log.
void expect_flat(const Drive& drive, std::uint64_t some, std::uint64_t many, bool keeps_freed) {
  const Held few = drive_for(drive, some), all = drive_for(drive, many);
  if (!keeps_freed) {
    EXPECT_LE(all.bytes, few.bytes + kBytesPerStep * (many - some) + kBesides);
  }
  EXPECT_EQ(all.descriptors, few.descriptors);
  std::printf(
      "%.1f bytes a step, %zu descriptors\n",
      (static_cast<double>(all.bytes) - static_cast<double>(few.bytes)) / static_cast<double>(many - some),
      all.descriptors);
}

TEST(LongRun, HoldsNoMoreThanTheIndexOfTheLog) {
  const bool keeps_freed = reserves_addresses();  // a sanitizer does, and takes ten times as long
  const std::uint64_t some = keeps_freed ? 2'000 : sized<std::uint64_t>(20'000, 100'000),
                      many = keeps_freed ? 5'000 : sized<std::uint64_t>(50'000, 1'000'000);
  expect_flat(kWanderer, some, many, keeps_freed);
}

/// The graph of wall_follower is whole when it has mapped the office; then it stands. Lists that grow are on the disk by then.
TEST(LongRun, HoldsNoMoreWithTheFirstRobotInIt) {
  const bool keeps_freed = reserves_addresses();
  const std::uint64_t some = keeps_freed ? 1'000 : 20'000,
                      many = keeps_freed ? 2'000 : sized<std::uint64_t>(40'000, 100'000);
  expect_flat(kFirstRobot, some, many, keeps_freed);
}

/// Whole rows up to some step are there when a run is killed.
TEST(LongRun, LeavesItsTablesWhenItIsKilled) {
  const TempFolder folder;
  Process run(command(kWanderer, 1'000'000, folder.path()));
  const fs::path part = (folder / "run").string() + ".part-" + std::to_string(run.pid());
  constexpr std::uint64_t kFrames = 8000;
  while (last_step(part / "drive.csv") < kFrames && peak_of(run.pid()) > 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ::kill(run.pid(), SIGKILL);
  const Ended ended = run.wait();
  EXPECT_EQ(ended.status, 128 + SIGKILL) << ended.err;
  EXPECT_GE(log::read_obeyed_commands(part / "drive.csv").size(), kFrames);
  const std::size_t true_poses = log::read_tum(part / "truth.tum").size();
  EXPECT_GE(true_poses, kFrames / 2) << "written in blocks";
  EXPECT_GE(log::read_poses(part / "truth_poses.csv").size(), kFrames / 2);
  const log::ReadLog seen = log::read_observations(part / "observations_eyes.csv");
  EXPECT_FALSE(seen.damage);
  EXPECT_GE(seen.log.iterations(), kFrames / 2);
  EXPECT_GT(last_step(part / "commands.csv"), 0u) << "short rows";
  EXPECT_TRUE(fs::exists(part / "map.map"));
  EXPECT_FALSE(fs::exists(part / "run.json"));
}

}  // namespace
}  // namespace hallway::test
