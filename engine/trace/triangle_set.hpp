// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "geom/box.hpp"
#include "trace/sight_line.hpp"
#include "trace/triangle_mesh.hpp"

namespace hallway::trace {

/// The triangles of a scene in double precision, and the predicate that decides what hits them.
class TriangleSet {
 public:
  /// Throws Error{kBadInput} for an index out of range and for coordinates that Scene does not take.
  explicit TriangleSet(const TriangleMesh& mesh);

  std::uint32_t size() const { return static_cast<std::uint32_t>(triangles_.size()); }

  /// Distance along the line at which it meets a triangle, if it does within [0, max_distance].
  ///
  /// The line is inside if the three signed volumes that it spans with the edges do not differ in sign. A
  /// volume that is less than its rounding error counts as zero, which is inside: a line that truly meets the
  /// triangle is never missed, so neighbours leave no gap at edges or vertices. The point of the hit always
  /// lies in the triangle's box grown by box_slack_m(): a search by boxes cannot lose a hit.
  std::optional<double> hit(std::uint32_t triangle, const SightLine& line) const;

  /// The distance that hit() gives, where it is known to give one: for less than half the work.
  double distance_of_hit(std::uint32_t triangle, const SightLine& line) const {
    const Triangle& t = triangles_[triangle];
    return t.normal.dot(t.a - line.origin) / t.normal.dot(line.direction);
  }

  std::array<Vec3, 3> corners(std::uint32_t triangle) const {
    return {triangles_[triangle].a, triangles_[triangle].b, triangles_[triangle].c};
  }
  /// True for a triangle whose vertices lie on a line: hit() never has a value.
  bool without_area(std::uint32_t triangle) const { return triangles_[triangle].normal.isZero(0.0); }
  /// The box of a triangle's vertices.
  Box box(std::uint32_t triangle) const;
  /// The box of everything, empty for no triangles.
  const Box& bounds() const { return bounds_; }
  /// How far outside its triangle's box a hit's point may be computed, in metres. It grows with the size of
  /// the scene.
  double box_slack_m() const { return box_slack_m_; }
  /// Half the diagonal of bounds(), at least 1 m.
  double radius_m() const { return radius_m_; }

 private:
  struct Triangle {
    Vec3 a, b, c;
    Vec3 normal;  ///< unit length, zero for a triangle without area
  };

  std::vector<Triangle> triangles_;
  Box bounds_;
  double radius_m_ = 1.0;
  double box_slack_m_ = 0.0;
};

}  // namespace hallway::trace
