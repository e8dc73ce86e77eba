// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/steps.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "slam_plane/thesis/matching.hpp"

namespace hallway::slam_plane::thesis {
namespace {

using TrackList = std::vector<const PlaneTrack*>;

void add_members(const Submap& submap, const State& state, TrackList& list) {
  for (const Member& member : submap.members()) list.push_back(&state.tracks[member.track]);
}

/// Tracks in the order in which they are asked (Rule 22).
std::vector<TrackList> stages(const State& state) {
  std::vector<TrackList> lists(3);
  if (state.carried.current != kNoSubmap) {
    const Submap& current = state.submaps[state.carried.current];
    add_members(current, state, lists[0]);
    for (const SubmapIndex linked : current.links) add_members(state.submaps[linked], state, lists[1]);
  }
  for (const TrackId id : state.recent) lists[2].push_back(&state.tracks[id]);
  return lists;
}

/// Tracks seen in the last few iterations.
void keep_recent(const Options& options, State& state) {
  std::erase_if(state.recent, [&](TrackId id) {
    return state.tracks[id].empty() ||
           state.tracks[id].newest().iteration + options.recent_iterations < state.now;
  });
  std::vector<TrackId> all;
  std::set_union(state.recent.begin(), state.recent.end(), state.seen.begin(), state.seen.end(),
                 std::back_inserter(all));
  state.recent.swap(all);
}

/// The unassigned track goes on as `to`, which was out of view.
void hand_over(TrackId from, TrackId to, State& state) {
  PlaneTrack& track = state.tracks[to];
  const PlaneTrack& young = state.tracks[from];
  const Iteration last = track.empty() ? -1 : track.newest().iteration;
  for (std::size_t i = young.lower_bound(last + 1); i < young.size(); ++i) track.push(young[i]);
  state.pairs.forget(from);
  state.tracks[from].truncate(-1);
  std::ranges::replace(state.recent, from, to);
  make_set(state.recent);
  state.met_again.push_back(to);
}

}  // namespace

void add_planes(std::span<const WallObservation> given, const Options& options, State& state) {
  const auto [observations, given_at] = FrameObservations(given, state.now);
  if (state.start < 0 && !observations.empty()) state.start = state.now;
  const std::vector<TrackList> lists = stages(state);
  const std::vector<const PlaneTrack*> matched = match_tracks(observations, lists, options.match());
  state.matches.clear();
  state.seen.clear();
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const TrackId id =
        matched[i] != nullptr ? matched[i]->id() : state.tracks.create(state.now, given_at[i]).id();
    if (matched[i] == nullptr) state.carried.unassigned.push_back({id, -1, std::nullopt});
    state.tracks[id].push(observations[i]);
    state.matches.push_back({given_at[i], id});
    state.seen.push_back(id);
  }
  std::ranges::sort(state.seen);
  keep_recent(options, state);
  chart_submaps(state);
}

void chart_submaps(State& state) {
  std::vector<SubmapIndex> all;
  for (const TrackId id : state.seen) {
    const auto& of = state.tracks.submaps(id);
    all.insert(all.end(), of.begin(), of.end());
    const auto& charted = state.tracks.charted(id);
    std::copy_if(charted.begin(), charted.end(), std::back_inserter(all),
                 [&](SubmapIndex submap) { return !state.submaps[submap].members().empty(); });
  }
  std::ranges::sort(all);
  state.chart.clear();
  for (const SubmapIndex submap : all) {
    if (state.chart.empty() || state.chart.back().first != submap) state.chart.emplace_back(submap, 0);
    ++state.chart.back().second;
  }
}

std::vector<TrackId> map_matches(const Segment& segment, const Options& options, const State& state) {
  std::vector<std::pair<double, TrackId>> found;
  const MatchOptions bounds = options.map_match();
  state.map.visit_near(segment.middle(), [&](TrackId id) {
    const Segment wall = state.map.find(id)->reference.place.segment();
    const std::optional<double> score = match_score(placed_terms(segment, wall, bounds), bounds);
    if (score) found.emplace_back(-*score, id);
  });
  std::ranges::sort(found);
  std::vector<TrackId> result;
  for (const auto& [score, id] : found) result.push_back(id);
  return result;
}

void match_with_map(const Options& options, State& state) {
  state.met_again.clear();
  if (!state.carried.located) return;
  const Pose2& T_map_robot = state.carried.motion.pose();
  std::vector<Unassigned> kept;
  for (Unassigned entry : state.carried.unassigned) {
    const PlaneTrack& track = state.tracks[entry.track];
    if (track.empty()) continue;
    bool handed = false;
    entry.part_of.reset();
    if (entry.joined < 0 && track.newest().iteration == state.now - 1) {
      for (const TrackId id : map_matches(T_map_robot * track.newest().segment, options, state)) {
        if (id == entry.track) continue;
        if (!state.tracks[id].empty() && state.tracks[id].newest().iteration == state.now - 1) {
          entry.part_of = id;
        } else {
          hand_over(entry.track, id, state);
          handed = true;
        }
        break;
      }
    }
    if (!handed) kept.push_back(entry);
  }
  state.carried.unassigned.swap(kept);
}

}  // namespace hallway::slam_plane::thesis
