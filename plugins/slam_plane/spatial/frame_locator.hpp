// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "slam_plane/core/options.hpp"
#include "slam_plane/spatial/frame_search.hpp"
#include "slam_plane/spatial/plane_map.hpp"
#include "slam_plane/spatial/plane_matcher.hpp"
#include "slam_plane/spatial/pose_fit.hpp"

namespace hallway::slam_plane::spatial {

/// A frame on its way through an iteration.
struct Frame {
  std::uint64_t iteration = 0;
  std::vector<AssociatedObservation> observations;
  Pose T_map_robot;
  Pose T_submap_robot;    ///< in the active submap; between iterations that of
                          ///< the last frame
  PoseInformation known;  ///< of T_map_robot

  /// Planes that it saw, ascending.
  std::vector<Index> landmarks() const;
};

/// Says of which planes a frame's observations are, and where it was made from, from where constant velocity gives it to be. Where that has led nowhere for
/// some frames, the whole map is searched.
class FrameLocator {
 public:
  explicit FrameLocator(const Options& options);

  /// Sets the planes of observations, which of them outlier, the frame's pose and what is known of it. Answers why there is none, or `no`.
  Lost locate(const PlaneMap& map, Frame& frame);

  /// Whether the last frame was found by a search.
  bool found_again() const { return found_again_; }

  /// What a frame tells of its own pose in a world that is known exactly.
  PoseInformation own_information(const Frame& frame) const {
    return fit_.own_information(frame.observations);
  }

  /// Learns from a frame with a pose how the robot moves. What is predicted goes on in the frame of the active submap.
  void note_motion(const PlaneMap& map, Frame& frame);
  /// Without a pose the robot goes on as predicted in what is open.
  void drift(const PlaneMap& map, Frame& frame);
  /// The map about the robot was moved.
  void carry(const Pose& T_map_before);

 private:
  Lost follow(const PlaneMap& map, Frame& frame);
  bool search(const PlaneMap& map, Frame& frame);
  void predict(const PlaneMap& map, Frame& frame) const;
  void associate(const PlaneMap& map, Frame& frame);
  PoseInformation fit(const PlaneMap& map, const Frame& frame, Pose& T);
  bool drop_outliers(const PlaneMap& map, const Pose& T, Frame& frame) const;

  PlaneMatcher matcher_;
  FrameSearch search_;
  PoseFit fit_;
  double smoothing_;
  double worst_doubt_m_;
  std::optional<Pose> T_before_;   // of the last frame in the map, if it had a pose
  Vec6 motion_ = Vec6::Zero();     // predicted, from frame to frame, in the robot's frame
  bool moving_ = false;            // it is known
  int frames_lost_ = 0;            // in a row
  std::optional<Pose> suspected_;  // what the last search found
  bool found_again_ = false;
  double doubt_m_ = 0.0;  // of the predicted place, while there is no pose
};

}  // namespace hallway::slam_plane::spatial
