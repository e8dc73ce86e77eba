// SPDX-License-Identifier: MIT
#include "editor/commands/openings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "editor/commands/shape_parts.hpp"
#include "editor/made_line.hpp"
#include "editor/selection.hpp"
#include "editor/shapes.hpp"

namespace hallway::editor {
namespace {

constexpr double kTolerance = 1e-6;  ///< map units

/// A wall in which openings can be: where it runs, and how high it is.
struct Wall {
  std::vector<WallStretch> stretches{};
  double height = 0.0;
  std::string material{};
  std::string floor{};  ///< material of the floor in a door; empty: as the rest

  double length() const {
    double sum = 0.0;
    for (const WallStretch& stretch : stretches) sum += (stretch.to - stretch.from).norm();
    return sum;
  }
};

/// The side of a room's wall as a stretch from west to east, or from south to north.
WallStretch side_of(const Box& inside, const std::string& side, double thickness) {
  const Vec3 low = inside.min(), high = inside.max();
  const bool along_x = side == "north" || side == "south";
  const auto point = [&](double along, double across) {
    return along_x ? Vec3(along, across, low.z()) : Vec3(across, along, low.z());
  };
  const Eigen::Index a = along_x ? 0 : 1, b = along_x ? 1 : 0;
  const bool far = side == "north" || side == "east";
  const double inner = far ? high[b] : low[b];
  const double outer = tidied(point(0.0, far ? inner + thickness : inner - thickness))[b];
  const double least = std::min(inner, outer), most = std::max(inner, outer), middle = (inner + outer) / 2.0;
  WallStretch stretch{point(low[a], middle), point(high[a], middle), {}};
  stretch.outline = {point(low[a], least), point(high[a], least), point(high[a], most), point(low[a], most)};
  if (!along_x) std::ranges::reverse(stretch.outline);
  return stretch;
}

/// A wall by its shape alone: an upright block on a rectangle, which runs along its longer side, from west to east or
/// else from south to north.
std::optional<Wall> block_wall(const map::Brush& brush) {
  const auto body = body_of(brush);
  if (!body || body->sides.size() != 6 || body->vertices.size() != 8) return std::nullopt;
  const Box box = bounds_of(*body);
  for (const map::ConvexBody::Side& side : body->sides) {
    std::vector<Vec3> base;
    for (const std::uint32_t v : side.loop) base.push_back(tidied(body->vertices[v]));
    const bool at_foot = std::ranges::all_of(
        base, [&](const Vec3& corner) { return std::abs(corner.z() - box.min().z()) <= kTolerance; });
    if (!at_foot || base.size() != 4) continue;
    std::ranges::reverse(base);  // it is seen from below
    Vec3 one = base[1] - base[0], other = base[3] - base[0];
    if (std::abs(one.dot(other)) > kTolerance * one.norm() * other.norm()) return std::nullopt;
    if (other.norm() > one.norm()) {
      std::rotate(base.begin(), base.begin() + 1, base.end());
      one = base[1] - base[0];
    }
    if (one.x() < -kTolerance || (std::abs(one.x()) <= kTolerance && one.y() < 0.0))
      std::rotate(base.begin(), base.begin() + 2, base.end());
    Wall wall{.stretches = {},
              .height = box.sizes().z(),
              .material = brush.faces[side.plane].material,
              .floor = {}};
    wall.stretches.push_back({(base[0] + base[3]) / 2.0, (base[1] + base[2]) / 2.0, base});
    // The sides must be upright: then what is over the foot is as large as it.
    if (std::abs(volume_of(*body) - one.norm() * (base[3] - base[0]).norm() * wall.height) >
        1e-6 * volume_of(*body))
      return std::nullopt;
    return wall;
  }
  return std::nullopt;
}

/// The brushes of which a thing alone is made: those of an entity, or of a group with its members. None where something is cut out of
/// it but doors and windows.
std::vector<const map::Brush*> own_brushes(const State& state, const Thing& thing) {
  const EntityItem& entity = *state.entities[thing.entity];
  std::vector<const map::Brush*> brushes = brushes_of(state, thing);
  if (const auto number = group_number(entity); number && !thing.brush) {
    for (const Thing& member : members_of(state, *number)) {
      const EntityItem& part = *state.entities[member.entity];
      if (is_opening(part) || is_fill(part)) continue;
      if (part.classname() == "hw_subtract") return {};
      std::ranges::copy(brushes_of(state, member), std::back_inserter(brushes));
    }
  }
  return brushes;
}

Wall made_wall(const Edit& edit, const Call& call, const Arguments& opening) {
  const Edit as_made = without_grid(edit.state, edit.file);  // the line has its places rounded already
  const Arguments& made = call.arguments;
  Wall wall{.stretches = {},
            .height = made.number("height") / edit.metres_per_unit(),
            .material = made.text("material"),
            .floor = {}};
  if (call.command->name == "room") {
    if (!opening.has("side"))
      refuse("side: a room has four walls; say `side` north, east, south or west (north is y+)");
    wall.stretches.push_back(side_of(room_inside(as_made, made), opening.text("side"),
                                     made.number("wall") / edit.metres_per_unit()));
    wall.floor = made.text("floor_material");
    return wall;
  }
  if (call.command->name == "wall") {
    wall.stretches.push_back(wall_stretch(as_made, made));
  } else {
    wall.stretches = arc_stretches(as_made, made);
  }
  return wall;
}

Wall wall_of(const Edit& edit, const Thing& host, const Arguments& opening) {
  const State& state = edit.state;
  const EntityItem& entity = *state.entities[host.entity];
  const auto call = host.brush ? std::nullopt : made_call(state, entity);
  const std::string_view made = call ? call->command->name : std::string_view();
  if (made != "room" && opening.has("side"))
    refuse("side: {} is no room; `side` says which wall of a room", describe(state, host));
  if (made == "wall" || made == "arc" || made == "room") return made_wall(edit, *call, opening);
  const auto brushes = own_brushes(state, host);
  auto wall = brushes.size() == 1 ? block_wall(*brushes.front()) : std::nullopt;
  if (!wall) {
    refuse("in: {} is no wall: a `wall`, `arc` or `room` as it was made, or one upright block",
           describe(state, host));
  }
  return std::move(*wall);
}

/// To a tenth of a millimetre.
std::string length_text(double metres) {
  return format_double(std::round(metres * 1e4) / 1e4 + 0.0);
}

/// Where an opening is in its wall, map units.
struct Gap {
  double begin = 0.0;  ///< along the middle line
  double end = 0.0;
  double low = 0.0;  ///< over the foot of the wall
  double high = 0.0;
};

Gap gap_of(const Edit& edit, const Wall& wall, std::string_view command, const Arguments& arguments) {
  const double scale = edit.metres_per_unit();
  const double at = arguments.number("at");
  const double half = arguments.number("width") / 2.0;
  const double low = arguments.has("sill") ? arguments.number("sill") : 0.0;
  const double high = low + arguments.number("height");
  const double length = wall.length() * scale, height = wall.height * scale;
  constexpr double kSlack_m = 1e-9;
  if (at - half < -kSlack_m || at + half > length + kSlack_m) {
    refuse("{}: it reaches from {} m to {} m along a wall that is {} m long", command, length_text(at - half),
           length_text(at + half), length_text(length));
  }
  if (high > height + kSlack_m) {
    refuse("{}: it reaches {} m high in a wall that is {} m high", command, length_text(high),
           length_text(height));
  }
  return {(at - half) / scale, (at + half) / scale, low / scale, std::min(high / scale, wall.height)};
}

/// What of the wall is in the gap, a body for each stretch.
std::vector<map::Brush> cut_brushes(const Wall& wall, const Gap& gap, const std::string& material) {
  std::vector<map::Brush> brushes;
  double passed = 0.0;
  for (const WallStretch& stretch : wall.stretches) {
    const Vec3 way = stretch.to - stretch.from;
    const double length = way.norm();
    const Vec3 direction = way / length;
    const double begin = gap.begin - passed, end = gap.end - passed;
    passed += length;
    if (end <= kTolerance || begin >= length - kTolerance) continue;
    std::vector<Vec3> outline = stretch.outline;
    if (begin > kTolerance)
      outline = polygon_behind(outline, stretch.from + begin * direction, Vec3(-direction));
    if (end < length - kTolerance)
      outline = polygon_behind(outline, stretch.from + end * direction, direction);
    if (outline.size() < 3) continue;
    for (Vec3& corner : outline) {
      corner.z() = stretch.from.z() + gap.low;
      corner = tidied(corner);
    }
    brushes.push_back(extrusion(outline, (gap.high - gap.low) * Vec3::UnitZ(), material));
  }
  return brushes;
}

/// The place on the middle line of a wall, at its foot.
Vec3 place_along(const Wall& wall, double along) {
  double passed = 0.0;
  for (const WallStretch& stretch : wall.stretches) {
    const Vec3 way = stretch.to - stretch.from;
    if (along <= passed + way.norm() + kTolerance) return stretch.from + (along - passed) * way.normalized();
    passed += way.norm();
  }
  return wall.stretches.back().to;
}

/// The wall as thin as a pane, around its middle line.
Wall thinned(Wall wall, double thickness) {
  for (WallStretch& stretch : wall.stretches) {
    const Vec3 across = Vec3::UnitZ().cross(stretch.to - stretch.from).normalized();
    for (const double side : {0.5, -0.5})
      stretch.outline = polygon_behind(stretch.outline, stretch.from + side * thickness * across,
                                       side > 0.0 ? across : Vec3(-across));
  }
  return wall;
}

/// A leaf that hangs at the beginning of the gap, turned out of the wall.
map::Brush leaf_brush(const Wall& wall, const Gap& gap, double thickness, double open_rad,
                      const std::string& material) {
  const Vec3 hinge = place_along(wall, gap.begin), end = place_along(wall, gap.end);
  const Vec3 along = Eigen::AngleAxisd(open_rad, Vec3::UnitZ()) * (end - hinge);
  const Vec3 half = 0.5 * thickness * Vec3::UnitZ().cross(along).normalized();
  std::vector<Vec3> base{hinge - half, hinge + along - half, hinge + along + half, hinge + half};
  for (Vec3& corner : base) corner = tidied(corner + gap.low * Vec3::UnitZ());
  return extrusion(base, (gap.high - gap.low) * Vec3::UnitZ(), material);
}

/// The pane or leaf that the arguments ask for.
std::vector<map::Brush> fill_brushes(const Edit& edit, const Wall& wall, const Gap& gap,
                                     const Arguments& arguments) {
  constexpr double kPane_m = 0.02, kLeaf_m = 0.04;
  if (arguments.has("pane"))
    return cut_brushes(thinned(wall, kPane_m / edit.metres_per_unit()), gap, arguments.text("pane"));
  if (arguments.has("leaf")) {
    const double open = arguments.has("open") ? arguments.number("open") : 0.0;
    return {leaf_brush(wall, gap, kLeaf_m / edit.metres_per_unit(), open, arguments.text("leaf"))};
  }
  if (arguments.has("open")) refuse("open: the door has no leaf; `leaf` says of which material one is");
  return {};
}

/// One more than the highest order of what makes the wall.
int order_for(const State& state, const Thing& host) {
  const EntityItem& entity = *state.entities[host.entity];
  int order = host.brush || !group_number(entity) ? order_of(entity) : 0;
  if (const auto number = group_number(entity); number && !host.brush) {
    for (const Thing& member : members_of(state, *number)) {
      const EntityItem& part = *state.entities[member.entity];
      if (part.classname().starts_with("hw_") && !part.brushes.empty() && !is_opening(part) && !is_fill(part))
        order = std::max(order, order_of(part));
    }
  }
  return order + 1;
}

void check_free(const State& state, std::string_view command, const std::vector<map::Brush>& cuts, Id but) {
  const Box bounds = bounds_of(cuts);
  const auto overlapped = find_entity(state, [&](const EntityItem& entity) {
    return entity.id != but && is_opening(entity) &&
           std::ranges::any_of(entity.brushes, [&](const BrushItem& brush) {
             return any_overlaps(cuts, bounds, *brush.brush);
           });
  });
  if (overlapped) refuse("{}: it overlaps {}", command, describe(state, {*overlapped, {}}));
}

/// Says what is gone altogether because it stood where the opening is.
void say_vanished(Edit& edit, const std::vector<map::Brush>& cuts, const Thing& host) {
  const Box bounds = bounds_of(cuts);
  const int order = order_for(edit.state, host);
  std::vector<std::string> names;
  for (std::size_t e = 0; e < edit.state.entities.size(); ++e) {
    const EntityItem& entity = *edit.state.entities[e];
    const bool adds = entity.classname() == "worldspawn" || entity.classname() == "func_group" ||
                      entity.classname() == "hw_add" || entity.classname() == "hw_detail";
    if (!adds || e == host.entity || order_of(entity) >= order) continue;
    for (std::size_t b = 0; b < entity.brushes.size(); ++b) {
      const map::Brush& brush = *entity.brushes[b].brush;
      if (!may_overlap(bounds, brush)) continue;
      double left = volume_of(brush);
      for (const map::Brush& cut : cuts) {
        if (const auto common = intersection(brush, cut)) left -= volume_of(*common);
      }
      if (left < 1e-6 * volume_of(brush)) names.push_back(describe(edit.state, {e, b}));
    }
  }
  if (!names.empty())
    edit.report.say("it cuts away all of {}; what is put into the opening now stays", fmt::join(names, ", "));
}

void set_floor(std::vector<map::Brush>& cuts, const std::string& material) {
  for (map::Brush& cut : cuts) {
    for (map::Face& face : cut.faces) {
      const auto plane = plane_of(face);
      if (plane && plane->normal.z() < -0.5) face.material = material;
    }
  }
}

/// An opening: what is cut out, and what fills it. Both with their brushes and their place in the order.
struct OpeningParts {
  map::Entity cut{};
  map::Entity fill{};  ///< without brushes where there is none
};

OpeningParts opening_entities(const Edit& edit, std::string_view command, const Arguments& arguments,
                              const Thing& host, Id but) {
  const Wall wall = wall_of(edit, host, arguments);
  const Gap gap = gap_of(edit, wall, command, arguments);
  OpeningParts made;
  map::Entity& cut = made.cut;
  cut.brushes =
      cut_brushes(wall, gap, arguments.has("material") ? arguments.text("material") : wall.material);
  if (command == "door" && !arguments.has("material") && !wall.floor.empty())
    set_floor(cut.brushes, wall.floor);
  if (cut.brushes.empty()) refuse("{}: nothing of the wall is in it", command);
  check_free(edit.state, command, cut.brushes, but);
  cut.add("classname", "hw_subtract");
  const int order = order_for(edit.state, host);
  cut.add("order", std::to_string(order));
  made.fill.brushes = fill_brushes(edit, wall, gap, arguments);
  if (!made.fill.brushes.empty()) cut.add("_hw_opening", "1");
  const int among = order_among_cuts(edit.state, made.fill.brushes);
  made.fill.keys = {
      {"classname", "hw_add"}, {"order", std::to_string(std::max(order + 1, among))}, {"_hw_fill", "1"}};
  return made;
}

void add_fill(State& state, map::Entity fill, const std::string& group) {
  if (fill.brushes.empty()) return;
  if (!group.empty()) fill.add("_tb_group", group);
  add_entity(state, std::move(fill));
}

void remove_fills(State& state, Id opening) {
  remove(state, fills_of(state, find(state, opening)->entity));
}

Thing host_of(const State& state, const Thing& opening) {
  const std::string* number = state.entities[opening.entity]->head->find("_tb_group");
  const auto group = number != nullptr ? find_group(state, *number) : std::nullopt;
  if (group) return {*group, {}};
  refuse("{} belongs to no wall that has a name; make it again with `door` or `window`",
         describe(state, opening));
}

}  // namespace

Id cut_opening(Edit& edit, std::string_view command, const Arguments& arguments) {
  const std::string name = arguments.text_or_empty("name");
  check_new_name(edit.state, name);
  const Thing host = resolve_one(edit.state, arguments.text("in"));
  const std::string group = group_of(*edit.state.entities[host.entity]);
  OpeningParts made = opening_entities(edit, command, arguments, host, 0);
  map::Entity& cut = made.cut;
  if (!name.empty()) cut.add("targetname", name);
  if (!group.empty()) cut.add("_tb_group", group);
  cut.add("_hw_made", made_line(edit, command, arguments));
  say_vanished(edit, cut.brushes, host);
  const Id id = add_entity(edit.state, std::move(cut));
  add_fill(edit.state, std::move(made.fill), group);
  return id;
}

void recut_opening(Edit& edit, Id opening, std::string_view command, const Arguments& arguments) {
  remove_fills(edit.state, opening);
  const Thing thing = *find(edit.state, opening);
  const Thing host = host_of(edit.state, thing);
  OpeningParts made = opening_entities(edit, command, arguments, host, opening);
  map::Entity& cut = made.cut;
  set_key(edit.state, thing.entity, "order", *cut.find("order"));
  set_key(edit.state, thing.entity, "_hw_made", made_line(edit, command, arguments));
  set_brushes(edit.state, thing.entity, std::move(cut.brushes));
  add_fill(edit.state, std::move(made.fill), group_of(*edit.state.entities[host.entity]));
}

void recut_openings(Edit& edit, Id group) {
  const std::string number = *group_number(*edit.state.entities[find(edit.state, group)->entity]);
  std::vector<Id> openings;
  for (const Thing& member : members_of(edit.state, number)) {
    if (is_opening(*edit.state.entities[member.entity])) openings.push_back(id_of(edit.state, member));
  }
  // Each is checked against the others where they are to be: so they all leave before the first comes back.
  for (const Id id : openings) remove_fills(edit.state, id);
  for (const Id id : openings) set_brushes(edit.state, find(edit.state, id)->entity, {});
  for (const Id id : openings) {
    const Thing thing = *find(edit.state, id);
    const auto call = made_call(edit.state, *edit.state.entities[thing.entity]);
    if (!call)
      refuse("{} cannot be cut again: its key _hw_made does not say how", describe(edit.state, thing));
    try {
      recut_opening(edit, id, call->command->name, call->arguments);
    } catch (const Error& error) {
      refuse("{}, which is in it: {}", describe(edit.state, thing), error.what());
    }
  }
}

}  // namespace hallway::editor
