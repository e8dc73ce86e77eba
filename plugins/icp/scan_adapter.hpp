// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/plugin.hpp>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "adapter/body_frame.hpp"
#include "icp/core/lidar_odometry.hpp"

namespace hallway::icp {

/// Between the ABI and LidarOdometry: the first sensor of scans, the first of odometry and the first of angular velocity of a robot.
class ScanAdapter {
 public:
  /// Takes the sensors. @return whether there is one of scans
  bool activate(const hw_activation_t& activation) {
    scanner_ = odometry_ = imu_ = Sensor();
    for (std::uint32_t i = 0; i < activation.n_sensors; ++i) {
      const hw_sensor_info_t& info = *activation.sensors[i];
      Sensor* sensor = info.kind == HW_SAMPLE_RANGE_SCAN ? &scanner_
                       : info.kind == HW_SAMPLE_ODOMETRY ? &odometry_
                       : info.kind == HW_SAMPLE_IMU      ? &imu_
                                                         : nullptr;
      if (sensor == nullptr || sensor->id) continue;
      *sensor = {info.id, to_pose(info.T_body_sensor)};
      if (sensor != &scanner_) continue;
      noise_m_ = sdk::largest_noise_m(info);
      noise_per_m_ = hw_noise_per_m_of(&info, 0);
    }
    body_ = BodyFrame(scanner_.T_body_sensor);
    reset();
    return scanner_.id.has_value();
  }

  void reset() { lost_ = false; }

  /// What the scanner's description tells of its noise; NaN where it does not.
  double noise_m() const { return noise_m_; }
  double noise_per_m() const { return noise_per_m_; }
  const BodyFrame& body() const { return body_; }

  /// Gives a frame's readings to the algorithm: those of motion, then the scans, in the order of their ends. @return its answer to the last scan; null where there is none
  const ScanAnswer* process(const hw_frame_t& frame, LidarOdometry& algorithm) {
    std::vector<const hw_sample_t*> scans;
    for (std::uint32_t k = 0; k < frame.n_samples; ++k) {
      const hw_sample_t& sample = *frame.samples[k];
      if (const hw_odometry_t* odometry = sdk::odometry_in(sample))
        add_odometry(sample, *odometry, algorithm);
      if (const hw_imu_t* imu = sdk::imu_in(sample)) add_imu(sample, *imu, algorithm);
      if (sample.kind == HW_SAMPLE_RANGE_SCAN && scanner_.id == sample.sensor_id) scans.push_back(&sample);
    }
    std::stable_sort(scans.begin(), scans.end(),
                     [](const hw_sample_t* a, const hw_sample_t* b) { return a->t_end_ns < b->t_end_ns; });
    const ScanAnswer* answer = nullptr;
    for (const hw_sample_t* sample : scans) {
      answer = &algorithm.process(scan_of(*sample));
      end_ns_ = sample->t_end_ns;
    }
    return answer;
  }

  /// Answers the pose of the last scan, at its end, or that there is none, and logs where that changes.
  void put_pose(const sdk::Host& host, const hw_frame_t& frame, const ScanAnswer& answer) {
    if (answer.has_pose) {
      const Mat6 covariance = body_.covariance(answer.T_map_scanner, answer.covariance);
      const bool is_earlier = end_ns_ > 0 && end_ns_ < frame.t_ns;
      host.put_pose(body_.pose(answer.T_map_scanner), covariance.data(), is_earlier ? end_ns_ : 0);
    } else {
      host.put_lost();
    }
    if (lost_ != answer.has_pose) return;
    lost_ = !answer.has_pose;
    const std::string what = lost_ ? " determines no pose" : " has a pose again";
    host.log(lost_ ? HW_LOG_WARNING : HW_LOG_INFO, "frame " + std::to_string(frame.sequence) + what);
  }

 private:
  struct Sensor {
    std::optional<std::uint32_t> id{};
    Pose T_body_sensor{};
  };

