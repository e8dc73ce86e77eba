// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/matching.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <unordered_set>

namespace hallway::slam_plane::thesis {
namespace {

constexpr double kStage = 10.0;  // of a score; what a track of a later stage has to be better by

/// Extent of something along a line.
struct Extent {
  double low, high;
};

double shared_part(const Extent& a, const Extent& b, double slack) {
  const double shorter = std::min(a.high - a.low, b.high - b.low);
  return (std::min(a.high, b.high) - std::max(a.low, b.low) + slack) / std::max(shorter, 1e-9);
}

/// Intersection by union; negative for extents that are apart.
double likeness(const Extent& a, const Extent& b) {
  return (std::min(a.high, b.high) - std::max(a.low, b.low)) /
         (std::max(a.high, b.high) - std::min(a.low, b.low));
}

Extent own_extent(const TimedObservation& observation) {
  return {observation.direction.dot(observation.segment.end[kEndA]),
          observation.direction.dot(observation.segment.end[kEndB])};
}

struct Candidate {
  double score;
  double likeness;  // of the extents: decides between equal scores
  std::size_t observation;
  std::size_t order;  // of the track
  const PlaneTrack* track;
};

/// All acceptable pairs of observations and tracks, the best first.
std::vector<Candidate> candidates(std::span<const TimedObservation> seen, MatchStages stages,
                                  const MatchOptions& options) {
  std::vector<Candidate> result;
  std::unordered_set<const PlaneTrack*> given;  // never walked through
  std::size_t order = 0;
  for (std::size_t stage = 0; stage < stages.size(); ++stage) {
    for (const PlaneTrack* track : stages[stage]) {
      if (track->empty() || !given.insert(track).second) continue;
      ++order;
      for (std::size_t i = 0; i < seen.size(); ++i) {
        const MatchTerms terms = tracked_terms(seen[i], track->newest(), options);
        const auto score = match_score(terms, options);
        // One that was out of view is asked last: what was seen on and on is not to be given to it.
        const std::size_t asked = terms.age > 1 ? stages.size() - 1 : stage;
        if (!score) continue;
        const double like = likeness(own_extent(seen[i]), own_extent(track->newest()));
        result.push_back({*score - kStage * static_cast<double>(asked), like, i, order, track});
      }
    }
  }
  std::ranges::sort(result, [](const Candidate& a, const Candidate& b) {
    return std::make_tuple(-a.score, -a.likeness, a.observation, a.order) <
           std::make_tuple(-b.score, -b.likeness, b.observation, b.order);
  });
  return result;
}

}  // namespace

std::optional<double> match_score(const MatchTerms& terms, const MatchOptions& options) {
  const double angle_bound = radians(options.angle_deg);
  if (terms.angle > angle_bound || terms.distance > options.distance_m || terms.overlap < options.overlap)
    return std::nullopt;
  if (terms.age < 1 || terms.age > options.recent_iterations) return std::nullopt;
  const double recency = 1.0 - static_cast<double>(terms.age - 1) / options.recent_iterations;
  return 25.0 * ((1.0 - terms.angle / angle_bound) + (1.0 - terms.distance / options.distance_m) +
                 std::min(1.0, terms.overlap) + recency);
}

MatchTerms tracked_terms(const TimedObservation& seen, const TimedObservation& before,
                         const MatchOptions& options) {
  MatchTerms terms;
  terms.angle = std::abs(angle_between(seen.direction, before.direction));
  terms.distance = std::abs(cross(seen.direction, seen.segment.end[kEndA]) -
                            cross(before.direction, before.segment.end[kEndA]));
  terms.overlap = shared_part(own_extent(seen), own_extent(before), options.slack_m);
  terms.age = seen.iteration - before.iteration;
  return terms;
}

MatchTerms placed_terms(const Segment& seen, const Segment& wall, const MatchOptions& options) {
  const Vec2 along = wall.direction();
  const Vec2 a = seen.end[kEndA] - wall.end[kEndA];
  const Vec2 b = seen.end[kEndB] - wall.end[kEndA];
  MatchTerms terms;
  terms.angle = std::abs(angle_between(seen.direction(), along));
  terms.distance = std::abs(0.5 * (cross(along, a) + cross(along, b)));
  terms.overlap = shared_part({std::min(along.dot(a), along.dot(b)), std::max(along.dot(a), along.dot(b))},
                              {0.0, wall.length()}, options.slack_m);
  return terms;
}

std::vector<const PlaneTrack*> match_tracks(std::span<const TimedObservation> seen, MatchStages stages,
                                            const MatchOptions& options) {
  std::vector<const PlaneTrack*> matched(seen.size(), nullptr);
  std::unordered_set<const PlaneTrack*> taken;
  for (const Candidate& candidate : candidates(seen, stages, options)) {
    if (matched[candidate.observation] == nullptr && taken.insert(candidate.track).second)
      matched[candidate.observation] = candidate.track;
  }
  return matched;
}

}  // namespace hallway::slam_plane::thesis
