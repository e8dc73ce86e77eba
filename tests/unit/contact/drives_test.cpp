// SPDX-License-Identifier: MIT
// Bodies that drive among obstacles: an oracle that shares no code with the library looks at every pose.
#include <gtest/gtest.h>

#include <string>

#include "support/long_mode.hpp"
#include "support/overlap_oracle.hpp"
#include "unit/contact/scene.hpp"

namespace hallway::contact::test {
namespace {

struct Body {
  std::string name;
  RobotSpec spec;
  double radius = 0.0;  ///< of a cylinder
};

std::vector<Body> bodies() {
  return {{"box", box_robot(), 0.0}, {"cylinder", round_robot(), 0.2}, {"odd", odd_robot(), 0.0}};
}

/// Looks at poses of a history, at parts' ends and between.
class Watch {
 public:
  Watch(const Body& body, const Scene& scene)
      : body_(body), scene_(scene), hull_(body.spec.shape.vertices()) {}

  void look(Robot& robot) {
    for (const Part& part : robot.history().parts()) {
      for (const double share : {0.0, 0.31, 0.5, 0.77, 1.0}) {
        const std::int64_t t =
            part.begin_ns + static_cast<std::int64_t>(share * static_cast<double>(part.ramp.duration_ns));
        if (part.ramp.duration_ns > 0) look_at(robot.history().pose_at(t), t);
      }
      look_at(part.from, part.begin_ns);
      look_at(part.to, part.end_ns());
    }
    robot.forget_before(robot.now_ns() + 1);
  }

  int poses() const { return poses_; }

 private:
  void look_at(const Pose& pose, std::int64_t t) {
    ++poses_;
    const double reach = body_.spec.shape.radius();
    ASSERT_TRUE(pose.t.allFinite() && pose.q.coeffs().allFinite());
    for (const Triangle& triangle : scene_.triangles) {
      bool far = false;
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const double low = std::min({triangle[0][axis], triangle[1][axis], triangle[2][axis]});
        const double high = std::max({triangle[0][axis], triangle[1][axis], triangle[2][axis]});
        far = far || low > pose.t[axis] + reach || high < pose.t[axis] - reach;
      }
      if (far) continue;
      const double gap = body_.radius > 0.0 ? cylinder_gap(pose.t, body_.radius, 0.03, 0.53, triangle)
                                            : hull_.gap(pose, triangle);
      ASSERT_GT(gap, 0.0) << body_.name << " at " << pose.t.transpose() << ", " << t << " ns";
    }
  }

