// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "geometry/se3.hpp"
#include "host/sensor_info.hpp"
#include "import/imu_table.hpp"
#include "import/lidar_cloud.hpp"

namespace hallway::import {

/// A reading of one of the sensors of a rig.
struct RigSample {
  std::uint32_t sensor = 0;    ///< its place in RigRecording::sensors()
  std::uint64_t sequence = 0;  ///< counts the readings of the sensor
  std::int64_t t_begin_ns = 0;
  std::int64_t t_end_ns = 0;
  /// Times of a cloud's points count from t_begin_ns and are within the reading.
  std::variant<LidarCloud, ImuSample> content{};
  std::optional<Pose> T_world_body{};  ///< at t_end_ns, where the recording has a true pose of that very time
};

/// One moment of a rig: what its sensors have measured since the one before.
struct RigFrame {
  std::int64_t t_ns = 0;
  std::vector<RigSample> samples{};
  std::optional<Pose> T_world_body{};  ///< the true pose, where it is known
};

/// A recording of several sensors, frame by frame. A frame is a pure function of its number as long as the files stay as they are.
class RigRecording {
 public:
  virtual ~RigRecording() = default;

  /// How many frames there are, at least one.
  virtual std::uint32_t frames() const = 0;
  /// Replaces `frame` by frame `index`, below frames(). Times do not decrease. Throws Error{kBadInput, kIo} naming the file.
  virtual void read(std::uint32_t index, RigFrame& frame) = 0;
  /// Mean time from frame to frame.
  virtual std::int64_t period_ns() const = 0;
  /// Whether any true pose is known.
  virtual bool has_truth() const = 0;
  /// The sensors, by id from 0: clouds as points, IMUs.
  const std::vector<host::SensorInfo>& sensors() const { return sensors_; }

 protected:
  std::vector<host::SensorInfo> sensors_;
};

/// A sequence of the KITTI odometry layout: a frame for each cloud, at its time. The body is the lidar, in a world that is the lidar's frame where the pose of
/// the file is the identity. Throws as open_kitti_odometry().
std::unique_ptr<RigRecording> open_kitti_rig(const std::filesystem::path& folder);

struct RigOptions {
  std::int64_t truth_within_ns = 100'000'000;  ///< how far from a frame its true pose may be
  std::int64_t period_ns = 100'000'000;        ///< EuRoC: from frame to frame
};

/// The IMU and the true states of a EuRoC sequence: a frame each period, from the begin of the first sample's interval until all samples are in one. Throws as
/// read_euroc().
std::unique_ptr<RigRecording> open_euroc_rig(const std::filesystem::path& folder, const RigOptions& options);

/// A folder of PCD files with an IMU: a frame at the time of each cloud, and one after the last. Where the points of the first cloud have times after its own,
/// a cloud is in the frame after that of its time, when it is whole; else in that of its time, and there is no frame after the last. A last frame has the samples
/// of the IMU that remain. Throws as open_pcd_imu_folder().
std::unique_ptr<RigRecording> open_pcd_imu_rig(const std::filesystem::path& folder,
                                               const RigOptions& options);

}  // namespace hallway::import
