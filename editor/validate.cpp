// SPDX-License-Identifier: MIT
#include "editor/validate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>
#include <tuple>
#include <utility>

#include "base/refuse.hpp"
#include "base/text.hpp"
#include "editor/command.hpp"
#include "editor/selection.hpp"
#include "editor/shapes.hpp"
#include "map/content.hpp"
#include "map/entity_schema.hpp"
#include "map/start_check.hpp"
#include "run/pictures/map_findings.hpp"

namespace hallway::editor {
namespace {

namespace fs = std::filesystem;
using map::Severity;

constexpr double kSliver_m = 1e-3;     ///< bodies thinner than this are slivers
constexpr double kFarthest_m = 10000;  ///< what lies farther from the origin is out of bounds

/// The thing that a finding's element names: "entity 3", "entity 3, brush 7", with more behind it.
std::optional<Thing> thing_of(const State& state, const std::string& element) {
  constexpr std::string_view kEntity = "entity ", kBrush = ", brush ";
  const auto number_at = [&](std::size_t at) {
    std::size_t end = at;
    while (end < element.size() && element[end] >= '0' && element[end] <= '9') ++end;
    return std::pair(parse_uint(std::string_view(element).substr(at, end - at)), end);
  };
  if (!element.starts_with(kEntity)) return std::nullopt;
  const auto [entity, end] = number_at(kEntity.size());
  if (!entity || *entity >= state.entities.size()) return std::nullopt;
  Thing thing{static_cast<std::size_t>(*entity), {}};
  if (element.compare(end, kBrush.size(), kBrush) == 0) {
    const auto brush = number_at(end + kBrush.size()).first;
    if (brush && *brush < state.entities[thing.entity]->brushes.size())
      thing.brush = static_cast<std::size_t>(*brush);
  }
  return thing;
}

std::string key_command(Id id, const Pairs& keys) {
  std::string line = fmt::format("key #{}", id);
  for (const auto& [key, value] : keys) line += " " + editor::quoted(key + "=" + value);
  return line;
}

std::string unused_name(const State& state, const std::string& name) {
  std::set<std::string> names;
  for (const auto& entity : state.entities) {
    for (const char* key : {"name", "targetname"}) {
      if (const std::string* value = entity->head->find(key)) names.insert(*value);
    }
  }
  for (int i = 2;; ++i) {
    std::string next = fmt::format("{}-{}", name, i);
    if (!names.contains(next)) return next;
  }
}

/// The command that mends what map::check() found in an entity.
std::string entity_fix(const State& state, std::size_t e, const map::Finding& finding) {
  const std::string& id = finding.id;
  const EntityItem& entity = *state.entities[e];
  const map::EntitySpec* spec = map::find_entity_spec(entity.classname());
  if (id == "two-robot-starts" || id == "no-brushes" || id == "two-worldspawns")
    return fmt::format("delete #{}", entity.id);
  if (id == "doubled-name" || id == "doubled-targetname") {
    const std::string key = id == "doubled-name" ? "name" : "targetname";
    const std::string* name = entity.head->find(key);
    return name == nullptr ? "" : key_command(entity.id, {{key, unused_name(state, *name)}});
  }
  if (id == "unknown-class") {
    const auto name =
        nearest_name(entity.classname(), names_in(map::entity_schema(), &map::EntitySpec::classname));
    return name ? key_command(entity.id, {{"classname", *name}}) : "";
  }
  if (id == "doubled-key") {
    std::set<std::string> seen;
    for (const map::KeyValue& pair : entity.head->keys) {
      if (!seen.insert(pair.key).second) return key_command(entity.id, {{pair.key, entity.value(pair.key)}});
    }
  }
  if (id == "unknown-key" && spec != nullptr) {
    auto known = names_in(spec->keys, &map::KeySpec::name);
    for (const std::string_view key : map::common_keys()) known.emplace_back(key);
    for (const map::KeyValue& pair : entity.head->keys) {
      if (pair.key.starts_with('_') || std::ranges::find(known, pair.key) != known.end()) continue;
      const bool is_meant = finding.message.starts_with("unknown key `" + printable(pair.key, 60) + "`");
      if (!is_meant) continue;
      const auto name = nearest_name(pair.key, known);
      if (name && entity.head->find(*name) == nullptr)
        return key_command(entity.id, {{pair.key, ""}, {*name, pair.value}});
      return key_command(entity.id, {{pair.key, ""}});
    }
  }
  return {};
}

/// Looks at one state, fault by fault.
class Validator {
 public:
  Validator(const State& state, const std::string& file)
      : state_(state), file_(file), units_(units_of(state)) {}

