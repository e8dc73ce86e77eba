// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vector>

#include "base/random.hpp"
#include "contact/robot.hpp"

namespace hallway::contact::test {

/// Random numbers in order.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed, stream_id("contact.test")) {}
  double in(double low, double high) { return random_.uniform(0, next_++, low, high); }
  int below(int count) { return static_cast<int>(in(0.0, count)); }
  Vec3 point(double size) { return {in(-size, size), in(-size, size), in(-size, size)}; }
  Vec3 direction() {
    Vec3 v = point(1.0);
    while (v.norm() < 0.1 || v.norm() > 1.0) v = point(1.0);
    return v.normalized();
  }
  Pose pose(double size) { return {rotation_by(in(0.0, 3.0) * direction()), point(size)}; }

 private:
  Random random_;
  std::uint64_t next_ = 0;
};

/// Triangles of simple things. Metres.
struct Scene {
  std::vector<Triangle> triangles;

  void quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  }
  /// A level rectangle.
  void floor(double x0, double y0, double x1, double y1, double z = 0.0) {
    quad({x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z});
  }
  /// An upright box about a middle, turned about it.
  void box(const Vec2& middle, double length, double width, double low, double high, double yaw = 0.0) {
    const Vec2 u(std::cos(yaw), std::sin(yaw)), v(-u.y(), u.x());
    const auto at = [&](double x, double y, double z) {
      const Vec2 p = middle + 0.5 * x * length * u + 0.5 * y * width * v;
      return Vec3(p.x(), p.y(), z);
    };
    for (const double z : {low, high}) quad(at(-1, -1, z), at(1, -1, z), at(1, 1, z), at(-1, 1, z));
    const double corner[5][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
    for (int i = 0; i < 4; ++i) {
      quad(at(corner[i][0], corner[i][1], low), at(corner[i + 1][0], corner[i + 1][1], low),
           at(corner[i + 1][0], corner[i + 1][1], high), at(corner[i][0], corner[i][1], high));
    }
  }
  /// An upright wall without thickness.
  void wall(const Vec2& a, const Vec2& b, double low = 0.0, double high = 2.0) {
    quad({a.x(), a.y(), low}, {b.x(), b.y(), low}, {b.x(), b.y(), high}, {a.x(), a.y(), high});
  }
  /// Four walls and a floor.
  void room(double x0, double y0, double x1, double y1) {
    floor(x0 - 1.0, y0 - 1.0, x1 + 1.0, y1 + 1.0);
    wall({x0, y0}, {x1, y0});
    wall({x1, y0}, {x1, y1});
    wall({x1, y1}, {x0, y1});
    wall({x0, y1}, {x0, y0});
  }
  /// A part of a plane whose height runs from z0 at x0 to z1 at x1.
  void ramp(double x0, double x1, double z0, double z1, double half_width = 3.0) {
    quad({x0, -half_width, z0}, {x1, -half_width, z1}, {x1, half_width, z1}, {x0, half_width, z0});
  }
};

inline Wheels square_wheels(double half = 0.1) {
  return {{Vec2(half, half), Vec2(-half, half), Vec2(-half, -half), Vec2(half, -half)}, Vec2::Zero()};
}

/// Three wheels.
inline Wheels trike(double size = 0.1) {
  return {{Vec2(size, size), Vec2(size, -size), Vec2(-size, 0.0)}, Vec2(0.3 * size, 0.0)};
}

/// A box of 0.4 x 0.3 x 0.5 m, 3 cm above the floor.
inline RobotSpec box_robot(double half_length = 0.2, double half_width = 0.15) {
  RobotSpec spec{BodyShape::box({-half_length, -half_width, 0.03}, {half_length, half_width, 0.53}),
                 square_wheels()};
  spec.move.gyration = 0.15;
  return spec;
}

inline RobotSpec round_robot(double radius = 0.2) {
  RobotSpec spec{BodyShape::cylinder(radius, 0.03, 0.53), trike()};
  spec.move.gyration = 0.15;
  return spec;
}

/// A prism over an uneven hexagon that is wider at its top.
inline RobotSpec odd_robot() {
  std::vector<Vec3> corners;
  for (int i = 0; i < 6; ++i) {
    const double angle = 1.05 * i + 0.2, radius = 0.15 + 0.02 * i;
    corners.emplace_back(0.8 * radius * std::cos(angle), 0.8 * radius * std::sin(angle), 0.04);
    corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.4);
  }
  RobotSpec spec{BodyShape::polytope(corners), trike()};
  spec.move.gyration = 0.15;
  return spec;
}

constexpr std::int64_t kSecond = 1'000'000'000;

inline TwistRamp steady(double x, double y, double turn, double seconds) {
  const PlanarTwist twist{x, y, turn};
  return {twist, twist, static_cast<std::int64_t>(std::llround(seconds * 1e9))};
}

inline Advance drive(Robot& robot, const TwistRamp& ramp) {
  return robot.advance(std::span(&ramp, 1));
}

}  // namespace hallway::contact::test
