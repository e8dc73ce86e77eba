// SPDX-License-Identifier: MIT
#include "mesh/import.hpp"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "map/world.hpp"

namespace hallway::mesh {
namespace {

namespace fs = std::filesystem;

constexpr double kMetresPerUnit = 0.01;
constexpr double kWall_m = 0.2;  ///< thickness of the hull
constexpr double kUnderFloor_m =
    0.1;  ///< the hull's floor lies that far below the model, so that they do not coincide
constexpr double kLeastMargin_m = 1.0;
constexpr double kStart_m = 0.8;  ///< height of the robot start above the floor

/// A box in map units, on whole units.
struct Block {
  Vec3 low;
  Vec3 high;
};

Vec3 rounded(const Vec3& point_m, double (*round)(double)) {
  return (point_m / kMetresPerUnit).unaryExpr([round](double value) { return round(value); });
}

map::Face face(const std::array<Vec3, 3>& points, const std::string& material, bool level, bool along_x) {
  map::Face result;
  result.points = points;
  result.material = material;
  result.u_axis = level || along_x ? Vec3::UnitX() : Vec3::UnitY();
  result.v_axis = level ? Vec3(0.0, -1.0, 0.0) : Vec3(0.0, 0.0, -1.0);
  return result;
}

/// An upright box; the points of each face run clockwise seen from outside.
map::Brush brush(const Block& block, const std::string& material) {
  const auto& [l, h] = block;
  map::Brush result;
  result.faces = {face({Vec3(l.x(), l.y(), h.z()), Vec3(h.x(), h.y(), h.z()), Vec3(h.x(), l.y(), h.z())},
                       material, true, true),
                  face({Vec3(l.x(), l.y(), l.z()), Vec3(h.x(), l.y(), l.z()), Vec3(h.x(), h.y(), l.z())},
                       material, true, true),
                  face({Vec3(l.x(), l.y(), l.z()), Vec3(l.x(), l.y(), h.z()), Vec3(h.x(), l.y(), l.z())},
                       material, false, true),
                  face({Vec3(h.x(), l.y(), l.z()), Vec3(h.x(), l.y(), h.z()), Vec3(h.x(), h.y(), l.z())},
                       material, false, false),
                  face({Vec3(h.x(), h.y(), l.z()), Vec3(h.x(), h.y(), h.z()), Vec3(l.x(), h.y(), l.z())},
                       material, false, true),
                  face({Vec3(l.x(), h.y(), l.z()), Vec3(l.x(), h.y(), h.z()), Vec3(l.x(), l.y(), l.z())},
                       material, false, false)};
  return result;
}

/// Six blocks around `room`: floor and ceiling over everything, walls between them.
std::vector<map::Brush> hull(const Block& room) {
  const double wall = std::round(kWall_m / kMetresPerUnit);
  const Vec3 l = room.low - Vec3::Constant(wall);
  const Vec3 h = room.high + Vec3::Constant(wall);
  const auto& [a, b] = room;
  return {brush({l, {h.x(), h.y(), a.z()}}, "floor"),
          brush({{l.x(), l.y(), b.z()}, h}, "ceiling"),
          brush({{l.x(), l.y(), a.z()}, {a.x(), h.y(), b.z()}}, "wall"),
          brush({{b.x(), l.y(), a.z()}, {h.x(), h.y(), b.z()}}, "wall"),
          brush({{a.x(), l.y(), a.z()}, {b.x(), a.y(), b.z()}}, "wall"),
          brush({{a.x(), b.y(), a.z()}, {b.x(), h.y(), b.z()}}, "wall")};
}

std::string numbers(const Vec3& values) {
  return format_double(values.x()) + " " + format_double(values.y()) + " " + format_double(values.z());
}

map::Entity entity(const std::vector<std::pair<std::string, std::string>>& keys) {
  map::Entity result;
  for (const auto& [key, value] : keys) result.keys.push_back({.key = key, .value = value});
  return result;
}

Block room_around(const Model& model, const ImportOptions& options) {
  const double units = options.units ? *options.units / model.metres_per_unit : 1.0;
  const Box bounds = bounds_of(model);
  const double margin = std::max(options.margin_m, kLeastMargin_m);
  Block room{rounded(units * bounds.min() - Vec3(margin, margin, kUnderFloor_m), std::floor),
             rounded(units * bounds.max() + Vec3::Constant(margin), std::ceil)};
  const double reach = std::max(room.low.cwiseAbs().maxCoeff(), room.high.cwiseAbs().maxCoeff());
  if (reach > map::kMaxCoordinate / 2.0) {
    throw Error(ErrorCode::kBadInput,
                "the model reaches " + format_double(std::round(reach * kMetresPerUnit)) +
                    " m from its origin, too far for a map; is its unit right (--units)?",
                {.file = printable(options.model, kMaxNameBytes)});
  }
  return room;
}

fs::path canonical_or_throw(const fs::path& path) {
  std::error_code problem;
  fs::path found = fs::canonical(path, problem);
  if (problem)
    throw Error(ErrorCode::kIo, "cannot open: " + problem.message(),
                {.file = printable(path.string(), kMaxNameBytes)});
  return found;
}

}  // namespace

map::Document import_document(const Model& model, const ImportOptions& options) {
  const Block room = room_around(model, options);
  map::Document document;
  map::Entity world = entity({{"classname", "worldspawn"},
                              {"mapversion", "220"},
                              {"_hallway", "1"},
                              {"_scale", format_double(kMetresPerUnit)}});
  world.comments = {" Game: Hallway", " Format: Valve"};
  world.brushes = hull(room);
  document.entities.push_back(std::move(world));
  map::Entity placed = entity({{"classname", "hw_mesh"}, {"origin", "0 0 0"}, {"model", options.model}});
  if (options.units) placed.keys.push_back({.key = "units", .value = format_double(*options.units)});
  document.entities.push_back(std::move(placed));
  // The strip between wall and model is free whatever the model is like inside.
  const double strip = std::max(options.margin_m, kLeastMargin_m) / kMetresPerUnit / 2.0;
  const Vec3 start(room.low.x() + std::round(strip), std::round((room.low.y() + room.high.y()) / 2.0),
                   room.low.z() + kStart_m / kMetresPerUnit);
  document.entities.push_back(
      entity({{"classname", "hw_robot_start"}, {"origin", numbers(start)}, {"angle", "0"}}));
  return document;
}

std::string path_in_map_folder(const fs::path& model, const fs::path& map_folder) {
  const fs::path folder = canonical_or_throw(map_folder.empty() ? fs::path(".") : map_folder);
  const fs::path path = canonical_or_throw(model);
  const auto [rest, unused] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  if (rest == folder.end()) return path.lexically_relative(folder).string();
  throw Error(ErrorCode::kBadInput,
              "lies outside the map's folder " + printable(folder.string(), kMaxNameBytes) +
                  "; a map only reads models in its own folder. Write the map beside the model, or copy the "
                  "model with "
                  "--copy",
              {.file = printable(model.string(), kMaxNameBytes)});
}

void copy_model_files(const std::vector<std::string>& files, const fs::path& root, const fs::path& map_folder,
                      bool replace) {
  const fs::path folder = map_folder.empty() ? fs::path(".") : map_folder;
  std::vector<std::pair<fs::path, std::string>> wanted;
  for (const std::string& file : files) {
    std::string content = read_file(root / file);
    const fs::path target = folder / file;
    std::error_code problem;
    if (fs::exists(target, problem)) {
      if (fs::is_regular_file(target, problem) && read_file(target) == content) continue;
      if (!replace) {
        throw Error(ErrorCode::kIo, "is there already with another content; --force replaces it",
                    {.file = printable(target.string(), kMaxNameBytes)});
      }
    }
    wanted.emplace_back(target, std::move(content));
  }
  for (const auto& [target, content] : wanted) {
    make_folder(target.parent_path());
    write_file_atomically(target, content);
  }
}

}  // namespace hallway::mesh
