// SPDX-License-Identifier: MIT
#include "import/kitti_odometry.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "base/file.hpp"
#include "support/temp_folder.hpp"
#include "unit/import/cloud_bytes.hpp"
#include "unit/import/rig_scene.hpp"

namespace hallway::import {
namespace {

namespace fs = std::filesystem;
using test::expect_error;
using test::RigScene;

constexpr const char* kIdentity = "1 0 0 0 0 1 0 0 0 0 1 0\n";

class KittiOdometry : public testing::Test {
 protected:
  void write_scene(const Pose& T_cam0_velodyne = kitti_cam0_velodyne(), bool with_truth = true) const {
    KittiOdometryWriter writer(root(), "07", T_cam0_velodyne);
    for (std::uint32_t i = 0; i < RigScene::kFrames; ++i) {
      writer.add(RigScene::time_ns(i), RigScene::cloud(i),
                 with_truth ? std::optional(RigScene::pose(i)) : std::nullopt);
    }
    writer.close();
  }
  fs::path root() const { return folder_ / "kitti"; }
  fs::path sequence() const { return root() / "sequences" / "07"; }
  fs::path poses() const { return root() / "poses" / "07.txt"; }
  /// What opening the sequence and reading its clouds is refused with, after a file was replaced.
  void refused(const fs::path& file, const std::string& content, const std::string& words,
               ErrorCode code = ErrorCode::kBadInput) const {
    const std::string before = read_file(file);
    write_file_atomically(file, content);
    expect_error([&] { read_all(); }, code, words);
    write_file_atomically(file, before);
    EXPECT_NO_THROW(read_all());
  }
  void read_all() const {
    const KittiSequence opened = open_kitti_odometry(sequence());
    for (std::uint32_t i = 0; i < opened.frames(); ++i) opened.cloud(i);
  }
  test::TempFolder folder_;
};

TEST_F(KittiOdometry, WhatIsWrittenReadsBack) {
  for (const Pose& Tr :
       {kitti_cam0_velodyne(), Pose{from_yaw_pitch_roll(-1.6, 0.01, -1.55), Vec3(0.01, -0.08, -0.27)}}) {
    fs::remove_all(root());
    write_scene(Tr);
    for (const fs::path& folder : {sequence(), root(), sequence() / ""}) {
      const KittiSequence opened = open_kitti_odometry(folder);
      ASSERT_EQ(opened.frames(), RigScene::kFrames);
      test::expect_near(opened.calibration.T_cam0_velodyne, Tr);
      for (std::uint32_t i = 0; i < opened.frames(); ++i) {
        EXPECT_EQ(opened.t_ns[i], RigScene::time_ns(i));
        test::expect_near(opened.T_world_velodyne(i).value(), RigScene::pose(i));
        const LidarCloud cloud = opened.cloud(i), given = RigScene::cloud(i);
        EXPECT_EQ(cloud.points, test::as_float32(given.points));
        EXPECT_EQ(cloud.intensity, given.intensity);
      }
    }
  }
}

TEST_F(KittiOdometry, CameraZeroLooksAlongTheLidarsX) {
  const Pose Tr = kitti_cam0_velodyne();
  EXPECT_EQ(Tr * Vec3(1, 0, 0), Vec3(0, 0, 1)) << "forward";
  EXPECT_EQ(Tr * Vec3(0, 1, 0), Vec3(-1, 0, 0)) << "left";
  EXPECT_EQ(Tr * Vec3(0, 0, 1), Vec3(0, -1, 0)) << "up";
  write_scene();
  EXPECT_TRUE(read_file(sequence() / "calib.txt").ends_with("\nTr: 0 -1 0 0 0 0 -1 0 1 0 0 0\n"));
}

TEST_F(KittiOdometry, ASequenceWithoutPosesHasNoTruth) {
  write_scene(kitti_cam0_velodyne(), false);
  EXPECT_FALSE(fs::exists(root() / "poses"));
  EXPECT_FALSE(open_kitti_odometry(sequence()).has_truth());
  EXPECT_FALSE(open_kitti_odometry(sequence()).T_world_velodyne(0));
}

TEST_F(KittiOdometry, TheBenchmarksOwnLinesAreRead) {
  const KittiCalibration calibration = parse_kitti_calibration(
      "P0: 7.188560000000e+02 0.000000000000e+00 6.071928000000e+02 0.000000000000e+00 0.000000000000e+00 "
      "7.188560000000e+02 "
      "1.852157000000e+02 0.000000000000e+00 0.000000000000e+00 0.000000000000e+00 1.000000000000e+00 "
      "0.000000000000e+00\n"
      "Tr: 4.276802385584e-04 -9.999672484946e-01 -8.084491683471e-03 -1.198459927713e-02 "
      "-7.210626507497e-03 "
      "8.081198471645e-03 -9.999413164504e-01 -5.403984729748e-02 9.999738645903e-01 4.859485810390e-04 "
      "-7.206933692422e-03 -2.921968648686e-01 \r\n",
      "calib.txt");
  EXPECT_EQ(calibration.projection[0].value()[2], 607.1928);
  EXPECT_FALSE(calibration.projection[1]);
  EXPECT_NEAR(calibration.T_cam0_velodyne.t.z(), -0.2921968648686, 1e-15);
  EXPECT_NEAR((calibration.T_cam0_velodyne.q * Vec3::UnitX()).z(), 0.99997386, 1e-7);
  EXPECT_EQ(parse_kitti_times("0.000000e+00\n1.036224e-01\n4.706206e+02\n", "t"),
            (std::vector<std::int64_t>{0, 103'622'400, 470'620'600'000}));
  const auto poses = parse_kitti_poses(
      "9.999978e-01 5.272628e-04 -2.066935e-03 -4.690294e-02 -5.296506e-04 9.999992e-01 -1.154865e-03 "
      "-2.839928e-02 2.066324e-03 "
      "1.155958e-03 9.999971e-01 8.586941e-01\n",
      "p");
  EXPECT_EQ(poses.at(0).t, Vec3(-4.690294e-02, -2.839928e-02, 8.586941e-01));
}

TEST_F(KittiOdometry, LineEndsMarksAndBlanksAreNoMatter) {
  write_scene();
  const KittiSequence plain = open_kitti_odometry(sequence());
  for (const fs::path& file : {sequence() / "times.txt", sequence() / "calib.txt", poses()}) {
    std::string other = "\xEF\xBB\xBF";
    for (const char c : read_file(file)) other += c == '\n' ? std::string(" \t\r\n") : std::string(1, c);
    write_file_atomically(file, other + "\r\n  \n");
  }
  const KittiSequence opened = open_kitti_odometry(sequence());
  EXPECT_EQ(opened.t_ns, plain.t_ns);
  EXPECT_EQ(opened.T_world_cam0.at(5).t, plain.T_world_cam0.at(5).t);
}

TEST_F(KittiOdometry, CloudsKeepFinitePoints) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::string bytes;
  for (const float value : {1.f, 2.f, 3.f, 0.5f, nan, 2.f, 3.f, 0.25f, 4.f, 5.f, 6.f, nan})
    bytes += test::bytes_of(value);
  const LidarCloud cloud = parse_kitti_cloud(bytes, "a.bin");
  EXPECT_EQ(cloud.points, (PointList{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(cloud.not_finite, 1u);
  EXPECT_EQ(cloud.intensity.at(0), 0.5f);
  EXPECT_TRUE(std::isnan(cloud.intensity.at(1)));
  EXPECT_TRUE(parse_kitti_cloud("", "a.bin").points.empty());
}

TEST_F(KittiOdometry, BadTextNamesFileAndLine) {
  write_scene();
  const fs::path times = sequence() / "times.txt", calib = sequence() / "calib.txt";
  const std::string six = "0\n1\n2\n3\n4\n5\n";
  refused(times, "", "times.txt: has no times");
  refused(times, "0\n1\n1\n3\n4\n5\n", "times.txt:3: the time 1 is not after the one above it");
  refused(times, "0\n2\n1\n", "times.txt:3: the time 1 is not after");
  refused(times, "0\n1\nnan\n", "times.txt:3: a time in seconds below 9e9 is needed, \"nan\" found");
  refused(times, "0\n-1\n", "times.txt:2: a time in seconds");
  refused(times, "0\n1403636579758555392\n", "times.txt:2: a time in seconds below 9e9");
  refused(times, "0 1\n", "times.txt:1: a time in seconds");
  refused(times, six.substr(0, 10), "times.txt: has 5 times for 6 clouds");
  refused(times, six + "6\n", "times.txt: has 7 times for 6 clouds");
  refused(times, six.substr(0, 11),
          "times.txt:6: the last line has no line end: the file seems to be cut off");
  refused(calib, "P0: 1 2 3\n", "calib.txt:1: 3 numbers where the rows of a 3x4 matrix have 12");
  refused(calib, std::string("P0: ") + kIdentity, "calib.txt: has no line Tr:");
  refused(calib, std::string("Tr: ") + kIdentity + "Tr: " + kIdentity, "calib.txt:2: Tr is there twice");
  refused(calib, std::string("P2: ") + kIdentity + "P2: " + kIdentity, "calib.txt:2: P2 is there twice");
  refused(calib, "Tr 1 0 0 0 0 1 0 0 0 0 1 0\n", "calib.txt:1: a name with a colon is needed, \"Tr\" found");
  refused(calib, "Tr: 1 0 0 0 0 1 0 0 0 0 -1 0\n", "calib.txt:1: the first three columns are a mirror image");
  const std::string line = kIdentity;
  const std::string two = line + line;
  refused(poses(), two + "1 0 0 nan 0 1 0 0 0 0 1 0\n",
          "07.txt:3: a finite number within 1e+09 is needed, \"nan\" found");
  refused(poses(), two + "1 0 0 1e10 0 1 0 0 0 0 1 0\n", "07.txt:3: a finite number within 1e+09");
  refused(poses(), two + "1 0 0 1e999 0 1 0 0 0 0 1 0\n", "07.txt:3: a finite number");
  refused(poses(), two + "1 0 0 x 0 1 0 0 0 0 1 0\n",
          "07.txt:3: a finite number within 1e+09 is needed, \"x\" found");
  refused(poses(), two + "1 0 0 0 0 1.000001 0 0 0 0 1 0\n",
          "07.txt:3: the first three columns are no rotation");
  refused(poses(), two + "1 0 0 0 0 1 0 0 0 0 1\n", "07.txt:3: 11 numbers");
  refused(poses(), two + line + line + line, "07.txt: has 5 poses for 6 clouds");
  refused(poses(), "", "07.txt: has no poses");
}

TEST_F(KittiOdometry, BadCloudsNameFileAndByte) {
  write_scene();
  const fs::path cloud = sequence() / "velodyne" / "000002.bin";
  const std::string bytes = read_file(cloud);
  refused(cloud, bytes.substr(0, 16 * 7 + 5),
          "000002.bin: byte 112: 117 bytes are no whole points of 16 bytes");
  std::string damaged = bytes;
  damaged.replace(32, 4, test::bytes_of(3e38f));
  refused(cloud, damaged, "000002.bin: byte 32: a coordinate lies beyond 1e+09 m");
  expect_error([&] { parse_kitti_cloud(bytes.substr(0, 33), "a.bin"); }, ErrorCode::kBadInput,
               "a.bin: byte 32: 1 bytes follow, and a point has 16");
}

TEST_F(KittiOdometry, MissingAndStrangeFilesAreNamed) {
  const auto fails = [&](ErrorCode code, const std::string& words) {
    expect_error([&] { read_all(); }, code, words);
    fs::remove_all(root());
    write_scene();
  };
  write_scene();
  fs::remove(sequence() / "calib.txt");
  fails(ErrorCode::kIo, "calib.txt: cannot open");
  fs::remove(sequence() / "times.txt");
  fails(ErrorCode::kIo, "times.txt: cannot open");
  fs::remove(sequence() / "times.txt");
  make_folder(sequence() / "times.txt");
  fails(ErrorCode::kIo, "times.txt: is a folder, not a file");
  fs::remove(sequence() / "velodyne" / "000003.bin");
  fails(ErrorCode::kBadInput, "velodyne/000003.bin: is missing: clouds go on to 000005.bin");
  fs::remove(sequence() / "velodyne" / "000005.bin");
  make_folder(sequence() / "velodyne" / "000005.bin");
  fails(ErrorCode::kIo, "velodyne/000005.bin: is not a regular file");
  write_file_atomically(sequence() / "velodyne" / "5.bin", "");
  fails(ErrorCode::kBadInput, "velodyne/5.bin: has no name of six digits");
  fs::remove_all(sequence() / "velodyne");
  fails(ErrorCode::kIo, "velodyne: cannot read the folder");
  fs::remove_all(sequence() / "velodyne");
  make_folder(sequence() / "velodyne");
  fails(ErrorCode::kBadInput, "velodyne: has no clouds");
  make_folder(root() / "sequences" / "08");
  expect_error([&] { open_kitti_odometry(root()); }, ErrorCode::kBadInput,
               "sequences: has 2 sequences; name the folder of one");
  make_folder(folder_ / "empty");
  expect_error([&] { open_kitti_odometry(folder_ / "empty"); }, ErrorCode::kIo,
               "empty/calib.txt: cannot open");
}

TEST_F(KittiOdometry, TheWriterRefusesWhatIsNoSequence) {
  write_scene();
  expect_error([&] { KittiOdometryWriter(root(), "07"); }, ErrorCode::kIo, "poses/07.txt: is there already");
  fs::remove_all(root() / "poses");
  expect_error([&] { KittiOdometryWriter(root(), "07"); }, ErrorCode::kIo, "07: the folder is not empty");
  KittiOdometryWriter writer(root(), "08");
  expect_error([&] { writer.close(); }, ErrorCode::kBadInput, "08: there are no clouds to write");
  writer.add(5, {}, Pose{});
  const auto refuses = [&](std::int64_t t_ns, const LidarCloud& cloud, const std::optional<Pose>& pose,
                           const std::string& words) {
    expect_error([&] { writer.add(t_ns, cloud, pose); }, ErrorCode::kBadInput, words);
  };
  refuses(5, {}, Pose{}, "000001.bin: the time 5 ns is not after 5 ns");
  refuses(9'000'000'000'000'000'000, {}, Pose{},
          "000001.bin: the time 9000000000000000000 ns is not below 9e9 s");
  refuses(6, {}, std::nullopt, "a sequence has the poses of all its clouds, or of none");
  refuses(6, {}, Pose{Quat(1, 0, 0, 1), Vec3::Zero()}, "the pose is not finite, or no rotation");
  refuses(6, {}, Pose{Quat::Identity(), Vec3(0, std::nan(""), 0)}, "the pose is not finite, or no rotation");
  refuses(6, {.points = {{std::nan(""), 0, 0}}}, Pose{}, "000001.bin: point 0 is not finite");
  writer.close();
  EXPECT_EQ(open_kitti_odometry(root() / "sequences" / "08").frames(), 1u);
}

}  // namespace
}  // namespace hallway::import
