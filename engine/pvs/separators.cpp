// SPDX-License-Identifier: MIT
#include "pvs/separators.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::pvs {
namespace {

/// An edge or a vertex's distance from it that is shorter gives no plane, metres: its direction is noise.
constexpr double kShortest = 1e-7;

/// Adds the planes through edges of `edges` that have it on one side and `others` on the other. `normal` is
/// that of the plane of `edges`, pointing to `others`; `side` is +1 if `edges` runs counter-clockwise around
/// it, else -1. The planes added have `others` in front if `side` is +1, behind if -1.
void add_planes(const Winding& edges, const Vec3& normal, double offset, double side, const Winding& others,
                double tolerance, const Precision& precision, Separators& separators) {
  std::array<double, Winding::kCapacity> height;
  for (std::size_t k = 0; k < others.count; ++k) {
    height[k] = normal.dot(others.points[k]) - offset;
    if (height[k] < -tolerance) return;
    height[k] = std::max(height[k], 0.0);
  }
  for (std::size_t i = 0; i < edges.count; ++i) {
    const Vec3& start = edges.points[i];
    const Vec3 edge = side * (edges.points[i + 1 == edges.count ? 0 : i + 1] - start);
    const double edge_squared = edge.squaredNorm();
    if (edge_squared < kShortest * kShortest) continue;
    const Vec3 outward = edge.cross(normal);
    const double base = outward.dot(start);
    // The vertex that a plane meets first when it turns around the edge, away from `edges`.
    std::size_t best = others.count;
    double best_height = 0.0;
    double best_out = 0.0;
    bool found = true;
    for (std::size_t k = 0; k < others.count && found; ++k) {
      const double out = outward.dot(others.points[k]) - base;
      const double high = height[k];
      const double squared = out * out + high * high * edge_squared;
      if (squared < kShortest * kShortest * edge_squared) {
        // On the edge, which is no matter, or too near to it.
        found = squared <= tolerance * tolerance * edge_squared;
      } else if (high <= tolerance && out < 0.0) {
        found = false;  // the plane that meets it is that of `edges`, which says nothing
      } else if (best == others.count || out * best_height < best_out * high) {
        best = k;
        best_height = high;
        best_out = out;
      }
    }
    if (!found || best_height <= tolerance) continue;
    const Vec3 plane = edge.cross(others.points[best] - start);
    const double squared = plane.squaredNorm();
    const double scale = side / std::sqrt(squared);
    const double spread =
        std::sqrt(std::max(squared, edge_squared * edge_squared) / (edge_squared * squared));
    const Vec3 unit = scale * plane;
    separators.planes[separators.count++] = {unit, unit.dot(start),
                                             4.0 * precision.noise * (1.0 + precision.diameter * spread)};
  }
}

}  // namespace

void separate(const Winding& behind, const DirectedPortal& behind_portal, const Winding& front,
              const DirectedPortal& front_portal, const Precision& precision, Separators& separators) {
  separators.count = 0;
  const double tolerance = 4.0 * (behind_portal.slack + front_portal.slack);
  add_planes(behind, behind_portal.normal, behind_portal.offset, 1.0, front, tolerance, precision,
             separators);
  add_planes(front, -front_portal.normal, -front_portal.offset, -1.0, behind, tolerance, precision,
             separators);
}

}  // namespace hallway::pvs
