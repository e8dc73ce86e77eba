// SPDX-License-Identifier: MIT
// What a robot promises whatever it meets: integrals, times, starts, inputs.
#include "contact/robot.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "support/errors.hpp"
#include "unit/contact/scene.hpp"

namespace hallway::contact::test {
namespace {

/// The motion of a ramp in the plane, by Simpson's rule on many steps: x, y and heading.
Vec3 integrated(Vec3 state, const TwistRamp& ramp, int steps) {
  const double seconds = 1e-9 * static_cast<double>(ramp.duration_ns), h = seconds / steps;
  const double heading = state.z();
  const auto velocity = [&](double t) {
    const PlanarTwist twist = ramp.at(t / seconds);
    const double angle = heading + t * ramp.from.angular_rad_s +
                         0.5 * t * t / seconds * (ramp.to.angular_rad_s - ramp.from.angular_rad_s);
    return Vec3(std::cos(angle) * twist.forward_m_s - std::sin(angle) * twist.lateral_m_s,
                std::sin(angle) * twist.forward_m_s + std::cos(angle) * twist.lateral_m_s,
                twist.angular_rad_s);
  };
  for (int i = 0; i < steps; ++i)
    state += h / 6.0 * (velocity(i * h) + 4.0 * velocity((i + 0.5) * h) + velocity((i + 1) * h));
  return state;
}

Scene plain() {
  Scene scene;
  scene.floor(-100, -100, 100, 100, 0.25);
  return scene;
}

const std::vector<TwistRamp> kRamps{{{0, 0, 0}, {1, 0, 0}, kSecond},
                                    {{1, 0, 0}, {1, 0.2, 1.5}, 2 * kSecond},
                                    {{1, 0.2, 1.5}, {-0.5, 0.1, -2}, 3 * kSecond},
                                    {{-0.5, 0, -2}, {0, 0, 0}, kSecond}};

TEST(Robot, FreeMotionIsTheIntegralOfItsTwist) {
  const Obstacles obstacles(plain().triangles);
  Robot robot(obstacles, box_robot());
  ASSERT_EQ(robot.put({1, 2, 0.25}, 0.3, 5), Start::kStands);
  Vec3 expected(1, 2, 0.3);
  for (const TwistRamp& ramp : kRamps) {
    const std::int64_t begin = robot.now_ns();
    drive(robot, ramp);
    for (const double share : {0.1, 0.37, 0.5, 0.93, 1.0}) {
      const auto part_ns = static_cast<std::int64_t>(share * static_cast<double>(ramp.duration_ns));
      const double exact = static_cast<double>(part_ns) / static_cast<double>(ramp.duration_ns);
      const Vec3 there = integrated(expected, {ramp.from, ramp.at(exact), part_ns}, 2000);
      const Pose pose = robot.history().pose_at(begin + part_ns);
      EXPECT_NEAR(pose.t.x(), there.x(), 1e-10);
      EXPECT_NEAR(pose.t.y(), there.y(), 1e-10);
      EXPECT_EQ(pose.t.z(), 0.25);
      EXPECT_NEAR(angle_between(pose.q, from_yaw_pitch_roll(there.z(), 0, 0)), 0.0, 1e-10);
      const PlanarTwist twist = robot.history().twist_at(begin + part_ns - (share == 1.0 ? 1 : 0));
      EXPECT_NEAR(twist.forward_m_s, ramp.at(exact).forward_m_s, 1e-8);
    }
    expected = integrated(expected, ramp, 4000);
  }
  EXPECT_EQ(robot.now_ns(), 7 * kSecond + 5);
  EXPECT_EQ(robot.counts().contacts, 0u);
}

TEST(Robot, CutsOfTimeDoNotMatterAwayFromContacts) {
  const Obstacles obstacles(plain().triangles);
  Robot whole(obstacles, round_robot()), cut(obstacles, round_robot());
  whole.put({0, 0, 0.25}, 0.3, 0);
  cut.put({0, 0, 0.25}, 0.3, 0);
  whole.advance(kRamps);
  Dice dice(4);
  for (const TwistRamp& ramp : kRamps) {
    std::int64_t done = 0;
    while (done < ramp.duration_ns) {
      const std::int64_t more = std::min(ramp.duration_ns - done, static_cast<std::int64_t>(dice.in(1, 1e8)));
      const auto share = [&](std::int64_t t) {
        return static_cast<double>(t) / static_cast<double>(ramp.duration_ns);
      };
      drive(cut, {ramp.at(share(done)), ramp.at(share(done + more)), more});
      done += more;
    }
  }
  EXPECT_EQ(whole.now_ns(), cut.now_ns());
  EXPECT_LT((whole.pose().t - cut.pose().t).norm(), 1e-12);
  EXPECT_LT(angle_between(whole.pose().q, cut.pose().q), 1e-7);  // of an acos near 1
  EXPECT_LT((whole.pose().q * Vec3::UnitX() - cut.pose().q * Vec3::UnitX()).norm(), 1e-12);
}

TEST(Robot, CutsOfTimeHardlyMatterOnAWall) {
  Scene scene = plain();
  scene.wall({-50, 1}, {50, 1});
  const Obstacles obstacles(scene.triangles);
  std::vector<Vec3> ends;
  for (const int count : {1, 7, 40, 333}) {
    Robot robot(obstacles, round_robot());
    robot.put({0, 0.5, 0.25}, 0.4, 0);
    for (int i = 0; i < count; ++i) drive(robot, steady(0.8, 0, 0, 2.0 / count));
    ends.push_back(robot.pose().t);
  }
  for (const Vec3& end : ends) EXPECT_LT((end - ends[0]).norm(), 2e-3);
}

TEST(Robot, SameCallsSameBytes) {
  Scene scene = plain();
  Dice dice(8);
  for (int i = 0; i < 40; ++i) scene.box({dice.in(-3, 3), dice.in(-3, 3) + 4}, 0.3, 0.2, 0, 1, dice.in(0, 3));
  const Obstacles obstacles(scene.triangles);
  const auto run = [&] {
    Robot robot(obstacles, odd_robot());
    EXPECT_EQ(robot.put({0, 0, 0.25}, 0.3, 0), Start::kStands);
    Dice way(9);
    std::vector<double> bytes;
    for (int i = 0; i < 40; ++i) {
      const Advance advance = drive(robot, steady(way.in(-0.5, 1), way.in(-0.3, 0.3), way.in(-2, 2), 0.3));
      for (const Touch& touch : advance.touching) bytes.push_back(touch.gap_m + touch.normal.x());
      for (Eigen::Index k = 0; k < 3; ++k) bytes.push_back(robot.pose().t[k]);
      for (Eigen::Index k = 0; k < 4; ++k) bytes.push_back(robot.pose().q.coeffs()[k]);
    }
    return bytes;
  };
  const std::vector<double> first = run(), second = run();
  ASSERT_EQ(first.size(), second.size());
  EXPECT_EQ(std::memcmp(first.data(), second.data(), first.size() * sizeof(double)), 0);
}

/// Ramps, low things that wheels climb or not and that undersides meet, and posts.
Scene uneven_scene(Dice& dice) {
  Scene scene = plain();
  for (int i = 0; i < 12; ++i) {
    const double x = dice.in(-3, 3), run = dice.in(0.2, 1.5), rise = run * dice.in(0.05, 0.3);
    scene.ramp(x, x + run, 0.0, rise, dice.in(0.1, 2.0));
    scene.ramp(x + run, x + run + dice.in(0.5, 1.5), rise, 0.0, dice.in(0.1, 2.0));
  }
  for (int i = 0; i < 12; ++i) {
    scene.box({dice.in(-3, 3), dice.in(-3, 3)}, dice.in(0.05, 0.8), dice.in(0.05, 0.8), -0.1,
              dice.in(0.005, 0.06), dice.in(0, 3));
  }
  return scene;
}

TEST(Robot, WhatStandsTouchesSomething) {
  std::int64_t stood = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(seed);
    Dice dice(seed);
    const Obstacles obstacles(uneven_scene(dice).triangles);
    Robot robot(obstacles, seed % 3 == 0 ? round_robot() : seed % 3 == 1 ? box_robot() : odd_robot());
    int tries = 0;
    while (robot.put({dice.in(-3, 3), dice.in(-3, 3), 0.5}, dice.in(0, 6), 0) != Start::kStands &&
           ++tries < 100) {
    }
    TwistRamp wanted = steady(0, 0, 0, 0.05);
    for (int i = 0; i < 600; ++i) {
      if (i % 40 == 0)
        wanted = steady(dice.in(-0.6, 0.6), dice.in(-0.2, 0.2), i % 80 == 0 ? 0.0 : dice.in(-1.5, 1.5), 0.05);
      const std::int64_t before_ns = robot.counts().stood_ns;
      const Advance advance = drive(robot, wanted);
      const std::int64_t stood_ns = robot.counts().stood_ns - before_ns;
      stood += stood_ns;
      ASSERT_FALSE(stood_ns == wanted.duration_ns && advance.touching.empty()) << "slice " << i;
      for (const Touch& touch : advance.touching) ASSERT_LE(touch.gap_m, kContactRange) << "slice " << i;
    }
  }
  EXPECT_GT(stood, 10 * kSecond);
}

TEST(Robot, HistoryHasNoGaps) {
  Scene scene = plain();
  scene.wall({1, -50}, {1, 50});
  const Obstacles obstacles(scene.triangles);
  Robot robot(obstacles, box_robot());
  robot.put({0, 0, 0.25}, 0.2, 100);
  drive(robot, steady(1, 0, 0.5, 2.0));
  const History& history = robot.history();
  std::int64_t end = 100;
  Pose last = history.pose_at(100);
  for (const Part& part : history.parts()) {
    EXPECT_EQ(part.begin_ns, end);
    EXPECT_EQ(part.from.t, last.t);
    EXPECT_LT((pose_in(part, 1.0 - 1e-9).t - part.to.t).norm(), 1e-9);
    end = part.end_ns();
    last = part.to;
  }
  EXPECT_EQ(end, robot.now_ns());
  EXPECT_EQ(history.pose_at(end).t, robot.pose().t);
  EXPECT_TRUE(hallway::test::error_of([&] { history.pose_at(99); }));
  EXPECT_TRUE(hallway::test::error_of([&] { history.pose_at(end + 1); }));
  robot.forget_before(end - 1000);
  EXPECT_EQ(history.pose_at(end - 500).t.allFinite(), true);
  EXPECT_LE(history.parts().size(), 2u);
}

TEST(Robot, PushesAddToWhatIsWanted) {
  const Obstacles obstacles(plain().triangles);
  Robot robot(obstacles, box_robot());
  robot.put({0, 0, 0.25}, 0, 0);
  robot.push({0, 0.5, 0}, kSecond / 2);
  robot.push({0, 0.5, 0}, kSecond);
  drive(robot, steady(1, 0, 0, 2.0));
  EXPECT_NEAR(robot.pose().t.x(), 2.0, 1e-12);
  EXPECT_NEAR(robot.pose().t.y(), 0.75, 1e-12);
  EXPECT_EQ(robot.twist(), (PlanarTwist{1, 0, 0}));
}

TEST(Robot, Starts) {
  Scene scene;
  scene.floor(-2, -2, 2, 2);
  scene.box({0, 1}, 0.5, 0.5, 0, 1);
  scene.ramp(5, 15, 0, 20);
  const Obstacles obstacles(scene.triangles);
  Robot robot(obstacles, box_robot());
  EXPECT_EQ(robot.put({0, 0, 0}, 0, 0), Start::kStands);
  EXPECT_EQ(robot.put({0, 0, 1.5}, 0, 0), Start::kStands);  // put down
  EXPECT_EQ(robot.pose().t.z(), 0.0);
  EXPECT_EQ(robot.put({0, 0.7, 0}, 0, 0), Start::kInObstacle);
  drive(robot, steady(1, 0, 0, 1));
  EXPECT_EQ(robot.pose().t.x(), 0.0);
  EXPECT_TRUE(robot.is_lost());
  EXPECT_EQ(robot.put({0, 0, 0}, 0, 0, [](const Vec3& p) { return p.z() > 0.2; }), Start::kInSolid);
  EXPECT_EQ(robot.put({0, 0, -0.1}, 0, 0), Start::kNoFloor);
  EXPECT_EQ(robot.put({30, 0, 0}, 0, 0), Start::kNoFloor);
  EXPECT_EQ(robot.put({1.95, 0, 0}, 0, 0), Start::kNoStance);  // two wheels over the edge
  EXPECT_EQ(robot.put({10, 0, 10}, 0, 0), Start::kNoStance);
  EXPECT_EQ(robot.put({0, 0, 0}, 0, 0), Start::kStands);
  EXPECT_FALSE(robot.is_lost());
}

TEST(Robot, RefusesBadInput) {
  const auto refused = [](auto work) {
    const auto error = hallway::test::error_of(work);
    return error && error->code() == ErrorCode::kBadInput;
  };
  const Obstacles obstacles(plain().triangles);
  Robot robot(obstacles, box_robot());
  robot.put({0, 0, 0.25}, 0, 0);
  for (const double bad : {1e300, -1e300, 101.0, double(NAN), double(INFINITY)}) {
    EXPECT_TRUE(refused([&] { drive(robot, steady(bad, 0, 0, 1)); }));
    EXPECT_TRUE(refused([&] { drive(robot, steady(0, bad, 0, 1)); }));
    EXPECT_TRUE(refused([&] { drive(robot, {{}, {0, 0, bad}, kSecond}); }));
    EXPECT_TRUE(refused([&] { robot.push({bad, 0, 0}, kSecond); }));
  }
  EXPECT_TRUE(refused([&] { drive(robot, {{}, {}, 0}); }));
  EXPECT_TRUE(refused([&] { drive(robot, {{}, {}, -5}); }));
  EXPECT_TRUE(refused([&] { robot.put({NAN, 0, 0}, 0, 0); }));
  EXPECT_TRUE(refused([&] { robot.put({0, 0, 0}, INFINITY, 0); }));
  EXPECT_EQ(robot.now_ns(), 0);
  EXPECT_TRUE(refused([] { Obstacles({{Vec3(0, 0, NAN), Vec3(0, 1, 0), Vec3(1, 0, 0)}}); }));
  EXPECT_TRUE(refused([] { Obstacles({{Vec3(0, 0, 1e9), Vec3(0, 1, 0), Vec3(1, 0, 0)}}); }));
  const auto refused_spec = [&](auto change) {
    RobotSpec spec = box_robot();
    change(spec);
    return refused([&] { Robot(obstacles, spec); });
  };
  EXPECT_TRUE(refused_spec([](RobotSpec& spec) { spec.shape = BodyShape::box({-1, -1, 0}, {1, 1, 1}); }));
  EXPECT_TRUE(refused_spec([](RobotSpec& spec) { spec.wheels.at.pop_back(), spec.wheels.at.pop_back(); }));
  EXPECT_TRUE(refused_spec([](RobotSpec& spec) { spec.wheels.at[0].x() = NAN; }));
  EXPECT_TRUE(refused_spec([](RobotSpec& spec) { spec.wheels.centre_of_mass.x() = 1.0; }));
  EXPECT_TRUE(refused_spec([](RobotSpec& spec) { spec.ground.step_m = NAN; }));
  EXPECT_TRUE(refused_spec([](RobotSpec& spec) { spec.ground.slope_rad = 1.5; }));
  EXPECT_TRUE(refused_spec([](RobotSpec& spec) { spec.move.gyration = 0.0; }));
}

TEST(Robot, TheGreatestTwistsAreDriven) {
  Scene scene;
  scene.room(-2, -2, 2, 2);
  const Obstacles obstacles(scene.triangles);
  for (const RobotSpec& spec : {box_robot(), round_robot(), odd_robot()}) {
    Robot robot(obstacles, spec);
    robot.put({0, 0, 0}, 0, 0);
    drive(robot, {{kGreatestSpeed, -kGreatestSpeed, kGreatestTurn},
                  {-kGreatestSpeed, 1, -kGreatestTurn},
                  kSecond / 5});
    EXPECT_EQ(robot.now_ns(), kSecond / 5);
    EXPECT_LT(robot.pose().t.cwiseAbs().maxCoeff(), 2.0);
    EXPECT_LE(robot.counts().parts, 3u * kMostParts);
  }
}

TEST(Robot, FarFromTheOrigin) {
  Scene near, far;
  near.room(-2, -2, 2, 2);
  const Vec3 away(1e4, -2e4, 100);
  for (const Triangle& t : near.triangles) far.triangles.push_back({t[0] + away, t[1] + away, t[2] + away});
  const Obstacles near_obstacles(near.triangles), far_obstacles(far.triangles);
  Robot here(near_obstacles, round_robot()), there(far_obstacles, round_robot());
  ASSERT_EQ(here.put(Vec3::Zero(), 0, 0), Start::kStands);
  ASSERT_EQ(there.put(away, 0, 0), Start::kStands);
  for (int i = 0; i < 10; ++i) {
    const TwistRamp ramp = steady(1, 0, 0.5 * (i % 3), 0.5);
    drive(here, ramp);
    drive(there, ramp);
  }
  EXPECT_LT((here.pose().t - (there.pose().t - away)).norm(), 1e-3);
}

}  // namespace
}  // namespace hallway::contact::test
