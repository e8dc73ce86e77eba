// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "eval/driven_way.hpp"
#include "eval/floor_plan.hpp"
#include "eval/topology_truth.hpp"
#include "log/topology.hpp"

namespace hallway::test {

/// The boundary of free space: closed polygons with free space on the left.
using Boundary = std::vector<std::vector<Vec2>>;

/// A motion of the plane: turns about the origin, then shifts.
struct PlaneMotion {
  double yaw_rad = 0.0;
  Vec2 shift = Vec2::Zero();

  Vec2 operator*(const Vec2& p) const {
    const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
    return Vec2(c * p.x() - s * p.y(), s * p.x() + c * p.y()) + shift;
  }
};

inline eval::FloorPlan plan_of(const Boundary& boundary, const PlaneMotion& motion = {}) {
  std::vector<eval::PlanSegment> segments;
  for (const std::vector<Vec2>& polygon : boundary) {
    for (std::size_t i = 0; i < polygon.size(); ++i)
      segments.push_back({motion * polygon[i], motion * polygon[(i + 1) % polygon.size()]});
  }
  return eval::FloorPlan(segments);
}

/// A robot that drives straight and turns in place: a pose each 2 cm or 5 degrees, ten a second.
class Drive {
 public:
  Drive(double x_m, double y_m, double yaw_deg) : pose_{x_m, y_m, yaw_deg * kDegree} { add(); }

  Drive& forward(double length_m) {
    const int steps = static_cast<int>(std::lround(std::abs(length_m) / 0.02));
    const PlanarPose start = pose_;
    for (int i = 1; i <= steps; ++i) {
      const double driven = length_m * i / steps;
      pose_.x_m = start.x_m + driven * std::cos(start.yaw_rad);
      pose_.y_m = start.y_m + driven * std::sin(start.yaw_rad);
      add();
    }
    return *this;
  }
  Drive& turn(double angle_deg) {
    const int steps = static_cast<int>(std::lround(std::abs(angle_deg) / 5.0));
    const double start = pose_.yaw_rad;
    for (int i = 1; i <= steps; ++i) {
      pose_.yaw_rad = start + angle_deg * kDegree * i / steps;
      add();
    }
    return *this;
  }
  Drive& left() { return turn(90); }
  Drive& right() { return turn(-90); }

  eval::DrivenWay way(const PlaneMotion& motion = {}) const {
    eval::DrivenWay way;
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      const Vec2 place = motion * Vec2(poses_[i].x_m, poses_[i].y_m);
      way.add(time(i), {place.x(), place.y(), poses_[i].yaw_rad + motion.yaw_rad});
    }
    return way;
  }
  /// The same way with heading and distance from the wall that waver.
  eval::DrivenWay wavering_way() const {
    eval::DrivenWay way;
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      const PlanarPose& pose = poses_[i];
      const double phase = 0.11 * static_cast<double>(i), aside_m = 0.04 * std::sin(phase);
      way.add(time(i),
              {pose.x_m - aside_m * std::sin(pose.yaw_rad), pose.y_m + aside_m * std::cos(pose.yaw_rad),
               pose.yaw_rad + 6 * kDegree * std::cos(phase)});
    }
    return way;
  }

 private:
  static constexpr double kDegree = std::numbers::pi / 180;
  static std::int64_t time(std::size_t i) { return static_cast<std::int64_t>(i) * 100'000'000; }
  void add() { poses_.push_back(pose_); }

  PlanarPose pose_;
  std::vector<PlanarPose> poses_;
};

/// A room of 4 x 4 m with a niche of 1 x 0.3 m in its southern wall.
inline Boundary niche_room() {
  return {{{0, 0}, {1.5, 0}, {1.5, -0.3}, {2.5, -0.3}, {2.5, 0}, {4, 0}, {4, 4}, {0, 4}}};
}
/// Once around in it, 0.4 m from the walls, and along the southern wall again.
inline Drive niche_drive() {
  Drive drive(0.6, 0.4, 0);
  drive.forward(3.0).left().forward(3.2).left().forward(3.2).left().forward(3.2).left().forward(3.2);
  return drive;
}

