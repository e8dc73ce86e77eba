// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geometry/se3.hpp"
#include "slam_plane/core/types.hpp"

namespace hallway::slam_plane::spatial {

using Vec4 = Eigen::Vector4d;
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat4 = Eigen::Matrix4d;
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// What one frame saw of a plane of the world: a convex polygon in the robot's frame (x forward, y left, z up) [m].
struct PlaneObservation {
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

/// A plane of the map.
struct PlaneLandmark {
  LandmarkId id = kNoLandmark;
  Vec3 normal = Vec3::Zero();  ///< map frame, unit, towards where it was seen from
  double offset = 0.0;         ///< normal . x = offset [m]
  std::vector<Vec3> outline;   ///< what was seen of it: convex, counter-clockwise as seen from there [m]
  std::vector<bool> certain;   ///< of each edge, from its corner to the next: that the plane truly ends there
  std::uint32_t observations = 0;
  LandmarkStatus status = LandmarkStatus::temporary;
};

/// The whole map. Its frame is the robot's at the frame that began it.
struct Map {
  std::vector<PlaneLandmark> landmarks;  ///< by id
  std::vector<SubmapAt<Pose>> submaps;   ///< by id
};

/// Totals since the mapper was made or reset.
struct Counters : slam_plane::Counters {
  std::uint64_t edges = 0;          ///< that are certain, now
  std::uint64_t edges_revoked = 0;  ///< that were disproved
  std::uint64_t found_again = 0;    ///< times that the pose was found by a search of the map
};

/// What a frame tells.
struct Answer {
  bool has_pose = false;
  Lost lost = Lost::no;
  Pose T_map_robot;
  Mat6 covariance = Mat6::Zero();  ///< of position [m] and rotation vector [rad], both in the map's frame
  int open = 0;                    ///< how many of the six directions of the pose the frame leaves open
  /// If it is exactly one along which the robot may have moved: its unit vector in the map's frame, else zero.
  Vec3 unobservable = Vec3::Zero();
  std::vector<LandmarkId> associations;  ///< one per plane given, in their order; kNoLandmark for none
  Counters counters;
};

}  // namespace hallway::slam_plane::spatial
