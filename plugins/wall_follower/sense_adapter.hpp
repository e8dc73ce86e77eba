// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/plugin.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "adapter/body_frame.hpp"
#include "wall_follower/core/angles.hpp"
#include "wall_follower/core/senses.hpp"

namespace hallway::wall_follower {

/// Between the ABI and what Follower takes: five infrared detectors, a sonar that sweeps, bump zones and the encoders of two tracks. A scanner of one ray is an infrared detector, by the direction in which it looks; one of more rays is the sonar.
class SenseAdapter {
 public:
  /// Takes the sensors.
  void activate(const hw_activation_t& activation) {
    *this = SenseAdapter();
    for (std::uint32_t i = 0; i < activation.n_sensors; ++i) add(*activation.sensors[i]);
  }

  /// What the robot lacks to follow walls; empty where it has all.
  std::string missing() const {
    if (!encoders_) return "encoders of two wheels beside each other";
    if (!looks_[kFront] || !looks_[kRight] || !looks_[kFrontRight])
      return "infrared detectors that look ahead, to the right and between these";
    return {};
  }

  const Body& body() const { return body_; }

  /// What a frame tells. Bumps, ticks and ranges of several readings are in the order of their ends.
  const Senses& gather(const hw_frame_t& frame) {
    senses_.t_ns = frame.t_ns;
    senses_.bump = {};
    senses_.sweep.reset();
    for (auto& readings : senses_.infrared) readings.clear();
    for (std::uint32_t k = 0; k < frame.n_samples; ++k) take(*frame.samples[k]);
    return senses_;
  }

 private:
  struct Wheels {
    std::uint32_t id;
    std::uint64_t left, right;
    double left_m_per_tick, right_m_per_tick;
  };

  void add(const hw_sensor_info_t& info) {
    const Pose T = to_pose(info.T_body_sensor);
    const Vec3 ahead = T.q * Vec3::UnitX();
    if (info.kind == HW_SAMPLE_BUMP) bump_yaw_.push_back({info.id, std::atan2(ahead.y(), ahead.x())});
    if (info.kind == HW_SAMPLE_ENCODER && !encoders_) add_wheels(info, T);
    if (info.kind != HW_SAMPLE_RANGE_SCAN) return;
    const double yaw = std::atan2(ahead.y(), ahead.x());
    const hw_range_scan_info_t* scan = hw_range_scan_info_of(&info);
    const bool is_detector = scan != nullptr && scan->width <= 1 && scan->height <= 1;
    if (!is_detector) {
      if (!sonar_) sonar_ = Turned{info.id, yaw};
      return;
    }
    const auto look = static_cast<std::size_t>(std::lround(2.0 - yaw / (0.5 * kQuarter)));
    if (look >= kLooks || looks_[look]) return;
    looks_[look] = info.id;
    body_.infrared[look] = {T.t.head<2>(), yaw};
  }

  void add_wheels(const hw_sensor_info_t& info, const Pose& T) {
    const std::vector<hw_encoder_wheel_t> wheels = sdk::copy_wheels(info);
    Wheels found{info.id, 0, 0, std::nan(""), std::nan("")};
    double left_y = 0.0, right_y = 0.0;
    for (std::uint64_t i = 0; i < wheels.size(); ++i) {
      const double y = (T * Vec3(wheels[i].position[0], wheels[i].position[1], wheels[i].position[2])).y();
      if (y > left_y) {
        left_y = y;
        found.left = i;
        found.left_m_per_tick = wheels[i].m_per_tick;
      } else if (y < right_y) {
        right_y = y;
        found.right = i;
        found.right_m_per_tick = wheels[i].m_per_tick;
      }
    }
    if (std::isnan(found.left_m_per_tick) || std::isnan(found.right_m_per_tick)) return;
    body_.wheel_base_m = left_y - right_y;
    encoders_ = found;
  }

  void take(const hw_sample_t& sample) {
    if (sample.kind == HW_SAMPLE_BUMP) take_bump(sample);
    if (sample.kind == HW_SAMPLE_ENCODER && encoders_ && encoders_->id == sample.sensor_id) {
      const auto* ticks = static_cast<const hw_encoder_t*>(sample.payload);
      if (ticks->count <= std::max(encoders_->left, encoders_->right)) return;
      senses_.left_m =
          encoders_->left_m_per_tick * static_cast<double>(hw_wheel_ticks_at(ticks, encoders_->left));
      senses_.right_m =
          encoders_->right_m_per_tick * static_cast<double>(hw_wheel_ticks_at(ticks, encoders_->right));
    }
    if (sample.kind == HW_SAMPLE_RANGE_SCAN) take_ranges(sample);
  }

  void take_ranges(const hw_sample_t& sample) {
    const sdk::RangeScan scan(sample);
    if (sonar_ && sonar_->id == sample.sensor_id) {
      Sweep sweep{sample.t_begin_ns, {}};
      const std::size_t firsts = scan.layers() > 1 ? scan.size() / scan.layers() : scan.size();
      for (std::size_t i = 0; i < firsts; ++i)
        sweep.pings.push_back({scan[i].azimuth_rad + sonar_->yaw, scan[i].range_m});
      senses_.sweep = std::move(sweep);
      return;
    }
    for (std::size_t look = 0; look < kLooks; ++look) {
      if (looks_[look] == sample.sensor_id && scan.size() > 0)
        senses_.infrared[look].push_back(scan[0].range_m);
    }
  }

  void take_bump(const hw_sample_t& sample) {
    double yaw = 0.0;
    for (const Turned& one : bump_yaw_) {
      if (one.id == sample.sensor_id) yaw = one.yaw;
    }
    const auto* bump = static_cast<const hw_bump_t*>(sample.payload);
    for (std::uint64_t i = 0; i < bump->count; ++i) {
      const hw_bump_zone_t& zone = *hw_bump_zone_at(bump, i);
      if (zone.pressed == 0) continue;
      const double at = wrapped(std::atan2(zone.direction[1], zone.direction[0]) + yaw);
      if (std::abs(at) < kFrontSector) {
        (at >= 0.0 ? senses_.bump.left : senses_.bump.right) = true;
      } else if (std::abs(at) > kBackSector) {
        senses_.bump.behind = true;
      } else {
        (at >= 0.0 ? senses_.bump.left_side : senses_.bump.right_side) = true;
      }
    }
  }

  struct Turned {
    std::uint32_t id;
    double yaw;
  };

  static constexpr double kFrontSector = 1.22;  // [rad]
  static constexpr double kBackSector = 1.92;   // [rad]

  Body body_;
  Senses senses_;
  std::array<std::optional<std::uint32_t>, kLooks> looks_;
  std::optional<Turned> sonar_;
  std::vector<Turned> bump_yaw_;
  std::optional<Wheels> encoders_;
};

}  // namespace hallway::wall_follower
