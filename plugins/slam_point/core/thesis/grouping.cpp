// SPDX-License-Identifier: MIT
#include "slam_point/core/thesis/grouping.hpp"

#include <algorithm>

namespace hallway::slam_point::thesis {
namespace {

constexpr Iteration kLongestView =
    512;  // iterations after which a point that stays in view gets its last group

}  // namespace

Grouping::Grouping(const Options& options, double least_basis_m)
    : options_(options), least_basis_m_(least_basis_m) {}

Iteration Grouping::kept_iterations(const Options& options) {
  const int most = std::max(
      {options.look_back, options.temporary_look_back, options.merge_after, options.match_iterations});
  const auto kept = static_cast<Iteration>(most + 2);
  return options.levels >= 3
             ? std::max(kept, kLongestView + static_cast<Iteration>(options.match_iterations) + 2)
             : kept;
}

void Grouping::add(Index track) {
  without_temporary_.push_back(track);
  if (options_.levels >= 2) without_final_.push_back(track);
  if (options_.levels >= 3) in_view_.push_back(track);
}

void Grouping::compute(Tracks& tracks) {
  const Iteration now = tracks.now();
  ready_.clear();
  for (const Index track : tracks.seen_between(now, now)) {
    for (const Index g : tracks[track].groups) {
      Slot& slot = groups_[g];
      if (slot.stamp != now) {
        slot.stamp = now;
        slot.seen = 0;
      }
      if (++slot.seen == slot.group->points().size()) ready_.push_back(g);
    }
  }
  std::sort(ready_.begin(), ready_.end());
  for (const Index g : ready_) {
    average_between(*groups_[g].group, tracks, now, now);
    if (place(groups_[g], tracks)) place_landmarks(g, tracks);
  }
}

void Grouping::create(Tracks& tracks) {
  create_due(without_temporary_, 1, static_cast<Iteration>(options_.temporary_look_back), tracks);
  if (options_.levels >= 2) create_due(without_final_, 2, static_cast<Iteration>(options_.look_back), tracks);
  if (options_.levels >= 3) create_for_gone(tracks);
}

void Grouping::create_due(std::deque<Index>& waiting, int level, Iteration look_back, Tracks& tracks) {
  while (!waiting.empty()) {
    const Index creation = waiting.front();
    const Track& track = tracks[creation];
    if (track.first + look_back > tracks.now()) return;
    waiting.pop_front();
    if (track.merged_into != kNone || track.level >= level) continue;
    const bool first = track.first == 0;
    Selection selection;
    if (select(tracks, creation, level, look_back, false, selection)) {
      make(tracks, selection, level, track.first, false);
    } else if (first && select(tracks, creation, level, look_back, true, selection)) {
      make(tracks, selection, level, track.first, true);
    }
  }
}

bool Grouping::select(Tracks& tracks, Index creation, int level, Iteration look_back, bool first,
                      Selection& selection) {
  const Iteration begin = tracks[creation].first;
  const Iteration end = begin + look_back;
  std::vector<Candidate> previous;
  std::vector<Candidate> next;
  for (const Index track : tracks.seen_between(begin, end)) {
    const Candidate candidate{track, tracks[track].history.count(begin, end)};
    (tracks[track].level >= level ? previous : next).push_back(candidate);
  }
  const auto whole = [](int value) { return static_cast<std::size_t>(value); };
  // A shorter look-back allows for as large a share of misses.
  const std::size_t reduction = std::min(whole(options_.accuracy_reduction), whole(options_.look_back));
  Constants constants;
  constants.threshold =
      std::max<std::size_t>(2, look_back - look_back * reduction / whole(options_.look_back));
  constants.previous_min = whole(options_.previous_min);
  constants.previous_max = std::max(whole(options_.previous_max), constants.previous_min);
  constants.next_min = whole(options_.next_min);
  return select_by_constants(std::move(previous), std::move(next), constants, first, selection);
}

void Grouping::create_for_gone(Tracks& tracks) {
  std::vector<Index> due;
  const auto unseen = static_cast<Iteration>(options_.match_iterations);
  if (tracks.now() > unseen) {
    const Iteration left = tracks.now() - unseen - 1;
    for (const Index track : tracks.seen_between(left, left)) {
      if (tracks[track].last == left) due.push_back(track);
    }
  }
  while (!in_view_.empty() && tracks[in_view_.front()].first + kLongestView <= tracks.now()) {
    due.push_back(in_view_.front());
    in_view_.pop_front();
  }
  std::sort(due.begin(), due.end());
  for (const Index creation : due) {
    const Track& track = tracks[creation];
    if (track.merged_into != kNone || track.level >= 3 || track.history.empty()) continue;
    Selection selection;
    const Iteration since = track.history.between(0, track.last).front().iteration;
    if (select_for_gone(tracks, creation, false, selection)) {
      make(tracks, selection, 3, since, false);
    } else if (track.first == 0 && select_for_gone(tracks, creation, true, selection)) {
      make(tracks, selection, 3, since, true);
    }
  }
}

bool Grouping::select_for_gone(Tracks& tracks, Index creation, bool first, Selection& selection) {
  const std::span<const Sighting> own = tracks[creation].history.between(0, tracks[creation].last);
  const Iteration begin = own.front().iteration;
  const Iteration end = own.back().iteration;
  const auto presence_of = [&](Index track) {
    Presence presence(end - begin + 1);
    for (const Sighting& sighting : tracks[track].history.between(begin, end))
      presence.set(sighting.iteration - begin);
    return PresentPoint{track, std::move(presence)};
  };
  std::vector<PresentPoint> previous;
  std::vector<PresentPoint> next;
  for (const Index track : tracks.seen_between(begin, end)) {
    if (track == creation) continue;
    const bool usable = tracks[track].level >= 3 || !first || tracks[track].first == 0;
    if (usable) (tracks[track].level >= 3 ? previous : next).push_back(presence_of(track));
  }
  return select_by_total(presence_of(creation), std::move(previous), std::move(next), first, selection);
}

void Grouping::make(Tracks& tracks, const Selection& selection, int level, Iteration since, bool starts) {
  std::vector<Index> points = selection.points;
  std::size_t references = selection.previous;
  if (starts) {
    const auto was_first = [&](Index track) { return tracks[track].first == 0; };
    references = static_cast<std::size_t>(std::stable_partition(points.begin(), points.end(), was_first) -
                                          points.begin());
  }
  Slot slot;
  slot.starts = starts;
  slot.group = std::make_unique<Group>(std::move(points), references, level);
  average_between(*slot.group, tracks, since, tracks.now());
  if (slot.group->iterations() == 0 || !place(slot, tracks)) return;
  const auto g = static_cast<Index>(groups_.size());
  groups_.push_back(std::move(slot));
  ++standing_;
  if (level > 1) ++made_;
  for (const Index track : groups_[g].group->points()) {
    tracks[track].groups.push_back(g);
    if (tracks[track].level < level) take_home(tracks, track, g);
  }
  place_landmarks(g, tracks);
}

void Grouping::average_between(Group& group, const Tracks& tracks, Iteration first, Iteration last) {
  // The first member's observations tell which iterations can count at all.
  for (const Sighting& sighting : tracks[group.points().front()].history.between(first, last)) {
    if (gather(group, tracks, sighting.iteration)) {
      group.add(seen_, static_cast<Basis>(options_.basis), least_basis_m_);
    }
  }
}

bool Grouping::gather(const Group& group, const Tracks& tracks, Iteration iteration) {
  seen_.clear();
  for (const Index track : group.points()) {
    const Vec3* point = tracks[track].history.find(iteration);
    if (point == nullptr) return false;
    seen_.push_back(*point);
  }
  return true;
}

bool Grouping::place(Slot& slot, const Tracks& tracks) {
  places_.clear();
  for (std::size_t m = 0; m < slot.group->references(); ++m) {
    const Track& track = tracks[slot.group->points()[m]];
    places_.push_back(slot.starts ? track.first_seen : track.position);
  }
  return slot.group->place(places_);
}

void Grouping::place_landmarks(Index g, Tracks& tracks) {
  const Group& group = *groups_[g].group;
  for (std::size_t m = 0; m < group.points().size(); ++m) {
    const Index track = group.points()[m];
    if (tracks[track].home != g) continue;
    tracks.place(track, group.position(m));
  }
}

void Grouping::take_home(Tracks& tracks, Index index, Index g) {
  Track& track = tracks[index];
  const Index old = track.home;
  track.home = g;
  track.level = groups_[g].group->level();
  ++groups_[g].homed;
  if (old != kNone && --groups_[old].homed == 0) take_down(tracks, old);
}

void Grouping::take_down(Tracks& tracks, Index g) {
  for (const Index track : groups_[g].group->points()) {
    std::erase(tracks[track].groups, g);
    if (tracks[track].home == g) tracks[track].home = kNone;  // it stays where it is
  }
  groups_[g].group.reset();
  groups_[g].homed = 0;
  --standing_;
}

bool Grouping::can_merge(const Tracks& tracks, Index from) const {
  const std::vector<Index>& groups = tracks[from].groups;
  return std::all_of(groups.begin(), groups.end(), [&](Index g) { return groups_[g].group->level() == 1; });
}

void Grouping::merge(Tracks& tracks, Index into, Index from) {
  const std::vector<Index> temporary = tracks[from].groups;
  for (const Index g : temporary) take_down(tracks, g);
  const std::span<const Sighting> given = tracks[from].history.between(0, tracks.now());
  const std::vector<Sighting> gained(given.begin(), given.end());
  tracks.merge(into, from);
  for (const Index g : tracks[into].groups) {
    for (const Sighting& sighting : gained)
      average_between(*groups_[g].group, tracks, sighting.iteration, sighting.iteration);
    if (place(groups_[g], tracks)) place_landmarks(g, tracks);
  }
}

}  // namespace hallway::slam_point::thesis
