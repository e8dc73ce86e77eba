// SPDX-License-Identifier: MIT
#include "pvs/directed_portals.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.hpp"
#include "geom/box.hpp"

namespace hallway::pvs {
namespace {

/// How far a vertex may lie off its portal's plane or outside an edge's line: kNarrow metres and this part of
/// the world's size.
constexpr double kFlatness = 1e-9;
constexpr double kNarrow = 1e-6;

[[noreturn]] void refuse(std::size_t portal, const std::string& why) {
  throw Error(ErrorCode::kInternal, "portal graph: " + why, {.element = "portal " + std::to_string(portal)});
}

void check_numbers(const bsp::PortalGraph& graph) {
  for (std::size_t i = 0; i < graph.portals.size(); ++i) {
    const bsp::Portal& portal = graph.portals[i];
    for (const std::uint32_t cluster : portal.cluster) {
      if (cluster >= graph.clusters) refuse(i, "cluster out of range");
    }
    if (portal.cluster[0] == portal.cluster[1]) refuse(i, "the same cluster on both sides");
    if (portal.polygon.vertices.size() < 3) refuse(i, "fewer than three vertices");
    bool finite = portal.polygon.plane.normal.allFinite() && std::isfinite(portal.polygon.plane.offset);
    for (const Vec3& vertex : portal.polygon.vertices) finite = finite && vertex.allFinite();
    if (!finite) refuse(i, "a number is not finite");
    if (std::abs(portal.polygon.plane.normal.norm() - 1.0) > 1e-9)
      refuse(i, "a normal that is not of unit length");
  }
}

Box bounds_of(const bsp::PortalGraph& graph) {
  Box box;
  for (const bsp::Portal& portal : graph.portals) {
    for (const Vec3& vertex : portal.polygon.vertices) box.extend(vertex);
  }
  return box;
}

/// Twice the area, along the normal of the turning direction (Newell).
Vec3 area_vector(const std::vector<Vec3>& vertices) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    sum += (vertices[i] - vertices[0]).cross(vertices[(i + 1) % vertices.size()] - vertices[0]);
  }
  return sum;
}

/// The longest edge of a closed polygon, as a vector.
Vec3 longest_edge(const std::vector<Vec3>& vertices) {
  Vec3 longest = Vec3::Zero();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3 edge = vertices[(i + 1) % vertices.size()] - vertices[i];
    if (edge.squaredNorm() > longest.squaredNorm()) longest = edge;
  }
  return longest;
}

/// The rectangle in the plane around a polygon: larger, so nothing is lost.
std::vector<Vec3> rectangle_around(const std::vector<Vec3>& vertices, const Vec3& normal) {
  const Vec3 u = longest_edge(vertices).normalized();
  const Vec3 v = normal.cross(u);
  Eigen::AlignedBox2d box;
  for (const Vec3& vertex : vertices) {
    box.extend(Eigen::Vector2d(u.dot(vertex - vertices[0]), v.dot(vertex - vertices[0])));
  }
  const auto corner = [&](double x, double y) -> Vec3 { return vertices[0] + x * u + y * v; };
  return {corner(box.min().x(), box.min().y()), corner(box.max().x(), box.min().y()),
          corner(box.max().x(), box.max().y()), corner(box.min().x(), box.max().y())};
}

void check_shape(const std::vector<Vec3>& vertices, const Plane& plane, double tolerance, std::size_t index) {
  const double length = longest_edge(vertices).norm();
  if (length == 0.0) refuse(index, "all vertices at one point");
  if (area_vector(vertices).dot(plane.normal) < -tolerance * length) refuse(index, "the wrong way round");
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3& start = vertices[i];
    const Vec3 edge = vertices[(i + 1) % vertices.size()] - start;
    const Vec3 inward = plane.normal.cross(edge);
    for (const Vec3& vertex : vertices) {
      if (std::abs(plane.distance(vertex)) > tolerance) refuse(index, "a vertex off the plane");
      // The direction of a shorter edge is rounding.
      if (edge.norm() > tolerance && inward.dot(vertex - start) < -tolerance * edge.norm()) {
        refuse(index, "not convex");
      }
    }
  }
}

/// Vertices for the search: those given, or the rectangle around them if there are too many or if the polygon
/// is so narrow that rounding may have turned it over.
std::vector<Vec3> usable_vertices(const std::vector<Vec3>& vertices, const Plane& plane, double tolerance) {
  // One vertex less than fits, so that the first cut has room.
  const bool too_many = vertices.size() >= Winding::kCapacity - 1;
  const bool narrow = area_vector(vertices).dot(plane.normal) < tolerance * longest_edge(vertices).norm();
  return too_many || narrow ? rectangle_around(vertices, plane.normal) : vertices;
}

