// SPDX-License-Identifier: MIT
//
// The map as a whole, and entities by their keys.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "base/error.hpp"
#include "base/text.hpp"
#include "editor/commands/making.hpp"
#include "editor/commands/topics.hpp"
#include "editor/selection.hpp"
#include "map/entity_schema.hpp"

namespace hallway::editor {
namespace {

constexpr std::array kNew{ArgSpec{.name = "scale",
                                  .kind = ArgKind::kNumber,
                                  .fallback = "0.01",
                                  .help = "metres per map unit",
                                  .low = 1e-6,
                                  .high = 1e3},
                          ArgSpec{.name = "points",
                                  .kind = ArgKind::kNumber,
                                  .fallback = "0",
                                  .help = "landmark points per square metre of surface",
                                  .low = 0,
                                  .high = 1e6}};
constexpr std::array kEntity{
    ArgSpec{.name = "class", .kind = ArgKind::kText, .required = true, .help = "its class, such as `light`"},
    ArgSpec{.name = "at", .kind = ArgKind::kPlace, .help = "where it is"},
    ArgSpec{.name = "keys", .kind = ArgKind::kKeys, .help = "other keys, to the end of the line"}};
constexpr std::array kKey{
    ArgSpec{.name = "what", .kind = ArgKind::kWhat, .required = true, .help = "entities"},
    ArgSpec{.name = "keys",
            .kind = ArgKind::kKeys,
            .required = true,
            .help = "keys with their new values; an empty value removes the key"}};
constexpr std::array kDelete{
    ArgSpec{.name = "what", .kind = ArgKind::kWhat, .required = true, .help = "things"}};

void make_new(Edit& edit, const Arguments& arguments) {
  State fresh;
  fresh.next_id = edit.state.next_id;
  fresh.desk.grid_m = edit.state.desk.grid_m;
  map::Entity world;
  // The first two lines tell TrenchBroom which game and format to open the map with.
  world.comments = {"Game: Hallway", "Format: Valve"};
  world.keys = {{{}, "classname", "worldspawn", 0},
                {{}, "mapversion", "220", 0},
                {{}, "_hallway", "1", 0},
                {{}, "_scale", format_double(arguments.number("scale")), 0}};
  if (arguments.number("points") > 0.0)
    world.keys.push_back({{}, "_points_per_m2", format_double(arguments.number("points")), 0});
  add_entity(fresh, std::move(world));
  edit.state = std::move(fresh);
  edit.report.lines.push_back("an empty map");
}

/// Refuses a class that nearly is one of Hallway's; classes of games are their own business.
void check_class(const std::string& name) {
  std::vector<std::string> names;
  for (const map::EntitySpec& spec : map::entity_schema()) names.emplace_back(spec.classname);
  if (name.starts_with("hw_") && map::find_entity_spec(name) == nullptr) {
    throw Error(ErrorCode::kUsage,
                fmt::format("class: there is no class \"{}\"{}; there are: {}", printable(name),
                            suggestion(name, names), fmt::join(names, ", ")));
  }
  if (name == "worldspawn")
    throw Error(ErrorCode::kUsage, "class: a map has one worldspawn; `key` changes its keys");
}

void make_entity(Edit& edit, const Arguments& arguments) {
  const std::string& name = arguments.text("class");
  check_class(name);
  map::Entity entity;
  entity.keys.push_back({{}, "classname", name, 0});
  if (arguments.has("at"))
    entity.keys.push_back({{}, "origin", vector_text(edit.units(arguments.place("at"))), 0});
  if (arguments.has("keys")) {
    for (const auto& [key, value] : arguments.keys("keys")) {
      if (entity.find(key) != nullptr)
        throw Error(ErrorCode::kUsage, fmt::format("entity: the key {} is given twice", printable(key)));
      entity.keys.push_back({{}, key, value, 0});
    }
  }
  say_made(edit, {add_entity(edit.state, std::move(entity))});
}

void set_keys(Edit& edit, const Arguments& arguments) {
  const auto things = resolve(edit.state, arguments.text("what"));
  for (const Thing& thing : things) {
    if (thing.brush) {
      throw Error(ErrorCode::kUsage,
                  fmt::format("key: {} has no keys; those of its entity are #{}'s",
                              describe(edit.state, thing), edit.state.entities[thing.entity]->id));
    }
    for (const auto& [key, value] : arguments.keys("keys")) {
      if (key == "classname" && value.empty())
        throw Error(ErrorCode::kUsage, "key: an entity has a classname");
      set_key(edit.state, thing.entity, key, value);
    }
  }
  say_changed(edit, things);
}

void remove_things(Edit& edit, const Arguments& arguments) {
  auto things = with_members(edit.state, resolve(edit.state, arguments.text("what")));
  add_fills(edit.state, things);
  for (const Thing& thing : things) {
    if (!thing.brush && edit.state.entities[thing.entity]->classname() == "worldspawn")
      throw Error(ErrorCode::kUsage, "delete: worldspawn stays; `delete all` removes its brushes");
  }
  say_removed(edit, things);
  remove(edit.state, things);
  // An entity whose class has a shape means nothing without one.
  std::vector<Thing> empty;
  for (const Thing& thing : things) {
    if (!thing.brush) continue;
    for (std::size_t e = 0; e < edit.state.entities.size(); ++e) {
      const EntityItem& entity = *edit.state.entities[e];
      const map::EntitySpec* spec = map::find_entity_spec(entity.classname());
      const bool shaped =
          spec != nullptr && spec->shape == map::EntityShape::kBrushes && entity.classname() != "worldspawn";
      if (shaped && entity.brushes.empty() && !group_number(entity)) empty.push_back({e, {}});
    }
    break;
  }
  remove(edit.state, empty);
}

constexpr std::array kWorldCommands{
    CommandSpec{.name = "new",
                .topic = "the map",
                .summary = "begin with an empty map",
                .details = "What was there can be had back with `undo`.",
                .arguments = kNew,
                .example = "new scale=0.01 points=25",
                .run = &make_new},
    CommandSpec{.name = "entity",
                .topic = "the map",
                .summary = "add an entity of any class with any keys",
                .arguments = kEntity,
                .example = "entity light at 2,3,2.5 light=300 targetname=lamp",
                .run = &make_entity},
    CommandSpec{.name = "key",
                .topic = "the map",
                .summary = "set keys of entities",
                .arguments = kKey,
                .example = "key lamp light=200 _color=",
                .before = "entity light at 2,3,2.5 targetname=lamp",
                .run = &set_keys},
    CommandSpec{.name = "delete",
                .topic = "the map",
                .summary = "remove things; of groups all that is in them",
                .arguments = kDelete,
                .example = "delete lamp",
                .before = "entity light at 2,3,2.5 targetname=lamp",
                .run = &remove_things},
};

}  // namespace

std::span<const CommandSpec> world_commands() {
  return kWorldCommands;
}

}  // namespace hallway::editor
