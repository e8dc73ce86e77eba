// SPDX-License-Identifier: MIT
#include "run/feed/truth_tables.hpp"

#include "geom/arrays.hpp"
#include "log/landmarks.hpp"
#include "log/true_planes.hpp"
#include "record/files.hpp"

namespace hallway::run {

namespace files = record::files;

log::StampedPose stamped_pose(std::int64_t t_ns, const Pose& pose) {
  return {.t_s = static_cast<double>(t_ns) / 1e9,
          .position_m = to_array(pose.t),
          .orientation = to_array(pose.q)};
}

void TruthTables::add(std::uint32_t iteration, const SourceFrame& frame) {
  if (!frame.T_world_body) return;
  const log::StampedPose pose = stamped_pose(frame.t_ns(), *frame.T_world_body);
  trajectory_.push_back(pose);
  poses_.push_back({.iteration = iteration,
                    .position_m = pose.position_m,
                    .orientation = pose.orientation,
                    .orientation_known = frame.orientation_known});
}

void TruthTables::write(const std::filesystem::path& folder, const Source& source) const {
  if (!trajectory_.empty()) {
    log::write_tum(folder / files::kTrueTrajectory, trajectory_);
    log::write_poses(folder / files::kTruePoses, poses_);
  }
  if (source.true_landmarks()) log::write_landmarks(folder / files::kTrueLandmarks, *source.true_landmarks());
  if (source.true_planes()) log::write_true_planes(folder / files::kTruePlanes, *source.true_planes());
}

}  // namespace hallway::run
