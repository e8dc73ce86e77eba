// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "geom/box.hpp"
#include "geom/plane.hpp"
#include "geom/polygon.hpp"
#include "map/content.hpp"
#include "map/document.hpp"

namespace hallway::map {

/// One side of a solid.
struct SolidFace {
  Polygon polygon{};  ///< metres; its plane's normal points out of the solid
  std::string material{};
  int line = 0;  ///< of the face in the file
  /// Three points of the plane in map units, exactly as in the file; clockwise as seen from outside.
  std::array<Vec3, 3> points{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  bool drawn = true;  ///< false where pictures leave it out (`skip`); it is as solid as any other
};

/// A brush as a closed convex body in metres.
struct Solid {
  BrushRole role = BrushRole::kAdd;
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

/// A brush that is no body, and left out of the world, which stands without it; or one that is odd.
struct Problem {
  int entity = 0;
  int brush = 0;
  int line = 0;         ///< of the face at fault, or of the brush
  std::string message;  ///< the cause, safe to print
  bool left_out =
      true;  ///< false: the brush is a body all the same; of two faces on one plane the first counts
};

/// How many brushes have no part in the world for one reason.
struct LeftOutCount {
  LeftOut reason = LeftOut::kOther;
  std::size_t brushes = 0;
};

/// What the brushes of a map are in space. A point is solid if the last solid that contains it, hints aside, is no
/// kSubtract.
struct World {
  /// In the order in which they apply: `worldspawn`, `func_group` and detail in the order of the file, then `hw_add` and
  /// `hw_subtract` by their key `order`, ties in the order of the file.
  std::vector<Solid> solids;
  std::vector<Problem> problems;       ///< in the order of the file
  std::vector<LeftOutCount> left_out;  ///< by reason; without those that left out no brush
  Box bounds;  ///< of what is added (kAdd, kDetail), metres; empty where there is none
  double metres_per_unit = kQuakeMetresPerUnit;
};

inline constexpr double kMaxCoordinate =
    16777216.0;  ///< map units; a face point beyond makes the brush a Problem
inline constexpr std::size_t kMaxBrushFaces = 1024;  ///< a brush of more faces is a Problem

/// The brushes of a map as bodies with what they do to the world (tables in content.hpp). Brushes that have no part in the
/// world are counted and not looked at further.
///
/// Each body is closed: within one body neighbouring faces share their vertices bit by bit, and every vertex lies on its
/// planes to about 1e-6 map units (rounding, for brushes near the origin). Features smaller than that are merged.
/// O(sum of squares of the brushes' face counts). Throws Error{kBadInput} only for a bad `_scale`, and for a key of
/// `hw_add`, `hw_subtract` or `hw_detail` that is unknown, or an `order` that is no whole number.
World build_world(const Document& document);

/// The brushes that build_world() would leave out as Problems, also for a document whose keys it would refuse.
std::vector<Problem> brush_problems(const Document& document);

/// The cause and what follows from it: "…; the brush is left out".
std::string problem_text(const Problem& problem);

/// "entity 3, brush 7", the way messages name a brush.
std::string brush_name(int entity, int brush);

}  // namespace hallway::map
