// SPDX-License-Identifier: MIT
//
// The files of a KITTI odometry sequence. Whatever the bytes are, they are refused with an Error that names their file, or what was read is sound. The first
// byte chooses which file the rest is.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "base/error.hpp"
#include "import/kitti_odometry.hpp"

namespace {

using namespace hallway;

enum What : std::uint8_t { kCloud, kCalibration, kTimes, kPoses, kCount };

void demand(bool condition) {
  if (!condition) std::abort();
}

void check_pose(const Pose& pose) {
  demand(pose.t.cwiseAbs().maxCoeff() <= import::kMaxImport_m && std::abs(pose.q.norm() - 1.0) < 1e-9);
  demand(import::fault_of(import::rows_of(pose)).empty());
}

void check_cloud(const std::string& bytes) {
  const import::LidarCloud cloud = import::parse_kitti_cloud(bytes, "file");
  demand(cloud.intensity.size() == cloud.points.size());
  demand(16 * (cloud.points.size() + cloud.not_finite) == bytes.size());
  // What was read can be written, and reads back the same.
  const std::string again = import::print_kitti_cloud(cloud, "file");
  demand(import::parse_kitti_cloud(again, "file").points == cloud.points);
}

void check(What what, const std::string& bytes) {
  switch (what) {
    case kCloud:
      return check_cloud(bytes);
    case kCalibration:
      return check_pose(import::parse_kitti_calibration(bytes, "file").T_cam0_velodyne);
    case kTimes: {
      std::int64_t last_ns = -1;
      for (const std::int64_t t_ns : import::parse_kitti_times(bytes, "file")) {
        demand(t_ns > last_ns);
        last_ns = t_ns;
      }
      return;
    }
    default:
      for (const Pose& pose : import::parse_kitti_poses(bytes, "file")) check_pose(pose);
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
