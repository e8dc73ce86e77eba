// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "icp/core/types.hpp"

namespace hallway::icp {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// The matrix that makes v x w of w.
Mat3 cross_matrix(const Vec3& v);

/// The motion of a screw: velocity, then angular velocity, both in the moving frame and constant, for a unit of time: exp of se(3).
Pose screw_motion(const Vec6& screw);

/// The screw that makes a motion of less than half a turn: log of SE(3).
Vec6 screw_of(const Pose& motion);

/// What the error of T_a_b becomes as the error of T_a_c where T_b_c is exact. Errors here are of the position, then a rotation vector, both in
/// frame a: true rotation = exp(error) * rotation. @param arm  from b to c in frame a
Mat6 carried_covariance(const Mat6& covariance, const Vec3& arm);

/// Poses of a sensor in a frame of its own at rising times. Between two of them it moves as a screw; before the first and after the last
/// as between the nearest two.
class MotionTrack {
 public:
  /// Adds a pose. One that is not later than the last is passed over.
  void add(std::int64_t t_ns, const Pose& T_track_sensor);
  /// Forgets poses that nothing at or after `t_ns` needs.
  void forget_before(std::int64_t t_ns);
  void clear() { times_.clear(), poses_.clear(), screws_.clear(); }

  std::size_t size() const { return times_.size(); }
  std::int64_t first_ns() const { return times_.front(); }
  std::int64_t last_ns() const { return times_.back(); }
  /// T_track_sensor at a time; of a track with one pose that pose. Not of an empty one. O(log n).
  Pose at(std::int64_t t_ns) const;

 private:
  std::vector<std::int64_t> times_;
  std::vector<Pose> poses_;
  std::vector<Vec6> screws_;  // from each pose to the next
};

/// The points of a scan as the sensor would have met them all at `end_ns` had it stood still: each is moved from where the sensor was when it was
/// measured. @param times_ns  of each point
Points deskewed(const Points& points, std::span<const std::int64_t> times_ns, std::int64_t end_ns,
                const MotionTrack& track);

}  // namespace hallway::icp
