// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "run/sources/source.hpp"

namespace hallway::run {

/// The frames of another source as sensors would give them that never err in following what they see, in samples of every kind that has tracks
/// (host::SampleKind::track): a point's track is its true landmark. For comparisons with algorithms that do not find out by themselves which point is
/// which.
class TrackedSource : public Source {
 public:
  /// Throws Error{kUsage} where the observations do not name their landmarks, or no sensor gives a kind that has tracks.
  explicit TrackedSource(std::unique_ptr<Source> source);

  std::uint32_t iterations() const override { return source_->iterations(); }
  std::optional<eval::FloorPlan> floor_plan() const override { return source_->floor_plan(); }

 private:
  void fill(std::uint32_t iteration, SourceFrame& frame) override;

  std::unique_ptr<Source> source_;
  SourceFrame untracked_;
};

}  // namespace hallway::run
