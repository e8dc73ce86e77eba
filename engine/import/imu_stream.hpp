// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "import/imu_interval.hpp"
#include "import/rig_recording.hpp"
#include "import/true_track.hpp"

namespace hallway::import {

/// The samples of an IMU by the frames that they are in: each in the first frame that is not before its interval's end.
class ImuStream {
 public:
  /// @param samples  times increase
  explicit ImuStream(std::vector<ImuSample> samples);

  std::int64_t begin_ns() const { return intervals_.front().begin_ns; }
  std::int64_t end_ns() const { return intervals_.back().end_ns; }
  /// Adds the samples of a frame.
  /// @param before_ns  time of the frame before; below 0: there is none
  /// @param exact      gives poses of its own times only
  void add_samples(std::int64_t before_ns, std::uint32_t sensor, const TrueTrack& exact,
                   RigFrame& frame) const;

 private:
  std::vector<ImuSample> samples_;
  std::vector<Interval> intervals_;
};

/// What is known of a sensor of a rig.
host::SensorInfo rig_sensor(std::uint32_t id, std::uint32_t kind, const char* name,
                            const Pose& T_body_sensor);

}  // namespace hallway::import
