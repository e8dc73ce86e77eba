// SPDX-License-Identifier: MIT
// Runs of maps that have no scenario, and where their robot starts.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "small_world.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// small_map() with a robot start, in map units (centimetres).
std::string map_with_start(const std::string& origin) {
  return small_map() + "{\n\"classname\" \"hw_robot_start\"\n\"origin\" \"" + origin + "\"\n}\n";
}

/// The same with neither path nor waypoints, and points on the faces instead of the cloud.
std::string map_without_path() {
  std::string map = map_with_start("300 100 50");
  map = map.substr(0, map.find("{\n\"classname\" \"hw_path\"")) +
        map.substr(map.find("{\n\"classname\" \"hw_robot_start\""));
  return replaced(map, "\"_scale\" \"0.01\"", "\"_scale\" \"0.01\"\n\"_points_per_m2\" \"5\"");
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(MapRun, NeedsNoScenarioAndSaysWhatItAssumes) {
  const TempFolder folder;
  const std::string map =
      folder.write("home.map", replaced(small_map(), "\"per_100m\" \"60\"", "\"per_100m\" \"1000\""));
  const Ended ended = hallway({"run", map, "--out", folder / "run", "--steps", "40", "--json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  for (const char* part :
       {"path `straight` once, at 1 m/s", "no hw_sensor", "`slam_point`", "hallway scenario new"})
    EXPECT_TRUE(says(ended.err, part)) << part << "\n" << ended.err;
  const Json manifest = Json::parse(read_file(folder.path() / "run" / "run.json"));
  EXPECT_EQ(manifest.at("plugins").at(0).at("id"), "slam_point");
  EXPECT_GT(Json::parse(read_file(folder.path() / "run" / "metrics.json")).at("landmarks_mapped").get<int>(),
            0);
}

TEST(MapRun, IsThatOfTheScenarioThatIsWritten) {
  const TempFolder folder;
  const std::string map = folder.write("home.map", small_map());
  ASSERT_EQ(hallway({"run", map, "--out", folder / "a", "--steps", "30", "--quiet"}).status, 0);
  ASSERT_EQ(hallway({"scenario", "new", map}).status, 0);
  ASSERT_EQ(hallway({"run", folder / "home.toml", "--out", folder / "b", "--steps", "30", "--quiet"}).status,
            0);
  for (const char* file : {"observations.csv", "trajectory.tum", "landmarks.csv", "scenario.toml"})
    EXPECT_EQ(read_file(folder.path() / "a" / file), read_file(folder.path() / "b" / file)) << file;
  EXPECT_EQ(hallway({"scenario", "new", map}).status, 3) << "an earlier scenario is not replaced";
  EXPECT_EQ(hallway({"scenario", "new", map, "--force"}).status, 0);
}

TEST(MapRun, ASensorOfTheMapIsNamedAsSuch) {
  const TempFolder folder;
  const std::string map = folder.write(
      "home.map", replaced(map_without_path(), "\"classname\" \"hw_robot_start\"",
                           "\"classname\" \"hw_sensor\"\n\"name\" \"eyes\"\n\"kind\" \"points\"\n}\n{\n"
                           "\"classname\" \"hw_robot_start\""));
  const Ended ended = hallway({"run", map, "--out", folder / "run", "--set", "sensor.eyes.noise_m=0.05"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_TRUE(says(ended.err, "its sensors are the map's")) << ended.err;
}

TEST(MapRun, SaysNothingAssumedThatWasSet) {
  const TempFolder folder;
  const std::string map = folder.write("home.map", map_without_path());
  const Ended ended =
      hallway({"run", map, "--out", folder / "run", "--steps", "3", "--quiet", "--plugin", "em"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_FALSE(says(ended.err, "100 frames")) << ended.err;
  EXPECT_TRUE(says(ended.err, "stays at its")) << ended.err;
  EXPECT_FALSE(says(ended.err, "`slam_point`")) << ended.err;
}

TEST(ScenarioNew, FindsTheMapFromBehindALink) {
  const TempFolder folder;
  const std::string map = folder.write("home.map", map_without_path());
  fs::create_directories(folder.path() / "real" / "deep");
  fs::create_directory_symlink(folder.path() / "real" / "deep", folder.path() / "link");
  const std::string scenario = folder / "link/home.toml";
  ASSERT_EQ(hallway({"scenario", "new", map, "--out", scenario}).status, 0);
  const Ended ended = hallway({"run", scenario, "--out", folder / "run", "--steps", "3", "--quiet"});
  EXPECT_EQ(ended.status, 0) << ended.err;
}

TEST(MapRun, AMapThatNoScenarioCanNameIsNamed) {
  const TempFolder folder;
  const std::string map = folder.write("a\xff.map", map_without_path());
  const Ended ended = hallway({"run", map, "--out", folder / "run"});
  EXPECT_EQ(ended.status, 3);
  EXPECT_TRUE(says(ended.err, ".map: a scenario cannot name this map")) << ended.err;
}

TEST(MapRun, WithoutAPathTheRobotStaysAtItsStart) {
  const TempFolder folder;
  const std::string map = folder.write("home.map", map_without_path());
  const Ended ended = hallway({"run", map, "--out", folder / "run", "--steps", "3", "--quiet"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_TRUE(says(ended.err, "stays at its hw_robot_start")) << ended.err;
  const std::string poses = read_file(folder.path() / "run" / "truth_poses.csv");
  EXPECT_TRUE(says(poses, "\n0,3,1,0.5,")) << poses;
  EXPECT_TRUE(says(poses, "\n2,3,1,0.5,")) << poses;
}

TEST(MapRun, NeedsAPathOrAStart) {
  const TempFolder folder;
  const std::string map = folder.write("home.map", "{\n\"classname\" \"worldspawn\"\n}\n");
  const Ended ended = hallway({"run", map, "--out", folder / "run"});
  EXPECT_EQ(ended.status, 3);
  EXPECT_TRUE(says(ended.err, "neither a path nor a robot start")) << ended.err;
}

TEST(RobotStart, OffThePathIsAWarningWithBothPlaces) {
  const SmallWorld world;
  world.folder().write("small.map", map_with_start("700 -300 0"));
  const Ended run = world.run({"--steps", "5", "--quiet"});
  EXPECT_EQ(run.status, 0);
  for (const char* part : {"warning", "(7, -3, 0)", "`straight` begins at (0, 0, 0)", "begins there"})
    EXPECT_TRUE(says(run.err, part)) << part << "\n" << run.err;
  EXPECT_TRUE(says(hallway({"map", "check", world.folder() / "small.map"}).out, "[start-off-path]"));
  EXPECT_NE(world.run({"--steps", "5", "--strict"}, "strict").status, 0);
}

TEST(RobotStart, OnThePathIsNoWarning) {
  const SmallWorld world;
  world.folder().write("small.map", map_with_start("0 0 0"));
  EXPECT_EQ(world.run({"--steps", "5", "--quiet"}).err, "");
  EXPECT_FALSE(says(hallway({"map", "check", world.folder() / "small.map"}).out, "start-off-path"));
}

// ---- projects -------------------------------------------------------------------------------------------------------

/// Configures and builds a project in the folder.
Ended built(const fs::path& folder) {
  const std::string commands = "cd '" + folder.string() + "' && cmake --workflow --preset release 2>&1";
  return Process({"/bin/sh", "-c", commands}).wait();
}

TEST(NewProject, OfAPluginBuildsWithTheProgramsOfTheBuildTree) {
  const TempFolder folder;
  ASSERT_EQ(hallway({"plugin", "new", "my_slam", "--folder", folder / "my_slam"}).status, 0);
  const Ended build = built(folder.path() / "my_slam");
  ASSERT_EQ(build.status, 0) << build.out;
  EXPECT_EQ(hallway({"plugin", "check", folder / "my_slam/build/my_slam.so"}).status, 0);
}

TEST(NewProject, OfADriverBuildsAndRuns) {
  const TempFolder folder;
  ASSERT_EQ(hallway({"driver", "new", "my_base", "--folder", folder / "my_base"}).status, 0);
  const Ended build = built(folder.path() / "my_base");
  ASSERT_EQ(build.status, 0) << build.out;
  const Ended run = hallway_robot({"run", folder / "my_base/robot.toml", "--out", folder / "run", "--json"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_GT(Json::parse(run.out).at("landmarks").get<int>(), 20);
}

}  // namespace
}  // namespace hallway::test
