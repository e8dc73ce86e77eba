// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/bridge.hpp"

#include <algorithm>
#include <cmath>

#include "slam_plane/thesis/map_report.hpp"
#include "slam_plane/thesis/matching.hpp"

namespace hallway::slam_plane::thesis {
namespace {

constexpr double kAbout_m = 30.0;  // how far a robot sees and goes until all is done again

/// Tracks that need to remember no more than what they are matched by.
TrackOptions short_memory(const Options& options) {
  TrackOptions result = options.track();
  result.capacity = 2 * result.trend_window;
  return result;
}

}  // namespace

Bridge::Bridge(const Options& options, const State& before)
    : options_(options.match()),
      memory_(short_memory(options)),
      corner_bound_m_(options.max_deviation_m),
      now_(before.now),
      motion_(before.carried.motion),
      next_(before.tracks.size()),
      in_map_(options.map_match()) {
  for (const TrackId id : before.recent) {
    if (before.tracks[id].empty()) continue;
    Followed& next = followed_.emplace_back(Followed{PlaneTrack(id, memory_), {}, {}, wall_of(id, before)});
    next.track.push(before.tracks[id].newest());
    const PlaneLandmark* plane = before.map.find(id);
    if (plane == nullptr) continue;
    next.in_map = plane->reference;
    next.seen = before.locator.seen(before.tracks[id], before.now);
  }
  if (!motion_.has_pose()) return;
  for (TrackId id = 0; id < before.map.size(); ++id) {
    const PlaneLandmark* plane = before.map.find(id);
    if (plane == nullptr) continue;
    const Placement& place = plane->reference.place;
    if ((place.middle - motion_.pose().t).norm() < kAbout_m + 0.5 * place.size)
      about_.push_back({plane->reference, wall_of(id, before)});
  }
}

Bridge::Followed& Bridge::followed(const PlaneTrack& track) {
  return *std::ranges::lower_bound(followed_, track.id(), {},
                                   [](const Followed& one) { return one.track.id(); });
}

void Bridge::forget_unseen() {
  std::erase_if(followed_, [&](const Followed& one) {
    return one.track.newest().iteration + options_.recent_iterations < now_;
  });
}

/// What no plane that is followed is may be one of the map that was out of view; of that one nothing but its line is evidence.
void Bridge::begin_following(const TimedObservation& observation, std::span<const LandmarkId> taken) {
  Followed& next = followed_.emplace_back(Followed{PlaneTrack(next_++, memory_), {}, {}, kNoLandmark});
  next.track.push(observation);
  if (!motion_.has_pose()) return;
  const Segment segment = motion_.pose() * observation.segment;
  double best = 0.0;
  for (const Mapped& mapped : about_) {
    if (std::ranges::find(taken, mapped.wall) != taken.end()) continue;
    const auto score = match_score(placed_terms(segment, mapped.place.place.segment(), in_map_), in_map_);
    if (!score || *score <= best) continue;
    best = *score;
    next.in_map = mapped.place;
    next.wall = mapped.wall;
  }
}

/// An end that is not where it should be is one that the view cuts now, or something hides: it is no corner any more.
std::vector<PlanePair> Bridge::evidence_of(std::span<Followed* const> mapped) const {
  std::vector<PlanePair> lines;
  for (const Followed* one : mapped) {
    lines.emplace_back();
    lines.back().direction[0] = one->seen.place.direction;
    lines.back().direction[1] = one->in_map.place.direction;
  }
  std::vector<PlanePair> evidence;
  if (lines.empty() || !motion_.has_pose()) return evidence;
  const Pose2 expected{motion_.predicted().t, mean_rotation(lines)};
  for (Followed* one : mapped) {
    const Segment now = expected * one->seen.place.segment();
    const Segment corners = one->in_map.place.segment();
    for (int end = 0; end < 2; ++end) {
      const double off = one->in_map.place.direction.dot(now.end[end] - corners.end[end]);
      if (std::abs(off) > corner_bound_m_) one->seen.known[end] = false;
    }
    append_pairs(one->seen, one->in_map, evidence);
  }
  return evidence;
}

Bridge::Report Bridge::follow(std::span<const WallObservation> given) {
  ++now_;
  forget_unseen();
  Report reported;
  reported.associations.assign(given.size(), kNoLandmark);
  const auto [observations, given_at] = FrameObservations(given, now_);
  std::vector<std::vector<const PlaneTrack*>> stages(1);
  for (const Followed& one : followed_) stages[0].push_back(&one.track);
  const std::vector<const PlaneTrack*> matched = match_tracks(observations, stages, options_);
  std::vector<Followed*> mapped;
  std::vector<std::size_t> unmatched;
  reported.seen = !observations.empty();
  for (std::size_t i = 0; i < observations.size(); ++i) {
    if (matched[i] == nullptr) {
      unmatched.push_back(i);
      continue;
    }
    Followed& one = followed(*matched[i]);
    one.track.push(observations[i]);
    reported.associations[given_at[i]] = one.wall;
    if (!one.in_map.valid()) continue;
    one.seen.place = reference_of(observations[i]).place;
    mapped.push_back(&one);
  }
  const std::vector<PlanePair> evidence = evidence_of(mapped);
  if (motion_.has_pose()) reported.location = align(evidence, motion_.predicted());
  reported.location = motion_.completed(reported.location);
  for (const std::size_t i : unmatched) {
    begin_following(observations[i], reported.associations);
    reported.associations[given_at[i]] = followed_.back().wall;
  }
  return reported;
}

}  // namespace hallway::slam_plane::thesis
