// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hallway::slam_plane {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat2 = Eigen::Matrix2d;
using Mat3 = Eigen::Matrix3d;

/// A vector turned by 90 degrees to the left.
inline Vec2 left_of(const Vec2& v) {
  return {-v.y(), v.x()};
}

/// z component of the cross product of two vectors.
inline double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The angle from direction a to direction b, in (-pi, pi] [rad].
inline double angle_between(const Vec2& a, const Vec2& b) {
  return std::atan2(cross(a, b), a.dot(b));
}

/// A rigid motion of the plane: `T_a_b * p_b` is the point in frame a.
struct Pose2 {
  Vec2 t = Vec2::Zero();    ///< translation [m]
  Vec2 r = Vec2(1.0, 0.0);  ///< cosine and sine of the heading

  /// The pose at `t` [m] with a heading [rad].
  static Pose2 at(const Vec2& t, double heading) { return {t, Vec2(std::cos(heading), std::sin(heading))}; }

  double heading() const { return std::atan2(r.y(), r.x()); }
  Vec2 rotate(const Vec2& v) const { return {r.x() * v.x() - r.y() * v.y(), r.y() * v.x() + r.x() * v.y()}; }
  Vec2 unrotate(const Vec2& v) const {
    return {r.x() * v.x() + r.y() * v.y(), -r.y() * v.x() + r.x() * v.y()};
  }
  Vec2 operator*(const Vec2& p) const { return rotate(p) + t; }
  Pose2 operator*(const Pose2& other) const { return {*this * other.t, rotate(other.r).normalized()}; }
  Pose2 inverse() const { return {-unrotate(t), Vec2(r.x(), -r.y())}; }
  /// Moved by `step` [m] and turned about its own origin by `turn` [rad].
  Pose2 moved(const Vec2& step, double turn) const {
    return {t + step, Pose2::at(Vec2::Zero(), turn).rotate(r).normalized()};
  }
};

/// The two ends of a wall; a index into pairs of things.
enum End : int { kEndA = 0, kEndB = 1 };

/// One part of a wall that one frame saw, in the robot's frame (x forward, y left, z up) [m]. The robot sees `a` on the left.
struct Piece {
  Vec2 a = Vec2::Zero();
  Vec2 b = Vec2::Zero();
  double z_low = 0.0;
  double z_high = 0.0;
};

/// What bounds a frame.
struct View {
  double horizontal_fov_rad = 1.5707963267948966;  ///< full angle, symmetric about the x axis
  double max_range_m = 12.0;                       ///< farthest depth (x); 0: no bound
  bool range_bounds_sides = false;                 ///< the bound is one of the range, not of the depth
};

/// Names one wall for the life of a mapper.
using WallId = std::uint64_t;
/// "This piece belongs to no wall."
inline constexpr WallId kNoWall = ~std::uint64_t{0};

/// How far a wall is trusted.
enum class WallStatus {
  temporary,  ///< seen too seldom
  mapped,
  dynamic,  ///< it moves: it is where it was seen last, and tells nothing of any pose
};

/// One wall of the map: a facing segment.
struct Wall {
  WallId id = kNoWall;
  Vec2 a = Vec2::Zero();             ///< map frame [m]; on the left for who sees the wall
  Vec2 b = Vec2::Zero();             ///< likewise, on the right
  bool certain[2] = {false, false};  ///< that the end is a true corner; else the wall was seen up to there
  double z_low = 0.0;                ///< lowest seen, averaged [m]
  double z_high = 0.0;               ///< highest seen, averaged [m]
  std::uint32_t observations = 0;    ///< pieces it was made from
  WallStatus status = WallStatus::temporary;  ///< mapped from Options::min_observations on
};

/// One submap: what was seen from about one place.
struct Submap {
  std::uint64_t id = 0;
  Pose2 T_map_submap;           ///< the pose of its first frame, as the map now has it
  bool lines_only = false;      ///< of frames that left a direction undetermined
  std::vector<WallId> members;  ///< in the order in which they joined
};

/// The whole map. Its frame is the robot's at the frame that started it.
struct Map {
  std::vector<Wall> walls;      ///< by id
  std::vector<Submap> submaps;  ///< by id
};

/// Totals since the mapper was made or reset.
struct Counters {
  std::uint64_t iterations = 0;       ///< calls of process()
  std::uint64_t lost = 0;             ///< iterations without a pose
  std::uint64_t walls = 0;            ///< in the map, temporary ones included
  std::uint64_t submaps = 0;          ///< in the map
  std::uint64_t closes = 0;           ///< times a submap was closed
  std::uint64_t reopened = 0;         ///< times an old submap was taken up again
  std::uint64_t degenerate = 0;       ///< iterations that left a direction undetermined
  std::uint64_t gaps = 0;             ///< times the place along a direction was lost
  std::uint64_t gaps_closed = 0;      ///< times it was found again
  std::uint64_t global_steps = 0;     ///< times all submaps were placed together
  std::uint64_t merged = 0;           ///< walls that turned out to be another one
  std::uint64_t dynamic = 0;          ///< walls that turned out to move
  std::uint64_t corners_revoked = 0;  ///< ends taken for corners that turned out not to be any
};

/// Why a frame has no pose.
enum class Lost { no, nothing_seen, nothing_known };

/// What one frame gave.
struct Answer {
  bool has_pose = false;
  Lost lost = Lost::nothing_seen;  ///< `no` when has_pose
  Pose2 T_map_robot;               ///< defined when has_pose
  /// Of x, y [m] and heading [rad], in the map's frame, given the walls as they are.
  Mat3 covariance = Mat3::Zero();
  /// Unit vector of the map's frame along which the frame does not tell where the robot is, or zero.
  Vec2 undetermined = Vec2::Zero();
  /// Unit vector of the map's frame along which the ground about the robot is not tied to that seen earlier, or zero.
  Vec2 untied = Vec2::Zero();
  std::uint32_t part = 0;            ///< of the map, that the pose is in; see Mapper::joined_parts()
  std::vector<WallId> associations;  ///< one per piece given, in their order; kNoWall for none
  Counters counters;
};

}  // namespace hallway::slam_plane
