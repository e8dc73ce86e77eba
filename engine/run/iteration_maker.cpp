// SPDX-License-Identifier: MIT
#include "run/iteration_maker.hpp"

#include "geom/arrays.hpp"
#include "record/answer_tables.hpp"
#include "run/abi_pose.hpp"

namespace hallway::run {

IterationMaker::IterationMaker(const Source& source)
    : source_(source), T_body_sensor_(pose_of(source.sensor().T_body_sensor)) {}

eval::Iteration IterationMaker::make(const FrameAnswer& answer) {
  const SourceFrame& frame = answer.frame;
  identities_.clear();
  if (source_.has_identities()) frame.identities(identities_);
  points_.clear();
  for (const log::Observation& seen : frame.observations)
    points_.push_back(T_body_sensor_ * to_vec3(seen.point));
  none_.assign(frame.observations.size() + frame.planes.size(), log::kNoLandmark);
  eval::Iteration iteration{.T_world_body = frame.T_world_body,
                            .orientation_known = frame.orientation_known,
                            .t_s = static_cast<double>(frame.t_ns) * 1e-9,
                            .associations = none_,
                            .identities = identities_,
                            .points = points_};
  if (answer.outputs == nullptr) return iteration;
  if (const auto given = answer.outputs->associations(0)) iteration.associations = *given;
  if (const auto& pose = answer.outputs->pose(); pose && pose->valid)
    iteration.T_map_body = pose_of(pose->T_map_body);
  iteration.wall_ms = record::milliseconds(answer.time.wall_ns);
  iteration.cpu_ms = record::milliseconds(answer.time.cpu_ns);
  return iteration;
}

}  // namespace hallway::run
