// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geom/box.hpp"
#include "map/document.hpp"

namespace hallway::editor {

/// The number of an entity or brush. It belongs to it for as long as the map's journal lasts, and is never given again.
using Id = std::uint64_t;

/// A brush as a shared value: states that agree on it share it.
struct BrushItem {
  Id id = 0;
  std::shared_ptr<const map::Brush> brush;
};

/// An entity as a shared value.
struct EntityItem {
  Id id = 0;
  std::shared_ptr<const map::Entity> head;  ///< all of it but its brushes
  std::vector<BrushItem> brushes;

  std::string_view classname() const { return head->classname(); }
  bool is_world() const { return classname() == "worldspawn"; }
  /// The value of a key, or the empty text.
  const std::string& value(std::string_view key) const { return head->value(key); }
  bool has(std::string_view key, std::string_view value) const { return head->has(key, value); }
};

/// What an editor remembers beside the map's content; it is in no map file.
struct Desk {
  std::vector<Id> selection{};  ///< rising
  std::vector<Id> hidden{};     ///< rising; left out of pictures
  double grid_m = 0.0;          ///< places that commands are given are rounded to it; 0: none

  friend bool operator==(const Desk&, const Desk&) = default;
};

/// A map under edit, as a value. Copies are cheap: O(entities), and changing one brush costs O(brushes of its entity).
struct State {
  std::vector<std::shared_ptr<const EntityItem>> entities;
  std::vector<std::string> closing_comments;
  Id next_id = 1;  ///< of what is made next
  Desk desk;
};

/// The document with ids in the order of the file: each entity, then its brushes.
State state_of(const map::Document& document);

/// The document that a state stands for. O(size of the map).
map::Document document_of(const State& state, const std::string& file);

/// A thing of a state: an entity, or a brush of it.
struct Thing {
  std::size_t entity = 0;              ///< index in State::entities
  std::optional<std::size_t> brush{};  ///< index in EntityItem::brushes; none: the entity itself

  friend auto operator<=>(const Thing&, const Thing&) = default;
};

/// Calls `visit` with each thing and its number: each entity, then its brushes.
template <typename Visit>
void for_each_thing(const State& state, Visit&& visit) {
  for (std::size_t e = 0; e < state.entities.size(); ++e) {
    visit(Thing{e, {}}, state.entities[e]->id);
    const auto& brushes = state.entities[e]->brushes;
    for (std::size_t b = 0; b < brushes.size(); ++b) visit(Thing{e, b}, brushes[b].id);
  }
}

/// The entities for which `test` holds, in their order.
template <typename Test>
std::vector<Thing> entities_where(const State& state, Test&& test) {
  std::vector<Thing> things;
  for (std::size_t e = 0; e < state.entities.size(); ++e) {
    if (test(*state.entities[e])) things.push_back({e, {}});
  }
  return things;
}

/// The first entity for which `test` holds, by index.
template <typename Test>
std::optional<std::size_t> find_entity(const State& state, Test&& test) {
  for (std::size_t e = 0; e < state.entities.size(); ++e) {
    if (test(*state.entities[e])) return e;
  }
  return std::nullopt;
}

/// The thing of that number, or none. O(things).
std::optional<Thing> find(const State& state, Id id);

/// The brush that a thing is.
inline const map::Brush& brush_at(const State& state, const Thing& thing) {
  return *state.entities[thing.entity]->brushes[*thing.brush].brush;
}

/// The number of a thing.
Id id_of(const State& state, const Thing& thing);

/// An entity without its brushes.
map::Entity without_brushes(const map::Entity& entity);

// What changes a state. Each gives new things the next numbers.

/// An entity to be changed, which no other state shares from now on. O(its brushes).
EntityItem& own(State& state, std::size_t entity);

/// Adds an entity at the end, its brushes included; returns its number.
Id add_entity(State& state, map::Entity entity);
/// Adds a brush behind the entity's others; returns its number.
Id add_brush(State& state, std::size_t entity, map::Brush brush);
/// Replaces what an entity is but for its brushes (those of `head` are not looked at).
void set_head(State& state, std::size_t entity, map::Entity head);
/// Replaces a brush; it keeps its number.
void set_brush(State& state, const Thing& thing, map::Brush brush);
/// Removes things; those of an entity go with it. Brushes of one entity cost O(its brushes) together.
void remove(State& state, const std::vector<Thing>& things);
/// Sets a key of an entity, which then stands once; an empty value removes it.
void set_key(State& state, std::size_t entity, const std::string& key, const std::string& value);

/// A document as the successor of a state: entities and brushes that were there keep their numbers and stay shared, the rest gets new
/// ones. An entity is known again by its text without brushes, else by its place if its class there is the same; brushes by
/// their text. O(size of the map).
State matched(const State& before, const map::Document& document);

}  // namespace hallway::editor
