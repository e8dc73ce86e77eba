// SPDX-License-Identifier: MIT
#include "run/feed/truth_tables.hpp"

#include "geom/arrays.hpp"
#include "log/landmarks.hpp"
#include "log/poses.hpp"
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
  if (!trajectory_) {
    orientations_ = frame.orientation_known;
    trajectory_.emplace(folder_ / files::kTrueTrajectory, ' ', std::string_view{});
    poses_.emplace(folder_ / files::kTruePoses, ',', log::pose_columns(orientations_));
  }
  const log::StampedPose pose = stamped_pose(frame.t_ns(), *frame.T_world_body);
  log::add_row(trajectory_->next_row(), pose);
  log::add_row(poses_->next_row(),
               {.iteration = iteration, .position_m = pose.position_m, .orientation = pose.orientation},
               orientations_);
}

void TruthTables::finish(const Source& source) {
  if (trajectory_) {
    trajectory_->close();
    poses_->close();
  }
  if (source.true_landmarks())
    log::write_landmarks(folder_ / files::kTrueLandmarks, *source.true_landmarks());
  if (source.true_planes()) log::write_true_planes(folder_ / files::kTruePlanes, *source.true_planes());
}

}  // namespace hallway::run
