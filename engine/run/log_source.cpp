// SPDX-License-Identifier: MIT
#include "run/log_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "geom/arrays.hpp"
#include "host/frame_builder.hpp"
#include "host/plane_lists.hpp"
#include "host/strided.hpp"
#include "run/log_recorder.hpp"

namespace hallway::run {

LogSource::LogSource(log::ObservationLog observations, LogTruth truth, host::SensorInfo sensor,
                     std::int64_t period_ns, std::uint32_t steps)
    : observations_(std::move(observations)),
      truth_(std::move(truth)),
      sensor_(std::move(sensor)),
      period_ns_(period_ns) {
  sensor_.kind = HW_SAMPLE_POINTS;
  count_iterations(observations_.iterations(), steps);
}

LogSource::LogSource(log::PlaneObservationLog planes, LogTruth truth, host::SensorInfo sensor,
                     std::int64_t period_ns, std::uint32_t steps)
    : planes_(std::move(planes)),
      truth_(std::move(truth)),
      sensor_(std::move(sensor)),
      period_ns_(period_ns) {
  sensor_.kind = HW_SAMPLE_PLANES;
  count_iterations(planes_.iterations(), steps);
  check_planes();
}

void LogSource::count_iterations(std::uint32_t seen, std::uint32_t steps) {
  iterations_ = seen;
  // A robot may have seen nothing at the end: the frames of its poses were there all the same.
  if (truth_.poses && !truth_.poses->empty()) {
    iterations_ = std::max(iterations_, truth_.poses->back().iteration + 1);
  }
  if (steps > 0) iterations_ = std::min(iterations_, steps);
}

void LogSource::check_planes() {
  host::FrameBuilder builder;
  host::PlaneLists lists;
  SourceFrame frame;
  for (const std::uint32_t iteration : planes_.filled_iterations()) {
    if (iteration >= iterations_) return;
    read(iteration, frame);
    const hw_frame_t& built = build_frame(builder, iteration, frame);
    lists.clear();
    try {
      lists.add(*static_cast<const hw_planes_t*>(built.samples[0]->payload), 0, 0);
    } catch (const host::Malformed& malformed) {
      throw Error(ErrorCode::kBadInput, malformed.text, {.element = fmt::format("iteration {}", iteration)});
    }
  }
}

void LogSource::read(std::uint32_t iteration, SourceFrame& frame) {
  frame.t_ns = period_ns_ * static_cast<std::int64_t>(iteration);
  frame.is_of_planes = is_of_planes();
  const auto seen = observations_.frame(iteration);
  frame.observations.assign(seen.begin(), seen.end());
  frame.is_tracked = observations_.has_tracks();
  const auto planes = planes_.frame(iteration);
  frame.planes.assign(planes.begin(), planes.end());
  frame.T_world_body.reset();
  if (!truth_.poses) return;
  const auto pose =
      std::lower_bound(truth_.poses->begin(), truth_.poses->end(), iteration,
                       [](const log::IterationPose& a, std::uint32_t b) { return a.iteration < b; });
  if (pose == truth_.poses->end() || pose->iteration != iteration) return;
  frame.orientation_known = pose->orientation_known;
  frame.T_world_body = to_pose(pose->position_m, pose->orientation);
}

}  // namespace hallway::run
