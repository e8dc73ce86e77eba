// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "slam_point/core/index/pairing.hpp"
#include "slam_point/core/submaps/submap_graph.hpp"

namespace hallway::slam_point {

/// The landmarks that were found to move: follows each from frame to frame by where it was and how fast it went, so that it
/// stays one landmark, and remembers where it was last.
class MotionTracks {
 public:
  /// A landmark that moves.
  struct Track {
    Index landmark = kNone;
    std::uint32_t sightings = 0;
    Index submap = kNone;       ///< the one active when it was last seen
    Vec3 place = Vec3::Zero();  ///< in that submap's frame [m]
  };
  /// A point to be found a track for.
  struct Candidate {
    Index observation = kNone;
    Vec3 place = Vec3::Zero();  ///< map frame [m]
  };

  /// `graph` must outlive it. `reach_m`: farthest from its prediction that a point is looked for [m].
  MotionTracks(const SubmapGraph& graph, double reach_m) : graph_(graph), reach_m_(reach_m) {}

  /// Begins to follow a landmark that is at `place` in frame `frame` (map frame, metres), after `sightings` so far.
  /// `velocity`: metres per frame.
  void begin(Index landmark, std::uint64_t frame, const Vec3& place, const Vec3& velocity,
             std::uint32_t sightings);

  /// Gives candidates to the landmarks that were followed until a few frames ago, nearest to where they are expected first, one
  /// to one, and calls take(observation, landmark) for each. O((tracks + candidates) log).
  template <typename Take>
  void follow(std::uint64_t frame, const std::vector<Candidate>& candidates, Take&& take) {
    match(frame, candidates);
    for (const Pairing& match : matches_) {
      Live& live = live_[match.other];
      const Candidate& candidate = candidates[match.point];
      if (live.last_frame == frame || taken_[match.point] != 0) continue;
      taken_[match.point] = 1;
      see(live, frame, candidate.place);
      take(candidate.observation, tracks_[live.track].landmark);
    }
    forget(frame);
  }

  /// All that were ever found, in the order in which they were.
  const std::vector<Track>& tracks() const { return tracks_; }

  void clear();

 private:
  /// A track that may be continued.
  struct Live {
    std::size_t track = 0;
    std::uint64_t last_frame = 0;
    Vec3 place = Vec3::Zero();     // map frame
    Vec3 velocity = Vec3::Zero();  // per frame
  };
  struct Expected {
    Vec3 place = Vec3::Zero();
    double reach_m = 0.0;
    Index live = 0;
  };

  void match(std::uint64_t frame, const std::vector<Candidate>& candidates);
  void see(Live& live, std::uint64_t frame, const Vec3& place);
  void forget(std::uint64_t frame);

  const SubmapGraph& graph_;
  double reach_m_;
  std::vector<Track> tracks_;
  std::vector<Live> live_;
  std::vector<Expected> expected_;
  std::vector<Pairing> matches_;  // of candidates and live tracks
  std::vector<std::uint8_t> taken_;
};

}  // namespace hallway::slam_point
