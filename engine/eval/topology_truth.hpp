// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "eval/driven_way.hpp"
#include "eval/floor_plan.hpp"

namespace hallway::eval {

/// What a place truly is, to a robot that follows walls on its right.
enum class TrueKind : std::uint8_t {
  kStep,     ///< the wall goes on nearer or farther; or, next to an opening or an end, it ends or begins
  kWallEnd,  ///< the wall ends and none goes on in line
  kRoom,     ///< an opening to a room
  kHallway,  ///< an opening to a hallway
  kDeadEnd,  ///< the wall at the end of a hallway
};

/// A place that a robot drove by and that is worth a node.
struct TrueNode {
  TrueKind kind = TrueKind::kStep;
  int direction =
      0;  ///< of kStep and kWallEnd: +1 the wall goes on farther from the robot, -1 nearer; else 0
  /// Of kStep the size, +Inf where no wall is on its other side; of kWallEnd +Inf; of openings the width, of dead ends the length.
  double size_m = 0.0;
  /// Where it is in the world: of openings and dead ends from one side to the other, of others one point twice.
  Vec2 from = Vec2::Zero();
  Vec2 to = Vec2::Zero();
  /// false: a chart may have it or not. Those are steps and openings that are small, the edges of openings, and dead ends.
  bool is_demanded = true;

  /// Metres from a place to the nearest of its places.
  double distance_to(const Vec2& place) const;
};

/// A time that the robot drove by a node: how far it had driven when that, of an opening its first edge, was abreast of it.
struct TruePass {
  std::size_t node = 0;  ///< index in TopologyTruth::nodes
  double way_m = 0.0;
};

/// What a chart is scored against.
struct TopologyTruth {
  std::vector<TrueNode> nodes;   ///< in the order in which the robot first met them
  std::vector<TruePass> passes;  ///< by way
  bool came_around = false;      ///< the robot followed a part of a wall that it had followed a loop before
};

/// What find_truth() counts as what. Metres.
struct TruthSettings {
  double reach_m = 1.0;           ///< to the robot's right, from its origin, in which a wall is followed
  double accepted_step_m = 0.04;  ///< the least step that is a node
  double demanded_step_m = 0.13;  ///< the least one that is demanded
  double accepted_gap_m = 0.25;  ///< the least gap between walls that is an opening; a narrower one is a step
  double demanded_gap_m = 0.5;   ///< the least one that is demanded
  double widest_m = 4.0;         ///< a wider gap is the wall's end
  double aside_m = 0.5;          ///< a wall that much beside the line of another one is still in line with it
  double end_m =
      0.4;  ///< to where before its end a wall has to be followed for the robot to have met that end
  double thin_m = 0.4;      ///< the thickest wall whose end is one place, and the widest door frame
  double loop_m = 3.0;      ///< the least way round a loop
  double dead_end_m = 2.5;  ///< the widest hallway whose end is a dead end
};

/// Derives from the plan and the way driven what a robot with the wall on its right drove by (thesis 2.2.4): steps and ends of the wall that it
/// followed, openings to rooms and hallways that it passed or entered, dead ends. Inner corners are no nodes, nor are arcs other than round edges (see FloorPlan).
/// Rigid motions of both change nothing but the places. O(poses * segments + openings * segments^2).
TopologyTruth find_truth(const FloorPlan& plan, const DrivenWay& way, const TruthSettings& settings = {});

}  // namespace hallway::eval
