// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/map_report.hpp"

#include <algorithm>

namespace hallway::slam_plane::thesis {
namespace {

constexpr double kPosition_m = 0.03;  // of a pose that is told
constexpr double kOpen_m = 1.0;       // along what is open
constexpr double kHeading = 0.005;    // [rad]
constexpr double kSame_m = 0.1;       // distance between two planes that may be one
constexpr double kSameSine = 0.05;

/// Whether `inner` lies on `outer` but for some slack.
bool lies_within(const Wall& inner, const Wall& outer) {
  const Vec2 d = (outer.b - outer.a).normalized();
  const double length = (outer.b - outer.a).norm();
  const Vec2 e = (inner.b - inner.a).normalized();
  if (d.dot(e) < 0.0 || std::abs(cross(d, e)) > kSameSine) return false;
  for (const Vec2& p : {inner.a, inner.b}) {
    const double s = d.dot(p - outer.a);
    if (std::abs(cross(d, p - outer.a)) > kSame_m || s < -kSame_m || s > length + kSame_m) return false;
  }
  return true;
}

Wall wall_from(WallId name, const Reference& reference, const Track& track) {
  const Segment segment = reference.place.segment();
  Wall wall;
  wall.id = name;
  wall.a = segment.end[kEndA];
  wall.b = segment.end[kEndB];
  for (int end = 0; end < 2; ++end) wall.certain[end] = reference.known[end];
  if (!track.empty()) {
    wall.z_low = track.newest().z_low;
    wall.z_high = track.newest().z_high;
  }
  wall.observations = static_cast<std::uint32_t>(track.pushed());
  wall.status = WallStatus::mapped;
  return wall;
}

std::vector<Wall> walls_of(const State& state) {
  std::vector<Wall> all;
  for (TrackId id = 0; id < state.map.size(); ++id) {
    const MappedPlane* plane = state.map.find(id);
    if (plane != nullptr) all.push_back(wall_from(state.tracks.name(id), plane->reference, state.tracks[id]));
  }
  std::sort(all.begin(), all.end(), [](const Wall& a, const Wall& b) { return a.id < b.id; });
  return all;
}

}  // namespace

Map report_map(const State& state) {
  Map map;
  const std::vector<Wall> all = walls_of(state);
  for (const Wall& wall : all) {
    const bool hidden = std::any_of(all.begin(), all.end(), [&](const Wall& other) {
      return other.id != wall.id && other.observations > wall.observations && lies_within(wall, other);
    });
    if (!hidden) map.walls.push_back(wall);
  }
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

WallId wall_of(TrackId track, const State& state) {
  return state.tracks.submaps(track).empty() ? kNoWall : state.tracks.name(track);
}

std::uint64_t count_walls(const State& state) {
  return state.map.valid_planes();
}

Mat3 covariance_of(const Alignment& location) {
  Mat3 result = Mat3::Zero();
  result.topLeftCorner<2, 2>() = kPosition_m * kPosition_m * Mat2::Identity();
  result.topLeftCorner<2, 2>() += kOpen_m * kOpen_m * location.open * location.open.transpose();
  result(2, 2) = kHeading * kHeading;
  return result;
}

}  // namespace hallway::slam_plane::thesis
