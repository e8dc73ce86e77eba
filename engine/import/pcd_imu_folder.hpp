// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "import/imu_table.hpp"
#include "import/lidar_cloud.hpp"
#include "import/true_track.hpp"

namespace hallway::import {

// A folder of lidar clouds and an IMU:
//   NANOSECONDS.pcd, or SECONDS.NANOSECONDS.pcd with nine decimals   clouds (lidar_cloud.hpp), named by their times
//   imu.csv       t_ns,wx,wy,wz,ax,ay,az: rad/s and m/s^2, in the IMU's frame
//   truth.tum     T_world_body, lines `t x y z qx qy qz qw`; need not be there
//   mounts.toml   tables [lidar] and [imu] with position_m = [x, y, z], orientation_wxyz = [w, x, y, z]: T_body_lidar, T_body_imu; need not be there

/// Most clouds of a folder.
inline constexpr std::size_t kMaxFolderClouds = 10'000'000;

/// Where lidar and IMU are on the body.
struct RigMounts {
  Pose T_body_lidar{};
  Pose T_body_imu{};
};

/// A cloud of a folder, and its time.
struct TimedCloud {
  std::int64_t t_ns = 0;
  std::filesystem::path file;
};

/// What a folder holds; clouds are read when they are requested. The IMU's table may have 2 GiB.
struct PcdImuFolder {
  std::vector<TimedCloud> clouds;  ///< at least one; times increase
  std::vector<ImuSample> imu;      ///< at least one; times increase
  std::vector<TimedPose> truth{};  ///< times increase; empty where truth.tum is not there
  std::optional<RigMounts> mounts{};

  /// Reads a cloud. Throws Error{kBadInput, kIo}.
  LidarCloud cloud(std::size_t index) const;
};

/// Opens a folder. Throws Error{kBadInput, kIo} naming file and line: no clouds, a name of a cloud that is no time, two clouds of a time, no imu.csv.
PcdImuFolder open_pcd_imu_folder(const std::filesystem::path& folder);

/// The time that the name of a cloud is, without its ending; empty for other names.
std::optional<std::int64_t> time_of_name(std::string_view stem);

/// Reads imu.csv. Throws as parse_imu_table().
std::vector<ImuSample> parse_folder_imu(std::string_view text, const std::string& file);

/// Reads mounts.toml; a table that is not there is the identity. Throws Error{kBadInput} with the line, also for other keys.
RigMounts parse_mounts(std::string_view text, const std::string& file);

/// The text that parse_mounts() reads back.
std::string print_mounts(const RigMounts& mounts);

/// Writes a folder as it goes on. Numbers are written so that they read back the same, coordinates of points as float32.
class PcdImuFolderWriter {
 public:
  /// Makes the folder. Throws Error{kIo}, also where it is there already and not empty; Error{kBadInput} for a mount that is no pose.
  PcdImuFolderWriter(const std::filesystem::path& folder, const std::optional<RigMounts>& mounts);
  ~PcdImuFolderWriter();

  /// Adds a cloud as NANOSECONDS.pcd. These throw Error{kBadInput} for a time that is not after the last one of its kind, and for what is not finite;
  /// Error{kIo}.
  void add(std::int64_t t_ns, const LidarCloud& cloud);
  void add(const ImuSample& sample);
  void add(const TimedPose& T_world_body);
  /// What was written is safe. Throws Error{kIo}; Error{kBadInput} without clouds or without samples.
  void close();

 private:
  struct Files;
  std::unique_ptr<Files> files_;
};

}  // namespace hallway::import
