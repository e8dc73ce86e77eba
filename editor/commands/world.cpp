// SPDX-License-Identifier: MIT
//
// The map as a whole, and entities by their keys.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "base/refuse.hpp"
#include "base/text.hpp"
#include "editor/commands/making.hpp"
#include "editor/commands/topics.hpp"
#include "editor/selection.hpp"
#include "map/entity_schema.hpp"

namespace hallway::editor {
namespace {

constexpr std::array kNew{
    ArgSpec{"scale", ArgKind::kNumber, "metres per map unit", "0.01"}.within(1e-6, 1e3),
    ArgSpec{"points", ArgKind::kNumber, "landmark points per square metre of surface", "0"}.within(0, 1e6)};
constexpr std::array kEntity{ArgSpec{"class", ArgKind::kText, "its class, such as `light`"}.needed(),
                             ArgSpec{"at", ArgKind::kPlace, "where it is"},
                             ArgSpec{"keys", ArgKind::kKeys, "other keys, to the end of the line"}};
constexpr std::array kKey{
    ArgSpec{"what", ArgKind::kWhat, "entities"}.needed(),
    ArgSpec{"keys", ArgKind::kKeys, "keys with their new values; an empty value removes the key"}.needed()};
constexpr std::array kDelete{ArgSpec{"what", ArgKind::kWhat, "things"}.needed()};

void make_new(Edit& edit, const Arguments& arguments) {
  State fresh;
  fresh.next_id = edit.state.next_id;
  fresh.desk.grid_m = edit.state.desk.grid_m;
  map::Entity world;
  // The first two lines tell TrenchBroom which game and format to open the map with.
  world.comments = {"Game: Hallway", "Format: Valve"};
  world.keys = {{"classname", "worldspawn"},
                {"mapversion", "220"},
                {"_hallway", "1"},
                {"_scale", format_double(arguments.number("scale"))}};
  if (arguments.number("points") > 0.0)
    world.add("_points_per_m2", format_double(arguments.number("points")));
  add_entity(fresh, std::move(world));
  edit.state = std::move(fresh);
  edit.report.say("an empty map");
}

/// Refuses a class that nearly is one of Hallway's; classes of games are their own business.
void check_class(const std::string& name) {
  const auto names = names_in(map::entity_schema(), &map::EntitySpec::classname);
  if (name.starts_with("hw_") && map::find_entity_spec(name) == nullptr) {
    refuse("class: there is no class \"{}\"{}; there are: {}", printable(name), suggestion(name, names),
           fmt::join(names, ", "));
  }
  if (name == "worldspawn") refuse("class: a map has one worldspawn; `key` changes its keys");
}

void make_entity(Edit& edit, const Arguments& arguments) {
  const std::string& name = arguments.text("class");
  check_class(name);
  map::Entity entity;
  entity.add("classname", name);
  if (arguments.has("at")) entity.add("origin", vector_text(edit.units(arguments.place("at"))));
  if (arguments.has("keys")) {
    for (const auto& [key, value] : arguments.keys("keys")) {
      if (entity.find(key) != nullptr) refuse("entity: the key {} is given twice", printable(key));
      entity.add(key, value);
    }
  }
  say_made(edit, {add_entity(edit.state, std::move(entity))});
}

void set_keys(Edit& edit, const Arguments& arguments) {
  const auto things = resolve(edit.state, arguments.text("what"));
  for (const Thing& thing : things) {
    if (thing.brush) {
      refuse("key: {} has no keys; those of its entity are #{}'s", describe(edit.state, thing),
             edit.state.entities[thing.entity]->id);
    }
    for (const auto& [key, value] : arguments.keys("keys")) {
      if (key == "classname" && value.empty()) refuse("key: an entity has a classname");
      set_key(edit.state, thing.entity, key, value);
    }
  }
  say_changed(edit, things);
}

void remove_things(Edit& edit, const Arguments& arguments) {
  auto things = with_members(edit.state, resolve(edit.state, arguments.text("what")));
  add_fills(edit.state, things);
  for (const Thing& thing : things) {
    if (!thing.brush && edit.state.entities[thing.entity]->is_world())
      refuse("delete: worldspawn stays; `delete all` removes its brushes");
  }
  say_removed(edit, things);
  remove(edit.state, things);
  // An entity whose class has a shape means nothing without one.
  if (std::ranges::none_of(things, [](const Thing& thing) { return thing.brush.has_value(); })) return;
  remove(edit.state, entities_where(edit.state, [](const EntityItem& entity) {
           const map::EntitySpec* spec = map::find_entity_spec(entity.classname());
           const bool shaped =
               spec != nullptr && spec->shape == map::EntityShape::kBrushes && !entity.is_world();
           return shaped && entity.brushes.empty() && !group_number(entity);
         }));
}

constexpr std::array kWorldCommands{
    CommandSpec{.name = "new",
                .summary = "begin with an empty map",
                .details = "What was there can be had back with `undo`.",
                .arguments = kNew,
                .example = "new scale=0.01 points=25",
                .run = &make_new},
    CommandSpec{.name = "entity",
                .summary = "add an entity of any class with any keys",
                .arguments = kEntity,
                .example = "entity light at 2,3,2.5 light=300 targetname=lamp",
                .run = &make_entity},
    CommandSpec{.name = "key",
                .summary = "set keys of entities",
                .arguments = kKey,
                .example = "key lamp light=200 _color=",
                .before = "entity light at 2,3,2.5 targetname=lamp",
                .run = &set_keys},
    CommandSpec{.name = "delete",
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
