// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/reference.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::slam_plane::thesis {

Reference reference_of(const TimedObservation& observation) {
  return {.place = {observation.segment.middle(), observation.direction, observation.length, true}};
}

Reference moved(const Pose2& T, const Reference& reference) {
  Reference result = reference;
  result.place.middle = T * reference.place.middle;
  result.place.direction = T.rotate(reference.place.direction);
  return result;
}

Reference reference_of(const Comparison& comparison, int which) {
  Reference result;
  result.place = comparison.placement(which);
  result.shared = comparison.shared;
  if (comparison.key[which] != KeyPoint::none) result.known[end_of(comparison.key[which])] = true;
  return result;
}

Reference chained(const Reference& base, const Comparison& comparison) {
  if (!base.valid() || !comparison.places()) return {};
  const End end = end_of(comparison.key[0]);
  if (!base.known[end]) return {};
  const Vec2 in_base = base.place.segment().end[end];
  const Vec2 in_parent = comparison.placement(0).segment().end[end];
  const Pose2 T_base_turned{Vec2::Zero(), base.place.direction};
  Reference result = reference_of(comparison, 1);
  result.place.middle = in_base + T_base_turned.rotate(comparison.offset - in_parent);
  result.place.direction = T_base_turned.rotate(comparison.direction).normalized();
  result.shared = std::min(base.shared, comparison.shared);
  return result;
}

void append_pairs(const Reference& from, const Reference& to, std::vector<PlanePair>& pairs) {
  const Segment a = from.place.segment();
  const Segment b = to.place.segment();
  PlanePair pair;
  pair.direction[0] = from.place.direction;
  pair.direction[1] = to.place.direction;
  bool any = false;
  for (int end = 0; end < 2; ++end) {
    if (!from.known[end] || !to.known[end]) continue;
    pair.point[0] = a.end[end];
    pair.point[1] = b.end[end];
    pair.same_point = any = true;
    pairs.push_back(pair);
  }
  if (any) return;
  pair.same_point = false;
  pair.point[0] = a.middle();
  pair.point[1] = b.middle();
  pairs.push_back(pair);
}

void grow(Reference& plane, const Reference& other) {
  const Vec2 direction = plane.place.direction;
  Segment segment = plane.place.segment();
  const Segment seen = other.place.segment();
  for (int end = 0; end < 2; ++end) {
    const int far = 1 - end;
    if (plane.known[end]) continue;

    if (other.known[end]) {
      segment.end[end] += direction * direction.dot(seen.end[end] - segment.end[end]);
      plane.known[end] = true;
    } else if (plane.known[far] && other.known[far] && other.place.size > segment.length()) {
      segment.end[end] = segment.end[far] + outward(end) * direction * other.place.size;
    }
  }
  plane.place.middle = segment.middle();
  plane.place.size = direction.dot(segment.end[kEndB] - segment.end[kEndA]);
}

}  // namespace hallway::slam_plane::thesis
