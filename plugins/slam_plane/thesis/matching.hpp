// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "slam_plane/thesis/observation.hpp"
#include "slam_plane/thesis/plane_track.hpp"
#include "slam_plane/thesis/track_options.hpp"

namespace hallway::slam_plane::thesis {

/// In how far two segments are one wall: what matching judges, with the robot's motion or without.
struct MatchTerms {
  double angle = 0.0;     ///< between the normals, in [0, pi] [rad]
  double distance = 0.0;  ///< between the lines [m]
  double overlap = 0.0;   ///< of the extents, as a share of the shorter one; negative: apart
  Iteration age = 1;      ///< iterations between them; 1 where time does not matter
};

/// A score in (0, 100], 25 for each of normal, distance, extent and recency; nothing if one of them is out of bounds (Rules 1, 10).
std::optional<double> match_score(const MatchTerms& terms, const MatchOptions& options);

/// Compares what two iterations saw, each in its robot frame, without any pose (Rule 1): lines by their distance from the robot, extents from the foot of the
/// perpendicular. Both stay as they are however the robot turns.
MatchTerms tracked_terms(const TimedObservation& seen, const TimedObservation& before,
                         const MatchOptions& options);

/// Compares two segments of one frame, such as an observation and a wall in the map's (Rule 11).
MatchTerms placed_terms(const Segment& seen, const Segment& wall, const MatchOptions& options);

/// One list of tracks for each of the stages in which matches are sought: the current submap's tracks first, then its neighbours', and so on (Rule 22).
using MatchStages = std::span<const std::vector<const PlaneTrack*>>;

/// Takes each observation of one iteration for a recently seen track, or for none: the best pairs first, each track once. A track of a later stage has to be better by a tenth of the
/// greatest score for each stage; one given in several stages counts in its first one. One that was out of view is asked last, whatever its stage. Ties go to the one whose extent is more like it, then to the earlier observation, then to the earlier track.
///
/// @returns for each observation the track, or null. O(observations x tracks seen recently).
std::vector<const PlaneTrack*> match_tracks(std::span<const TimedObservation> seen, MatchStages stages,
                                            const MatchOptions& options);

}  // namespace hallway::slam_plane::thesis
