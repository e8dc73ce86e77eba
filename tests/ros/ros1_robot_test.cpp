// SPDX-License-Identifier: MIT
// A simulated run, sent through ROS to hallway-robot, gives the same files.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "base/text.hpp"
#include "cli/small_world.hpp"
#include "private_network.hpp"
#include "ros_master.hpp"

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

TEST(Ros1Robot, WritesWhatTheSimulatedRunWrote) {
  const std::string problem = enter_private_network();
  if (!problem.empty()) GTEST_SKIP() << "no network namespace of our own: " << problem;
  const SmallWorld world;
  ASSERT_EQ(world.run({"--plugin", "slam_point", "--quiet"}).status, 0);
  const Master master(kPort);
  const fs::path config = world.folder().write(
      "robot.toml", "[driver]\nname = \"" DRIVER "\"\nmaster = \"" + uri_of(kPort) +
                        "\"\naddress = \"127.0.0.1\"\npoints_topic = \"/points\"\nmount = \"" +
                        mount_of(world.out()) +
                        "\"\nperiod_s = 0.1\nlock_step = true\n\n[[plugin]]\nname = \"slam_point\"\n");
  Process robot(
      {binary_folder() / "bin/hallway-robot", "run", config, "--out", world.out("robot"), "--quiet"});
  Process publisher({PUBLISH_LOG, world.out() + "/run.mcap", "/points", "/diagnostics"}, {},
                    environment_of(kPort));
  const Ended published = publisher.wait();
  EXPECT_EQ(published.out, "60 frames\n") << published.err;
  const Ended ended = robot.wait();
  EXPECT_EQ(ended.status, 0) << ended.err;
  const fs::path run = world.out();
  const fs::path on_robot = world.out("robot");
  for (const char* table : {"trajectory.tum", "landmarks.csv", "submaps.csv", "landmarks.ply"}) {
    EXPECT_EQ(read_file(run / table), read_file(on_robot / table)) << table;
  }
  EXPECT_GT(fs::file_size(on_robot / "trajectory.tum"), 0u);
}

}  // namespace
}  // namespace hallway::test
