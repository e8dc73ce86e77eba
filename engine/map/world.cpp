// SPDX-License-Identifier: MIT
#include "map/world.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

#include "base/text.hpp"
#include "map/convex_body.hpp"

namespace hallway::map {
namespace {

constexpr double kReach = 4.0 * kMaxCoordinate;  ///< half the cube that holds a brush, units
constexpr double kFlatAngle = 1e-9;              ///< radians; three points closer to a line give no plane
constexpr double kSameNormal = 1e-9;             ///< radians between planes that count as one

/// The cause why a brush is no body, and the line to look at.
struct Cause {
  int line;
  std::string message;
};

/// Planes of a brush in map units, relative to `origin`, which keeps their offsets small.
struct LocalPlanes {
  Vec3 origin;
  double tolerance;
  std::vector<Plane> planes;
};

std::string lines_of(const Face& a, const Face& b) {
  return "the faces at lines " + std::to_string(a.line) + " and " + std::to_string(b.line);
}

std::optional<Cause> check_faces(const Brush& brush) {
  constexpr std::size_t kFewestFaces = 4;
  if (brush.faces.size() < kFewestFaces) {
    return Cause{brush.line,
                 "the brush has " + std::to_string(brush.faces.size()) + " faces; a solid has at least 4"};
  }
  if (brush.faces.size() > kMaxBrushFaces) {
    return Cause{brush.line, "the brush has " + std::to_string(brush.faces.size()) + " faces; the limit is " +
                                 std::to_string(kMaxBrushFaces)};
  }
  for (const Face& face : brush.faces) {
    for (const Vec3& point : face.points) {
      if (point.cwiseAbs().maxCoeff() <= kMaxCoordinate) continue;
      return Cause{face.line, "the coordinate " + format_double(point.cwiseAbs().maxCoeff()) +
                                  " lies beyond " + format_double(kMaxCoordinate) + " units"};
    }
    const Vec3 a = face.points[1] - face.points[0];
    const Vec3 b = face.points[2] - face.points[0];
    const Vec3 c = face.points[2] - face.points[1];
    const double shortest = std::min({a.norm(), b.norm(), c.norm()});
    if (shortest == 0.0) return Cause{face.line, "two of the face's three points are the same"};
    if (a.cross(b).norm() <= kFlatAngle * a.norm() * b.norm()) {
      return Cause{face.line, "the face's three points lie on one line"};
    }
  }
  return std::nullopt;
}

LocalPlanes local_planes(const Brush& brush) {
  LocalPlanes local;
  local.origin = Vec3::Zero();
  for (const Face& face : brush.faces)
    local.origin += face.points[0] / static_cast<double>(brush.faces.size());
  local.origin = local.origin.array().round();  // whole coordinates stay whole
  double size = 0.0;
  for (const Face& face : brush.faces) {
    const Vec3 normal = (face.points[2] - face.points[0]).cross(face.points[1] - face.points[0]).normalized();
    const Vec3 on_plane = face.points[0] - local.origin;
    local.planes.push_back({normal, normal.dot(on_plane)});
    size = std::max(size, on_plane.norm());
  }
  local.tolerance = 1e-6 + 1e-12 * size;  // well above rounding, well below what an editor can place
  return local;
}

std::optional<Cause> find_duplicates(const Brush& brush, const LocalPlanes& local) {
  for (std::size_t i = 0; i < local.planes.size(); ++i) {
    for (std::size_t j = i + 1; j < local.planes.size(); ++j) {
      const Plane& a = local.planes[i];
      const Plane& b = local.planes[j];
      if ((a.normal - b.normal).norm() > kSameNormal || std::abs(a.offset - b.offset) > local.tolerance)
        continue;
      return Cause{brush.faces[j].line, lines_of(brush.faces[i], brush.faces[j]) + " lie on the same plane"};
    }
  }
  return std::nullopt;
}

bool is_body_inside_out(const LocalPlanes& local) {
  std::vector<Plane> flipped;
  for (const Plane& plane : local.planes) flipped.push_back({-plane.normal, -plane.offset});
  return std::holds_alternative<ConvexBody>(intersect_half_spaces(flipped, kReach, local.tolerance));
}

Cause explain_empty(const Brush& brush, const LocalPlanes& local) {
  if (is_body_inside_out(local)) {
    return {brush.line,
            "the brush is inside out: its faces' points run counter-clockwise as seen from outside"};
  }
  for (std::size_t i = 0; i < local.planes.size(); ++i) {
    for (std::size_t j = i + 1; j < local.planes.size(); ++j) {
      const Plane& a = local.planes[i];
      const Plane& b = local.planes[j];
      if ((a.normal + b.normal).norm() > kSameNormal || a.offset + b.offset > local.tolerance) continue;
      return {brush.faces[j].line, lines_of(brush.faces[i], brush.faces[j]) +
                                       " are parallel and leave no room between them (" +
                                       format_double(a.offset + b.offset) + " units)"};
    }
  }
  return {brush.line, "no point lies behind all faces of the brush, or it is thinner than " +
                          format_double(local.tolerance) + " units"};
}

Cause explain(ConvexFault fault, const Brush& brush, const LocalPlanes& local) {
  switch (fault) {
    case ConvexFault::kUnbounded:
      return {brush.line, "the brush is not closed: its faces do not bound a finite solid"};
    case ConvexFault::kUnstable:
      return {brush.line, "faces of the brush are so nearly alike that its shape is not defined"};
    case ConvexFault::kEmpty:
      break;
  }
  return explain_empty(brush, local);
}

Solid to_metres(const ConvexBody& body, const LocalPlanes& local, const Brush& brush, double scale) {
  std::vector<Vec3> vertices;
  for (const Vec3& vertex : body.vertices) vertices.push_back((vertex + local.origin) * scale);
  Solid solid;
  for (const ConvexBody::Side& side : body.sides) {
    const Plane& plane = local.planes[side.plane];
    SolidFace face;
    face.material = brush.faces[side.plane].material;
    face.line = brush.faces[side.plane].line;
    face.polygon.plane = {plane.normal, (plane.offset + plane.normal.dot(local.origin)) * scale};
    for (const std::uint32_t v : side.loop) face.polygon.vertices.push_back(vertices[v]);
    solid.planes.push_back(face.polygon.plane);
    solid.faces.push_back(std::move(face));
  }
  for (const Vec3& vertex : vertices) solid.box.extend(vertex);
  return solid;
}

std::variant<Solid, Cause> build_solid(const Brush& brush, double scale) {
  if (auto cause = check_faces(brush)) return *cause;
  const LocalPlanes local = local_planes(brush);
  if (auto cause = find_duplicates(brush, local)) return *cause;
  const auto body = intersect_half_spaces(local.planes, kReach, local.tolerance);
  if (const auto* fault = std::get_if<ConvexFault>(&body)) return explain(*fault, brush, local);
  return to_metres(std::get<ConvexBody>(body), local, brush, scale);
}

bool is_world_class(std::string_view classname) {
  return classname == "worldspawn" || classname == "func_group";
}

}  // namespace

bool Solid::contains(const Vec3& point, double inset_m) const {
  return std::all_of(planes.begin(), planes.end(),
                     [&](const Plane& plane) { return plane.distance(point) <= -inset_m; });
}

World build_world(const Document& document) {
  const double scale = document.metres_per_unit();
  World world;
  for (std::size_t e = 0; e < document.entities.size(); ++e) {
    const Entity& entity = document.entities[e];
    if (!is_world_class(entity.classname())) continue;
    for (std::size_t b = 0; b < entity.brushes.size(); ++b) {
      auto result = build_solid(entity.brushes[b], scale);
      const int entity_index = static_cast<int>(e);
      const int brush_index = static_cast<int>(b);
      if (const auto* cause = std::get_if<Cause>(&result)) {
        world.problems.push_back({entity_index, brush_index, cause->line, cause->message});
        continue;
      }
      Solid solid = std::get<Solid>(std::move(result));
      solid.entity = entity_index;
      solid.brush = brush_index;
      solid.line = entity.brushes[b].line;
      world.bounds.extend(solid.box);
      world.solids.push_back(std::move(solid));
    }
  }
  return world;
}

std::string brush_name(int entity, int brush) {
  return "entity " + std::to_string(entity) + ", brush " + std::to_string(brush);
}

}  // namespace hallway::map
