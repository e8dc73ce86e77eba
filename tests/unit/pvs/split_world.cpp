// SPDX-License-Identifier: MIT
#include "split_world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace hallway::pvs::test {
namespace {

using Points = std::vector<Vec3>;

/// Distances below this are zero when a polygon is cut.
constexpr double kOnPlane = 1e-11;

/// The part of a convex polygon on one side of a plane: sign +1 in front, -1 behind.
Points part(const Points& polygon, const Plane& plane, double sign) {
  Points result;
  const auto distance = [&](const Vec3& point) {
    const double d = sign * plane.distance(point);
    return std::abs(d) < kOnPlane ? 0.0 : d;
  };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3& here = polygon[i];
    const Vec3& next = polygon[(i + 1) % polygon.size()];
    const double a = distance(here);
    const double b = distance(next);
    if (a >= 0.0) result.push_back(here);
    if ((a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0)) result.push_back(here + a / (a - b) * (next - here));
  }
  return result;
}

double area(const Points& polygon) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    sum += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  }
  return 0.5 * sum.norm();
}

Vec3 mean(const Points& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

/// Two directions that make a right-handed system with the normal.
std::pair<Vec3, Vec3> directions_in(const Plane& plane) {
  const Vec3 helper = std::abs(plane.normal.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 u = plane.normal.cross(helper).normalized();
  return {u, plane.normal.cross(u)};
}

Points large_square(const Plane& plane, const Vec3& near, double half) {
  const Vec3 centre = near - plane.distance(near) * plane.normal;
  const auto [u, v] = directions_in(plane);
  return {centre - half * u - half * v, centre + half * u - half * v, centre + half * u + half * v,
          centre - half * u + half * v};
}

struct Cell {
  std::vector<Plane> planes;  ///< normals point out
  std::vector<Points> faces;
  bool solid = false;
};

class Builder {
 public:
  Builder(std::uint64_t seed, const WorldSettings& settings) : dice_(seed), settings_(settings) {}

  SplitWorld build() {
    cells_.push_back(box());
    for (std::size_t tries = 0; cells_.size() < settings_.cells && tries < 20 * settings_.cells; ++tries) {
      const std::size_t cell = dice_.below(cells_.size());
      split(cell, random_plane(cells_[cell]));
    }
    for (Cell& cell : cells_) cell.solid = dice_.chance(settings_.pillar);
    SplitWorld world;
    world.graph.clusters = static_cast<std::uint32_t>(cells_.size());
    for (const Cell& cell : cells_) world.corners.push_back(corners(cell));
    for (bsp::Portal& portal : portals_) {
      if (!cells_[portal.cluster[0]].solid && !cells_[portal.cluster[1]].solid) {
        world.graph.portals.push_back(std::move(portal));
      }
    }
    return world;
  }

 private:
  static Points corners(const Cell& cell) {
    Points all;
    for (const Points& face : cell.faces) all.insert(all.end(), face.begin(), face.end());
    return all;
  }

  Points section(const Cell& cell, const Plane& plane) const {
    Points polygon = large_square(plane, mean(corners(cell)), 4.0 * settings_.size);
    for (const Plane& bound : cell.planes) polygon = part(polygon, bound, -1.0);
    return polygon;
  }

  Cell box() const {
    Cell cell;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {-1.0, 1.0}) {
        const Vec3 normal = sign * Vec3::Unit(axis);
        const double offset = sign * (settings_.origin[axis] + (sign > 0.0 ? settings_.size : 0.0));
        cell.planes.push_back({normal, offset});
      }
    }
    const Vec3 middle = settings_.origin + Vec3::Constant(settings_.size / 2);
    for (std::size_t i = 0; i < cell.planes.size(); ++i) {
      Points face = large_square(cell.planes[i], middle, settings_.size);
      for (std::size_t k = 0; k < cell.planes.size(); ++k) {
        if (k != i) face = part(face, cell.planes[k], -1.0);
      }
      cell.faces.push_back(face);
    }
    return cell;
  }

  Plane random_plane(const Cell& cell) {
    const Points points = corners(cell);
    Vec3 through = Vec3::Zero();
    double sum = 0.0;
    for (const Vec3& point : points) {
      const double weight = dice_.uniform(0.1, 1.0);
      through += weight * point;
      sum += weight;
    }
    through /= sum;
    if (dice_.chance(settings_.oblique)) {
      const Vec3 normal = dice_.direction();
      return {normal, normal.dot(through)};
    }
    const int axis = static_cast<int>(dice_.below(3));
    const double sign = dice_.chance(0.5) ? 1.0 : -1.0;
    return {sign * Vec3::Unit(axis), sign * 0.5 * std::round(2.0 * through[axis])};
  }

  /// The opening in the wall on a cut; empty for none.
  Points opening(const Points& cut, const Plane& plane) {
    const double kind = dice_.uniform();
    if (kind < settings_.wall) return {};
    const Vec3 centre = mean(cut);
    if (kind < settings_.wall + settings_.door) {
      Points door;
      const Vec3 to = centre + dice_.uniform(0.0, 0.9) * (cut[dice_.below(cut.size())] - centre);
      const double scale = dice_.uniform(0.05, 0.7);
      for (const Vec3& point : cut) door.push_back(to + scale * (point - to));
      return door;
    }
    if (kind < settings_.wall + settings_.door + settings_.sliver) {
      const auto [u, v] = directions_in(plane);
      const double angle = dice_.uniform(0.0, 6.0);
      const Vec3 across = std::cos(angle) * u + std::sin(angle) * v;
      const Points half = part(cut, {across, across.dot(centre)}, 1.0);
      return part(half, {across, across.dot(centre) + 1e-6}, -1.0);
    }
    return cut;
  }

  void split(std::size_t index, const Plane& plane) {
    const Points cut = section(cells_[index], plane);
    if (cut.size() < 3 || area(cut) < 1e-3) return;
    const auto [behind, front] = halves(cells_[index], plane, cut);
    if (behind.faces.size() < 4 || front.faces.size() < 4) return;
    const auto old_cell = static_cast<std::uint32_t>(index);
    const auto new_cell = static_cast<std::uint32_t>(cells_.size());
    cells_[index] = behind;
    cells_.push_back(front);
    divide_portals(old_cell, new_cell, plane);
    const Points hole = opening(cut, plane);
    if (hole.size() >= 3) portals_.push_back({.polygon = {hole, plane}, .cluster = {new_cell, old_cell}});
  }

  static std::pair<Cell, Cell> halves(const Cell& cell, const Plane& plane, const Points& cut) {
    std::array<Cell, 2> half;
    for (std::size_t side = 0; side < 2; ++side) {
      const double sign = side == 0 ? -1.0 : 1.0;
      for (std::size_t f = 0; f < cell.faces.size(); ++f) {
        const Points face = part(cell.faces[f], plane, sign);
        if (face.size() < 3 || area(face) < 1e-9) continue;
        half[side].planes.push_back(cell.planes[f]);
        half[side].faces.push_back(face);
      }
      half[side].planes.push_back({-sign * plane.normal, -sign * plane.offset});
      half[side].faces.push_back(cut);
    }
    return {half[0], half[1]};
  }

  void divide_portals(std::uint32_t old_cell, std::uint32_t new_cell, const Plane& plane) {
    std::vector<bsp::Portal> divided;
    for (const bsp::Portal& portal : portals_) {
      if (portal.cluster[0] != old_cell && portal.cluster[1] != old_cell) {
        divided.push_back(portal);
        continue;
      }
      for (const double sign : {-1.0, 1.0}) {
        bsp::Portal piece = portal;
        piece.polygon.vertices = part(portal.polygon.vertices, plane, sign);
        if (piece.polygon.vertices.size() < 3 || area(piece.polygon.vertices) < 1e-12) continue;
        if (sign > 0.0) std::replace(piece.cluster.begin(), piece.cluster.end(), old_cell, new_cell);
        divided.push_back(piece);
      }
    }
    portals_ = std::move(divided);
  }

  Dice dice_;
  WorldSettings settings_;
  std::vector<Cell> cells_;
  std::vector<bsp::Portal> portals_;
};

}  // namespace

Vec3 Dice::direction() {
  for (;;) {
    const Vec3 point(uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0));
    const double norm = point.norm();
    if (norm > 0.1 && norm <= 1.0) return point / norm;
  }
}

Vec3 SplitWorld::point_in(std::size_t cell, Dice& dice) const {
  Vec3 sum = Vec3::Zero();
  double total = 0.0;
  for (const Vec3& corner : corners[cell]) {
    const double weight = dice.uniform(0.01, 1.0);
    sum += weight * weight * corner;
    total += weight * weight;
  }
  return sum / total;
}

SplitWorld split_world(std::uint64_t seed, const WorldSettings& settings) {
  return Builder(seed, settings).build();
}

}  // namespace hallway::pvs::test
