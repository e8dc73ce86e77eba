// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "wall_follower/core/chart.hpp"
#include "wall_follower/core/loop_finder.hpp"

namespace hallway::wall_follower {

/// How the reckoned way is corrected: turned about a place, which then moves.
struct Correction {
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();  ///< [m]
  int turns = 0;                                ///< of 90 degrees, to the left

  Vec2 of(const Vec2& at) const { return to + turned(at - from, turns * kQuarter); }
};

/// The first sight of a landmark of the wall. @param same  of a wall that leads back, in the order of the way
std::size_t first_sight(const std::vector<SameLandmark>& same, std::size_t landmark);

/// The pairs from the one on that says best how long a lap is.
std::vector<SameLandmark> from_surest(const Chart& chart, const std::vector<SameLandmark>& same);

/// The wall that is followed leads back: it becomes a circuit of one lap. Landmarks that were seen twice are one, with their visits added, and an edge leads from the end of the lap to its beginning. Landmarks before the
/// lap are left out from the first one on that is seen again at its end; what is left leads into the lap.
/// What the reckoned way of the lap does not lead back by is shared out over it. @return the correction of what is behind the lap [m]
Vec2 close_loop(Chart& chart, const std::vector<SameLandmark>& same, const Options& options);

/// The wall that is followed is a known one: its landmarks are left out, and the crossing to it: where exactly that meets the wall is not certain. Six landmarks or more before the known ones are of another wall, and stay.
/// @return the correction of the reckoned way
Correction join_circuit(Chart& chart, std::size_t circuit, const std::vector<SameLandmark>& same);

/// What a correction that grows along a way comes to at a part of it.
Vec2 share_of(const Vec2& correction, double from_m, double to_m, double at_m);

/// Whether two landmarks may be one by kind, direction, and direction of their walls.
bool may_be_one(const Node& a, const Node& b);

/// The landmark of a circuit that a landmark may be, the nearest one by the reckoned way. O(lap).
std::optional<std::size_t> landmark_near(const Chart& chart, const Circuit& circuit, const Node& node,
                                         double within_m);

/// Likewise, the nearest one along the wall. @param station_m  way along it since the lap's beginning, where the landmark is
std::optional<std::size_t> landmark_at(const Chart& chart, const Circuit& circuit, const Node& node,
                                       double station_m, double within_m);

}  // namespace hallway::wall_follower
