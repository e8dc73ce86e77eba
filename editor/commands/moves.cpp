// SPDX-License-Identifier: MIT
//
// Moving, turning, copying.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "base/error.hpp"
#include "base/text.hpp"
#include "editor/clipboard.hpp"
#include "editor/commands/common_arguments.hpp"
#include "editor/commands/making.hpp"
#include "editor/commands/topics.hpp"
#include "editor/made_line.hpp"
#include "editor/selection.hpp"
#include "editor/shapes.hpp"
#include "editor/transform.hpp"

namespace hallway::editor {
namespace {

constexpr ArgSpec kBy{.name = "by", .kind = ArgKind::kVector, .help = "how far, along the axes"};
constexpr ArgSpec kTo{.name = "to",
                      .kind = ArgKind::kPlace,
                      .help = "where the lowest corner of what they occupy goes, instead of `by`"};

constexpr std::array kMove{kThings, kBy, kTo};
constexpr std::array kRotate{kThings,
                             ArgSpec{.name = "by",
                                     .kind = ArgKind::kAngle,
                                     .required = true,
                                     .help = "counter-clockwise",
                                     .low = -36000,
                                     .high = 36000},
                             ArgSpec{.name = "about",
                                     .kind = ArgKind::kPlace,
                                     .help = "a place on the axis [the middle of what they occupy]"},
                             ArgSpec{.name = "axis",
                                     .kind = ArgKind::kChoice,
                                     .fallback = "z",
                                     .help = "which way the axis runs",
                                     .choices = "x y z"}};
constexpr std::array kScale{kThings,
                            ArgSpec{.name = "by",
                                    .kind = ArgKind::kFactors,
                                    .required = true,
                                    .help = "how many times as large",
                                    .low = 1e-3,
                                    .high = 1e3},
                            ArgSpec{.name = "about",
                                    .kind = ArgKind::kPlace,
                                    .help = "the place that stays [the middle of their bottom]"}};
constexpr std::array kMirror{
    kThings,
    ArgSpec{.name = "axis",
            .kind = ArgKind::kChoice,
            .required = true,
            .help = "the axis that is reversed",
            .choices = "x y z"},
    ArgSpec{
        .name = "at", .kind = ArgKind::kLength, .help = "where on that axis the mirror is [their middle]"}};
constexpr std::array kAlign{
    kThings,
    ArgSpec{.name = "side",
            .kind = ArgKind::kChoice,
            .required = true,
            .help = "what of each: left and right are along x, front and back along y",
            .choices = "left right front back bottom top centre"},
    ArgSpec{.name = "to",
            .kind = ArgKind::kWhat,
            .required = true,
            .help = "the same side of these things, or a place"},
    ArgSpec{.name = "edge",
            .kind = ArgKind::kChoice,
            .help = "another side of them, such as `top` to put on [the same]",
            .choices = "left right front back bottom top centre"}};
constexpr std::array kSnap{kThings, ArgSpec{.name = "size",
                                            .kind = ArgKind::kLength,
                                            .help = "the grid [that of `grid`]",
                                            .low = 1e-6,
                                            .high = 1e3}};
constexpr std::array kArray{
    kThings,
    ArgSpec{.name = "kind",
            .kind = ArgKind::kChoice,
            .required = true,
            .help = "in a row or in a circle",
            .choices = "linear circular"},
    ArgSpec{.name = "count",
            .kind = ArgKind::kWhole,
            .required = true,
            .help = "how many there are in the end",
            .low = 2,
            .high = 1000},
    ArgSpec{.name = "by", .kind = ArgKind::kVector, .help = "linear: from one to the next"},
    ArgSpec{.name = "about", .kind = ArgKind::kPlace, .help = "circular: the centre, the axis being z"},
    ArgSpec{.name = "through",
            .kind = ArgKind::kAngle,
            .help = "circular: from the first to the last [360, all round]",
            .low = -360,
            .high = 360}};
constexpr std::array kDuplicate{
    kThings,
    ArgSpec{
        .name = "by", .kind = ArgKind::kVector, .required = true, .help = "from the things to their copies"}};
constexpr std::array kWhat{kThings};
constexpr std::array kPaste{kBy, kTo};

int axis_of(const std::string& text) {
  return text == "x" ? 0 : text == "y" ? 1 : 2;
}

double degrees(double angle) {
  return std::round(angle * 180.0 / std::numbers::pi * 1e9) / 1e9;
}

/// The things, and the panes and leaves of the openings among them, which stay with their openings.
std::vector<Thing> resolve_with_fills(const State& state, const std::string& what) {
  std::vector<Thing> things = resolve(state, what);
  add_fills(state, things);
  return things;
}

/// What things occupy with all that belongs to them.
Box bounds_together(const State& state, const std::vector<Thing>& things) {
  Box box;
  for (const Thing& thing : with_members(state, things)) {
    if (const Box part = bounds_of(state, thing); !part.isEmpty()) box.extend(part);
  }
  return box;
}

Box bounds_needed(const State& state, const std::vector<Thing>& things, const char* command) {
  const Box box = bounds_together(state, things);
  if (box.isEmpty())
    throw Error(ErrorCode::kUsage,
                fmt::format("{}: that has no place: neither brushes nor an origin", command));
  return box;
}

std::vector<Thing> things_with(const State& state, const std::vector<Id>& ids) {
  std::vector<Thing> things;
  const std::set<Id> wanted(ids.begin(), ids.end());
  for (std::size_t e = 0; e < state.entities.size(); ++e) {
    const EntityItem& entity = *state.entities[e];
    if (wanted.contains(entity.id)) things.push_back({e, {}});
    for (std::size_t b = 0; b < entity.brushes.size(); ++b) {
      if (wanted.contains(entity.brushes[b].id)) things.push_back({e, b});
    }
  }
  return things;
}

/// The way that `by` or `to` asks for; none where neither is given.
Vec3 way_of(const Edit& edit, const Arguments& arguments, const std::vector<Thing>& things,
            const char* command) {
  if (arguments.has("by") && arguments.has("to"))
    throw Error(ErrorCode::kUsage, fmt::format("{}: either `by` or `to`, not both", command));
  if (arguments.has("by")) return way_units(edit, arguments.place("by"));
  if (!arguments.has("to")) return Vec3::Zero();
  return edit.units(arguments.place("to")) - bounds_needed(edit.state, things, command).min();
}

void move(Edit& edit, const Arguments& arguments) {
  const auto things = resolve_with_fills(edit.state, arguments.text("what"));
  if (!arguments.has("by") && !arguments.has("to"))
    throw Error(ErrorCode::kUsage, "move: `by` (how far) or `to` (a place) is missing");
  bounds_needed(edit.state, things, "move");
  transform_things(edit, things, move_by(way_of(edit, arguments, things, "move")));
  say_changed(edit, things);
}

void rotate(Edit& edit, const Arguments& arguments) {
  const auto things = resolve_with_fills(edit.state, arguments.text("what"));
  const Box box = bounds_needed(edit.state, things, "rotate");
  const Vec3 centre = arguments.has("about") ? edit.units(arguments.place("about")) : Vec3(box.center());
  transform_things(edit, things,
                   turn_about(centre, axis_of(arguments.text("axis")), degrees(arguments.number("by"))));
  say_changed(edit, things);
}

void scale(Edit& edit, const Arguments& arguments) {
  const auto things = resolve_with_fills(edit.state, arguments.text("what"));
  const Box box = bounds_needed(edit.state, things, "scale");
  Vec3 centre = box.center();
  centre.z() = box.min().z();
  if (arguments.has("about")) centre = edit.units(arguments.place("about"));
  transform_things(edit, things, scale_about(centre, arguments.place("by")));
  say_changed(edit, things);
}

void mirror(Edit& edit, const Arguments& arguments) {
  const auto things = resolve_with_fills(edit.state, arguments.text("what"));
  const Box box = bounds_needed(edit.state, things, "mirror");
  const int axis = axis_of(arguments.text("axis"));
  double at = box.center()[axis];
  if (arguments.has("at")) at = edit.units(Vec3::Constant(arguments.number("at")))[axis];
  transform_things(edit, things, mirror_at(axis, at));
  say_changed(edit, things);
}

// ---- Aligning and snapping --------------------------------------------------------------------------------------------

/// How far along each axis a side of a box must move to be where a side of another is.
Vec3 way_between(const Box& from, const std::string& side, const Box& to, const std::string& edge) {
  if ((side == "centre") != (edge == "centre"))
    throw Error(ErrorCode::kUsage, "align: a centre is aligned to a centre");
  if (side == "centre") {
    Vec3 way = to.center() - from.center();
    way.z() = 0.0;
    return way;
  }
  const auto axis = [](const std::string& one) {
    return one == "left" || one == "right" ? 0 : one == "front" || one == "back" ? 1 : 2;
  };
  const auto place = [&](const Box& box, const std::string& one) {
    const bool low = one == "left" || one == "front" || one == "bottom";
    return (low ? box.min() : box.max())[axis(one)];
  };
  if (axis(side) != axis(edge))
    throw Error(ErrorCode::kUsage, fmt::format("align: {} and {} are not along the same axis", side, edge));
  Vec3 way = Vec3::Zero();
  way[axis(side)] = place(to, edge) - place(from, side);
  return way;
}

void align(Edit& edit, const Arguments& arguments) {
  const auto things = resolve(edit.state, arguments.text("what"));
  const std::string& to = arguments.text("to");
  const std::string& side = arguments.text("side");
  const std::string edge = arguments.has("edge") ? arguments.text("edge") : side;
  Box target;
  if (to.find(',') != std::string::npos && to.find('=') == std::string::npos) {
    constexpr ArgSpec kTarget{.name = "to", .kind = ArgKind::kPlace};
    target.extend(edit.units(std::get<Vec3>(read_value(kTarget, to, units_of(edit.state)))));
  } else {
    target = bounds_needed(edit.state, resolve(edit.state, to), "align");
  }
  for (const Thing& thing : things) {
    const Box bounds = bounds_needed(edit.state, {thing}, "align");
    std::vector<Thing> moved{thing};
    add_fills(edit.state, moved);
    transform_things(edit, moved, move_by(way_between(bounds, side, target, edge)));
  }
  say_changed(edit, things);
}

/// The axis that a plane is across, or -1.
Eigen::Index axis_across(const Plane& plane) {
  Eigen::Index axis = 0;
  return plane.normal.cwiseAbs().maxCoeff(&axis) > 1.0 - 1e-9 ? axis : -1;
}

bool is_box(const map::Brush& brush) {
  return brush.faces.size() == 6 && body_of(brush) &&
         std::all_of(brush.faces.begin(), brush.faces.end(), [](const map::Face& face) {
           const auto plane = plane_of(face);
           return plane && axis_across(*plane) >= 0;
         });
}

double on_grid(double x, double grid) {
  return std::round(std::round(x / grid) * grid * 1e7) / 1e7 + 0.0;
}

/// An upright box with its corners on the grid. A point of a face that is no corner moves across its face only.
map::Brush snapped(const map::Brush& brush, double grid) {
  const Box box = bounds_of(brush);
  map::Brush result = brush;
  for (map::Face& face : result.faces) {
    const Eigen::Index across = axis_across(*plane_of(face));
    for (Vec3& point : face.points) {
      const bool corner =
          ((point - box.min()).cwiseAbs().cwiseMin((point - box.max()).cwiseAbs())).maxCoeff() < 1e-6;
      for (Eigen::Index i = 0; i < 3; ++i) {
        if (corner || i == across) point[i] = on_grid(point[i], grid);
      }
    }
  }
  if (!is_box(result))
    throw Error(ErrorCode::kUsage,
                "snap: a box is too thin for this grid and would be no body; a finer one keeps it");
  return result;
}

void snap(Edit& edit, const Arguments& arguments) {
  const auto meant = resolve(edit.state, arguments.text("what"));
  const double size = arguments.has("size") ? arguments.number("size") : edit.state.desk.grid_m;
  if (size <= 0.0)
    throw Error(ErrorCode::kUsage, "snap: there is no grid; `grid 0.1` sets one, or give `size`");
  const double grid = size / edit.metres_per_unit();
  const auto things = with_members(edit.state, meant);
  std::size_t snapped_things = 0, left = 0;
  std::set<std::size_t> changed;
  change_brushes(edit.state, things,
                 [&](const EntityItem&, const map::Brush& brush) -> std::optional<map::Brush> {
                   if (!is_box(brush)) return ++left, std::nullopt;
                   ++snapped_things;
                   return snapped(brush, grid);
                 });
  for (const Thing& thing : things) {
    const auto origin = thing.brush ? std::nullopt : origin_of(*edit.state.entities[thing.entity]);
    if (!origin) continue;
    ++snapped_things;
    const Vec3 place(on_grid(origin->x(), grid), on_grid(origin->y(), grid), on_grid(origin->z(), grid));
    set_key(edit.state, thing.entity, "origin", vector_text(place));
  }
  if (snapped_things == 0)
    throw Error(ErrorCode::kUsage,
                "snap: that has neither upright boxes nor an origin; other shapes have no corners to spare");
  forget_made(edit.state, things);
  if (left > 0)
    edit.report.lines.push_back(fmt::format("note: {} brush{} no upright box and stay{} as it is", left,
                                            left == 1 ? " is" : "es are", left == 1 ? "s" : ""));
  edit.report.data["left"] = left;
  say_changed(edit, meant);
}

// ---- Copies ---------------------------------------------------------------------------------------------------------

void say_copies(Edit& edit, const Copies& copies) {
  for (const std::string& note : copies.notes) {
    edit.report.lines.push_back("note: " + note);
    edit.report.data["notes"].push_back(note);
  }
  // A group stands for its members.
  std::vector<Id> ids;
  std::set<Thing> members;
  const auto made = things_with(edit.state, copies.ids);
  for (const Thing& thing : made) {
    if (thing.brush) continue;
    for (const Thing& member : with_members(edit.state, {thing})) {
      if (member != thing) members.insert(member);
    }
  }
  for (const Thing& thing : made) {
    if (!members.contains(thing)) ids.push_back(id_of(edit.state, thing));
  }
  say_made(edit, ids);
}

void duplicate(Edit& edit, const Arguments& arguments) {
  const auto things = resolve_with_fills(edit.state, arguments.text("what"));
  bounds_needed(edit.state, things, "duplicate");
  const Copies copies = add_copies(edit, edit.state, things);
  transform_things(edit, things_with(edit.state, copies.ids),
                   move_by(way_units(edit, arguments.place("by"))));
  say_copies(edit, copies);
}

/// The way from the original to a copy of an array.
Transform step_of(const Edit& edit, const Arguments& arguments, std::int64_t step) {
  const auto times = static_cast<double>(step);
  if (arguments.text("kind") == "linear") return move_by(way_units(edit, times * arguments.place("by")));
  const double through = arguments.has("through") ? degrees(arguments.number("through")) : 360.0;
  const bool all_round = std::abs(through) == 360.0;
  const auto steps = static_cast<double>(all_round ? arguments.whole("count") : arguments.whole("count") - 1);
  return turn_about(edit.units(arguments.place("about")), 2, through * times / steps);
}

void check_array(const Arguments& arguments) {
  const bool linear = arguments.text("kind") == "linear";
  const bool other = linear ? arguments.has("about") || arguments.has("through") : arguments.has("by");
  if (linear && (!arguments.has("by") || other))
    throw Error(ErrorCode::kUsage,
                "array: a linear one takes `by`, the way from one to the next, and nothing else");
  if (!linear && (!arguments.has("about") || other))
    throw Error(ErrorCode::kUsage, "array: a circular one takes `about`, its centre, and may take `through`");
}

void array(Edit& edit, const Arguments& arguments) {
  constexpr std::size_t kMostMade = 1'000'000;
  check_array(arguments);
  const auto things = resolve_with_fills(edit.state, arguments.text("what"));
  bounds_needed(edit.state, things, "array");
  const auto count = arguments.whole("count");
  if (with_members(edit.state, things).size() * static_cast<std::size_t>(count) > kMostMade)
    throw Error(ErrorCode::kUsage, fmt::format("array: that makes more than {} things", kMostMade));
  std::vector<Id> originals;
  for (const Thing& thing : things) originals.push_back(id_of(edit.state, thing));
  Copies all;
  for (std::int64_t step = 1; step < count; ++step) {
    const Copies copies = add_copies(edit, edit.state, things_with(edit.state, originals));
    transform_things(edit, things_with(edit.state, copies.ids), step_of(edit, arguments, step));
    all.ids.insert(all.ids.end(), copies.ids.begin(), copies.ids.end());
    all.notes = copies.notes;
  }
  say_copies(edit, all);
}

void copy_to_clipboard(Edit& edit, const Arguments& arguments) {
  const auto things = resolve_with_fills(edit.state, arguments.text("what"));
  write_clipboard(edit, clipboard_text(edit, things));
  edit.report.data["copied"] = things.size();
  edit.report.lines.push_back(
      fmt::format("{} thing{} in the clipboard", things.size(), things.size() == 1 ? "" : "s"));
}

void cut_to_clipboard(Edit& edit, const Arguments& arguments) {
  auto things = with_members(edit.state, resolve(edit.state, arguments.text("what")));
  add_fills(edit.state, things);
  for (const Thing& thing : things) {
    if (!thing.brush && edit.state.entities[thing.entity]->classname() == "worldspawn")
      throw Error(ErrorCode::kUsage, "cut: worldspawn stays; `cut all` takes its brushes");
  }
  write_clipboard(edit, clipboard_text(edit, things));
  say_removed(edit, things);
  forget_made(edit.state, things);
  remove(edit.state, things);
}

void paste(Edit& edit, const Arguments& arguments) {
  const State source = read_clipboard(edit);
  worldspawn(edit.state);
  const Copies copies = add_copies(edit, source, all_things(source));
  const double from = units_of(source).metres_per_unit, to = edit.metres_per_unit();
  const auto made = things_with(edit.state, copies.ids);
  if (from != to) transform_things(edit, made, change_units(from, to));
  transform_things(edit, made, move_by(way_of(edit, arguments, made, "paste")));
  say_copies(edit, copies);
}

constexpr std::string_view kMovesTopic = "moving and copying";
constexpr std::string_view kTable = "box from 0,0 to 2,1,1 name=table";

constexpr std::array kMovesCommands{
    CommandSpec{.name = "move",
                .topic = kMovesTopic,
                .summary = "move things, by so much or to a place",
                .details = "Textures stay where they are on the faces, here and with all that follows. "
                           "Groups move with their members, "
                           "paths with their waypoints.",
                .arguments = kMove,
                .example = "move table by 1,0,0",
                .before = kTable,
                .run = &move},
    CommandSpec{.name = "rotate",
                .topic = kMovesTopic,
                .summary = "turn things about an axis",
                .details = "Quarter turns are exact. What has a heading is turned too.",
                .arguments = kRotate,
                .example = "rotate table by 90 about 0,0",
                .before = kTable,
                .run = &rotate},
    CommandSpec{.name = "scale",
                .topic = kMovesTopic,
                .summary = "make things larger or smaller",
                .details = "Textures are scaled with them. Lengths of paths and clouds follow where all "
                           "factors are the same.",
                .arguments = kScale,
                .example = "scale table by 1,1,0.5",
                .before = kTable,
                .run = &scale},
    CommandSpec{.name = "mirror",
                .topic = kMovesTopic,
                .summary = "mirror things at a plane across an axis",
                .arguments = kMirror,
                .example = "mirror table x at 3",
                .before = kTable,
                .run = &mirror},
    CommandSpec{.name = "align",
                .topic = kMovesTopic,
                .summary = "move things until one side is level with something",
                .details = "Each thing by itself, a group as one. `centre` is the middle in x and y.",
                .arguments = kAlign,
                .example = "align lamp bottom to table edge=top",
                .before = "box from 0,0 to 2,1,1 name=table\nlight 1,0.5,2 name=lamp",
                .run = &align},
    CommandSpec{
        .name = "snap",
        .topic = kMovesTopic,
        .summary = "put corners of upright boxes, and origins, on the grid",
        .details = "Other shapes stay as they are. A box that would have no thickness left is refused.",
        .arguments = kSnap,
        .example = "snap table size=0.25",
        .before = kTable,
        .run = &snap},
    CommandSpec{.name = "array",
                .topic = kMovesTopic,
                .summary = "repeat things in a row or in a circle",
                .details = "All round, the copies are spread evenly; through less, the last is at the "
                           "end. Copies are turned with the circle.",
                .arguments = kArray,
                .example = "array table linear 4 by 2.5,0",
                .before = kTable,
                .run = &array},
    CommandSpec{.name = "duplicate",
                .topic = kMovesTopic,
                .summary = "copy things to another place",
                .details = "Names of copies get a number behind: `table` becomes `table-2`. What refers to "
                           "each other within what is copied keeps doing so.",
                .arguments = kDuplicate,
                .example = "duplicate table by 0,2",
                .before = kTable,
                .run = &duplicate},
    CommandSpec{.name = "copy",
                .topic = kMovesTopic,
                .summary = "put copies of things into the clipboard",
                .details = "The clipboard is a file in the map format, for all maps and shells of a user: "
                           "`hallway/clipboard.map` in $XDG_CACHE_HOME, or else in "
                           "~/.cache.",
                .arguments = kWhat,
                .example = "copy table",
                .before = kTable,
                .run = &copy_to_clipboard},
    CommandSpec{.name = "cut",
                .topic = kMovesTopic,
                .summary = "take things out of the map into the clipboard",
                .arguments = kWhat,
                .example = "cut table",
                .before = kTable,
                .run = &cut_to_clipboard},
    CommandSpec{.name = "paste",
                .topic = kMovesTopic,
                .summary = "put what is in the clipboard into the map",
                .details = "Where it was in its map, unless `by` or `to` says otherwise. Maps of other units "
                           "get it in the same size.",
                .arguments = kPaste,
                .example = "paste by 0,2",
                .before = "box from 0,0 to 2,1,1 name=table\ncopy table",
                .run = &paste},
};

}  // namespace

std::span<const CommandSpec> moves_commands() {
  return kMovesCommands;
}

}  // namespace hallway::editor
