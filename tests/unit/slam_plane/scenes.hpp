// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "slam_plane/core/types.hpp"

namespace hallway::slam_plane::test {

/// A facing segment of the world: who stands before it sees `a` on the left.
struct TrueWall {
  Vec2 a, b;
};

/// A wall that moves, by the same step and turn (about its end a) each frame of a time.
struct Motion {
  std::size_t wall = 0;
  std::size_t first = 0;  ///< frame
  std::size_t frames = 0;
  Vec2 step = Vec2::Zero();
  double turn_rad = 0.0;
};

/// Walls and the robot's poses, one for each iteration.
struct Scene {
  std::string name;
  std::vector<TrueWall> walls;
  std::vector<Pose2> path;
  std::vector<Motion> motions = {};

  /// The walls as they are in a frame.
  std::vector<TrueWall> walls_at(std::size_t frame) const;
};

/// Four walls about the robot, which circles; all are always seen, as parts, in a full circle of view.
Scene four_walls(int frames);
/// A corridor about a block, with doors, niches and pillars: 112 walls, `laps` times round.
Scene corridor_loop(int laps);
/// A corridor that ends in one wall that fills the view; a turn; and back.
Scene corridor_return();
/// A loop with one side that has no features, in which the robot changes its speed.
Scene featureless_loop(int laps);

/// The path of a robot that drives to each corner, stops, turns, and goes on. `step_m` and `turn_rad` a frame; it stands for `pause` frames at each.
std::vector<Pose2> drive(const std::vector<Vec2>& corners, double step_m, double turn_rad, int pause);

/// What the simulated sensor does.
struct Sensor {
  View view;
  bool occlusion = false;
  double noise_m = 0.02;
  double noise_angle_rad = 0.3 * 0.017453292519943295;
  double noise_end_m = 0.005;
  double noise_along_m = 0.0;
  double least_length_m = 0.05;  ///< shorter observations are not told
  double missed = 0.0;           ///< share of observations that are not told
  double spurious = 0.0;         ///< observations a frame that are of no wall
};

/// One frame, with what a mapper is not told.
struct TrueFrame {
  Pose2 T_world_robot;
  std::vector<WallObservation> observations;
  std::vector<int> wall;        ///< of each observation, -1 for a spurious one
  std::vector<bool> corner[2];  ///< that the end is the wall's
};

/// All frames of a scene. Exact interval visibility: a wall is seen where it faces the robot, lies in the view, and, with occlusion, nothing is
/// before it.
std::vector<TrueFrame> observe(const Scene& scene, const Sensor& sensor, std::uint64_t seed);

}  // namespace hallway::slam_plane::test
