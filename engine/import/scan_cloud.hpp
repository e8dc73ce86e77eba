// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/sample.h>

#include <cstdint>
#include <vector>

#include "import/lidar_cloud.hpp"
#include "import/true_track.hpp"

namespace hallway::import {

/// A reading of rays or of points as a cloud in the sensor's frame, in its order, with intensities, rings and times where it has them. Of rays the points
/// that they met, in all layers: a ray without a return has none.
/// @param sample  of rays or points
LidarCloud cloud_of(const hw_sample_t& sample);

/// How a body truly moves: poses at some times, between which it moves evenly (position linear in time, orientation on the shorter arc).
class TrueMotion {
 public:
  /// @param poses  in any order; of equal times the first one counts
  explicit TrueMotion(std::vector<TimedPose> poses);

  const std::vector<TimedPose>& poses() const { return poses_; }
  /// Whether the poses begin at `begin_ns` or before and end at `end_ns` or after.
  bool covers(std::int64_t begin_ns, std::int64_t end_ns) const;
  /// Whether one of the poses is of that time.
  bool has(std::int64_t t_ns) const;
  /// The pose at a time that is covered. O(log n).
  Pose at(std::int64_t t_ns) const;
  /// The longest time between two poses that follow each other, of those that at() needs for an interval that is covered.
  std::int64_t longest_gap_ns(std::int64_t begin_ns, std::int64_t end_ns) const;

 private:
  std::size_t index_after(std::int64_t t_ns) const;

  std::vector<TimedPose> poses_;
};

/// Brings the points of a cloud into the sensor's frame at one time, by the true motion; each was measured in the frame at its own time.
/// @param cloud       has times
/// @param begin_ns    the time that those of the points count from
/// @param T_body_sensor  mount
/// @param T_world_body   at the time of the frame that the points are to have
/// @param motion      covers the times of all points
void deskew(LidarCloud& cloud, std::int64_t begin_ns, const Pose& T_body_sensor, const Pose& T_world_body,
            const TrueMotion& motion);

}  // namespace hallway::import
