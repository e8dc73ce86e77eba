// SPDX-License-Identifier: MIT
#include "map/convex_body.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include <Eigen/LU>

namespace hallway::map {
namespace {

using Loop = std::vector<std::uint32_t>;
using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Sine-like measure below which three planes meet at too flat an angle to solve for their point.
constexpr double kFlat = 1e-4;

constexpr int kUnknown = 2;  ///< of a vertex that has not been classified yet

class Cutter {
 public:
  Cutter(std::span<const Plane> planes, double reach, double tolerance)
      : given_(planes.size()), tolerance_(tolerance), planes_(planes.begin(), planes.end()) {
    add_cube(reach);
  }

  std::variant<ConvexBody, ConvexFault> run() {
    for (std::size_t i = 0; i < given_; ++i) {
      if (const auto fault = cut(i)) return *fault;
    }
    for (const ConvexBody::Side& side : sides_) {
      if (side.plane >= given_) return ConvexFault::kUnbounded;
    }
    sharpen_vertices();
    contract_short_edges();
    drop_slivers();
    constexpr std::size_t kFewestSides = 4;
    if (sides_.size() < kFewestSides) return ConvexFault::kEmpty;
    return compact();
  }

 private:
  void add_cube(double reach) {
    for (int corner = 0; corner < 8; ++corner) {
      vertices_.push_back(reach *
                          Vec3(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0));
    }
    const std::array<std::pair<Vec3, Loop>, 6> faces{{{Vec3::UnitX(), {1, 3, 7, 5}},
                                                      {-Vec3::UnitX(), {0, 4, 6, 2}},
                                                      {Vec3::UnitY(), {2, 6, 7, 3}},
                                                      {-Vec3::UnitY(), {0, 1, 5, 4}},
                                                      {Vec3::UnitZ(), {4, 5, 7, 6}},
                                                      {-Vec3::UnitZ(), {0, 2, 3, 1}}}};
    for (const auto& [normal, loop] : faces) {
      sides_.push_back({planes_.size(), loop});
      planes_.push_back({normal, reach});
    }
  }

  /// -1 inside, 0 on, 1 outside.
  int classify(const Plane& plane, const Vec3& point) const {
    const double distance = plane.distance(point);
    return distance > tolerance_ ? 1 : distance < -tolerance_ ? -1 : 0;
  }

  std::optional<ConvexFault> cut(std::size_t plane) {
    where_.assign(vertices_.size(), kUnknown);
    bool any_inside = false;
    bool any_outside = false;
    for (const ConvexBody::Side& side : sides_) {
      for (const std::uint32_t v : side.loop) {
        if (where_[v] == kUnknown) where_[v] = classify(planes_[plane], vertices_[v]);
        any_inside |= where_[v] < 0;
        any_outside |= where_[v] > 0;
      }
    }
    if (!any_outside) return std::nullopt;
    if (!any_inside) return ConvexFault::kEmpty;
    find_neighbours();
    cut_vertices_.clear();
    std::vector<ConvexBody::Side> kept;
    for (ConvexBody::Side& side : sides_) {
      if (is_cut(side)) side.loop = cut_loop(side, plane);
      if (side.loop.size() >= 3) kept.push_back(std::move(side));
    }
    sides_ = std::move(kept);
    return close(plane);
  }

  bool is_cut(const ConvexBody::Side& side) const {
    return std::any_of(side.loop.begin(), side.loop.end(), [&](std::uint32_t v) { return where_[v] > 0; });
  }

  /// Which side lies across each edge of the sides that are cut, by the direction in which that side runs along it.
  void find_neighbours() {
    side_of_edge_.clear();
    for (const ConvexBody::Side& side : sides_) {
      if (!is_cut(side)) continue;
      for (std::size_t i = 0; i < side.loop.size(); ++i) {
        side_of_edge_.push_back({{side.loop[i], side.loop[(i + 1) % side.loop.size()]}, side.plane});
      }
    }
    std::sort(side_of_edge_.begin(), side_of_edge_.end());
  }

