// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "slam_plane/core/dead_reckoning.hpp"
#include "slam_plane/core/frame.hpp"
#include "slam_plane/core/frame_matcher.hpp"
#include "slam_plane/core/wall_map.hpp"

namespace hallway::slam_plane {

/// Finds the walls and the pose of a frame: where the motion so far puts it, the walls that its observations are there, and the pose that these
/// tell, first in the map and then in the active submap alone.
class FrameLocator {
 public:
  explicit FrameLocator(const Options& options)
      : matcher_(options), fit_(options), smoothing_(options.smoothing) {}

  /// Sets the pose that constant velocity predicts, and the walls and the pose found from there. `since`: no walls of epochs before that
  /// one are looked for by place. Along a direction that the walls leave open the frame is where dead reckoning has it. O(observations * walls seen just before), flat in the size of the map.
  void locate(const WallMap& map, std::uint32_t since, Frame& frame);
  /// How many observations locate() found a wall for.
  std::size_t known() const { return known_; }

  /// Sets Observation::outlier of observations that do not lie on their walls at the pose that locate() found, and finds it anew without them.
  void find_outliers(const WallMap& map, Frame& frame);

  /// Sets Frame::T_submap_robot and in_submap from the active submap alone.
  void locate_in_submap(const WallMap& map, Frame& frame);

  static constexpr std::uint32_t kAllEpochs = ~std::uint32_t{0};
  /// Fits a pose to the map as it was known before an epoch.
  PoseInformation fit_map(const WallMap& map, const Frame& frame, std::uint32_t before_epoch,
                          Pose2& T_map_robot);

  /// What a frame's own lines and corners tell of its pose, were all of its walls known.
  PoseInformation own_information(const Frame& frame) const {
    return fit_.own_information(frame.observations);
  }

  /// Takes note of the motion from `before` (T_submap_robot of the last frame) to the frame. `untied`: a direction in the map in which
  /// nothing was measured, or zero.
  void note_motion(const Pose2& before, const Frame& frame, const Vec2& untied);
  /// Takes note of the walls that are seen.
  void note_seen(const WallMap& map, const Frame& frame);
  /// A wall has become another one.
  void replace(Index gone, Index kept);

  /// Of one frame.
  const Pose2& motion() const { return motion_; }
  /// The longest motion so far [m a frame].
  double fastest() const { return fastest_; }

 private:
  bool trust_most(const WallMap& map, Frame& frame) const;
  void reckon(const Pose2& T_map_submap, Frame& frame);
  void locate_from(const Pose2& T_map_robot, const WallMap& map, std::uint32_t since, Frame& frame);

  FrameMatcher matcher_;
  FrameFit fit_;
  DeadReckoning reckoning_;
  double smoothing_;
  std::vector<Index> recent_;  // walls seen just before
  Pose2 motion_;
  double fastest_ = 0.0;
  std::size_t known_ = 0;
};

}  // namespace hallway::slam_plane
