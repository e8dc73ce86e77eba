// SPDX-License-Identifier: MIT
#include "run/sources/log_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "geom/arrays.hpp"
#include "host/samples/plane_kind.hpp"
#include "host/samples/plane_lists.hpp"
#include "host/samples/point_kind.hpp"
#include "host/samples/strided.hpp"
#include "record/plane_observations.hpp"

namespace hallway::run {

LogSource::LogSource(std::uint32_t kind, bool has_identities, LogTruth truth, const host::SensorInfo& sensor,
                     std::int64_t period_ns)
    : Source({.sensors = {sensor},
              .has_identities = has_identities,
              .true_landmarks = std::move(truth.landmarks),
              .true_planes = std::move(truth.planes)}),
      true_poses_(std::move(truth.poses)),
      period_ns_(period_ns) {
  facts_.sensors.front().kind = kind;
}

LogSource::LogSource(log::ObservationLog observations, LogTruth truth, const host::SensorInfo& sensor,
                     std::int64_t period_ns, std::uint32_t steps)
    : LogSource(HW_SAMPLE_POINTS, observations.has_identities(), std::move(truth), sensor, period_ns) {
  facts_.has_tracks = observations.has_tracks();
  observations_ = std::move(observations);
  count_iterations(observations_.iterations(), steps);
}

LogSource::LogSource(log::PlaneObservationLog planes, LogTruth truth, const host::SensorInfo& sensor,
                     std::int64_t period_ns, std::uint32_t steps)
    : LogSource(HW_SAMPLE_PLANES, planes.has_identities(), std::move(truth), sensor, period_ns) {
  planes_ = std::move(planes);
  count_iterations(planes_.iterations(), steps);
  check_planes();
}

void LogSource::count_iterations(std::uint32_t seen, std::uint32_t steps) {
  iterations_ = seen;
  // A robot may have seen nothing at the end: the frames of its poses were there all the same.
  if (true_poses_ && !true_poses_->empty()) {
    iterations_ = std::max(iterations_, true_poses_->back().iteration + 1);
  }
  if (steps > 0) iterations_ = std::min(iterations_, steps);
}

void LogSource::check_planes() {
  host::PlaneLists lists;
  SourceFrame frame;
  for (const std::uint32_t iteration : planes_.filled_iterations()) {
    if (iteration >= iterations_) return;
    read(iteration, frame);
    lists.clear();
    try {
      lists.add(*static_cast<const hw_planes_t*>(frame.sample(0).payload), 0, 0);
    } catch (const host::Malformed& malformed) {
      throw Error(ErrorCode::kBadInput, malformed.text, {.element = fmt::format("iteration {}", iteration)});
    }
  }
}

void LogSource::add_points(host::FrameBuilder& builder, std::uint32_t iteration, SourceFrame& frame) const {
  std::vector<hw_point3_t>& points = host::add_points(builder, facts_.sensors.front().id);
  const auto seen = observations_.frame(iteration);
  for (const log::Observation& one : seen) {
    points.push_back({one.point[0], one.point[1], one.point[2]});
    if (has_identities()) frame.identities.push_back(one.landmark);
  }
  if (!observations_.has_tracks()) return;
  std::vector<std::uint64_t>& tracks = builder.add_tracks();
  for (const log::Observation& one : seen) tracks.push_back(one.track);
}

void LogSource::add_planes(host::FrameBuilder& builder, std::uint32_t iteration, SourceFrame& frame) const {
  const host::PlaneReading reading = host::add_planes(builder, facts_.sensors.front().id);
  for (const log::PlaneObservation& one : planes_.frame(iteration)) {
    record::add_plane(reading, one);
    if (has_identities()) frame.identities.push_back(one.true_plane);
  }
}

void LogSource::fill(std::uint32_t iteration, SourceFrame& frame) {
  host::FrameBuilder& builder = frame.begin(iteration, period_ns_ * static_cast<std::int64_t>(iteration));
  if (gives(HW_SAMPLE_PLANES)) {
    add_planes(builder, iteration, frame);
  } else {
    add_points(builder, iteration, frame);
  }
  if (!true_poses_) return;
  const auto pose =
      std::lower_bound(true_poses_->begin(), true_poses_->end(), iteration,
                       [](const log::IterationPose& a, std::uint32_t b) { return a.iteration < b; });
  if (pose == true_poses_->end() || pose->iteration != iteration) return;
  frame.orientation_known = pose->orientation_known;
  frame.T_world_body = to_pose(pose->position_m, pose->orientation);
}

}  // namespace hallway::run
