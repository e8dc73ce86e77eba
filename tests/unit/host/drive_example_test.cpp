// SPDX-License-Identifier: MIT
// The SDK's example in C that drives.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "host/plugin.hpp"
#include "host/samples/bump_kind.hpp"

namespace hallway::host {
namespace {

class DriveExample : public testing::Test {
 protected:
  void SetUp() override { plugin_.activate(robot()); }

  /// What the plugin is activated with.
  virtual Activation robot() const {
    return std::vector<SensorInfo>{{.id = 3, .kind = HW_SAMPLE_BUMP, .name = "bump"}};
  }

  /// What it commands for a frame of that time in which the zones to the left and right are pressed or not.
  DriveCommand drive(std::int64_t t_ns, bool left, bool right) {
    builder_.begin(step_++, t_ns);
    add_bump(builder_, 3) = {zone(0, left, 0.6), zone(1, right, -0.6)};
    const auto& command = plugin_.process(builder_.finish()).drive_command();
    EXPECT_TRUE(command);
    return command.value_or(DriveCommand{});
  }

 private:
  static hw_bump_zone_t zone(std::uint32_t number, bool pressed, double y) {
    hw_bump_zone_t zone{{0, 0, 0}, std::numeric_limits<double>::quiet_NaN(), number, pressed ? 1u : 0u};
    if (pressed) zone.direction[0] = 0.8, zone.direction[1] = y;
    return zone;
  }

  Plugin plugin_{find_plugin(EXAMPLE_THAT_DRIVES, {})};
  FrameBuilder builder_;
  std::uint64_t step_ = 0;
};

TEST_F(DriveExample, GoesAheadUntilItTouches) {
  const DriveCommand ahead = drive(0, false, false);
  EXPECT_GT(ahead.linear_m_s, 0);
  EXPECT_EQ(ahead.angular_rad_s, 0);
  EXPECT_EQ(ahead.lateral_m_s, 0);
  EXPECT_LT(drive(100'000'000, true, false).linear_m_s, 0);
  EXPECT_LT(drive(200'000'000, false, false).linear_m_s, 0) << "it still backs off";
  EXPECT_EQ(drive(10'000'000'000, false, false), ahead);
}

TEST_F(DriveExample, TurnsAwayFromTheSideThatItTouches) {
  EXPECT_LT(drive(0, true, false).angular_rad_s, 0) << "to the right";
  EXPECT_GT(drive(1, false, true).angular_rad_s, 0) << "to the left";
  EXPECT_NE(drive(2, true, true).angular_rad_s, 0) << "to some side";
}

/// A robot that is slow.
class SlowDriveExample : public DriveExample {
  Activation robot() const override {
    Activation slow = DriveExample::robot();
    slow.drive = DriveInfo{.max_speed_m_s = 0.125, .max_angular_rad_s = 0.25};
    return slow;
  }
};

TEST_F(SlowDriveExample, IsToldNoMoreThanItsDriveCanDo) {
  EXPECT_EQ(drive(0, false, false).linear_m_s, 0.125);
  const DriveCommand away = drive(1, true, false);
  EXPECT_EQ(away.linear_m_s, -0.0625);
  EXPECT_EQ(away.angular_rad_s, -0.25);
}

}  // namespace
}  // namespace hallway::host
