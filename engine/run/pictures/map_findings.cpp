// SPDX-License-Identifier: MIT
#include "run/pictures/map_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
#include "bsp/point_location.hpp"
#include "bsp/segment.hpp"
#include "map/path.hpp"
#include "map/robot_file.hpp"
#include "render/map_layers.hpp"
#include "run/pictures/map_view.hpp"
#include "world/compiled_world.hpp"

namespace hallway::run {
namespace {

using map::Finding;
using map::Severity;

/// A path is looked at in steps of this length, or longer ones where it is very long.
constexpr double kStep_m = 0.05;
constexpr double kMostSteps = 200'000;

/// Whether a class is one of ours: what stands in solid then cannot work.
bool is_ours(const std::string& classname) {
  return classname.starts_with("hw_");
}

/// Findings about one map.
class Findings {
 public:
  Findings(const map::Document& document, std::vector<Finding>& list) : document_(document), list_(list) {}

  void add(Severity severity, int entity, int line, const std::string& message, const char* id) {
    list_.push_back(
        {severity,
         {.file = printable(document_.file, 4096), .line = line, .element = fmt::format("entity {}", entity)},
         message,
         id});
  }

 private:
  const map::Document& document_;
  std::vector<Finding>& list_;
};

void add_occupants_in_solid(Findings& findings, const world::CompiledWorld& world) {
  for (const std::size_t index : world.partition.enclosure.in_solid) {
    const map::Occupant& occupant = world.occupants[index];
    findings.add(
        is_ours(occupant.classname) ? Severity::kError : Severity::kWarning, occupant.entity, occupant.line,
        fmt::format("{} is in solid, at {}", printable(occupant.classname), place_text(occupant.position_m)),
        "occupant-in-solid");
  }
}

void add_leak(Findings& findings, const world::CompiledWorld& world) {
  const auto& leak = world.partition.enclosure.leak;
  const bool has_structure =
      std::any_of(world.brushes.solids.begin(), world.brushes.solids.end(),
                  [](const map::Solid& solid) { return solid.role == map::BrushRole::kAdd; });
  if (!leak || !has_structure) return;
  const map::Occupant& occupant = world.occupants[leak->occupant];
  findings.add(
      Severity::kWarning, occupant.entity, occupant.line,
      fmt::format("the map leaks: {} reaches the void after {}, through {}", printable(occupant.classname),
                  render::measure_text(leak->length_m), opening_text(leak->narrowest)),
      "leak");
}

/// A stretch of a path that lies in solid.
struct Stretch {
  double from_m = 0.0;  ///< along the path
  double to_m = 0.0;
  Vec3 at = Vec3::Zero();  ///< where it begins
};

/// The first stretch of a path that passes through solid, and how many there are.
std::pair<std::optional<Stretch>, std::size_t> blocked_stretches(const bsp::Tree& tree,
                                                                 const map::Path& path) {
  const double length = path.length_m();
  const double steps = std::clamp(std::ceil(length / kStep_m), 1.0, kMostSteps);
  std::optional<Stretch> first;
  std::size_t count = 0;
  bool inside = false;
  Vec3 from = path.at(0.0).t;
  for (double i = 1.0; i <= steps; i += 1.0) {
    const Vec3 to = path.at(length * i / steps).t;
    const auto hit = bsp::first_solid(tree, from, to);
    if (hit && !inside) ++count;
    if (hit && !first) {
      const double begin = length * (i - 1.0 + hit->fraction) / steps;
      first = Stretch{begin, begin, hit->point};
    }
    if (hit && count == 1) {  // the end is looked for from the other side
      const auto back = bsp::first_solid(tree, to, from);
      first->to_m = length * (i - (back ? back->fraction : 0.0)) / steps;
    }
    inside = hit.has_value();
    from = to;
  }
  return {first, count};
}

void add_blocked_paths(Findings& findings, const map::Document& document, const world::CompiledWorld& world) {
  std::size_t paths = 0;
  for (std::size_t i = 0; i < document.entities.size(); ++i) {
    const map::Entity& entity = document.entities[i];
    const std::string* name = entity.find("name");
    if (entity.classname() != "hw_path" || name == nullptr) continue;
    if (++paths > map::kMostPathsChecked) return;
    try {
      const auto [first, count] = blocked_stretches(world.partition.tree, map::find_path(document, *name));
      if (!first) continue;
      std::string text =
          fmt::format("path \"{}\" passes through a wall from {:.2f} m to {:.2f} m along it, at {}",
                      printable(*name), first->from_m, first->to_m, place_text(first->at));
      if (count > 1) text += count == 2 ? ", and once more" : fmt::format(", and {} more times", count - 1);
      findings.add(Severity::kError, static_cast<int>(i), entity.line, text, "path-through-wall");
    } catch (const Error&) {
      continue;  // a path that cannot be made is a finding of map::check()
    }
  }
}

/// For each cluster the number of the part of the empty space that it belongs to; portals join clusters to parts.
std::vector<std::uint32_t> connected_parts(const bsp::PortalGraph& graph) {
  std::vector<std::vector<std::uint32_t>> neighbours(graph.clusters);
  for (const bsp::Portal& portal : graph.portals) {
    neighbours[portal.cluster[0]].push_back(portal.cluster[1]);
    neighbours[portal.cluster[1]].push_back(portal.cluster[0]);
  }
  constexpr std::uint32_t kNone = UINT32_MAX;
  std::vector<std::uint32_t> parts(graph.clusters, kNone);
  std::vector<std::uint32_t> open;
  for (std::uint32_t first = 0; first < graph.clusters; ++first) {
    if (parts[first] != kNone) continue;
    parts[first] = first;
    open.push_back(first);
    while (!open.empty()) {
      const std::uint32_t cluster = open.back();
      open.pop_back();
      for (const std::uint32_t next : neighbours[cluster]) {
        if (parts[next] != kNone) continue;
        parts[next] = first;
        open.push_back(next);
      }
    }
  }
  return parts;
}

/// Waypoints to which no opening leads from any robot start. Those in solid are said already.
void add_unreachable_waypoints(Findings& findings, const world::CompiledWorld& world) {
  const bsp::Tree& tree = world.partition.tree;
  const auto parts = connected_parts(world.partition.portals);
  std::set<std::uint32_t> reached;
  for (const map::Occupant& occupant : world.occupants) {
    const std::int32_t cluster =
        occupant.classname == "hw_robot_start" ? bsp::cluster_at(tree, occupant.position_m) : -1;
    if (cluster >= 0) reached.insert(parts[static_cast<std::size_t>(cluster)]);
  }
  if (reached.empty()) return;
  for (const map::Occupant& occupant : world.occupants) {
    const std::int32_t cluster = bsp::cluster_at(tree, occupant.position_m);
    if (occupant.classname != "hw_waypoint" || cluster < 0) continue;
    if (reached.contains(parts[static_cast<std::size_t>(cluster)])) continue;
    findings.add(
        Severity::kError, occupant.entity, occupant.line,
        fmt::format("waypoint {} at {} cannot be reached from the robot's start: no opening leads there",
                    printable(occupant.name), place_text(occupant.position_m)),
        "unreachable-waypoint");
  }
}

/// Where the openings of a map lead.
class Openings {
 public:
  explicit Openings(const map::World& brushes) : brushes_(brushes) {}

