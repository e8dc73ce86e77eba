// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "editor/state.hpp"

namespace hallway::editor {

/// A run of a list that is replaced by another: [at, at + before.size()) becomes `after`.
template <typename Item>
struct Splice {
  std::size_t at = 0;
  std::vector<Item> before{};
  std::vector<Item> after{};
};

/// What changed within one entity that stays.
struct EntityChange {
  Id id = 0;
  std::shared_ptr<const map::Entity> head_before{};  ///< both null where the head stays
  std::shared_ptr<const map::Entity> head_after{};
  std::vector<Splice<BrushItem>> brushes{};  ///< places in the list before; rising
};

/// The difference of two states, in both directions: do and undo are the same operation.
struct Patch {
  std::vector<Splice<std::shared_ptr<const EntityItem>>> entities{};  ///< places in the list before; rising
  std::vector<EntityChange> changes{};                                ///< of entities that are in both states
  std::optional<std::pair<std::vector<std::string>, std::vector<std::string>>> closing_comments{};
  std::optional<std::pair<Desk, Desk>> desk{};
  std::pair<Id, Id> next_id{};

  /// Whether it changes what the map's file holds.
  bool changes_map() const { return !entities.empty() || !changes.empty() || closing_comments; }
  bool empty() const { return !changes_map() && !desk; }
};

/// What makes `after` of `before`. What the two share is recognised by its address, so that this costs O(entities) and
/// O(brushes) of changed entities.
Patch difference(const State& before, const State& after);

/// The way back. Numbers given stay given: the state that it leads to has `next_id` as it is now.
Patch inverse(const Patch& patch);

/// Changes a state. Throws Error{kInternal} where the patch does not fit it.
void apply(State& state, const Patch& patch);

/// As JSON; brushes and entities as text in the map format.
nlohmann::ordered_json to_json(const Patch& patch);

/// The whole number, not negative, that a value of a record is. Throws Error{kBadInput} for anything else: a fraction, or more than fits.
std::uint64_t whole_number(const nlohmann::ordered_json& json);

/// Throws Error{kBadInput} for anything that to_json() does not write.
Patch patch_from_json(const nlohmann::ordered_json& json);

}  // namespace hallway::editor
