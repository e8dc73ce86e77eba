// SPDX-License-Identifier: MIT
#include "editor/commands/making.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/refuse.hpp"
#include "base/text.hpp"
#include "editor/shapes.hpp"

namespace hallway::editor {
namespace {

constexpr std::size_t kMostNamed = 8;  ///< things that a line names one by one

void say(Edit& edit, const char* verb, const std::vector<Thing>& things) {
  std::vector<Id> ids;
  std::vector<std::string> names;
  for (const Thing& thing : things) {
    ids.push_back(id_of(edit.state, thing));
    if (names.size() < kMostNamed) names.push_back(describe(edit.state, thing));
  }
  edit.report.data[verb] = ids;
  edit.report.say(names.empty() ? verb : fmt::format("{} {}", verb, listed(names, things.size())));
}

/// Marks a member of a group as a part of the group's shape.
constexpr const char* kPart = "_hw_part";

map::Entity part_entity(const char* classname, int order, const std::string& number,
                        std::vector<map::Brush> brushes) {
  map::Entity part;
  part.keys = {{"classname", classname}, {"order", std::to_string(order)}};
  if (!number.empty()) {
    part.add("_tb_group", number);
    part.add(kPart, "1");
  }
  part.brushes = std::move(brushes);
  return part;
}

/// Puts brushes into the part of a class that a group has, makes one, or removes it.
void set_part(State& state, const std::string& number, const char* classname, int order,
              std::vector<map::Brush> brushes) {
  std::vector<Thing> gone;
  for (const Thing& member : members_of(state, number)) {
    const EntityItem& entity = *state.entities[member.entity];
    if (entity.classname() != classname || entity.head->find(kPart) == nullptr) continue;
    if (brushes.empty()) {
      gone.push_back(member);
      continue;
    }
    set_brushes(state, member.entity, std::move(brushes));
    set_key(state, member.entity, "order", std::to_string(order));
    return;
  }
  remove(state, gone);
  if (!brushes.empty()) add_entity(state, part_entity(classname, order, number, std::move(brushes)));
}

bool is_filled_by(const EntityItem& opening, const EntityItem& fill) {
  if (opening.value("_tb_group") != fill.value("_tb_group")) return false;
  return std::ranges::any_of(opening.brushes, [&](const BrushItem& cut) {
    return std::ranges::any_of(fill.brushes,
                               [&](const BrushItem& part) { return overlap(*part.brush, *cut.brush); });
  });
}

}  // namespace

std::string listed(const std::vector<std::string>& names, std::size_t count) {
  const std::size_t named = std::min(names.size(), kMostNamed);
  return fmt::format("{}{}",
                     fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(named), ", "),
                     count > named ? fmt::format(" and {} more", count - named) : "");
}

std::string vector_text(const Vec3& vector) {
  return format_double(vector.x()) + ' ' + format_double(vector.y()) + ' ' + format_double(vector.z());
}

int axis_of(std::string_view choice) {
  return choice == "x" ? 0 : choice == "y" ? 1 : 2;
}

double degrees(double angle_rad) {
  return std::round(angle_rad * 180.0 / std::numbers::pi * 1e9) / 1e9;
}

void say_made(Edit& edit, const std::vector<Id>& ids) {
  std::vector<Thing> things;
  for (const Id id : ids) things.push_back(*find(edit.state, id));
  say(edit, "made", things);
}

void say_changed(Edit& edit, const std::vector<Thing>& things) {
  say(edit, "changed", things);
}

void say_removed(Edit& edit, const std::vector<Thing>& things) {
  say(edit, "removed", things);
}

std::size_t worldspawn(const State& state) {
  if (const auto world = find_entity(state, [](const EntityItem& entity) { return entity.is_world(); }))
    return *world;
  refuse("the map has no worldspawn; `new` begins one");
}

