// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <initializer_list>
#include <vector>

#include "slam_plane/thesis/state.hpp"
#include "slam_plane/thesis/steps.hpp"
#include "unit/slam_plane_thesis/walls.hpp"

namespace hallway::slam_plane::thesis::test {

/// A wall across the way of a robot that drives along x, `x` metres ahead of the origin.
inline Segment across(double x) {
  return {{Vec2(x, 3), Vec2(x, -3)}};
}

/// What an iteration of the mapper works on, made by hand: tracks that saw walls at observations times from a robot that drives along x, and submaps of them. The map's frame is the world's. `kAlong` should be the first wall
/// and be seen all the time, and the others stand across: then each of them is compared with it and with nothing else, and rules about comparisons do not matter.
class SmallWorld {
 public:
  SmallWorld() : state(options) { state.start = 0; }

  /// A track that saw a wall, but for what `hidden(k)` says, in some intervals.
  template <typename Path, typename Hide>
  TrackId see(const Segment& wall, std::initializer_list<Interval> times, const Path& path,
              const Hide& hidden) {
    PlaneTrack& track = state.tracks.create(times.begin()->first);
    for (const Interval& time : times) {
      for (Iteration k = time.first; k <= time.last; ++k)
        track.push(seen(wall, path(k), k, hidden(k).left, hidden(k).right));
    }
    walls.push_back(wall);
    return track.id();
  }

  template <typename Path>
  TrackId see(const Segment& wall, std::initializer_list<Interval> times, const Path& path) {
    return see(wall, times, path, [](Iteration) { return Hidden{}; });
  }

  TrackId see(const Segment& wall, std::initializer_list<Interval> times) {
    return see(wall, times, straight);
  }

  /// The wall of a track is seen again, whole but for a part beside its right end.
  void see_again(TrackId id, const Interval& time, double hidden = 0.0) {
    for (Iteration k = time.first; k <= time.last; ++k)
      state.tracks[id].push(seen(walls[id], straight(k), k, 0.0, hidden));
  }

  /// A submap of tracks, computed from what they saw, and not in the map yet. It becomes the current one.
  SubmapIndex group(std::initializer_list<TrackId> members, std::initializer_list<SubmapIndex> links = {}) {
    const SubmapIndex made = state.submaps.size();
    state.submaps.emplace_back(made, state.start);
    for (const TrackId id : members) {
      state.submaps[made].add(id, state.start, false);
      state.tracks.submaps(id).push_back(made);
    }
    for (const SubmapIndex linked : links) {
      state.submaps[made].links.push_back(linked);
      state.submaps[linked].links.push_back(made);
    }
    Iteration newest = 0;
    for (const TrackId id : members) newest = std::max(newest, state.tracks[id].newest().iteration);
    state.submaps[made].compute(state.pairs, state.tracks, options, newest);
    state.carried.current = made;
    return made;
  }

  /// Places a submap where its walls are.
  void fix(SubmapIndex index) {
    for (const Member& member : state.submaps[index].members()) {
      Reference truth;
      truth.place = {walls[member.track].middle(), walls[member.track].direction(),
                     walls[member.track].length(), true};
      truth.known[kEndA] = truth.known[kEndB] = true;
      state.submaps[index].anchors.push_back({member.track, truth});
    }
    const std::vector<SubmapIndex> changed{index};
    state.map.build(changed, state.submaps, state.tracks);
  }

  /// A submap in the map.
  SubmapIndex fixed_group(std::initializer_list<TrackId> members,
                          std::initializer_list<SubmapIndex> links = {}) {
    const SubmapIndex made = group(members, links);
    fix(made);
    return made;
  }

  /// Makes it iteration k: in view is what was seen then.
  void set_now(Iteration k) {
    state.now = k;
    state.seen.clear();
    for (TrackId id = 0; id < state.tracks.size(); ++id) {
      if (!state.tracks[id].empty() && state.tracks[id].newest().iteration == k) state.seen.push_back(id);
    }
    chart_submaps(state);
  }

  /// How far a plane of the map is from its wall [m]; 1e9 if the map does not have it.
  double error_in_map(TrackId id) const {
    const PlaneLandmark* plane = state.map.find(id);
    if (plane == nullptr) return 1e9;
    const Segment segment = plane->reference.place.segment();
    return std::max((segment.end[kEndA] - walls[id].end[kEndA]).norm(),
                    (segment.end[kEndB] - walls[id].end[kEndB]).norm());
  }

  Options options;
  State state;
  std::vector<Segment> walls;  ///< by track
};

}  // namespace hallway::slam_plane::thesis::test
