// SPDX-License-Identifier: MIT
#pragma once

#include "slam_point/core/places/relocaliser.hpp"

namespace hallway::slam_point {

/// Where a frame is in the map.
struct Placement {
  bool has_pose = false;       ///< see Mapper::process for the rule
  Pose T_map_sensor;           ///< where it fits best
  Pose T_submap_sensor;        ///< the same in the active submap
  bool is_sure = false;        ///< so much agrees where the prediction led that no better pose is searched
  bool is_searched = false;    ///< the pose is one that a search found
  bool is_observable = false;  ///< the associations determine a pose, whether they agree with it or not
  int agreeing = 0;            ///< points that are on their landmark up to noise
  bool is_recognised = false;  ///< its constellations were found in the map
  /// Where that is, if tracking cannot go on to there; else its part is kNone.
  Relocalisation elsewhere;

  // Without a pose:
  int associated = 0;  ///< points that had a landmark
  /// Degrees of freedom that they determine nevertheless, being few or on a line and near where they were expected.
  int determined = 0;
  /// The frame shows that the prediction is wrong. One that shows what was expected and leaves the pose open, as points of much noise do, is
  /// evidence for the prediction.
  bool contradicts_prediction = false;
};

}  // namespace hallway::slam_point
