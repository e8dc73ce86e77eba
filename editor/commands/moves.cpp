// SPDX-License-Identifier: MIT
//
// Moving, turning, copying.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>

#include "base/refuse.hpp"
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

constexpr ArgSpec kBy{"by", ArgKind::kVector, "how far, along the axes"};
constexpr ArgSpec kTo{"to", ArgKind::kPlace,
                      "where the lowest corner of what they occupy goes, instead of `by`"};

constexpr std::array kMove{kThings, kBy, kTo};
constexpr std::array kRotate{
    kThings, ArgSpec{"by", ArgKind::kAngle, "counter-clockwise"}.needed().within(-36000, 36000),
    ArgSpec{"about", ArgKind::kPlace, "a place on the axis [the middle of what they occupy]"},
    ArgSpec{"axis", ArgKind::kChoice, "which way the axis runs", "z", "x y z"}};
constexpr std::array kScale{
    kThings, ArgSpec{"by", ArgKind::kFactors, "how many times as large"}.needed().within(1e-3, 1e3),
    ArgSpec{"about", ArgKind::kPlace, "the place that stays [the middle of their bottom]"}};
constexpr std::array kMirror{
    kThings, ArgSpec{"axis", ArgKind::kChoice, "the axis that is reversed", "", "x y z"}.needed(),
    ArgSpec{"at", ArgKind::kLength, "where on that axis the mirror is [their middle]"}};
constexpr std::array kAlign{
    kThings,
    ArgSpec{"side", ArgKind::kChoice, "what of each: left and right are along x, front and back along y", "",
            "left right front back bottom top centre"}
        .needed(),
    ArgSpec{"to", ArgKind::kWhat, "the same side of these things, or a place"}.needed(),
    ArgSpec{"edge", ArgKind::kChoice, "another side of them, such as `top` to put on [the same]", "",
            "left right front back bottom top centre"}};
constexpr std::array kSnap{kThings,
                           ArgSpec{"size", ArgKind::kLength, "the grid [that of `grid`]"}.within(1e-6, 1e3)};
constexpr std::array kArray{
    kThings,
    ArgSpec{"kind", ArgKind::kChoice, "in a row or in a circle", "", "linear circular"}.needed(),
    ArgSpec{"count", ArgKind::kWhole, "how many there are in the end"}.needed().within(2, 1000),
    ArgSpec{"by", ArgKind::kVector, "linear: from one to the next"},
    ArgSpec{"about", ArgKind::kPlace, "circular: the centre, the axis being z"},
    ArgSpec{"through", ArgKind::kAngle, "circular: from the first to the last [360, all round]"}.within(-360,
                                                                                                        360)};
constexpr std::array kDuplicate{kThings,
                                ArgSpec{"by", ArgKind::kVector, "from the things to their copies"}.needed()};
constexpr std::array kWhat{kThings};
constexpr std::array kPaste{kBy, kTo};

/// The things, and the panes and leaves of the openings among them, which stay with their openings.
std::vector<Thing> resolve_with_fills(const State& state, const std::string& what) {
  std::vector<Thing> things = resolve(state, what);
  add_fills(state, things);
  return things;
}

Box bounds_needed(const State& state, const std::vector<Thing>& things, const char* command) {
  const Box box = bounds_together(state, things);
  if (box.isEmpty()) refuse("{}: that has no place: neither brushes nor an origin", command);
  return box;
}

/// The way that `by` or `to` asks for; none where neither is given.
Vec3 way_of(const Edit& edit, const Arguments& arguments, const std::vector<Thing>& things,
            const char* command) {
  if (arguments.has("by") && arguments.has("to")) refuse("{}: either `by` or `to`, not both", command);
  if (arguments.has("by")) return way_units(edit, arguments.place("by"));
  if (!arguments.has("to")) return Vec3::Zero();
  return edit.units(arguments.place("to")) - bounds_needed(edit.state, things, command).min();
}

void move(Edit& edit, const Arguments& arguments) {
  const auto things = resolve_with_fills(edit.state, arguments.text("what"));
  if (!arguments.has("by") && !arguments.has("to"))
    refuse("move: `by` (how far) or `to` (a place) is missing");
  bounds_needed(edit.state, things, "move");
  transform_things(edit, things, move_by(way_of(edit, arguments, things, "move")));
  say_changed(edit, things);
}

