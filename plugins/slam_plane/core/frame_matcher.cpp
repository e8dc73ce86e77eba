// SPDX-License-Identifier: MIT
#include "slam_plane/core/frame_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/median.hpp"

namespace hallway::slam_plane {
namespace {

constexpr double kLeastOverlap = 0.5;  // of the shorter one
constexpr double kWideAngle_rad =
    0.35;  // between an observation and what it may be, before the heading is corrected
constexpr double kWideBound_m = 0.5;
constexpr double kQueryStep_m = 1.5;  // less than twice the reach of the index
constexpr double kRivalOverlap = 0.3;
constexpr std::uint64_t kTrailFrames = 3;  // for which a wall may be where it was seen last
constexpr double kTrailShare = 0.8;        // of the bound, that it may have gone since

/// How a segment of the map's frame lies beside a wall.
struct Overlap {
  Overlap(const WallEstimate& wall, const Vec2& a, const Vec2& b) {
    const double from = wall.basis.along(a);
    const double to = wall.basis.along(b);
    length = std::max(to - from, 1e-9);
    const double begin = std::max(from, wall.reach[kEndA]);
    const double end = std::min(to, wall.reach[kEndB]);
    shared = end - begin;
    const double share = std::clamp((0.5 * (begin + end) - from) / length, 0.0, 1.0);
    middle = a + share * (b - a);
  }

