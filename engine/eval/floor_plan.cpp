// SPDX-License-Identifier: MIT
#include "eval/floor_plan.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "geometry/convex2.hpp"

namespace hallway::eval {
namespace {

/// From -pi to pi, left positive.
double turn(const PlanSegment& a, const PlanSegment& b) {
  const Vec2 u = a.to - a.from, v = b.to - b.from;
  return std::atan2(cross(u, v), u.dot(v));
}

/// For each segment the one that goes on at its end, or PlanWall::kNone.
std::vector<std::size_t> find_next(const std::vector<PlanSegment>& segments) {
  std::map<std::pair<double, double>, std::vector<std::size_t>> by_start;
  for (std::size_t i = 0; i < segments.size(); ++i)
    by_start[{segments[i].from.x(), segments[i].from.y()}].push_back(i);
  std::vector<std::size_t> next(segments.size(), PlanWall::kNone);
  std::vector<bool> is_taken(segments.size(), false);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const auto found = by_start.find({segments[i].to.x(), segments[i].to.y()});
    if (found == by_start.end()) continue;
    // Free space is on the left: where boundaries touch, that round the same space turns left the most.
    for (const std::size_t other : found->second) {
      if (is_taken[other]) continue;
      if (next[i] == PlanWall::kNone ||
          turn(segments[i], segments[other]) > turn(segments[i], segments[next[i]]))
        next[i] = other;
    }
    if (next[i] != PlanWall::kNone) is_taken[next[i]] = true;
  }
  return next;
}

/// Whether a wall begins with each segment.
std::vector<bool> find_starts(const std::vector<PlanSegment>& segments,
                              const std::vector<std::size_t>& next) {
  std::vector<bool> is_start(segments.size(), true);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (next[i] != PlanWall::kNone)
      is_start[next[i]] = std::abs(turn(segments[i], segments[next[i]])) >= FloorPlan::kCorner_rad;
  }
  return is_start;
}

/// Whether a turn may be a part of a bend.
bool is_bending(double turn_rad) {
  return turn_rad < -0.01 && turn_rad > -1.3;
}

double length_of(const PlanSegment& segment) {
  return (segment.to - segment.from).norm();
}

/// Makes each bend one corner, at its begin.
/// @return by segment that a wall begins with: how many of its first segments are the bend
std::vector<std::size_t> join_bends(const std::vector<PlanSegment>& segments,
                                    const std::vector<std::size_t>& next, std::vector<bool>& is_start) {
  std::vector<double> turn_after(segments.size(), 0.0);
  std::vector<bool> is_within(segments.size(), false);  // it may be between two turns of a bend
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (next[i] == PlanWall::kNone) continue;
    turn_after[i] = turn(segments[i], segments[next[i]]);
    is_within[next[i]] = is_bending(turn_after[i]) && length_of(segments[next[i]]) <= FloorPlan::kBend_m;
  }
  std::vector<std::size_t> bends(segments.size(), 0);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (is_within[i] || !is_bending(turn_after[i])) continue;
    std::vector<std::size_t> bend;
    double turned = turn_after[i], length_m = 0.0;
    for (std::size_t at = next[i]; is_within[at] && is_bending(turn_after[at]); at = next[at]) {
      bend.push_back(at);
      turned += turn_after[at];
      length_m += length_of(segments[at]);
    }
    if (turned > -FloorPlan::kBend_rad || length_m > FloorPlan::kBend_m) continue;
    for (const std::size_t at : bend) is_start[next[at]] = false;
    is_start[next[i]] = true;
    bends[next[i]] = bend.size();
  }
  return bends;
}

}  // namespace

FloorPlan::FloorPlan(std::span<const PlanSegment> given) {
  std::vector<PlanSegment> segments;
  for (const PlanSegment& segment : given) {
    if (segment.from != segment.to) segments.push_back(segment);
  }
  const std::vector<std::size_t> next = find_next(segments);
  std::vector<bool> is_start = find_starts(segments, next);
  const std::vector<std::size_t> bends = join_bends(segments, next, is_start);
  std::vector<std::size_t> wall_of(segments.size(), PlanWall::kNone), last_segment;
  const auto add_wall = [&](std::size_t first) {
    PlanWall& wall = walls_.emplace_back();
    wall.points.push_back(segments[first].from);
    wall.bend = bends[first];
    std::size_t last = first;
    for (std::size_t at = first;
         at != PlanWall::kNone && wall_of[at] == PlanWall::kNone && (at == first || !is_start[at]);
         at = next[at]) {
      wall_of[at] = walls_.size() - 1;
      pieces_.push_back({segments[at].from, segments[at].to, walls_.size() - 1, wall.length_m});
      wall.points.push_back(segments[at].to);
      wall.length_m += length_of(segments[at]);
      if (wall.points.size() == bends[first] + 1) wall.bend_m = wall.length_m;
      last = at;
    }
    last_segment.push_back(last);
  };
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (is_start[i]) add_wall(i);
  }
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (wall_of[i] == PlanWall::kNone) add_wall(i);  // closed, without a corner
  }
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    const std::size_t follower = next[last_segment[w]];
    if (follower != PlanWall::kNone) walls_[w].next = wall_of[follower];
  }
}

std::optional<FloorPlan::Hit> FloorPlan::first_hit(const Vec2& from, const Vec2& direction,
                                                   double reach_m) const {
  std::optional<Hit> first;
  double nearest_m = reach_m;
  for (const Piece& piece : pieces_) {
    const Vec2 along = piece.to - piece.from, to_piece = piece.from - from;
    const double facing = cross(direction, along);
    if (facing <= 0.0) continue;  // parallel, or seen from behind
    const double range_m = cross(to_piece, along) / facing;
    const double share = cross(to_piece, direction) / facing;
    if (range_m < 0.0 || range_m > nearest_m || share < 0.0 || share > 1.0) continue;
    nearest_m = range_m;
    const double length_m = along.norm();
    first = {piece.wall, range_m, piece.along_m + share * length_m, along / length_m};
  }
  return first;
}

}  // namespace hallway::eval