  Loop cut_loop(const ConvexBody::Side& side, std::size_t plane) {
    Loop rest;
    for (std::size_t i = 0; i < side.loop.size(); ++i) {
      const std::uint32_t a = side.loop[i];
      const std::uint32_t b = side.loop[(i + 1) % side.loop.size()];
      if (where_[a] <= 0) rest.push_back(a);
      if (where_[a] * where_[b] < 0) rest.push_back(cut_vertex({a, b}, side.plane, plane));
    }
    return rest;
  }

  std::uint32_t cut_vertex(Edge edge, std::size_t side, std::size_t plane) {
    const Edge key = std::minmax(edge.first, edge.second);
    const auto known = cut_vertices_.find(key);
    if (known != cut_vertices_.end()) return known->second;
    const auto id = static_cast<std::uint32_t>(vertices_.size());
    vertices_.push_back(cut_point(key, side, neighbour({edge.second, edge.first}), plane));
    where_.push_back(0);
    cut_vertices_.emplace(key, id);
    return id;
  }

  std::size_t neighbour(Edge edge) const {
    const auto found =
        std::lower_bound(side_of_edge_.begin(), side_of_edge_.end(), std::pair(edge, std::size_t{0}));
    return found->second;
  }

  Vec3 cut_point(Edge edge, std::size_t side, std::size_t other, std::size_t plane) const {
    if (const auto point = meet(side, other, plane)) return *point;
    const Vec3& a = vertices_[edge.first];
    const Vec3& b = vertices_[edge.second];
    const double from = planes_[plane].distance(a);
    const double to = planes_[plane].distance(b);
    return a + (b - a) * (from / (from - to));
  }

  std::optional<Vec3> meet(std::size_t i, std::size_t j, std::size_t k) const {
    Eigen::Matrix3d normals;
    normals << planes_[i].normal.transpose(), planes_[j].normal.transpose(), planes_[k].normal.transpose();
    if (std::abs(normals.determinant()) < kFlat) return std::nullopt;
    return normals.partialPivLu().solve(Vec3(planes_[i].offset, planes_[j].offset, planes_[k].offset));
  }

  /// Adds the side on `plane`: its edges are those that the cut left open, the other way round.
  std::optional<ConvexFault> close(std::size_t plane) {
    std::set<Edge> open;
    for (const ConvexBody::Side& side : sides_) {
      for (std::size_t i = 0; i < side.loop.size(); ++i) {
        const std::uint32_t a = side.loop[i];
        const std::uint32_t b = side.loop[(i + 1) % side.loop.size()];
        if (where_[a] != 0 || where_[b] != 0) continue;
        if (open.erase({a, b}) == 0) open.insert({b, a});
      }
    }
    std::map<std::uint32_t, std::uint32_t> next;
    for (const auto& [from, to] : open) {
      if (!next.emplace(from, to).second) return ConvexFault::kUnstable;
    }
    if (next.size() < 3) return ConvexFault::kUnstable;
    Loop loop;
    std::uint32_t at = next.begin()->first;
    do {
      loop.push_back(at);
      const auto step = next.find(at);
      if (step == next.end() || loop.size() > next.size()) return ConvexFault::kUnstable;
      at = step->second;
    } while (at != loop.front());
    if (loop.size() != next.size()) return ConvexFault::kUnstable;
    sides_.push_back({plane, std::move(loop)});
    return std::nullopt;
  }

  void sharpen_vertices() {
    std::vector<std::vector<std::size_t>> planes_at(vertices_.size());
    for (const ConvexBody::Side& side : sides_) {
      for (const std::uint32_t v : side.loop) planes_at[v].push_back(side.plane);
    }
    for (std::size_t v = 0; v < vertices_.size(); ++v) {
      const auto point = sharp_point(planes_at[v]);
      if (point && (*point - vertices_[v]).norm() <= 10.0 * tolerance_) vertices_[v] = *point;
    }
  }

