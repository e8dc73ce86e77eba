// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "base/text.hpp"
#include "bsp/point_location.hpp"
#include "bsp/segment.hpp"
#include "command.hpp"
#include "compiled_map.hpp"
#include "console.hpp"
#include "csg/surface.hpp"
#include "render/map_layers.hpp"
#include "run/pictures/map_view.hpp"
#include "sense/occluders.hpp"
#include "shared_options.hpp"
#include "sim/models.hpp"
#include "trace/scene.hpp"

namespace hallway::cli {
namespace {

struct QueryOptions {
  std::string map;
  std::string from;
  std::string to;
  std::string level = "full";
  bool json = false;
};

void add_places(Command& command, QueryOptions& options) {
  command.argument("map", &options.map, "A .map file").required().value("MAP");
  command.argument("from", &options.from, "Start of the ray, metres").required().value("X,Y,Z");
  command.argument("to", &options.to, "End of the ray, metres").required().value("X,Y,Z");
  add_shared(command, Shared::kJson, &options.json);
}

// ---- pvs ------------------------------------------------------------------------------------------------------------

/// The cluster of a place. Throws Error{kBadInput} where there is none.
std::uint32_t cluster_of(const bsp::Tree& tree, const char* name, const Vec3& place) {
  const std::int32_t cluster = bsp::cluster_at(tree, place);
  if (cluster < 0) {
    throw Error(ErrorCode::kBadInput,
                fmt::format("{} {} is in solid or outside of the map", name, run::place_text(place)));
  }
  return static_cast<std::uint32_t>(cluster);
}

std::string sight_text(const Vec3& from, const Vec3& to, const std::optional<bsp::SegmentHit>& hit) {
  if (!hit) return fmt::format("free: {}", render::measure_text((to - from).norm()));
  return fmt::format("blocked at {}, {} from there", run::place_text(hit->point),
                     render::measure_text((hit->point - from).norm()));
}

int ask_pvs(const QueryOptions& options) {
  const Vec3 from = parse_place("FROM", options.from);
  const Vec3 to = parse_place("TO", options.to);
  const CompiledMap compiled = compile_map({.file = options.map, .level = level_named(options.level)});
  if (!compiled.world.visible) {
    throw Error(ErrorCode::kBadInput,
                "leaks, so nothing is known of what can see what; `hallway map leak` shows where",
                {.file = path_text(options.map)});
  }
  const bsp::Tree& tree = compiled.world.partition.tree;
  const std::uint32_t from_cluster = cluster_of(tree, "FROM", from);
  const std::uint32_t to_cluster = cluster_of(tree, "TO", to);
  const bool visible = compiled.world.visible->visible(from_cluster, to_cluster);
  const auto hit = bsp::first_solid(tree, from, to);
  const int status = visible ? 0 : 1;
  if (options.json) {
    print_json({{"schema", "hallway.pvs/1"},
                {"status", status},
                {"visible", visible},
                {"from", {{"at_m", place_json(from)}, {"cluster", from_cluster}}},
                {"to", {{"at_m", place_json(to)}, {"cluster", to_cluster}}},
                {"clusters", compiled.world.visible->clusters()},
                {"ray_free", !hit},
                {"ray_hit_m", hit ? place_json(hit->point) : Json(nullptr)}});
    return status;
  }
  print_result("{}\n  from         cluster {} at {}\n  to           cluster {} at {}\n  line         {}\n",
               visible ? "visible: somewhere the clusters may see each other"
                       : "hidden: nowhere can the clusters see each other",
               from_cluster, run::place_text(from), to_cluster, run::place_text(to),
               sight_text(from, to, hit));
  return status;
}

// ---- ray ------------------------------------------------------------------------------------------------------------

/// Everything that stops a ray, as triangles, and where each comes from.
class Obstacles {
 public:
  explicit Obstacles(const CompiledMap& compiled)
      : world_(compiled.world),
        models_(sim::load_models(compiled.document, models_folder(compiled))),
        mesh_(sense::make_occluders(world_.partition.surface, sim::triangles_of(models_))) {
    const csg::Surface& surface = world_.partition.surface;
    for (std::uint32_t i = 0; i < surface.polygons.size(); ++i) {
      polygon_.insert(polygon_.end(), csg::triangulate(surface, surface.polygons[i]).size(), i);
    }
    for (std::size_t i = 0; i < models_.meshes.size(); ++i) {
      model_.insert(model_.end(), models_.meshes[i].triangles.size(), i);
    }
  }