/// Transforms things as `transform_of` says by what they occupy.
void transform_meant(Edit& edit, const Arguments& arguments, const char* command,
                     const std::function<Transform(const Box& box)>& transform_of) {
  const auto things = resolve_with_fills(edit.state, arguments.text("what"));
  transform_things(edit, things, transform_of(bounds_needed(edit.state, things, command)));
  say_changed(edit, things);
}

void rotate(Edit& edit, const Arguments& arguments) {
  transform_meant(edit, arguments, "rotate", [&](const Box& box) {
    const Vec3 centre = arguments.has("about") ? edit.units(arguments.place("about")) : Vec3(box.center());
    return turn_about(centre, axis_of(arguments.text("axis")), degrees(arguments.number("by")));
  });
}

void scale(Edit& edit, const Arguments& arguments) {
  transform_meant(edit, arguments, "scale", [&](const Box& box) {
    Vec3 centre = box.center();
    centre.z() = box.min().z();
    if (arguments.has("about")) centre = edit.units(arguments.place("about"));
    return scale_about(centre, arguments.place("by"));
  });
}

void mirror(Edit& edit, const Arguments& arguments) {
  transform_meant(edit, arguments, "mirror", [&](const Box& box) {
    const int axis = axis_of(arguments.text("axis"));
    double at = box.center()[axis];
    if (arguments.has("at")) at = edit.units(Vec3::Constant(arguments.number("at")))[axis];
    return mirror_at(axis, at);
  });
}

// ---- Aligning and snapping --------------------------------------------------------------------------------------------

