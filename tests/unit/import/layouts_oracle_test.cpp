// SPDX-License-Identifier: MIT
// Folders in the layouts of other programs, read by read_layouts.py, which shares no code with the writers.
#include <gtest/gtest.h>

#include "base/file.hpp"
#include "base/text.hpp"
#include "import/kitti_odometry.hpp"
#include "import/pcd_imu_folder.hpp"
#include "support/data.hpp"
#include "support/python.hpp"
#include "support/temp_folder.hpp"
#include "unit/import/rig_scene.hpp"

namespace hallway::import {
namespace {

namespace fs = std::filesystem;
using test::RigScene;

/// What was given to a writer, as lines of a word and numbers.
class GivenTruth {
 public:
  void add(const std::string& word, std::int64_t t_ns, const std::vector<double>& numbers) {
    text_ += word + ' ' + std::to_string(t_ns);
    for (const double number : numbers) text_ += ' ' + format_double(number);
    text_ += '\n';
  }
  void add(const std::string& word, std::int64_t t_ns, const Pose& pose) {
    const Mat3 R = pose.q.toRotationMatrix();
    std::vector<double> rows;
    for (int i = 0; i < 3; ++i) rows.insert(rows.end(), {R(i, 0), R(i, 1), R(i, 2), pose.t[i]});
    add(word, t_ns, rows);
  }
  void add(std::int64_t t_ns, const LidarCloud& cloud) {
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
      const auto& [x, y, z] = cloud.points[i];
      add("point", t_ns,
          {x, y, z, static_cast<double>(cloud.intensity[i]), static_cast<double>(cloud.ring[i]),
           static_cast<double>(cloud.t_offset_ns[i])});
    }
  }
  void add(const ImuSample& sample) {
    std::vector<double> numbers(sample.angular_rad_s.begin(), sample.angular_rad_s.end());
    numbers.insert(numbers.end(), sample.force_m_s2.begin(), sample.force_m_s2.end());
    add("imu", sample.t_ns, numbers);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

class LayoutsOracle : public testing::Test {
 protected:
  void SetUp() override {
    const auto python = test::python_with_numpy();
    if (!python) GTEST_SKIP() << "no Python with numpy (HALLWAY_PYTHON names one)";
    python_ = *python;
  }
  /// The exit status of the script, which prints what differs.
  int differences(const std::string& layout, const GivenTruth& truth) const {
    const fs::path file = folder_.write("truth.txt", truth.text());
    return test::run_python(
        python_, {test::source_folder() / "tests/unit/import/read_layouts.py", layout, data(), file});
  }
  fs::path data() const { return folder_ / "data"; }
  test::TempFolder folder_;
  std::string python_;
};

TEST_F(LayoutsOracle, KittiOdometryIsWhatWasGiven) {
  GivenTruth truth, other_pose, other_point;
  const Pose Tr{from_yaw_pitch_roll(-1.6, 0.01, -1.55), Vec3(0.01, -0.08, -0.27)};
  KittiOdometryWriter writer(data(), "00", Tr);
  for (GivenTruth* given : {&truth, &other_pose, &other_point}) given->add("mount", 0, Tr);
  for (std::uint32_t i = 0; i < RigScene::kFrames; ++i) {
    const std::int64_t t_ns = RigScene::time_ns(i);
    const Pose pose = RigScene::pose(i);
    LidarCloud cloud = RigScene::cloud(i);
    writer.add(t_ns, cloud, pose);
    for (GivenTruth* given : {&truth, &other_pose, &other_point}) {
      const bool moved = given == &other_pose && i == 4;
      given->add("pose", t_ns, moved ? Pose{pose.q, pose.t + Vec3(0, 2e-9, 0)} : pose);
      if (given == &other_point) cloud.points[7][1] *= 1.0 + 1e-6;
      given->add(t_ns, cloud);
    }
  }
  writer.close();
  EXPECT_EQ(differences("kitti", truth), 0);
  EXPECT_NE(differences("kitti", other_pose), 0);
  EXPECT_NE(differences("kitti", other_point), 0);
  truth.add("pose", RigScene::time_ns(9), RigScene::pose(9));
  EXPECT_NE(differences("kitti", truth), 0) << "a frame more";
}

TEST_F(LayoutsOracle, EurocIsWhatWasGiven) {
  GivenTruth truth;
  const EurocImuSensor sensor{"made up", RigScene::mount(0.4), 200.0, 1.6968e-4, 1.9393e-5, 2e-3, 3e-3};
  EurocWriter writer(data(), sensor, "");
  truth.add("mount", 0, sensor.T_body_imu);
  truth.add("noise", 0, {200.0, 1.6968e-4, 1.9393e-5, 2e-3, 3e-3});
  for (const ImuSample& sample : RigScene::imu()) writer.add(sample), truth.add(sample);
  for (const EurocState& state : RigScene::states(true)) {
    writer.add(state);
    truth.add("pose", state.t_ns, state.T_world_body);
    std::vector<double> motion;
    for (const auto* three : {&state.motion->velocity_m_s, &state.motion->gyroscope_bias_rad_s,
                              &state.motion->accelerometer_bias_m_s2})
      motion.insert(motion.end(), three->begin(), three->end());
    truth.add("motion", state.t_ns, motion);
  }
  writer.close();
  EXPECT_EQ(differences("euroc", truth), 0);
  truth.add(ImuSample{RigScene::time_ns(99), {}, {}});
  EXPECT_NE(differences("euroc", truth), 0) << "a sample more";
}

TEST_F(LayoutsOracle, PcdImuFolderIsWhatWasGiven) {
  GivenTruth truth;
  const RigMounts mounts{RigScene::mount(0.1), RigScene::mount(-2.0)};
  PcdImuFolderWriter writer(data(), mounts);
  truth.add("mount", 0, mounts.T_body_lidar);
  truth.add("mount", 1, mounts.T_body_imu);
  for (std::uint32_t i = 0; i < RigScene::kFrames; ++i) {
    writer.add(RigScene::time_ns(i), RigScene::cloud(i));
    writer.add(TimedPose{RigScene::time_ns(i), RigScene::pose(i)});
    truth.add("pose", RigScene::time_ns(i), RigScene::pose(i));
    truth.add(RigScene::time_ns(i), RigScene::cloud(i));
  }
  for (const ImuSample& sample : RigScene::imu()) writer.add(sample), truth.add(sample);
  writer.close();
  EXPECT_EQ(differences("pcd_imu", truth), 0);
  truth.add(RigScene::time_ns(9), RigScene::cloud(9));
  EXPECT_NE(differences("pcd_imu", truth), 0) << "a cloud more";
}

}  // namespace
}  // namespace hallway::import
