// SPDX-License-Identifier: MIT
#include "render/leaf_pieces.hpp"

#include <array>
#include <utility>

namespace hallway::render {
namespace {

/// Vertices this near a plane lie on it.
constexpr double kOnPlane_m = 1e-6;

/// Where a polygon lies beside a plane, and its parts on both sides.
struct Halves {
  bool front = false;
  bool behind = false;
  std::array<std::vector<Vec3>, 2> part{};  ///< only where it lies on both sides
};

Halves divide(const std::vector<Vec3>& corners, const Plane& plane) {
  Halves halves;
  std::vector<double> distance;
  distance.reserve(corners.size());
  for (const Vec3& corner : corners) {
    distance.push_back(plane.distance(corner));
    halves.front = halves.front || distance.back() > kOnPlane_m;
    halves.behind = halves.behind || distance.back() < -kOnPlane_m;
  }
  if (!halves.front || !halves.behind) return halves;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t next = (i + 1) % corners.size();
    const double d = distance[i];
    const double e = distance[next];
    if (d >= -kOnPlane_m) halves.part[0].push_back(corners[i]);
    if (d <= kOnPlane_m) halves.part[1].push_back(corners[i]);
    const bool crosses = (d > kOnPlane_m && e < -kOnPlane_m) || (d < -kOnPlane_m && e > kOnPlane_m);
    if (!crosses) continue;
    const Vec3 at = corners[i] + d / (d - e) * (corners[next] - corners[i]);
    halves.part[0].push_back(at);
    halves.part[1].push_back(at);
  }
  return halves;
}

}  // namespace

std::vector<LeafPiece> leaf_pieces(const bsp::Tree& tree, const Polygon& face) {
  std::vector<LeafPiece> out;
  std::vector<std::pair<bsp::Child, std::vector<Vec3>>> open{{tree.root, face.vertices}};
  while (!open.empty()) {
    auto [child, corners] = std::move(open.back());
    open.pop_back();
    if (child.is_leaf()) {
      out.push_back({child.index(), {std::move(corners), face.plane}});
      continue;
    }
    const bsp::Node& node = tree.nodes[child.index()];
    const Plane plane = tree.plane(child.index());
    Halves halves = divide(corners, plane);
    if (halves.front && halves.behind) {
      for (std::size_t side : {std::size_t{1}, std::size_t{0}}) {
        if (halves.part[side].size() >= 3) open.emplace_back(node.child[side], std::move(halves.part[side]));
      }
      continue;
    }
    // A face in the node's plane belongs to the side that it looks at.
    const bool before = halves.front || (!halves.behind && plane.normal.dot(face.plane.normal) > 0.0);
    open.emplace_back(node.child[before ? 0 : 1], std::move(corners));
  }
  return out;
}

std::vector<std::uint32_t> leaf_depths(const bsp::Tree& tree) {
  std::vector<std::uint32_t> depths(tree.leaves.size(), 0);
  std::vector<std::pair<bsp::Child, std::uint32_t>> open{{tree.root, 0}};
  while (!open.empty()) {
    const auto [child, depth] = open.back();
    open.pop_back();
    if (child.is_leaf()) {
      depths[child.index()] = depth;
      continue;
    }
    for (const bsp::Child next : tree.nodes[child.index()].child) open.emplace_back(next, depth + 1);
  }
  return depths;
}

}  // namespace hallway::render
