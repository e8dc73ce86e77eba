// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/steps.hpp"

#include <algorithm>
#include <utility>

namespace hallway::slam_plane::thesis {
namespace {

constexpr int kForgetAfter = 50;       // iterations, or the limit of roll backs
constexpr Iteration kLookEvery = 20;   // iterations
constexpr std::size_t kFewEmpty = 32;  // empty submaps that are left in the list

/// Whether a track is not in the map and was not seen for so long that it never will be.
bool came_to_nothing(TrackId id, const Options& options, const State& state) {
  const PlaneTrack& track = state.tracks[id];
  if (state.map.find(id) != nullptr) return false;
  return track.empty() || track.newest().iteration + forget_after(options) < state.now;
}

/// Whether a placed submap other than this one tells as much of the ends of a plane, from as many observations: then the map does not take the plane from this one alone.
bool told_elsewhere(const Member& member, SubmapIndex index, const State& state) {
  const auto& of = state.tracks.submaps(member.track);
  return std::ranges::any_of(of, [&](SubmapIndex other) {
    if (other == index || !state.submaps[other].placed) return false;
    const Member* there = state.submaps[other].find(member.track);
    if (there == nullptr || !there->reference.valid()) return false;
    const bool(&known)[2] = member.reference.known;
    return there->reference.shared >= member.reference.shared &&
           (there->reference.known[kEndA] || !known[kEndA]) &&
           (there->reference.known[kEndB] || !known[kEndB]);
  });
}

bool is_stale(SubmapIndex index, const Options& options, const State& state) {
  const Submap& submap = state.submaps[index];
  if (submap.members().empty() || index == state.carried.current) return false;
  if (std::max(submap.created(), submap.current_at) + forget_after(options) >= state.now) return false;
  return std::ranges::all_of(submap.members(), [&](const Member& member) {
    if (!member.link) return came_to_nothing(member.track, options, state);
    return !submap.placed || !member.reference.valid() || told_elsewhere(member, index, state);
  });
}

/// Links what a submap is linked to with what it was made from instead.
void bypass(SubmapIndex index, State& state) {
  const std::vector<SubmapIndex> linked = state.submaps[index].links;
  for (const SubmapIndex a : linked) {
    std::erase(state.submaps[a].links, index);
    for (const SubmapIndex b : linked) {
      auto& of = state.submaps[a].links;
      if (a == b || std::min(a, b) > index || std::ranges::find(of, b) != of.end()) continue;
      of.push_back(b);
    }
  }
}

void drop(SubmapIndex index, State& state) {
  bypass(index, state);
  for (const Member& member : state.submaps[index].members()) {
    auto& of = state.tracks.submaps(member.track);
    std::erase(of, index);
    if (member.link || !of.empty()) continue;
    state.pairs.forget(member.track);
    state.tracks[member.track].forget();
  }
  state.submaps[index] = Submap(state.submaps[index].id(), state.submaps[index].created());
  ++state.dropped_submaps;
}

/// Releases the tracks of which nothing is left. A roll back to before this finds none of them in what it restores.
void release_unused(State& state) {
  for (TrackId id = 0; id < state.tracks.size(); ++id) {
    if (state.tracks.is_free(id) || !state.tracks[id].empty()) continue;
    if (!state.tracks.submaps(id).empty() || state.map.find(id) != nullptr) continue;
    state.pairs.forget(id);
    state.map.forget(id);
    std::erase(state.recent, id);
    std::erase_if(state.carried.unassigned, [&](const Unassigned& entry) { return entry.track == id; });
    state.tracks.release(id);
  }
  const std::vector<LandmarkId> names = state.tracks.names();
  state.hints.forget_tracks([&](LandmarkId name) { return std::ranges::binary_search(names, name); });
}

}  // namespace

int forget_after(const Options& options) {
  return std::max(kForgetAfter, options.roll_back_limit);
}

void prune_stale(const Options& options, State& state) {
  if (state.now % kLookEvery != 0) return;
  for (SubmapIndex index = 1; index < state.submaps.size(); ++index) {  // the first one holds the map's frame
    if (is_stale(index, options, state)) drop(index, state);
  }
  release_unused(state);
}

std::vector<SubmapIndex> close_up(State& state) {
  if (state.dropped_submaps < kFewEmpty || 2 * state.dropped_submaps < state.submaps.size()) return {};
  std::vector<SubmapIndex> now_at(state.submaps.size(), kNoSubmap);
  std::vector<Submap> kept;
  for (SubmapIndex index = 0; index < state.submaps.size(); ++index) {
    if (index > 0 && state.submaps[index].members().empty()) continue;
    now_at[index] = kept.size();
    kept.push_back(std::move(state.submaps[index]));
  }
  state.submaps.swap(kept);
  state.dropped_submaps = 0;
  const auto renumber = [&](std::vector<SubmapIndex>& list) {
    for (SubmapIndex& index : list) index = now_at[index];
    std::erase(list, kNoSubmap);
  };
  for (Submap& submap : state.submaps) renumber(submap.links);
  for (TrackId id = 0; id < state.tracks.size(); ++id) {
    renumber(state.tracks.submaps(id));
    renumber(state.tracks.charted(id));
  }
  if (state.carried.current != kNoSubmap) state.carried.current = now_at[state.carried.current];
  state.hints.renumber([&](SubmapIndex index) { return index < now_at.size() ? now_at[index] : index; });
  return now_at;
}

}  // namespace hallway::slam_plane::thesis
