// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "geom/pose.hpp"
#include "map/document.hpp"

namespace hallway::map {

/// Reads the keys of one entity as what they mean. Every function throws Error{kBadInput} with file, line, entity and cause
/// if the value is not what is asked for, if the key stands twice, or if it is missing and there is no default.
class EntityKeys {
 public:
  /// Both must outlive this; `entity` is one of the document's.
  EntityKeys(const Document& document, const Entity& entity) : document_(document), entity_(entity) {}

  bool has(std::string_view key) const { return entity_.find(key) != nullptr; }
  std::string text(std::string_view key) const;
  /// A finite decimal number in [low, high].
  double number(std::string_view key, double low, double high) const;
  double number_or(std::string_view key, double fallback, double low, double high) const;
  std::int64_t integer(std::string_view key) const;
  std::uint64_t seed_or(std::string_view key, std::uint64_t fallback) const;
  /// "0" or "1".
  bool flag_or(std::string_view key, bool fallback) const;
  /// Key `origin`, three numbers in map units, as metres in the world.
  Vec3 origin_m() const;
  /// Key `angle`: turn about z in radians, counter-clockwise from above; written in degrees, 0 where absent.
  double angle() const;

  /// Refuses a key that is none of `known`, with a suggestion. Keys that every entity may have (`classname`, `origin`,
  /// `angle`, `targetname`, `target`, `spawnflags`) and those that begin with an underscore or slashes pass.
  void refuse_unknown(std::initializer_list<std::string_view> known) const;

  /// An Error about this entity, at the line of `key` if it has that key.
  Error error(std::string message, std::string_view key = {}) const;
  /// Index of the entity in the document.
  int index() const;

 private:
  const KeyValue* find_once(std::string_view key) const;
  const KeyValue& require(std::string_view key) const;
  double number_from(const KeyValue& pair, double low, double high) const;

  const Document& document_;
  const Entity& entity_;
};

}  // namespace hallway::map
