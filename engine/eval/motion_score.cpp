// SPDX-License-Identifier: MIT
#include "eval/motion_score.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace hallway::eval {

using log::LandmarkId;
using log::LandmarkStatus;

MotionScore::MotionScore(std::span<const log::Landmark> landmarks, double limit_m) : limit_m_(limit_m) {
  for (const log::Landmark& landmark : landmarks) {
    if (landmark.moving) tracks_.emplace(landmark.id, Track());
  }
}

void MotionScore::add(const Pose& T_world_body, std::span<const LandmarkId> identities,
                      std::span<const Vec3> points) {
  if (identities.size() != points.size())
    throw Error(ErrorCode::kInternal, "a frame has not as many points as identities");
  if (tracks_.empty()) return;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto track = tracks_.find(identities[i]);
    if (track != tracks_.end()) track->second.add(T_world_body * points[i]);
  }
}

void MotionScore::Track::add(const Vec3& place) {
  last[frames % kMean] = place;
  ++frames;
  if (frames < kMean) return;
  Vec3 mean = Vec3::Zero();
  for (const Vec3& seen : last) mean += seen / static_cast<double>(kMean);
  if (frames == kMean) first = mean;
  farthest_m = std::max(farthest_m, (mean - first).norm());
}

bool MotionScore::has_moved(LandmarkId landmark) const {
  const auto track = tracks_.find(landmark);
  return track != tracks_.end() && track->second.frames >= kLeastFrames &&
         track->second.farthest_m >= limit_m_;
}

MovingMetrics MotionScore::metrics(std::span<const log::MapLandmark> map,
                                   const AssociationScore::Votes& votes) const {
  std::unordered_map<LandmarkId, LandmarkStatus> status;
  for (const log::MapLandmark& landmark : map) status.emplace(landmark.id, landmark.status);
  struct Given {
    std::uint64_t to_dynamic = 0;
    std::uint64_t to_mapped = 0;
  };
  std::map<LandmarkId, Given> given;  // by true landmark
  for (const auto& [pair, count] : votes) {
    const auto found = status.find(pair.map);
    if (found == status.end() || pair.truth == log::kNoLandmark) continue;
    if (found->second == LandmarkStatus::kDynamic) given[pair.truth].to_dynamic += count;
    if (found->second == LandmarkStatus::kMapped) given[pair.truth].to_mapped += count;
  }
  MovingMetrics metrics;
  for (const auto& [landmark, track] : tracks_) metrics.moved += has_moved(landmark) ? 1u : 0u;
  for (const auto& [landmark, count] : given) {
    if (count.to_dynamic <= count.to_mapped) continue;
    ++metrics.marked;
    if (moves(landmark)) ++metrics.marked_moving;
    if (has_moved(landmark)) ++metrics.moved_marked;
  }
  return metrics;
}

}  // namespace hallway::eval
