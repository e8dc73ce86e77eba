// SPDX-License-Identifier: MIT
#include "icp/core/scan_motion.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::icp {
namespace {

constexpr double kNs = 1e-9;
constexpr double kSlack = 0.3;         // share of an interval that a source need not cover
constexpr double kVelocity_m_s = 1.0;  // by how much a velocity may change from scan to scan
constexpr double kRate_rad_s = 2.0;
constexpr double kGyro_rad_s = 0.02;   // what a bias that is not known may be
constexpr double kOdometry = 4.0;      // variances of odometry count so many times: slip has a mean
constexpr double kOdometry_m = 0.003;  // least standard deviations of what odometry says
constexpr double kOdometry_rad = 0.005;
constexpr double kUneven = 0.1;  // of a motion between two readings: how far it may be from even
constexpr double kBiasGain = 0.03;
constexpr double kLearned = 5.0;  // rotations that a bias is known by

double seconds(std::int64_t from_ns, std::int64_t to_ns) {
  return kNs * static_cast<double>(to_ns - from_ns);
}

bool covers(const MotionTrack& track, std::int64_t from_ns, std::int64_t to_ns) {
  if (track.size() < 2) return false;
  const double slack = kSlack * static_cast<double>(to_ns - from_ns);
  return static_cast<double>(track.first_ns() - from_ns) <= slack &&
         static_cast<double>(to_ns - track.last_ns()) <= slack;
}

}  // namespace

void ScanMotion::add(const OdometryReading& reading) {
  OdometryReading known = reading;
  Mat6& covariance = known.covariance;
  for (int i = 0; i < 6; ++i) {
    if (std::isfinite(covariance(i, i))) continue;
    if (i >= 3 && std::isinf(covariance(i, i))) measures_turns_ = false;
    covariance.row(i).setZero();
    covariance.col(i).setZero();
    const double dt = last_ ? seconds(last_->t_ns, reading.t_ns) : 0.0;
    const double sigma = dt * (i < 3 ? kVelocity_m_s : kRate_rad_s);
    covariance(i, i) = sigma * sigma;
  }
  for (double& value : covariance.reshaped()) {
    if (!std::isfinite(value)) value = 0.0;
  }
  if (last_ && reading.t_ns <= last_->t_ns) return;
  if (last_) steps_.push_back({reading.t_ns, covariance});
  odometry_.add(reading.t_ns, reading.T_odom_scanner);
  last_ = known;
}

void ScanMotion::add(const RateReading& reading) {
  if (reading.end_ns <= reading.begin_ns || !reading.rate.allFinite()) return;
  if (rates_.size() == 0) rates_.add(reading.begin_ns, Pose());
  const std::int64_t last_ns = rates_.last_ns();
  if (reading.end_ns <= last_ns) return;
  const Pose last = rates_.at(last_ns);
  rates_.add(
      reading.end_ns,
      {(last.q * rotation_by(seconds(last_ns, reading.end_ns) * reading.rate)).normalized(), Vec3::Zero()});
}

Deskew ScanMotion::source(Deskew deskew, std::int64_t from_ns, std::int64_t to_ns) {
  const bool any = deskew == Deskew::automatic || deskew == Deskew::none;
  turns_by_rates_ = any && learned_ >= kLearned && covers(rates_, from_ns, to_ns);
  if ((any || deskew == Deskew::odometry) && (measures_turns_ || turns_by_rates_) &&
      covers(odometry_, from_ns, to_ns))
    return Deskew::odometry;
  if ((any || deskew == Deskew::imu) && covers(rates_, from_ns, to_ns)) return Deskew::imu;
  return Deskew::motion;
}

/// The turns of the gyroscopes, in steps, with the ways that `way` tells from one time to another, in the scanner's frame at the first.
template <typename Way>
MotionTrack ScanMotion::turned_by_rates(std::int64_t from_ns, std::int64_t to_ns, const Way& way) const {
  constexpr int kSteps = 20;
  MotionTrack track;
  track.add(from_ns, Pose());
  Pose pose;
  for (int i = 0; i < kSteps; ++i) {
    const auto begin_ns = from_ns + (to_ns - from_ns) * i / kSteps;
    const auto end_ns = from_ns + (to_ns - from_ns) * (i + 1) / kSteps;
    Vec6 screw;
    screw << way(begin_ns, end_ns), rotation_vector(rates_.at(begin_ns).q.conjugate() * rates_.at(end_ns).q) -
                                        seconds(begin_ns, end_ns) * bias_;
    pose = pose * screw_motion(screw);
    track.add(end_ns, pose);
  }
  return track;
}

