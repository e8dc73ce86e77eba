// SPDX-License-Identifier: MIT
//
// What is taken away from what is there.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "base/refuse.hpp"
#include "base/text.hpp"
#include "editor/commands/making.hpp"
#include "editor/commands/openings.hpp"
#include "editor/commands/topics.hpp"
#include "editor/made_line.hpp"
#include "editor/selection.hpp"
#include "editor/shapes.hpp"

namespace hallway::editor {
namespace {

constexpr ArgSpec kWhat = ArgSpec{"what", ArgKind::kWhat, "brushes, or shapes"}.needed();
constexpr ArgSpec kName{"name", ArgKind::kName, "what it is called from now on"};

constexpr ArgSpec opening_size(std::string_view name, std::string_view fallback, std::string_view help) {
  return ArgSpec{name, ArgKind::kLength, help, fallback}.within(1e-3, 1e5);
}

constexpr ArgSpec kIn = ArgSpec{"in", ArgKind::kWhat, "a wall, arc or room, or an upright block"}.needed();
constexpr ArgSpec kAt =
    ArgSpec{"at", ArgKind::kLength, "its middle: how far along the wall, from where that begins"}
        .needed()
        .within(0, 1e5);
constexpr ArgSpec kSide{"side", ArgKind::kChoice, "of a room: which wall; north is y+", "",
                        "north east south west"};
constexpr ArgSpec kRevealMaterial{
    "material", ArgKind::kMaterial,
    "of the faces in the wall [the wall's; under a door of a room the floor's]"};

constexpr std::array kDoor{
    kIn,
    kAt,
    opening_size("width", "0.9", "along the wall"),
    opening_size("height", "2.1", "from the foot of the wall"),
    kSide,
    kRevealMaterial,
    ArgSpec{"leaf", ArgKind::kMaterial, "of a door leaf that hangs in it, 4 cm thick [no leaf]"},
    ArgSpec{"open", ArgKind::kAngle,
            "how far the leaf is open, counter-clockwise from above about the "
            "jamb nearer to where the wall begins [0, closed]"}
        .within(-135, 135),
    kName};
constexpr std::array kWindow{
    kIn,
    kAt,
    opening_size("width", "1.2", "along the wall"),
    opening_size("height", "1.2", "from the sill up"),
    ArgSpec{"sill", ArgKind::kLength, "how high over the foot of the wall it begins", "0.9"}.within(0, 1e5),
    kSide,
    kRevealMaterial,
    ArgSpec{"pane", ArgKind::kMaterial, "of a pane that fills it, 2 cm thick [no pane]"},
    kName};
constexpr std::array kSubtract{
    kWhat,
    ArgSpec{"order", ArgKind::kWhole, "when it is cut out [after all that it is to cut]"}.within(-1e6, 1e6),
    kName};
constexpr std::array kAdded{
    kWhat,
    ArgSpec{"order", ArgKind::kWhole, "when it is added [after all cuts that it is in]"}.within(-1e6, 1e6),
    kName};
constexpr std::array kGnssZone{
    kWhat,
    ArgSpec{"factor", ArgKind::kNumber, "by which errors grow in it, at least 1; 0: there is no fix", "0"}
        .within(0, 1e6),
    kName};
constexpr std::array kIntersect{kWhat, ArgSpec{"with", ArgKind::kWhat, "the other brushes"}.needed(), kName};
constexpr std::array kHollow{
    kWhat,
    ArgSpec{"thickness", ArgKind::kLength, "of the walls, within the outer faces", "0.15"}.within(1e-4, 1e5),
    ArgSpec{"joints", ArgKind::kChoice, "how the walls meet: on the bisector, or each ending at another",
            "mitred", "mitred slabs"},
    ArgSpec{"material", ArgKind::kMaterial, "of the inside [that of the outer face]"}, kName};
constexpr std::array kClip{
    kWhat,
    ArgSpec{"axis", ArgKind::kChoice, "with `at`: across which axis the plane is", "", "x y z"},
    ArgSpec{"at", ArgKind::kLength, "where on the axis; its front is the side of larger numbers"}.within(-1e5,
                                                                                                         1e5),
    ArgSpec{"through", ArgKind::kPlaces,
            "instead: three places in the plane, counter-clockwise as seen from its front"},
    ArgSpec{"keep", ArgKind::kChoice, "what stays of the brushes", "back", "front back both"},
    ArgSpec{"material", ArgKind::kMaterial, "of the cut [that of the first face]"}};

/// The brushes that things are, sorted; groups count with their members.
std::vector<Thing> brushes_of(const State& state, std::string_view command, std::string_view what) {
  std::vector<Thing> brushes;
  for (const Thing& thing : with_members(state, resolve(state, what))) {
    const EntityItem& entity = *state.entities[thing.entity];
    if (thing.brush) {
      brushes.push_back(thing);
      continue;
    }
    if (entity.brushes.empty() && !group_number(entity))
      refuse("{}: {} has no brushes", command, describe(state, thing));
    for (std::size_t b = 0; b < entity.brushes.size(); ++b) brushes.push_back({thing.entity, b});
  }
  if (brushes.empty()) refuse("{}: {} has no brushes", command, printable(what));
  for (const Thing& thing : brushes) {
    if (!body_of(brush_at(state, thing)))
      refuse("{}: {} is no closed body; `validate` says why", command, describe(state, thing));
  }
  return brushes;
}

/// Refuses brushes that are cuts already.
void check_solid(const State& state, std::string_view command, const std::vector<Thing>& brushes) {
  for (const Thing& thing : brushes) {
    if (state.entities[thing.entity]->classname() == "hw_subtract")
      refuse("{}: {} is cut out, and no solid", command, describe(state, {thing.entity, {}}));
  }
}

std::vector<Thing> solids_of(const State& state, std::string_view command, std::string_view what) {
  std::vector<Thing> brushes = brushes_of(state, command, what);
  check_solid(state, command, brushes);
  return brushes;
}

std::vector<map::Brush> copies_of(const State& state, const std::vector<Thing>& brushes) {
  std::vector<map::Brush> copies;
  for (const Thing& thing : brushes) copies.push_back(brush_at(state, thing));
  return copies;
}

/// Removes brushes, and what of the entities has nothing left in it; a group goes with the last of its parts.
void take_away(State& state, const std::vector<Thing>& brushes) {
  forget_made(state, brushes);
  std::set<Id> touched;
  for (const Thing& thing : brushes) {
    touched.insert(state.entities[thing.entity]->id);
    for (const std::size_t group : groups_of(state, thing)) touched.insert(state.entities[group]->id);
  }
  remove(state, brushes);
  for (bool again = true; again;) {
    again = false;
    for (std::size_t e = state.entities.size(); e-- > 0;) {
      const EntityItem& entity = *state.entities[e];
      if (!touched.contains(entity.id) || !entity.brushes.empty() || entity.is_world()) continue;
      if (const auto number = group_number(entity); number && !members_of(state, *number).empty()) continue;
      remove(state, {Thing{e, {}}});
      again = true;
    }
  }
}

/// The numbers of things, before they go.
std::vector<Id> ids_of(const State& state, const std::vector<Thing>& things) {
  std::vector<Id> ids;
  for (const Thing& thing : things) ids.push_back(id_of(state, thing));
  return ids;
}

template <const auto& kCommand>
void make_opening(Edit& edit, const Arguments& arguments) {
  say_made(edit, {cut_opening(edit, kCommand, arguments)});
}

/// One more than the highest order of what is added where the cuts are.
int order_after(const State& state, const std::vector<Thing>& cuts) {
  const auto bodies = copies_of(state, cuts);
  const Box bounds = bounds_of(bodies);
  int order = 1;
  for (std::size_t e = 0; e < state.entities.size(); ++e) {
    const EntityItem& entity = *state.entities[e];
    const bool solid = entity.classname() == "hw_add" || entity.classname() == "hw_detail";
    if (!solid || order_of(entity) < order) continue;
    for (std::size_t b = 0; b < entity.brushes.size(); ++b) {
      if (std::ranges::binary_search(cuts, Thing{e, b})) continue;
      if (any_overlaps(bodies, bounds, *entity.brushes[b].brush)) {
        order = order_of(entity) + 1;
        break;
      }
    }
  }
  return order;
}

/// The name of the one entity that all brushes are of, where all of it goes.
std::string inherited_name(const State& state, const std::vector<Thing>& things) {
  if (things.size() != 1 || things.front().brush) return {};
  return name_of(*state.entities[things.front().entity]);
}

/// Makes brushes one entity of a class, with a key. They leave where they are.
void become_entity(Edit& edit, const Arguments& arguments, const char* classname,
                   const std::vector<Thing>& brushes, map::KeyValue key) {
  State& state = edit.state;
  std::string name = arguments.text_or_empty("name");
  if (name.empty()) name = inherited_name(state, resolve(state, arguments.text("what")));
  map::Entity entity;
  entity.keys = {{"classname", classname}, std::move(key)};
  entity.brushes = copies_of(state, brushes);
  const auto group_at = [&](const Thing& thing) { return group_of(*state.entities[thing.entity]); };
  const std::string group = group_at(brushes.front());
  const bool one_group =
      std::ranges::all_of(brushes, [&](const Thing& thing) { return group_at(thing) == group; });
  take_away(state, brushes);
  check_new_name(state, name);
  if (!name.empty()) entity.add("targetname", name);
  // Brushes of a group of which something is left stay with it.
  if (one_group && !group.empty() && find_group(state, group)) entity.add("_tb_group", group);
  say_made(edit, {add_entity(state, std::move(entity))});
}

/// The order that is given, or else `order`.
map::KeyValue order_key(const Arguments& arguments, std::int64_t order) {
  return {"order", std::to_string(arguments.has("order") ? arguments.whole("order") : order)};
}

void subtract(Edit& edit, const Arguments& arguments) {
  const auto brushes = solids_of(edit.state, "subtract", arguments.text("what"));
  become_entity(edit, arguments, "hw_subtract", brushes,
                order_key(arguments, order_after(edit.state, brushes)));
}

void make_gnss_zone(Edit& edit, const Arguments& arguments) {
  const double factor = arguments.number("factor");
  if (factor > 0.0 && factor < 1.0) refuse("gnss_zone: factor is below 1; 0 is for no fix at all");
  become_entity(edit, arguments, "hw_gnss_zone", solids_of(edit.state, "gnss_zone", arguments.text("what")),
                {"factor", format_double(factor)});
}

/// Makes solid brushes one entity of a class, whose order is that of what stands in cuts.
void make_added(Edit& edit, const Arguments& arguments, const char* command, const char* classname) {
  const auto brushes = solids_of(edit.state, command, arguments.text("what"));
  become_entity(edit, arguments, classname, brushes,
                order_key(arguments, order_among_cuts(edit.state, copies_of(edit.state, brushes))));
}

void make_solid(Edit& edit, const Arguments& arguments) {
  make_added(edit, arguments, "add", "hw_add");
}

void make_detail(Edit& edit, const Arguments& arguments) {
  make_added(edit, arguments, "detail", "hw_detail");
}

void intersect(Edit& edit, const Arguments& arguments) {
  State& state = edit.state;
  std::vector<Thing> all = brushes_of(state, "intersect", arguments.text("what"));
  const std::vector<Thing> with = brushes_of(state, "intersect", arguments.text("with"));
  check_solid(state, "intersect", all);
  check_solid(state, "intersect", with);
  Parts parts;
  for (const Thing& one : all) {
    for (const Thing& other : with) {
      const map::Brush &a = brush_at(state, one), &b = brush_at(state, other);
      if (!overlap(a, b)) continue;
      if (auto common = intersection(a, b)) parts.added.push_back(std::move(*common));
    }
  }
  if (parts.added.empty()) refuse("intersect: the two have no volume in common");
  for (const Thing& thing : with) {
    if (std::ranges::binary_search(all, thing))
      refuse("intersect: {} is in both `what` and `with`", describe(state, thing));
  }
  all.insert(all.end(), with.begin(), with.end());
  std::ranges::sort(all);
  edit.report.data["removed"] = ids_of(state, all);
  take_away(state, all);
  parts.added_order = order_among_cuts(state, parts.added);
  say_made(edit, {add_shape(edit, arguments.text_or_empty("name"), {}, std::move(parts))});
}

void hollow(Edit& edit, const Arguments& arguments) {
  State& state = edit.state;
  const auto brushes = solids_of(state, "hollow", arguments.text("what"));
  const std::string name = arguments.text_or_empty("name");
  if (!name.empty() && brushes.size() != 1) refuse("name: several brushes cannot all have one name");
  const double thickness = arguments.number("thickness") / edit.metres_per_unit();
  const Joint joint = arguments.text("joints") == "slabs" ? Joint::kSlabs : Joint::kMitred;
  // Brushes of entities become walls there; a plain brush becomes a group of its own.
  std::map<Id, std::vector<map::Brush>> walls;  // of each entity, or plain brush
  std::vector<Thing> plain;
  std::set<std::size_t> entities;
  for (const Thing& thing : brushes) {
    const EntityItem& entity = *state.entities[thing.entity];
    auto pieces = hollowed(brush_at(state, thing), thickness, joint, arguments.text_or_empty("material"));
    std::ranges::move(pieces, std::back_inserter(walls[entity.is_world() ? id_of(state, thing) : entity.id]));
    if (entity.is_world()) {
      plain.push_back(thing);
    } else {
      entities.insert(thing.entity);
    }
  }
  forget_made(state, brushes);
  std::vector<Id> made;
  for (const std::size_t e : entities) {
    const Id id = state.entities[e]->id;
    std::vector<map::Brush> next;
    for (std::size_t b = 0; b < state.entities[e]->brushes.size(); ++b) {
      if (!std::ranges::binary_search(brushes, Thing{e, b})) next.push_back(brush_at(state, {e, b}));
    }
    std::ranges::move(walls[id], std::back_inserter(next));
    set_brushes(state, e, std::move(next));
    made.push_back(id);
    if (!name.empty()) {
      check_new_name(state, name);
      set_key(state, e, group_number(*state.entities[e]) ? "_tb_name" : "targetname", name);
    }
  }
  const std::vector<Id> plain_ids = ids_of(state, plain);
  remove(state, plain);
  for (const Id id : plain_ids) made.push_back(add_shape(edit, name, {}, {.added = std::move(walls[id])}));
  say_made(edit, made);
}

/// The plane of `clip` as a face whose brush would be behind it.
map::Face cut_plane(const Edit& edit, const Arguments& arguments, const std::string& material) {
  const bool across = arguments.has("axis") && arguments.has("at");
  const bool any_across = arguments.has("axis") || arguments.has("at");
  if (across == arguments.has("through") || (any_across && !across))
    refuse("clip: the plane is either `axis` and `at`, or three places, `through`");
  if (across) {
    const int axis = axis_of(arguments.text("axis"));
    const Vec3 at = edit.units(arguments.number("at") * Vec3::Unit(axis));
    constexpr double kApart = 64.0;
    return face_through(at, at + kApart * Vec3::Unit((axis + 1) % 3),
                        at + kApart * Vec3::Unit((axis + 2) % 3), material);
  }
  const auto& places = arguments.places("through");
  if (places.size() != 3) refuse("through: a plane goes through three places");
  return face_through(edit.units(places[0]), edit.units(places[1]), edit.units(places[2]), material);
}

/// What a clipping makes of the brushes.
struct Clipped {
  std::vector<Thing> gone{};
  std::vector<std::pair<Thing, map::Brush>> smaller{};
  std::vector<std::pair<std::size_t, map::Brush>> more{};  ///< and the entity that they go to
};

Clipped clipped(const Edit& edit, const Arguments& arguments, const std::vector<Thing>& brushes) {
  const std::string& keep = arguments.text("keep");
  Clipped result;
  for (const Thing& thing : brushes) {
    const map::Brush& brush = brush_at(edit.state, thing);
    const std::string material =
        arguments.has("material") ? arguments.text("material") : brush.faces.front().material;
    Halves parts = halves(brush, cut_plane(edit, arguments, material));
    if (keep == "front") std::swap(parts.behind, parts.in_front);
    const bool cut = parts.behind && parts.in_front;
    if (!cut && keep == "both") continue;
    if (!parts.behind) {
      result.gone.push_back(thing);
    } else if (cut) {
      result.smaller.emplace_back(thing, std::move(*parts.behind));
      if (keep == "both") result.more.emplace_back(thing.entity, std::move(*parts.in_front));
    }
  }
  return result;
}

void clip(Edit& edit, const Arguments& arguments) {
  State& state = edit.state;
  const auto brushes = brushes_of(state, "clip", arguments.text("what"));
  Clipped result = clipped(edit, arguments, brushes);
  if (result.gone.empty() && result.smaller.empty()) refuse("clip: the plane takes nothing away from them");
  if (result.gone.size() == brushes.size())
    refuse("clip: nothing would be left of them; `delete` removes things");
  forget_made(state, brushes);
  std::set<Id> changed;
  std::vector<Id> made;
  for (auto& [thing, brush] : result.smaller) {
    changed.insert(id_of(state, thing));
    set_brush(state, thing, std::move(brush));
  }
  for (auto& [entity, brush] : result.more) made.push_back(add_brush(state, entity, std::move(brush)));
  if (!result.gone.empty()) {
    edit.report.data["removed"] = ids_of(state, result.gone);
    edit.report.say("removed {} brushes in all", result.gone.size());
    take_away(state, result.gone);
  }
  std::vector<Thing> things;
  for (const Id id : changed) things.push_back(*find(state, id));
  if (!things.empty()) say_changed(edit, things);
  if (!made.empty()) say_made(edit, made);
}

constexpr std::string_view kDoorName = "door", kWindowName = "window";

constexpr std::array kCutsCommands{
    CommandSpec{.name = kDoorName,
                .summary = "an opening in a wall, from its foot",
                .details = "Where a wall begins: a `wall` and an `arc` where they were drawn from; the walls "
                           "of a room at the west or "
                           "south end of its inside; a block at the west end, or else the south end, of its "
                           "longer side. In an arc the "
                           "place is counted along the chords, and the cut follows them. A leaf is solid: "
                           "closed, it seals the "
                           "opening. `remake` opens and closes it.",
                .arguments = kDoor,
                .example = "door in north at 2 width 0.9 height 2.1 leaf=wood open=60",
                .before = "wall from 0,0 to 6,0 name=north",
                .run = &make_opening<kDoorName>},
    CommandSpec{
        .name = kWindowName,
        .summary = "an opening in a wall, above its foot",
        .details = "Places are counted as `door` does. A pane is solid, of whatever material.",
        .arguments = kWindow,
        .example = "window in kitchen side=east at 2 width 1.2 height 1.1 sill 0.9 pane=glass name=view",
        .before = "room from 0,0 to 5,4 name=kitchen",
        .run = &make_opening<kWindowName>},
    CommandSpec{.name = "subtract",
                .summary = "cut out of the map what solid brushes cover",
                .arguments = kSubtract,
                .example = "subtract niche",
                .before = "box from 0,0 to 4,4,3\nbox from 1,1,1 to 2,4,2 name=niche",
                .run = &subtract},
    CommandSpec{.name = "add",
                .summary = "put solid brushes together, to be added after cuts",
                .details = "Shapes in a room are added after it without this; `add` makes several one "
                           "thing with one order.",
                .arguments = kAdded,
                .example = "add pillar+pillar-2 name=pillars",
                .before =
                    "room from 0,0 to 5,4 name=kitchen\ncylinder at 1,1 radius 0.2 height 2.7 name=pillar\n"
                    "duplicate pillar by 2,0",
                .run = &make_solid},
    CommandSpec{.name = "detail",
                .summary = "make solid brushes detail, which does not divide the map",
                .details =
                    "Furniture, door frames, and whatever else neither seals a room nor is worth a say in "
                    "what may see what: "
                    "they stay solid, and compiling and the visible sets cost less.",
                .arguments = kAdded,
                .example = "detail table",
                .before = "room from 0,0 to 5,4 name=kitchen\nbox from 1,1 to 2,2,0.7 name=table",
                .run = &make_detail},
    CommandSpec{.name = "gnss_zone",
                .summary = "make brushes a place where satellites are badly seen",
                .details = "They are no longer solid.",
                .arguments = kGnssZone,
                .example = "gnss_zone roof factor=5",
                .before = "box from 0,0 to 8,4,3 name=roof",
                .run = &make_gnss_zone},
    CommandSpec{.name = "intersect",
                .summary = "keep only what two sets of brushes have in common",
                .arguments = kIntersect,
                .example = "intersect pillar with block name=half",
                .before = "cylinder at 0,0 radius 1 height 2 name=pillar\nbox from 0,-1 to 1,1,2 name=block",
                .run = &intersect},
    CommandSpec{.name = "hollow",
                .summary = "make brushes into walls around what was their inside",
                .details = "The outer faces stay where they are. A plain brush becomes a group.",
                .arguments = kHollow,
                .example = "hollow crate thickness 2cm",
                .before = "box from 0,0 to 1,1,1 name=crate",
                .run = &hollow},
    CommandSpec{.name = "clip",
                .summary = "cut brushes along a plane, and keep one side or both",
                .arguments = kClip,
                .example = "clip block axis=x at=1 keep=both",
                .before = "box from 0,0 to 3,1,1 name=block",
                .run = &clip},
};

}  // namespace

std::span<const CommandSpec> cut_commands() {
  return kCutsCommands;
}

}  // namespace hallway::editor
