// SPDX-License-Identifier: MIT
#include "run/serving/served_path.hpp"

#include <nlohmann/json.hpp>
#include <optional>

#include "eval/evaluator.hpp"
#include "eval/metrics_json.hpp"
#include "log/command_file.hpp"
#include "log/row_file.hpp"
#include "log/tum.hpp"
#include "record/answer_tables.hpp"
#include "record/files.hpp"
#include "record/manifest.hpp"
#include "run/feed/drive_record.hpp"
#include "run/scoring/truth_of.hpp"
#include "run/sources/abi_pose.hpp"

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

}  // namespace

void ServedPath::add_frame(const SourceFrame& frame) {
  Frame added{.t_ns = frame.t_ns(),
              .has_truth = frame.T_world_body.has_value(),
              .orientation_known = frame.orientation_known};
  if (frame.T_world_body) {
    const Quat& q = frame.T_world_body->q;
    const Vec3& t = frame.T_world_body->t;
    added.T_world_body = {q.x(), q.y(), q.z(), q.w(), t.x(), t.y(), t.z()};
  }
  frames_.push_back(added);
}

void ServedPath::add_answer(const link::Answer& answer) {
  if (!answer.pose && !answer.command) return;
  Frame frame = frames_[answer.sequence];
  if (answer.pose) {
    frame.has_pose = answer.pose->valid;
    frame.T_map_body = answer.pose->T_map_body;
  }
  if (answer.command) {
    frame.has_command = true;
    frame.command = {answer.command->linear_m_s, answer.command->angular_rad_s, answer.command->lateral_m_s};
  }
  frames_.set(answer.sequence, frame);
}

eval::Metrics ServedPath::write(const Source& source, const std::optional<sim::DriveCounts>& drive) const {
  eval::Evaluator evaluator(path_truth(source), folder_);
  log::RowFile trajectory(folder_ / record::files::kTrajectory, ' ', {});
  std::optional<log::CommandFile> commands;
  SpillList<Frame>::Reader frames(frames_);
  std::uint32_t k = 0;
  for (const Frame* frame = frames.next(); frame != nullptr; frame = frames.next(), ++k) {
    eval::Iteration iteration{};
    if (frame->has_truth)
      iteration.T_world_body = Pose{Quat(frame->T_world_body.data()), Vec3(frame->T_world_body.data() + 4)};
    iteration.t_s = static_cast<double>(frame->t_ns) * 1e-9;
    iteration.orientation_known = frame->orientation_known;
    if (frame->has_pose) {
      iteration.T_map_body = pose_of(frame->T_map_body);
      log::add_row(trajectory.next_row(), record::stamped_pose(frame->t_ns, frame->T_map_body));
    }
    evaluator.add(iteration);
    if (!frame->has_command) continue;
    if (!commands) commands.emplace(folder_ / record::files::kCommands);
    commands->add({k, frame->command[0], frame->command[1], frame->command[2]});
  }
  trajectory.close();
  if (commands) commands->close();
  eval::Metrics metrics = evaluator.metrics({}, std::nullopt);
  nlohmann::ordered_json document = eval::to_json(metrics);
  if (drive) document["drive"] = to_json(*drive);
  record::write_json(folder_ / record::files::kMetrics, document);
  return metrics;
}

}  // namespace hallway::run
