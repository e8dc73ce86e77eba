// SPDX-License-Identifier: MIT
#include "map/sensors.hpp"

#include <algorithm>
#include <set>
#include <string>

#include "base/text.hpp"

namespace hallway::map {
namespace {

constexpr std::string_view kClass = "hw_sensor";

std::string_view kind_of(const EntityKeys& keys) {
  return variant_of(*find_entity_spec(kClass), keys.entity());
}

double number_of(const EntityKeys& keys, std::string_view name) {
  const KeySpec& key = sensor_key(kind_of(keys), name);
  return keys.number_or(name, parse_double(key.fallback).value_or(0.0), key.low, key.high);
}

void check_keys(const EntityKeys& keys) {
  keys.refuse_unknown();
  const std::string_view kind = kind_of(keys);
  for (const KeySpec& key : find_entity_spec(kClass)->keys) {
    if (belongs(key, kind) && (key.required || keys.has(key.name))) keys.check_value(key);
  }
  check_sensor(keys);
}

}  // namespace

bool is_sensor_name(std::string_view name) {
  constexpr std::size_t kMostBytes = 64;
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  return !name.empty() && name.size() <= kMostBytes && std::all_of(name.begin(), name.end(), plain);
}

const KeySpec& sensor_key(std::string_view kind, std::string_view name) {
  const KeySpec* key = find_entity_spec(kClass)->key(name, kind);
  if (key != nullptr) return *key;
  throw Error(ErrorCode::kInternal,
              "sensors of the kind " + std::string(kind) + " have no key " + std::string(name));
}

std::vector<std::string> sensor_key_names(std::string_view kind) {
  std::vector<std::string> names;
  for (const KeySpec& key : find_entity_spec(kClass)->keys) {
    if (key.name != "name" && belongs(key, kind)) names.emplace_back(key.name);
  }
  return names;
}

std::span<const SensorKind> sensor_kinds() {
  return kSensorKinds;
}

void check_sensor(const EntityKeys& keys) {
  if (const std::string name = keys.text("name"); !is_sensor_name(name)) {
    throw keys.error("key `name`: `" + printable(name, 60) +
                         "` is no sensor's name: 1 to 64 of the characters a-z, A-Z, 0-9, _ and -",
                     "name");
  }
  if (find_entity_spec(kClass)->key("min_range_m", kind_of(keys)) == nullptr) return;
  const double nearest_m = number_of(keys, "min_range_m");
  const double farthest_m = number_of(keys, "max_range_m");
  if (nearest_m <= farthest_m) return;
  throw keys.error(
      "`min_range_m` " + format_double(nearest_m) + " is above `max_range_m` " + format_double(farthest_m),
      keys.has("min_range_m") ? "min_range_m" : "max_range_m");
}

std::vector<const Entity*> sensors(const Document& document) {
  std::vector<const Entity*> found;
  std::set<std::string> names;
  for (const Entity& entity : document.entities) {
    if (entity.classname() != kClass) continue;
    const EntityKeys keys(document, entity);
    check_keys(keys);
    if (const std::string name = keys.text("name"); !names.insert(name).second)
      throw keys.error("a second sensor named `" + name + "`", "name");
    if (names.size() > kMaxSensors)
      throw keys.error("a sensor too many: at most " + std::to_string(kMaxSensors) + " are allowed");
    found.push_back(&entity);
  }
  return found;
}

}  // namespace hallway::map
