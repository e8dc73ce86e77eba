// SPDX-License-Identifier: MIT
#include "run/serving/served_path.hpp"

#include <nlohmann/json.hpp>

#include "eval/evaluator.hpp"
#include "eval/metrics_json.hpp"
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
  frames_.push_back({frame.t_ns(), frame.T_world_body, frame.orientation_known});
}

void ServedPath::add_answer(const link::Answer& answer) {
  if (!answer.pose) return;
  if (answer.pose->valid) {
    poses_[answer.sequence] = answer.pose->T_map_body;
  } else {
    poses_.erase(answer.sequence);
  }
}

eval::Metrics ServedPath::write(const std::filesystem::path& folder, const Source& source,
                                const std::optional<sim::DriveCounts>& drive) const {
  eval::Evaluator evaluator(path_truth(source));
  std::vector<log::StampedPose> trajectory;
  for (std::size_t k = 0; k < frames_.size(); ++k) {
    const Frame& frame = frames_[k];
    eval::Iteration iteration{};
    iteration.T_world_body = frame.T_world_body;
    iteration.t_s = static_cast<double>(frame.t_ns) * 1e-9;
    iteration.orientation_known = frame.orientation_known;
    if (const auto pose = poses_.find(k); pose != poses_.end()) {
      iteration.T_map_body = pose_of(pose->second);
      trajectory.push_back(record::stamped_pose(frame.t_ns, pose->second));
    }
    evaluator.add(iteration);
  }
  log::write_tum(folder / record::files::kTrajectory, trajectory);
  eval::Metrics metrics = evaluator.metrics({}, std::nullopt);
  nlohmann::ordered_json document = eval::to_json(metrics);
  if (drive) document["drive"] = to_json(*drive);
  record::write_json(folder / record::files::kMetrics, document);
  return metrics;
}

}  // namespace hallway::run