  std::vector<Fault> run() {
    add_findings();
    for (std::size_t e = 0; e < state_.entities.size(); ++e) {
      for (std::size_t b = 0; b < state_.entities[e]->brushes.size(); ++b) look_at_brush({e, b});
      look_at_entity(e);
    }
    std::ranges::sort(faults_, [](const Fault& a, const Fault& b) {
      return std::tie(a.thing, a.id, a.message) < std::tie(b.thing, b.id, b.message);
    });
    return std::move(faults_);
  }

 private:
  void add(const Thing& thing, const char* id, Severity severity, std::string message, std::string fix) {
    const EntityItem& entity = *state_.entities[thing.entity];
    const int line = thing.brush ? entity.brushes[*thing.brush].brush->line : entity.head->line;
    faults_.push_back({id, severity, id_of(state_, thing), line, std::move(message), std::move(fix)});
  }

  void add_findings() {
    for (const map::Finding& finding : run::find_faults(document_of(state_, file_))) {
      const auto thing = thing_of(state_, finding.where.element);
      Fault fault{finding.id,         finding.severity, thing ? id_of(state_, *thing) : 0,
                  finding.where.line, finding.message,  {}};
      if (thing && thing->brush && finding.id == "bad-brush")
        fault.fix = fmt::format("delete #{}", fault.thing);
      if (thing && !thing->brush) fault.fix = entity_fix(state_, thing->entity, finding);
      if (finding.id == "start-off-path") fault.fix = start_fix();
      if (finding.id == "no-worldspawn") fault.fix = "";
      faults_.push_back(std::move(fault));
    }
  }

  /// Puts the start where the path begins; of several paths none is the one.
  std::string start_fix() const {
    const auto paths = std::ranges::count_if(
        state_.entities, [](const auto& entity) { return entity->classname() == "hw_path"; });
    const auto off = map::start_off_all_paths(document_of(state_, file_));
    if (paths != 1 || !off) return {};
    const auto fine = [](double x) { return format_double(std::round(x * 1e6) / 1e6 + 0.0); };
    const Vec3 at = off->T_world_begin.t / units_.metres_per_unit;
    const Vec3 ahead = off->T_world_begin.q * Vec3::UnitX();
    const double heading = std::atan2(ahead.y(), ahead.x()) * 180.0 / std::numbers::pi;
    const Id start = state_.entities[static_cast<std::size_t>(off->start.entity)]->id;
    return key_command(start, {{"origin", fine(at.x()) + " " + fine(at.y()) + " " + fine(at.z())},
                               {"angle", fine(heading)}});
  }

  void look_at_brush(const Thing& thing) {
    const EntityItem& entity = *state_.entities[thing.entity];
    const map::Brush& brush = *entity.brushes[*thing.brush].brush;
    const auto body = body_of(brush);
    if (!body) return;  // map::check() says so
    const std::string remove = fmt::format("delete #{}", id_of(state_, thing));
    const Box box = bounds_of(*body);
    const double scale = units_.metres_per_unit;
    if (box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff() * scale > kFarthest_m) {
      add(thing, "out-of-bounds", Severity::kWarning, "the brush reaches farther than 10 km from the origin",
          "");
    }
    const double thickness = thickness_of(brush, *body) * scale;
    if (thickness < kSliver_m) {
      add(thing, "sliver", Severity::kWarning,
          fmt::format("the brush is only {:.3g} mm thick", 1000.0 * thickness), remove);
    }
    const auto bare = std::ranges::count_if(brush.faces, [](const map::Face& face) {
      return face.material.empty() || face.material == "__TB_empty";
    });
    if (bare > 0) {
      add(thing, "no-material", Severity::kWarning,
          fmt::format("{} of its {} faces have no material", bare, brush.faces.size()), "");
    }
    const auto [first, is_new] = equal_.emplace(shape_of(entity, brush), thing);
    if (!is_new) {
      add(thing, "equal-brushes", Severity::kWarning,
          fmt::format("it fills the same space as {}, and hides it", describe(state_, first->second)),
          fmt::format("delete #{}", id_of(state_, first->second)));
      first->second = thing;
    }
  }