/// How far along each axis a side of a box must move to be where a side of another is.
Vec3 way_between(const Box& from, const std::string& side, const Box& to, const std::string& edge) {
  if ((side == "centre") != (edge == "centre")) refuse("align: a centre is aligned to a centre");
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
  if (axis(side) != axis(edge)) refuse("align: {} and {} are not along the same axis", side, edge);
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
    constexpr ArgSpec kTarget{"to", ArgKind::kPlace};
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
         std::ranges::all_of(brush.faces, [](const map::Face& face) {
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
    refuse("snap: a box is too thin for this grid and would be no body; a finer one keeps it");
  return result;
}

void snap(Edit& edit, const Arguments& arguments) {
  const auto meant = resolve(edit.state, arguments.text("what"));
  const double size = arguments.has("size") ? arguments.number("size") : edit.state.desk.grid_m;
  if (size <= 0.0) refuse("snap: there is no grid; `grid 0.1` sets one, or give `size`");
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
    refuse("snap: that has neither upright boxes nor an origin; other shapes have no corners to spare");
  forget_made(edit.state, things);
  if (left > 0)
    edit.report.say("note: {} brush{} no upright box and stay{} as it is", left, left == 1 ? " is" : "es are",
                    left == 1 ? "s" : "");
  edit.report.data["left"] = left;
  say_changed(edit, meant);
}

// ---- Copies ---------------------------------------------------------------------------------------------------------

void say_copies(Edit& edit, const Copies& copies) {
  for (const std::string& note : copies.notes) edit.report.note(note);
  // A group stands for its members.
  std::vector<Id> ids;
  std::set<Thing> members;
  const auto made = things_of(edit.state, copies.ids);
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
  transform_things(edit, things_of(edit.state, copies.ids), move_by(way_units(edit, arguments.place("by"))));
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
    refuse("array: a linear one takes `by`, the way from one to the next, and nothing else");
  if (!linear && (!arguments.has("about") || other))
    refuse("array: a circular one takes `about`, its centre, and may take `through`");
}

void array(Edit& edit, const Arguments& arguments) {
  constexpr std::size_t kMostMade = 1'000'000;
  check_array(arguments);
  const auto things = resolve_with_fills(edit.state, arguments.text("what"));
  bounds_needed(edit.state, things, "array");
  const auto count = arguments.whole("count");
  if (with_members(edit.state, things).size() * static_cast<std::size_t>(count) > kMostMade)
    refuse("array: that makes more than {} things", kMostMade);
  std::vector<Id> originals;
  for (const Thing& thing : things) originals.push_back(id_of(edit.state, thing));
  Copies all;
  for (std::int64_t step = 1; step < count; ++step) {
    const Copies copies = add_copies(edit, edit.state, things_of(edit.state, originals));
    transform_things(edit, things_of(edit.state, copies.ids), step_of(edit, arguments, step));
    all.ids.insert(all.ids.end(), copies.ids.begin(), copies.ids.end());
    all.notes = copies.notes;
  }
  say_copies(edit, all);
}

void copy_to_clipboard(Edit& edit, const Arguments& arguments) {
  const auto things = resolve_with_fills(edit.state, arguments.text("what"));
  write_clipboard(edit, clipboard_text(edit, things));
  edit.report.data["copied"] = things.size();
  edit.report.say("{} thing{} in the clipboard", things.size(), things.size() == 1 ? "" : "s");
}

void cut_to_clipboard(Edit& edit, const Arguments& arguments) {
  auto things = with_members(edit.state, resolve(edit.state, arguments.text("what")));
  add_fills(edit.state, things);
  for (const Thing& thing : things) {
    if (!thing.brush && edit.state.entities[thing.entity]->is_world())
      refuse("cut: worldspawn stays; `cut all` takes its brushes");
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
  const auto made = things_of(edit.state, copies.ids);
  if (from != to) transform_things(edit, made, change_units(from, to));
  transform_things(edit, made, move_by(way_of(edit, arguments, made, "paste")));
  say_copies(edit, copies);
}

constexpr std::string_view kTable = "box from 0,0 to 2,1,1 name=table";

constexpr std::array kMovesCommands{
    CommandSpec{.name = "move",
                .summary = "move things, by so much or to a place",
                .details = "Textures stay where they are on the faces, here and with all that follows. "
                           "Groups move with their members, "
                           "paths with their waypoints.",
                .arguments = kMove,
                .example = "move table by 1,0,0",
                .before = kTable,
                .run = &move},
    CommandSpec{.name = "rotate",
                .summary = "turn things about an axis",
                .details = "Quarter turns are exact. What has a heading is turned too.",
                .arguments = kRotate,
                .example = "rotate table by 90 about 0,0",
                .before = kTable,
                .run = &rotate},
    CommandSpec{.name = "scale",
                .summary = "make things larger or smaller",
                .details = "Textures are scaled with them. Lengths of paths and clouds follow where all "
                           "factors are the same.",
                .arguments = kScale,
                .example = "scale table by 1,1,0.5",
                .before = kTable,
                .run = &scale},
    CommandSpec{.name = "mirror",
                .summary = "mirror things at a plane across an axis",
                .arguments = kMirror,
                .example = "mirror table x at 3",
                .before = kTable,
                .run = &mirror},
    CommandSpec{.name = "align",
                .summary = "move things until one side is level with something",
                .details = "Each thing by itself, a group as one. `centre` is the middle in x and y.",
                .arguments = kAlign,
                .example = "align lamp bottom to table edge=top",
                .before = "box from 0,0 to 2,1,1 name=table\nlight 1,0.5,2 name=lamp",
                .run = &align},
    CommandSpec{
        .name = "snap",
        .summary = "put corners of upright boxes, and origins, on the grid",
        .details = "Other shapes stay as they are. A box that would have no thickness left is refused.",
        .arguments = kSnap,
        .example = "snap table size=0.25",
        .before = kTable,
        .run = &snap},
    CommandSpec{.name = "array",
                .summary = "repeat things in a row or in a circle",
                .details = "All round, the copies are spread evenly; through less, the last is at the "
                           "end. Copies are turned with the circle.",
                .arguments = kArray,
                .example = "array table linear 4 by 2.5,0",
                .before = kTable,
                .run = &array},
    CommandSpec{.name = "duplicate",
                .summary = "copy things to another place",
                .details = "Names of copies get a number behind: `table` becomes `table-2`. What refers to "
                           "each other within what is copied keeps doing so.",
                .arguments = kDuplicate,
                .example = "duplicate table by 0,2",
                .before = kTable,
                .run = &duplicate},
    CommandSpec{.name = "copy",
                .summary = "put copies of things into the clipboard",
                .details = "The clipboard is a file in the map format, for all maps and shells of a user: "
                           "`hallway/clipboard.map` in $XDG_CACHE_HOME, or else in "
                           "~/.cache.",
                .arguments = kWhat,
                .example = "copy table",
                .before = kTable,
                .run = &copy_to_clipboard},
    CommandSpec{.name = "cut",
                .summary = "take things out of the map into the clipboard",
                .arguments = kWhat,
                .example = "cut table",
                .before = kTable,
                .run = &cut_to_clipboard},
    CommandSpec{.name = "paste",
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
