// SPDX-License-Identifier: MIT
//
// Naming, grouping and hiding things, and what their faces are made of.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "base/refuse.hpp"
#include "base/text.hpp"
#include "editor/commands/common_arguments.hpp"
#include "editor/commands/making.hpp"
#include "editor/commands/topics.hpp"
#include "editor/made_line.hpp"
#include "editor/selection.hpp"
#include "editor/shapes.hpp"
#include "editor/transform.hpp"
#include "map/entity_schema.hpp"

namespace hallway::editor {
namespace {

constexpr std::array kOnlyThings{kThings};
constexpr std::array kRename{ArgSpec{"what", ArgKind::kWhat, "one thing"}.needed(),
                             ArgSpec{"name", ArgKind::kName, "its new name"}.needed()};
constexpr std::array kGroup{kThings, ArgSpec{"name", ArgKind::kName, "of the group"}.needed()};
constexpr std::array kShow{ArgSpec{"what", ArgKind::kWhat, "things", "all"}};
constexpr std::array kMaterial{
    kThings, ArgSpec{"material", ArgKind::kMaterial, "the new one"}.needed(),
    ArgSpec{"face", ArgKind::kChoice, "which faces of each brush; north is +y, east is +x", "all",
            "all top bottom sides north east south west"}};
constexpr std::array kGrid{ArgSpec{"size", ArgKind::kText, "a length, or `off`; nothing: says what it is"}};

// ---- Names and groups ---------------------------------------------------------------------------------------------

/// Takes brushes out of the entities that they are in, with their numbers.
std::vector<BrushItem> taken_out(State& state, const std::vector<Thing>& things) {
  std::vector<BrushItem> items;
  std::vector<Thing> brushes;
  for (const Thing& thing : things) {
    if (!thing.brush) continue;
    items.push_back(state.entities[thing.entity]->brushes[*thing.brush]);
    brushes.push_back(thing);
  }
  remove(state, brushes);  // entities stay where they are
  return items;
}

void put_in(State& state, std::size_t entity, const std::vector<BrushItem>& items) {
  std::vector<BrushItem>& brushes = own(state, entity).brushes;
  brushes.insert(brushes.end(), items.begin(), items.end());
}

void check_loose(const Edit& edit, const Thing& thing, const char* verb) {
  const EntityItem& entity = *edit.state.entities[thing.entity];
  if (entity.is_world()) {
    if (thing.brush) return;
    refuse("{}: worldspawn is the world itself; name its brushes", verb);
  }
  if (thing.brush) {
    refuse("{}: {} belongs to {}; take that as a whole", verb, describe(edit.state, thing),
           describe(edit.state, {thing.entity, {}}));
  }
}

/// A key for the name of an entity.
const char* name_key(const EntityItem& entity) {
  if (group_number(entity)) return "_tb_name";
  const map::EntitySpec* spec = map::find_entity_spec(entity.classname());
  return spec != nullptr && spec->key("name") != nullptr ? "name" : "targetname";
}

/// References by a thing's old name follow.
void rename_references(State& state, const EntityItem& named, const std::string& key, const std::string& from,
                       const std::string& to) {
  const bool path = named.classname() == "hw_path";
  if (from.empty() || (!path && key != "targetname")) return;
  for (std::size_t e = 0; e < state.entities.size(); ++e) {
    const std::string classname(state.entities[e]->classname());
    const auto follow = [&](const char* reference) {
      if (state.entities[e]->has(reference, from)) set_key(state, e, reference, to);
    };
    if (path && (classname == "hw_waypoint" || classname == "hw_landmark_cloud")) follow("path");
    if (!path) follow("target");
    if (!path) follow("killtarget");
  }
}

void name_thing(Edit& edit, const Arguments& arguments) {
  const std::string& name = arguments.text("name");
  const Thing thing = resolve_one(edit.state, arguments.text("what"));
  if (!thing.brush && name_of(*edit.state.entities[thing.entity]) == name)
    return edit.report.say("it has that name");
  check_new_name(edit.state, name);
  check_loose(edit, thing, "name");
  if (thing.brush) {
    map::Entity group = new_group(edit.state, name);
    const auto items = taken_out(edit.state, {thing});
    const Id id = add_entity(edit.state, std::move(group));
    put_in(edit.state, edit.state.entities.size() - 1, items);
    return say_made(edit, {id});
  }
  const EntityItem entity = *edit.state.entities[thing.entity];
  const std::string key = name_key(entity);
  rename_references(edit.state, entity, key, entity.value(key), name);
  set_key(edit.state, thing.entity, key, name);
  if (const std::string* line = entity.head->find(kMadeKey))
    set_key(edit.state, thing.entity, kMadeKey, renamed_line(*line, name, units_of(edit.state)));
  for (const Thing& member : with_members(edit.state, {thing})) {
    if (member != thing) name_host(edit.state, member.entity);
  }
  say_changed(edit, {thing});
}

/// The value of a key that all things have in common; empty if they differ.
std::string common_value(const State& state, const std::vector<Thing>& things, const char* key) {
  std::set<std::string> values;
  for (const Thing& thing : things) {
    values.insert(state.entities[thing.entity]->value(key));
  }
  return values.size() == 1 ? *values.begin() : std::string();
}

void group_things(Edit& edit, const Arguments& arguments) {
  const std::string& name = arguments.text("name");
  const auto things = resolve(edit.state, arguments.text("what"));
  check_new_name(edit.state, name);
  for (const Thing& thing : things) check_loose(edit, thing, "group");
  map::Entity group = new_group(edit.state, name);
  const std::string number = group.value("_tb_id");
  for (const char* key : {"_tb_group", "_tb_layer"}) {
    if (std::string value = common_value(edit.state, things, key); !value.empty())
      group.add(key, std::move(value));
  }
  std::vector<Thing> parts;  // of what a line made, which are so no longer
  for (const Thing& thing : things) {
    if (maker_of(edit.state, thing) != thing.entity) parts.push_back(thing);
  }
  forget_made(edit.state, parts);
  for (const Thing& thing : things) {
    if (thing.brush) continue;
    if (edit.state.entities[thing.entity]->head->find("_tb_layer") != nullptr)
      set_key(edit.state, thing.entity, "_tb_layer", {});
    set_key(edit.state, thing.entity, "_tb_group", number);
  }
  const auto items = taken_out(edit.state, things);
  const Id id = add_entity(edit.state, std::move(group));
  put_in(edit.state, edit.state.entities.size() - 1, items);
  say_made(edit, {id});
}

/// The entity that takes the brushes of a group that is dissolved: the group or layer around it, else worldspawn.
std::size_t entity_around(const State& state, const EntityItem& group) {
  for (const char* key : {"_tb_group", "_tb_layer"}) {
    const std::string* wanted = group.head->find(key);
    const auto around = find_entity(state, [&](const EntityItem& entity) {
      return wanted != nullptr && entity.has("_tb_type", key) && entity.has("_tb_id", *wanted);
    });
    if (around) return *around;
  }
  return worldspawn(state);
}

void ungroup_one(Edit& edit, std::size_t index) {
  State& state = edit.state;
  const auto group = state.entities[index];
  const std::string number = *group_number(*group);
  while (maker_of(state, {index, {}})) forget_made(state, {{index, {}}});
  for (std::size_t e = 0; e < state.entities.size(); ++e) {
    if (!state.entities[e]->has("_tb_group", number)) continue;
    set_key(state, e, "_tb_group", {});
    for (const char* key : {"_tb_group", "_tb_layer"}) {
      if (const std::string* around = group->head->find(key)) set_key(state, e, key, *around);
    }
  }
  map::Entity rest = *state.entities[index]->head;
  const auto is_around = [](const map::KeyValue& pair) {
    return pair.key == "_tb_group" || pair.key == "_tb_layer";
  };
  std::erase_if(rest.keys,
                [&](const map::KeyValue& pair) { return pair.key.starts_with("_tb_") && !is_around(pair); });
  const bool keys_left =
      !group->brushes.empty() && std::ranges::any_of(rest.keys, [&](const map::KeyValue& pair) {
        return pair.key != "classname" && !is_around(pair);
      });
  if (keys_left) {
    set_head(state, index, std::move(rest));  // a density, say, which means these brushes
  } else {
    put_in(state, entity_around(state, *group), group->brushes);
  }
}

void ungroup(Edit& edit, const Arguments& arguments) {
  const auto things = resolve(edit.state, arguments.text("what"));
  for (const Thing& thing : things) {
    if (thing.brush || !group_number(*edit.state.entities[thing.entity]))
      refuse("ungroup: " + describe(edit.state, thing) + " is no group");
  }
  say_removed(edit, things);
  // A group's brushes may go into another of these groups, which is dissolved after it.
  auto inner_first = things;
  std::ranges::stable_sort(inner_first, [&](const Thing& a, const Thing& b) {
    return groups_of(edit.state, a).size() > groups_of(edit.state, b).size();
  });
  std::vector<Thing> gone;
  for (const Thing& thing : inner_first) {
    ungroup_one(edit, thing.entity);
    if (group_number(*edit.state.entities[thing.entity])) gone.push_back(thing);
  }
  remove(edit.state, gone);
}

// ---- What pictures show ---------------------------------------------------------------------------------------------

void set_hidden(Edit& edit, const std::set<Id>& hidden) {
  edit.state.desk.hidden.assign(hidden.begin(), hidden.end());
  edit.report.data["hidden"] = hidden;
  edit.report.say("{} hidden", hidden.size());
}

void hide(Edit& edit, const Arguments& arguments) {
  const auto things = resolve(edit.state, arguments.text("what"));
  std::set<Id> hidden(edit.state.desk.hidden.begin(), edit.state.desk.hidden.end());
  for (const Thing& thing : with_members(edit.state, things)) hidden.insert(id_of(edit.state, thing));
  set_hidden(edit, hidden);
}

void show(Edit& edit, const Arguments& arguments) {
  const std::string& what = arguments.text("what");
  std::set<Id> hidden(edit.state.desk.hidden.begin(), edit.state.desk.hidden.end());
  if (what == "all") {
    hidden.clear();
  } else {
    for (const Thing& thing : with_members(edit.state, resolve(edit.state, what))) {
      const EntityItem& entity = *edit.state.entities[thing.entity];
      // One brush of a hidden entity is shown by hiding the others instead.
      const bool split = thing.brush && hidden.erase(entity.id) > 0;
      for (const BrushItem& item : entity.brushes) {
        if (split) hidden.insert(item.id);
        if (!thing.brush) hidden.erase(item.id);
      }
      hidden.erase(id_of(edit.state, thing));
    }
  }
  set_hidden(edit, hidden);
}

// ---- Materials --------------------------------------------------------------------------------------------------------

bool is_meant(const map::Face& face, const std::string& which) {
  if (which == "all") return true;
  const auto plane = plane_of(face);
  if (!plane) return false;
  const Vec3& n = plane->normal;
  constexpr double kLevel = 0.7;  // steeper than 45 degrees is a side
  const bool side = std::abs(n.z()) <= kLevel;
  if (which == "top") return n.z() > kLevel;
  if (which == "bottom") return n.z() < -kLevel;
  if (which == "sides") return side;
  const bool along_x = std::abs(n.x()) > std::abs(n.y());
  if (!side) return false;
  if (which == "east") return along_x && n.x() > 0.0;
  if (which == "west") return along_x && n.x() < 0.0;
  return !along_x && (which == "north" ? n.y() > 0.0 : n.y() < 0.0);
}

/// The line of a group that gets a material as a whole, if that is the one argument about it.
std::string line_with_material(const std::string& line, const std::string& material, const Units& units) {
  const auto changed = changed_line(line, units, [&](Call& call) {
    const auto& specs = call.command->arguments;
    if (std::ranges::count(specs, ArgKind::kMaterial, &ArgSpec::kind) != 1) return false;
    call.arguments.set(std::ranges::find(specs, ArgKind::kMaterial, &ArgSpec::kind)->name, material);
    return true;
  });
  return changed.value_or("");
}

void material(Edit& edit, const Arguments& arguments) {
  const auto meant = resolve(edit.state, arguments.text("what"));
  const auto things = with_members(edit.state, meant);
  const std::string& name = arguments.text("material");
  const std::string& which = arguments.text("face");
  std::size_t faces = 0;
  change_brushes(edit.state, things,
                 [&](const EntityItem&, const map::Brush& brush) -> std::optional<map::Brush> {
                   map::Brush next = brush;
                   bool changed = false;
                   for (map::Face& face : next.faces) {
                     if (!is_meant(face, which)) continue;
                     ++faces;
                     changed = changed || face.material != name;
                     face.material = name;
                   }
                   return changed ? std::optional(std::move(next)) : std::nullopt;
                 });
  if (faces == 0 && which == "all") refuse("material: that has no faces");
  if (faces == 0) refuse("material: that has no face {}", which);
  std::vector<std::pair<std::size_t, std::string>> lines;
  for (const Thing& thing : things) {
    if (thing.brush || which != "all") continue;
    if (const std::string* line = edit.state.entities[thing.entity]->head->find(kMadeKey))
      lines.emplace_back(thing.entity, line_with_material(*line, name, units_of(edit.state)));
  }
  forget_made(edit.state, things);
  for (const auto& [entity, line] : lines) set_key(edit.state, entity, kMadeKey, line);
  say_changed(edit, meant);
  edit.report.data["faces"] = faces;
}

void grid(Edit& edit, const Arguments& arguments) {
  constexpr ArgSpec kSize = ArgSpec{"size", ArgKind::kLength}.within(1e-6, 1e3);
  double& size = edit.state.desk.grid_m;
  if (arguments.has("size")) {
    const std::string& word = arguments.text("size");
    size = word == "off" ? 0.0 : std::get<double>(read_value(kSize, word, units_of(edit.state)));
  }
  edit.report.data["grid_m"] = size;
  edit.report.say(size > 0.0 ? fmt::format("grid of {} m", format_double(size)) : "no grid");
}

constexpr std::string_view kLampAlone = "entity light at 2,3,2.5 light=300 targetname=lamp";

constexpr std::array kGroupsCommands{
    CommandSpec{
        .name = "name",
        .summary = "give a thing a name",
        .details = "What refers to it by its old name follows. A plain brush becomes a group of its own.",
        .arguments = kRename,
        .example = "name lamp lantern",
        .before = kLampAlone,
        .run = &name_thing},
    CommandSpec{
        .name = "group",
        .summary = "make things a group, as TrenchBroom has them",
        .details = "Groups may be in groups. Brushes of the world go into the group; entities keep being "
                   "what they are.",
        .arguments = kGroup,
        .example = "group lamp+second lamps",
        .before = "entity light at 2,3,2.5 targetname=lamp\nentity light at 4,3,2.5 targetname=second",
        .run = &group_things},
    CommandSpec{.name = "ungroup",
                .summary = "dissolve groups; what is in them stays",
                .arguments = kOnlyThings,
                .example = "ungroup lamps",
                .before = "entity light at 2,3,2.5 targetname=lamp\ngroup lamp lamps",
                .run = &ungroup},
    CommandSpec{.name = "hide",
                .summary = "leave things out of pictures",
                .details = "The map's file says nothing of it.",
                .arguments = kOnlyThings,
                .example = "hide lamp",
                .before = kLampAlone,
                .run = &hide},
    CommandSpec{.name = "show",
                .summary = "show hidden things again",
                .arguments = kShow,
                .example = "show all",
                .run = &show},
    CommandSpec{.name = "material",
                .summary = "put a material on the faces of things",
                .details = "`top` is what looks up, `sides` what is steeper than 45 degrees. A room is cut "
                           "out of a block: its floor is the "
                           "`bottom` of the brush that was taken away.",
                .arguments = kMaterial,
                .example = "material all brick face=top",
                .before = "box 0,0,0 2,2,2",
                .run = &material},
    CommandSpec{.name = "grid",
                .summary = "round the places that commands are given",
                .arguments = kGrid,
                .example = "grid 0.1",
                .run = &grid},
};

}  // namespace

std::span<const CommandSpec> group_commands() {
  return kGroupsCommands;
}

}  // namespace hallway::editor
