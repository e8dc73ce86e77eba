// SPDX-License-Identifier: MIT
#include "map/check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "base/text.hpp"
#include "map/content.hpp"
#include "map/entities.hpp"
#include "map/entity_keys.hpp"
#include "map/entity_schema.hpp"
#include "map/material_check.hpp"
#include "map/path.hpp"
#include "map/robot_file.hpp"
#include "map/sensors.hpp"
#include "map/start_check.hpp"
#include "map/tie_check.hpp"
#include "map/world.hpp"

namespace hallway::map {
namespace {

std::string quote(std::string_view text) {
  return "`" + printable(text, 60) + "`";
}

bool begins_with_hw(std::string_view name) {
  const auto is = [&](std::size_t i, char c) { return (name[i] | 0x20) == c; };
  return name.size() >= 3 && is(0, 'h') && is(1, 'w') && name[2] == '_';
}

std::vector<std::string> class_names() {
  std::vector<std::string> names;
  for (const EntitySpec& spec : entity_schema()) names.emplace_back(spec.classname);
  return names;
}

/// Names of the entities of a class, and the line of the first of each name.
using Names = std::map<std::string, int, std::less<>>;

class Checker {
 public:
  explicit Checker(const Document& document) : document_(document) {}

  std::vector<Finding> run() {
    for (const Entity& entity : document_.entities) {
      check_doubled_keys(entity);
      check_class(entity);
    }
    check_worldspawns();
    check_targetnames();
    if (is_robot_file(document_)) {
      check_robot();
      sort();
      return std::move(findings_);
    }
    check_no_robot();
    check_robot_starts();
    const Names paths = check_names("hw_path");
    check_names("hw_landmark_cloud");
    check_names("hw_sensor");
    check_names("hw_robot_start");
    check_sensors();
    check_references("hw_waypoint", paths);
    check_references("hw_landmark_cloud", paths);
    check_paths(paths);
    check_start_of_paths();
    check_world();
    check_materials();
    sort();
    return std::move(findings_);
  }

 private:
  void add(Severity severity, const Error& error, std::string id) {
    findings_.push_back({severity, error.where(), error.message(), std::move(id)});
    if (severity == Severity::kError) faulty_.insert(error.where().element);
  }

  /// For what may follow from a fault that is known.
  void add_consequence(const Error& error, std::string id) {
    if (!faulty_.contains(error.where().element)) add(Severity::kError, error, std::move(id));
  }

  void check_doubled_keys(const Entity& entity) {
    const EntityKeys keys(document_, entity);
    const EntitySpec* spec = find_entity_spec(entity.classname());
    constexpr int kMost = 20;  // of one entity; each takes a walk over all of its keys
    int doubled = 0;
    std::map<std::string_view, int> lines;
    for (const KeyValue& pair : entity.keys) {
      const auto [known, is_new] = lines.emplace(pair.key, pair.line);
      if (is_new || ++doubled > kMost) continue;
      const bool read = spec && (!spec->open || is_in(*spec, pair.key));
      add(read ? Severity::kError : Severity::kWarning,
          keys.error(
              "key " + quote(pair.key) + " stands twice, first at line " + std::to_string(known->second),
              pair.key),
          "doubled-key");
    }
  }

  static bool is_in(const EntitySpec& spec, std::string_view key) { return spec.key(key) != nullptr; }

  void check_class(const Entity& entity) {
    const EntityKeys keys(document_, entity);
    const std::string_view name = entity.classname();
    const EntitySpec* spec = find_entity_spec(name);
    if (name.empty()) {
      add(Severity::kWarning, keys.error("the entity has no `classname`"), "no-class");
    } else if (!spec && begins_with_hw(name)) {
      add(Severity::kError,
          keys.error("unknown class " + quote(name) + suggestion(name, class_names()), "classname"),
          "unknown-class");
    }
    if (!spec) {
      if (entity.brushes.empty() && keys.has("origin"))
        check_value(keys, {.name = "origin", .kind = KeyKind::kPoint});
      return;
    }
    for (const Error& error : keys.unknown_keys()) add(Severity::kError, error, "unknown-key");
    const std::string_view variant = variant_of(*spec, entity);
    for (const KeySpec& key : spec->keys) {
      if (belongs(key, variant)) check_key(keys, key);
    }
    check_shape(entity, *spec);
  }

  void check_key(const EntityKeys& keys, const KeySpec& key) {
    if (keys.has(key.name)) {
      check_value(keys, key);
    } else if (key.required) {
      add(Severity::kError, keys.error("key " + quote(key.name) + " is missing"), "missing-key");
    }
  }

  void check_value(const EntityKeys& keys, const KeySpec& key) {
    try {
      keys.check_value(key);
    } catch (const Error& error) {
      if (!keys.is_doubled(key.name)) add(Severity::kError, error, "bad-value");
    }
  }

