// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "bsp/portal_graph.hpp"

namespace hallway::pvs::test {

/// Steps lines through the portals of a graph, from cluster to cluster: the truth about what sees what.
class SightLines {
 public:
  explicit SightLines(const bsp::PortalGraph& graph);

  /// The clusters that a half-line passes, in order, the first one among them, until it meets a wall: a place
  /// of a cluster's boundary that is not at least `margin` metres inside the edges of one of its portals.
  /// @param start    a point in or on the first cluster
  /// @param towards  any length
  std::vector<std::uint32_t> pass(std::uint32_t cluster, const Vec3& start, const Vec3& towards,
                                  double margin) const;

  /// The clusters along the whole line through a point of a portal; none if the line runs along the portal.
  std::vector<std::uint32_t> pass_through(std::size_t portal, const Vec3& point, const Vec3& towards,
                                          double margin) const;

 private:
  const bsp::PortalGraph& graph_;
  std::vector<std::vector<std::uint32_t>> portals_of_;
};

}  // namespace hallway::pvs::test
