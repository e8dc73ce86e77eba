// SPDX-License-Identifier: MIT
#include "editor/state.hpp"

#include <algorithm>
#include <utility>

namespace hallway::editor {

map::Entity without_brushes(const map::Entity& entity) {
  map::Entity head;
  head.comments = entity.comments;
  head.keys = entity.keys;
  head.closing_comments = entity.closing_comments;
  head.line = entity.line;
  return head;
}

EntityItem& own(State& state, std::size_t entity) {
  auto copy = std::make_shared<EntityItem>(*state.entities[entity]);
  EntityItem& result = *copy;
  state.entities[entity] = std::move(copy);
  return result;
}

State state_of(const map::Document& document) {
  State state;
  for (const map::Entity& entity : document.entities) add_entity(state, entity);
  state.closing_comments = document.closing_comments;
  return state;
}

map::Document document_of(const State& state, const std::string& file) {
  map::Document document;
  document.file = file;
  document.closing_comments = state.closing_comments;
  document.entities.reserve(state.entities.size());
  for (const auto& item : state.entities) {
    map::Entity& entity = document.entities.emplace_back(*item->head);
    entity.brushes.reserve(item->brushes.size());
    for (const BrushItem& brush : item->brushes) entity.brushes.push_back(*brush.brush);
  }
  return document;
}

std::optional<Thing> find(const State& state, Id id) {
  for (std::size_t e = 0; e < state.entities.size(); ++e) {
    const EntityItem& entity = *state.entities[e];
    if (entity.id == id) return Thing{e, {}};
    for (std::size_t b = 0; b < entity.brushes.size(); ++b) {
      if (entity.brushes[b].id == id) return Thing{e, b};
    }
  }
  return std::nullopt;
}

Id id_of(const State& state, const Thing& thing) {
  const EntityItem& entity = *state.entities[thing.entity];
  return thing.brush ? entity.brushes[*thing.brush].id : entity.id;
}

Id add_entity(State& state, map::Entity entity) {
  auto item = std::make_shared<EntityItem>();
  item->id = state.next_id++;
  item->head = std::make_shared<const map::Entity>(without_brushes(entity));
  item->brushes.reserve(entity.brushes.size());
  for (map::Brush& brush : entity.brushes) {
    item->brushes.push_back({state.next_id++, std::make_shared<const map::Brush>(std::move(brush))});
  }
  state.entities.push_back(item);
  return item->id;
}

Id add_brush(State& state, std::size_t entity, map::Brush brush) {
  const Id id = state.next_id++;
  own(state, entity).brushes.push_back({id, std::make_shared<const map::Brush>(std::move(brush))});
  return id;
}

void set_head(State& state, std::size_t entity, map::Entity head) {
  own(state, entity).head = std::make_shared<const map::Entity>(without_brushes(head));
}

void set_brush(State& state, const Thing& thing, map::Brush brush) {
  own(state, thing.entity).brushes[*thing.brush].brush = std::make_shared<const map::Brush>(std::move(brush));
}

void remove(State& state, const std::vector<Thing>& things) {
  std::vector<Thing> sorted = things;
  std::ranges::sort(sorted);
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  std::vector<std::shared_ptr<const EntityItem>> kept;
  auto next = sorted.begin();
  for (std::size_t e = 0; e < state.entities.size(); ++e) {
    const auto begin = next;
    while (next != sorted.end() && next->entity == e) ++next;
    if (begin == next) {
      kept.push_back(state.entities[e]);
    } else if (begin->brush) {  // an entity itself sorts before its brushes
      const auto& old = *state.entities[e];
      auto copy = std::make_shared<EntityItem>(EntityItem{old.id, old.head, {}});
      auto gone = begin;
      for (std::size_t b = 0; b < old.brushes.size(); ++b) {
        if (gone != next && *gone->brush == b) {
          ++gone;
        } else {
          copy->brushes.push_back(old.brushes[b]);
        }
      }
      kept.push_back(std::move(copy));
    }
  }
  state.entities = std::move(kept);
}

void set_key(State& state, std::size_t entity, const std::string& key, const std::string& value) {
  map::Entity head = *state.entities[entity]->head;
  // Where a key stands twice, the last one counts: the others would come back to light if it alone were removed.
  const auto has_key = [&](const map::KeyValue& pair) { return pair.key == key; };
  const auto last = std::find_if(head.keys.rbegin(), head.keys.rend(), has_key);
  if (value.empty()) {
    head.erase(key);
  } else if (last == head.keys.rend()) {
    head.add(key, value);
  } else {
    last->value = value;
    const auto kept = std::prev(last.base());
    head.keys.erase(std::remove_if(head.keys.begin(), kept, has_key), kept);
  }
  set_head(state, entity, std::move(head));
}

}  // namespace hallway::editor
