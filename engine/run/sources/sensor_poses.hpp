// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "geometry/se3.hpp"
#include "host/stage.hpp"
#include "run/sources/abi_pose.hpp"

namespace hallway::run {

/// Where the sensors of a source are on the body.
class SensorPoses {
 public:
  explicit SensorPoses(std::span<const host::SensorInfo> sensors) {
    for (const host::SensorInfo& sensor : sensors)
      poses_.push_back({sensor.id, pose_of(sensor.T_body_sensor)});
  }
  /// T_body_sensor of the sensor of that id. Throws Error{kInternal} if there is none.
  const Pose& of(std::uint32_t sensor) const {
    for (const Entry& entry : poses_) {
      if (entry.sensor == sensor) return entry.T_body_sensor;
    }
    throw Error(ErrorCode::kInternal, "a sample of a sensor that its source does not have");
  }

 private:
  struct Entry {
    std::uint32_t sensor;
    Pose T_body_sensor;
  };
  std::vector<Entry> poses_;
};

}  // namespace hallway::run
