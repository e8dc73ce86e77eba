// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/steps.hpp"

#include <algorithm>

namespace hallway::slam_plane::thesis {
namespace {

constexpr int kBeginning = 10;      // iterations in which planes join the very first submap at once
constexpr int kFirstReadings = 3;   // of the planes of the very first submap
constexpr int kTryAgainAfter = 20;  // iterations in which a submap has not placed a track that joined it
constexpr int kLeastLinks = 2;      // Rule 8
constexpr std::size_t kLookThrough = 64;  // submaps that are looked through for a link

void join(TrackId track, SubmapIndex submap, bool link, State& state) {
  state.submaps[submap].add(track, state.now, link);
  state.tracks.submaps(track).push_back(submap);
}

bool has(const std::vector<TrackId>& tracks, TrackId track) {
  return std::ranges::find(tracks, track) != tracks.end();
}

/// Whether a comparison with another track tells where a track is. One that was rolled back for a short comparison has to wait for a longer one (Rule 32).
bool comparable(TrackId track, TrackId member, const Options& options, State& state) {
  const int least = std::max(1, options.min_interval * state.hints.strikes(state.tracks.name(track)));
  return member != track && state.pairs.update(state.tracks[track], state.tracks[member]).shared() >= least;
}

bool comparable(TrackId track, const Submap& submap, const Options& options, State& state) {
  return std::ranges::any_of(submap.members(), [&](const Member& member) {
    return comparable(track, member.track, options, state);
  });
}

bool beginning(const State& state) {
  return state.now < state.start + kBeginning;
}

/// Joins a submap in which all members were visible together with it (Rule 7).
bool try_join(TrackId track, SubmapIndex submap, const Options& options, State& state) {
  if (!state.hints.may_join(state.tracks.name(track), submap) || state.submaps[submap].contains(track))
    return false;
  const int least = std::min<int>(options.min_readings, static_cast<int>(state.tracks[track].size()));
  if (!fits(state.submaps[submap].common(state.tracks), state.tracks[track], least)) return false;
  if (!beginning(state) && !comparable(track, state.submaps[submap], options, state)) return false;
  join(track, submap, false, state);
  return true;
}

/// The submaps that a link is looked for in: breadth first from the current one (Rule 12).
std::vector<SubmapIndex> reachable(const State& state) {
  std::vector<SubmapIndex> order;
  if (state.carried.current == kNoSubmap) return order;
  order.push_back(state.carried.current);
  for (const auto& [submap, count] : state.chart) {
    if (submap != state.carried.current && count >= kLeastLinks) order.push_back(submap);
  }
  for (std::size_t i = 0; i < order.size() && order.size() < kLookThrough; ++i) {
    for (const SubmapIndex linked : state.submaps[order[i]].links) {
      add_new(order, linked);
    }
  }
  return order;
}

SubmapIndex make_submap(State& state) {
  const SubmapIndex index = state.submaps.size();
  state.submaps.emplace_back(index == 0 ? 0 : state.submaps.back().id() + 1, state.now);
  return index;
}

void connect(SubmapIndex a, SubmapIndex b, State& state) {
  state.submaps[a].links.push_back(b);
  state.submaps[b].links.push_back(a);
}

/// Members of submaps about the current one that can link them to a new one that `newcomer` causes, those of one submap first (Rules 8, 9, 12), and the submaps that they are of.
struct Links {
  std::vector<TrackId> tracks;
  std::vector<SubmapIndex> submaps;
  bool compared = false;  ///< one of them can be compared with the newcomer
};

void take_links(SubmapIndex base, TrackId newcomer, const Options& options, State& state, Links& links) {
  bool taken = false;
  for (const bool compared : {true, false}) {
    std::vector<const PlaneTrack*> list;
    for (const Member& member : state.submaps[base].members()) {
      if (member.track == newcomer || !member.reference.valid() || has(links.tracks, member.track)) continue;
      if (comparable(newcomer, member.track, options, state) == compared)
        list.push_back(&state.tracks[member.track]);
    }
    const int wanted = options.link_planes - static_cast<int>(links.tracks.size());
    for (const int i : linking_members(list, state.tracks[newcomer], wanted)) {
      links.tracks.push_back(list[static_cast<std::size_t>(i)]->id());
      links.compared = links.compared || compared;
      taken = true;
    }
  }
  if (taken) links.submaps.push_back(base);
}

void begin(TrackId track, const Links& links, State& state) {
  const SubmapIndex made = make_submap(state);
  for (const TrackId id : links.tracks) join(id, made, true, state);
  join(track, made, false, state);
  for (const SubmapIndex base : links.submaps) connect(made, base, state);
  state.carried.current = made;
}

/// A new submap of a track and of members of older ones that link them.
bool begin_linked(TrackId track, const Options& options, State& state) {
  Links several;
  for (const SubmapIndex base : reachable(state)) {
    if (!state.submaps[base].placed) continue;
    Links one;
    take_links(base, track, options, state, one);
    if (one.compared && one.tracks.size() >= kLeastLinks) {
      begin(track, one, state);
      return true;
    }
    take_links(base, track, options, state, several);
  }
  if (!several.compared || several.tracks.size() < kLeastLinks) return false;
  begin(track, several, state);
  return true;
}

/// A new submap of what is seen now, placed by where the motion model has the robot: one shared plane has to do (Rules 8, 29).
bool begin_after_motion(TrackId track, State& state) {
  if (!state.carried.after_motion) return false;
  const SubmapIndex made = make_submap(state);
  state.submaps[made].by_motion = true;
  for (const TrackId id : state.seen) {
    if (id == track || state.map.find(id) == nullptr) continue;
    join(id, made, true, state);
  }
  join(track, made, false, state);
  if (state.carried.current != kNoSubmap) connect(made, state.carried.current, state);
  state.carried.current = made;
  return true;
}

bool begin_first(TrackId track, State& state) {
  if (!state.submaps.empty()) return false;
  const SubmapIndex made = make_submap(state);
  join(track, made, false, state);
  state.carried.current = made;
  return true;
}

bool assign(TrackId track, const Options& options, State& state) {
  if (begin_first(track, state)) return true;
  if (state.carried.current != kNoSubmap) {
    if (try_join(track, state.carried.current, options, state)) return true;
    const std::vector<SubmapIndex> linked = state.submaps[state.carried.current].links;
    for (const SubmapIndex submap : linked) {
      if (try_join(track, submap, options, state)) return true;
    }
  }
  return begin_linked(track, options, state) || begin_after_motion(track, state);
}

void assign_unassigned(const Options& options, State& state) {
  std::vector<Unassigned> kept;
  const int least = beginning(state) ? kFirstReadings : options.min_readings;
  for (Unassigned entry : state.carried.unassigned) {
    const PlaneTrack& track = state.tracks[entry.track];
    if (track.empty() || state.map.find(entry.track) != nullptr) continue;
    const bool waited = entry.joined < 0 || entry.joined + kTryAgainAfter <= state.now;
    const bool ready = track.newest().iteration == state.now && static_cast<int>(track.size()) >= least &&
                       !entry.part_of.has_value() && waited;
    if (ready && assign(entry.track, options, state)) entry.joined = state.now;
    if (track.newest().iteration + forget_after(options) >= state.now) {
      kept.push_back(entry);
    } else if (state.tracks.submaps(entry.track).empty()) {
      state.pairs.forget(entry.track);
      state.tracks[entry.track].forget();
    }
  }
  state.carried.unassigned.swap(kept);
}

/// What was met again gets a submap with what is seen now, unless it has enough of them (Rule 21).
void regroup_met_again(const Options& options, State& state) {
  for (const TrackId id : state.met_again) {
    if (!std::ranges::binary_search(state.seen, id)) continue;
    if (state.tracks.submaps(id).size() >= static_cast<std::size_t>(options.max_references)) continue;
    if (state.carried.current == kNoSubmap || state.submaps[state.carried.current].contains(id)) continue;
    begin_linked(id, options, state);
  }
}

/// The submap with the most tracks in view, the last one of equals (Rule 22).
void choose_current(State& state) {
  SubmapIndex best = state.carried.current;
  int most = 0;
  for (const auto& [submap, count] : state.chart) {
    if (submap == state.carried.current) most = count;
  }
  for (const auto& [submap, count] : state.chart) {
    if (count <= most) continue;
    most = count;
    best = submap;
  }
  state.carried.current = best;
  if (best != kNoSubmap) state.submaps[best].current_at = state.now;
}

/// All mapped planes that each plane in view may be, and the submap that would have every plane in view if those that are one were merged (Rule 37).
void fix_after_motion(const Options& options, State& state) {
  if (!state.carried.after_motion || !state.carried.located || state.met_again.empty()) return;
  std::vector<std::vector<SubmapIndex>> of;
  std::vector<TrackId> mapped;
  for (const TrackId id : state.seen) {
    const PlaneLandmark* plane = state.map.find(id);
    if (plane == nullptr) continue;
    std::vector<SubmapIndex> submaps;
    for (const TrackId same : map_matches(plane->reference.place.segment(), options, state)) {
      const auto& has = state.tracks.submaps(same);
      submaps.insert(submaps.end(), has.begin(), has.end());
    }
    std::ranges::sort(submaps);
    of.push_back(submaps);
    mapped.push_back(id);
  }
  if (of.size() < 2) return;
  for (const SubmapIndex submap : of.front()) {
    const bool all = std::ranges::all_of(of, [&](const std::vector<SubmapIndex>& submaps) {
      return std::ranges::binary_search(submaps, submap);
    });
    if (!all || state.submaps[submap].by_motion) continue;
    state.carried.current = submap;
    state.carried.after_motion = false;
    for (const TrackId id : mapped) {
      if (!state.submaps[submap].contains(id)) state.tracks.charted(id).push_back(submap);
    }
    return;
  }
}

}  // namespace

void manage_submaps(const Options& options, State& state) {
  assign_unassigned(options, state);
  fix_after_motion(options, state);
  regroup_met_again(options, state);
  choose_current(state);
}

}  // namespace hallway::slam_plane::thesis
