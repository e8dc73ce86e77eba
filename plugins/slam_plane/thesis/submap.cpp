// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/submap.hpp"

#include <algorithm>

namespace hallway::slam_plane::thesis {
namespace {

std::vector<const Track*> tracks_of(const std::vector<Member>& members, const TrackBook& tracks) {
  std::vector<const Track*> list;
  list.reserve(members.size());
  for (const Member& member : members) list.push_back(&tracks[member.track]);
  return list;
}

}  // namespace

const Member* Submap::find(TrackId track) const {
  const auto at = std::find_if(members_.begin(), members_.end(),
                               [&](const Member& member) { return member.track == track; });
  return at == members_.end() ? nullptr : &*at;
}

void Submap::add(TrackId track, Iteration now) {
  Member member;
  member.track = track;
  member.joined = now;
  members_.push_back(member);
  ordered_ = computed_to_ = -1;
}

Intervals Submap::common(const TrackBook& tracks) const {
  return common_intervals(tracks_of(members_, tracks));
}

bool Submap::compute(PairComparer& comparer, const TrackBook& tracks, const Options& options, Iteration now) {
  Iteration newest = -1;
  for (const Member& member : members_) newest = std::max(newest, tracks[member.track].newest().iteration);
  if (newest <= computed_to_) return false;
  computed_to_ = newest;
  if (ordered_ < 0 || now - ordered_ >= options.reorder_every) reorder(comparer, tracks, now);
  for (Member& member : members_) member.reference = {};
  const CompareOptions& compare = comparer.options();
  for (const PairEdge& edge : order_) place_child(edge, comparer, tracks, compare);
  return true;
}

void Submap::reorder(PairComparer& comparer, const TrackBook& tracks, Iteration now) {
  order_ = order_comparisons(comparer, tracks_of(members_, tracks));
  ordered_ = now;
}

Comparison Submap::best_comparison(const PairEdge& edge, PairComparer& comparer, const TrackBook& tracks,
                                   const CompareOptions& options) {
  Member& child = members_[static_cast<std::size_t>(edge.child)];
  const TrackId parent = members_[static_cast<std::size_t>(edge.parent)].track;
  const Comparison now = comparer.compare(tracks[parent], tracks[child.track]);
  child.parent = parent;
  const bool same = child.saved.valid && child.saved_parent == parent;
  if (same && !better(now, child.saved, options)) return child.saved;
  if (now.valid) {
    child.saved = now;
    child.saved_parent = parent;
  }
  return now;
}

void Submap::place_child(const PairEdge& edge, PairComparer& comparer, const TrackBook& tracks,
                         const CompareOptions& options) {
  Member& child = members_[static_cast<std::size_t>(edge.child)];
  Member& parent = members_[static_cast<std::size_t>(edge.parent)];
  child.comparison = best_comparison(edge, comparer, tracks, options);
  if (!child.comparison.has_keys()) return;
  if (edge.parent == 0 && !parent.reference.valid()) {
    parent.reference = reference_of(child.comparison, 0, options);
    parent.comparison = child.comparison;
  }
  if (parent.reference.valid()) child.reference = chained(parent.reference, child.comparison, options);
}

std::optional<TrackId> Submap::too_short(const Options& options, Iteration now) {
  for (Member& member : members_) {
    if (member.confirmed) continue;
    const Membership judged = judge_member(member.comparison, member.joined, now, options.interval());
    if (judged == Membership::confirmed) member.confirmed = true;
    if (judged == Membership::too_short) return member.track;
  }
  return std::nullopt;
}

void Submap::confirm(TrackId track) {
  for (Member& member : members_) member.confirmed = member.confirmed || member.track == track;
}

void Submap::truncate(Iteration k) {
  std::erase_if(members_, [&](const Member& member) { return member.joined > k; });
  for (Member& member : members_) {
    if (member.saved.interval.last > k) member.saved = {};
  }
  ordered_ = computed_to_ = -1;
}

}  // namespace hallway::slam_plane::thesis
