// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/se3.hpp"
#include "sense/face_plan.hpp"
#include "slam_plane/spatial/mapper.hpp"

namespace hallway::slam_plane::spatial::test {

/// Faces and the robot's true poses, one for each iteration.
struct Scene {
  std::string name;
  sense::FacePlan plan;
  std::vector<hallway::Pose> path;
};

/// A room with boxes and a tilted slab, in which the robot flies in a circle, nods and rolls.
Scene furnished_room(int frames);
/// Two rooms of different heights, a door, and the way there and back.
Scene two_rooms();

/// A room with nothing in it, in which the robot does the same: turned by half a turn it looks as it did.
Scene empty_room(int frames);
/// The furnished room with a panel that hangs free; its index among the faces.
Scene room_with_panel(int frames, std::uint32_t& panel);

/// A room whose floor is level for half a metre and then a ramp: its side walls have an obtuse corner next to a short edge.
Scene ramp_room(int frames);

/// Noise of the simulated sensor.
struct NoiseOf {
  double plane_m = 0.0;
  double angle_rad = 0.0;
  double end_m = 0.0;
};
inline constexpr NoiseOf kNoise{0.02, 0.3 * 0.017453292519943295, 0.005};

/// One frame, with what a mapper is not told.
struct TrueFrame {
  hallway::Pose T_world_robot;
  std::vector<PlaneObservation> observations;
  std::vector<std::uint32_t> truth;  ///< of each face its number
};

inline constexpr View kView{1.5707963267948966, 1.3962634015954636, 0.0, 12.0, false};

/// What a sensor sees of a scene, frame by frame.
std::vector<TrueFrame> see(const Scene& scene, const NoiseOf& noise, std::uint64_t seed);

/// The same with a face that moves: from a frame on, for some frames, by the same step in each.
struct MovingFace {
  std::uint32_t face;
  std::size_t begin;
  std::size_t frames;
  Vec3 step_m;
};
std::vector<TrueFrame> see(const Scene& scene, const NoiseOf& noise, std::uint64_t seed,
                           const MovingFace& moving);

/// A run of the mapper, compared with the truth. Everything is aligned by the first pose's truth.
struct Outcome {
  double worst_position_m = 0.0, position_rmse_m = 0.0;
  double worst_turn_rad = 0.0;
  int lost = 0;
  int missing = 0;     ///< faces seen 20 times that are not mapped
  int duplicated = 0;  ///< mapped faces of a face that has another one
  int wrong = 0;       ///< associations with a mapped face that is mostly of another one
  double worst_plane_m = 0.0,
         plane_rmse_m = 0.0;  ///< of true corners that were seen, across the mapped planes
  int certain_edges = 0;
  int false_edges = 0;                           ///< certain edges farther than 10 cm from every true one
  double worst_edge_m = 0.0, edge_rmse_m = 0.0;  ///< of the others
  Counters counters;
};

/// @param T_world_map  where the map lies; identity: found by the poses
Outcome compare(const Scene& scene, const std::vector<TrueFrame>& frames, const Map& map,
                const std::vector<Answer>& answers);

Outcome run(const Scene& scene, const std::vector<TrueFrame>& frames, const Options& options);

/// The rigid motion that lays points on others best.
hallway::Pose pose_of(const Pose& T);

}  // namespace hallway::slam_plane::spatial::test
