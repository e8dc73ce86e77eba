// SPDX-License-Identifier: MIT
#include "run/sources/tracked_source.hpp"

#include <utility>

#include "base/error.hpp"
#include "log/observations.hpp"

namespace hallway::run {

static_assert(log::kNoTrack == log::kNoLandmark, "what has no identity has no track");

TrackedSource::TrackedSource(std::unique_ptr<Source> source)
    : Source(source->facts()), source_(std::move(source)) {
  facts_.has_tracks = true;
  if (!gives(HW_SAMPLE_POINTS))
    throw Error(ErrorCode::kUsage, "the log is not of points: there is nothing that has tracks");
  if (has_identities()) return;
  throw Error(ErrorCode::kUsage,
              "the log does not name the landmarks of its points: there are no ids to track by");
}

void TrackedSource::fill(std::uint32_t iteration, SourceFrame& frame) {
  source_->read(iteration, untracked_);
  host::FrameBuilder& builder = frame.begin(iteration, untracked_.t_ns());
  for (std::uint32_t k = 0; k < untracked_.n_samples(); ++k) {
    hw_sample_t sample = untracked_.sample(k);
    if (sample.kind != HW_SAMPLE_POINTS) {
      builder.add(sample);
      continue;
    }
    hw_points_t points = *static_cast<const hw_points_t*>(sample.payload);
    const auto tracks = untracked_.identities_of(k);
    if (!tracks.empty()) {
      points.track = tracks.data();
      sample.flags |= HW_SAMPLE_TRACKED;
    }
    sample.payload = &points;
    builder.add(sample);
  }
  frame.identities = untracked_.identities;
  frame.T_world_body = untracked_.T_world_body;
  frame.orientation_known = untracked_.orientation_known;
}

}  // namespace hallway::run
