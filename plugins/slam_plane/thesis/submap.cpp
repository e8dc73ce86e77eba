// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/submap.hpp"

#include <algorithm>
#include <numeric>

namespace hallway::slam_plane::thesis {
namespace {

std::vector<const PlaneTrack*> tracks_of(const std::vector<Member>& members, const TrackBook& tracks) {
  std::vector<const PlaneTrack*> list;
  list.reserve(members.size());
  for (const Member& member : members) list.push_back(&tracks[member.track]);
  return list;
}

/// All comparisons between members, those worth most first (Rule 30).
std::vector<PlaceOffer> offers_of(const std::vector<Member>& members, StaticPairs& pairs,
                                  const TrackBook& tracks) {
  std::vector<PlaceOffer> offers;
  for (std::size_t a = 0; a < members.size(); ++a) {
    for (std::size_t b = a + 1; b < members.size(); ++b) {
      const PlaneTrack& in_a = tracks[members[a].track];
      const PlaneTrack& in_b = tracks[members[b].track];
      const int first = in_a.id() < in_b.id() ? 0 : 1;  // which plane of the pair a is
      for (const Comparison& saved : pairs.update(in_a, in_b).saved)
        append_offers({a, b, {saved.key[first], saved.key[1 - first]}}, worth(saved), offers);
    }
  }
  sort_offers(offers);
  return offers;
}

std::size_t placed_count(const std::vector<Member>& members) {
  return static_cast<std::size_t>(
      std::ranges::count_if(members, [](const Member& member) { return member.reference.valid(); }));
}

}  // namespace

const Member* Submap::find(TrackId track) const {
  const auto at = std::ranges::find(members_, track, &Member::track);
  return at == members_.end() ? nullptr : &*at;
}

void Submap::add(TrackId track, Iteration now, bool link) {
  Member member;
  member.link = member.confirmed = link;
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
    member.comparison = {};
    for (int end = 0; end < 2; ++end) member.still[end] = false;
  }
  for (const PlaceStep& step : order_) take_step(step, pairs, tracks, now);
  take_best(tracks);
  keep_frame(before);
  keep_best(now);
  return true;
}

/// If nothing can be computed any more, since the observations are gone, it is as it was at its best (Rule 35).
void Submap::take_best(const TrackBook& tracks) {
  if (placed_count(members_) > 0) return;
  const bool found_wrong = std::ranges::any_of(best_, [&](const Member& saved) {
    const Iteration last = saved.comparison.interval.last;
    return saved.comparison.valid && tracks[saved.track].find(last) != nullptr &&
           tracks[saved.parent].find(last) != nullptr;
  });
  if (found_wrong) return;
  for (Member& member : members_) {
    for (const Member& saved : best_) {
      if (saved.track != member.track) continue;
      member.reference = saved.reference;
      member.comparison = saved.comparison;
      member.parent = saved.parent;
    }
  }
}

void Submap::keep_best(Iteration now) {
  if (placed_count(members_) < placed_count(best_)) return;
  best_ = members_;
  best_at_ = now;
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
  const std::vector<PlaceOffer> offers = offers_of(members_, pairs, tracks);
  std::vector<double> reach(members_.size(), 0.0);
  for (const PlaceOffer& offer : offers) reach[offer.step.parent] += offer.worth;
  std::vector<std::size_t> roots(members_.size());
  std::iota(roots.begin(), roots.end(), std::size_t{0});
  std::ranges::stable_sort(roots, [&](std::size_t a, std::size_t b) { return reach[a] > reach[b]; });
  OfferGraph graph(offers, members_.size());
  int best = -1;
  std::size_t best_root = 0;
  for (const std::size_t root : roots) {
    if (reach[root] <= 0.0) break;
    const std::vector<bool>& placed_then = graph.placed_from(root);
    const int score = score_of(placed_then);
    if (score > best) {
      best = score;
      best_root = root;
    }
    if (std::ranges::find(placed_then, false) == placed_then.end()) break;
  }
  order_.clear();
  if (best >= 0) order_ = graph.spanning_steps(best_root);
  ordered_ = now;
}

/// Members placed; the first two of those that link to older submaps count most.
int Submap::score_of(const std::vector<bool>& then) const {
  int placed_members = 0, links_placed = 0;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (!then[i]) continue;
    ++placed_members;
    links_placed += members_[i].link ? 1 : 0;
  }
  return placed_members + static_cast<int>(members_.size()) * std::min(links_placed, 2);
}

void Submap::take_step(const PlaceStep& step, StaticPairs& pairs, const TrackBook& tracks, Iteration now) {
  Member& child = members_[step.child];
  Member& parent = members_[step.parent];
  const PlaneTrack& child_track = tracks[child.track];
  const PlaneTrack& parent_track = tracks[parent.track];
  const PairHistory& history = pairs.update(parent_track, child_track);
  for (const Comparison& saved : history.saved) {
    const Comparison comparison = StaticPairs::oriented(saved, parent_track, child_track);
    if (comparison.key[0] != step.key[0] || comparison.key[1] != step.key[1]) continue;
    if (!parent.reference.valid()) {
      if (&step != &order_.front()) return;
      parent.reference = reference_of(comparison, 0);
      parent.comparison = inverse(comparison);
      parent.parent = child.track;
    }
    if (take_offer(parent.reference, comparison, child.reference) && !child.comparison.valid) {
      child.comparison = comparison;
      child.parent = parent.track;
    }
  }
  note_still(history, parent, child, now);
}

void Submap::note_still(const PairHistory& history, Member& parent, Member& child, Iteration now) {
  if (history.updated != now) return;
  const bool swapped = child.track < parent.track;
  for (int end = 0; end < 2; ++end) {
    parent.still[end] = parent.still[end] || history.still(swapped ? 1 : 0, end);
    child.still[end] = child.still[end] || history.still(swapped ? 0 : 1, end);
  }
}

std::optional<TrackId> Submap::too_short(const Options& options, Iteration now) {
  for (Member& member : members_) {
    if (member.confirmed) continue;
    const Membership judged = judge_member(member.comparison, member.joined, now, options);
    if (judged == Membership::confirmed) member.confirmed = true;
    if (judged == Membership::too_short) return member.track;
  }
  return std::nullopt;
}

void Submap::confirm(TrackId track) {
  for (Member& member : members_) member.confirmed = member.confirmed || member.track == track;
}

void Submap::truncate(Iteration k) {
  const bool changed = std::erase_if(members_, [&](const Member& member) { return member.joined > k; }) > 0;
  if (best_at_ > k) best_.clear();
  if (changed || computed_to_ > k || ordered_ > k) ordered_ = computed_to_ = -1;
}

}  // namespace hallway::slam_plane::thesis
