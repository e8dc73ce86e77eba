// SPDX-License-Identifier: MIT
//
// Shapes that are made by their measures, and made again with others.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/refuse.hpp"
#include "base/text.hpp"
#include "editor/commands/making.hpp"
#include "editor/commands/openings.hpp"
#include "editor/commands/shape_parts.hpp"
#include "editor/commands/topics.hpp"
#include "editor/made_line.hpp"
#include "editor/selection.hpp"
#include "editor/shapes.hpp"

namespace hallway::editor {
namespace {

constexpr double kShortest_m = 1e-4;
constexpr double kLongest_m = 1e5;

constexpr ArgSpec place(std::string_view name, std::string_view help) {
  return ArgSpec{name, ArgKind::kPlace, help}.needed();
}

/// A length above 0; without a fallback and not required it may be left out.
constexpr ArgSpec size(std::string_view name, std::string_view fallback, std::string_view help) {
  return ArgSpec{name, ArgKind::kLength, help, fallback}.within(kShortest_m, kLongest_m);
}

constexpr ArgSpec corner(std::string_view name, std::string_view help) {
  return ArgSpec{name, ArgKind::kLength, help}.within(0.0, kLongest_m);
}

constexpr ArgSpec whole(std::string_view name, std::string_view fallback, std::string_view help, double low,
                        double high) {
  return ArgSpec{name, ArgKind::kWhole, help, fallback}.within(low, high);
}

constexpr ArgSpec material(std::string_view fallback) {
  return {"material", ArgKind::kMaterial, "of all its faces: wall, floor, wood, brick, glass, ...", fallback};
}

constexpr ArgSpec kName{"name", ArgKind::kName, "what it is called from now on"};

constexpr std::array kBox{ArgSpec{"from", ArgKind::kPlace, "a corner"},
                          ArgSpec{"to", ArgKind::kPlace, "the opposite corner"},
                          ArgSpec{"at", ArgKind::kPlace, "instead of corners: the middle of its floor"},
                          ArgSpec{"size", ArgKind::kVector, "with `at`: how large it is"},
                          material("wall"),
                          kName};
constexpr std::array kWedge{
    place("from", "a corner of the block that it is half of"), place("to", "the opposite corner"),
    ArgSpec{"high", ArgKind::kChoice, "the side at which it has its full height; north is y+", "north",
            "north east south west"},
    material("wall"), kName};
constexpr std::array kCylinder{
    place("at", "the middle of the disc at its lower end"),
    size("radius", "", "from the middle to the corners").needed(),
    size("height", "", "its length along the axis").needed(),
    whole("sides", "16", "how many flat sides it has", 3, 256),
    ArgSpec{"axis", ArgKind::kChoice, "along which it stands or lies", "z", "x y z"},
    material("pillar"),
    kName};
constexpr std::array kPrism{
    ArgSpec{"polygon", ArgKind::kPlaces, "the corners of its floor, one way round"}.needed(),
    size("height", "", "how high it is").needed(),
    ArgSpec{"z", ArgKind::kLength, "how far over its corners it begins", "0"}.within(-kLongest_m, kLongest_m),
    material("wall"), kName};
constexpr std::array kWall{
    place("from", "where its middle line begins, at the foot"),
    place("to", "where that ends"),
    size("height", "2.7", "how high it is"),
    size("thickness", "0.15", "half of it to either side of the line"),
    corner("before", "how much longer it is before `from` [what fills a corner with a wall that ends there]"),
    corner("behind", "how much longer it is behind `to` [the same]"),
    material("wall"),
    kName};
constexpr std::array kArc{
    place("centre", "the middle of the circle, at the foot of the wall"),
    size("radius", "", "of the middle line").needed(),
    ArgSpec{"from", ArgKind::kAngle, "where it begins: 0 is along x, 90 along y"}.needed().within(-3600,
                                                                                                  3600),
    ArgSpec{"to", ArgKind::kAngle, "where it ends, counter-clockwise from there"}.needed().within(-3600,
                                                                                                  3600),
    whole("segments", "8", "how many straight stretches it has", 1, 1024),
    size("height", "2.7", "how high it is"),
    size("thickness", "0.15", "half of it to either side of the middle line"),
    material("wall"),
    kName};
constexpr std::array kRoom{place("from", "a corner of its inside, on the floor"),
                           place("to", "the opposite corner of the floor"),
                           size("height", "2.7", "from the floor to the ceiling"),
                           size("wall", "0.15", "thickness of the walls"),
                           size("floor", "", "thickness of the floor [as the walls]"),
                           size("ceiling", "", "thickness of the ceiling [as the walls]"),
                           material("wall"),
                           ArgSpec{"floor_material", ArgKind::kMaterial, "of the floor", "floor"},
                           ArgSpec{"ceiling_material", ArgKind::kMaterial, "of the ceiling", "ceiling"},
                           kName};
constexpr std::array kStairs{place("from", "the middle of the lowest edge"),
                             place("to", "below the middle of the highest edge: direction and length"),
                             size("width", "1", "across"),
                             size("rise", "", "of all steps together").needed(),
                             whole("steps", "", "how many", 1, 1000).needed(),
                             material("stone"),
                             kName};
constexpr std::array kRamp{place("from", "the middle of one end, on top"),
                           place("to", "the middle of the other end, on top, higher or lower"),
                           size("width", "1", "across"),
                           size("thickness", "", "measured straight down [solid down to its lower end]"),
                           material("concrete"),
                           kName};
constexpr std::array kTerrain{
    place("at", "its south-west corner, at height 0"),
    ArgSpec{"size", ArgKind::kVector, "X,Y: how large it is"}.needed(),
    whole("cells", "16", "squares along x", 1, 1000),
    ArgSpec{"rows", ArgKind::kWhole, "squares along y [so many that they are nearly square]"}.within(1, 1000),
    ArgSpec{"function", ArgKind::kText, "height in metres as a formula in x and y, metres from the corner"},
    ArgSpec{"file", ArgKind::kFile,
            "instead: a grey PNG picture, north on top; relative to the map's folder"},
    ArgSpec{"low", ArgKind::kLength, "height where the picture is black", "0"}.within(-kLongest_m,
                                                                                      kLongest_m),
    ArgSpec{"high", ArgKind::kLength, "height where it is white", "1"}.within(-kLongest_m, kLongest_m),
    size("depth", "0.5", "how thick it is where it is lowest"),
    material("grass"),
    kName};
constexpr std::array kRemake{
    ArgSpec{"what", ArgKind::kWhat, "one shape, door or window"}.needed(),
    ArgSpec{"changes", ArgKind::kKeys,
            "arguments of its command with their new values; an empty value leaves one out"}
        .needed()};

using MakeParts = Parts (*)(const Edit& edit, const Arguments& arguments);

struct Maker {
  std::string_view command;
  MakeParts make;
};

constexpr std::array<Maker, 10> kMakers{{{"box", &box_parts},
                                         {"wedge", &wedge_parts},
                                         {"cylinder", &cylinder_parts},
                                         {"prism", &prism_parts},
                                         {"wall", &wall_parts},
                                         {"arc", &arc_parts},
                                         {"room", &room_parts},
                                         {"stairs", &stairs_parts},
                                         {"ramp", &ramp_parts},
                                         {"terrain", &terrain_parts}}};

const Maker* maker_of(std::string_view command) {
  const auto found = std::ranges::find(kMakers, command, &Maker::command);
  return found == kMakers.end() ? nullptr : &*found;
}

/// Whether all of a room lies inside of one other room: then it would be cut away whole.
bool is_inside_a_room(const State& state, const std::vector<map::Brush>& inside, const std::string& but_of) {
  return std::ranges::any_of(state.entities, [&](const auto& entity) {
    if (entity->classname() != "hw_subtract" || is_opening(*entity)) return false;
    if (!but_of.empty() && entity->value("_tb_group") == but_of) return false;
    return std::ranges::any_of(entity->brushes, [&](const BrushItem& cut) {
      return std::ranges::all_of(inside,
                                 [&](const map::Brush& brush) { return lies_within(brush, *cut.brush); });
    });
  });
}

/// The parts of a shape with their place among the cuts. A room is a cut itself: its block comes first, but in another room.
Parts parts_of(const Edit& edit, const Maker& maker, const Arguments& arguments, const std::string& group) {
  Parts parts = maker.make(edit, arguments);
  const bool is_room = !parts.subtracted.empty();
  if (!is_room || is_inside_a_room(edit.state, parts.subtracted, group))
    parts.added_order = order_among_cuts(edit.state, parts.added, group);
  if (is_room && parts.added_order != 0) parts.order = parts.added_order + 1;
  return parts;
}

/// For programs; it is what everybody expects of a shape that stands in a room.
void say_order(Edit& edit, int order) {
  if (order != 0) edit.report.data["order"] = order;
}

/// Says what of the map a room takes away that was there before it.
void say_cut_away(Edit& edit, const std::vector<map::Brush>& cuts, int order) {
  std::vector<std::string> names;
  const Box bounds = bounds_of(cuts);
  for (std::size_t e = 0; e < edit.state.entities.size(); ++e) {
    const EntityItem& entity = *edit.state.entities[e];
    const std::string_view name = entity.classname();
    const bool first = name == "worldspawn" || name == "func_group";
    if (!first && !(name == "hw_add" && order_of(entity) < order)) continue;
    for (std::size_t b = 0; b < entity.brushes.size(); ++b) {
      if (!any_overlaps(cuts, bounds, *entity.brushes[b].brush)) continue;
      names.push_back(describe(edit.state, name == "worldspawn" ? Thing{e, b} : Thing{e, {}}));
      if (name != "worldspawn") break;
    }
  }
  if (!names.empty()) edit.report.say("its inside cuts away parts of " + listed(names, names.size()));
}

template <MakeParts kMake>
void make(Edit& edit, const Arguments& arguments) {
  const Maker& maker = *std::ranges::find(kMakers, kMake, &Maker::make);
  Parts parts = parts_of(edit, maker, arguments, {});
  const int order = parts.added_order;
  const auto cuts = parts.subtracted;
  if (!cuts.empty() && order == 0) say_cut_away(edit, cuts, parts.order);
  const Id id = add_shape(edit, arguments.text_or_empty("name"), made_line(edit, maker.command, arguments),
                          std::move(parts));
  say_made(edit, {id});
  say_order(edit, order);
}

/// How much longer a wall must be to fill the corner with another one that ends at the same place, metres.
double corner_of(const Edit& edit, const Vec3& end) {
  double more = 0.0;
  for (const auto& entity : edit.state.entities) {
    const auto call = made_call(edit.state, *entity);
    if (!call || call->command->name != "wall") continue;
    for (const char* name : {"from", "to"}) {
      constexpr double kSame_m = 1e-6;
      if ((call->arguments.place(name) - end).norm() < kSame_m)
        more = std::max(more, call->arguments.number("thickness") / 2.0);
    }
  }
  return more;
}

/// A wall is longer where another one ends: one of the two is enough. The line that made it says so in figures.
void make_wall(Edit& edit, const Arguments& arguments) {
  Arguments all = arguments;
  for (const auto& [more, end] : {std::pair("before", "from"), std::pair("behind", "to")}) {
    if (all.has(more)) continue;
    const double corner = corner_of(edit, edit.units(arguments.place(end)) * edit.metres_per_unit());
    if (corner > 0.0) all.set(more, corner);
  }
  make<&wall_parts>(edit, all);
}

/// The words of the line that made a thing, without those of the arguments for which `left_out` holds.
template <typename Test>
std::vector<std::string> words_without(const Edit& edit, const Call& call, Test&& left_out) {
  const Edit as_made = without_grid(edit.state, edit.file);
  std::vector<std::string> words;
  for (std::string& word : words_of(made_line(as_made, call.command->name, call.arguments))) {
    if (!left_out(std::string_view(word).substr(0, word.find('=')))) words.push_back(std::move(word));
  }
  return words;
}

/// The arguments that made a thing, with the changes that `remake` has. The name is there only if it changes.
Arguments changed_arguments(const Edit& edit, const Call& call, const Arguments& remake) {
  const auto& changes = remake.keys("changes");
  const auto is_changed = [&](std::string_view name) {
    return std::ranges::any_of(changes, [&](const auto& pair) { return pair.first == name; });
  };
  const auto& known = call.command->arguments;
  const auto is_known = [&](std::string_view name) { return call.command->argument(name) != nullptr; };
  if (is_known("in") && is_changed("in"))
    refuse("remake: a door or window stays in its wall; make it again in another");
  auto words =
      words_without(edit, call, [&](std::string_view name) { return is_changed(name) || name == "name"; });
  for (const auto& [name, value] : changes) {
    if (!value.empty() || !is_known(name)) words.push_back(name + "=" + value);
  }
  Arguments arguments = parse_words(words, units_of(edit.state)).arguments;
  for (const ArgSpec& spec : known) {
    if (spec.kind != ArgKind::kPlace || !is_changed(spec.name) || !arguments.has(spec.name)) continue;
    const Vec3 rounded = edit.metres_per_unit() * edit.units(arguments.place(spec.name));
    arguments.set(spec.name, rounded);
  }
  return arguments;
}

/// Gives a thing the name that the arguments have, or puts the one that it has into them.
void settle_name(Edit& edit, Id id, const char* key, Arguments& arguments) {
  const Thing thing = *find(edit.state, id);
  const std::string now = name_of(*edit.state.entities[thing.entity]);
  const std::string wanted = arguments.text_or_empty("name");
  if (!wanted.empty() && wanted != now) {
    check_new_name(edit.state, wanted);
    set_key(edit.state, thing.entity, key, wanted);
  } else if (!now.empty()) {
    arguments.set("name", now);
  }
}

void remake_opening(Edit& edit, Id id, const Call& call, const Arguments& remake) {
  Arguments arguments = changed_arguments(edit, call, remake);
  settle_name(edit, id, "targetname", arguments);
  recut_opening(edit, id, call.command->name, arguments);
}

void remake_shape(Edit& edit, Id id, const Call& call, const Arguments& remake) {
  const Maker& maker = *maker_of(call.command->name);
  const std::string group = *group_number(*edit.state.entities[find(edit.state, id)->entity]);
  Arguments arguments = changed_arguments(edit, call, remake);
  settle_name(edit, id, "_tb_name", arguments);
  const double grid = std::exchange(edit.state.desk.grid_m, 0.0);  // the places are rounded already
  Parts parts = parts_of(edit, maker, arguments, group);
  const int order = parts.added_order;
  replace_shape(edit, id, std::move(parts));
  set_key(edit.state, find(edit.state, id)->entity, kMadeKey, made_line(edit, maker.command, arguments));
  recut_openings(edit, id);
  edit.state.desk.grid_m = grid;
  say_order(edit, order);
}

void remake(Edit& edit, const Arguments& arguments) {
  const Thing thing = resolve_one(edit.state, arguments.text("what"));
  const EntityItem& entity = *edit.state.entities[thing.entity];
  const Id id = entity.id;
  const auto cannot = [&](const char* why) { refuse("remake: {} {}", describe(edit.state, thing), why); };
  if (thing.brush) cannot("is a brush, which does not know what made it; shapes with a name do");
  if (entity.head->find(kMadeKey) == nullptr)
    cannot("does not know what made it: it was made by hand, or changed in another way since");
  const auto call = made_call(edit.state, entity);
  if (!call) cannot("cannot be remade: its key _hw_made is no command");
  if (is_opening(entity)) {
    remake_opening(edit, id, *call, arguments);
  } else if (maker_of(call->command->name) != nullptr && group_number(entity)) {
    remake_shape(edit, id, *call, arguments);
  } else {
    cannot("cannot be remade: its key _hw_made is no command that makes a shape");
  }
  say_changed(edit, {*find(edit.state, id)});
}

constexpr std::array kShapesCommands{
    CommandSpec{.name = "box",
                .summary = "a block, by two corners or by its middle and size",
                .details =
                    "A shape in a room, a door, a window or anything else that is cut out is added after "
                    "that cut, so that it is there.",
                .arguments = kBox,
                .example = "box from 0,0 to 1,2,0.5 material=wood name=table",
                .run = &make<&box_parts>},
    CommandSpec{.name = "wedge",
                .summary = "a block that is cut in half, so that its top slopes",
                .arguments = kWedge,
                .example = "wedge from 0,0 to 2,1,0.5 high=east",
                .run = &make<&wedge_parts>},
    CommandSpec{.name = "cylinder",
                .summary = "a round pillar or pipe",
                .arguments = kCylinder,
                .example = "cylinder at 3,2 radius 0.3 height 2.7 sides=12",
                .run = &make<&cylinder_parts>},
    CommandSpec{
        .name = "prism",
        .summary = "a block on any polygon, also a concave one",
        .details = "A polygon with inward corners becomes several brushes, which together are the block.",
        .arguments = kPrism,
        .example = "prism 0,0;4,0;4,1;1,1;1,3;0,3 height 0.9 name=counter",
        .run = &make<&prism_parts>},
    CommandSpec{.name = "wall",
                .summary = "a straight wall",
                .arguments = kWall,
                .example = "wall from 0,0 to 6,0 height 2.7 thickness 0.15 name=north",
                .run = &make_wall},
    CommandSpec{.name = "arc",
                .summary = "a curved wall",
                .details = "Its stretches are chords of the circle. Where the two angles are alike it goes "
                           "all the way round.",
                .arguments = kArc,
                .example = "arc centre=0,0 radius=3 from=0 to=90 segments=6 name=bay",
                .run = &make<&arc_parts>},
    CommandSpec{.name = "room",
                .summary = "a room: floor, walls and ceiling around an inside",
                .details = "It is a block and an `hw_subtract` of the inside. Rooms whose distance is the "
                           "thickness of a wall share it; a room inside of another one keeps its walls. "
                           "What stood there before is cut away; shapes that are made in it afterwards stay.",
                .arguments = kRoom,
                .example = "room from 0,0 to 5,4 height=2.5 wall=0.2 floor_material=wood name=kitchen",
                .run = &make<&room_parts>},
    CommandSpec{.name = "stairs",
                .summary = "a flight of steps, solid down to the floor",
                .arguments = kStairs,
                .example = "stairs from 0,0 to 3,0 width=1.2 rise=1.8 steps=10",
                .run = &make<&stairs_parts>},
    CommandSpec{.name = "ramp",
                .summary = "a slope from one height to another",
                .arguments = kRamp,
                .example = "ramp from 0,0,0 to 4,0,0.6 width=1.5",
                .run = &make<&ramp_parts>},
    CommandSpec{.name = "terrain",
                .summary = "ground with heights from a formula or a picture",
                .details = "Each square is two triangles, and each triangle a column down to the foot. "
                           "Formulas know + - * / ^, "
                           "`a ? b : c`, pi, and functions such as sin, cos, sqrt, abs, exp, ln, min, max.",
                .arguments = kTerrain,
                .example = "terrain at=0,0 size=8,6 cells=8 function=\"0.3*sin(x) * cos(y)\" name=garden",
                .run = &make<&terrain_parts>},
    CommandSpec{.name = "remake",
                .summary = "make a shape, door or window again with other measures",
                .details = "It keeps its number and name, and its doors and windows are cut again "
                           "where they were along it.",
                .arguments = kRemake,
                .example = "remake north height=3 thickness=0.2",
                .before = "wall from 0,0 to 6,0 name=north\ndoor in north at 2",
                .run = &remake},
};

}  // namespace

std::span<const CommandSpec> shape_commands() {
  return kShapesCommands;
}

}  // namespace hallway::editor
