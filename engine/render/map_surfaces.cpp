// SPDX-License-Identifier: MIT
#include "render/map_surfaces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "render/leaf_pieces.hpp"

namespace hallway::render {
namespace {

Polygon polygon_of(const csg::Surface& surface, const csg::SurfacePolygon& polygon) {
  Polygon out{{}, polygon.plane};
  out.vertices.reserve(polygon.vertices.size());
  for (const std::uint32_t vertex : polygon.vertices) out.vertices.push_back(surface.vertices[vertex]);
  return out;
}

/// A piece of a face and its colour.
struct Piece {
  Polygon polygon{};
  Rgb colour{};
};

/// A face in pieces of one colour: whole where they are all of one.
class Painter {
 public:
  Painter(const bsp::Compiled& compiled, Faces faces, const LeafColour& colour)
      : compiled_(compiled), faces_(faces), colour_(colour) {}

  std::vector<Piece> pieces(const Polygon& face, Rgb material) const {
    std::vector<Piece> out;
    bool whole = true;
    for (LeafPiece& piece : leaf_pieces(compiled_.tree, face)) {
      const bool inside = compiled_.tree.leaves[piece.leaf].content == bsp::Content::kEmpty;
      const bool kept = inside || faces_ == Faces::kAll;
      whole = whole && kept;
      if (kept) out.push_back({std::move(piece.polygon), inside ? colour_(piece.leaf, material) : material});
      whole = whole && (out.empty() || out.back().colour == out.front().colour);
    }
    if (whole && !out.empty()) return {{face, out.front().colour}};
    return out;
  }

 private:
  const bsp::Compiled& compiled_;
  Faces faces_;
  const LeafColour& colour_;
};

// ---- meshes ---------------------------------------------------------------------------------------------------------

Rgb colour_of(const mesh::Material& material) {
  const auto channel = [&](std::size_t c) {
    return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(material.base_colour[c], 0.0f, 1.0f)));
  };
  return {channel(0), channel(1), channel(2)};
}

// ---- plans ----------------------------------------------------------------------------------------------------------

/// Less headroom than this makes no room.
constexpr double kLeastRoomHeight_m = 1.5;
constexpr double kLevel = 0.9;
/// A floor this much above a cut's own is a step; more, and the cut runs through what stands on it.
constexpr double kSteps_m = 1.0;
/// A cut that opens less of the floor than this is not worth what it closes.
constexpr double kLeastShare = 0.6;

/// A face that is nearly level, seen from above.
struct LevelFace {
  Polygon polygon{};
  Box box{};
  Vec3 centre = Vec3::Zero();
  double area_m2 = 0.0;
};

LevelFace level_face(Polygon polygon) {
  LevelFace face;
  for (const Vec3& corner : polygon.vertices) {
    face.centre += corner / static_cast<double>(polygon.vertices.size());
    face.box.extend(corner);
  }
  for (std::size_t i = 2; i < polygon.vertices.size(); ++i) {
    const Vec3 a = polygon.vertices[i - 1] - polygon.vertices[0];
    const Vec3 b = polygon.vertices[i] - polygon.vertices[0];
    face.area_m2 += 0.5 * std::abs(a.x() * b.y() - a.y() * b.x());
  }
  face.polygon = std::move(polygon);
  return face;
}

/// Whether a face that looks down covers a point of the ground plan.
bool covers(const LevelFace& face, const Vec3& point) {
  if (point.x() < face.box.min().x() || point.x() > face.box.max().x() || point.y() < face.box.min().y() ||
      point.y() > face.box.max().y()) {
    return false;
  }
  const std::vector<Vec3>& corners = face.polygon.vertices;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3& a = corners[i];
    const Vec3& b = corners[(i + 1) % corners.size()];
    // Counter-clockwise from below is clockwise from above.
    if ((b.x() - a.x()) * (point.y() - a.y()) - (b.y() - a.y()) * (point.x() - a.x()) > 0.0) return false;
  }
  return true;
}

/// A floor with headroom: where rooms are.
struct Room {
  Box plan{};  ///< around the floor
  double floor_m = 0.0;
  double ceiling_m = 0.0;
  double area_m2 = 0.0;
};

std::vector<Room> find_rooms(const bsp::Compiled& compiled) {
  std::vector<LevelFace> floors;
  std::vector<LevelFace> ceilings;
  for (std::size_t i = 0; i < compiled.surface.polygons.size(); ++i) {
    const csg::SurfacePolygon& polygon = compiled.surface.polygons[i];
    if (polygon.vertices.size() < 3 || !compiled.inside[i]) continue;
    if (polygon.plane.normal.z() > kLevel)
      floors.push_back(level_face(polygon_of(compiled.surface, polygon)));
    if (polygon.plane.normal.z() < -kLevel)
      ceilings.push_back(level_face(polygon_of(compiled.surface, polygon)));
  }
  std::vector<Room> rooms;
  for (const LevelFace& floor : floors) {
    double ceiling_m = std::numeric_limits<double>::infinity();
    for (const LevelFace& ceiling : ceilings) {
      const double height = ceiling.centre.z();
      if (height > floor.centre.z() && height < ceiling_m && covers(ceiling, floor.centre))
        ceiling_m = height;
    }
    const double headroom = ceiling_m - floor.centre.z();
    if (headroom > kLeastRoomHeight_m && std::isfinite(headroom)) {
      rooms.push_back({floor.box, floor.centre.z(), ceiling_m, floor.area_m2});
    }
  }
  return rooms;
}

