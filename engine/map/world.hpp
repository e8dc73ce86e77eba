// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "geom/box.hpp"
#include "geom/plane.hpp"
#include "geom/polygon.hpp"
#include "map/document.hpp"

namespace hallway::map {

/// One side of a solid.
struct SolidFace {
  Polygon polygon;  ///< metres; its plane's normal points out of the solid
  std::string material;
  int line = 0;  ///< of the face in the file
};

/// A brush as a closed convex body in metres.
struct Solid {
  int entity = 0;             ///< index in Document::entities
  int brush = 0;              ///< index in Entity::brushes
  int line = 0;               ///< of the brush in the file
  std::vector<Plane> planes;  ///< of `faces`, in the same order; normals outward
  std::vector<SolidFace>
      faces;  ///< in the order of the file, without those that touch the body in less than an area
  Box box;

  /// True for points at least `inset_m` inside every plane; a negative inset makes the body larger. O(faces).
  bool contains(const Vec3& point, double inset_m = 0.0) const;
};

/// A brush that is no body: left out of the world, which stands without it.
struct Problem {
  int entity = 0;
  int brush = 0;
  int line = 0;         ///< of the face at fault, or of the brush
  std::string message;  ///< the cause, safe to print
};

/// What the brushes of a map are in space.
struct World {
  std::vector<Solid> solids;  ///< in the order of the file
  std::vector<Problem> problems;
  Box bounds;  ///< of all solids, metres; empty where there are none
};

inline constexpr double kMaxCoordinate =
    16777216.0;  ///< map units; a face point beyond makes the brush a Problem
inline constexpr std::size_t kMaxBrushFaces = 1024;  ///< a brush of more faces is a Problem

/// The brushes of `worldspawn` and `func_group` as bodies. Other classes are left to those who know them.
///
/// Each body is closed: within one body neighbouring faces share their vertices bit by bit, and every vertex lies on its
/// planes to about 1e-6 map units (rounding, for brushes near the origin). Features smaller than that are merged.
/// O(sum of squares of the brushes' face counts). Throws Error{kBadInput} only for a bad `_scale`.
World build_world(const Document& document);

/// "entity 3, brush 7", the way messages name a brush.
std::string brush_name(int entity, int brush);

}  // namespace hallway::map