  void check_shape(const Entity& entity, const EntitySpec& spec) {
    const EntityKeys keys(document_, entity);
    const bool wants_brushes = spec.shape == EntityShape::kBrushes;
    if (wants_brushes && !spec.open && !spec.brushless && entity.brushes.empty())
      add(Severity::kWarning, keys.error("the entity has no brushes and so no effect"), "no-brushes");
    if (!wants_brushes && !entity.brushes.empty())
      add(Severity::kWarning, keys.error("brushes of an entity of this class have no part in the world"),
          "brushes-ignored");
  }

  void check_materials() {
    try {
      for (const UndescribedFace& face : undescribed_faces(document_))
        add(Severity::kWarning,
            Error(ErrorCode::kBadInput,
                  "the table of materials says nothing of " + quote(face.material) + "; it has the defaults",
                  {document_.file, face.line, {}}),
            "unknown-material");
    } catch (const Error& error) {
      add(Severity::kError, error, "bad-materials");
    }
  }

  void check_worldspawns() {
    const Entity* first = document_.worldspawn();
    if (!first) {
      add(Severity::kWarning,
          Error(ErrorCode::kBadInput, "the map has no entity of class `worldspawn`", {document_.file, 0, {}}),
          "no-worldspawn");
    }
    for (const Entity& entity : document_.entities) {
      if (entity.classname() != "worldspawn" || &entity == first) continue;
      add(Severity::kError,
          EntityKeys(document_, entity)
              .error("a second worldspawn; the first is at line " + std::to_string(first->line)),
          "two-worldspawns");
    }
  }

  /// Those without a name; of those with one, check_names() says which are doubled.
  void check_robot_starts() {
    const Entity* first = nullptr;
    for (const Entity& entity : document_.entities) {
      if (entity.classname() != "hw_robot_start") continue;
      const EntityKeys keys(document_, entity);
      if (entity.value("name") == kFreeStart) {
        add(Severity::kError,
            keys.error("no robot start may be named `free`: scenarios mean any free place by it", "name"),
            "bad-value");
      }
      if (entity.find("name")) continue;
      if (first) {
        add(Severity::kError,
            keys.error("a second robot start without a name; the first is at line " +
                       std::to_string(first->line)),
            "two-robot-starts");
      } else {
        first = &entity;
      }
    }
  }

  /// What is wrong with a robot file, at most one thing of its body and zones.
  void check_robot() {
    check_names("hw_sensor");
    check_names("hw_bump_zone");
    check_sensors();
    try {
      check_mounts(read_robot(document_));
    } catch (const Error& error) {
      if (faulty_.empty()) add(Severity::kError, error, "bad-robot");
    }
  }

  /// Of sensors that stand beside the body, by more than what may be their own case.
  void check_mounts(const RobotFile& robot) {
    constexpr double kCase_m = 0.05;
    for (const Entity* sensor : sensors(document_)) {
      const EntityKeys keys(document_, *sensor);
      const EntitySpec& spec = *find_entity_spec("hw_sensor");
      if (spec.key("position_m", variant_of(spec, *sensor)) == nullptr) continue;
      if (!keys.has("origin") && !keys.has("position_m")) continue;
      const Vec3 mount_m = keys.has("position_m") ? keys.vector("position_m") : keys.origin_m();
      const double beside_m = distance_beside(robot.body, mount_m);
      if (beside_m <= kCase_m) continue;
      add(Severity::kWarning,
          keys.error(
              "stands " + format_double(std::round(1e3 * beside_m) * 1e-3) + " m beside the robot's body",
              keys.has("position_m") ? "position_m" : "origin"),
          "sensor-beside-body");
    }
  }

  /// What only robot files have.
  void check_no_robot() {
    for (const Entity& entity : document_.entities) {
      const std::string_view name = entity.classname();
      if (name != "hw_body" && name != "hw_bump_zone" && name != "hw_drive") continue;
      add(Severity::kError,
          EntityKeys(document_, entity)
              .error("only a robot file, whose worldspawn has `_hallway_robot 1`, has a " + quote(name),
                     "classname"),
          "not-in-maps");
    }
  }

  void check_targetnames() {
    Names names;
    for (const Entity& entity : document_.entities) {
      const std::string* name = entity.find("targetname");
      if (!name) continue;
      const auto [first, is_new] = names.emplace(*name, entity.line);
      if (is_new) continue;
      add(Severity::kWarning,
          EntityKeys(document_, entity)
              .error("a second entity with the targetname " + quote(*name) + "; the first is at line " +
                         std::to_string(first->second),
                     "targetname"),
          "doubled-targetname");
    }
  }

