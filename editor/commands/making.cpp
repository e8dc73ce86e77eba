// SPDX-License-Identifier: MIT
#include "editor/commands/making.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
#include "editor/shapes.hpp"

namespace hallway::editor {
namespace {

constexpr std::size_t kMostNamed = 8;  ///< things that a line names one by one

void say(Edit& edit, const char* verb, const std::vector<Thing>& things) {
  std::vector<Id> ids;
  std::string line = verb;
  for (std::size_t i = 0; i < things.size(); ++i) {
    ids.push_back(id_of(edit.state, things[i]));
    if (i < kMostNamed) line += (i == 0 ? " " : ", ") + describe(edit.state, things[i]);
  }
  if (things.size() > kMostNamed) line += fmt::format(" and {} more", things.size() - kMostNamed);
  edit.report.data[verb] = ids;
  edit.report.lines.push_back(line);
}

/// Marks a member of a group as a part of the group's shape.
constexpr const char* kPart = "_hw_part";

map::Entity part_entity(const char* classname, int order, const std::string& number,
                        std::vector<map::Brush> brushes) {
  map::Entity part;
  part.keys = {{{}, "classname", classname, 0}, {{}, "order", std::to_string(order), 0}};
  if (!number.empty()) {
    part.keys.push_back({{}, "_tb_group", number, 0});
    part.keys.push_back({{}, kPart, "1", 0});
  }
  part.brushes = std::move(brushes);
  return part;
}

/// Puts brushes into the part of a class that a group has, makes one, or removes it.
void set_part(State& state, const std::string& number, const char* classname, int order,
              std::vector<map::Brush> brushes) {
  std::vector<Thing> gone;
  for (const std::size_t member : members_of(state, number)) {
    const EntityItem& entity = *state.entities[member];
    if (entity.classname() != classname || entity.head->find(kPart) == nullptr) continue;
    if (brushes.empty()) {
      gone.push_back({member, {}});
      continue;
    }
    set_brushes(state, member, std::move(brushes));
    set_key(state, member, "order", std::to_string(order));
    return;
  }
  remove(state, gone);
  if (!brushes.empty()) add_entity(state, part_entity(classname, order, number, std::move(brushes)));
}

std::string group_key(const EntityItem& entity) {
  const std::string* group = entity.head->find("_tb_group");
  return group != nullptr ? *group : std::string();
}

bool is_filled_by(const EntityItem& opening, const EntityItem& fill) {
  if (group_key(opening) != group_key(fill)) return false;
  return std::any_of(opening.brushes.begin(), opening.brushes.end(), [&](const BrushItem& cut) {
    return std::any_of(fill.brushes.begin(), fill.brushes.end(),
                       [&](const BrushItem& part) { return overlap(*part.brush, *cut.brush); });
  });
}

}  // namespace

std::string vector_text(const Vec3& vector) {
  return format_double(vector.x()) + ' ' + format_double(vector.y()) + ' ' + format_double(vector.z());
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
  for (std::size_t e = 0; e < state.entities.size(); ++e) {
    if (state.entities[e]->classname() == "worldspawn") return e;
  }
  throw Error(ErrorCode::kUsage, "the map has no worldspawn; `new` begins one");
}

int next_group_number(const State& state) {
  int next = 1;
  for (const auto& entity : state.entities) {
    for (const char* key : {"_tb_id", "_tb_group", "_tb_layer"}) {
      const std::string* text = entity->head->find(key);
      const auto number = text != nullptr ? parse_int(*text) : std::nullopt;
      if (number && *number >= next && *number < 1'000'000'000) next = static_cast<int>(*number) + 1;
    }
  }
  return next;
}

void check_new_name(const State& state, const std::string& name) {
  for (std::size_t e = 0; !name.empty() && e < state.entities.size(); ++e) {
    if (name_of(*state.entities[e]) != name) continue;
    throw Error(ErrorCode::kUsage, fmt::format("name: {} has that name already", describe(state, {e, {}})));
  }
}

Id add_shape(Edit& edit, const std::string& name, const std::string& made, Parts parts) {
  check_new_name(edit.state, name);
  const std::size_t world = worldspawn(edit.state);
  const bool one_brush = parts.added.size() == 1 && parts.subtracted.empty();
  if (name.empty() && one_brush && !parts.remembered) {
    if (parts.added_order == 0) return add_brush(edit.state, world, std::move(parts.added.front()));
    return add_entity(edit.state, part_entity("hw_add", parts.added_order, {}, std::move(parts.added)));
  }
  const std::string number = std::to_string(next_group_number(edit.state));
  map::Entity group;
  group.keys = {{{}, "classname", "func_group", 0}, {{}, "_tb_type", "_tb_group", 0}};
  if (!name.empty()) group.keys.push_back({{}, "_tb_name", name, 0});
  group.keys.push_back({{}, "_tb_id", number, 0});
  if (!made.empty()) group.keys.push_back({{}, "_hw_made", made, 0});
  if (parts.added_order == 0) group.brushes = std::move(parts.added);
  const Id id = add_entity(edit.state, std::move(group));
  if (parts.added_order != 0 && !parts.added.empty())
    add_entity(edit.state, part_entity("hw_add", parts.added_order, number, std::move(parts.added)));
  if (!parts.subtracted.empty())
    add_entity(edit.state, part_entity("hw_subtract", parts.order, number, std::move(parts.subtracted)));
  return id;
}

void set_brushes(State& state, std::size_t entity, std::vector<map::Brush> brushes) {
  auto item = std::make_shared<EntityItem>(*state.entities[entity]);
  const std::size_t had = item->brushes.size();
  item->brushes.resize(brushes.size());
  for (std::size_t b = 0; b < brushes.size(); ++b) {
    if (b >= had) item->brushes[b].id = state.next_id++;
    item->brushes[b].brush = std::make_shared<const map::Brush>(std::move(brushes[b]));
  }
  state.entities[entity] = std::move(item);
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
  const std::string* text = entity.head->find("order");
  const auto order = text != nullptr ? parse_int(*text) : std::nullopt;
  return order ? static_cast<int>(std::clamp<std::int64_t>(*order, -1'000'000'000, 1'000'000'000)) : 0;
}

bool is_opening(const EntityItem& entity) {
  const std::string* made = entity.head->find("_hw_made");
  return entity.classname() == "hw_subtract" && made != nullptr &&
         (made->starts_with("door ") || made->starts_with("window "));
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

std::vector<std::size_t> fills_of(const State& state, std::size_t opening) {
  std::vector<std::size_t> fills;
  for (std::size_t e = 0; e < state.entities.size(); ++e) {
    if (is_fill(*state.entities[e]) && is_filled_by(*state.entities[opening], *state.entities[e]))
      fills.push_back(e);
  }
  return fills;
}

std::optional<std::size_t> opening_of(const State& state, std::size_t fill) {
  for (std::size_t e = 0; e < state.entities.size(); ++e) {
    if (is_filled(*state.entities[e]) && is_filled_by(*state.entities[e], *state.entities[fill])) return e;
  }
  return std::nullopt;
}

void add_fills(const State& state, std::vector<Thing>& things) {
  std::vector<Thing> fills;
  for (const Thing& thing : things) {
    if (thing.brush || !is_filled(*state.entities[thing.entity])) continue;
    for (const std::size_t fill : fills_of(state, thing.entity)) fills.push_back({fill, {}});
  }
  things.insert(things.end(), fills.begin(), fills.end());
  std::sort(things.begin(), things.end());
  things.erase(std::unique(things.begin(), things.end()), things.end());
}

std::vector<std::size_t> members_of(const State& state, const std::string& number) {
  std::vector<std::size_t> members;
  for (std::size_t e = 0; e < state.entities.size(); ++e) {
    const std::string* group = state.entities[e]->head->find("_tb_group");
    if (group != nullptr && *group == number) members.push_back(e);
  }
  return members;
}

Box bounds_of(const std::vector<map::Brush>& brushes) {
  Box all;
  for (const map::Brush& brush : brushes) {
    if (const Box box = bounds_of(brush); !box.isEmpty()) all.extend(box);
  }
  return all;
}

bool may_overlap(const Box& box, const map::Brush& brush) {
  if (box.isEmpty()) return false;
  constexpr double kTouching = 1e-6;  // map units
  return std::none_of(brush.faces.begin(), brush.faces.end(), [&](const map::Face& face) {
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

int order_among_cuts(const State& state, const std::vector<map::Brush>& brushes, const std::string& but_of) {
  const Box all = bounds_of(brushes);
  int order = 0;
  for (const auto& entity : state.entities) {
    if (entity->classname() != "hw_subtract" || order_of(*entity) < order) continue;
    const std::string* group = entity->head->find("_tb_group");
    if (!but_of.empty() && group != nullptr && *group == but_of) continue;
    const bool stands_in = std::any_of(entity->brushes.begin(), entity->brushes.end(), [&](const auto& cut) {
      return may_overlap(all, *cut.brush) &&
             std::any_of(brushes.begin(), brushes.end(),
                         [&](const map::Brush& brush) { return overlap(brush, *cut.brush); });
    });
    if (stands_in) order = order_of(*entity) + 1;
  }
  return order;
}

}  // namespace hallway::editor