  /// Whether there is room before two faces of the opening that look away from each other. Between the brushes of one opening there is none.
  bool leads_through(std::span<const map::Solid* const> opening) const {
    constexpr double kUpright = 1e-6;
    std::vector<Vec3> free;  // normals
    for (const map::Solid* solid : opening) {
      for (const map::SolidFace& face : solid->faces) {
        const Vec3& normal = face.polygon.plane.normal;
        if (std::abs(normal.z()) < kUpright && is_free_before(*solid, face, opening)) free.push_back(normal);
      }
    }
    return std::ranges::any_of(free, [&](const Vec3& one) {
      return std::ranges::any_of(free, [&](const Vec3& other) { return one.dot(other) < 0.0; });
    });
  }

 private:
  bool is_solid(const Vec3& point) const {
    bool solid = false;
    for (const map::Solid& each : brushes_.solids) {
      if (each.box.contains(point) && each.contains(point)) solid = each.role != map::BrushRole::kSubtract;
    }
    return solid;
  }

  /// In front of any part of a face of `own`, but not in another brush of the opening: furniture may stand there too.
  bool is_free_before(const map::Solid& own, const map::SolidFace& face,
                      std::span<const map::Solid* const> opening) const {
    constexpr double kBefore_m = 0.01;
    constexpr double kSeam_m = 0.001;
    constexpr int kParts = 12;
    const auto& corners = face.polygon.vertices;
    const Vec3 before = kBefore_m * face.polygon.plane.normal;
    for (std::size_t c = 1; c + 1 < corners.size(); ++c) {
      for (int i = 1; i < kParts; ++i) {
        for (int j = 1; i + j < kParts; ++j) {
          const Vec3 point = corners[0] + (corners[c] - corners[0]) * i / kParts +
                             (corners[c + 1] - corners[0]) * j / kParts + before;
          const bool is_of_another = std::ranges::any_of(
              opening, [&](const map::Solid* one) { return one != &own && one->contains(point, -kSeam_m); });
          if (!is_of_another && !is_solid(point)) return true;
        }
      }
    }
    return false;
  }

