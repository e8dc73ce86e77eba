// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/map_report.hpp"

#include <algorithm>

namespace hallway::slam_plane::thesis {
namespace {

constexpr double kPosition_m = 0.03;     // of a pose that is told
constexpr double kOpen_m = 1.0;          // along what is open
constexpr double kHeading = 0.005;       // [rad]
constexpr double kSame_m = 0.1;          // distance between two planes that may be one
constexpr double kShared_m = 0.15;       // that two walls in one line share at least, if they are one
constexpr double kSameCosine = 0.99875;  // 2.9 degrees

/// A wall, and the line that it lies in.
struct Part {
  WallLandmark wall;
  Vec2 direction;  // unit, from a to b
  double length;

  explicit Part(const WallLandmark& w)
      : wall(w), direction((w.b - w.a).normalized()), length((w.b - w.a).norm()) {}

  double along(const Vec2& p) const { return direction.dot(p - wall.a); }
  double beside(const Vec2& p) const { return std::abs(cross(direction, p - wall.a)); }
};

/// Whether two parts lie in one line, face the same way, and share more than what errors make of walls that touch, or one lies within the other. `base` is the longer one.
bool are_one(const Part& part, const Part& base) {
  if (base.direction.dot(part.direction) < kSameCosine) return false;
  if (std::max(base.beside(part.wall.a), base.beside(part.wall.b)) > kSame_m) return false;
  const double low = base.along(part.wall.a), high = base.along(part.wall.b);
  const bool within = low > -kSame_m && high < base.length + kSame_m;
  return within || std::min(high, base.length) - std::max(low, 0.0) > kShared_m;
}

/// An end of two parts of one wall: the outer one. Where both are in one place it is certain if either is.
void join_end(int end, const Part& part, const Part& base, WallLandmark& joined) {
  const Vec2& of_base = end == kEndA ? base.wall.a : base.wall.b;
  const Vec2& of_part = end == kEndA ? part.wall.a : part.wall.b;
  const double farther = outward(end) * base.direction.dot(of_part - of_base);
  const bool one_place = std::abs(farther) <= kSame_m && base.wall.certain[end] != part.wall.certain[end];
  const bool takes_part = one_place ? part.wall.certain[end] : farther > 0.0;
  joined.certain[end] = takes_part ? part.wall.certain[end] : base.wall.certain[end];
  if (takes_part) (end == kEndA ? joined.a : joined.b) = base.wall.a + base.direction * base.along(of_part);
}

Part joined(const Part& part, const Part& base) {
  WallLandmark result = base.wall;
  for (const int end : {kEndA, kEndB}) join_end(end, part, base, result);
  result.id = std::min(part.wall.id, base.wall.id);
  result.z_low = std::min(part.wall.z_low, base.wall.z_low);
  result.z_high = std::max(part.wall.z_high, base.wall.z_high);
  result.observations = part.wall.observations + base.wall.observations;
  return Part(result);
}

/// Joins parts of one wall until there are none. O(walls²).
void join_parts(std::vector<Part>& parts) {
  for (std::size_t i = 0; i < parts.size();) {
    std::size_t other = 0;
    while (other < i) {
      const bool longer = parts[other].length >= parts[i].length;
      if (are_one(parts[longer ? i : other], parts[longer ? other : i])) break;
      ++other;
    }
    if (other == i) {
      ++i;
      continue;
    }
    const bool longer = parts[other].length >= parts[i].length;
    const Part both = joined(parts[longer ? i : other], parts[longer ? other : i]);
    parts[i] = both;  // those before it are to be looked at again
    parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(other));
    --i;
  }
}

WallLandmark wall_from(LandmarkId name, const Reference& reference, const PlaneTrack& track) {
  const Segment segment = reference.place.segment();
  WallLandmark wall;
  wall.id = name;
  wall.a = segment.end[kEndA];
  wall.b = segment.end[kEndB];
  for (int end = 0; end < 2; ++end) wall.certain[end] = reference.known[end];
  if (!track.empty()) {
    wall.z_low = track.newest().z_low;
    wall.z_high = track.newest().z_high;
  }
  wall.observations = static_cast<std::uint32_t>(track.pushed());
  wall.status = LandmarkStatus::mapped;
  return wall;
}

std::vector<WallLandmark> walls_of(const State& state) {
  std::vector<Part> parts;
  for (TrackId id = 0; id < state.map.size(); ++id) {
    const PlaneLandmark* plane = state.map.find(id);
    if (plane != nullptr)
      parts.emplace_back(wall_from(state.tracks.name(id), plane->reference, state.tracks[id]));
  }
  join_parts(parts);
  std::vector<WallLandmark> walls;
  for (const Part& part : parts) walls.push_back(part.wall);
  std::ranges::sort(walls, {}, &WallLandmark::id);
  return walls;
}

}  // namespace

Map report_map(const State& state) {
  Map map;
  map.walls = walls_of(state);
  for (const Submap& submap : state.submaps) {
    if (!submap.placed) continue;
    slam_plane::Submap told;
    told.id = submap.id();
    told.T_map_submap = submap.T_map_submap;
    told.lines_only = submap.by_motion;
    for (const Member& member : submap.members()) told.members.push_back(state.tracks.name(member.track));
    map.submaps.push_back(told);
  }
  return map;
}

LandmarkId wall_of(TrackId track, const State& state) {
  return state.tracks.submaps(track).empty() ? kNoLandmark : state.tracks.name(track);
}

Mat3 covariance_of(const Alignment& location) {
  Mat3 result = Mat3::Zero();
  result.topLeftCorner<2, 2>() = kPosition_m * kPosition_m * Mat2::Identity();
  result.topLeftCorner<2, 2>() += kOpen_m * kOpen_m * location.open * location.open.transpose();
  result(2, 2) = kHeading * kHeading;
  return result;
}

}  // namespace hallway::slam_plane::thesis
