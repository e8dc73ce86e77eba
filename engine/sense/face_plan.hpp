// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "csg/surface.hpp"
#include "geom/polygon.hpp"
#include "sense/convex.hpp"

namespace hallway::sense {

/// The world as a sensor of whole faces sees it. World frame, metres.
struct FacePlan {
  std::vector<Polygon> faces;      ///< convex; the index is the face's number
  std::vector<Polygon> obstacles;  ///< everything that hides, faces included
};

/// The faces of a world: polygons of the surface that lie in one plane and touch, as one where together they are convex, and else in
/// convex parts, each a face by itself. How brushes and tree have cut a face does not matter where it is convex as a whole.
///
/// @param wanted  says of a polygon, by its index in Surface::polygons, whether it may be of a face; empty: all may. Obstacles are all.
/// Faces stand in the order of their first polygons. O(n^2) in the polygons of a plane.
FacePlan make_face_plan(const csg::Surface& surface, const std::function<bool(std::size_t)>& wanted);

}  // namespace hallway::sense
