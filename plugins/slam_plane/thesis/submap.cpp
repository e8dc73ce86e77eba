// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/submap.hpp"

#include <Eigen/Core>
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

bool Submap::compute(StaticPairs& pairs, const TrackBook& tracks, const Options& options, Iteration now) {
  Iteration newest = -1;
  for (const Member& member : members_) newest = std::max(newest, tracks[member.track].newest().iteration);
  if (newest <= computed_to_) return false;
  computed_to_ = newest;
  if (ordered_ < 0 || now - ordered_ >= options.reorder_every) reorder(pairs, tracks, now);
  const std::vector<Member> before = members_;
  for (Member& member : members_) {
    member.reference = {};
    for (int end = 0; end < 2; ++end) member.still[end] = member.still_parent[end] = false;
  }
  for (const PairEdge& edge : order_) place_child(edge, pairs, tracks, now);
  keep_frame(before);
  return true;
}

/// What is placed from is another plane now and then, or grows: the frame stays where it was.
void Submap::keep_frame(const std::vector<Member>& before) {
  std::vector<PlanePair> common;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (members_[i].reference.valid() && before[i].reference.valid())
      append_pairs(members_[i].reference, before[i].reference, common);
  }
  const std::optional<Alignment> T_before_now = align(common, Pose2{});
  if (!T_before_now || !T_before_now->determined) {
    placed = false;
    return;
  }
  for (Member& member : members_) {
    if (member.reference.valid()) member.reference = moved(T_before_now->T_to_from, member.reference);
  }
}

void Submap::reorder(StaticPairs& pairs, const TrackBook& tracks, Iteration now) {
  const auto n = static_cast<int>(members_.size());
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(n, n);
  for (int a = 0; a < n; ++a) {
    for (int b = a + 1; b < n; ++b) {
      const Track& in_a = tracks[members_[static_cast<std::size_t>(a)].track];
      const Track& in_b = tracks[members_[static_cast<std::size_t>(b)].track];
      weights(a, b) = weights(b, a) = pairs.update(in_a, in_b).shared();
    }
  }
  int root = 0;
  for (int a = 1; a < n; ++a) {
    if (weights.row(a).sum() > weights.row(root).sum()) root = a;
  }
  const auto from_root = [root](int i) { return i == 0 ? root : i == root ? 0 : i; };
  const auto weight = [&](int a, int b) { return weights(from_root(a), from_root(b)); };
  order_ = maximum_spanning_tree(n, weight, weight);
  for (PairEdge& edge : order_) edge = {from_root(edge.parent), from_root(edge.child)};
  ordered_ = now;
}

void Submap::place_child(const PairEdge& edge, StaticPairs& pairs, const TrackBook& tracks, Iteration now) {
  Member& child = members_[static_cast<std::size_t>(edge.child)];
  Member& parent = members_[static_cast<std::size_t>(edge.parent)];
  const Track& child_track = tracks[child.track];
  const Track& parent_track = tracks[parent.track];
  const PairHistory& history = pairs.update(parent_track, child_track);
  const CompareOptions& options = pairs.comparer().options();
  child.parent = parent.track;
  place_by(history, parent_track, child_track, parent, child, edge.parent == order_.front().parent, options);
  if (history.since < 0 || history.updated != now) return;
  const bool swapped = child.track < parent.track;
  for (int end = 0; end < 2; ++end) {
    child.still_parent[end] = history.still[swapped ? 1 : 0][end];
    child.still[end] = history.still[swapped ? 0 : 1][end];
  }
}

void Submap::place_by(const PairHistory& history, const Track& parent_track, const Track& child_track,
                      Member& parent, Member& child, bool is_root,
                      const CompareOptions& options) {
  child.comparison = {};
  for (const Comparison& saved : history.saved) {
    const Comparison comparison = StaticPairs::oriented(saved, parent_track, child_track);
    if (!child.comparison.valid) child.comparison = comparison;
    if (is_root && !parent.reference.valid()) {
      parent.reference = reference_of(comparison, 0, options);
      parent.comparison = comparison;
    }
    if (!parent.reference.valid()) return;
    const Reference seen = chained(parent.reference, comparison, options);
    if (!seen.valid()) continue;
    if (child.reference.valid()) {
      grow(child.reference, seen);
    } else {
      child.reference = seen;
    }
  }
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
  ordered_ = computed_to_ = -1;
}

}  // namespace hallway::slam_plane::thesis
