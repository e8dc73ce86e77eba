// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "csg/surface.hpp"
#include "geom/box_tree.hpp"

namespace hallway::sense {

/// Which polygon of a surface a point lies on, and whether it is clear of everything else there.
///
/// Polygons that lie in one plane and share an edge continue each other: that edge is no edge of the face that they form.
/// The polygons of a surface without T-junctions cover their faces without gaps and overlaps, and so do the points that
/// polygon_at() gives to each.
class SurfaceClearance {
 public:
  /// Keeps a reference to the surface. O(n log n) for n vertices of polygons.
  explicit SurfaceClearance(const csg::Surface& surface);

  /// Of the polygons with that solid and face the one that a point of their plane lies on, if any.
  std::optional<std::uint32_t> polygon_at(const Vec3& point, std::uint32_t solid, std::uint32_t face) const;

  /// True if a point on a polygon is at least `distance` from the edges of the face, and the point `distance` above it at
  /// least that far from every polygon that does not continue the face. The upper point is then in empty space.
  /// O(log n + polygons nearby).
  bool is_clear(const Vec3& point, std::uint32_t polygon, double distance) const;

 private:
  struct Edge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::uint32_t polygon = 0;
  };

  bool continues(std::uint32_t polygon, std::uint32_t other) const;
  bool is_seam(std::uint32_t polygon, std::uint32_t from, std::uint32_t to) const;
  bool clear_of_edges(const Vec3& point, std::uint32_t polygon, double distance) const;
  bool clear_of_polygon(const Vec3& point, std::uint32_t polygon, double distance) const;
  bool holds(std::uint32_t polygon, const Vec3& point) const;

  const csg::Surface& surface_;
  std::vector<Edge> edges_;  ///< of all polygons, by (from, to, polygon)
  BoxTree tree_;
};

}  // namespace hallway::sense
