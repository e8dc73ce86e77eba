// SPDX-License-Identifier: MIT
#include "run/scoring/iteration_maker.hpp"

#include <algorithm>

#include "record/answer_tables.hpp"
#include "run/sources/abi_pose.hpp"
#include "run/sources/true_pose.hpp"

namespace hallway::run {

namespace {

/// Where the body truly was when a sample ended at that time; empty where none did or that is not known.
std::optional<Pose> truth_at(const SourceFrame& frame, std::int64_t t_ns) {
  for (std::uint32_t k = 0; k < frame.n_samples(); ++k) {
    if (frame.sample(k).t_end_ns != t_ns) continue;
    const auto truth = std::ranges::find(frame.sample_truths, k, &log::SampleTruth::sample);
    if (truth == frame.sample_truths.end()) continue;
    if (const std::optional<Pose> pose = true_pose_of(*truth)) return pose;
  }
  return std::nullopt;
}

}  // namespace

IterationMaker::IterationMaker(const Source& source)
    : sensor_poses_(source.sensors()),
      kind_(source.gives(HW_SAMPLE_POINTS) || !source.gives(HW_SAMPLE_PLANES) ? HW_SAMPLE_POINTS
                                                                              : HW_SAMPLE_PLANES) {}

void IterationMaker::add_sample(const SourceFrame& frame, std::uint32_t k, const host::Outputs* outputs) {
  const hw_sample_t& sample = frame.sample(k);
  if (sample.kind != kind_) return;
  const auto identities = frame.identities_of(k);
  identities_.insert(identities_.end(), identities.begin(), identities.end());
  const auto given = outputs != nullptr ? outputs->associations(k) : std::nullopt;
  if (given) {
    associations_.insert(associations_.end(), given->begin(), given->end());
  } else {
    associations_.resize(associations_.size() + frame.elements_of(k), log::kNoLandmark);
  }
  if (kind_ != HW_SAMPLE_POINTS) return;
  const Pose& T_body_sensor = sensor_poses_.of(sample.sensor_id);
  const auto& points = *static_cast<const hw_points_t*>(sample.payload);
  for (std::uint64_t i = 0; i < points.count; ++i) {
    const hw_point3_t& point = *hw_point_at(&points, i);
    points_.push_back(T_body_sensor * Vec3(point.x, point.y, point.z));
  }
}

eval::Iteration IterationMaker::make(const FrameAnswer& answer) {
  const SourceFrame& frame = answer.frame;
  identities_.clear();
  associations_.clear();
  points_.clear();
  for (std::uint32_t k = 0; k < frame.n_samples(); ++k) add_sample(frame, k, answer.outputs);
  eval::Iteration iteration{.T_world_body = frame.T_world_body,
                            .orientation_known = frame.orientation_known,
                            .t_s = static_cast<double>(frame.t_ns()) * 1e-9,
                            .associations = associations_,
                            .identities = identities_,
                            .points = points_};
  if (answer.outputs == nullptr) return iteration;
  if (const auto& pose = answer.outputs->pose(); pose && pose->valid) {
    iteration.T_map_body = pose_of(pose->T_map_body);
    if (pose->t_ns != 0 && pose->t_ns != frame.t_ns()) {
      iteration.T_world_body = truth_at(frame, pose->t_ns);
      iteration.t_s = static_cast<double>(pose->t_ns) * 1e-9;
    }
  }
  iteration.wall_ms = record::milliseconds(answer.time.wall_ns);
  iteration.cpu_ms = record::milliseconds(answer.time.cpu_ns);
  return iteration;
}

}  // namespace hallway::run