  double length;  // of the segment along the wall [m]
  double shared;  // of that, where the wall was seen; below 0: the distance between the two
  Vec2 middle;    // of the segment, where both are
};

}  // namespace

FrameMatcher::FrameMatcher(const Options& options)
    : near_bound_(options.match_bound_m),
      map_bound_(options.map_bound_m),
      angle_(radians(options.match_angle_deg)),
      sine_(std::sin(angle_)) {}

double FrameMatcher::score(const WallEstimate& wall, const Vec2& a, const Vec2& b, const Vec2& direction,
                           double bound) const {
  const WallBasis& basis = wall.basis;
  if (basis.differs(direction, sine_)) return 0.0;
  const Overlap overlap(wall, a, b);
  const double shorter = std::min(overlap.length, wall.reach[kEndB] - wall.reach[kEndA]);
  if (overlap.shared <= kLeastOverlap * shorter || overlap.shared <= 0.0) return 0.0;
  const double offset = std::abs(basis.across(overlap.middle));
  if (offset >= bound) return 0.0;
  return std::min(1.0, overlap.shared / overlap.length) +
         std::min(1.0, overlap.shared / std::max(shorter, 1e-9)) + (1.0 - offset / bound);
}

void FrameMatcher::correct_heading(const WallMap& map, const std::vector<Index>& recent,
                                   const std::vector<AssociatedObservation>& frame, Pose2& T) {
  turns_.clear();
  for (const AssociatedObservation& observation : frame) {
    const Vec2 end[2] = {T * observation.end[kEndA], T * observation.end[kEndB]};
    const Vec2 direction = T.rotate(observation.direction);
    double nearest = kWideBound_m;
    double turn = 0.0;
    for (const Index w : recent) {
      const WallEstimate& wall = map.walls[w].estimate;
      const double cosine = wall.basis.direction.dot(direction);
      if (cosine < 0.9) continue;
      const Overlap overlap(wall, end[kEndA], end[kEndB]);
      const double distance = std::hypot(wall.basis.across(overlap.middle), std::min(0.0, overlap.shared));
      if (distance >= nearest) continue;
      const double angle = std::atan2(cross(direction, wall.basis.direction), cosine);
      if (std::abs(angle) > kWideAngle_rad) continue;
      nearest = distance;
      turn = angle;
    }
    if (nearest < kWideBound_m) turns_.push_back(turn);
  }
  if (turns_.empty()) return;
  T = T.moved(Vec2::Zero(), median(turns_));
}

void FrameMatcher::match_recent(const WallMap& map, const std::vector<Index>& recent, std::uint64_t iteration,
                                const Pose2& T, std::vector<AssociatedObservation>& frame) {
  scores_.assign(frame.size(), 0.0);
  displaced_.clear();
  for (const Index w : recent) {
    const WallRecord& wall = map.walls[w];
    if (wall.trail_is_off && !wall.is_dynamic && wall.trail_seen + kTrailFrames >= iteration)
      displaced_.push_back(w);
  }
  for (std::size_t i = 0; i < frame.size(); ++i) {
    AssociatedObservation& observation = frame[i];
    const Vec2 a = T * observation.end[kEndA];
    const Vec2 b = T * observation.end[kEndB];
    const Vec2 direction = T.rotate(observation.direction);
    for (const Index w : recent) {
      const WallRecord& wall = map.walls[w];
      const double fit = score(wall.estimate, a, b, direction, near_bound_);
      if (fit <= scores_[i]) continue;
      scores_[i] = fit;
      observation.wall = w;
      observation.outlier = wall.is_dynamic;
    }
    for (const Index w : displaced_) {
      const WallRecord& wall = map.walls[w];
      if (score(wall.estimate, a, b, direction, near_bound_) > 0.0) continue;
      const double trail_score = score(wall.trail, a, b, direction, kTrailShare * near_bound_);
      if (trail_score <= scores_[i]) continue;
      scores_[i] = trail_score;
      observation.wall = w;
      observation.outlier = true;
    }
  }
  resolve_rivals(map, T, frame);
}

bool FrameMatcher::contradicts(const WallEstimate& wall, const AssociatedObservation& observation,
                               const Vec2 (&end)[2]) const {
  for (int k = 0; k < 2; ++k) {
    if (!wall.known[k]) continue;
    const double beyond = outward(k) * (wall.basis.along(end[k]) - wall.end[k]);
    if (beyond > 2.0 * map_bound_ || (observation.corner[k] && beyond < -2.0 * map_bound_)) return true;
  }
  return false;
}

void FrameMatcher::match_map(const WallMap& map, std::uint32_t since, const Pose2& T,
                             std::vector<AssociatedObservation>& frame) {
  for (std::size_t i = 0; i < frame.size(); ++i) {
    AssociatedObservation& observation = frame[i];
    if (observation.wall != kNone) continue;
    const Vec2 end[2] = {T * observation.end[kEndA], T * observation.end[kEndB]};
    const Vec2 direction = T.rotate(observation.direction);
    scores_[i] = 0.0;
    const int steps = 1 + static_cast<int>(observation.length / kQueryStep_m);
    for (int step = 0; step <= steps; ++step) {
      map.visit_near(end[0] + (end[1] - end[0]) * (static_cast<double>(step) / steps), [&](Index w) {
        const WallRecord& wall = map.walls[w];
        if (wall.epoch < since) return;
        const double fit = score(wall.estimate, end[0], end[1], direction, map_bound_);
        if (fit == 0.0 || fit < scores_[i] || (fit == scores_[i] && w >= observation.wall)) return;
        if (contradicts(wall.estimate, observation, end)) return;
        scores_[i] = fit;
        observation.wall = w;
        observation.outlier = wall.is_dynamic;
      });
    }
  }
  resolve_rivals(map, T, frame);
}

/// Two observations may be parts of one wall, but not the same part.
void FrameMatcher::resolve_rivals(const WallMap& map, const Pose2& T,
                                  std::vector<AssociatedObservation>& frame) {
  for (std::size_t i = 0; i < frame.size(); ++i) {
    for (std::size_t k = i + 1; k < frame.size() && frame[i].wall != kNone; ++k) {
      if (frame[k].wall != frame[i].wall) continue;
      const WallBasis& basis = map.walls[frame[i].wall].estimate.basis;
      const auto [a, b] = std::pair(basis.along(T * frame[i].end[0]), basis.along(T * frame[i].end[1]));
      const auto [c, d] = std::pair(basis.along(T * frame[k].end[0]), basis.along(T * frame[k].end[1]));
      if (std::min(b, d) - std::max(a, c) < kRivalOverlap * std::min(b - a, d - c)) continue;
      AssociatedObservation& loser = frame[scores_[i] >= scores_[k] ? k : i];
      loser.wall = kNone;
      loser.outlier = false;
    }
  }
}

}  // namespace hallway::slam_plane
