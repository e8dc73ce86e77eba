// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "geometry/se3.hpp"
#include "map/document.hpp"
#include "map/entity_schema.hpp"

namespace hallway::map {

/// Reads the keys of one entity as what they mean. Every function throws Error{kBadInput} with file, line, entity and cause
/// if the value is not what is asked for, if the key stands twice, or if it is missing and there is no default.
class EntityKeys {
 public:
  /// Both must outlive this; `entity` is one of the document's.
  EntityKeys(const Document& document, const Entity& entity) : document_(document), entity_(entity) {}

  bool has(std::string_view key) const { return entity_.find(key) != nullptr; }
  /// Whether the key stands more than once.
  bool is_doubled(std::string_view key) const;
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
  /// Three finite numbers between blanks.
  Vec3 vector(std::string_view key) const;
  /// Key `angle`: turn about z in radians, counter-clockwise from above; written in degrees, 0 where absent.
  double angle() const;

  /// Keys that the entity's class does not have (entity_schema.hpp), each as an Error with a suggestion, up to 20. Those that every
  /// entity may have and those that begin with an underscore or slashes pass, as do all in a class that is not in the
  /// schema or is open.
  std::vector<Error> unknown_keys() const;
  /// Throws the first of them.
  void refuse_unknown() const;
  /// Reads a key as the schema says and throws if its value is not of that kind. The key must be there.
  void check_value(const KeySpec& key) const;

  /// An Error about this entity, at the line of `key` if it has that key.
  Error error(std::string message, std::string_view key = {}) const;
  const Entity& entity() const { return entity_; }
  /// Index of the entity in the document.
  int index() const;

 private:
  const KeyValue* find_once(std::string_view key) const;
  const KeyValue& require(std::string_view key) const;
  double number_from(const KeyValue& pair, double low, double high) const;
  std::vector<double> numbers_from(const KeyValue& pair) const;
  void check_range(const KeySpec& key, double value) const;
  Vec3 point(std::string_view key) const;
  void check_scale(std::string_view key) const;
  void check_numbers(const KeySpec& key) const;
  void check_choice(const KeySpec& key) const;

  const Document& document_;
  const Entity& entity_;
};

}  // namespace hallway::map
