// SPDX-License-Identifier: MIT
#include "record/answer_tables.hpp"

#include <array>

#include "log/pose_covariances.hpp"
#include "log/pose_times.hpp"
#include "log/timing.hpp"
#include "log/tum.hpp"
#include "record/files.hpp"
#include "record/plane_observations.hpp"
#include "record/plugin_topology.hpp"

namespace hallway::record {

log::StampedPose stamped_pose(std::int64_t t_ns, const hw_pose_t& pose) {
  return {.t_s = static_cast<double>(t_ns) / 1e9,
          .position_m = std::to_array(pose.position),
          .orientation = std::to_array(pose.orientation)};
}

AnswerTables::AnswerTables(const std::filesystem::path& folder)
    : folder_(folder),
      trajectory_(folder / files::kTrajectory, ' ', {}),
      times_(folder / files::kTiming, ',', log::kTimingColumns) {}

void AnswerTables::add(const AnsweredFrame& frame, const host::Outputs& outputs, const host::CallTime& time) {
  const auto [iteration, t_ns, n_samples] = frame;
  log::add_row(times_.next_row(), log::IterationTime{.iteration = iteration,
                                                     .wall_ms = milliseconds(time.wall_ns),
                                                     .cpu_ms = milliseconds(time.cpu_ns)});
  if (const auto& pose = outputs.pose(); pose && pose->valid) add_pose(iteration, t_ns, *pose);
  if (const auto& command = outputs.drive_command()) {
    if (!commands_) commands_.emplace(folder_ / files::kCommands);
    commands_->add({.iteration = iteration,
                    .linear_m_s = command->linear_m_s,
                    .angular_rad_s = command->angular_rad_s,
                    .lateral_m_s = command->lateral_m_s});
  }
  if (outputs.topology() != nullptr) topology_ = copy_topology(*outputs.topology());
  for (std::uint32_t k = 0; k < n_samples; ++k) {
    if (const auto planes = outputs.planes(k)) add_planes(iteration, *planes);
  }
}

void AnswerTables::add_pose(std::uint32_t iteration, std::int64_t t_ns, const host::PoseOutput& pose) {
  log::add_row(trajectory_.next_row(), stamped_pose(t_ns, pose.T_map_body));
  if (pose.t_ns != 0) {
    if (!pose_times_) pose_times_.emplace(folder_ / files::kPoseTimes, ',', log::kPoseTimeColumns);
    log::add_row(pose_times_->next_row(), log::IterationPoseTime{.iteration = iteration, .t_ns = pose.t_ns});
  }
  if (!pose.covariance) return;
  if (!covariances_)
    covariances_.emplace(folder_ / files::kPoseCovariances, ',', log::kPoseCovarianceColumns);
  log::add_row(
      covariances_->next_row(),
      log::IterationCovariance{.iteration = iteration, .covariance = log::upper_triangle(*pose.covariance)});
}

void AnswerTables::add_planes(std::uint32_t iteration, const host::PlaneList& list) {
  if (!planes_) planes_.emplace(folder_ / files::kPlanes, ',', log::kPlaneColumns);
  for (const hw_plane_t& plane : list.planes)
    log::add_row(planes_->next_row(), log::IterationPlane{iteration, plane_observation(plane)});
}

void AnswerTables::close() {
  trajectory_.close();
  times_.close();
  if (covariances_) covariances_->close();
  if (pose_times_) pose_times_->close();
  if (commands_) commands_->close();
  if (planes_) planes_->close();
}

}  // namespace hallway::record