  Names check_names(std::string_view classname) {
    Names names;
    for (const Entity& entity : document_.entities) {
      const std::string* name = entity.find("name");
      if (entity.classname() != classname || !name) continue;
      const auto [first, is_new] = names.emplace(*name, entity.line);
      if (is_new) continue;
      add(Severity::kError,
          EntityKeys(document_, entity)
              .error("a second " + std::string(classname) + " named " + quote(*name) +
                         "; the first is at line " + std::to_string(first->second),
                     "name"),
          "doubled-name");
    }
    return names;
  }

  void check_sensors() {
    for (const Entity& entity : document_.entities) {
      if (entity.classname() != "hw_sensor") continue;
      try {
        check_sensor(EntityKeys(document_, entity));
      } catch (const Error& error) {
        add_consequence(error, "bad-value");
      }
    }
  }

  void check_references(std::string_view classname, const Names& paths) {
    std::vector<std::string> names;
    for (const auto& [name, line] : paths) names.push_back(name);
    names.resize(std::min(names.size(), kMostPathsChecked));  // of which one is suggested
    for (const Entity& entity : document_.entities) {
      const std::string* path = entity.find("path");
      if (entity.classname() != classname || !path || path->empty() || paths.contains(*path)) continue;
      add_consequence(EntityKeys(document_, entity)
                          .error("the map has no path " + quote(*path) + suggestion(*path, names), "path"),
                      "unknown-path");
    }
  }

  void check_paths(const Names& paths) {
    std::size_t tried = 0;
    for (const auto& [name, line] : paths) {
      if (++tried > kMostPathsChecked) {
        add(Severity::kWarning,
            Error(ErrorCode::kBadInput,
                  "the map has " + std::to_string(paths.size()) + " paths, of which " +
                      std::to_string(kMostPathsChecked) + " were tried",
                  {document_.file, 0, {}}),
            "many-paths");
        return;
      }
      try {
        find_path(document_, name);
      } catch (const Error& error) {
        add_consequence(error, "bad-path");
      }
    }
  }

  void check_start_of_paths() {
    const auto found = start_off_all_paths(document_);
    if (!found) return;
    const Entity& start = document_.entities[static_cast<std::size_t>(found->start.entity)];
    add(Severity::kWarning, EntityKeys(document_, start).error(start_off_path_text(*found)),
        "start-off-path");
  }

  void check_world() {
    std::optional<World> world;
    try {
      world = build_world(document_);
    } catch (const Error& error) {
      add_consequence(error, "bad-value");
    }
    for (const Problem& problem : world ? world->problems : brush_problems(document_)) {
      const Brush& brush = document_.entities[static_cast<std::size_t>(problem.entity)]
                               .brushes[static_cast<std::size_t>(problem.brush)];
      const Error error(ErrorCode::kBadInput, problem.message,
                        {document_.file, problem.line, brush_name(problem.entity, problem.brush)});
      if (!problem.left_out) {
        add(Severity::kWarning, error, "duplicate-plane");
      } else {
        add(Severity::kError, error, brush.unread.empty() ? "bad-brush" : "unread-shape");
      }
    }
    if (world) check_ties(*world);
  }

  void check_ties(const World& world) {
    for (const Tie& tie : tied_brushes(document_, world)) {
      add(Severity::kWarning,
          Error(ErrorCode::kBadInput,
                "the brush and that of the other kind at line " + std::to_string(tie.first->line) +
                    " overlap and have the same `order` " + std::to_string(tie.order) +
                    ": the one that stands later in the file counts, and editors may move it",
                {document_.file, tie.second->line, brush_name(tie.second->entity, tie.second->brush)}),
          "tied-order");
    }
  }

  void sort() {
    const auto rank = [](const Finding& f) {
      return std::tie(f.where.line, f.id, f.message, f.where.element);
    };
    std::stable_sort(findings_.begin(), findings_.end(),
                     [&](const Finding& a, const Finding& b) { return rank(a) < rank(b); });
  }

  const Document& document_;
  std::vector<Finding> findings_;
  std::set<std::string> faulty_;  ///< elements that have an error
};

}  // namespace

const std::vector<std::string>& finding_ids() {
  static const std::vector<std::string> ids{
      "bad-brush",       "bad-materials",      "bad-path",       "bad-robot",          "bad-value",
      "brushes-ignored", "doubled-key",        "doubled-name",   "doubled-targetname", "duplicate-plane",
      "many-paths",      "missing-key",        "no-brushes",     "no-class",           "no-worldspawn",
      "not-in-maps",     "sensor-beside-body", "start-off-path", "tied-order",         "two-robot-starts",
      "two-worldspawns", "unknown-class",      "unknown-key",    "unknown-material",   "unknown-path",
      "unread-shape"};
  return ids;
}

std::vector<Finding> check(const Document& document) {
  return Checker(document).run();
}

}  // namespace hallway::map
