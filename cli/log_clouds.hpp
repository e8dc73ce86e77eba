// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/sensor_info.hpp"
#include "log_input.hpp"
#include "log_readings.hpp"

namespace hallway::cli {

/// The clouds of a sensor of a log as layouts of other programs have them, with the truth.
class CloudExport {
 public:
  /// Reads the log once for its truth.
  /// @param sensor   its name; empty: the only one of rays, else of points
  /// @param deskews  whether points are brought to where the sensor truly was when the scan ended
  /// Throws as find_sensor(); Error{kBadInput} where points are to be deskewed and there is no truth.
  CloudExport(run::Source& source, const std::string& sensor, bool deskews, bool quiet);

  bool is_of(const hw_sample_t& sample) const { return sample.sensor_id == sensor_.id; }
  const import::TrueMotion& motion() const { return truth_.motion; }
  const Pose& mount() const { return mount_; }
  /// Whether the log tells where the sensor was at the end of every scan.
  bool has_poses() const { return has_poses_; }

  /// The cloud of sample `k`; deskewed, it has no times. Throws Error{kBadInput} where that is not possible.
  import::LidarCloud cloud(const run::SourceFrame& frame, std::uint32_t k);
  /// T_world_sensor at the end of the scan; nothing unless has_poses().
  std::optional<Pose> pose(const run::SourceFrame& frame, std::uint32_t k);
  /// Prints how near the truth is to what was written, and keeps it in `warnings`.
  void warn(std::vector<std::string>& warnings) const;

 private:
  void deskew(const hw_sample_t& sample, const TrueReading& reading, import::LidarCloud& cloud);

  host::SensorInfo sensor_;
  Pose mount_;
  bool deskews_;
  LogMotion truth_;
  bool has_poses_ = false;
  bool deskewed_ = false;
  std::int64_t longest_gap_ns_ = 0;
  std::uint64_t poses_ = 0, interpolated_ = 0;
};

}  // namespace hallway::cli