  /// The smallest distance between a face and the corner farthest from it, map units.
  static double thickness_of(const map::Brush& brush, const map::ConvexBody& body) {
    double least = 1e300;
    for (const map::ConvexBody::Side& side : body.sides) {
      const auto plane = plane_of(brush.faces[side.plane]);
      double farthest = 0.0;
      for (const Vec3& corner : body.vertices) farthest = std::max(farthest, -plane->distance(corner));
      least = std::min(least, farthest);
    }
    return least;
  }

  using Shape = std::pair<std::string, std::set<std::array<std::int64_t, 4>>>;

  /// The planes of a brush to a millionth of a unit, and what the brush does.
  static Shape shape_of(const EntityItem& entity, const map::Brush& brush) {
    constexpr double kFine = 1e6;
    Shape shape;
    const bool ordered = entity.classname().starts_with("hw_");
    shape.first = ordered ? std::string(entity.classname()) + entity.value("order") : "world";
    for (const map::Face& face : brush.faces) {
      const auto plane = plane_of(face);
      const auto whole = [&](double x) { return static_cast<std::int64_t>(std::llround(x * kFine)); };
      shape.second.insert({whole(plane->normal.x()), whole(plane->normal.y()), whole(plane->normal.z()),
                           whole(plane->offset)});
    }
    return shape;
  }

  void look_at_entity(std::size_t e) {
    const EntityItem& entity = *state_.entities[e];
    const std::string* model = entity.head->find("model");
    if (entity.classname() == "hw_mesh" && model != nullptr) {
      std::error_code none;
      if (!fs::is_regular_file(fs::path(file_).parent_path() / *model, none))
        add({e, {}}, "missing-file", Severity::kError, fmt::format("there is no file {}", printable(*model)),
            "");
    }
    const std::string& target = entity.value("target");
    const auto is_target = [&](const EntityItem& other) { return other.has("targetname", target); };
    if (!target.empty() && !find_entity(state_, is_target)) {
      std::vector<std::string> names;
      for (const auto& other : state_.entities) {
        if (const std::string* name = other->head->find("targetname")) names.push_back(*name);
      }
      const auto name = nearest_name(target, names);
      add({e, {}}, "unknown-target", Severity::kWarning,
          fmt::format("nothing has the targetname \"{}\"{}", printable(target), suggestion(target, names)),
          key_command(entity.id, {{"target", name.value_or("")}}));
    }
    const std::string* group = entity.head->find("_tb_group");
    if (group != nullptr && !find_group(state_, *group)) {
      add({e, {}}, "unknown-group", Severity::kWarning,
          fmt::format("the map has no group {}", printable(*group)),
          key_command(entity.id, {{"_tb_group", ""}}));
    }
  }

  const State& state_;
  const std::string& file_;
  Units units_;
  std::vector<Fault> faults_;
  std::map<Shape, Thing> equal_;
};

}  // namespace

std::vector<std::string> fault_ids() {
  std::vector<std::string> ids{"out-of-bounds", "sliver",         "no-material",  "equal-brushes",
                               "missing-file",  "unknown-target", "unknown-group"};
  for (const auto& more : {map::finding_ids(), run::world_finding_ids()})
    ids.insert(ids.end(), more.begin(), more.end());
  return ids;
}

std::vector<Fault> validate(const State& state, const std::string& file) {
  return Validator(state, file).run();
}

}  // namespace hallway::editor
