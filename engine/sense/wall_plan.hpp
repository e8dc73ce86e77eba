// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "csg/surface.hpp"
#include "geometry/se3.hpp"
#include "trace/triangle_mesh.hpp"

namespace hallway::sense {

/// A wall: what a horizontal plane cuts from the vertical faces of the world, as far as it lies on one plane and hangs together.
/// World frame, metres.
struct Wall {
  Vec2 left = Vec2::Zero();  ///< its ends, as they are seen from the empty side
  Vec2 right = Vec2::Zero();
  double low_m = 0.0;  ///< heights between which it stands
  double high_m = 0.0;

  double length_m() const { return (right - left).norm(); }
  /// Unit, into the empty side.
  Vec2 normal() const {
    const Vec2 along = (right - left).normalized();
    return {along.y(), -along.x()};
  }
};

/// A piece of what stands in the way at a height; world frame, metres.
struct Obstacle {
  Vec2 from = Vec2::Zero();
  Vec2 to = Vec2::Zero();
};

/// The world as a sensor sees it that knows the horizontal alone (2 1/2-D, as the simulations of thesis 4.3).
struct WallPlan {
  double height_m = 0.0;
  std::vector<Wall> walls;          ///< the index is the wall's number
  std::vector<Obstacle> obstacles;  ///< the whole boundary at that height, walls included
};

/// The plan of a world at a height.
///
/// A wall is made of all vertical polygons that the height cuts, that lie on one plane and follow each other without a gap at that
/// height: how brushes and tree have cut a face does not matter, and on both sides of a door are two walls even where a lintel joins
/// them above. It reaches up and down as far as the surface between its ends does, in one piece. What ends at the height itself is cut
/// by it, what begins there is not.
///
/// @param wanted  says of a polygon, by its index in Surface::polygons, whether it may be a wall; empty: all may. Obstacles are all.
/// @param meshes  obstacles too, and no walls
/// Walls stand in the order of the surface's polygons. O(n log n).
WallPlan make_wall_plan(const csg::Surface& surface, const std::function<bool(std::size_t)>& wanted,
                        double height_m, std::span<const trace::TriangleMesh> meshes = {});

}  // namespace hallway::sense
