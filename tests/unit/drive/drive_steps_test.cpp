// SPDX-License-Identifier: MIT
// The motion does not depend on how time is divided, and is the same twice.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "drive/drive.hpp"
#include "unit/drive/drives.hpp"

namespace hallway::drive {
namespace {

using testing::Dice;
using testing::kSecond;

constexpr double kSame = 1e-10;

/// What happens to a drive at a time.
struct Deed {
  std::int64_t t_ns = 0;
  Command command{};
  int contact = 0;  ///< 1: another twist, 2: blocked
};

std::vector<Deed> random_deeds(Dice& dice) {
  std::vector<Deed> deeds;
  for (std::int64_t t = 0; t < 8 * kSecond; t += dice.whole(0, kSecond)) {
    deeds.push_back({t, testing::random_command(dice), static_cast<int>(dice.whole(0, 5))});
  }
  return deeds;
}

void act(Drive& drive, const Deed& deed) {
  if (deed.contact == 1) drive.set_twist({0.1, -0.2, 0.3});
  if (deed.contact == 2) drive.stop();
  drive.command(deed.t_ns, deed.command);
}

void expect_same(const Drive& a, const PlanarPose& pose_a, const Drive& b, const PlanarPose& pose_b) {
  EXPECT_NEAR(pose_a.x_m, pose_b.x_m, kSame);
  EXPECT_NEAR(pose_a.y_m, pose_b.y_m, kSame);
  EXPECT_NEAR(pose_a.yaw_rad, pose_b.yaw_rad, kSame);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(a.wheel_travel_m()[i], b.wheel_travel_m()[i], kSame);
}

TEST(DriveSteps, AnyDivisionOfTimeGivesTheSameMotion) {
  Dice dice(31);
  for (int i = 0; i < 120; ++i) {
    DriveSpec spec = testing::random_spec(dice);
    if (i % 3 != 0) testing::add_noise(spec);
    Drive coarse(spec, 9), fine(spec, 9);
    PlanarPose coarse_pose, fine_pose;
    for (const Deed& deed : random_deeds(dice)) {
      testing::drive_on(coarse, deed.t_ns, coarse_pose);
      while (fine.present_ns() < deed.t_ns) {
        testing::drive_on(fine, std::min(deed.t_ns, fine.present_ns() + dice.whole(0, 40'000'000)),
                          fine_pose);
      }
      expect_same(coarse, coarse_pose, fine, fine_pose);
      act(coarse, deed);
      act(fine, deed);
    }
  }
}

TEST(DriveSteps, CommandsMayBeGivenAhead) {
  Dice dice(32);
  for (int i = 0; i < 40; ++i) {
    DriveSpec spec = testing::random_spec(dice);
    testing::add_noise(spec);
    Drive now(spec, 9), ahead(spec, 9);
    std::vector<Deed> deeds = random_deeds(dice);
    for (const Deed& deed : deeds) ahead.command(deed.t_ns, deed.command);
    PlanarPose now_pose, ahead_pose;
    for (const Deed& deed : deeds) {
      testing::drive_on(now, deed.t_ns, now_pose);
      now.command(deed.t_ns, deed.command);
    }
    testing::drive_on(now, 9 * kSecond, now_pose);
    testing::drive_on(ahead, 9 * kSecond, ahead_pose);
    expect_same(now, now_pose, ahead, ahead_pose);
  }
}

/// All numbers of a motion.
std::vector<double> numbers_of(const std::vector<Motion>& motions) {
  std::vector<double> numbers;
  for (const Motion& m : motions) {
    for (const PlanarTwist& t : {m.body.from, m.body.to}) {
      numbers.insert(numbers.end(), {t.forward_m_s, t.lateral_m_s, t.angular_rad_s});
    }
    for (const PerWheel& w : {m.wheels.from, m.wheels.to}) numbers.insert(numbers.end(), w.begin(), w.end());
    numbers.push_back(static_cast<double>(m.body.duration_ns));
  }
  return numbers;
}

TEST(DriveSteps, SameSeedGivesTheSameBytesAndACopyGoesOn) {
  Dice dice(33);
  for (int i = 0; i < 40; ++i) {
    DriveSpec spec = testing::random_spec(dice);
    testing::add_noise(spec);
    Drive first(spec, 9), second(spec, 9);
    for (const Deed& deed : random_deeds(dice)) {
      Drive copy = first;
      const std::vector<double> bytes = numbers_of(first.advance(deed.t_ns));
      EXPECT_EQ(bytes, numbers_of(second.advance(deed.t_ns)));
      EXPECT_EQ(bytes, numbers_of(copy.advance(deed.t_ns)));
      EXPECT_EQ(first.wheel_travel_m(), copy.wheel_travel_m());
      act(first, deed);
      act(second, deed);
    }
  }
}

TEST(DriveSteps, AnotherSeedGivesAnotherMotion) {
  DriveSpec spec;
  testing::add_noise(spec);
  Drive first(spec, 1), second(spec, 2);
  for (Drive* drive : {&first, &second}) drive->command(0, {0.5, 0.0, 0.0});
  EXPECT_NE(numbers_of(first.advance(kSecond)), numbers_of(second.advance(kSecond)));
}

TEST(DriveSteps, AddedDisturbanceChangesNoOthersDraws) {
  DriveSpec spec{.forward_noise = {0.0, 0.1, 100'000'000}};
  Drive alone(spec, 3);
  spec.left_slip = {0.1, 0.1, 0};
  spec.lateral_drift = {0.0, 0.1, 0};
  Drive among(spec, 3);
  for (Drive* drive : {&alone, &among}) {
    drive->command(0, {0.5, 0.0, 0.3});
    drive->advance(5 * kSecond);
  }
  EXPECT_EQ(alone.wheel_travel_m(), among.wheel_travel_m());  // the wheels show the noise of the motors alone
}

}  // namespace
}  // namespace hallway::drive