  /// Where three of the planes meet, chosen greedily for the best angle.
  std::optional<Vec3> sharp_point(std::vector<std::size_t> planes) const {
    if (planes.size() < 3) return std::nullopt;
    std::sort(planes.begin(), planes.end());
    const Vec3& first = planes_[planes[0]].normal;
    const auto best = [&](auto measure) {
      return *std::max_element(planes.begin(), planes.end(),
                               [&](std::size_t a, std::size_t b) { return measure(a) < measure(b); });
    };
    const std::size_t second = best([&](std::size_t i) { return first.cross(planes_[i].normal).norm(); });
    const Vec3 line = first.cross(planes_[second].normal);
    const std::size_t third = best([&](std::size_t i) { return std::abs(line.dot(planes_[i].normal)); });
    return meet(planes[0], second, third);
  }

  void contract_short_edges() {
    std::vector<std::uint32_t> leader(vertices_.size());
    std::iota(leader.begin(), leader.end(), 0u);
    const auto find = [&](std::uint32_t v) {
      while (leader[v] != v) v = leader[v];
      return v;
    };
    for (const ConvexBody::Side& side : sides_) {
      for (std::size_t i = 0; i < side.loop.size(); ++i) {
        const std::uint32_t a = find(side.loop[i]);
        const std::uint32_t b = find(side.loop[(i + 1) % side.loop.size()]);
        if ((vertices_[a] - vertices_[b]).norm() <= tolerance_) leader[std::max(a, b)] = std::min(a, b);
      }
    }
    for (ConvexBody::Side& side : sides_) {
      Loop loop;
      for (const std::uint32_t v : side.loop) {
        if (loop.empty() || loop.back() != find(v)) loop.push_back(find(v));
      }
      while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
      side.loop = std::move(loop);
    }
    std::erase_if(sides_, [](const ConvexBody::Side& side) { return side.loop.size() < 3; });
  }

  /// A side no wider than the tolerance is rounding; what it leaves open is no wider either.
  void drop_slivers() {
    std::erase_if(sides_, [&](const ConvexBody::Side& side) {
      Vec3 twice_area = Vec3::Zero();
      double longest = 0.0;
      const Vec3& first = vertices_[side.loop[0]];
      for (std::size_t i = 0; i < side.loop.size(); ++i) {
        const Vec3& a = vertices_[side.loop[i]];
        const Vec3& b = vertices_[side.loop[(i + 1) % side.loop.size()]];
        twice_area += (a - first).cross(b - first);
        longest = std::max(longest, (b - a).norm());
      }
      return twice_area.norm() <= tolerance_ * longest;
    });
  }

  ConvexBody compact() {
    std::sort(sides_.begin(), sides_.end(), [](const auto& a, const auto& b) { return a.plane < b.plane; });
    ConvexBody body;
    constexpr std::uint32_t kUnused = ~0u;
    std::vector<std::uint32_t> renamed(vertices_.size(), kUnused);
    for (ConvexBody::Side& side : sides_) {
      for (std::uint32_t& v : side.loop) {
        if (renamed[v] == kUnused) {
          renamed[v] = static_cast<std::uint32_t>(body.vertices.size());
          body.vertices.push_back(vertices_[v]);
        }
        v = renamed[v];
      }
    }
    body.sides = std::move(sides_);
    return body;
  }

  std::size_t given_;
  double tolerance_;
  std::vector<Plane> planes_;  ///< the given ones, then the cube's
  std::vector<Vec3> vertices_;
  std::vector<ConvexBody::Side> sides_;
  std::vector<int> where_;  ///< of each vertex, to the plane that cuts
  std::vector<std::pair<Edge, std::size_t>> side_of_edge_;
  std::map<Edge, std::uint32_t> cut_vertices_;
};

}  // namespace

std::variant<ConvexBody, ConvexFault> intersect_half_spaces(std::span<const Plane> planes, double reach,
                                                            double tolerance) {
  return Cutter(planes, reach, tolerance).run();
}

}  // namespace hallway::map
