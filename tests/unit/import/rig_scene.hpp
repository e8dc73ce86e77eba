// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "import/euroc.hpp"
#include "import/lidar_cloud.hpp"
#include "import/true_track.hpp"
#include "support/errors.hpp"

namespace hallway::test {

/// A made-up recording of a lidar and an IMU on a moving body: numbers of every size, times that a double in seconds does not hold.
class RigScene {
 public:
  static constexpr std::uint32_t kFrames = 6;
  static constexpr std::int64_t kBegin_ns = 1'403'636'579'758'555'393, kPeriod_ns = 100'000'007;

  static std::int64_t time_ns(std::uint32_t frame) { return kBegin_ns + kPeriod_ns * frame; }
  static Pose pose(std::uint32_t frame) {
    const double t = 0.3 * frame;
    return {from_yaw_pitch_roll(0.7 * t, 0.2 * std::sin(t), -0.1 * t),
            Vec3(1e3 + 3.0 * t, -7.0 / 3.0 * t, 0.1 * t * t)};
  }
  static Pose mount(double turn) {
    return {from_yaw_pitch_roll(turn, 0.02, -0.3), Vec3(0.1, -0.2 / 3.0, turn)};
  }
  /// @param count  of its points
  static import::LidarCloud cloud(std::uint32_t frame, std::size_t count = 300) {
    const Random random(11, stream_id("test.rig"));
    import::LidarCloud cloud;
    for (std::size_t i = 0; i < count; ++i) {
      const auto draw = [&](std::uint64_t k) { return random.uniform(frame, 8 * i + k); };
      const double far = std::pow(10.0, 6.0 * draw(0) - 3.0);
      cloud.points.push_back({far * (draw(1) - 0.5), far * (draw(2) - 0.5), draw(3)});
      cloud.intensity.push_back(static_cast<float>(draw(4)));
      cloud.ring.push_back(static_cast<std::uint32_t>(i % 16));
      cloud.t_offset_ns.push_back(static_cast<std::int64_t>(i) * 333'333);
    }
    return cloud;
  }
  static std::vector<import::ImuSample> imu() {
    std::vector<import::ImuSample> samples;
    for (int i = 0; i < 120; ++i) {
      const double t = 0.005 * i;
      samples.push_back({kBegin_ns + 5'000'001 * std::int64_t{i},
                         {std::sin(t), 1e-9 * i, -std::cos(3 * t)},
                         {9.81 / 3.0 * t, -1e3 * t * t, 9.80665}});
    }
    return samples;
  }
  static std::vector<import::EurocState> states(bool motion) {
    std::vector<import::EurocState> states;
    for (std::uint32_t i = 0; i < kFrames; ++i) {
      states.push_back({time_ns(i), pose(i), {}});
      if (motion)
        states.back().motion =
            import::EurocMotion{{3.0, -7.0 / 3.0, 0.02 * i}, {1e-3, 0, -1e-5}, {0.1, i * 0.1, 0}};
    }
    return states;
  }
};

/// The points that float32 numbers hold.
inline import::PointList as_float32(import::PointList points) {
  for (auto& point : points) {
    for (double& x : point) x = static_cast<double>(static_cast<float>(x));
  }
  return points;
}

inline void expect_same_cloud(const import::LidarCloud& a, const import::LidarCloud& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.intensity, b.intensity);
  EXPECT_EQ(a.ring, b.ring);
  EXPECT_EQ(a.t_offset_ns, b.t_offset_ns);
}

inline void expect_near(const Pose& a, const Pose& b, double tolerance = 1e-9) {
  EXPECT_LT((a.t - b.t).norm(), tolerance);
  EXPECT_LT(angle_between(a.q, b.q), tolerance);
}

/// Expects an Error of this code whose text has these words.
inline void expect_error(const std::function<void()>& work, ErrorCode code, const std::string& words) {
  const auto error = error_of(work);
  ASSERT_TRUE(error) << "no error; expected: " << words;
  EXPECT_EQ(error->code(), code) << error->what();
  EXPECT_NE(std::string(error->what()).find(words), std::string::npos)
      << error->what() << "\nlacks: " << words;
}

}  // namespace hallway::test
