// SPDX-License-Identifier: MIT
#include "render/map_surfaces.hpp"

#include <algorithm>

namespace hallway::render {
namespace {

/// Less headroom than this makes no room.
constexpr double kLeastRoomHeight_m = 1.5;
constexpr double kLevel = 0.9;

Vec3 centre_of(const Polygon& polygon) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& corner : polygon.vertices) sum += corner;
  return sum / static_cast<double>(polygon.vertices.size());
}

/// Whether a face that looks down covers a point of the ground plan.
bool covers(const Polygon& polygon, const Vec3& point) {
  for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
    const Vec3& a = polygon.vertices[i];
    const Vec3& b = polygon.vertices[(i + 1) % polygon.vertices.size()];
    // Counter-clockwise from below is clockwise from above.
    if ((b.x() - a.x()) * (point.y() - a.y()) - (b.y() - a.y()) * (point.x() - a.x()) > 0.0) return false;
  }
  return true;
}

bool has_ceiling(const std::vector<Surface>& surfaces, const Vec3& floor) {
  return std::any_of(surfaces.begin(), surfaces.end(), [&](const Surface& surface) {
    const Polygon& polygon = surface.polygon;
    return polygon.plane.normal.z() < -kLevel && covers(polygon, floor) &&
           centre_of(polygon).z() > floor.z() + kLeastRoomHeight_m;
  });
}

}  // namespace

std::vector<Surface> map_surfaces(const map::World& world) {
  std::vector<Surface> out;
  for (const map::Solid& solid : world.solids) {
    for (const map::SolidFace& face : solid.faces)
      out.push_back({face.polygon, material_colour(face.material)});
  }
  return out;
}

std::optional<double> plan_cut_height(const std::vector<Surface>& surfaces, double above_floor_m) {
  std::vector<Vec3> floors;
  for (const Surface& surface : surfaces) {
    const Polygon& polygon = surface.polygon;
    if (polygon.vertices.size() >= 3 && polygon.plane.normal.z() > kLevel)
      floors.push_back(centre_of(polygon));
  }
  std::stable_sort(floors.begin(), floors.end(), [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
  for (const Vec3& floor : floors) {
    if (has_ceiling(surfaces, floor)) return floor.z() + above_floor_m;
  }
  return std::nullopt;
}

}  // namespace hallway::render
