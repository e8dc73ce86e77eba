// SPDX-License-Identifier: MIT
// A simulated run, sent through ROS to hallway-robot, gives the same files.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "base/text.hpp"
#include "cli/small_world.hpp"
#include "private_network.hpp"
#include "ros_master.hpp"
#include "support/data.hpp"
#include "support/long_mode.hpp"
#include "support/temp_folder.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;

constexpr int kPort = 11311;

/// The mount of the run's sensor, as the driver's setting has it, to the last bit.
std::string mount_of(const fs::path& run) {
  const auto manifest = nlohmann::json::parse(read_file(run / "run.json"));
  const auto& pose = manifest.at("sensors").at(0).at("T_body_sensor");
  std::string mount;
  for (const char* part : {"position_m", "orientation_wxyz"}) {
    for (const auto& number : pose.at(part)) mount += format_double(number.get<double>()) + " ";
  }
  return mount;
}

/// Sends what stands in the log of `run` through ROS to hallway-robot, and expects the same tables of it.
void expect_same_through_ros(const fs::path& run, const fs::path& on_robot, const std::string& parameters,
                             int frames) {
  const Master master(kPort);
  const TempFolder folder;
  const fs::path config = folder.write(
      "robot.toml",
      "[driver]\nname = \"" DRIVER "\"\nmaster = \"" + uri_of(kPort) +
          "\"\naddress = \"127.0.0.1\"\npoints_topic = \"/points\"\nmount = \"" + mount_of(run) +
          "\"\nperiod_s = 0.1\nlock_step = true\n\n[[plugin]]\nname = \"slam_point\"\n" + parameters);
  Process robot({binary_folder() / "bin/hallway-robot", "run", config, "--out", on_robot, "--quiet"});
  Process publisher({PUBLISH_LOG, run / "run.mcap", "/points", "/diagnostics"}, {}, environment_of(kPort));
  const Ended published = publisher.wait();
  EXPECT_EQ(published.out, std::to_string(frames) + " frames\n") << published.err;
  const Ended ended = robot.wait();
  EXPECT_EQ(ended.status, 0) << ended.err;
  for (const char* table : {"trajectory.tum", "landmarks.csv", "submaps.csv", "landmarks.ply"}) {
    EXPECT_EQ(read_file(run / table), read_file(on_robot / table)) << table;
  }
  EXPECT_GT(fs::file_size(on_robot / "trajectory.tum"), 0u);
}

TEST(Ros1Robot, WritesWhatTheSimulatedRunWrote) {
  const std::string problem = enter_private_network();
  if (!problem.empty()) GTEST_SKIP() << "no network namespace of our own: " << problem;
  const SmallWorld world;
  ASSERT_EQ(world.run({"--plugin", "slam_point", "--quiet"}).status, 0);
  expect_same_through_ros(world.out(), world.out("robot"), "", 60);
}

TEST(Ros1Robot, WritesWhatARunOfTheOfficeWrote) {
  const std::string problem = enter_private_network();
  if (!problem.empty()) GTEST_SKIP() << "no network namespace of our own: " << problem;
  const int frames = sized(150, 2020);
  const TempFolder folder;
  const fs::path run = folder / "run";
  ASSERT_EQ(hallway({"run", source_folder() / "maps/office.toml", "--steps", std::to_string(frames), "--out",
                     run, "--quiet"})
                .status,
            0);
  expect_same_through_ros(run, folder / "robot", "params = { noise_m = 0.01 }\n", frames);
}

}  // namespace
}  // namespace hallway::test
