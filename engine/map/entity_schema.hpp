// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "map/document.hpp"

namespace hallway::map {

/// What the value of a key is.
enum class KeyKind {
  kText,
  kName,    ///< a text that other entities refer to
  kNumber,  ///< a finite decimal
  kWhole,
  kSeed,     ///< a whole number from 0 to 2^64 - 1
  kFlag,     ///< 0 or 1
  kChoice,   ///< one of KeySpec::choices
  kPoint,    ///< three numbers, map units
  kVector,   ///< three numbers
  kNumbers,  ///< one number or three
  kList,     ///< numbers, as many as one likes
  kScale,    ///< one number or three, of 1e-6 to 1e6 or their negatives
};

/// A key of a class of entities.
struct KeySpec {
  std::string_view name{};
  KeyKind kind = KeyKind::kText;
  bool required = false;
  double low =
      0.0;  ///< of a kNumber or kWhole, and of each number of a kNumbers, kVector or kList; of others than kNumber any where both are 0
  double high = 0.0;
  bool above_low = false;       ///< `low` itself is refused
  std::string_view fallback{};  ///< what counts where the key is absent; empty where that is nothing
  std::string_view choices{};   ///< of a kChoice, between blanks
  std::string_view variant{};   ///< variants of the class that have the key, between blanks; empty for all
  std::string_view about{};     ///< of a sensor: what it means, for people
};

/// Where the entities of a class have their place.
enum class EntityShape { kPoint, kBrushes };

/// A class of entities that Hallway reads.
struct EntitySpec {
  std::string_view classname{};
  EntityShape shape = EntityShape::kPoint;
  bool open = false;       ///< other programs have keys of their own there
  bool brushless = false;  ///< of a kBrushes: keys may take the place of brushes
  std::string_view
      selector{};  ///< key whose value (or fallback) names the variant; empty where there are none
  std::span<const KeySpec> keys{};

  /// The key of that name, or null; where variants have their own, the first.
  const KeySpec* key(std::string_view name) const;
  /// The key of that name that a variant has, or null.
  const KeySpec* key(std::string_view name, std::string_view variant) const;
};

/// All classes, as docs/formats.md and maps/trenchbroom/hallway.fgd have them; in a fixed order.
std::span<const EntitySpec> entity_schema();

/// The class of that very name, or null.
const EntitySpec* find_entity_spec(std::string_view classname);

/// What a key of a class may be. Throws Error{kInternal} if there is no such key.
const KeySpec& entity_key(std::string_view classname, std::string_view key);

/// The variant of a class that an entity is: the value of the selector, else its fallback.
std::string_view variant_of(const EntitySpec& spec, const Entity& entity);

/// Whether a key belongs to a variant of its class.
bool belongs(const KeySpec& key, std::string_view variant);

/// Keys that every entity may have: `classname`, `origin`, `angle`, `targetname`, `target`, `spawnflags`.
std::span<const std::string_view> common_keys();

}  // namespace hallway::map
