// SPDX-License-Identifier: MIT
#include "run/sources/tracked_source.hpp"

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "host/samples/sample_kind.hpp"
#include "log/observations.hpp"

namespace hallway::run {

namespace {

/// Whether a sensor can follow elements of a kind.
bool has_track(std::uint32_t kind) {
  const host::SampleKind* known = host::find_sample_kind(kind);
  return known != nullptr && known->track != host::kNoMember;
}

}  // namespace

static_assert(log::kNoTrack == log::kNoLandmark, "what has no identity has no track");

TrackedSource::TrackedSource(std::unique_ptr<Source> source)
    : Source(source->facts()), source_(std::move(source)) {
  facts_.has_tracks = true;
  if (std::ranges::none_of(sensors(), has_track, &host::SensorInfo::kind))
    throw Error(ErrorCode::kUsage, "the log is not of points: there is nothing that has tracks");
  if (has_identities()) return;
  throw Error(ErrorCode::kUsage,
              "the log does not name the landmarks of its points: there are no ids to track by");
}

void TrackedSource::fill(std::uint32_t iteration, SourceFrame& frame) {
  source_->read(iteration, untracked_);
  host::FrameBuilder& builder = frame.begin(iteration, untracked_.t_ns());
  for (std::uint32_t k = 0; k < untracked_.n_samples(); ++k) {
    const hw_sample_t& sample = untracked_.sample(k);
    builder.add(sample);
    if (!has_track(sample.kind)) continue;
    const auto tracks = untracked_.identities_of(k);
    builder.add_tracks().assign(tracks.begin(), tracks.end());
  }
  frame.identities = untracked_.identities;
  frame.T_world_body = untracked_.T_world_body;
  frame.orientation_known = untracked_.orientation_known;
}

}  // namespace hallway::run
