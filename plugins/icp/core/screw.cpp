// SPDX-License-Identifier: MIT
#include "icp/core/screw.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::icp {
namespace {

constexpr double kSmall_rad = 1e-4;  // below it series are exact to rounding

/// Integral of the rotation along a screw.
Mat3 left_jacobian(const Vec3& turn) {
  const double angle = turn.norm();
  const Mat3 cross = cross_matrix(turn);
  const double angle2 = angle * angle;
  const double a = angle < kSmall_rad ? 0.5 - angle2 / 24.0 : (1.0 - std::cos(angle)) / angle2;
  const double b =
      angle < kSmall_rad ? 1.0 / 6.0 - angle2 / 120.0 : (angle - std::sin(angle)) / (angle2 * angle);
  return Mat3::Identity() + a * cross + b * cross * cross;
}

Mat3 inverse_left_jacobian(const Vec3& turn) {
  const double angle = turn.norm();
  const Mat3 cross = cross_matrix(turn);
  const double c = angle < kSmall_rad ? 1.0 / 12.0 + angle * angle / 720.0
                                      : (1.0 - 0.5 * angle / std::tan(0.5 * angle)) / (angle * angle);
  return Mat3::Identity() - 0.5 * cross + c * cross * cross;
}

}  // namespace

Mat3 cross_matrix(const Vec3& v) {
  Mat3 cross;
  cross << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return cross;
}

Pose screw_motion(const Vec6& screw) {
  const Vec3 turn = screw.tail<3>();
  return {rotation_by(turn), left_jacobian(turn) * screw.head<3>()};
}

Vec6 screw_of(const Pose& motion) {
  const Vec3 turn = rotation_vector(motion.q);
  Vec6 screw;
  screw << inverse_left_jacobian(turn) * motion.t, turn;
  return screw;
}

Mat6 carried_covariance(const Mat6& covariance, const Vec3& arm) {
  Mat6 carry = Mat6::Identity();
  carry.topRightCorner<3, 3>() = -cross_matrix(arm);
  return carry * covariance * carry.transpose();
}

void MotionTrack::add(std::int64_t t_ns, const Pose& T_track_sensor) {
  if (!times_.empty()) {
    if (t_ns <= times_.back()) return;
    screws_.push_back(screw_of(poses_.back().inverse() * T_track_sensor));
  }
  times_.push_back(t_ns);
  poses_.push_back(T_track_sensor);
}

void MotionTrack::forget_before(std::int64_t t_ns) {
  const auto after = std::upper_bound(times_.begin(), times_.end(), t_ns) - times_.begin();
  const auto spare = std::min<std::ptrdiff_t>(after - 1, static_cast<std::ptrdiff_t>(times_.size()) - 2);
  if (spare <= 0) return;
  times_.erase(times_.begin(), times_.begin() + spare);
  poses_.erase(poses_.begin(), poses_.begin() + spare);
  screws_.erase(screws_.begin(), screws_.begin() + spare);
}

Pose MotionTrack::at(std::int64_t t_ns) const {
  if (screws_.empty()) return poses_.front();
  const auto after =
      static_cast<std::size_t>(std::upper_bound(times_.begin(), times_.end(), t_ns) - times_.begin());
  const std::size_t i = std::clamp<std::size_t>(after, 1, screws_.size()) - 1;
  const double share = static_cast<double>(t_ns - times_[i]) / static_cast<double>(times_[i + 1] - times_[i]);
  return poses_[i] * screw_motion(share * screws_[i]);
}

Points deskewed(const Points& points, std::span<const std::int64_t> times_ns, std::int64_t end_ns,
                const MotionTrack& track) {
  const Pose T_end_track = track.at(end_ns).inverse();
  Points moved;
  moved.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    moved.push_back(T_end_track * (track.at(times_ns[i]) * points[i]));
  return moved;
}

}  // namespace hallway::icp
