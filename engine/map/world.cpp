// SPDX-License-Identifier: MIT
#include "map/world.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

#include "base/text.hpp"
#include "map/content.hpp"
#include "map/convex_body.hpp"
#include "map/entity_keys.hpp"

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

/// A pair of faces on one plane.
struct Duplicate {
  std::size_t first;
  std::size_t second;
};

std::optional<Duplicate> find_duplicate(const LocalPlanes& local) {
  for (std::size_t i = 0; i < local.planes.size(); ++i) {
    for (std::size_t j = i + 1; j < local.planes.size(); ++j) {
      const Plane& a = local.planes[i];
      const Plane& b = local.planes[j];
      if ((a.normal - b.normal).norm() > kSameNormal || std::abs(a.offset - b.offset) > local.tolerance)
        continue;
      return Duplicate{i, j};
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
    face.points = brush.faces[side.plane].points;
    face.drawn = is_drawn(face.material);
    face.polygon.plane = {plane.normal, (plane.offset + plane.normal.dot(local.origin)) * scale};
    for (const std::uint32_t v : side.loop) face.polygon.vertices.push_back(vertices[v]);
    solid.planes.push_back(face.polygon.plane);
    solid.faces.push_back(std::move(face));
  }
  for (const Vec3& vertex : vertices) solid.box.extend(vertex);
  return solid;
}

Cause explain_unread(const Brush& brush) {
  const std::string word = brush.unread.substr(0, brush.unread.find_first_of(" \t\r\n\v\f{"));
  const bool patch = word.starts_with("patchDef");
  return {brush.line, "`" + printable(word, 60) + "`: " +
                          (patch ? "patches are not read" : "this form of brush is not read; `brushDef` is")};
}

/// A body, or why there is none; and what is odd about a brush that is one all the same.
struct BuiltSolid {
  std::variant<Solid, Cause> solid;
  std::optional<Cause> note{};
};

BuiltSolid build_solid(const Brush& brush, double scale) {
  if (!brush.unread.empty()) return {explain_unread(brush)};
  if (auto cause = check_faces(brush)) return {*cause};
  const LocalPlanes local = local_planes(brush);
  if (const auto duplicate = find_duplicate(local)) {
    // The first of the two is enough: the half-spaces are the same.
    const Face& second = brush.faces[duplicate->second];
    const std::string message = lines_of(brush.faces[duplicate->first], second) + " lie on the same plane";
    Brush rest = brush;
    rest.faces.erase(rest.faces.begin() + static_cast<std::ptrdiff_t>(duplicate->second));
    BuiltSolid built = build_solid(rest, scale);
    built.note = Cause{second.line, message};
    return built;
  }
  const auto body = intersect_half_spaces(local.planes, kReach, local.tolerance);
  if (const auto* fault = std::get_if<ConvexFault>(&body)) return {explain(*fault, brush, local)};
  return {to_metres(std::get<ConvexBody>(body), local, brush, scale)};
}

/// What is wrong with a brush, if anything.
std::optional<Problem> problem_of(const BuiltSolid& built, int entity, int brush) {
  if (const auto* cause = std::get_if<Cause>(&built.solid))
    return Problem{entity, brush, cause->line, cause->message, true};
  if (built.note) return Problem{entity, brush, built.note->line, built.note->message, false};
  return std::nullopt;
}

class WorldBuilder {
 public:
  explicit WorldBuilder(const Document& document) : document_(document) {
    world_.metres_per_unit = document.metres_per_unit();
  }

  World build() {
    for (std::size_t i = 0; i < document_.entities.size(); ++i) add_entity(i);
    std::stable_sort(ordered_.begin(), ordered_.end(),
                     [](const Ordered& a, const Ordered& b) { return a.order < b.order; });
    for (Ordered& next : ordered_) world_.solids.push_back(std::move(next.solid));
    for (const auto& [reason, brushes] : left_out_) world_.left_out.push_back({reason, brushes});
    return std::move(world_);
  }

 private:
  struct Ordered {
    std::int64_t order;
    Solid solid;
  };

  void add_entity(std::size_t index) {
    const Entity& entity = document_.entities[index];
    const std::int64_t order = order_of(entity);
    for (std::size_t i = 0; i < entity.brushes.size(); ++i) {
      const Brush& brush = entity.brushes[i];
      const BrushContent content = brush_content(entity, brush);
      if (!content.role) {
        ++left_out_[content.left_out];
        continue;
      }
      auto solid = solid_from(brush, static_cast<int>(index), static_cast<int>(i));
      if (!solid) continue;
      solid->role = *content.role;
      if (is_material(solid->role)) world_.bounds.extend(solid->box);
      if (content.ordered) {
        ordered_.push_back({order, *std::move(solid)});
      } else {
        world_.solids.push_back(*std::move(solid));
      }
    }
  }

  /// Key `order` of the classes that have it; also refuses keys that those classes do not have.
  std::int64_t order_of(const Entity& entity) const {
    const EntityKeys keys(document_, entity);
    const std::string_view name = entity.classname();
    const bool ordered = name == "hw_add" || name == "hw_subtract" || name == "hw_detail";
    if (ordered) keys.refuse_unknown();
    return ordered && keys.has("order") ? keys.integer("order") : 0;
  }

  std::optional<Solid> solid_from(const Brush& brush, int entity_index, int brush_index) {
    BuiltSolid built = build_solid(brush, world_.metres_per_unit);
    if (auto problem = problem_of(built, entity_index, brush_index))
      world_.problems.push_back(*std::move(problem));
    if (!std::holds_alternative<Solid>(built.solid)) return std::nullopt;
    Solid solid = std::get<Solid>(std::move(built.solid));
    solid.entity = entity_index;
    solid.brush = brush_index;
    solid.line = brush.line;
    return solid;
  }

  const Document& document_;
  World world_;
  std::vector<Ordered> ordered_;
  std::map<LeftOut, std::size_t> left_out_;
};

}  // namespace

bool Solid::contains(const Vec3& point, double inset_m) const {
  return std::all_of(planes.begin(), planes.end(),
                     [&](const Plane& plane) { return plane.distance(point) <= -inset_m; });
}

World build_world(const Document& document) {
  return WorldBuilder(document).build();
}

std::vector<Problem> brush_problems(const Document& document) {
  std::vector<Problem> problems;
  for (std::size_t e = 0; e < document.entities.size(); ++e) {
    const Entity& entity = document.entities[e];
    for (std::size_t b = 0; b < entity.brushes.size(); ++b) {
      if (!brush_content(entity, entity.brushes[b]).role) continue;
      const BuiltSolid built = build_solid(entity.brushes[b], kQuakeMetresPerUnit);
      if (auto problem = problem_of(built, static_cast<int>(e), static_cast<int>(b)))
        problems.push_back(*std::move(problem));
    }
  }
  return problems;
}

std::string problem_text(const Problem& problem) {
  return problem.message + (problem.left_out ? "; the brush is left out" : "; the first of them counts");
}

std::string brush_name(int entity, int brush) {
  return "entity " + std::to_string(entity) + ", brush " + std::to_string(brush);
}

}  // namespace hallway::map
