// SPDX-License-Identifier: MIT
#include "run/serving/served_path.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "eval/evaluator.hpp"
#include "eval/metrics_json.hpp"
#include "log/command_file.hpp"
#include "log/pose_times.hpp"
#include "log/row_file.hpp"
#include "log/tum.hpp"
#include "record/answer_tables.hpp"
#include "record/files.hpp"
#include "record/manifest.hpp"
#include "run/feed/drive_record.hpp"
#include "run/scoring/truth_of.hpp"
#include "run/sources/abi_pose.hpp"
#include "run/sources/true_pose.hpp"

namespace hallway::run {
namespace {

/// What is true of the path; there is no map to be scored.
eval::Truth path_truth(const Source& source) {
  eval::Truth truth = truth_of(source);
  truth.has_identities = false;
  truth.landmarks.reset();
  truth.planes.reset();
  return truth;
}

std::array<double, 7> numbers_of(const Pose& pose) {
  return {pose.q.x(), pose.q.y(), pose.q.z(), pose.q.w(), pose.t.x(), pose.t.y(), pose.t.z()};
}

}  // namespace

void ServedPath::add_frame(const SourceFrame& frame) {
  Frame added{.t_ns = frame.t_ns(),
              .first_end = ends_.size(),
              .has_truth = frame.T_world_body.has_value(),
              .orientation_known = frame.orientation_known};
  if (frame.T_world_body) added.T_world_body = numbers_of(*frame.T_world_body);
  for (const log::SampleTruth& truth : frame.sample_truths) {
    if (const std::optional<Pose> pose = true_pose_of(truth)) {
      ends_.push_back({frame.sample(truth.sample).t_end_ns, numbers_of(*pose)});
      ++added.n_ends;
    }
  }
  frames_.push_back(added);
}

void ServedPath::add_answer(const link::Answer& answer) {
  if (answer.status != HW_ANSWER_FAILED) ++answers_;
  if (answer.pose) ++poses_;
  if (!answer.pose && !answer.command) return;
  Frame frame = frames_[answer.sequence];
  if (answer.pose) {
    frame.has_pose = answer.pose->valid;
    frame.T_map_body = answer.pose->T_map_body;
    frame.pose_t_ns = answer.pose->t_ns;
  }
  if (answer.command) {
    frame.has_command = true;
    frame.command = {answer.command->linear_m_s, answer.command->angular_rad_s, answer.command->lateral_m_s};
  }
  frames_.set(answer.sequence, frame);
}

/// Where the body truly was at the time of the answered pose; empty where that is not known.
std::optional<Pose> ServedPath::true_pose(const Frame& frame) const {
  const auto pose_from = [](const TruePose& numbers) {
    return Pose{Quat(numbers.data()), Vec3(numbers.data() + 4)};
  };
  if (!frame.has_pose || frame.pose_t_ns == 0 || frame.pose_t_ns == frame.t_ns) {
    if (!frame.has_truth) return std::nullopt;
    return pose_from(frame.T_world_body);
  }
  for (std::uint64_t i = frame.first_end; i < frame.first_end + frame.n_ends; ++i) {
    if (const SampleEnd end = ends_[i]; end.t_ns == frame.pose_t_ns) return pose_from(end.T_world_body);
  }
  return std::nullopt;
}

eval::Metrics ServedPath::write(const Source& source, const std::optional<sim::DriveCounts>& drive) const {
  eval::Truth truth = path_truth(source);
  truth.gives_poses = poses_ > 0 || answers_ == 0;
  eval::Evaluator evaluator(std::move(truth), folder_);
  log::RowFile trajectory(folder_ / record::files::kTrajectory, ' ', {});
  std::optional<log::CommandFile> commands;
  std::optional<log::RowFile> pose_times;
  SpillList<Frame>::Reader frames(frames_);
  std::uint32_t k = 0;
  for (const Frame* frame = frames.next(); frame != nullptr; frame = frames.next(), ++k) {
    eval::Iteration iteration{};
    iteration.T_world_body = true_pose(*frame);
    const bool is_other_time = frame->has_pose && frame->pose_t_ns != 0;
    iteration.t_s = static_cast<double>(is_other_time ? frame->pose_t_ns : frame->t_ns) * 1e-9;
    iteration.orientation_known = frame->orientation_known;
    if (frame->has_pose) {
      iteration.T_map_body = pose_of(frame->T_map_body);
      log::add_row(trajectory.next_row(), record::stamped_pose(frame->t_ns, frame->T_map_body));
    }
    if (is_other_time) {
      if (!pose_times) pose_times.emplace(folder_ / record::files::kPoseTimes, ',', log::kPoseTimeColumns);
      log::add_row(pose_times->next_row(), log::IterationPoseTime{.iteration = k, .t_ns = frame->pose_t_ns});
    }
    evaluator.add(iteration);
    if (!frame->has_command) continue;
    if (!commands) commands.emplace(folder_ / record::files::kCommands);
    commands->add({k, frame->command[0], frame->command[1], frame->command[2]});
  }
  trajectory.close();
  if (commands) commands->close();
  if (pose_times) pose_times->close();
  eval::Metrics metrics = evaluator.metrics({}, std::nullopt);
  nlohmann::ordered_json document = eval::to_json(metrics);
  if (drive) document["drive"] = to_json(*drive);
  record::write_json(folder_ / record::files::kMetrics, document);
  return metrics;
}

}  // namespace hallway::run
