// SPDX-License-Identifier: MIT
#include "sight_lines.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::pvs::test {
namespace {

/// A line that meets a portal's plane at a smaller angle than this runs along it.
constexpr double kParallel = 1e-9;

bool is_inside(const Polygon& polygon, const Vec3& point, double margin) {
  for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
    const Vec3& start = polygon.vertices[i];
    const Vec3 edge = polygon.vertices[(i + 1) % polygon.vertices.size()] - start;
    if (polygon.plane.normal.cross(edge).dot(point - start) < margin * edge.norm()) return false;
  }
  return true;
}

}  // namespace

SightLines::SightLines(const bsp::PortalGraph& graph) : graph_(graph), portals_of_(graph.clusters) {
  for (std::uint32_t i = 0; i < graph.portals.size(); ++i) {
    for (const std::uint32_t cluster : graph.portals[i].cluster) portals_of_[cluster].push_back(i);
  }
}

std::vector<std::uint32_t> SightLines::pass(std::uint32_t cluster, const Vec3& start, const Vec3& towards,
                                            double margin) const {
  std::vector<std::uint32_t> passed{cluster};
  const Vec3 way = towards.normalized();
  for (bool goes_on = true; goes_on && passed.size() <= graph_.clusters;) {
    goes_on = false;
    for (const std::uint32_t index : portals_of_[passed.back()]) {
      const bsp::Portal& portal = graph_.portals[index];
      const bool forward = portal.cluster[1] == passed.back();
      const double speed = (forward ? 1.0 : -1.0) * portal.polygon.plane.normal.dot(way);
      if (speed < kParallel) continue;
      const double distance = (forward ? -1.0 : 1.0) * portal.polygon.plane.distance(start) / speed;
      if (distance < 0.0 || !is_inside(portal.polygon, start + distance * way, margin)) continue;
      passed.push_back(portal.cluster[forward ? 0 : 1]);
      goes_on = true;
      break;
    }
  }
  return passed;
}

std::vector<std::uint32_t> SightLines::pass_through(std::size_t index, const Vec3& point, const Vec3& towards,
                                                    double margin) const {
  const bsp::Portal& portal = graph_.portals[index];
  const double slope = portal.polygon.plane.normal.dot(towards.normalized());
  if (std::abs(slope) < kParallel) return {};
  const bool forward = slope > 0.0;
  // Start a little off the portal, on either side.
  const Vec3 step = 1e-7 * towards.normalized();
  std::vector<std::uint32_t> passed = pass(portal.cluster[forward ? 1 : 0], point - step, -towards, margin);
  std::reverse(passed.begin(), passed.end());
  const auto ahead = pass(portal.cluster[forward ? 0 : 1], point + step, towards, margin);
  passed.insert(passed.end(), ahead.begin(), ahead.end());
  return passed;
}

}  // namespace hallway::pvs::test