int next_group_number(const State& state) {
  int next = 1;
  for (const auto& entity : state.entities) {
    for (const char* key : {"_tb_id", "_tb_group", "_tb_layer"}) {
      const auto number = parse_int(entity->value(key));
      if (number && *number >= next && *number < 1'000'000'000) next = static_cast<int>(*number) + 1;
    }
  }
  return next;
}

void check_new_name(const State& state, const std::string& name) {
  if (name.empty()) return;
  const auto taken = find_entity(state, [&](const EntityItem& entity) { return name_of(entity) == name; });
  if (taken) refuse("name: {} has that name already", describe(state, {*taken, {}}));
}

map::Entity new_group(const State& state, const std::string& name) {
  map::Entity group;
  group.keys = {{"classname", "func_group"}, {"_tb_type", "_tb_group"}};
  if (!name.empty()) group.add("_tb_name", name);
  group.add("_tb_id", std::to_string(next_group_number(state)));
  return group;
}

Id add_shape(Edit& edit, const std::string& name, const std::string& made, Parts parts) {
  check_new_name(edit.state, name);
  const std::size_t world = worldspawn(edit.state);
  const bool one_brush = parts.added.size() == 1 && parts.subtracted.empty();
  if (name.empty() && one_brush && !parts.remembered) {
    if (parts.added_order == 0) return add_brush(edit.state, world, std::move(parts.added.front()));
    return add_entity(edit.state, part_entity("hw_add", parts.added_order, {}, std::move(parts.added)));
  }
  map::Entity group = new_group(edit.state, name);
  const std::string number = group.value("_tb_id");
  if (!made.empty()) group.add("_hw_made", made);
  if (parts.added_order == 0) group.brushes = std::move(parts.added);
  const Id id = add_entity(edit.state, std::move(group));
  if (parts.added_order != 0 && !parts.added.empty())
    add_entity(edit.state, part_entity("hw_add", parts.added_order, number, std::move(parts.added)));
  if (!parts.subtracted.empty())
    add_entity(edit.state, part_entity("hw_subtract", parts.order, number, std::move(parts.subtracted)));
  return id;
}

void set_brushes(State& state, std::size_t entity, std::vector<map::Brush> brushes) {
  std::vector<BrushItem>& items = own(state, entity).brushes;
  const std::size_t had = items.size();
  items.resize(brushes.size());
  for (std::size_t b = 0; b < brushes.size(); ++b) {
    if (b >= had) items[b].id = state.next_id++;
    items[b].brush = std::make_shared<const map::Brush>(std::move(brushes[b]));
  }
}

void replace_shape(Edit& edit, Id group, Parts parts) {
  const std::size_t entity = find(edit.state, group)->entity;
  const std::string number = *group_number(*edit.state.entities[entity]);
  const bool first = parts.added_order == 0;
  set_brushes(edit.state, entity, first ? std::move(parts.added) : std::vector<map::Brush>{});
  set_part(edit.state, number, "hw_add", parts.added_order,
           first ? std::vector<map::Brush>{} : std::move(parts.added));
  set_part(edit.state, number, "hw_subtract", parts.order, std::move(parts.subtracted));
}

int order_of(const EntityItem& entity) {
  const auto order = parse_int(entity.value("order"));
  return order ? static_cast<int>(std::clamp<std::int64_t>(*order, -1'000'000'000, 1'000'000'000)) : 0;
}

bool is_opening(const EntityItem& entity) {
  const std::string& made = entity.value("_hw_made");
  return entity.classname() == "hw_subtract" && (made.starts_with("door ") || made.starts_with("window "));
}

bool is_fill(const EntityItem& entity) {
  return entity.head->find("_hw_fill") != nullptr;
}

namespace {

/// Also one that was moved, which no command has made as it is.
bool is_filled(const EntityItem& entity) {
  return is_opening(entity) ||
         (entity.classname() == "hw_subtract" && entity.head->find("_hw_opening") != nullptr);
}

}  // namespace

std::vector<Thing> fills_of(const State& state, std::size_t opening) {
  return entities_where(state, [&](const EntityItem& entity) {
    return is_fill(entity) && is_filled_by(*state.entities[opening], entity);
  });
}

std::optional<std::size_t> opening_of(const State& state, std::size_t fill) {
  return find_entity(state, [&](const EntityItem& entity) {
    return is_filled(entity) && is_filled_by(entity, *state.entities[fill]);
  });
}

void add_fills(const State& state, std::vector<Thing>& things) {
  std::vector<Thing> fills;
  for (const Thing& thing : things) {
    if (thing.brush || !is_filled(*state.entities[thing.entity])) continue;
    std::ranges::copy(fills_of(state, thing.entity), std::back_inserter(fills));
  }
  things.insert(things.end(), fills.begin(), fills.end());
  std::ranges::sort(things);
  things.erase(std::unique(things.begin(), things.end()), things.end());
}

std::string group_of(const EntityItem& entity) {
  return group_number(entity).value_or(entity.value("_tb_group"));
}

std::vector<Thing> members_of(const State& state, const std::string& number) {
  return entities_where(state, [&](const EntityItem& entity) { return entity.has("_tb_group", number); });
}

Box bounds_of(const std::vector<map::Brush>& brushes) {
  Box all;
  for (const map::Brush& brush : brushes) all.extend(bounds_of(brush));
  return all;
}

bool may_overlap(const Box& box, const map::Brush& brush) {
  if (box.isEmpty()) return false;
  constexpr double kTouching = 1e-6;  // map units
  return std::ranges::none_of(brush.faces, [&](const map::Face& face) {
    const auto plane = plane_of(face);
    if (!plane) return false;
    const Vec3 deepest =
        (plane->normal.array() > 0.0).select(box.min(), box.max());  // the corner that is furthest behind
    return plane->distance(deepest) >= -kTouching;
  });
}

bool lies_within(const map::Brush& brush, const map::Brush& other) {
  constexpr double kTouching = 1e-6;  // map units
  const auto body = body_of(brush);
  return body && std::ranges::all_of(other.faces, [&](const map::Face& face) {
           const auto plane = plane_of(face);
           return plane && std::ranges::all_of(body->vertices, [&](const Vec3& corner) {
                    return plane->distance(corner) <= kTouching;
                  });
         });
}

bool overlap(const map::Brush& a, const map::Brush& b) {
  if (!may_overlap(bounds_of(a), b)) return false;
  constexpr double kThin = 1e-3;  // map units cubed; what rounding leaves between neighbours is no overlap
  const auto common = intersection(a, b);
  const auto body = common ? body_of(*common) : std::nullopt;
  return body && volume_of(*body) > kThin;
}

bool any_overlaps(const std::vector<map::Brush>& brushes, const Box& box, const map::Brush& other) {
  return may_overlap(box, other) &&
         std::ranges::any_of(brushes, [&](const map::Brush& brush) { return overlap(brush, other); });
}

int order_among_cuts(const State& state, const std::vector<map::Brush>& brushes, const std::string& but_of) {
  const Box all = bounds_of(brushes);
  int order = 0;
  for (const auto& entity : state.entities) {
    if (entity->classname() != "hw_subtract" || order_of(*entity) < order) continue;
    if (!but_of.empty() && entity->value("_tb_group") == but_of) continue;
    const bool stands_in = std::ranges::any_of(
        entity->brushes, [&](const BrushItem& cut) { return any_overlaps(brushes, all, *cut.brush); });
    if (stands_in) order = order_of(*entity) + 1;
  }
  return order;
}

}  // namespace hallway::editor
