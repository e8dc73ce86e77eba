// SPDX-License-Identifier: MIT
#include "map/document.hpp"

#include <algorithm>

#include "map/entity_keys.hpp"

namespace hallway::map {

const std::string* Entity::find(std::string_view key) const {
  const auto last =
      std::find_if(keys.rbegin(), keys.rend(), [&](const KeyValue& pair) { return pair.key == key; });
  return last == keys.rend() ? nullptr : &last->value;
}

const std::string& Entity::value(std::string_view key) const {
  static const std::string none;
  const std::string* found = find(key);
  return found != nullptr ? *found : none;
}

bool Entity::has(std::string_view key, std::string_view value) const {
  const std::string* found = find(key);
  return found != nullptr && *found == value;
}

void Entity::erase(std::string_view key) {
  std::erase_if(keys, [&](const KeyValue& pair) { return pair.key == key; });
}

const Entity* Document::worldspawn() const {
  for (const Entity& entity : entities) {
    if (entity.classname() == "worldspawn") return &entity;
  }
  return nullptr;
}

double Document::metres_per_unit() const {
  const Entity* world = worldspawn();
  if (!world) return kQuakeMetresPerUnit;
  return EntityKeys(*this, *world).number_or("_scale", kQuakeMetresPerUnit, 1e-6, 1e3);
}

}  // namespace hallway::map
