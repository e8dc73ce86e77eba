// SPDX-License-Identifier: MIT
#include "run/tracked_source.hpp"

#include <utility>

#include "base/error.hpp"

namespace hallway::run {

static_assert(log::kNoTrack == log::kNoLandmark, "what has no identity has no track");

TrackedSource::TrackedSource(std::unique_ptr<Source> source)
    : Source(source->facts()), source_(std::move(source)) {
  facts_.has_tracks = true;
  if (sensor().kind != HW_SAMPLE_POINTS)
    throw Error(ErrorCode::kUsage, "the log is not of points: there is nothing that has tracks");
  if (has_identities()) return;
  throw Error(ErrorCode::kUsage,
              "the log does not name the landmarks of its points: there are no ids to track by");
}

void TrackedSource::read(std::uint32_t iteration, SourceFrame& frame) {
  source_->read(iteration, frame);
  frame.is_tracked = true;
  for (log::Observation& seen : frame.observations) seen.track = seen.landmark;
}

}  // namespace hallway::run
