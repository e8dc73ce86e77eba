// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "import/lidar_cloud.hpp"
#include "import/pose_rows.hpp"

namespace hallway::import {

// The layout of the KITTI odometry benchmark:
//   sequences/NN/velodyne/000000.bin …  float32 x, y, z, reflectance of each point; lidar frame: x forward, y left, z up
//   sequences/NN/times.txt              seconds, a line for each cloud
//   sequences/NN/calib.txt              P0 to P3: projections of the cameras; Tr: T_cam0_velodyne
//   poses/NN.txt                        T_world_cam0, a line for each cloud; not of all sequences
// cam0 and its world have x right, y down and z forward.

/// Most clouds of a sequence: their names have six digits.
inline constexpr std::uint32_t kMaxKittiFrames = 1'000'000;

/// What calib.txt has.
struct KittiCalibration {
  std::array<std::optional<PoseRows>, 4> projection{};  ///< P0 to P3: 3x4, row by row
  Pose T_cam0_velodyne;
};

/// The T_cam0_velodyne of sequences that this program writes: axes are exchanged, the origins are the same.
Pose kitti_cam0_velodyne();

/// A sequence: the times and poses of all its clouds. A cloud is read when it is requested.
struct KittiSequence {
  std::filesystem::path folder;  ///< …/sequences/NN
  KittiCalibration calibration;
  std::vector<std::int64_t> t_ns;    ///< of each cloud, at least one; they increase
  std::vector<Pose> T_world_cam0{};  ///< empty, or of each cloud

  std::uint32_t frames() const { return static_cast<std::uint32_t>(t_ns.size()); }
  bool has_truth() const { return !T_world_cam0.empty(); }
  /// The lidar's true pose in a world with z up: inverse(Tr) * pose * Tr, where poses exist. This world is the lidar's frame where the pose is the identity,
  /// as the first one of the benchmark is.
  std::optional<Pose> T_world_velodyne(std::uint32_t index) const;
  /// The file of a cloud.
  std::filesystem::path cloud_file(std::uint32_t index) const;
  /// Reads a cloud; `intensity` is the reflectance. Throws Error{kBadInput, kIo}.
  LidarCloud cloud(std::uint32_t index) const;
};

/// Opens a sequence.
///
/// Checks that the clouds are 000000.bin and so on without a gap, that each has whole points, and that times and poses are as many. Throws Error{kBadInput,
/// kIo} naming file and line.
/// @param folder  …/sequences/NN; or the folder above `sequences`, if it has one sequence
KittiSequence open_kitti_odometry(const std::filesystem::path& folder);

/// Reads the content of a .bin file. Points that are not finite are left out. Throws Error{kBadInput} with the byte: a part of a point at the end, a
/// coordinate beyond kMaxImport_m.
LidarCloud parse_kitti_cloud(std::string_view bytes, const std::string& file);

/// Reads calib.txt; Tr is required. Lines of other names are passed over. Throws Error{kBadInput} with the line.
KittiCalibration parse_kitti_calibration(std::string_view text, const std::string& file);

/// Reads times.txt to the nearest nanosecond. Throws Error{kBadInput} with the line, also where times do not increase.
std::vector<std::int64_t> parse_kitti_times(std::string_view text, const std::string& file);

/// Reads poses. Throws Error{kBadInput} with the line, also for a matrix that is no rotation within kRotationTolerance.
std::vector<Pose> parse_kitti_poses(std::string_view text, const std::string& file);

/// The content of a .bin file. Without intensities the reflectance is 0. Throws as check_cloud().
std::string print_kitti_cloud(const LidarCloud& cloud, const std::string& file);

/// Writes a sequence cloud by cloud. Rings and times of points have no place in this layout.
class KittiOdometryWriter {
 public:
  /// Makes ROOT/sequences/NAME. Throws Error{kIo} where it is there already and not empty, or poses/NAME.txt is there.
  ///
  /// @param name  of the sequence, such as "00"
  KittiOdometryWriter(const std::filesystem::path& root, const std::string& name,
                      const Pose& T_cam0_velodyne = kitti_cam0_velodyne());

  /// Adds a cloud. Poses are written as Tr * T_world_velodyne * inverse(Tr); to have the first one be the identity, as in the benchmark, take the first
  /// T_world_velodyne as the world. Throws Error{kBadInput} for a time that is not after the last one, a pose that is none, poses of some
  /// clouds only, and as check_cloud(); Error{kIo}.
  void add(std::int64_t t_ns, const LidarCloud& cloud, const std::optional<Pose>& T_world_velodyne);
  /// Writes calib.txt, times.txt and, with poses, poses/NAME.txt. Throws Error{kBadInput} without clouds, Error{kIo}.
  void close();

 private:
  std::filesystem::path root_;
  std::string name_;
  Pose T_cam0_velodyne_;
  std::uint32_t frames_ = 0;
  std::int64_t last_ns_ = -1;
  bool has_poses_ = false;
  std::string times_, poses_;
};

}  // namespace hallway::import
