// SPDX-License-Identifier: MIT
//
// The adapter of slam_point: frames of the sensors and of the body. What the algorithm itself does is tested with its core.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "fixtures.hpp"
#include "support/errors.hpp"

namespace hallway::host {
namespace {

using test_fixtures::point_sensors;
using Isometry = Eigen::Isometry3d;
using Vec3 = Eigen::Vector3d;

constexpr int kSteps = 30;

/// Points on a ring of walls around the origin, 2 m apart or more: one frame of it fixes a pose.
std::vector<Vec3> landmarks() {
  std::vector<Vec3> points;
  for (int i = 0; i < 24; ++i) {
    const double angle = i * 2 * M_PI / 24;
    points.emplace_back(12 * std::cos(angle), 12 * std::sin(angle), (i * 7) % 5 - 2.0);
  }
  return points;
}

/// The body drives slowly forward and turns. Step 0 is the identity: the map's frame is the world's.
Isometry body_pose(int step) {
  return Eigen::Translation3d(0.03 * step, 0.001 * step * step, 0) *
         Eigen::AngleAxisd(0.004 * step, Vec3::UnitZ());
}

hw_pose_t to_c(const Isometry& pose) {
  const Eigen::Quaterniond q(pose.linear());
  const Vec3 t = pose.translation();
  return {{t.x(), t.y(), t.z()}, {q.w(), q.x(), q.y(), q.z()}};
}

Isometry from_c(const hw_pose_t& pose) {
  const auto& q = pose.orientation;
  return Eigen::Translation3d(pose.position[0], pose.position[1], pose.position[2]) *
         Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
}

/// Drives the ring with these mounts, each sensor seeing every `mounts`-th landmark, without noise.
class Drive {
 public:
  explicit Drive(const std::vector<Isometry>& mounts)
      : mounts_(mounts), plugin_(find_plugin(std::string(PLUGINS) + "/slam_point.so", {})) {
    auto sensors = point_sensors(static_cast<std::uint32_t>(mounts.size()));
    for (std::size_t i = 0; i < mounts.size(); ++i) sensors[i].T_body_sensor = to_c(mounts[i]);
    plugin_.activate(sensors);
  }

  const Outputs& step(int i) {
    begin(i);
    for (std::size_t s = 0; s < mounts_.size(); ++s) add_reading(s, i);
    return plugin_.process(builder_.finish());
  }

  /// The same with a reading of each sensor before, from where the body was a step ago.
  const Outputs& step_with_older_readings(int i) {
    begin(i);
    for (std::size_t s = 0; s < mounts_.size(); ++s) {
      add_reading(s, i - 1);
      builder_.set_reading(static_cast<std::uint64_t>(2 * i), kPeriod_ns * i - 50'000'000,
                           kPeriod_ns * i - 50'000'000);
      add_reading(s, i);
      builder_.set_reading(static_cast<std::uint64_t>(2 * i + 1), kPeriod_ns * i, kPeriod_ns * i);
    }
    return plugin_.process(builder_.finish());
  }

  Plugin& plugin() { return plugin_; }

 private:
  static constexpr std::int64_t kPeriod_ns = 100'000'000;

  void begin(int i) { builder_.begin(static_cast<std::uint64_t>(i), kPeriod_ns * i); }

  /// What a sensor sees from where the body is in a step.
  void add_reading(std::size_t sensor, int i) {
    const std::vector<Vec3> world = landmarks();
    const Isometry T_sensor_world = (body_pose(i) * mounts_[sensor]).inverse();
    auto& points = add_points(builder_, static_cast<std::uint32_t>(sensor));
    for (std::size_t k = sensor; k < world.size(); k += mounts_.size()) {
      const Vec3 p = T_sensor_world * world[k];
      points.push_back({p.x(), p.y(), p.z()});
    }
  }

