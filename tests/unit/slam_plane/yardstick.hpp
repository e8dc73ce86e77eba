// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "slam_plane/core/types.hpp"
#include "unit/slam_plane/scenes.hpp"

namespace hallway::slam_plane::test {

/// A wall as who scores one knows it.
struct ScoredWall {
  bool known = false;
  Vec2 point = Vec2::Zero();  ///< on its line
  Vec2 direction = Vec2(1.0, 0.0);
  bool corner[2] = {false, false};
  double end[2] = {0.0, 0.0};  ///< places of the corners, from `point`
};

/// Poses and walls, in any one frame.
struct Solution {
  std::vector<Pose2> poses;      ///< by frame
  std::vector<bool> determined;  ///< by frame: its walls tell its pose; else a direction is held where it was
  std::vector<ScoredWall> walls;  ///< by true wall
};

/// Batch least squares over all frames with the true association and the true corners: the best that the data allow. Gauss-Newton from
/// the truth; poses are eliminated. Corners seen fewer than five times are left out.
Solution solve_batch(const Scene& scene, const std::vector<TrueFrame>& frames, const Sensor& sensor);

/// Fits each frame's pose to walls that are given, with the true association and true corners.
void fit_poses(const std::vector<TrueFrame>& frames, const Sensor& sensor, Solution& solution);

/// Squared errors after the rigid motion that fits the corners best to the truth; of positions, those of determined frames.
struct Score {
  double corner2 = 0.0;  ///< sum of squares [m^2]
  int corners = 0;
  double worst_corner = 0.0;
  double position2 = 0.0;  ///< sum of squares [m^2]
  int frames = 0;

  void add(const Score& other);
  double corner_rmse() const;
  double position_rmse() const;
};

/// The rigid motion from the solution's frame to the scene's that fits its corners best to the truth.
Pose2 alignment(const Scene& scene, const Solution& solution);

Score score(const Scene& scene, const Solution& solution);

}  // namespace hallway::slam_plane::test
