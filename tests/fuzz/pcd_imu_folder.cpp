// SPDX-License-Identifier: MIT
//
// The files of a folder of lidar clouds and an IMU. Whatever the bytes are, they are refused with an Error that names their file, or what was read is sound
// and reads back the same once it is written. The first byte chooses which file the rest is.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "base/error.hpp"
#include "import/pcd_imu_folder.hpp"
#include "import/timed_poses.hpp"

namespace {

using namespace hallway;

enum What : std::uint8_t { kCloud, kImu, kTruth, kMounts, kName, kCount };

void demand(bool condition) {
  if (!condition) std::abort();
}

void check_cloud(const std::string& bytes) {
  const import::LidarCloud cloud = import::parse_lidar_pcd(bytes, "file");
  const std::string written = import::print_lidar_pcd(cloud, "written");
  const import::LidarCloud again = import::parse_lidar_pcd(written, "written");
  demand(again.points.size() == cloud.points.size() && again.ring == cloud.ring);
  demand(again.t_offset_ns == cloud.t_offset_ns && again.intensity.size() == cloud.intensity.size());
  demand(import::print_lidar_pcd(again, "written").size() == written.size());
}

void check_mounts(const std::string& text) {
  const import::RigMounts mounts = import::parse_mounts(text, "file");
  demand(import::is_sound(mounts.T_body_lidar) && import::is_sound(mounts.T_body_imu));
  const import::RigMounts again = import::parse_mounts(import::print_mounts(mounts), "written");
  demand(again.T_body_lidar.t == mounts.T_body_lidar.t && again.T_body_imu.t == mounts.T_body_imu.t);
}

void check(What what, const std::string& bytes) {
  std::int64_t last_ns = -1;
  switch (what) {
    case kCloud:
      return check_cloud(bytes);
    case kImu:
      for (const import::ImuSample& sample : import::parse_folder_imu(bytes, "file")) {
        import::check_sample(sample, last_ns, "sample");
        last_ns = sample.t_ns;
      }
      return;
    case kTruth:
      for (const import::TimedPose& pose : import::parse_timed_poses(bytes, "file")) {
        demand(pose.t_ns > last_ns && import::is_sound(pose.T_world_body));
        last_ns = pose.t_ns;
      }
      return;
    case kMounts:
      return check_mounts(bytes);
    default:
      demand(import::time_of_name(bytes).value_or(0) >= 0);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  try {
    check(static_cast<What>(data[0] % kCount), std::string(data + 1, data + size));
  } catch (const Error& error) {
    demand(error.code() == ErrorCode::kBadInput && error.where().file == "file");
  }
  return 0;
}
