// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/sighting.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hallway::slam_plane::thesis {
namespace {

bool in_bounds(const Vec2& p) {
  return std::abs(p.x()) <= kMaxCoordinate_m && std::abs(p.y()) <= kMaxCoordinate_m;  // false for NaN
}

}  // namespace

Segment operator*(const Pose2& T_to_from, const Segment& segment) {
  return {{T_to_from * segment.end[kEndA], T_to_from * segment.end[kEndB]}};
}

std::optional<Sighting> make_sighting(const Piece& piece, Iteration iteration) {
  if (!in_bounds(piece.a) || !in_bounds(piece.b)) return std::nullopt;
  Sighting sighting;
  sighting.iteration = iteration;
  sighting.segment = {{piece.a, piece.b}};
  if (cross(piece.a, piece.b) > 0.0) std::swap(sighting.segment.end[kEndA], sighting.segment.end[kEndB]);
  sighting.length = sighting.segment.length();
  if (!(sighting.length > 1e-9)) return std::nullopt;
  sighting.direction = sighting.segment.direction();
  sighting.z_low = piece.z_low;
  sighting.z_high = piece.z_high;
  return sighting;
}

}  // namespace hallway::slam_plane::thesis
