// SPDX-License-Identifier: MIT
// What plugins are told of a simulated robot is what it does.
#include "sim/describe.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "drive/wheels.hpp"
#include "sim/driven_robot.hpp"
#include "sim/simulator.hpp"
#include "support/temp_folder.hpp"
#include "unit/sim/small_world.hpp"

namespace hallway::sim {
namespace {

const std::string kRound = "radius_m = 0.2\nbottom_m = 0.03\ntop_m = 0.5\n";

/// A robot on a large floor.
struct ToldRobot {
  explicit ToldRobot(const std::string& drive, const std::string& body = kRound) {
    folder.write("small.map",
                 test::map_text(test::block(-5000, -5000, -20, 5000, 5000, 0),
                                "{\n\"classname\" \"hw_robot_start\"\n\"origin\" \"0 0 50\"\n}\n"));
    const std::string text = "map = \"small.map\"\nsteps = 400\nperiod_s = 0.1\n[robot]\n" + body +
                             "[robot.drive]\n" + drive + "[sensor.wheels]\nkind = 'encoders'\n";
    simulator = std::make_unique<Simulator>(load_scenario(folder.write("s.toml", text)), 1,
                                            trace::Backend::kBruteForce);
    robot = std::make_unique<DrivenRobot>(world(), simulator->scenario(), simulator->path());
  }

  const DrivenWorld& world() const { return *simulator->driven_world(); }
  const drive::DriveSpec& spec() const { return simulator->scenario().robot.driven->drive; }
  drive::Clamps clamps(const drive::Command& command) {
    const drive::Clamps clamps = robot->obey({.command = command}).obeyed.clamps;
    robot->advance();
    return clamps;
  }