/// A hallway of 20 x 2 m. On its southern side are a doorway of 1 m through a wall of 0.2 m into a room of 3 x 3 m, and a hallway
/// of 1.5 x 8 m that ends.
inline Boundary doorway_hall() {
  return {{{0, 0},
           {3, 0},
           {3, -0.2},
           {2, -0.2},
           {2, -3.2},
           {5, -3.2},
           {5, -0.2},
           {4, -0.2},
           {4, 0},
           {7, 0},
           {7, -8},
           {8.5, -8},
           {8.5, 0},
           {20, 0},
           {20, 2},
           {0, 2}}};
}
/// Past the doorway, into the hallway, to its end and out again.
inline Drive doorway_drive() {
  Drive drive(1, 0.5, 0);
  drive.forward(6.5).right().forward(8).left().forward(0.5).left().forward(8).right().forward(3);
  return drive;
}

/// A corridor 12 m long whose southern wall is staggered: 0.2 m nearer from 3 m on, 0.3 m farther from 6 m on, 0.1 m nearer from
/// 9 m on. At its end it is 1.8 m wide.
inline Boundary staggered_corridor() {
  return {{{0, 0}, {3, 0}, {3, 0.2}, {6, 0.2}, {6, -0.1}, {9, -0.1}, {9, 0}, {12, 0}, {12, 1.8}, {0, 1.8}}};
}
/// To its end and back.
inline Drive staggered_drive() {
  Drive drive(0.5, 0.7, 0);
  drive.forward(10.8).left().forward(0.4).left().forward(10.6);
  return drive;
}

/// Once around a polygon whose sides are along the axes and `clear_m` from its walls, into everything, from the middle of its first side and on along that side.
inline Drive drive_around(const std::vector<Vec2>& polygon, double clear_m) {
  const std::size_t n = polygon.size();
  const auto side = [&](std::size_t i) -> Vec2 { return polygon[(i + 1) % n] - polygon[i % n]; };
  const auto turns_left = [&](std::size_t i) {  // at the end of side i
    return side(i).x() * side((i + 1) % n).y() - side(i).y() * side((i + 1) % n).x() > 0.0;
  };
  // At an inner corner the robot stops before the wall ahead, at an outer one it drives past the corner.
  const auto end_m = [&](std::size_t i) { return turns_left(i) ? -clear_m : clear_m; };
  const Vec2 along = side(0).normalized(),
             start = 0.5 * (polygon[0] + polygon[1]) + clear_m * Vec2(-along.y(), along.x());
  Drive drive(start.x(), start.y(), std::atan2(along.y(), along.x()) * 180 / std::numbers::pi);
  drive.forward(0.5 * side(0).norm() + end_m(0));
  for (std::size_t i = 1; i <= n; ++i) {
    turns_left(i - 1) ? drive.left() : drive.right();
    drive.forward(side(i).norm() + end_m((i - 1) % n) + end_m(i % n));
  }
  return drive;
}

/// The chart that says what is true, demanded or not: its nodes are seen at the frame nearest to the first pass, its edges lead from each
/// pass to the next one.
inline log::Topology chart_of(const eval::TopologyTruth& truth, const eval::DrivenWay& way) {
  const auto kind_of = [](eval::TrueKind kind) {
    switch (kind) {
      case eval::TrueKind::kRoom:
        return log::PlaceKind::kRoom;
      case eval::TrueKind::kHallway:
      case eval::TrueKind::kDeadEnd:
        return log::PlaceKind::kHallwayEnd;
      default:
        return log::PlaceKind::kDiscontinuity;
    }
  };
  log::Topology chart;
  chart.loop = truth.came_around ? log::LoopState::kClosed : log::LoopState::kOpen;
  for (std::size_t i = 0; i < truth.passes.size(); ++i) {
    const eval::TruePass& pass = truth.passes[i];
    const auto id = static_cast<std::uint32_t>(pass.node + 10);
    if (i > 0) {
      const eval::TruePass& before = truth.passes[i - 1];
      chart.edges.push_back({static_cast<std::uint32_t>(before.node + 10), id, pass.way_m - before.way_m});
    }
    bool is_new = true;
    for (log::TopologyNode& node : chart.nodes) {
      if (node.id != id) continue;
      is_new = false;
      ++node.visits;
    }
    if (!is_new) continue;
    const eval::TrueNode& node = truth.nodes[pass.node];
    const eval::WayPose* nearest = &way.poses().front();
    for (const eval::WayPose& pose : way.poses()) {
      if (std::abs(pose.way_m - pass.way_m) < std::abs(nearest->way_m - pass.way_m)) nearest = &pose;
    }
    const Vec2 place = nearest->body(node.from);
    chart.nodes.push_back({.id = id,
                           .kind = kind_of(node.kind),
                           .direction = node.direction,
                           .t_ns = nearest->t_ns,
                           .x_m = place.x(),
                           .y_m = place.y()});
  }
  return chart;
}

}  // namespace hallway::test
