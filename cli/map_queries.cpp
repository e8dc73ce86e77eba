// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <memory>

#include "base/text.hpp"
#include "bsp/point_location.hpp"
#include "bsp/segment.hpp"
#include "compiled_map.hpp"
#include "console.hpp"
#include "csg/surface.hpp"
#include "map_command.hpp"
#include "render/map_layers.hpp"
#include "run/map_view.hpp"
#include "trace/scene.hpp"

namespace hallway::cli {
namespace {

using Json = nlohmann::ordered_json;

struct QueryOptions {
  std::string map;
  std::string from;
  std::string to;
  std::string level = "full";
  bool json = false;
};

Json place_json(const Vec3& place) {
  return Json::array({place.x(), place.y(), place.z()});
}

void add_places(CLI::App& command, QueryOptions& options) {
  command.add_option("map", options.map, "A .map file")->required()->type_name("MAP");
  command.add_option("from", options.from, "Where to look from, metres")->required()->type_name("X,Y,Z");
  command.add_option("to", options.to, "Where to look to, metres")->required()->type_name("X,Y,Z");
  command.add_flag("--json", options.json, "Print one JSON document");
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
  const CompiledMap compiled = compile_map(
      {.file = options.map, .level = options.level == "full" ? pvs::Level::kFull : pvs::Level::kFast});
  if (!compiled.world.visible) {
    throw Error(ErrorCode::kBadInput,
                "leaks, so nothing is known of what can see what; `hallway map leak` shows where",
                {.file = printable(options.map, 4096)});
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
  print_result(fmt::format(
      "{}\n  from         cluster {} at {}\n  to           cluster {} at {}\n  line         {}\n",
      visible ? "visible: somewhere the clusters may see each other"
              : "hidden: nowhere can the clusters see each other",
      from_cluster, run::place_text(from), to_cluster, run::place_text(to), sight_text(from, to, hit)));
  return status;
}

// ---- ray ------------------------------------------------------------------------------------------------------------

/// The surface as triangles, and which polygon each comes from.
struct Triangles {
  trace::TriangleMesh mesh{};
  std::vector<std::uint32_t> polygon{};
};

Triangles triangles_of(const csg::Surface& surface) {
  Triangles out;
  out.mesh.vertices = surface.vertices;
  for (std::uint32_t i = 0; i < surface.polygons.size(); ++i) {
    for (const auto& triangle : csg::triangulate(surface, surface.polygons[i])) {
      out.mesh.triangles.push_back(triangle);
      out.polygon.push_back(i);
    }
  }
  return out;
}

/// What a ray meets.
struct Met {
  double distance_m = 0.0;
  Vec3 at = Vec3::Zero();
  const csg::SurfacePolygon* polygon = nullptr;
};

std::optional<Met> first_face(const csg::Surface& surface, const Vec3& from, const Vec3& to) {
  const Triangles triangles = triangles_of(surface);
  const double length = (to - from).norm();
  const auto hit =
      trace::Scene(triangles.mesh, trace::Backend::kBruteForce).first_hit({from, to - from, length});
  if (!hit) return std::nullopt;
  const Vec3 at = length > 0.0 ? Vec3(from + hit->distance / length * (to - from)) : from;
  return Met{hit->distance, at, &surface.polygons[triangles.polygon[hit->triangle]]};
}

int ask_ray(const QueryOptions& options) {
  const Vec3 from = parse_place("FROM", options.from);
  const Vec3 to = parse_place("TO", options.to);
  const CompiledMap compiled = compile_map({.file = options.map});
  const world::CompiledWorld& world = compiled.world;
  const std::optional<Met> met = first_face(world.partition.surface, from, to);
  if (!met) {
    if (options.json) {
      print_json(
          {{"schema", "hallway.ray/1"}, {"status", 0}, {"length_m", (to - from).norm()}, {"hit", nullptr}});
    } else {
      print_result(fmt::format("free: {}\n", render::measure_text((to - from).norm())));
    }
    return 0;
  }
  const map::Solid& solid = world.brushes.solids[met->polygon->solid];
  const map::SolidFace& face = solid.faces[met->polygon->face];
  const Vec3& normal = met->polygon->plane.normal;
  if (options.json) {
    print_json({{"schema", "hallway.ray/1"},
                {"status", 0},
                {"length_m", (to - from).norm()},
                {"hit",
                 {{"at_m", place_json(met->at)},
                  {"distance_m", met->distance_m},
                  {"normal", place_json(normal)},
                  {"entity", solid.entity},
                  {"brush", solid.brush},
                  {"line", face.line},
                  {"material", printable(face.material)}}}});
    return 0;
  }
  print_result(fmt::format(
      "hit after {}\n  at           {}\n  normal       ({:.3f}, {:.3f}, {:.3f})\n  face         {}, line {}, "
      "material {}\n",
      render::measure_text(met->distance_m), run::place_text(met->at), normal.x(), normal.y(), normal.z(),
      map::brush_name(solid.entity, solid.brush), face.line, printable(face.material)));
  return 0;
}

}  // namespace

void add_map_pvs_command(CLI::App& group, Action& chosen) {
  CLI::App* command =
      group.add_subcommand("pvs", "Say whether one place may see another by the visible sets, and by a line");
  const auto options = std::make_shared<QueryOptions>();
  add_places(*command, *options);
  command->add_option("--level", options->level, "How hard to look for what cannot be seen")
      ->check(CLI::IsMember({"fast", "full"}))
      ->capture_default_str();
  command->footer(
      "Status 0 if the sets say visible, 1 if they say hidden.\n"
      "Example: hallway map pvs maps/office.map 1,2,1.5 9,2,1.5");
  command->callback([&chosen, options] { chosen = [options] { return ask_pvs(*options); }; });
}

void add_map_ray_command(CLI::App& group, Action& chosen) {
  CLI::App* command = group.add_subcommand("ray", "Say which face of the map is met first on a line");
  const auto options = std::make_shared<QueryOptions>();
  add_places(*command, *options);
  command->footer("Example: hallway map ray maps/office.map 1,2,1.5 9,2,1.5");
  command->callback([&chosen, options] { chosen = [options] { return ask_ray(*options); }; });
}

}  // namespace hallway::cli