  test::TempFolder folder;
  std::unique_ptr<Simulator> simulator;
  std::unique_ptr<DrivenRobot> robot;
};

class ToldDrive : public testing::TestWithParam<const char*> {
 protected:
  std::string kind() const { return "kind = '" + std::string(GetParam()) + "'\n"; }
};

TEST_P(ToldDrive, HasTheLimitsThatCommandsAreClampedTo) {
  ToldRobot told(kind() + "max_speed_m_s = 0.75\nmax_angular_rad_s = 1.25\n");
  const host::DriveInfo info = describe(told.spec());
  EXPECT_EQ(info.kind, host::drive_kind(GetParam()));
  EXPECT_EQ(info.max_speed_m_s, 0.75);
  EXPECT_FALSE(told.clamps({.forward_m_s = -info.max_speed_m_s}).speed);
  EXPECT_TRUE(told.clamps({.forward_m_s = 1.01 * info.max_speed_m_s}).speed);
  const double ahead_m_s = info.kind == HW_DRIVE_ACKERMANN ? 0.5 : 0.0;
  EXPECT_FALSE(told.clamps({.forward_m_s = ahead_m_s, .angular_rad_s = info.max_angular_rad_s}).angular);
  EXPECT_TRUE(
      told.clamps({.forward_m_s = ahead_m_s, .angular_rad_s = 1.01 * info.max_angular_rad_s}).angular);
  if (info.max_lateral_m_s > 0.0) {
    EXPECT_FALSE(told.clamps({.lateral_m_s = info.max_lateral_m_s}).lateral);
    EXPECT_TRUE(told.clamps({.lateral_m_s = 1.01 * info.max_lateral_m_s}).lateral);
  } else {
    EXPECT_TRUE(told.clamps({.lateral_m_s = 0.1}).left_out) << "it does not go sideways";
  }
}

TEST_P(ToldDrive, SaysWhetherItTurnsOnTheSpot) {
  ToldRobot told(kind());
  hw_drive_info_t info{};
  info.kind = describe(told.spec()).kind;
  told.robot->obey({.command = drive::Command{.angular_rad_s = 1.0}});
  for (int i = 0; i < 10; ++i) told.robot->advance();
  const Pose after = told.robot->pose_at(1'000'000'000);
  EXPECT_EQ(hw_turns_on_the_spot(&info) != 0, std::abs(2.0 * std::atan2(after.q.z(), after.q.w())) > 0.1);
}

/// A point p of a body moves with v + w x p; a rim without slip as fast along the wheel's direction as the floor goes by there.
TEST_P(ToldDrive, HasItsWheelsWhereTheyRoll) {
  if (std::string(GetParam()) == "omnidirectional") GTEST_SKIP() << "its wheels also roll sideways";
  ToldRobot told(kind() + "wheel_base_m = 0.4\n");
  const auto wheels = describe_wheels(told.spec(), told.world(), 0.001);
  ASSERT_EQ(wheels.size(), drive::wheel_count(told.spec().kind));
  const drive::Command twist{.forward_m_s = 0.3, .lateral_m_s = 0.0, .angular_rad_s = 0.7};
  const drive::PerWheel speeds = drive::wheel_speeds(told.spec(), twist);
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    const auto& [x, y, z] = wheels[i].position;
    const double along_x = twist.forward_m_s - twist.angular_rad_s * y;
    const double along_y = twist.angular_rad_s * x;
    EXPECT_NEAR(along_x * wheels[i].direction[0] + along_y * wheels[i].direction[1], speeds[i], 1e-12) << i;
    EXPECT_NEAR(z, 0.0, 1e-9) << "the body's origin is on the floor: its bottom is its clearance above it";
    EXPECT_EQ(wheels[i].m_per_tick, 0.001);
  }
}

INSTANTIATE_TEST_SUITE_P(Each, ToldDrive,
                         testing::Values("differential", "tracked", "ackermann", "omnidirectional"),
                         [](const auto& instance) { return std::string(instance.param); });

TEST(ToldDriveNumbers, ThatHaveNoMeaningForTheKindAreUnknown) {
  drive::DriveSpec spec;
  EXPECT_TRUE(std::isnan(describe(spec).greatest_steering_rad));
  EXPECT_TRUE(std::isnan(describe(spec).axle_distance_m));
  EXPECT_EQ(describe(spec).max_deceleration_m_s2, spec.max_acceleration_m_s2);
  spec.kind = drive::DriveKind::kAckermann;
  spec.latency_ns = 30'000'000;
  EXPECT_EQ(describe(spec).greatest_steering_rad, spec.greatest_steering_rad);
  EXPECT_EQ(describe(spec).axle_distance_m, spec.axle_distance_m);
  EXPECT_EQ(describe(spec).latency_s, 0.03);
}

TEST(ToldBody, IsThatOfTheScenario) {
  const ToldRobot round("kind = 'differential'\n");
  const host::BodyInfo circle = describe_body(round.world());
  EXPECT_TRUE(circle.corners.empty());
  EXPECT_EQ(circle.radius_m, 0.2);
  EXPECT_EQ(circle.bottom_m, 0.03);
  EXPECT_EQ(circle.top_m, 0.5);
  const ToldRobot box("kind = 'tracked'\n", "length_m = 0.5\nwidth_m = 0.25\nbottom_m = -0.1\ntop_m = 0.3\n");
  const host::BodyInfo outline = describe_body(box.world());
  EXPECT_EQ(outline.corners, (std::vector<std::array<double, 2>>{
                                 {-0.25, -0.125}, {0.25, -0.125}, {0.25, 0.125}, {-0.25, 0.125}}));
  EXPECT_EQ(outline.bottom_m, -0.1);
  EXPECT_EQ(outline.top_m, 0.3);
  EXPECT_EQ(host::problem_of(outline), "");
  const auto wheels = describe_wheels(box.spec(), box.world(), 0.001);
  EXPECT_NEAR(wheels[0].position[2], -0.1 - 0.03, 1e-9) << "the floor is the clearance below the bottom";
}

}  // namespace
}  // namespace hallway::sim
