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

/// What the commands that write several files leave, without the facts of the clock.
TEST(OutputFolder, EarlierResultsStayWithoutForce) {
  const SmallWorld world;
  const std::string cloud = world.folder().write("cloud.csv", "x,y,z\n0,0,1\n1,0,1\n0,1,1\n");
  const std::string plan = world.folder().write(
      "plan.toml", "schema = \"hallway.batch/1\"\nscenarios = [\"small.toml\"]\nsteps = 5\n");
  ASSERT_EQ(world.run({"--quiet", "--steps", "5"}, "a_run").status, 0);
  struct Writer {
    std::vector<std::string> command;
    std::string document;
  };
  for (const Writer& writer :
       {Writer{{"batch", plan}, "results.json"},
        Writer{{"compare", world.scenario(), "--plugin", "slam_point", "--steps", "5"}, "results.json"},
        Writer{{"planes", cloud, "--plugin", "em"}, "planes.json"},
        Writer{{"bench-em", "--plugin", "em", "--scenes", "1", "--points", "300..300", "--planes", "3..3",
                "--pictures", "0"},
               "results.json"}}) {
    SCOPED_TRACE(writer.command.front());
    const auto with = [&](const std::string& out, std::vector<std::string> more) {
      std::vector<std::string> all = writer.command;
      all.insert(all.end(), {"--quiet", "--out", world.out(out)});
      all.insert(all.end(), more.begin(), more.end());
      return hallway(all);
    };
    const std::string out = writer.command.front();
    ASSERT_EQ(with(out, {}).status, 0);
    const fs::path document = fs::path(world.out(out)) / writer.document;
    const std::string before = read_file(document);
    const Ended again = with(out, {});
    EXPECT_EQ(again.status, 3);
    EXPECT_NE(again.err.find("--force"), std::string::npos) << again.err;
    EXPECT_EQ(read_file(document), before);
    EXPECT_EQ(with(out, {"--force"}).status, 0);

    const std::set<std::string> run = names_in(world.out("a_run"));
    const Ended into_run = with("a_run", {"--force"});
    EXPECT_EQ(into_run.status, 3);
    EXPECT_NE(into_run.err.find("folder of a run"), std::string::npos) << into_run.err;
    EXPECT_EQ(names_in(world.out("a_run")), run);
  }
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
