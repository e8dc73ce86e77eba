// SPDX-License-Identifier: MIT
#pragma once

#include "slam_point/core/types.hpp"

namespace hallway::slam_point {

/// Where the sensor is expected, from how it moved last: a motion from frame to frame, never a place in the map.
class MotionPrediction {
 public:
  /// `smoothing`: share of a new motion in the average; `match_bound_m`: see Options.
  MotionPrediction(double smoothing, double match_bound_m)
      : smoothing_(smoothing), match_bound_(match_bound_m) {}

  /// The pose `frames` frames after `from`, in the same frame.
  Pose after(const Pose& from, int frames) const;

  /// Takes in that the sensor moved by `moved` in `frames` frames, frame of the earlier pose. `sudden`: the prediction
  /// had failed: then the average before says nothing, and what is no motion of a robot was a carriage and says nothing either.
  void learn(const Pose& moved, int frames, bool sudden);

 private:
  double smoothing_;
  double match_bound_;
  Vec3 turn_ = Vec3::Zero();    // of one frame, in the frame of the earlier pose: rotation vector
  Vec3 travel_ = Vec3::Zero();  // likewise [m]
  bool has_motion_ = false;
};

}  // namespace hallway::slam_point
