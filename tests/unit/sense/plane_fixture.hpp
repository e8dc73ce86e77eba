// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "geometry/se3.hpp"
#include "sense/plane_sensor.hpp"

namespace hallway::test {

/// The height of the sensor over the floor.
inline constexpr double kEye_m = 1.0;

/// Ends of a wall as its empty side sees them.
struct WallEnds {
  Vec2 left, right;
};

/// Walls from the floor to 3 m, which hide what is behind them.
inline sense::WallPlan plan_of(const std::vector<WallEnds>& walls) {
  sense::WallPlan plan;
  plan.height_m = kEye_m;
  for (const auto& [left, right] : walls) {
    plan.walls.push_back({.left = left, .right = right, .low_m = 0.0, .high_m = 3.0});
    plan.obstacles.push_back({left, right});
  }
  return plan;
}

/// The walls of an upright box.
inline std::vector<WallEnds> box_walls(const Vec2& low, const Vec2& high) {
  const Vec2 a = low, b(high.x(), low.y()), c = high, d(low.x(), high.y());
  return {{a, b}, {b, c}, {c, d}, {d, a}};
}

/// 90 degrees, 12 m, without noise.
inline sense::PlaneSensorSpec plane_camera() {
  sense::PlaneSensorSpec spec;
  spec.name = "eyes";
  return spec;
}

/// A robot at a place that looks in a direction, with its sensor at kEye_m.
inline Pose standing(double x = 0.0, double y = 0.0, double yaw = 0.0) {
  return {from_yaw_pitch_roll(yaw, 0, 0), {x, y, kEye_m}};
}

inline std::vector<PlaneObservation> observe(const sense::PlaneSensor& sensor, const Pose& pose,
                                             std::uint32_t step = 0) {
  std::vector<PlaneObservation> planes;
  sensor.observe(pose, step, planes);
  return planes;
}

/// What is seen without noise, by wall and from left to right.
inline std::vector<PlaneObservation> seen_of(const sense::PlaneSensorSpec& spec, const sense::WallPlan& plan,
                                             const Pose& pose = standing()) {
  auto planes = observe(sense::PlaneSensor(spec, plan, 1), pose);
  const auto left_bearing = [](const PlaneObservation& plane) {
    return std::atan2(plane.corners[0].y(), plane.corners[0].x());
  };
  std::sort(planes.begin(), planes.end(), [&](const auto& a, const auto& b) {
    return std::pair(a.true_plane, -left_bearing(a)) < std::pair(b.true_plane, -left_bearing(b));
  });
  return planes;
}

/// Whether a plane reaches from one point to another, sensor frame.
inline bool reaches(const PlaneObservation& plane, const Vec2& left, const Vec2& right) {
  constexpr double kRounding_m = 1e-12;
  return (plane.corners[0].head<2>() - left).norm() < kRounding_m &&
         (plane.corners[1].head<2>() - right).norm() < kRounding_m;
}

/// An upright brush over a convex polygon, counter-clockwise from above; map units.
inline std::string prism_brush(const std::vector<Vec2>& corners, double low, double high) {
  const auto point = [](const Vec2& at, double z) {
    return "( " + format_double(at.x()) + " " + format_double(at.y()) + " " + format_double(z) + " ) ";
  };
  const std::string axes = "wall [ 1 0 0 0 ] [ 0 -1 0 0 ] 0 1 1\n";
  const Vec2 &a = corners[0], &b = corners[1], &c = corners[2];
  std::string text = "{\n" + point(a, high) + point(c, high) + point(b, high) + axes;
  text += point(a, low) + point(b, low) + point(c, low) + axes;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 &from = corners[i], &to = corners[(i + 1) % corners.size()];
    text += point(from, low) + point(from, high) + point(to, low) + axes;
  }
  return text + "}\n";
}

}  // namespace hallway::test