MotionTrack ScanMotion::track(Deskew source, std::int64_t from_ns, std::int64_t to_ns,
                              const Vec6& velocity) const {
  if (source == Deskew::odometry) return turns_by_rates_ ? odometry_with_rates(from_ns, to_ns) : odometry_;
  if (source == Deskew::imu) {
    // The velocity is constant in the scanner's frame.
    return turned_by_rates(from_ns, to_ns, [&](std::int64_t begin_ns, std::int64_t end_ns) -> Vec3 {
      return seconds(begin_ns, end_ns) * velocity.head<3>();
    });
  }
  MotionTrack track;
  track.add(from_ns, Pose());
  track.add(to_ns, screw_motion(seconds(from_ns, to_ns) * velocity));
  return track;
}

/// The ways of odometry with the turns of the gyroscopes, which have no ticks.
MotionTrack ScanMotion::odometry_with_rates(std::int64_t from_ns, std::int64_t to_ns) const {
  return turned_by_rates(from_ns, to_ns, [&](std::int64_t begin_ns, std::int64_t end_ns) -> Vec3 {
    return screw_of(odometry_.at(begin_ns).inverse() * odometry_.at(end_ns)).head<3>();
  });
}

Expected ScanMotion::expected(Deskew source, std::int64_t from_ns, std::int64_t to_ns,
                              const Vec6& velocity) const {
  const MotionTrack path = track(source, from_ns, to_ns, velocity);
  const Pose T_from_track = path.at(from_ns).inverse();
  Expected result;
  result.motion = T_from_track * path.at(to_ns);
  const double dt = seconds(from_ns, to_ns);
  const double sigma_m = kVelocity_m_s * dt + 0.005;
  const double sigma_rad = kRate_rad_s * dt + 0.005;
  Vec6 variances;
  variances.head<3>().setConstant(sigma_m * sigma_m);
  variances.tail<3>().setConstant(sigma_rad * sigma_rad);
  if (source == Deskew::imu) {
    const double gyro_rad = kGyro_rad_s * dt + 0.001;
    variances.tail<3>().setConstant(gyro_rad * gyro_rad);
  }
  result.covariance = variances.asDiagonal();
  if (source != Deskew::odometry) return result;
  variances.head<3>().setConstant(kOdometry_m * kOdometry_m);
  variances.tail<3>().setConstant(kOdometry_rad * kOdometry_rad);
  result.covariance = variances.asDiagonal();
  std::int64_t before_ns = odometry_.first_ns();
  for (const Step& step : steps_) {
    if (step.t_ns > from_ns && before_ns < to_ns) {
      const Pose at = T_from_track * odometry_.at(before_ns);
      Mat6 turn = Mat6::Zero();
      turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = at.q.toRotationMatrix();
      result.covariance +=
          kOdometry * carried_covariance(turn * step.covariance * turn.transpose(), result.motion.t - at.t);
    }
    before_ns = step.t_ns;
  }
  return result;
}

Mat6 ScanMotion::deskew_covariance(Deskew source) const {
  Vec6 variances = Vec6::Constant(1e-8);
  if (source == Deskew::odometry && !steps_.empty()) {
    variances += steps_.back().covariance.diagonal().cwiseMin(1e-3);
    // Between its readings the robot need not have moved evenly.
    const std::int64_t last_ns = steps_.back().t_ns;
    const std::int64_t before_ns = steps_.size() > 1 ? steps_[steps_.size() - 2].t_ns : odometry_.first_ns();
    const Vec6 way = kUneven * screw_of(odometry_.at(before_ns).inverse() * odometry_.at(last_ns));
    variances += way.cwiseAbs2();
    if (turns_by_rates_) variances.tail<3>().setConstant(1e-8);
  }
  return variances.asDiagonal();
}

void ScanMotion::learn_bias(std::int64_t from_ns, std::int64_t to_ns, const Quat& turned) {
  if (!covers(rates_, from_ns, to_ns)) return;
  const Quat told = rates_.at(from_ns).q.conjugate() * rates_.at(to_ns).q;
  const Vec3 excess = rotation_vector(turned.conjugate() * told) / seconds(from_ns, to_ns);
  bias_ += std::max(kBiasGain, 1.0 / ++learned_) * (excess - bias_);
}

void ScanMotion::forget_before(std::int64_t t_ns) {
  odometry_.forget_before(t_ns);
  rates_.forget_before(t_ns);
  const std::int64_t first_ns = odometry_.size() > 0 ? odometry_.first_ns() : t_ns;
  steps_.erase(std::remove_if(steps_.begin(), steps_.end(),
                              [first_ns](const Step& step) { return step.t_ns <= first_ns; }),
               steps_.end());
}

}  // namespace hallway::icp
