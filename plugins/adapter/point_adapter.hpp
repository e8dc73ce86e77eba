// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/plugin.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "adapter/body_frame.hpp"
#include "adapter/newest_sample.hpp"
#include "geometry/se3.hpp"

namespace hallway {

/// Between the ABI and an algorithm that takes a frame's points and says where their sensor is. The algorithm is fed with points in
/// the frame of the first point sensor (what other sensors see is moved there) and answers in that frame; answers are moved to the
/// body, so that the map's frame is the body's at the frame that the algorithm began with.
class PointAdapter {
 public:
  using Mat6 = Eigen::Matrix<double, 6, 6>;

  /// Takes the sensors that give points. Throws sdk::Failure when there is none.
  void activate(const hw_activation_t& activation) {
    sensors_.clear();
    noise_m_ = std::nan("");
    for (std::uint32_t i = 0; i < activation.n_sensors; ++i) {
      const hw_sensor_info_t& sensor = *activation.sensors[i];
      if (sensor.kind == HW_SAMPLE_POINTS) add_sensor(sensor);
    }
    if (sensors_.empty()) throw sdk::Failure(HW_ERROR_ARGUMENT, "no sensor gives points");
    reset();
  }

  /// The largest standard deviation that the sensors' descriptions tell, metres; NaN where they tell none.
  double noise_m() const { return noise_m_; }

  /// As after activate().
  void reset() { lost_ = false; }

  /// The frame's points in the reference frame, sample after sample, of each sensor's newest readings; they live until the next call. Throws sdk::Failure for a sample of a
  /// sensor that was not announced.
  const std::vector<Vec3>& gather(const hw_frame_t& frame) {
    points_.clear();
    tracks_.clear();
    ranges_.clear();
    for (std::uint32_t k = 0; k < frame.n_samples; ++k) {
      const hw_sample_t& sample = *frame.samples[k];
      if (sample.kind == HW_SAMPLE_POINTS && !is_superseded(frame, k)) add_points(k, sample);
    }
    return points_;
  }

  /// The ids under which the sensors follow the points of gather(), in that order, HW_NO_TRACK for none; empty where no sensor
  /// follows any. Different sensors' ids are taken for different ones only if they are.
  const std::vector<std::uint64_t>& tracks() const { return tracks_; }

  /// Answers the pose of a frame, or that there is none, and logs where that changes. `covariance`: of the sensor pose's error
  /// (position, then rotation vector in the algorithm's map frame), if it is known.
  void put_pose(const sdk::Host& host, const hw_frame_t& frame, bool has_pose, const Pose& T_map_sensor,
                const std::optional<Mat6>& covariance = std::nullopt) {
    if (has_pose && covariance) {
      const Mat6 of_body = body_covariance(T_map_sensor, *covariance);
      host.put_pose(body_pose(T_map_sensor), of_body.data());
    } else if (has_pose) {
      host.put_pose(body_pose(T_map_sensor));
    } else {
      host.put_lost();
    }
    if (lost_ != has_pose) return;
    lost_ = !has_pose;
    const std::string what = lost_ ? " determines no pose" : " has a pose again";
    host.log(lost_ ? HW_LOG_WARNING : HW_LOG_INFO, "frame " + std::to_string(frame.sequence) + what);
  }

  /// Answers which landmark each point was taken for; `landmarks` has one entry for each point of gather(), in that order.
  void put_associations(const sdk::Host& host, const std::vector<std::uint64_t>& landmarks) {
    for (const Range& range : ranges_) {
      const auto first = landmarks.begin();
      associations_.assign(first + static_cast<std::ptrdiff_t>(range.begin),
                           first + static_cast<std::ptrdiff_t>(range.end));
      host.put_associations(range.sample, associations_);
    }
  }

  /// T_map_body, in the ABI's form, of a sensor pose or of a submap's, which is one.
  hw_pose_t body_pose(const Pose& T_map_sensor) const { return body_.pose(T_map_sensor); }

  /// The covariance of body_pose() from that of the sensor pose, as hw_pose_output_t has it; symmetric, so by rows or columns.
  Mat6 body_covariance(const Pose& T_map_sensor, const Mat6& covariance) const {
    return body_.covariance(T_map_sensor, covariance);
  }

  /// The covariance of a point of the algorithm's map in the map's frame.
  Mat3 map_covariance(const Mat3& covariance) const {
    const Mat3 turn = body_.T_body_sensor().q.toRotationMatrix();
    return turn * covariance * turn.transpose();
  }

  /// A point of the algorithm's map in the map's frame.
  Vec3 map_point(const Vec3& p) const { return body_.T_body_sensor() * p; }

 private:
  struct Sensor {
    std::uint32_t id;
    Pose T_reference_sensor;
  };
  /// Which points of `points_` a sample gave.
  struct Range {
    std::uint32_t sample;
    std::size_t begin, end;
  };

  void add_sensor(const hw_sensor_info_t& info) {
    noise_m_ = std::fmax(noise_m_, sdk::largest_noise_m(info));
    const Pose T_body_sensor = to_pose(info.T_body_sensor);
    if (sensors_.empty()) body_ = BodyFrame(T_body_sensor);
    sensors_.push_back({info.id, sensors_.empty() ? Pose{} : body_.T_sensor_body() * T_body_sensor});
  }

  const Sensor& find_sensor(std::uint32_t id) const {
    for (const Sensor& sensor : sensors_) {
      if (sensor.id == id) return sensor;
    }
    throw sdk::Failure(HW_ERROR_DATA,
                       "a sample of sensor " + std::to_string(id) + ", which was not announced");
  }

  void add_points(std::uint32_t index, const hw_sample_t& sample) {
    const Sensor& sensor = find_sensor(sample.sensor_id);
    const bool is_reference = &sensor == &sensors_.front();
    const auto& points = *static_cast<const hw_points_t*>(sample.payload);
    ranges_.push_back({index, points_.size(), points_.size() + points.count});
    for (std::uint64_t i = 0; i < points.count; ++i) {
      const hw_point3_t& p = *hw_point_at(&points, i);
      const Vec3 point(p.x, p.y, p.z);
      points_.push_back(is_reference ? point : sensor.T_reference_sensor * point);
    }
    add_tracks(sample, points);
  }

  void add_tracks(const hw_sample_t& sample, const hw_points_t& points) {
    const bool given = (sample.flags & HW_SAMPLE_TRACKED) != 0 && points.track != nullptr && points.count > 0;
    if (!given && tracks_.empty()) return;
    tracks_.resize(points_.size(), HW_NO_TRACK);
    if (given)
      std::copy(points.track, points.track + points.count,
                tracks_.end() - static_cast<std::ptrdiff_t>(points.count));
  }

  std::vector<Sensor> sensors_;  ///< those that give points; the first one is the reference
  BodyFrame body_;
  double noise_m_ = std::nan("");
  bool lost_ = false;
  std::vector<Vec3> points_;  ///< of this frame, in the reference sensor's frame
  std::vector<std::uint64_t> tracks_;
  std::vector<Range> ranges_;
  std::vector<std::uint64_t> associations_;
};

}  // namespace hallway
