// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "base/text.hpp"
#include "geom/plane.hpp"
#include "map/document.hpp"
#include "map/world.hpp"

/// Maps made in memory, in map units.
namespace hallway::test {

/// A face through three points, clockwise as seen from outside.
inline map::Face face_through(const Vec3& a, const Vec3& b, const Vec3& c,
                              const std::string& material = "wall") {
  map::Face face;
  face.points = {a, b, c};
  face.material = material;
  return face;
}

/// A brush over a convex polygon of (x, y), counter-clockwise from above: first its top, then its bottom, then the sides in their order.
inline map::Brush prism(const std::vector<Vec2>& corners, double low, double high,
                        const std::string& material = "wall") {
  const auto at = [&](std::size_t i, double z) {
    return Vec3(corners[i % corners.size()].x(), corners[i % corners.size()].y(), z);
  };
  map::Brush brush;
  brush.faces.push_back(face_through(at(0, high), at(2, high), at(1, high), material));
  brush.faces.push_back(face_through(at(0, low), at(1, low), at(2, low), material));
  for (std::size_t i = 0; i < corners.size(); ++i)
    brush.faces.push_back(face_through(at(i, low), at(i, high), at(i + 1, low), material));
  return brush;
}

/// An upright box; its faces' points are corners of it.
inline map::Brush box(const Vec3& low, const Vec3& high, const std::string& material = "wall") {
  return prism({{low.x(), low.y()}, {high.x(), low.y()}, {high.x(), high.y()}, {low.x(), high.y()}}, low.z(),
               high.z(), material);
}

/// The points behind all planes, normals outward. Each face's points lie about `spread` apart around the plane's point nearest to
/// `centre`; their coordinates are rounded as those of a file would be.
inline map::Brush polyhedron(const std::vector<Plane>& planes, const Vec3& centre, double spread = 64.0,
                             const std::string& material = "wall") {
  map::Brush brush;
  for (const Plane& plane : planes) {
    const Vec3 u = plane.normal.unitOrthogonal() * spread;
    const Vec3 v = plane.normal.cross(u);
    const Vec3 on = centre - plane.distance(centre) * plane.normal;
    brush.faces.push_back(face_through(on, on + v, on + u, material));
  }
  return brush;
}

/// The brush turned about the origin, then moved.
inline map::Brush moved(map::Brush brush, const Eigen::Quaterniond& turn, const Vec3& shift = Vec3::Zero()) {
  for (map::Face& face : brush.faces) {
    for (Vec3& point : face.points) point = turn * point + shift;
  }
  return brush;
}

/// A polyhedron of 4 to 12 planes that touch a ball of that radius around the centre, and a cube that closes it.
inline map::Brush random_polyhedron(std::mt19937_64& random, const Vec3& centre, double radius,
                                    const std::string& material = "wall") {
  std::normal_distribution<double> normal;
  std::vector<Plane> planes;
  const auto add = [&](const Vec3& direction, double distance) {
    planes.push_back({direction, direction.dot(centre) + distance});
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) add(sign * Vec3::Unit(axis), 1.3 * radius);
  }
  for (int i = static_cast<int>(4 + random() % 9); i > 0; --i) {
    const double x = normal(random);
    const double y = normal(random);
    add(Vec3(x, y, normal(random)).normalized(), radius);
  }
  return polyhedron(planes, centre, radius, material);
}

/// Makes a map entity by entity. All brushes of one call stand in one entity; `worldspawn` is entity 0.
class MapMaker {
 public:
  explicit MapMaker(double metres_per_unit = 0.01) {
    document_.file = "made.map";
    entity("worldspawn", {}, {{"_hallway", "1"}, {"_scale", format_double(metres_per_unit)}});
  }

  /// Adds a brush to worldspawn.
  MapMaker& add(map::Brush brush) {
    document_.entities.front().brushes.push_back(std::move(brush));
    return *this;
  }
  MapMaker& add(const std::vector<map::Brush>& brushes) {
    for (const map::Brush& brush : brushes) add(brush);
    return *this;
  }
  /// hw_detail, hw_add and hw_subtract.
  MapMaker& detail(map::Brush brush, int order = 0) { return ordered("hw_detail", std::move(brush), order); }
  MapMaker& add_later(map::Brush brush, int order) { return ordered("hw_add", std::move(brush), order); }
  MapMaker& subtract(map::Brush brush, int order = 0) {
    return ordered("hw_subtract", std::move(brush), order);
  }
  /// Gives its faces the material that makes it a hint.
  MapMaker& hint(map::Brush brush) {
    for (map::Face& face : brush.faces) face.material = "hint";
    return add(std::move(brush));
  }
  MapMaker& point(const std::string& classname, const Vec3& origin) {
    return entity(classname, {},
                  {{"origin", format_double(origin.x()) + " " + format_double(origin.y()) + " " +
                                  format_double(origin.z())}});
  }
  MapMaker& entity(const std::string& classname, std::vector<map::Brush> brushes,
                   const std::vector<std::pair<std::string, std::string>>& keys = {}) {
    map::Entity& made = document_.entities.emplace_back();
    made.add("classname", classname);
    for (const auto& [key, value] : keys) made.add(key, value);
    made.brushes = std::move(brushes);
    return *this;
  }

  const map::Document& document() const { return document_; }
  map::World world() const { return map::build_world(document_); }

 private:
  MapMaker& ordered(const std::string& classname, map::Brush brush, int order) {
    return entity(classname, {std::move(brush)}, {{"order", std::to_string(order)}});
  }

  map::Document document_;
};

/// The six walls, `thick` units, around the empty box from `low` to `high`: floor, ceiling, then -x, +x, -y, +y. Floor and ceiling reach over
/// the walls, the x walls over the y walls.
inline std::vector<map::Brush> room(const Vec3& low, const Vec3& high, double thick = 16.0) {
  const Vec3 a = low - Vec3::Constant(thick);
  const Vec3 b = high + Vec3::Constant(thick);
  return {box(a, {b.x(), b.y(), low.z()}, "floor"),
          box({a.x(), a.y(), high.z()}, b, "ceiling"),
          box({a.x(), a.y(), low.z()}, {low.x(), b.y(), high.z()}, "west"),
          box({high.x(), a.y(), low.z()}, {b.x(), b.y(), high.z()}, "east"),
          box({low.x(), a.y(), low.z()}, {high.x(), low.y(), high.z()}, "south"),
          box({low.x(), high.y(), low.z()}, {high.x(), b.y(), high.z()}, "north")};
}

/// Which brushes count.
enum class Counting { kAll, kStructure };

/// Whether a point (metres) is solid: the last brush that holds it adds. The definition, brush by brush.
inline bool brushes_solid(const map::World& world, const Vec3& point_m, Counting counting = Counting::kAll) {
  for (auto solid = world.solids.rbegin(); solid != world.solids.rend(); ++solid) {
    if (solid->role == map::BrushRole::kHint) continue;
    if (counting == Counting::kStructure && solid->role == map::BrushRole::kDetail) continue;
    if (solid->contains(point_m)) return solid->role != map::BrushRole::kSubtract;
  }
  return false;
}

/// Whether a point lies within the distance (metres) of the surface of a brush, where rounding may decide.
inline bool near_a_face(const map::World& world, const Vec3& point_m, double distance_m) {
  for (const map::Solid& solid : world.solids) {
    if (solid.contains(point_m, -distance_m) && !solid.contains(point_m, distance_m)) return true;
  }
  return false;
}

}  // namespace hallway::test