  /// The first hit as a document: place, distance, normal and what is hit; null for none.
  Json first_hit(const Vec3& from, const Vec3& to) const {
    const double length = (to - from).norm();
    const auto hit = trace::Scene(mesh_, trace::Backend::kBruteForce).first_hit({from, to - from, length});
    if (!hit) return nullptr;
    const Vec3 at = length > 0.0 ? Vec3(from + hit->distance / length * (to - from)) : from;
    Json met{{"at_m", place_json(at)}, {"distance_m", hit->distance}};
    if (hit->triangle < polygon_.size()) {
      describe_face(world_.partition.surface.polygons[polygon_[hit->triangle]], met);
    } else {
      describe_model(hit->triangle, to - from, met);
    }
    return met;
  }

 private:
  void describe_face(const csg::SurfacePolygon& polygon, Json& met) const {
    const map::Solid& solid = world_.brushes.solids[polygon.solid];
    const map::SolidFace& face = solid.faces[polygon.face];
    met["normal"] = place_json(polygon.plane.normal);
    met["entity"] = solid.entity;
    met["brush"] = solid.brush;
    met["line"] = face.line;
    met["material"] = printable(face.material);
  }

  void describe_model(std::uint32_t triangle, const Vec3& direction, Json& met) const {
    const auto& [a, b, c] = mesh_.triangles[triangle];
    Vec3 normal =
        (mesh_.vertices[b] - mesh_.vertices[a]).cross(mesh_.vertices[c] - mesh_.vertices[a]).normalized();
    if (normal.dot(direction) > 0.0) normal = -normal;  // models are seen from either side
    const mesh::Placement& placement = models_.placements[model_[triangle - polygon_.size()]];
    met["normal"] = place_json(normal);
    met["entity"] = placement.entity;
    met["line"] = placement.line;
    met["model"] = printable(placement.model);
  }

  const world::CompiledWorld& world_;
  sim::PlacedModels models_;
  trace::TriangleMesh mesh_;            ///< the surface's triangles, then those of the models
  std::vector<std::uint32_t> polygon_;  ///< of each triangle of the surface
  std::vector<std::size_t> model_;      ///< of each triangle behind those
};

std::string hit_text(const Json& met) {
  const auto place = [&](const char* key) {
    const auto& values = met.at(key);
    return Vec3(values[0].get<double>(), values[1].get<double>(), values[2].get<double>());
  };
  const Vec3 normal = place("normal");
  const std::string what =
      met.contains("model")
          ? fmt::format("model        {}, entity {}, line {}", met.at("model").get<std::string>(),
                        met.at("entity").get<int>(), met.at("line").get<int>())
          : fmt::format("face         {}, line {}, material {}",
                        map::brush_name(met.at("entity").get<int>(), met.at("brush").get<int>()),
                        met.at("line").get<int>(), met.at("material").get<std::string>());
  return fmt::format("hit after {}\n  at           {}\n  normal       ({:.3f}, {:.3f}, {:.3f})\n  {}\n",
                     render::measure_text(met.at("distance_m").get<double>()), run::place_text(place("at_m")),
                     normal.x(), normal.y(), normal.z(), what);
}

int ask_ray(const QueryOptions& options) {
  const Vec3 from = parse_place("FROM", options.from);
  const Vec3 to = parse_place("TO", options.to);
  const double length = (to - from).norm();
  const CompiledMap compiled = compile_map({.file = options.map});
  const Json met = Obstacles(compiled).first_hit(from, to);
  if (options.json) {
    print_json({{"schema", "hallway.ray/1"}, {"status", 0}, {"length_m", length}, {"hit", met}});
  } else {
    print_result(met.is_null() ? fmt::format("free: {}\n", render::measure_text(length)) : hit_text(met));
  }
  return 0;
}

}  // namespace

void add_map_pvs_command(Command& group) {
  Command& command = group.command(
      "pvs", "Test whether one place can see another, by the potentially visible sets and by a ray");
  QueryOptions& options = command.runs(&ask_pvs);
  add_places(command, options);
  add_shared(command, Shared::kLevel, &options.level);
  command.footer(
      "Status 0 if the sets say visible, 1 if they say hidden.\n"
      "Example: hallway map pvs maps/office.map 1,2,1.5 9,2,1.5");
}

void add_map_ray_command(Command& group) {
  Command& command = group.command("ray", "Find the first face or model that a ray hits");
  QueryOptions& options = command.runs(&ask_ray);
  add_places(command, options);
  command.footer("Example: hallway map ray maps/office.map 1,2,1.5 9,2,1.5");
}

}  // namespace hallway::cli