/// The portal as passed along its normal, relative to `origin`.
DirectedPortal forward_portal(const bsp::Portal& portal, std::size_t index, const Vec3& origin,
                              const DirectedPortals& world) {
  std::vector<Vec3> vertices = portal.polygon.vertices;
  for (Vec3& vertex : vertices) vertex -= origin;
  Plane plane = portal.polygon.plane;
  plane.offset -= plane.normal.dot(origin);
  const double tolerance = kFlatness * (world.diameter + origin.norm()) + kNarrow;
  check_shape(vertices, plane, tolerance, index);
  vertices = usable_vertices(vertices, plane, tolerance);

  DirectedPortal result;
  result.from = portal.cluster[1];
  result.to = portal.cluster[0];
  result.normal = plane.normal;
  result.offset = plane.offset;
  result.winding.count = vertices.size();
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    result.winding.points[i] = vertices[i];
    result.slack = std::max(result.slack, std::abs(plane.distance(vertices[i])));
    sum += vertices[i];
  }
  result.slack += world.noise;
  result.centre = sum / static_cast<double>(vertices.size());
  for (const Vec3& vertex : vertices)
    result.radius = std::max(result.radius, (vertex - result.centre).norm());
  result.radius += world.noise;
  return result;
}

DirectedPortal reversed(DirectedPortal portal) {
  std::swap(portal.from, portal.to);
  portal.normal = -portal.normal;
  portal.offset = -portal.offset;
  std::reverse(portal.winding.points.begin(),
               portal.winding.points.begin() + static_cast<std::ptrdiff_t>(portal.winding.count));
  return portal;
}

/// Portals of the graph as a breadth-first walk from cluster to cluster meets them.
std::vector<std::size_t> walk_order(const bsp::PortalGraph& graph) {
  std::vector<std::vector<std::size_t>> at(graph.clusters);
  for (std::size_t i = 0; i < graph.portals.size(); ++i) {
    for (const std::uint32_t cluster : graph.portals[i].cluster) at[cluster].push_back(i);
  }
  std::vector<std::size_t> order;
  std::vector<bool> numbered(graph.portals.size());
  std::vector<bool> met(graph.clusters);
  std::vector<std::uint32_t> queue;
  for (std::uint32_t start = 0; start < graph.clusters; ++start) {
    if (met[start]) continue;
    met[start] = true;
    queue.assign(1, start);
    for (std::size_t next = 0; next < queue.size(); ++next) {
      for (const std::size_t portal : at[queue[next]]) {
        if (numbered[portal]) continue;
        numbered[portal] = true;
        order.push_back(portal);
        for (const std::uint32_t cluster : graph.portals[portal].cluster) {
          if (met[cluster]) continue;
          met[cluster] = true;
          queue.push_back(cluster);
        }
      }
    }
  }
  return order;
}

/// Fills `begin` and `leaving`.
void list_leaving(std::uint32_t clusters, DirectedPortals& world) {
  world.begin.assign(clusters + std::size_t{1}, 0);
  for (const DirectedPortal& portal : world.portals) ++world.begin[portal.from + std::size_t{1}];
  for (std::size_t c = 0; c < clusters; ++c) world.begin[c + 1] += world.begin[c];
  world.leaving.resize(world.portals.size());
  std::vector<std::uint32_t> next(world.begin.begin(), world.begin.end() - 1);
  for (std::uint32_t i = 0; i < world.portals.size(); ++i) world.leaving[next[world.portals[i].from]++] = i;
}

}  // namespace

DirectedPortals direct_portals(const bsp::PortalGraph& graph) {
  check_numbers(graph);
  DirectedPortals world;
  if (!graph.portals.empty()) {
    const Box box = bounds_of(graph);
    // Whole metres, so that moving the portals rounds nothing.
    const Vec3 origin = box.center().array().round().matrix();
    world.diameter = box.diagonal().norm();
    // Four units in the last place of the largest coordinate that a computation meets.
    world.noise = std::ldexp(world.diameter, -50) + std::ldexp(origin.norm(), -52);
    world.portals.reserve(2 * graph.portals.size());
    for (const std::size_t i : walk_order(graph)) {
      world.portals.push_back(forward_portal(graph.portals[i], i, origin, world));
      world.portals.push_back(reversed(world.portals.back()));
    }
  }
  list_leaving(graph.clusters, world);
  return world;
}

}  // namespace hallway::pvs
