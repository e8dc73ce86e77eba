// SPDX-License-Identifier: MIT
#include "import/pcd_imu_folder.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "base/file.hpp"
#include "import/timed_poses.hpp"
#include "support/temp_folder.hpp"
#include "unit/import/rig_scene.hpp"

namespace hallway::import {
namespace {

namespace fs = std::filesystem;
using test::expect_error;
using test::RigScene;

class PcdImu : public testing::Test {
 protected:
  void write_scene() const {
    PcdImuFolderWriter writer(folder(), RigMounts{RigScene::mount(0.1), RigScene::mount(-2.0)});
    for (std::uint32_t i = 0; i < RigScene::kFrames; ++i) {
      writer.add(RigScene::time_ns(i), RigScene::cloud(i));
      writer.add(TimedPose{RigScene::time_ns(i), RigScene::pose(i)});
    }
    for (const ImuSample& sample : RigScene::imu()) writer.add(sample);
    writer.close();
  }
  void read_all() const {
    const PcdImuFolder opened = open_pcd_imu_folder(folder());
    for (std::size_t i = 0; i < opened.clouds.size(); ++i) opened.cloud(i);
  }
  fs::path folder() const { return folder_ / "rig"; }
  test::TempFolder folder_;
};

TEST_F(PcdImu, WhatIsWrittenReadsBack) {
  write_scene();
  const PcdImuFolder opened = open_pcd_imu_folder(folder());
  ASSERT_EQ(opened.clouds.size(), RigScene::kFrames);
  ASSERT_EQ(opened.truth.size(), RigScene::kFrames);
  for (std::uint32_t i = 0; i < RigScene::kFrames; ++i) {
    EXPECT_EQ(opened.clouds[i].t_ns, RigScene::time_ns(i));
    LidarCloud expected = RigScene::cloud(i);
    expected.points = test::as_float32(expected.points);
    test::expect_same_cloud(opened.cloud(i), expected);
    EXPECT_EQ(opened.truth[i].t_ns, RigScene::time_ns(i));
    test::expect_near(opened.truth[i].T_world_body, RigScene::pose(i));
  }
  const auto imu = RigScene::imu();
  ASSERT_EQ(opened.imu.size(), imu.size());
  for (std::size_t i = 0; i < imu.size(); ++i) {
    EXPECT_EQ(opened.imu[i].t_ns, imu[i].t_ns);
    EXPECT_EQ(opened.imu[i].angular_rad_s, imu[i].angular_rad_s);
    EXPECT_EQ(opened.imu[i].force_m_s2, imu[i].force_m_s2);
  }
  ASSERT_TRUE(opened.mounts);
  test::expect_near(opened.mounts->T_body_lidar, RigScene::mount(0.1));
  test::expect_near(opened.mounts->T_body_imu, RigScene::mount(-2.0));
}

TEST_F(PcdImu, TruthAndMountsNeedNotBeThere) {
  write_scene();
  fs::remove(folder() / "truth.tum");
  fs::remove(folder() / "mounts.toml");
  EXPECT_TRUE(open_pcd_imu_folder(folder()).truth.empty());
  EXPECT_FALSE(open_pcd_imu_folder(folder()).mounts);
}

TEST_F(PcdImu, NamesAreTimes) {
  EXPECT_EQ(time_of_name("1403636579758555393"), 1'403'636'579'758'555'393);
  EXPECT_EQ(time_of_name("1403636579.758555393"), 1'403'636'579'758'555'393);
  EXPECT_EQ(time_of_name("0"), 0);
  EXPECT_EQ(time_of_name("007.000000005"), 7'000'000'005);
  for (const char* other : {"", "cloud_5", "-5", "5.5", "5.0000000001", ".000000001", "1.000000000.0",
                            "99999999999999999999", "9999999999.999999999", "5 "}) {
    EXPECT_FALSE(time_of_name(other)) << other;
  }
}

TEST_F(PcdImu, CloudsComeInTheOrderOfTheirTimes) {
  make_folder(folder());
  for (const char* name : {"20000000000.pcd", "3.000000000.pcd", "0000000000000000001.PCD", "note.txt"}) {
    write_file_atomically(folder() / name, print_lidar_pcd({}, name));
  }
  write_file_atomically(folder() / "imu.csv", "t_ns,wx,wy,wz,ax,ay,az\n0,0,0,0,0,0,0\n");
  const PcdImuFolder opened = open_pcd_imu_folder(folder());
  ASSERT_EQ(opened.clouds.size(), 3u);
  EXPECT_EQ(opened.clouds[0].t_ns, 1);
  EXPECT_EQ(opened.clouds[1].t_ns, 3'000'000'000);
  EXPECT_EQ(opened.clouds[2].t_ns, 20'000'000'000);
}

TEST_F(PcdImu, BadFilesAreNamedWithTheLine) {
  write_scene();
  const auto refused = [&](const char* name, const std::string& content, const std::string& words) {
    const std::string before = read_file(folder() / name);
    write_file_atomically(folder() / name, content);
    expect_error([&] { read_all(); }, ErrorCode::kBadInput, words);
    write_file_atomically(folder() / name, before);
    EXPECT_NO_THROW(read_all());
  };
  const std::string header = "t_ns,wx,wy,wz,ax,ay,az\n";
  refused("imu.csv", header, "imu.csv: has no samples");
  refused("imu.csv", "t_ns,wx,wy,wz,ax,ay\n", "imu.csv:1: the header has no column \"az\"");
  refused("imu.csv", header + "5,0,0,0,0,0,0\n4,0,0,0,0,0,0\n", "imu.csv:3: column t_ns: a time after 5");
  refused("imu.csv", header + "5,0,x,0,0,0,0\n",
          "imu.csv:2: column wy: a finite number is needed, \"x\" found");
  refused("imu.csv", header + "5,0,0,0,0,0", "imu.csv:2: the last line has no line end");
  refused("truth.tum", "", "truth.tum: has no poses");
  refused("truth.tum", "1 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n",
          "truth.tum:2: the time 1 is not after the one above it");
  refused("truth.tum", "1 0 0 nan 0 0 0 1\n",
          "truth.tum:1: a finite number within 1e+09 is needed, \"nan\" found");
  refused("truth.tum", "1 0 0 1e300 0 0 0 1\n", "truth.tum:1: a finite number within 1e+09");
  refused("truth.tum", "1 0 0 0 0 0 1 1\n",
          "truth.tum:1: the quaternion qx qy qz qw does not have unit length");
  refused("truth.tum", "1 0 0 0 0 0 1\n", "truth.tum:1: 7 numbers where t x y z qx qy qz qw need 8");
  refused("truth.tum", "1403636579758555393 0 0 0 0 0 0 1\n", "truth.tum:1: a time in seconds below 9e9");
  refused("mounts.toml", "[lidar]\nposition_m = [1, 2]\n",
          "mounts.toml:2: key lidar.position_m: a list of 3 numbers is needed");
  refused("mounts.toml", "[imu]\norientation_wxyz = [1, 0, 0, 1]\n",
          "mounts.toml:2: key imu.orientation_wxyz: the quaternion");
  refused("mounts.toml", "[imu]\nposition_m = [1, 2, nan]\n",
          "mounts.toml:2: key imu.position_m: a number is not finite");
  refused("mounts.toml", "[imu]\nposition_m = [1, 2, \"3\"]\n",
          "mounts.toml:2: key imu.position_m: a list of 3 numbers is needed; it has");
  refused("mounts.toml", "[imu]\nposition = [1, 2, 3]\n",
          "mounts.toml:2: key imu.position: there are position_m");
  refused("mounts.toml", "[lidr]\n", "mounts.toml:1: key lidr: there are the tables [lidar] and [imu]");
  refused("mounts.toml", "lidar = 5\n", "mounts.toml:1: key lidar: there are the tables");
  const std::string cloud = fs::path(open_pcd_imu_folder(folder()).clouds[2].file).filename().string();
  refused(cloud.c_str(), read_file(folder() / cloud).substr(0, 500),
          cloud + ":11: 300 points of 22 bytes follow");
  refused(cloud.c_str(), "", cloud + ": the header has no line DATA");
}

TEST_F(PcdImu, MissingAndStrangeFilesAreNamed) {
  const auto fails = [&](ErrorCode code, const std::string& words) {
    expect_error([&] { read_all(); }, code, words);
    fs::remove_all(folder());
    write_scene();
  };
  write_scene();
  for (const char* name : {"imu.csv", "truth.tum", "mounts.toml"}) {
    fs::remove(folder() / name);
    make_folder(folder() / name);
    fails(ErrorCode::kIo, std::string(name) + ": is a folder, not a file");
  }
  fs::remove(folder() / "imu.csv");
  fails(ErrorCode::kIo, "imu.csv: cannot open");
  write_file_atomically(folder() / "cloud.pcd", "");
  fails(ErrorCode::kBadInput, "cloud.pcd: is not named by a time");
  write_file_atomically(folder() / "1403636579.758555393.pcd", "");
  fails(ErrorCode::kBadInput, "has the time of 1403636579");
  make_folder(folder() / "5.pcd");
  fails(ErrorCode::kIo, "5.pcd: is a folder, not a file");
  fs::remove_all(folder());
  expect_error([&] { read_all(); }, ErrorCode::kIo, "rig: cannot read the folder");
  make_folder(folder());
  expect_error([&] { read_all(); }, ErrorCode::kBadInput, "rig: has no clouds (files that end in .pcd)");
}

TEST_F(PcdImu, MarksAndBlanksAreNoMatter) {
  EXPECT_EQ(parse_folder_imu("\xEF\xBB\xBF t_ns , wx,wy,wz,ax,ay,az,temperature\r\n5,1,2,3,4,5, 6,20 \r\n",
                             "imu.csv")
                .at(0)
                .force_m_s2[2],
            6.0);
  EXPECT_EQ(
      parse_timed_poses("\xEF\xBB\xBF# t x\r\n 1.5\t0 0 7 0 0 0 1 \r\n\r\n", "t").at(0).T_world_body.t.z(),
      7.0);
  EXPECT_EQ(parse_mounts("", "m").T_body_imu.t, Vec3::Zero());
}

TEST_F(PcdImu, TheWriterRefusesWhatIsNoRecording) {
  write_scene();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Pose wrong{Quat(1, 1, 0, 0), Vec3::Zero()};
  expect_error([&] { PcdImuFolderWriter(folder(), {}); }, ErrorCode::kIo, "rig: the folder is not empty");
  expect_error(
      [&] {
        PcdImuFolderWriter(folder_ / "b", RigMounts{wrong, {}});
      },
      ErrorCode::kBadInput, "mounts.toml: a mount is not finite");
  PcdImuFolderWriter writer(folder_ / "b", {});
  expect_error([&] { writer.close(); }, ErrorCode::kBadInput, "there are no clouds to write");
  writer.add(5, {});
  expect_error([&] { writer.close(); }, ErrorCode::kBadInput, "imu.csv: there are no samples to write");
  expect_error([&] { writer.add(5, {}); }, ErrorCode::kBadInput, "5.pcd: the time 5 ns is not after 5 ns");
  writer.add(ImuSample{});
  expect_error([&] { writer.add(ImuSample{}); }, ErrorCode::kBadInput,
               "imu.csv: the time 0 ns is not after 0 ns");
  expect_error(
      [&] {
        writer.add(ImuSample{1, {}, {0, nan, 0}});
      },
      ErrorCode::kBadInput, "the sample at 1 ns has a number");
  expect_error(
      [&] {
        writer.add(TimedPose{9'000'000'000'000'000'000, {}});
      },
      ErrorCode::kBadInput, "truth.tum: the time 9000000000000000000 ns is not below 9e9 s");
  expect_error(
      [&] {
        writer.add(TimedPose{1, wrong});
      },
      ErrorCode::kBadInput, "truth.tum: the pose at 1 ns is not finite");
  writer.close();
  EXPECT_EQ(open_pcd_imu_folder(folder_ / "b").clouds.size(), 1u);
}

}  // namespace
}  // namespace hallway::import
