// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "csg/surface.hpp"
#include "geometry/se3.hpp"

namespace hallway::editor {

/// A straight line in a plan, metres.
struct PlanLine {
  Vec2 from = Vec2::Zero();
  Vec2 to = Vec2::Zero();
};

using PlanBox = Eigen::AlignedBox2d;

/// What of a world is solid at a height.
struct Section {
  /// Closed outlines, metres: regions of solid counter-clockwise, holes in them clockwise.
  std::vector<std::vector<Vec2>> loops{};

  double area_m2() const;
  PlanBox bounds() const;
};

/// Cuts a surface just above a height: what ends at that height is below. The outlines close because neighbours of the surface share
/// their edges. O(n log n).
Section section_at(const csg::Surface& surface, double height_m);

/// The pieces of a surface that are not upright, by where they are in x and y.
class PlanColumns {
 public:
  /// @param surface  not owned
  explicit PlanColumns(const csg::Surface& surface);

  /// Whether the surface crosses the upright line at a place strictly between two heights.
  bool blocked(const Vec2& at, double low_m, double high_m) const;
  /// Indices of polygons that may be over some of a box, rising.
  std::vector<std::uint32_t> near(const PlanBox& box) const;
  /// Whether a polygon is over a place, its border included.
  bool covers(std::uint32_t polygon, const Vec2& at) const;
  /// The height of a polygon's plane at a place.
  double height_at(std::uint32_t polygon, const Vec2& at) const;

 private:
  Eigen::Array2i cell_of(const Vec2& at) const;

  const csg::Surface& surface_;
  PlanBox bounds_;
  int side_ = 1;  ///< cells along x, and along y
  std::vector<std::vector<std::uint32_t>> cells_;
};

/// The edges at which what lies below a height ends or bends by more than 15 degrees, as far as they are seen from above. Every line
/// once. O(n k) for edges that have k polygons near them in the plan.
std::vector<PlanLine> edges_below(const csg::Surface& surface, const PlanColumns& columns, double height_m);

}  // namespace hallway::editor