  std::vector<Isometry> mounts_;
  FrameBuilder builder_;
  Plugin plugin_;
};

Isometry tilted_mount() {
  return Eigen::Translation3d(0.4, -0.1, 0.6) * Eigen::AngleAxisd(0.3, Vec3(0.2, 0.9, 0.3).normalized());
}

double pose_error(const hw_pose_t& pose, const Isometry& truth) {
  return (from_c(pose).matrix() - truth.matrix()).cwiseAbs().maxCoeff();
}

/// Largest distance from a landmark of the map to the nearest true one.
double map_error(const Outputs& map) {
  double largest = 0;
  for (const hw_landmark_t& landmark : map.landmarks()) {
    double nearest = 1e9;
    for (const Vec3& truth : landmarks()) {
      nearest = std::min(
          nearest, (Vec3(landmark.position[0], landmark.position[1], landmark.position[2]) - truth).norm());
    }
    largest = std::max(largest, nearest);
  }
  return largest;
}

TEST(SlamPointPlugin, WithATiltedMountThePoseIsThatOfTheBody) {
  Drive drive({tilted_mount()});
  for (int i = 0; i < kSteps; ++i) {
    const Outputs& outputs = drive.step(i);
    ASSERT_TRUE(outputs.pose() && outputs.pose()->valid) << "step " << i;
    EXPECT_LT(pose_error(outputs.pose()->T_map_body, body_pose(i)), 1e-6) << "step " << i;
  }
}

TEST(SlamPointPlugin, OfSeveralReadingsOfASensorTheNewestCounts) {
  Drive drive({tilted_mount(), Isometry::Identity()});
  for (int i = 0; i < kSteps; ++i) {
    const Outputs& outputs = drive.step_with_older_readings(i);
    ASSERT_TRUE(outputs.pose() && outputs.pose()->valid) << "step " << i;
    EXPECT_LT(pose_error(outputs.pose()->T_map_body, body_pose(i)), 1e-6) << "step " << i;
    for (const std::uint32_t older : {0u, 2u}) EXPECT_FALSE(outputs.associations(older));
    for (const std::uint32_t newest : {1u, 3u}) EXPECT_TRUE(outputs.associations(newest));
  }
}

TEST(SlamPointPlugin, WithATiltedMountTheMapsFrameIsTheFirstBodyFrame) {
  Drive drive({tilted_mount()});
  for (int i = 0; i < kSteps; ++i) drive.step(i);
  for (const bool refine : {false, true}) {
    const Outputs& map = drive.plugin().report(refine);
    EXPECT_EQ(map.landmarks().size(), landmarks().size());
    EXPECT_LT(map_error(map), 1e-6);
  }
}

TEST(SlamPointPlugin, TheFirstSubmapStandsAtTheFirstBodyPose) {
  Drive drive({tilted_mount()});
  for (int i = 0; i < kSteps; ++i) drive.step(i);
  const Outputs& map = drive.plugin().report(false);
  ASSERT_FALSE(map.submaps().empty());
  EXPECT_LT(pose_error(map.submaps()[0].T_map_submap, Isometry::Identity()), 1e-6);
  EXPECT_FALSE(map.members(map.submaps()[0]).empty());
}

TEST(SlamPointPlugin, SeveralSensorsAreOneFrameAndEachHasItsAssociations) {
  Drive drive({tilted_mount(), Isometry::Identity()});
  for (int i = 0; i < kSteps; ++i) {
    const Outputs& outputs = drive.step(i);
    ASSERT_TRUE(outputs.pose() && outputs.pose()->valid) << "step " << i;
    EXPECT_LT(pose_error(outputs.pose()->T_map_body, body_pose(i)), 1e-6) << "step " << i;
    for (const std::uint32_t sample : {0u, 1u}) {
      ASSERT_TRUE(outputs.associations(sample));
      EXPECT_EQ(outputs.associations(sample)->size(), landmarks().size() / 2);
    }
  }
  EXPECT_LT(map_error(drive.plugin().report(false)), 1e-6);
}

TEST(SlamPointPlugin, AnAssociationNamesTheLandmarkAtThatPlace) {
  Drive drive({tilted_mount()});
  std::vector<std::uint64_t> last;
  for (int i = 0; i < kSteps; ++i) {
    const auto ids = *drive.step(i).associations(0);
    last.assign(ids.begin(), ids.end());
  }
  const Outputs& map = drive.plugin().report(false);
  ASSERT_EQ(last.size(), landmarks().size());
  for (std::size_t i = 0; i < last.size(); ++i) {
    for (const hw_landmark_t& landmark : map.landmarks()) {
      if (landmark.id != last[i]) continue;
      EXPECT_LT(
          (Vec3(landmark.position[0], landmark.position[1], landmark.position[2]) - landmarks()[i]).norm(),
          1e-6);
    }
  }
}

TEST(SlamPointPlugin, AResetStartsAgainToTheLastBit) {
  Drive drive({tilted_mount()});
  std::vector<double> first, second;
  for (int i = 0; i < kSteps; ++i) first.push_back(drive.step(i).pose()->T_map_body.position[0]);
  drive.plugin().reset();
  for (int i = 0; i < kSteps; ++i) second.push_back(drive.step(i).pose()->T_map_body.position[0]);
  EXPECT_EQ(first, second);
}

TEST(SlamPointPlugin, AFrameWithoutPointsIsLostAndTheLogSaysWhen) {
  std::vector<std::string> lines;
  const LogSink sink = [&](const std::string&, std::uint32_t, const std::string& message) {
    lines.push_back(message);
  };
  Plugin plugin(find_plugin(std::string(PLUGINS) + "/slam_point.so", {}), sink);
  plugin.activate(point_sensors());
  FrameBuilder builder;
  EXPECT_FALSE(plugin.process(test_fixtures::frame_of(builder, 0, {})).pose()->valid);
  EXPECT_FALSE(plugin.process(test_fixtures::frame_of(builder, 1, {})).pose()->valid);
  EXPECT_EQ(lines, std::vector<std::string>{"frame 0 determines no pose"});
}

TEST(SlamPointPlugin, ASampleOfASensorThatWasNotAnnouncedIsRefused) {
  Plugin plugin(find_plugin(std::string(PLUGINS) + "/slam_point.so", {}));
  plugin.activate(point_sensors(1));
  FrameBuilder builder;
  builder.begin(0, 0);
  add_points(builder, 9);
  const auto error = test::error_of([&] { plugin.process(builder.finish()); });
  ASSERT_TRUE(error);
  EXPECT_NE(error->message().find("sensor 9, which was not announced"), std::string::npos)
      << error->message();
}

TEST(SlamPointPlugin, EveryParameterHasAHelpAndItsDefaultIsAllowed) {
  Plugin plugin(find_plugin(std::string(PLUGINS) + "/slam_point.so", {}));
  ASSERT_FALSE(plugin.parameters().empty());
  for (std::size_t i = 0; i < plugin.parameters().size(); ++i) {
    const Parameter& parameter = plugin.parameters()[i];
    EXPECT_FALSE(parameter.help.empty()) << parameter.name;
    EXPECT_NO_THROW(plugin.set_parameter(parameter.name, plugin.parameter_text(i))) << parameter.name;
  }
}

}  // namespace
}  // namespace hallway::host
