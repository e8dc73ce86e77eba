// SPDX-License-Identifier: MIT
#include "editor/patch.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "base/error.hpp"
#include "editor/item_text.hpp"

namespace hallway::editor {
namespace {

using Json = nlohmann::ordered_json;
using EntityPointer = std::shared_ptr<const EntityItem>;

Id id_of(const EntityPointer& entity) {
  return entity->id;
}
Id id_of(const BrushItem& brush) {
  return brush.id;
}

/// Whether two items are one value.
bool same(const BrushItem& a, const BrushItem& b) {
  return a.id == b.id && a.brush == b.brush;
}
/// Entities that stay are compared within.
bool same(const EntityPointer& a, const EntityPointer& b) {
  return a->id == b->id;
}

/// Items that both lists have stay where the order allows it: one pass that takes what is new and drops what is gone. Lists in
/// another order are replaced from the first difference to the last.
template <typename Item>
std::vector<Splice<Item>> splices(const std::vector<Item>& before, const std::vector<Item>& after) {
  std::vector<Splice<Item>> result;
  std::size_t head = 0;
  while (head < before.size() && head < after.size() && same(before[head], after[head])) ++head;
  std::size_t tail = 0;
  while (tail < before.size() - head && tail < after.size() - head &&
         same(before[before.size() - 1 - tail], after[after.size() - 1 - tail]))
    ++tail;
  if (head + tail == before.size() && head + tail == after.size()) return result;
  const std::size_t end_before = before.size() - tail, end_after = after.size() - tail;
  std::unordered_map<Id, std::size_t> old;  // only asked, never walked through
  for (std::size_t i = head; i < end_before; ++i) old.emplace(id_of(before[i]), i);
  std::size_t i = head;
  Splice<Item> open{head, {}, {}};
  const auto close = [&](std::size_t next) {
    if (!open.before.empty() || !open.after.empty()) result.push_back(std::move(open));
    open = {next, {}, {}};
  };
  for (std::size_t j = head; j < end_after; ++j) {
    const auto found = old.find(id_of(after[j]));
    if (found == old.end() || found->second < i || !same(before[found->second], after[j])) {
      open.after.push_back(after[j]);
      if (found != old.end() && found->second >= i) {  // changed in place: all up to it goes
        for (; i <= found->second; ++i) open.before.push_back(before[i]);
      }
      continue;
    }
    for (; i < found->second; ++i) open.before.push_back(before[i]);
    ++i;
    close(i);
  }
  for (; i < end_before; ++i) open.before.push_back(before[i]);
  close(i);
  return result;
}

template <typename Item>
void apply_splices(std::vector<Item>& list, const std::vector<Splice<Item>>& changes) {
  std::vector<Item> result;
  std::size_t next = 0;
  for (const Splice<Item>& change : changes) {
    if (change.at < next || change.at + change.before.size() > list.size()) {
      throw Error(ErrorCode::kInternal, "a change does not fit the map: its place is not there");
    }
    for (; next < change.at; ++next) result.push_back(list[next]);
    for (const Item& gone : change.before) {
      if (id_of(list[next++]) != id_of(gone)) {
        throw Error(ErrorCode::kInternal, "a change does not fit the map: something else is in its place");
      }
    }
    result.insert(result.end(), change.after.begin(), change.after.end());
  }
  result.insert(result.end(), list.begin() + static_cast<std::ptrdiff_t>(next), list.end());
  list = std::move(result);
}

template <typename Item>
std::vector<Splice<Item>> inverse_of(const std::vector<Splice<Item>>& changes) {
  std::vector<Splice<Item>> result;
  std::size_t added = 0, removed = 0;
  for (const Splice<Item>& change : changes) {
    result.push_back({change.at + added - removed, change.after, change.before});
    added += change.after.size();
    removed += change.before.size();
  }
  return result;
}

Json json_of(const BrushItem& brush) {
  return {{"id", brush.id}, {"text", text_of(*brush.brush)}};
}

Json json_of(const EntityPointer& entity) {
  Json brushes = Json::array();
  for (const BrushItem& brush : entity->brushes) brushes.push_back(json_of(brush));
  return {{"id", entity->id}, {"text", text_of(*entity->head)}, {"brushes", std::move(brushes)}};
}

void read(const Json& json, BrushItem& out) {
  out.id = whole_number(json.at("id"));
  out.brush = std::make_shared<const map::Brush>(brush_of(json.at("text").get<std::string>()));
}

void read(const Json& json, EntityPointer& out) {
  auto entity = std::make_shared<EntityItem>();
  entity->id = whole_number(json.at("id"));
  entity->head = std::make_shared<const map::Entity>(head_of(json.at("text").get<std::string>()));
  for (const Json& brush : json.at("brushes")) read(brush, entity->brushes.emplace_back());
  out = std::move(entity);
}

template <typename Item>
Json json_of(const std::vector<Item>& items) {
  Json list = Json::array();
  for (const Item& item : items) list.push_back(json_of(item));
  return list;
}

template <typename Item>
Json json_of(const std::vector<Splice<Item>>& changes) {
  Json list = Json::array();
  for (const Splice<Item>& change : changes) {
    list.push_back({{"at", change.at}, {"before", json_of(change.before)}, {"after", json_of(change.after)}});
  }
  return list;
}

template <typename Item>
void read(const Json& json, std::vector<Splice<Item>>& out) {
  for (const Json& entry : json) {
    Splice<Item>& change = out.emplace_back();
    change.at = whole_number(entry.at("at"));
    for (const Json& item : entry.at("before")) read(item, change.before.emplace_back());
    for (const Json& item : entry.at("after")) read(item, change.after.emplace_back());
  }
}

Json json_of(const Desk& desk) {
  return {{"selection", desk.selection}, {"hidden", desk.hidden}, {"grid_m", desk.grid_m}};
}

std::vector<Id> ids_of(const Json& json) {
  std::vector<Id> ids;
  for (const Json& id : json) ids.push_back(whole_number(id));
  return ids;
}

Desk desk_of(const Json& json) {
  return {ids_of(json.at("selection")), ids_of(json.at("hidden")), json.at("grid_m").get<double>()};
}

}  // namespace

std::uint64_t whole_number(const Json& json) {
  if (json.is_number_unsigned()) return json.get<std::uint64_t>();
  throw Error(ErrorCode::kBadInput, "a record has something else where a whole number should stand");
}

Patch difference(const State& before, const State& after) {
  Patch patch;
  patch.next_id = {before.next_id, after.next_id};
  patch.entities = splices(before.entities, after.entities);
  std::unordered_set<Id> replaced;  // only asked
  for (const auto& change : patch.entities) {
    for (const EntityPointer& entity : change.before) replaced.insert(entity->id);
  }
  std::unordered_map<Id, const EntityItem*> old;  // only asked
  for (const EntityPointer& entity : before.entities) old.emplace(entity->id, entity.get());
  for (const EntityPointer& entity : after.entities) {
    const auto found = old.find(entity->id);
    if (found == old.end() || found->second == entity.get() || replaced.contains(entity->id)) continue;
    EntityChange change{.id = entity->id};
    if (found->second->head != entity->head) {
      change.head_before = found->second->head;
      change.head_after = entity->head;
    }
    change.brushes = splices(found->second->brushes, entity->brushes);
    if (change.head_after || !change.brushes.empty()) patch.changes.push_back(std::move(change));
  }
  if (before.closing_comments != after.closing_comments) {
    patch.closing_comments = {before.closing_comments, after.closing_comments};
  }
  if (before.desk != after.desk) patch.desk = {before.desk, after.desk};
  return patch;
}

Patch inverse(const Patch& patch) {
  Patch back;
  back.entities = inverse_of(patch.entities);
  for (const EntityChange& change : patch.changes) {
    back.changes.push_back({change.id, change.head_after, change.head_before, inverse_of(change.brushes)});
  }
  if (patch.closing_comments) {
    back.closing_comments = {patch.closing_comments->second, patch.closing_comments->first};
  }
  if (patch.desk) back.desk = {patch.desk->second, patch.desk->first};
  back.next_id = {patch.next_id.second, patch.next_id.second};
  return back;
}

void apply(State& state, const Patch& patch) {
  apply_splices(state.entities, patch.entities);
  std::unordered_map<Id, std::size_t> places;  // only asked
  if (!patch.changes.empty()) {
    for (std::size_t e = 0; e < state.entities.size(); ++e) places.emplace(state.entities[e]->id, e);
  }
  for (const EntityChange& change : patch.changes) {
    const auto place = places.find(change.id);
    if (place == places.end()) {
      throw Error(ErrorCode::kInternal, "a change does not fit the map: its entity is not there");
    }
    EntityPointer& entity = state.entities[place->second];
    auto copy = std::make_shared<EntityItem>(*entity);
    if (change.head_after) copy->head = change.head_after;
    apply_splices(copy->brushes, change.brushes);
    entity = std::move(copy);
  }
  if (patch.closing_comments) state.closing_comments = patch.closing_comments->second;
  if (patch.desk) state.desk = patch.desk->second;
  state.next_id = std::max(state.next_id, patch.next_id.second);
}

Json to_json(const Patch& patch) {
  Json json = {{"next_id", {patch.next_id.first, patch.next_id.second}}};
  if (!patch.entities.empty()) json["entities"] = json_of(patch.entities);
  for (const EntityChange& change : patch.changes) {
    Json entry = {{"id", change.id}};
    if (change.head_after)
      entry["head"] = {{"before", text_of(*change.head_before)}, {"after", text_of(*change.head_after)}};
    if (!change.brushes.empty()) entry["brushes"] = json_of(change.brushes);
    json["changes"].push_back(std::move(entry));
  }
  if (patch.closing_comments) {
    json["closing_comments"] = {{"before", patch.closing_comments->first},
                                {"after", patch.closing_comments->second}};
  }
  if (patch.desk)
    json["desk"] = {{"before", json_of(patch.desk->first)}, {"after", json_of(patch.desk->second)}};
  return json;
}

Patch patch_from_json(const Json& json) {
  try {
    Patch patch;
    patch.next_id = {whole_number(json.at("next_id").at(0)), whole_number(json.at("next_id").at(1))};
    if (json.contains("entities")) read(json["entities"], patch.entities);
    for (const Json& entry : json.value("changes", Json::array())) {
      EntityChange& change = patch.changes.emplace_back();
      change.id = whole_number(entry.at("id"));
      if (entry.contains("head")) {
        const auto head = [&](const char* side) {
          return std::make_shared<const map::Entity>(
              head_of(entry["head"].at(side).template get<std::string>()));
        };
        change.head_before = head("before");
        change.head_after = head("after");
      }
      if (entry.contains("brushes")) read(entry["brushes"], change.brushes);
    }
    if (json.contains("closing_comments")) {
      const Json& comments = json["closing_comments"];
      patch.closing_comments = {comments.at("before").get<std::vector<std::string>>(),
                                comments.at("after").get<std::vector<std::string>>()};
    }
    if (json.contains("desk"))
      patch.desk = {desk_of(json["desk"].at("before")), desk_of(json["desk"].at("after"))};
    return patch;
  } catch (const Json::exception& fault) {
    throw Error(ErrorCode::kBadInput, std::string("a change cannot be read: ") + fault.what());
  }
}

}  // namespace hallway::editor
