// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <vector>

namespace hallway::peers {

using Point2 = std::array<double, 2>;

/// A facing segment: who stands before it sees `a` on the left.
struct Facing {
  Point2 a{}, b{};
};

/// A pose in the plane: position [m] and heading [rad].
using Pose3 = std::array<double, 3>;

/// What one frame saw of one wall, sensor frame.
struct SeenWall {
  std::size_t wall = 0;  ///< index into PlaneRun::walls
  Facing piece;
  bool corner[2] = {false, false};  ///< that the end is the wall's own and no cut
};

/// A recorded run of a sensor of planes, with what is true of it.
struct PlaneRun {
  std::vector<Facing> walls;                  ///< world
  std::vector<Pose3> poses;                   ///< T_world_sensor by iteration
  std::vector<std::vector<SeenWall>> frames;  ///< by iteration
  double noise_m = 0.0, noise_angle_rad = 0.0, noise_end_m = 0.0;
};

/// A point of frame `pose` in the frame that the pose is in.
inline Point2 placed(const Pose3& pose, const Point2& p) {
  const double c = std::cos(pose[2]), s = std::sin(pose[2]);
  return {c * p[0] - s * p[1] + pose[0], s * p[0] + c * p[1] + pose[1]};
}

/// Reads a run folder: run.json, observed_planes.csv, true_walls.csv, truth_poses.csv. An end is a corner if the wall's own end lies in the view
/// and, where the sensor has occlusion, nothing hides it. Throws Error{kBadInput, kIo}.
PlaneRun read_plane_run(const std::filesystem::path& folder);

}  // namespace hallway::peers
