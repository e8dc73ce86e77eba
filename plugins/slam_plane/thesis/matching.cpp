// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/matching.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <unordered_set>

namespace hallway::slam_plane::thesis {
namespace {

/// Extent of something along a line.
struct Extent {
  double low, high;
};

double shared_part(const Extent& a, const Extent& b, double slack) {
  const double shorter = std::min(a.high - a.low, b.high - b.low);
  return (std::min(a.high, b.high) - std::max(a.low, b.low) + slack) / std::max(shorter, 1e-9);
}

Extent own_extent(const Sighting& sighting) {
  return {sighting.direction.dot(sighting.segment.end[kEndA]),
          sighting.direction.dot(sighting.segment.end[kEndB])};
}

struct Candidate {
  double score;
  std::size_t sighting;
  std::size_t track;
};

/// All acceptable pairs of the sightings that are not taken with the tracks that are not, the best first.
std::vector<Candidate> candidates(std::span<const Sighting> seen, const std::vector<const Track*>& matched,
                                  const std::vector<const Track*>& tracks,
                                  const std::unordered_set<const Track*>& taken,
                                  const MatchOptions& options) {
  std::vector<Candidate> result;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (matched[i] != nullptr) continue;
    for (std::size_t t = 0; t < tracks.size(); ++t) {
      if (tracks[t]->empty() || taken.count(tracks[t]) != 0) continue;
      const auto score = match_score(tracked_terms(seen[i], tracks[t]->newest(), options), options);
      if (score) result.push_back({*score, i, t});
    }
  }
  std::sort(result.begin(), result.end(), [](const Candidate& a, const Candidate& b) {
    return std::make_tuple(-a.score, a.sighting, a.track) < std::make_tuple(-b.score, b.sighting, b.track);
  });
  return result;
}

}  // namespace

std::optional<double> match_score(const MatchTerms& terms, const MatchOptions& options) {
  const double angle_bound = options.angle_deg * std::numbers::pi / 180.0;
  if (terms.angle > angle_bound || terms.distance > options.distance_m || terms.overlap < options.overlap)
    return std::nullopt;
  if (terms.age < 1 || terms.age > options.recent_iterations) return std::nullopt;
  const double recency = 1.0 - static_cast<double>(terms.age - 1) / options.recent_iterations;
  return 25.0 * ((1.0 - terms.angle / angle_bound) + (1.0 - terms.distance / options.distance_m) +
                 std::min(1.0, terms.overlap) + recency);
}

MatchTerms tracked_terms(const Sighting& seen, const Sighting& before, const MatchOptions& options) {
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

std::vector<const Track*> match_tracks(std::span<const Sighting> seen, MatchStages stages,
                                       const MatchOptions& options) {
  std::vector<const Track*> matched(seen.size(), nullptr);
  std::unordered_set<const Track*> taken;  // never walked through
  for (const std::vector<const Track*>& tracks : stages) {
    for (const Candidate& candidate : candidates(seen, matched, tracks, taken, options)) {
      const Track* track = tracks[candidate.track];
      if (matched[candidate.sighting] != nullptr || !taken.insert(track).second) continue;
      matched[candidate.sighting] = track;
    }
  }
  return matched;
}

}  // namespace hallway::slam_plane::thesis
