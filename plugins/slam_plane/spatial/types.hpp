// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "slam_plane/core/types.hpp"

namespace hallway::slam_plane::spatial {

using Vec4 = Eigen::Vector4d;
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat4 = Eigen::Matrix4d;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using Quat = Eigen::Quaterniond;

using Index = std::size_t;
/// "None", of an index.
inline constexpr Index kNone = std::numeric_limits<Index>::max();

/// The rotation by a rotation vector [rad].
inline Quat rotation_by(const Vec3& vector) {
  const double angle = vector.norm();
  if (angle < 1e-12) return Quat(1.0, 0.5 * vector.x(), 0.5 * vector.y(), 0.5 * vector.z()).normalized();
  return Quat(Eigen::AngleAxisd(angle, vector / angle));
}

/// The rotation vector of a rotation, of at most half a turn [rad].
inline Vec3 rotation_vector(const Quat& q) {
  const Eigen::AngleAxisd turn(q.w() < 0.0 ? Quat(-q.w(), -q.x(), -q.y(), -q.z()) : q);
  return turn.angle() * turn.axis();
}

/// A rigid motion of space: `T_a_b * p_b` is the point in frame a.
struct Pose3 {
  Quat q = Quat::Identity();
  Vec3 t = Vec3::Zero();  ///< [m]

  Vec3 operator*(const Vec3& p) const { return q * p + t; }
  Pose3 operator*(const Pose3& other) const { return {(q * other.q).normalized(), q * other.t + t}; }
  Pose3 inverse() const { return {q.conjugate(), q.conjugate() * -t}; }
  /// Moved by `step` (translation [m], then a rotation vector [rad]); both in frame a, the turn about the own origin.
  Pose3 moved(const Vec6& step) const {
    return {(rotation_by(step.tail<3>()) * q).normalized(), t + step.head<3>()};
  }
};

/// What one frame saw of a face of the world: a convex polygon in the robot's frame (x forward, y left, z up) [m].
struct Face {
  Vec3 normal = Vec3::Zero();  ///< unit, towards the robot
  Vec3 centre = Vec3::Zero();  ///< where the plane is known best
  std::vector<Vec3> outline;   ///< at least three; counter-clockwise as seen by the robot
};

/// What bounds a frame: a pyramid about the x axis.
struct View {
  double horizontal_fov_rad = 1.5707963267948966;  ///< full angle; from pi on it bounds nothing
  double vertical_fov_rad = 1.0471975511965976;    ///< likewise
  double min_range_m = 0.0;                        ///< nearest depth (x)
  double max_range_m = 12.0;                       ///< farthest depth; 0: no bound
  bool range_bounds_sides = false;                 ///< the ranges are distances, not depths
};

/// A face of the map.
struct MappedFace {
  WallId id = kNoWall;
  Vec3 normal = Vec3::Zero();  ///< map frame, unit, towards where it was seen from
  double offset = 0.0;         ///< normal . x = offset [m]
  std::vector<Vec3> outline;   ///< what was seen of it: convex, counter-clockwise as seen from there [m]
  std::vector<bool> certain;   ///< of each edge, from its corner to the next: that the face truly ends there
  std::uint32_t observations = 0;
  WallStatus status = WallStatus::temporary;
};

/// A part of the map that is rigid in itself.
struct MappedSubmap {
  std::uint64_t id = 0;
  Pose3 T_map_submap;           ///< the pose of its first frame, as the map now has it
  std::vector<WallId> members;  ///< in the order in which they joined
};

/// The whole map. Its frame is the robot's at the frame that began it.
struct Map {
  std::vector<MappedFace> faces;      ///< by id
  std::vector<MappedSubmap> submaps;  ///< by id
};

/// Why there is no pose.
enum class Lost {
  no,
  nothing_known,  ///< too little of the map is in view
  undetermined,   ///< what is in view of it leaves directions of the pose open
};

/// Totals since the mapper was made or reset.
struct Counters {
  std::uint64_t lost = 0;
  std::uint64_t faces = 0;
  std::uint64_t submaps = 0;
  std::uint64_t closes = 0;
  std::uint64_t reopened = 0;
  std::uint64_t degenerate = 0;  ///< frames that left directions open
  std::uint64_t global_steps = 0;
  std::uint64_t merged = 0;
  std::uint64_t edges = 0;          ///< that are certain, now
  std::uint64_t edges_revoked = 0;  ///< that were disproved
  std::uint64_t dynamic = 0;        ///< faces that turned out to move
  std::uint64_t found_again = 0;    ///< times that the pose was found by a search of the map
};

/// What a frame tells.
struct Answer {
  bool has_pose = false;
  Lost lost = Lost::no;
  Pose3 T_map_robot;
  Mat6 covariance = Mat6::Zero();  ///< of position [m] and rotation vector [rad], both in the map's frame
  int open = 0;                    ///< how many of the six directions of the pose the frame leaves open
  /// If it is exactly one along which the robot may have moved: its unit vector in the map's frame, else zero.
  Vec3 undetermined = Vec3::Zero();
  std::vector<WallId> associations;  ///< one per face given, in their order; kNoWall for none
  Counters counters;
};

}  // namespace hallway::slam_plane::spatial