  const map::World& brushes_;
};

/// Doors and windows of the editor that end in solid, such as where another wall stands behind the one that they are in.
void add_blocked_openings(Findings& findings, const map::Document& document,
                          const world::CompiledWorld& world) {
  std::map<int, std::vector<const map::Solid*>> openings;  // by entity
  for (const map::Solid& solid : world.brushes.solids) {
    const map::Entity& entity = document.entities[static_cast<std::size_t>(solid.entity)];
    const std::string* made = entity.find("_hw_made");
    if (entity.classname() != "hw_subtract" || made == nullptr) continue;
    if (made->starts_with("door ") || made->starts_with("window ")) openings[solid.entity].push_back(&solid);
  }
  const Openings places(world.brushes);
  for (const auto& [index, solids] : openings) {
    if (places.leads_through(solids)) continue;
    const map::Entity& entity = document.entities[static_cast<std::size_t>(index)];
    const std::string& made = *entity.find("_hw_made");
    Box box;
    for (const map::Solid* solid : solids) box.extend(solid->box);
    findings.add(Severity::kWarning, index, entity.line,
                 fmt::format("the {} at {} leads nowhere: there is solid behind it",
                             made.substr(0, made.find(' ')), place_text((box.min() + box.max()) / 2.0)),
                 "blocked-opening");
  }
}

/// Compiles the map, if its entities let it, and adds what shows then.
void add_world_findings(std::vector<Finding>& findings, const map::Document& document) {
  world::Settings settings;
  settings.level.reset();
  world::CompiledWorld world;
  try {
    world = world::compile(document, settings);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kBadInput) throw;
    if (findings.empty()) {
      findings.push_back({Severity::kError, error.where(), error.message(), "not-compilable"});
    }
    return;
  }
  Findings found(document, findings);
  add_occupants_in_solid(found, world);
  add_blocked_paths(found, document, world);
  add_unreachable_waypoints(found, world);
  add_blocked_openings(found, document, world);
  add_leak(found, world);
}

}  // namespace

const std::vector<std::string>& world_finding_ids() {
  static const std::vector<std::string> ids{"blocked-opening",   "leak",
                                            "not-compilable",    "occupant-in-solid",
                                            "path-through-wall", "unreachable-waypoint"};
  return ids;
}

std::vector<Finding> find_faults(const map::Document& document) {
  std::vector<Finding> findings = map::check(document);
  if (!map::is_robot_file(document)) add_world_findings(findings, document);
  std::stable_sort(findings.begin(), findings.end(), [](const Finding& a, const Finding& b) {
    return std::tie(a.where.line, a.id, a.message) < std::tie(b.where.line, b.id, b.message);
  });
  return findings;
}

}  // namespace hallway::run
