// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bsp/portal_graph.hpp"
#include "pvs/winding.hpp"

namespace hallway::pvs {

/// A portal as passed in one direction. What every look needs stands first.
struct DirectedPortal {
  Vec3 centre = Vec3::Zero();  ///< mean of the vertices
  double radius = 0.0;         ///< of the vertices around `centre`
  std::uint32_t to = 0;        ///< cluster
  std::uint32_t from = 0;      ///< cluster
  Vec3 normal = Vec3::Zero();  ///< unit, along the way
  double offset = 0.0;
  double slack = 0.0;  ///< of distances from the plane
  Winding winding;     ///< counter-clockwise around `normal`

  double distance(const Vec3& point) const { return normal.dot(point) - offset; }
  Cutter front() const { return {normal, offset, slack}; }
  Cutter back() const { return {-normal, -offset, slack}; }
};

/// A portal graph made ready for the search, moved to the middle of the world. Numbers of portals next to
/// each other are near each other, so that what sees each other shares words of the bit rows.
struct DirectedPortals {
  std::vector<DirectedPortal> portals;  ///< p ^ 1 is p passed the other way
  std::vector<std::uint32_t> begin;     ///< of each cluster in `leaving`, and the end
  std::vector<std::uint32_t> leaving;   ///< portals that leave the clusters
  double diameter = 0.0;                ///< of the box around all portals, metres
  double noise = 0.0;  ///< bound of the rounding error of a point computed by cutting, metres

  std::size_t clusters() const { return begin.size() - 1; }
  std::span<const std::uint32_t> leaving_from(std::size_t cluster) const {
    return {leaving.data() + begin[cluster], leaving.data() + begin[cluster + 1]};
  }
};

/// @throws Error kInternal if a portal has a cluster out of range, the same cluster on both sides, fewer than
///         three vertices, numbers that are not finite, no extent, a vertex off its plane, or is not convex
DirectedPortals direct_portals(const bsp::PortalGraph& graph);

}  // namespace hallway::pvs
