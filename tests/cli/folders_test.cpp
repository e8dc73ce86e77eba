// SPDX-License-Identifier: MIT
// Output folders: what was there stays unless it may be replaced, and nothing half-written is left.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "cli/small_world.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

TEST(OutputFolder, HoldsTheDocumentedFiles) {
  const SmallWorld world;
  ASSERT_EQ(world.run({"--quiet"}).status, 0);
  const std::set<std::string> expected{"run.json",
                                       "run.mcap",
                                       "metrics.json",
                                       "scenario.toml",
                                       "map.map",
                                       "observations.csv",
                                       "truth.tum",
                                       "truth_poses.csv",
                                       "truth_landmarks.csv",
                                       "trajectory.tum",
                                       "landmarks.csv",
                                       "landmarks.ply",
                                       "matches.csv",
                                       "submaps.csv",
                                       "submap_poses.csv",
                                       "timing.csv",
                                       "pose_covariances.csv"};
  EXPECT_EQ(names_in(world.out()), expected);
}

TEST(OutputFolder, LeavesNothingBeside) {
  const SmallWorld world;
  ASSERT_EQ(world.run({"--quiet"}).status, 0);
  EXPECT_EQ(names_in(fs::path(world.out()).parent_path()), std::set<std::string>{"run"});
}

TEST(OutputFolder, EarlierRunStaysWithoutForce) {
  const SmallWorld world;
  ASSERT_EQ(world.run({"--quiet"}).status, 0);
  const std::string before = read_file(fs::path(world.out()) / "run.json");
  const Ended ended = world.run({"--seed", "9"});
  EXPECT_EQ(ended.status, 3);
  EXPECT_NE(ended.err.find("--force"), std::string::npos);
  EXPECT_EQ(read_file(fs::path(world.out()) / "run.json"), before);
}

TEST(OutputFolder, ForceReplacesAnEarlierRunWhole) {
  const SmallWorld world;
  ASSERT_EQ(world.run({"--quiet"}).status, 0);
  write_file_atomically(fs::path(world.out()) / "notes.txt", "of the earlier run");
  ASSERT_EQ(world.run({"--quiet", "--force", "--seed", "9"}).status, 0);
  EXPECT_FALSE(fs::exists(fs::path(world.out()) / "notes.txt"));
  EXPECT_EQ(names_in(fs::path(world.out()).parent_path()), std::set<std::string>{"run"});
}

TEST(OutputFolder, ForceNeverReplacesWhatIsNoRun) {
  const SmallWorld world;
  fs::create_directories(world.out());
  write_file_atomically(fs::path(world.out()) / "thesis.txt", "ten years of work");
  const Ended ended = world.run({"--force"});
  EXPECT_EQ(ended.status, 3);
  EXPECT_NE(ended.err.find("not a run folder"), std::string::npos) << ended.err;
  EXPECT_EQ(read_file(fs::path(world.out()) / "thesis.txt"), "ten years of work");
}

TEST(OutputFolder, MayBeEmptyAndThere) {
  const SmallWorld world;
  fs::create_directories(world.out());
  EXPECT_EQ(world.run({"--quiet"}).status, 0);
}

TEST(OutputFolder, IsAFile) {
  const SmallWorld world;
  world.folder().write("taken", "text");
  const Ended ended = hallway({"run", world.scenario(), "--out", world.folder() / "taken"});
  EXPECT_EQ(ended.status, 3);
  EXPECT_EQ(read_file(world.folder() / "taken"), "text");
}

TEST(OutputFolder, BelowAFileCannotBeWritten) {
  const SmallWorld world;
  world.folder().write("taken", "text");
  const Ended ended = hallway({"run", world.scenario(), "--out", world.folder() / "taken/run"});
  EXPECT_EQ(ended.status, 3);
  EXPECT_NE(ended.err.find("taken"), std::string::npos) << ended.err;
}

TEST(OutputFolder, OnAReadOnlyFileSystem) {
  const SmallWorld world;
  const Ended ended = hallway({"run", world.scenario(), "--out", "/proc/hallway-run"});
  EXPECT_EQ(ended.status, 3);
  EXPECT_NE(ended.err.find("/proc/hallway-run"), std::string::npos) << ended.err;
}

TEST(OutputFolder, AFailedRunLeavesNothing) {
  const SmallWorld world;
  EXPECT_EQ(world.run({"--plugin", "no_such_plugin"}).status, 4);
  EXPECT_FALSE(fs::exists(fs::path(world.out()).parent_path()));
}

}  // namespace
}  // namespace hallway::test