  void add_odometry(const hw_sample_t& sample, const hw_odometry_t& odometry,
                    LidarOdometry& algorithm) const {
    if (odometry_.id != sample.sensor_id) return;
    const Pose T_scanner_sensor = body_.T_sensor_body() * odometry_.T_body_sensor;
    OdometryReading reading;
    reading.t_ns = sample.t_end_ns;
    reading.T_odom_scanner = to_pose(odometry.T_odom_sensor) * T_scanner_sensor.inverse();
    const Mat3 turn = T_scanner_sensor.q.toRotationMatrix();
    Mat6 covariance;
    for (std::uint32_t i = 0; i < 6; ++i) {
      for (std::uint32_t j = 0; j < 6; ++j) covariance(i, j) = hw_odometry_covariance(&odometry, i, j);
    }
    reading.covariance = moved(covariance, turn, -(T_scanner_sensor.q * T_scanner_sensor.inverse().t));
    algorithm.add(reading);
  }

  /// A covariance in other axes and at the end of an arm; what is not measured stays so where the axes are the same.
  static Mat6 moved(const Mat6& covariance, const Mat3& turn, const Vec3& back) {
    if (!covariance.allFinite()) {
      const bool all = !std::isfinite(covariance(3, 3)) || !std::isfinite(covariance(4, 4)) ||
                       !std::isfinite(covariance(5, 5));
      Mat6 open = Mat6::Zero();
      open.diagonal().head<3>().setConstant(std::nan(""));
      // Without a covariance turns are trusted like ways; with an infinite one they are not measured.
      const bool no_turns = all && (std::isinf(covariance(3, 3)) || std::isinf(covariance(4, 4)) ||
                                    std::isinf(covariance(5, 5)));
      open.diagonal().tail<3>().setConstant(no_turns ? std::numeric_limits<double>::infinity()
                                                     : std::nan(""));
      return open;
    }
    Mat6 turned = Mat6::Zero();
    turned.topLeftCorner<3, 3>() = turned.bottomRightCorner<3, 3>() = turn;
    return carried_covariance(turned * covariance * turned.transpose(), -back);
  }

  void add_imu(const hw_sample_t& sample, const hw_imu_t& imu, LidarOdometry& algorithm) const {
    if (imu_.id != sample.sensor_id) return;
    RateReading reading;
    reading.begin_ns = sample.t_begin_ns;
    reading.end_ns = sample.t_end_ns;
    for (int k = 0; k < 3; ++k) {  // an axis that is not measured does not turn
      const double rate = imu.angular_rad_s[k];
      reading.rate(k) = std::isnan(rate) ? 0.0 : rate;
    }
    reading.rate = body_.T_sensor_body().q * (imu_.T_body_sensor.q * reading.rate);
    algorithm.add(reading);
  }

  /// The first returns of a scan's rays.
  static Scan scan_of(const hw_sample_t& sample) {
    const sdk::RangeScan rays(sample);
    Scan scan;
    scan.begin_ns = sample.t_begin_ns;
    scan.end_ns = sample.t_end_ns;
    const std::size_t firsts = rays.layers() > 1 ? rays.size() / rays.layers() : rays.size();
    scan.planar = firsts > 0;
    scan.points.reserve(firsts);
    const bool timed = rays.c_scan().t_offset_ns != nullptr;
    for (std::size_t i = 0; i < firsts; ++i) {
      if (rays[i].elevation_rad != 0.0) scan.planar = false;
      const auto point = rays.point(i);
      if (!point || rays[i].range_m == 0.0) continue;
      scan.points.emplace_back(point->x, point->y, point->z);
      if (timed) scan.times_ns.push_back(rays.time_ns(i));
      if (rays.is_organised())
        scan.places.push_back(
            {static_cast<std::uint32_t>(i / rays.width()), static_cast<std::uint32_t>(i % rays.width())});
    }
    if (!rays.is_organised()) scan.places = places_of(scan.points);
    return scan;
  }

  Sensor scanner_, odometry_, imu_;
  BodyFrame body_;
  double noise_m_ = std::nan("");
  double noise_per_m_ = std::nan("");
  bool lost_ = false;
  std::int64_t end_ns_ = 0;
};

}  // namespace hallway::icp