/// Floor that a cut at that height shows from not too far above.
double opened_m2(const std::vector<Room>& rooms, double cut_m, double above_floor_m) {
  double sum = 0.0;
  for (const Room& room : rooms) {
    const double above = cut_m - room.floor_m;
    if (room.ceiling_m > cut_m && above > 0.0 && above < above_floor_m + kSteps_m) sum += room.area_m2;
  }
  return sum;
}

struct Cut {
  double height_m = 0.0;
  double opened_m2 = -1.0;
};

Cut best_cut(const std::vector<Room>& rooms, double above_floor_m) {
  std::vector<double> heights;
  for (const Room& room : rooms) heights.push_back(room.floor_m + above_floor_m);
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  Cut best;
  for (const double height : heights) {
    const double opened = opened_m2(rooms, height, above_floor_m);
    if (opened > best.opened_m2 * (1.0 + 1e-9)) best = {height, opened};
  }
  return best;
}

/// The floor of the room that holds a place, if there is one.
std::optional<double> floor_under(const std::vector<Room>& rooms, const Vec3& place) {
  std::optional<double> floor;
  for (const Room& room : rooms) {
    const bool above = place.x() >= room.plan.min().x() && place.x() <= room.plan.max().x() &&
                       place.y() >= room.plan.min().y() && place.y() <= room.plan.max().y() &&
                       place.z() >= room.floor_m && place.z() <= room.ceiling_m;
    if (above && (!floor || room.floor_m > *floor)) floor = room.floor_m;
  }
  return floor;
}

}  // namespace

std::vector<Surface> map_surfaces(const map::World& world, const bsp::Compiled& compiled, Faces faces) {
  return map_surfaces(world, compiled, faces, [](std::uint32_t, Rgb material) { return material; });
}

std::vector<Surface> map_surfaces(const map::World& world, const bsp::Compiled& compiled, Faces faces,
                                  const LeafColour& colour) {
  const Painter painter(compiled, faces, colour);
  std::vector<Surface> out;
  for (std::size_t i = 0; i < compiled.surface.polygons.size(); ++i) {
    const csg::SurfacePolygon& polygon = compiled.surface.polygons[i];
    if (polygon.vertices.size() < 3 || (faces == Faces::kInside && !compiled.inside[i])) continue;
    const map::SolidFace& face = world.solids[polygon.solid].faces[polygon.face];
    const SurfaceKind kind = face.drawn ? SurfaceKind::kSolid : SurfaceKind::kUnseen;
    for (Piece& piece :
         painter.pieces(polygon_of(compiled.surface, polygon), material_colour(face.material))) {
      out.push_back({std::move(piece.polygon), piece.colour, kind});
    }
  }
  return out;
}

Textures model_textures(std::vector<mesh::Image> images) {
  Textures textures;
  for (mesh::Image& image : images) {
    textures.push_back(
        std::make_shared<const Texture>(Texture{image.width, image.height, std::move(image.rgba)}));
  }
  return textures;
}

std::vector<Surface> mesh_surfaces(const mesh::Model& model, const Textures& textures,
                                   const mesh::PlacedMesh& placed) {
  std::vector<Surface> out;
  out.reserve(placed.triangles.size());
  for (std::size_t i = 0; i < placed.triangles.size(); ++i) {
    const std::array<Vec3, 3> corners = placed.corners(i);
    const Vec3 across = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    if (!(across.norm() > 0.0)) continue;
    const Vec3 normal = across.normalized();
    const mesh::Triangle& triangle = placed.triangles[i];
    const mesh::Material& material = model.materials[triangle.material];
    Surface surface{{{corners.begin(), corners.end()}, {normal, normal.dot(corners[0])}},
                    colour_of(material),
                    SurfaceKind::kSheet};
    if (material.image && !model.uv.empty()) {
      surface.texture = textures.at(*material.image);
      for (const std::uint32_t vertex : triangle.vertices) surface.uv.push_back(model.uv[vertex]);
    }
    out.push_back(std::move(surface));
  }
  return out;
}

Plan plan_of(const bsp::Compiled& compiled, const std::optional<Vec3>& focus, double above_floor_m) {
  const std::vector<Room> rooms = find_rooms(compiled);
  if (rooms.empty()) return {};
  double total = 0.0;
  for (const Room& room : rooms) total += room.area_m2;
  const Cut best = best_cut(rooms, above_floor_m);
  if (best.opened_m2 >= kLeastShare * total) return {Faces::kAll, best.height_m};
  if (compiled.enclosure.sealed) return {Faces::kInside, std::nullopt};
  const std::optional<double> floor = focus ? floor_under(rooms, *focus) : std::nullopt;
  return {Faces::kAll, floor ? *floor + above_floor_m : best.height_m};
}

}  // namespace hallway::render
