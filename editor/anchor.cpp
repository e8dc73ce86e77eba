// SPDX-License-Identifier: MIT
#include "editor/anchor.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "base/refuse.hpp"
#include "base/text.hpp"
#include "editor/commands/shape_parts.hpp"
#include "editor/made_line.hpp"
#include "editor/selection.hpp"

namespace hallway::editor {
namespace {

constexpr std::array kAnchors{Anchor{"ne", "north-east corner at the foot; north is y+"},
                              Anchor{"nw", "north-west corner"},
                              Anchor{"se", "south-east corner"},
                              Anchor{"sw", "south-west corner"},
                              Anchor{"n", "middle of the north side"},
                              Anchor{"e", "middle of the east side"},
                              Anchor{"s", "middle of the south side"},
                              Anchor{"w", "middle of the west side"},
                              Anchor{"centre", "middle at the foot"},
                              Anchor{"top", "middle on top"},
                              Anchor{"start", "where a wall, an arc, stairs, a ramp or a path begins"},
                              Anchor{"end", "where that ends"}};

const Anchor* find_anchor(std::string_view name) {
  const auto found = std::ranges::find(kAnchors, name, &Anchor::name);
  return found == kAnchors.end() ? nullptr : &*found;
}

/// What a thing occupies with all that is in it, map units; of a room its inside.
Box extent_of(const State& state, const Thing& thing) {
  const auto call = thing.brush ? std::nullopt : made_call(state, *state.entities[thing.entity]);
  if (call && call->command->name == "room") {
    return room_inside(without_grid(state), call->arguments);
  }
  Box box;
  for (const Thing& part : with_members(state, {thing})) {
    if (!part.brush && state.entities[part.entity]->classname() == "hw_subtract" && part != thing) continue;
    box.extend(bounds_of(state, part));
  }
  return box;
}

/// Both ends of what has ends, map units.
std::optional<std::pair<Vec3, Vec3>> ends_of(const State& state, const Thing& thing) {
  const EntityItem& entity = *state.entities[thing.entity];
  if (thing.brush) return std::nullopt;
  if (entity.classname() == "hw_path") {
    std::vector<Vec3> places;
    for (const auto& [number, waypoint] : waypoints_of(state, name_of(entity))) {
      const auto origin = origin_of(*state.entities[waypoint]);
      if (number && origin) places.push_back(*origin);
    }
    if (places.empty()) return std::nullopt;
    return std::pair(places.front(), places.back());
  }
  const auto call = made_call(state, entity);
  if (!call) return std::nullopt;
  const std::string_view command = call->command->name;
  if (command == "arc") {
    const auto stretches = arc_stretches(without_grid(state), call->arguments);
    return std::pair(stretches.front().from, stretches.back().to);
  }
  if (command != "wall" && command != "stairs" && command != "ramp") return std::nullopt;
  const double scale = units_of(state).metres_per_unit;
  return std::pair(Vec3(call->arguments.place("from") / scale), Vec3(call->arguments.place("to") / scale));
}

Vec3 place_on(const Box& box, std::string_view anchor) {
  const auto has = [&](char c) { return anchor.find(c) != std::string_view::npos; };
  const Vec3 middle = box.center();
  if (anchor == "top") return {middle.x(), middle.y(), box.max().z()};
  if (anchor == "centre") return {middle.x(), middle.y(), box.min().z()};
  return {has('e')   ? box.max().x()
          : has('w') ? box.min().x()
                     : middle.x(),
          has('n')   ? box.max().y()
          : has('s') ? box.min().y()
                     : middle.y(),
          box.min().z()};
}

/// Splits at the first dot before which there is the name of a thing; at the last one if there is no such thing.
std::pair<std::string_view, std::string_view> split_name(const State& state, std::string_view text) {
  std::size_t dot = text.find('.');
  while (dot != std::string_view::npos && text.find('.', dot + 1) != std::string_view::npos) {
    const std::string_view name = text.substr(0, dot);
    if (find_entity(state, [&](const EntityItem& entity) { return name_of(entity) == name; })) break;
    dot = text.find('.', dot + 1);
  }
  if (dot == std::string_view::npos) return {text, {}};
  return {text.substr(0, dot), text.substr(dot + 1)};
}

}  // namespace

std::span<const Anchor> anchors() {
  return kAnchors;
}

std::string anchor_names() {
  return fmt::format("{}", fmt::join(names_in(kAnchors, &Anchor::name), ", "));
}

Vec3 anchor_place(const State& state, std::string_view text) {
  const auto [name, word] = split_name(state, text);
  const Thing thing = resolve_one(state, name);
  const Anchor* anchor = find_anchor(word);
  if (anchor == nullptr) {
    refuse("@{}: {}{}; there are {}", printable(name),
           word.empty() ? "an anchor is missing, as in `@" + printable(name) + ".ne`"
                        : "no anchor is called \"" + printable(word) + "\"",
           word.empty() ? "" : suggestion(word, names_in(kAnchors, &Anchor::name)), anchor_names());
  }
  const double scale = units_of(state).metres_per_unit;
  if (anchor->name == "start" || anchor->name == "end") {
    const auto ends = ends_of(state, thing);
    if (!ends)
      refuse("@{}: {} has no {}; walls, arcs, stairs, ramps and paths do", printable(text),
             describe(state, thing), anchor->name);
    return (anchor->name == "start" ? ends->first : ends->second) * scale;
  }
  const Box box = extent_of(state, thing);
  if (box.isEmpty())
    refuse("@{}: {} has neither brushes nor an origin", printable(text), describe(state, thing));
  return place_on(box, anchor->name) * scale;
}

}  // namespace hallway::editor
