// SPDX-License-Identifier: MIT
#include "run/log_source.hpp"

#include <algorithm>
#include <utility>

namespace hallway::run {

LogSource::LogSource(log::ObservationLog observations, LogTruth truth, host::SensorInfo sensor,
                     std::int64_t period_ns, std::uint32_t steps)
    : observations_(std::move(observations)),
      truth_(std::move(truth)),
      sensor_(std::move(sensor)),
      period_ns_(period_ns),
      iterations_(observations_.iterations()) {
  // A robot may have seen nothing at the end: the frames of its poses were there all the same.
  if (truth_.poses && !truth_.poses->empty()) {
    iterations_ = std::max(iterations_, truth_.poses->back().iteration + 1);
  }
  if (steps > 0) iterations_ = std::min(iterations_, steps);
}

void LogSource::read(std::uint32_t iteration, SourceFrame& frame) {
  frame.t_ns = period_ns_ * static_cast<std::int64_t>(iteration);
  const auto seen = observations_.frame(iteration);
  frame.observations.assign(seen.begin(), seen.end());
  frame.is_tracked = observations_.has_tracks();
  frame.T_world_body.reset();
  if (!truth_.poses) return;
  const auto pose =
      std::lower_bound(truth_.poses->begin(), truth_.poses->end(), iteration,
                       [](const log::IterationPose& a, std::uint32_t b) { return a.iteration < b; });
  if (pose == truth_.poses->end() || pose->iteration != iteration) return;
  const auto& q = pose->orientation;
  const auto& t = pose->position_m;
  frame.orientation_known = pose->orientation_known;
  // As it was read: normalised again it might differ in its last bit, and be written as another pose.
  frame.T_world_body = Pose{Quat(q[0], q[1], q[2], q[3]), Vec3(t[0], t[1], t[2])};
}

}  // namespace hallway::run
