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

#include "base/text.hpp"
#include "editor/commands/making.hpp"
#include "editor/commands/openings.hpp"
#include "editor/commands/topics.hpp"
#include "editor/made_line.hpp"
#include "editor/refuse.hpp"
#include "editor/selection.hpp"
#include "editor/shapes.hpp"

namespace hallway::editor {
namespace {

constexpr ArgSpec kWhat{
    .name = "what", .kind = ArgKind::kWhat, .required = true, .help = "brushes, or shapes"};
constexpr ArgSpec kName{.name = "name", .kind = ArgKind::kName, .help = "what it is called from now on"};

constexpr ArgSpec opening_size(std::string_view name, std::string_view fallback, std::string_view help) {
  return {
      .name = name, .kind = ArgKind::kLength, .fallback = fallback, .help = help, .low = 1e-3, .high = 1e5};
}

constexpr ArgSpec kIn{.name = "in",
                      .kind = ArgKind::kWhat,
                      .required = true,
                      .help = "a wall, arc or room, or an upright block"};
constexpr ArgSpec kAt{.name = "at",
                      .kind = ArgKind::kLength,
                      .required = true,
                      .help = "its middle: how far along the wall, from where that begins",
                      .low = 0,
                      .high = 1e5};
constexpr ArgSpec kSide{.name = "side",
                        .kind = ArgKind::kChoice,
                        .help = "of a room: which wall; north is y+",
                        .choices = "north east south west"};
constexpr ArgSpec kRevealMaterial{
    .name = "material",
    .kind = ArgKind::kMaterial,
    .help = "of the faces in the wall [the wall's; under a door of a room the floor's]"};

constexpr std::array kDoor{kIn,
                           kAt,
                           opening_size("width", "0.9", "along the wall"),
                           opening_size("height", "2.1", "from the foot of the wall"),
                           kSide,
                           kRevealMaterial,
                           kName};
constexpr std::array kWindow{kIn,
                             kAt,
                             opening_size("width", "1.2", "along the wall"),
                             opening_size("height", "1.2", "from the sill up"),
                             ArgSpec{.name = "sill",
                                     .kind = ArgKind::kLength,
                                     .fallback = "0.9",
                                     .help = "how high over the foot of the wall it begins",
                                     .low = 0,
                                     .high = 1e5},
                             kSide,
                             kRevealMaterial,
                             kName};
constexpr std::array kSubtract{kWhat,
                               ArgSpec{.name = "order",
                                       .kind = ArgKind::kWhole,
                                       .help = "when it is cut out [after all that it is to cut]",
                                       .low = -1e6,
                                       .high = 1e6},
                               kName};
constexpr std::array kAdded{kWhat,
                            ArgSpec{.name = "order",
                                    .kind = ArgKind::kWhole,
                                    .help = "when it is added [after all cuts that it stands in]",
                                    .low = -1e6,
                                    .high = 1e6},
                            kName};
constexpr std::array kIntersect{
    kWhat, ArgSpec{.name = "with", .kind = ArgKind::kWhat, .required = true, .help = "the other brushes"},
    kName};
constexpr std::array kHollow{
    kWhat,
    ArgSpec{.name = "thickness",
            .kind = ArgKind::kLength,
            .fallback = "0.15",
            .help = "of the walls, within the outer faces",
            .low = 1e-4,
            .high = 1e5},
    ArgSpec{.name = "joints",
            .kind = ArgKind::kChoice,
            .fallback = "mitred",
            .help = "how the walls meet: on the bisector, or each ending at another",
            .choices = "mitred slabs"},
    ArgSpec{.name = "material", .kind = ArgKind::kMaterial, .help = "of the inside [that of the outer face]"},
    kName};
constexpr std::array kClip{
    kWhat,
    ArgSpec{.name = "axis",
            .kind = ArgKind::kChoice,
            .help = "with `at`: across which axis the plane stands",
            .choices = "x y z"},
    ArgSpec{.name = "at",
            .kind = ArgKind::kLength,
            .help = "where on the axis; its front is the side of larger numbers",
            .low = -1e5,
            .high = 1e5},
    ArgSpec{.name = "through",
            .kind = ArgKind::kPlaces,
            .help = "instead: three places in the plane, counter-clockwise as seen from its front"},
    ArgSpec{.name = "keep",
            .kind = ArgKind::kChoice,
            .fallback = "back",
            .help = "what stays of the brushes",
            .choices = "front back both"},
    ArgSpec{.name = "material", .kind = ArgKind::kMaterial, .help = "of the cut [that of the first face]"}};

/// The brushes that things are, entity by entity; groups count with their members.
using Brushes = std::map<std::size_t, std::set<std::size_t>>;

Brushes brushes_of(const State& state, std::string_view command, std::string_view what) {
  Brushes brushes;
  for (const Thing& thing : with_members(state, resolve(state, what))) {
    const EntityItem& entity = *state.entities[thing.entity];
    if (thing.brush) {
      brushes[thing.entity].insert(*thing.brush);
    } else if (entity.brushes.empty() && !group_number(entity)) {
      refuse(fmt::format("{}: {} has no brushes", command, describe(state, thing)));
    }
    for (std::size_t b = 0; !thing.brush && b < entity.brushes.size(); ++b) brushes[thing.entity].insert(b);
  }
  if (brushes.empty()) refuse(fmt::format("{}: {} has no brushes", command, printable(what)));
  for (const auto& [e, indices] : brushes) {
    for (const std::size_t b : indices) {
      if (!body_of(*state.entities[e]->brushes[b].brush))
        refuse(
            fmt::format("{}: {} is no closed body; `validate` says why", command, describe(state, {e, b})));
    }
  }
  return brushes;
}

/// Refuses brushes that are cuts already.
void check_solid(const State& state, std::string_view command, const Brushes& brushes) {
  for (const auto& [e, indices] : brushes) {
    if (state.entities[e]->classname() == "hw_subtract")
      refuse(fmt::format("{}: {} is cut out, and no solid", command, describe(state, {e, {}})));
  }
}

std::vector<Thing> things_of(const Brushes& brushes) {
  std::vector<Thing> things;
  for (const auto& [e, indices] : brushes) {
    for (const std::size_t b : indices) things.push_back({e, b});
  }
  return things;
}

std::vector<map::Brush> copies_of(const State& state, const Brushes& brushes) {
  std::vector<map::Brush> copies;
  for (const Thing& thing : things_of(brushes))
    copies.push_back(*state.entities[thing.entity]->brushes[*thing.brush].brush);
  return copies;
}

/// The group whose shape an entity is or is a part of.
std::string group_of(const EntityItem& entity) {
  if (const auto number = group_number(entity)) return *number;
  const std::string* number = entity.head->find("_tb_group");
  return number != nullptr ? *number : std::string();
}

/// Removes brushes, and what of the entities has nothing left in it; a group goes with the last of its parts.
void take_away(State& state, const Brushes& brushes) {
  forget_made(state, things_of(brushes));
  std::set<Id> touched;
  for (const auto& [e, indices] : brushes) {
    touched.insert(state.entities[e]->id);
    for (const std::size_t group : groups_of(state, {e, {}})) touched.insert(state.entities[group]->id);
  }
  remove(state, things_of(brushes));
  for (bool again = true; again;) {
    again = false;
    for (std::size_t e = state.entities.size(); e-- > 0;) {
      const EntityItem& entity = *state.entities[e];
      if (!touched.contains(entity.id) || !entity.brushes.empty() || entity.classname() == "worldspawn")
        continue;
      if (const auto number = group_number(entity); number && !members_of(state, *number).empty()) continue;
      remove(state, {Thing{e, {}}});
      again = true;
    }
  }
}

/// The numbers of things, before they go.
nlohmann::ordered_json numbers_of(const State& state, const Brushes& brushes) {
  auto numbers = nlohmann::ordered_json::array();
  for (const Thing& thing : things_of(brushes)) numbers.push_back(id_of(state, thing));
  return numbers;
}

void make_door(Edit& edit, const Arguments& arguments) {
  say_made(edit, {cut_opening(edit, "door", arguments)});
}

void make_window(Edit& edit, const Arguments& arguments) {
  say_made(edit, {cut_opening(edit, "window", arguments)});
}

/// One more than the highest order of what is added where the cuts are.
int order_after(const State& state, const Brushes& cuts) {
  const auto bodies = copies_of(state, cuts);
  const Box bounds = bounds_of(bodies);
  int order = 1;
  for (std::size_t e = 0; e < state.entities.size(); ++e) {
    const EntityItem& entity = *state.entities[e];
    const bool solid = entity.classname() == "hw_add" || entity.classname() == "hw_detail";
    if (!solid || order_of(entity) < order) continue;
    for (std::size_t b = 0; b < entity.brushes.size(); ++b) {
      const auto own = cuts.find(e);
      if (own != cuts.end() && own->second.contains(b)) continue;
      if (!may_overlap(bounds, *entity.brushes[b].brush)) continue;
      if (std::any_of(bodies.begin(), bodies.end(),
                      [&](const map::Brush& body) { return overlap(body, *entity.brushes[b].brush); })) {
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

/// What `subtract` and `detail` share: brushes leave where they are and become one entity.
void become_entity(Edit& edit, const Arguments& arguments, const char* classname, const Brushes& brushes,
                   int order) {
  State& state = edit.state;
  std::string name = arguments.text_or_empty("name");
  if (name.empty()) name = inherited_name(state, resolve(state, arguments.text("what")));
  map::Entity entity;
  entity.keys = {{{}, "classname", classname, 0}, {{}, "order", std::to_string(order), 0}};
  entity.brushes = copies_of(state, brushes);
  const std::string group = group_of(*state.entities[brushes.begin()->first]);
  const bool one_group = std::all_of(brushes.begin(), brushes.end(), [&](const auto& entry) {
    return group_of(*state.entities[entry.first]) == group;
  });
  take_away(state, brushes);
  check_new_name(state, name);
  if (!name.empty()) entity.keys.push_back({{}, "targetname", name, 0});
  // Brushes of a group of which something is left stay with it.
  const bool group_lives = one_group && !group.empty() &&
                           std::any_of(state.entities.begin(), state.entities.end(),
                                       [&](const auto& e) { return group_number(*e) == group; });
  if (group_lives) entity.keys.push_back({{}, "_tb_group", group, 0});
  say_made(edit, {add_entity(state, std::move(entity))});
}

void subtract(Edit& edit, const Arguments& arguments) {
  const Brushes brushes = brushes_of(edit.state, "subtract", arguments.text("what"));
  check_solid(edit.state, "subtract", brushes);
  const int order =
      arguments.has("order") ? static_cast<int>(arguments.whole("order")) : order_after(edit.state, brushes);
  become_entity(edit, arguments, "hw_subtract", brushes, order);
}

/// Makes solid brushes one entity of a class, whose order is that of what stands in cuts.
void make_added(Edit& edit, const Arguments& arguments, const char* command, const char* classname) {
  const Brushes brushes = brushes_of(edit.state, command, arguments.text("what"));
  check_solid(edit.state, command, brushes);
  const int order = arguments.has("order") ? static_cast<int>(arguments.whole("order"))
                                           : order_among_cuts(edit.state, copies_of(edit.state, brushes));
  become_entity(edit, arguments, classname, brushes, order);
}

void make_solid(Edit& edit, const Arguments& arguments) {
  make_added(edit, arguments, "add", "hw_add");
}

void make_detail(Edit& edit, const Arguments& arguments) {
  make_added(edit, arguments, "detail", "hw_detail");
}

void intersect(Edit& edit, const Arguments& arguments) {
  State& state = edit.state;
  Brushes all = brushes_of(state, "intersect", arguments.text("what"));
  const Brushes with = brushes_of(state, "intersect", arguments.text("with"));
  check_solid(state, "intersect", all);
  check_solid(state, "intersect", with);
  const auto one = copies_of(state, all), other = copies_of(state, with);
  Parts parts;
  for (const map::Brush& a : one) {
    for (const map::Brush& b : other) {
      if (!overlap(a, b)) continue;
      if (auto common = intersection(a, b)) parts.added.push_back(std::move(*common));
    }
  }
  if (parts.added.empty()) refuse("intersect: the two have no volume in common");
  for (const auto& [e, indices] : with) {
    for (const std::size_t b : indices) {
      if (!all[e].insert(b).second)
        refuse(fmt::format("intersect: {} is in both `what` and `with`", describe(state, {e, b})));
    }
  }
  edit.report.data["removed"] = numbers_of(state, all);
  take_away(state, all);
  parts.added_order = order_among_cuts(state, parts.added);
  say_made(edit, {add_shape(edit, arguments.text_or_empty("name"), {}, std::move(parts))});
}

void hollow(Edit& edit, const Arguments& arguments) {
  State& state = edit.state;
  const Brushes brushes = brushes_of(state, "hollow", arguments.text("what"));
  check_solid(state, "hollow", brushes);
  const std::string name = arguments.text_or_empty("name");
  if (!name.empty() && (brushes.size() != 1 || brushes.begin()->second.size() != 1))
    refuse("name: several brushes cannot all have one name");
  const double thickness = arguments.number("thickness") / edit.metres_per_unit();
  const Joint joint = arguments.text("joints") == "slabs" ? Joint::kSlabs : Joint::kMitred;
  std::vector<Id> made;
  std::map<Id, std::vector<map::Brush>> walls;  // of each entity
  for (const Thing& thing : things_of(brushes)) {
    const EntityItem& entity = *state.entities[thing.entity];
    auto pieces =
        hollowed(*entity.brushes[*thing.brush].brush, thickness, joint, arguments.text_or_empty("material"));
    const Id key = entity.classname() == "worldspawn" ? id_of(state, thing) : entity.id;
    std::move(pieces.begin(), pieces.end(), std::back_inserter(walls[key]));
  }
  // Brushes of entities become walls there; a plain brush becomes a group of its own.
  forget_made(state, things_of(brushes));
  std::vector<Thing> plain;
  for (const auto& [e, indices] : brushes) {
    const Id id = state.entities[e]->id;
    if (state.entities[e]->classname() == "worldspawn") {
      for (const std::size_t b : indices) plain.push_back({e, b});
      continue;
    }
    std::vector<map::Brush> next;
    for (std::size_t b = 0; b < state.entities[e]->brushes.size(); ++b) {
      if (!indices.contains(b)) next.push_back(*state.entities[e]->brushes[b].brush);
    }
    std::move(walls[id].begin(), walls[id].end(), std::back_inserter(next));
    set_brushes(state, e, std::move(next));
    made.push_back(id);
    if (!name.empty()) {
      check_new_name(state, name);
      set_key(state, e, group_number(*state.entities[e]) ? "_tb_name" : "targetname", name);
    }
  }
  std::vector<Id> plain_ids;
  for (const Thing& thing : plain) plain_ids.push_back(id_of(state, thing));
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
    const Eigen::Index axis = arguments.text("axis") == "x" ? 0 : arguments.text("axis") == "y" ? 1 : 2;
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
  Brushes gone{};
  std::vector<std::pair<Thing, map::Brush>> smaller{};
  std::vector<std::pair<std::size_t, map::Brush>> more{};  ///< and the entity that they go to

  bool empty() const { return gone.empty() && smaller.empty(); }
};

Clipped clipped(const Edit& edit, const Arguments& arguments, const Brushes& brushes) {
  const std::string& keep = arguments.text("keep");
  Clipped result;
  for (const Thing& thing : things_of(brushes)) {
    const map::Brush& brush = *edit.state.entities[thing.entity]->brushes[*thing.brush].brush;
    const std::string material =
        arguments.has("material") ? arguments.text("material") : brush.faces.front().material;
    Halves parts = halves(brush, cut_plane(edit, arguments, material));
    if (keep == "front") std::swap(parts.behind, parts.in_front);
    const bool cut = parts.behind && parts.in_front;
    if (!cut && keep == "both") continue;
    if (!parts.behind) {
      result.gone[thing.entity].insert(*thing.brush);
    } else if (cut) {
      result.smaller.emplace_back(thing, std::move(*parts.behind));
      if (keep == "both") result.more.emplace_back(thing.entity, std::move(*parts.in_front));
    }
  }
  return result;
}

void clip(Edit& edit, const Arguments& arguments) {
  State& state = edit.state;
  const Brushes brushes = brushes_of(state, "clip", arguments.text("what"));
  Clipped result = clipped(edit, arguments, brushes);
  if (result.empty()) refuse("clip: the plane takes nothing away from them");
  std::size_t kept = 0;
  for (const auto& [e, indices] : brushes) kept += indices.size();
  for (const auto& [e, indices] : result.gone) kept -= indices.size();
  if (kept == 0) refuse("clip: nothing would be left of them; `delete` removes things");
  forget_made(state, things_of(brushes));
  std::set<Id> changed;
  std::vector<Id> made;
  for (auto& [thing, brush] : result.smaller) {
    changed.insert(id_of(state, thing));
    set_brush(state, thing, std::move(brush));
  }
  for (auto& [entity, brush] : result.more) made.push_back(add_brush(state, entity, std::move(brush)));
  if (!result.gone.empty()) {
    edit.report.data["removed"] = numbers_of(state, result.gone);
    edit.report.lines.push_back(fmt::format("removed {} brushes in all", edit.report.data["removed"].size()));
    take_away(state, result.gone);
  }
  std::vector<Thing> things;
  for (const Id id : changed) things.push_back(*find(state, id));
  if (!things.empty()) say_changed(edit, things);
  if (!made.empty()) say_made(edit, made);
}

constexpr std::array kCutsCommands{
    CommandSpec{.name = "door",
                .topic = "cuts",
                .summary = "an opening in a wall, from its foot",
                .details = "Where a wall begins: a `wall` and an `arc` where they were drawn from; the walls "
                           "of a room at the west or "
                           "south end of its inside; a block at the west end, or else the south end, of its "
                           "longer side. In an arc the "
                           "place is counted along the chords, and the cut follows them.",
                .arguments = kDoor,
                .example = "door in north at 2 width 0.9 height 2.1",
                .before = "wall from 0,0 to 6,0 name=north",
                .run = &make_door},
    CommandSpec{.name = "window",
                .topic = "cuts",
                .summary = "an opening in a wall, above its foot",
                .details = "Places are counted as `door` does.",
                .arguments = kWindow,
                .example = "window in kitchen side=east at 2 width 1.2 height 1.1 sill 0.9 name=view",
                .before = "room from 0,0 to 5,4 name=kitchen",
                .run = &make_window},
    CommandSpec{.name = "subtract",
                .topic = "cuts",
                .summary = "cut out of the map what solid brushes cover",
                .arguments = kSubtract,
                .example = "subtract niche",
                .before = "box from 0,0 to 4,4,3\nbox from 1,1,1 to 2,4,2 name=niche",
                .run = &subtract},
    CommandSpec{
        .name = "add",
        .topic = "cuts",
        .summary = "put solid brushes together, to be added after cuts",
        .details = "Shapes that stand in a room are added after it without this; `add` makes several one "
                   "thing with one order.",
        .arguments = kAdded,
        .example = "add pillar+pillar-2 name=pillars",
        .before = "room from 0,0 to 5,4 name=kitchen\ncylinder at 1,1 radius 0.2 height 2.7 name=pillar\n"
                  "duplicate pillar by 2,0",
        .run = &make_solid},
    CommandSpec{.name = "detail",
                .topic = "cuts",
                .summary = "make solid brushes detail, which does not divide the map",
                .details =
                    "Furniture, door frames, and whatever else neither seals a room nor is worth a say in "
                    "what may see what: "
                    "they stay solid, and compiling and the visible sets cost less.",
                .arguments = kAdded,
                .example = "detail table",
                .before = "room from 0,0 to 5,4 name=kitchen\nbox from 1,1 to 2,2,0.7 name=table",
                .run = &make_detail},
    CommandSpec{.name = "intersect",
                .topic = "cuts",
                .summary = "keep only what two sets of brushes have in common",
                .arguments = kIntersect,
                .example = "intersect pillar with block name=half",
                .before = "cylinder at 0,0 radius 1 height 2 name=pillar\nbox from 0,-1 to 1,1,2 name=block",
                .run = &intersect},
    CommandSpec{.name = "hollow",
                .topic = "cuts",
                .summary = "make brushes into walls around what was their inside",
                .details = "The outer faces stay where they are. A plain brush becomes a group.",
                .arguments = kHollow,
                .example = "hollow crate thickness 2cm",
                .before = "box from 0,0 to 1,1,1 name=crate",
                .run = &hollow},
    CommandSpec{.name = "clip",
                .topic = "cuts",
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