  const Body& body_;
  const Scene& scene_;
  HullOracle hull_;
  int poses_ = 0;
};

PlanarTwist wild(Dice& dice, double speed) {
  return {dice.in(-speed, speed), dice.below(2) == 0 ? 0.0 : dice.in(-speed, speed),
          dice.below(3) == 0 ? 0.0 : dice.in(-4.0, 4.0)};
}

/// Drives with random ramps; says how far it came.
Counts drive_wildly(const Body& body, const Scene& scene, const Vec3& place, double yaw, std::uint64_t seed,
                    double speed, int ramps) {
  const Obstacles obstacles(scene.triangles);
  Robot robot(obstacles, body.spec);
  const Start start = robot.put(place, yaw, 0);
  EXPECT_EQ(start, Start::kStands) << body.name << ", seed " << seed;
  Watch watch(body, scene);
  Dice dice(seed + 1000);
  PlanarTwist last = wild(dice, speed);
  for (int i = 0; i < ramps && !::testing::Test::HasFatalFailure(); ++i) {
    const PlanarTwist next = dice.below(4) == 0 ? last : wild(dice, speed);
    drive(robot, {last, next, static_cast<std::int64_t>(dice.in(0.01, 0.4) * 1e9)});
    watch.look(robot);
    last = next;
  }
  return robot.counts();
}

TEST(Drives, RandomRooms) {
  const int seeds = hallway::test::long_mode() ? 1000 : 60;
  std::uint64_t contacts = 0;
  double distance = 0.0;
  for (int seed = 0; seed < seeds; ++seed) {
    Dice dice(static_cast<std::uint64_t>(seed));
    Scene scene;
    scene.room(-2, -2, 2, 2);
    for (int i = 0; i < 10; ++i) {
      const double angle = dice.in(0, 6.28), away = dice.in(0.8, 2.0);
      // Some stand on the floor, some hang above it: low enough for the body's top.
      const double low = dice.below(3) == 0 ? dice.in(0.1, 0.5) : 0.0;
      scene.box({away * std::cos(angle), away * std::sin(angle)}, dice.in(0.02, 0.7), dice.in(0.02, 0.7), low,
                low + dice.in(0.1, 1.0), dice.in(0, 3));
    }
    for (const Body& body : bodies()) {
      const Counts counts =
          drive_wildly(body, scene, {0, 0, 0}, dice.in(-3, 3), static_cast<std::uint64_t>(seed), 1.5, 12);
      contacts += counts.contacts;
      distance += counts.distance_m;
    }
  }
  EXPECT_GT(contacts, static_cast<std::uint64_t>(seeds));
  EXPECT_GT(distance, 1.0 * seeds);
}

TEST(Drives, TightPlaces) {
  const int seeds = hallway::test::long_mode() ? 400 : 15;
  for (int seed = 0; seed < seeds; ++seed) {
    const auto key = static_cast<std::uint64_t>(seed);
    for (const Body& body : bodies()) {
      const double half = body.name == "box" ? 0.15 : body.name == "odd" ? 0.26 : 0.2;
      Scene corridor;  // of the body's width and a millimetre
      corridor.room(-3, -half - 0.0005, 3, half + 0.0005);
      drive_wildly(body, corridor, {0, 0, 0}, 0.0, key, 1.0, 10);
      Scene box;  // in which it can hardly turn
      const double side = body.spec.shape.vertices().empty() ? 0.2003 : body.name == "odd" ? 0.262 : 0.252;
      box.room(-side, -side, side, side);
      drive_wildly(body, box, {0, 0, 0}, 0.0, key, 1.0, 10);
      Scene wedge;
      wedge.floor(-5, -5, 5, 5);
      wedge.wall({-2, 0.9}, {3, -0.02});
      wedge.wall({-2, -0.9}, {3, 0.02});
      drive_wildly(body, wedge, {-1.4, 0, 0}, 0.0, key, 2.0, 10);
      Scene spikes;  // corners of triangles that point at the body, at all heights
      spikes.floor(-5, -5, 5, 5);
      Dice dice(key + 7);
      for (int i = 0; i < 24; ++i) {
        const double angle = 0.2618 * i, away = dice.in(0.4, 0.8), z = dice.in(0.04, 0.5);
        const Vec3 out(std::cos(angle), std::sin(angle), 0.0), tip = away * out + Vec3(0, 0, z);
        spikes.triangles.push_back(
            {tip, tip + out + 0.1 * dice.point(1.0), tip + out + 0.1 * dice.point(1.0)});
      }
      drive_wildly(body, spikes, {0, 0, 0}, 0.0, key, 1.0, 10);
    }
  }
}

TEST(Drives, ThinThingsHitFast) {
  for (const Body& body : bodies()) {
    for (int seed = 0; seed < (hallway::test::long_mode() ? 1000 : 25); ++seed) {
      Dice dice(static_cast<std::uint64_t>(seed));
      Scene scene;
      scene.floor(-5, -5, 5, 5);
      scene.wall({1.0, -4.0}, {dice.in(1.0, 1.3), 4.0}, 0.0, dice.in(0.05, 0.6));
      const double x = dice.in(0.8, 1.5), y = dice.in(-0.2, 0.2);
      scene.triangles.push_back(
          {Vec3(x, y, 0.2), Vec3(x + 1e-6, y, 0.4), Vec3(x, y + 1e-6, 0.4)});  // a needle
      const Obstacles obstacles(scene.triangles);
      Robot robot(obstacles, body.spec);
      ASSERT_EQ(robot.put({-0.5, 0, 0}, dice.in(-0.1, 0.1), 0), Start::kStands);
      Watch watch(body, scene);
      drive(robot, steady(10.0, dice.in(-1, 1), dice.in(-2, 2), 0.4));
      watch.look(robot);
      EXPECT_LT(robot.pose().t.x(), 1.5) << body.name << ", seed " << seed;
      EXPECT_GE(robot.counts().contacts, 1u);
    }
  }
}

TEST(Drives, UnevenFloors) {
  const int seeds = hallway::test::long_mode() ? 200 : 10;
  for (int seed = 0; seed < seeds; ++seed) {
    Dice dice(static_cast<std::uint64_t>(seed));
    Scene scene;
    std::array<std::array<double, 21>, 21> height{};
    for (auto& row : height) {
      for (double& z : row) z = dice.in(0.0, 0.012);
    }
    const auto at = [&](std::size_t i, std::size_t j) {
      return Vec3(0.2 * static_cast<double>(i) - 2.0, 0.2 * static_cast<double>(j) - 2.0, height[i][j]);
    };
    for (std::size_t i = 0; i < 20; ++i) {
      for (std::size_t j = 0; j < 20; ++j) scene.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
    for (int i = 0; i < 5; ++i)
      scene.box({dice.in(-2, 2), dice.in(0.5, 2)}, 0.5, 0.3, -0.1, dice.in(0.02, 0.5), dice.in(0, 3));
    for (const Body& body : bodies()) {
      if (body.radius > 0.0) continue;  // its oracle is upright
      const Counts counts =
          drive_wildly(body, scene, {0, -0.3, 0.02}, 0.3, static_cast<std::uint64_t>(seed), 0.8, 8);
      EXPECT_GT(counts.distance_m, 0.01) << seed;
    }
  }
}

/// Drives straight on; leaves what it touches, and turns. The longest time without motion, seconds.
double longest_rest(Robot& robot, std::uint64_t seed, int frames) {
  Dice dice(seed);
  Pose last = robot.pose();
  int back = 0, since = 0, longest = 0;
  double turn = 1.0, away = -0.3;
  for (int i = 0; i < frames; ++i) {
    const TwistRamp ramp = back > 10  ? steady(away, 0, 0, 0.1)
                           : back > 0 ? steady(0, 0, turn, 0.1)
                                      : steady(0.5, 0, 0.05, 0.1);
    const Advance advance = drive(robot, ramp);
    robot.forget_before(robot.now_ns());
    if (back > 0) --back;
    if (back == 0 && !advance.touching.empty()) {
      back = 12 + dice.below(12);
      turn = dice.below(2) == 0 ? 1.0 : -1.0;
      Vec3 normals = Vec3::Zero();
      for (const Touch& touch : advance.touching) normals += touch.normal;
      away = normals.dot(robot.pose().q * Vec3::UnitX()) < 0.0 ? -0.3 : 0.3;
    }
    ++since;
    if ((robot.pose().t - last.t).norm() > 0.02 || angle_between(robot.pose().q, last.q) > 0.05) {
      last = robot.pose();
      since = 0;
    }
    longest = std::max(longest, since);
  }
  return 0.1 * longest;
}

TEST(Drives, WandererNeverStandsForLong) {
  // On a floor that tilts it, which brings it nearer to walls and away from them.
  const int frames = hallway::test::long_mode() ? 36000 : 1500;
  for (std::uint64_t seed = 0; seed < (hallway::test::long_mode() ? 10 : 2); ++seed) {
    Dice dice(seed + 50);
    Scene scene;
    std::array<std::array<double, 62>, 62> height{};
    for (auto& row : height) {
      for (double& z : row) z = dice.in(0.0, 0.004);
    }
    const auto at = [&](std::size_t i, std::size_t j) {
      return Vec3(0.12 * static_cast<double>(i) - 3.6, 0.12 * static_cast<double>(j) - 3.6, height[i][j]);
    };
    for (std::size_t i = 0; i < 61; ++i) {
      for (std::size_t j = 0; j < 61; ++j) scene.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
    const double corner[5][2] = {{-3, -3}, {3, -3}, {3, 3}, {-3, 3}, {-3, -3}};
    for (int i = 0; i < 4; ++i)
      scene.wall({corner[i][0], corner[i][1]}, {corner[i + 1][0], corner[i + 1][1]}, -0.1);
    for (int i = 0; i < 14; ++i) {
      const Vec2 middle(dice.in(-3, 3), dice.in(-3, 3));
      if (middle.norm() > 0.9)
        scene.box(middle, dice.in(0.05, 0.6), dice.in(0.05, 0.6), -0.1, 1.0, dice.in(0, 3));
    }
    const Obstacles obstacles(scene.triangles);
    for (const Body& body : bodies()) {
      Robot robot(obstacles, body.spec);
      ASSERT_EQ(robot.put({0, 0, 0.01}, 0, 0), Start::kStands);
      EXPECT_LT(longest_rest(robot, seed, frames), 10.0) << body.name << ", seed " << seed;
      EXPECT_GT(robot.counts().distance_m, 0.015 * frames) << body.name;
    }
  }
}

}  // namespace
}  // namespace hallway::contact::test
