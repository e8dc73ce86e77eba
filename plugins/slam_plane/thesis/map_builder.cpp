// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/map_builder.hpp"

#include <algorithm>

namespace hallway::slam_plane::thesis {
namespace {

constexpr std::size_t kLeastLinkPlanes = 2;  // Rule 8
constexpr double kMoved_m = 1e-4;            // a submap that moves less takes no others along

std::optional<Pose2> by_anchors(const Submap& submap) {
  std::vector<PlanePair> pairs;
  for (const Anchor& anchor : submap.anchors) {
    const Member* member = submap.find(anchor.track);
    if (member != nullptr && member->reference.valid())
      append_pairs(member->reference, anchor.reference, pairs);
  }
  const std::optional<Alignment> alignment = align(pairs, submap.T_map_submap);
  if (!alignment || !alignment->determined) return std::nullopt;
  return alignment->T_to_from;
}

}  // namespace

std::optional<Pose2> MapBuilder::link(SubmapIndex index, const std::vector<Submap>& submaps) {
  const Submap& submap = submaps[index];
  std::vector<PlanePair> pairs;
  std::vector<TrackId> shared;
  for (const SubmapIndex linked : submap.links) {
    const Submap& base = submaps[linked];
    if (linked >= index || !base.placed) continue;
    for (const Member& member : submap.members()) {
      const Member* other = base.find(member.track);
      if (other == nullptr || !member.reference.valid() || !other->reference.valid()) continue;
      append_pairs(member.reference, moved(base.T_map_submap, other->reference), pairs);
      add_new(shared, member.track);
    }
  }
  if (shared.size() < kLeastLinkPlanes) return std::nullopt;
  const std::optional<Alignment> alignment = align(pairs, submap.T_map_submap);
  if (!alignment || !alignment->determined) return std::nullopt;
  return alignment->T_to_from;
}

bool MapBuilder::place(SubmapIndex index, std::vector<Submap>& submaps) const {
  Submap& submap = submaps[index];
  const Pose2 before = submap.T_map_submap;
  const bool was = submap.placed;
  std::optional<Pose2> T;
  if (!submap.anchors.empty()) T = by_anchors(submap);
  if (!T) T = link(index, submaps);
  if (!T) return false;
  submap.T_map_submap = *T;
  submap.placed = true;
  return !was || (before.t - T->t).norm() > kMoved_m || (before.r - T->r).norm() > kMoved_m;
}

void MapBuilder::combine(TrackId track, const std::vector<Submap>& submaps, const TrackBook& tracks) {
  std::vector<Reference> seen;
  for (const SubmapIndex index : tracks.submaps(track)) {
    const Submap& submap = submaps[index];
    if (!submap.placed) continue;
    const Member* member = submap.find(track);
    if (member != nullptr && member->reference.valid())
      seen.push_back(moved(submap.T_map_submap, member->reference));
  }
  if (seen.empty()) return;
  std::ranges::stable_sort(seen, [](const Reference& a, const Reference& b) {
    const int ends_a = int{a.known[0]} + int{a.known[1]};
    const int ends_b = int{b.known[0]} + int{b.known[1]};
    return ends_a != ends_b ? ends_a > ends_b : a.shared > b.shared;
  });
  Reference plane = seen.front();
  for (const Reference& other : seen) grow(plane, other);
  if (planes_.size() <= track) planes_.resize(tracks.size());
  if (!planes_[track].valid()) ++valid_;
  planes_[track].reference = plane;
  grow_to_reach(track);
}

void MapBuilder::grow_to_reach(TrackId track) {
  PlaneLandmark& plane = planes_[track];
  const Vec2 direction = plane.reference.place.direction;
  Segment segment = plane.reference.place.segment();
  for (int end = 0; end < 2; ++end) {
    if (!plane.reach[end] || plane.reference.known[end]) continue;
    const double farther = direction.dot(plane.reach[end]->place - segment.end[end]);
    if (end == kEndA ? farther < 0.0 : farther > 0.0) segment.end[end] += direction * farther;
  }
  plane.reference.place.middle = segment.middle();
  plane.reference.place.size = direction.dot(segment.end[kEndB] - segment.end[kEndA]);
  index_.put(track, segment.end[kEndA], segment.end[kEndB]);
}

void MapBuilder::expand(TrackId track, const Segment& seen, Iteration now) {
  if (find(track) == nullptr) return;
  PlaneLandmark& plane = planes_[track];
  const Segment segment = plane.reference.place.segment();
  for (int end = 0; end < 2; ++end) {
    const double farther = plane.reference.place.direction.dot(seen.end[end] - segment.end[end]);
    if (end == kEndA ? farther < 0.0 : farther > 0.0)
      plane.reach[end] = PlaneLandmark::Reach{seen.end[end], now};
  }
  grow_to_reach(track);
}

void MapBuilder::clear(Iteration k) {
  for (PlaneLandmark& plane : planes_) {
    plane.reference = {};
    for (auto& reach : plane.reach) {
      if (reach && reach->at > k) reach.reset();
    }
  }
  index_.clear();
  valid_ = 0;
}

void MapBuilder::build(std::span<const SubmapIndex> changed, std::vector<Submap>& submaps,
                       const TrackBook& tracks) {
  std::vector<SubmapIndex> order(changed.begin(), changed.end());
  std::ranges::sort(order);
  std::vector<TrackId> touched;
  for (const SubmapIndex index : order) {
    place(index, submaps);
    if (!submaps[index].placed) continue;
    for (const Member& member : submaps[index].members()) touched.push_back(member.track);
  }
  make_set(touched);
  for (const TrackId track : touched) combine(track, submaps, tracks);
}

}  // namespace hallway::slam_plane::thesis
