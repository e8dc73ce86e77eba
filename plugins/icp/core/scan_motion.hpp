// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "icp/core/scan_options.hpp"
#include "icp/core/screw.hpp"

namespace hallway::icp {

/// One reading of odometry, moved to the scanner: where it was, and the covariance of the error of its motion since the reading before (position, then rotation
/// vector, in the scanner's frame at that reading). Where variances are infinite or NaN, that part of the motion is not measured.
struct OdometryReading {
  std::int64_t t_ns = 0;
  Pose T_odom_scanner;
  Mat6 covariance = Mat6::Zero();
};

/// Mean angular velocity over an interval, in the scanner's frame [rad/s].
struct RateReading {
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;
  Vec3 rate = Vec3::Zero();
};

/// A motion that is expected, with the covariance of its error (position, then rotation vector, in the frame that it starts from).
struct Expected {
  Pose motion;
  Mat6 covariance = Mat6::Identity();
};

/// What is known of a scanner's motion without its scans.
class ScanMotion {
 public:
  void add(const OdometryReading& reading);
  void add(const RateReading& reading);
  void clear() { *this = ScanMotion(); }

  /// What serves best from one time to another, out of what `deskew` allows; odometry and rates count where they cover most of it.
  Deskew source(Deskew deskew, std::int64_t from_ns, std::int64_t to_ns);

  /// The scanner's path about [from, to] by that source, `velocity` being the last or registered one (linear, then angular, scanner's frame).
  MotionTrack track(Deskew source, std::int64_t from_ns, std::int64_t to_ns, const Vec6& velocity) const;
  /// The motion from one time to the other on that path, and how well it is known.
  Expected expected(Deskew source, std::int64_t from_ns, std::int64_t to_ns, const Vec6& velocity) const;

  /// Whether gyroscopes turned the odometry of the last source(): wheels tell nothing of a slope.
  bool measures_all() const { return turns_by_rates_; }

  /// What the errors of that path within a scan add to the pose at its end, roughly: those of the source's last reading; scanner's frame.
  Mat6 deskew_covariance(Deskew source) const;

  /// Learns the gyroscopes' bias from a registered rotation over the interval.
  void learn_bias(std::int64_t from_ns, std::int64_t to_ns, const Quat& turned);
  /// Forgets what was before a time.
  void forget_before(std::int64_t t_ns);

 private:
  struct Step {
    std::int64_t t_ns;
    Mat6 covariance;
  };
  template <typename Way>
  MotionTrack turned_by_rates(std::int64_t from_ns, std::int64_t to_ns, const Way& way) const;
  MotionTrack odometry_with_rates(std::int64_t from_ns, std::int64_t to_ns) const;

  MotionTrack odometry_;
  std::vector<Step> steps_;
  MotionTrack rates_;  // rotation alone
  Vec3 bias_ = Vec3::Zero();
  std::optional<OdometryReading> last_;
  bool measures_turns_ = true;
  bool turns_by_rates_ = false;  // with odometry: for the interval of the last source()
  double learned_ = 0.0;         // rotations that bias_ was learnt from
};

}  // namespace hallway::icp
