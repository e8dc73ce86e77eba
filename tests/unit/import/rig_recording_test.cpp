// SPDX-License-Identifier: MIT
#include "import/rig_recording.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/file.hpp"
#include "import/imu_interval.hpp"
#include "import/kind.hpp"
#include "import/kitti_odometry.hpp"
#include "import/pcd_imu_folder.hpp"
#include "import/scan_cloud.hpp"
#include "support/temp_folder.hpp"
#include "unit/import/rig_scene.hpp"

namespace hallway::import {
namespace {

namespace fs = std::filesystem;
using test::expect_near;
using test::RigScene;

std::vector<ImuSample> samples_of(const std::vector<Interval>& intervals) {
  std::vector<ImuSample> samples;
  for (const Interval& interval : intervals) samples.push_back({.t_ns = middle_ns(interval)});
  return samples;
}

TEST(ImuIntervals, EqualOnesAreReadBack) {
  for (const std::int64_t length : {1, 2, 3, 1'250'000, 5'000'000, 5'000'001, 7'812'500}) {
    std::vector<Interval> intervals;
    for (std::int64_t i = 0; i < 20; ++i) intervals.push_back({1000 + i * length, 1000 + (i + 1) * length});
    EXPECT_EQ(intervals_of(samples_of(intervals)), intervals) << length;
  }
}

TEST(ImuIntervals, DoNotGrowInAGapOrOverlap) {
  const std::vector<ImuSample> samples{{.t_ns = 1},   {.t_ns = 10},  {.t_ns = 20}, {.t_ns = 30},
                                       {.t_ns = 130}, {.t_ns = 140}, {.t_ns = 143}};
  const std::vector<Interval> intervals = intervals_of(samples);
  EXPECT_EQ(intervals.front().begin_ns, 0) << "not below 0";
  EXPECT_EQ(intervals[3], (Interval{25, 35})) << "before a gap";
  EXPECT_EQ(intervals[4], (Interval{125, 135})) << "behind it";
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_LE(intervals[i].begin_ns, samples[i].t_ns);
    EXPECT_GE(intervals[i].end_ns, samples[i].t_ns);
    if (i > 0) {
      EXPECT_GE(intervals[i].begin_ns, intervals[i - 1].end_ns);
    }
  }
  EXPECT_EQ(intervals_of(std::vector<ImuSample>{{.t_ns = 7}}), (std::vector<Interval>{{7, 7}}));
}

/// A body that moves evenly and turns about its z axis.
Pose even_motion(double t_s) {
  return {from_yaw_pitch_roll(0.8 * t_s, 0, 0), Vec3(2.0 * t_s, -1.0 * t_s, 0.1 * t_s)};
}

TEST(TrueMotion, IsExactAtItsPosesAndEvenBetween) {
  std::vector<TimedPose> poses;
  for (const std::int64_t t : {30, 0, 10, 30})
    poses.push_back({t, even_motion(0.01 * static_cast<double>(t))});
  poses.back().T_world_body.t.x() = 99;
  const TrueMotion motion(poses);
  ASSERT_EQ(motion.poses().size(), 3u) << "of two of a time the first one counts";
  for (const std::int64_t t : {0, 3, 10, 17, 30}) {
    expect_near(motion.at(t), even_motion(0.01 * static_cast<double>(t)), 1e-12);
    EXPECT_EQ(motion.has(t), t % 10 == 0) << t;
  }
  EXPECT_TRUE(motion.covers(0, 30));
  EXPECT_FALSE(motion.covers(-1, 30));
  EXPECT_FALSE(motion.covers(0, 31));
  EXPECT_FALSE(TrueMotion({}).covers(0, 0));
  EXPECT_EQ(motion.longest_gap_ns(0, 10), 10);
  EXPECT_EQ(motion.longest_gap_ns(3, 5), 10);
  EXPECT_EQ(motion.longest_gap_ns(5, 11), 20);
  EXPECT_EQ(motion.longest_gap_ns(30, 30), 0);
}

TEST(Deskew, PointsOfTheWorldAreWhereTheSensorSeesThemAtTheEnd) {
  const Pose mount = RigScene::mount(0.4);
  constexpr std::int64_t kBegin_ns = 700'000'000, kEnd_ns = 800'000'000;
  std::vector<TimedPose> poses;
  for (std::int64_t t = 0; t <= 1'000'000'000; t += 50'000'000)
    poses.push_back({t, even_motion(1e-9 * static_cast<double>(t))});
  const auto sensor_at = [&](std::int64_t t_ns) {
    return even_motion(1e-9 * static_cast<double>(t_ns)) * mount;
  };
  LidarCloud seen = RigScene::cloud(3, 200), expected = seen;
  for (std::size_t i = 0; i < seen.points.size(); ++i) {
    const Vec3 place(seen.points[i][0], seen.points[i][1], seen.points[i][2]);
    const std::int64_t offset = seen.t_offset_ns[i] = static_cast<std::int64_t>(i / 4) * 2'000'000;
    const auto local = [&](std::int64_t t_ns) {
      const Vec3 p = sensor_at(t_ns).inverse() * place;
      return std::array{p.x(), p.y(), p.z()};
    };
    seen.points[i] = local(kBegin_ns + offset);
    expected.points[i] = local(kEnd_ns);
  }
  deskew(seen, kBegin_ns, mount, even_motion(0.8), TrueMotion(poses));
  for (std::size_t i = 0; i < seen.points.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(seen.points[i][axis], expected.points[i][axis], 1e-8) << i;
  }
}

class RigRecordings : public testing::Test {
 protected:
  fs::path data() const { return folder_.path() / "data"; }
  /// Clouds whose points are measured from `shift_ns` after the time of the cloud on.
  void write_pcd_imu(std::int64_t shift_ns) const {
    PcdImuFolderWriter writer(data(), RigMounts{RigScene::mount(0.1), RigScene::mount(-2.0)});
    for (std::uint32_t i = 0; i < RigScene::kFrames; ++i) {
      LidarCloud cloud = RigScene::cloud(i);
      for (std::int64_t& t : cloud.t_offset_ns) t += shift_ns;
      writer.add(RigScene::time_ns(i), cloud);
      writer.add(TimedPose{RigScene::time_ns(i), RigScene::pose(i)});
    }
    for (const ImuSample& sample : RigScene::imu()) writer.add(sample);
    writer.close();
  }
  test::TempFolder folder_;
};

TEST_F(RigRecordings, OfPcdFilesWithTimesAfterTheirOwn) {
  write_pcd_imu(0);
  ASSERT_EQ(tell_kind(data()), Kind::kPcdImu);
  const auto rig = open_pcd_imu_rig(data(), {});
  ASSERT_EQ(rig->frames(), RigScene::kFrames + 1);
  EXPECT_EQ(rig->period_ns(), RigScene::kPeriod_ns);
  RigFrame frame;
  std::size_t samples = 0;
  std::int64_t before_ns = -1;
  for (std::uint32_t i = 0; i < rig->frames(); ++i) {
    rig->read(i, frame);
    EXPECT_EQ(frame.t_ns, RigScene::time_ns(i));
    if (i < RigScene::kFrames) {
      ASSERT_TRUE(frame.T_world_body);
      expect_near(*frame.T_world_body, RigScene::pose(i));
    }
    if (i > 0) {
      const RigSample& scan = frame.samples.at(0);
      EXPECT_EQ(scan.sequence, i - 1);
      EXPECT_EQ(scan.t_begin_ns, RigScene::time_ns(i - 1));
      EXPECT_EQ(scan.t_end_ns - scan.t_begin_ns, 299 * 333'333);
      EXPECT_EQ(std::get<LidarCloud>(scan.content).ring, RigScene::cloud(i - 1).ring);
    }
    for (std::size_t k = i > 0 ? 1 : 0; k < frame.samples.size(); ++k, ++samples) {
      const RigSample& imu = frame.samples[k];
      EXPECT_EQ(imu.sequence, samples);
      EXPECT_LE(imu.t_end_ns, frame.t_ns);
      EXPECT_GT(imu.t_end_ns, before_ns);
      EXPECT_EQ(middle_ns({imu.t_begin_ns, imu.t_end_ns}), RigScene::imu()[samples].t_ns);
      EXPECT_EQ(std::get<ImuSample>(imu.content).force_m_s2, RigScene::imu()[samples].force_m_s2);
    }
    before_ns = frame.t_ns;
  }
  EXPECT_EQ(samples, RigScene::imu().size());
}

TEST_F(RigRecordings, OfPcdFilesNamedByTheEndOfTheirScans) {
  constexpr std::int64_t kScan_ns = 299 * 333'333;
  write_pcd_imu(-kScan_ns);
  const auto rig = open_pcd_imu_rig(data(), {});
  ASSERT_EQ(rig->frames(), RigScene::kFrames + 1) << "the last has what the IMU measured later";
  RigFrame frame;
  rig->read(2, frame);
  EXPECT_EQ(frame.t_ns, RigScene::time_ns(2));
  EXPECT_EQ(frame.samples.at(0).t_begin_ns, RigScene::time_ns(2) - kScan_ns);
  EXPECT_EQ(frame.samples.at(0).t_end_ns, RigScene::time_ns(2));
  EXPECT_EQ(std::get<LidarCloud>(frame.samples.at(0).content).t_offset_ns.front(), 0);
  rig->read(RigScene::kFrames, frame);
  EXPECT_FALSE(frame.samples.empty());
  EXPECT_TRUE(std::holds_alternative<ImuSample>(frame.samples.front().content)) << "no cloud";
}

TEST_F(RigRecordings, OfKitti) {
  KittiOdometryWriter writer(data(), "00");
  for (std::uint32_t i = 0; i < RigScene::kFrames; ++i)
    writer.add(RigScene::time_ns(i), RigScene::cloud(i), RigScene::pose(i));
  writer.close();
  EXPECT_EQ(tell_kind(data()), Kind::kKitti);
  EXPECT_EQ(tell_kind(data() / "sequences" / "00"), Kind::kKitti);
  const auto rig = open_kitti_rig(data());
  RigFrame frame;
  rig->read(4, frame);
  EXPECT_EQ(frame.t_ns, RigScene::time_ns(4));
  expect_near(*frame.T_world_body, RigScene::pose(4), 1e-8);
  ASSERT_EQ(frame.samples.size(), 1u);
  EXPECT_EQ(std::get<LidarCloud>(frame.samples[0].content).points,
            test::as_float32(RigScene::cloud(4).points));
}

TEST_F(RigRecordings, OfEuroc) {
  EurocWriter writer(data(), {"", RigScene::mount(0.4), 200.0}, "");
  for (const ImuSample& sample : RigScene::imu()) writer.add(sample);
  for (const EurocState& state : RigScene::states(false)) writer.add(state);
  writer.close();
  EXPECT_EQ(tell_kind(data()), Kind::kEuroc);
  EXPECT_EQ(tell_kind(data() / "mav0"), Kind::kEuroc);
  for (const std::int64_t period_ns : {5'000'001, 50'000'000, 2'000'000'000}) {
    const auto rig = open_euroc_rig(data(), {.period_ns = period_ns});
    RigFrame frame;
    std::size_t samples = 0;
    for (std::uint32_t i = 0; i < rig->frames(); ++i) {
      rig->read(i, frame);
      for (const RigSample& sample : frame.samples) EXPECT_EQ(sample.sequence, samples++);
    }
    EXPECT_EQ(samples, RigScene::imu().size()) << "every sample is in one frame, at " << period_ns;
  }
  RigOptions tiny{.period_ns = 1};
  test::expect_error([&] { open_euroc_rig(data(), tiny); }, ErrorCode::kBadInput, "more frames");
}

}  // namespace
}  // namespace hallway::import
