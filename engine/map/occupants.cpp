// SPDX-License-Identifier: MIT
#include "map/occupants.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "map/entity_keys.hpp"
#include "map/entity_schema.hpp"

namespace hallway::map {
namespace {

constexpr std::array<std::string_view, 7> kPlaceless{"worldspawn", "info_null", "info_notnull", "hw_magnet",
                                                     "hw_mesh",    "hw_sensor", "misc_model"};

bool has_place(const Entity& entity) {
  const std::string_view name = entity.classname();
  return entity.brushes.empty() && !name.starts_with("misc_external_map") &&
         std::find(kPlaceless.begin(), kPlaceless.end(), name) == kPlaceless.end();
}

/// Whether the entity is of a class of Hallway's, and of a variant, that must have an origin.
bool needs_origin(const Entity& entity) {
  const EntitySpec* spec = find_entity_spec(entity.classname());
  if (!spec || spec->open) return false;
  const std::string_view variant = variant_of(*spec, entity);
  return std::any_of(spec->keys.begin(), spec->keys.end(), [&](const KeySpec& key) {
    return key.name == "origin" && key.required && belongs(key, variant);
  });
}

std::string name_of(const Entity& entity) {
  if (entity.classname() == "hw_waypoint") {
    const std::string* path = entity.find("path");
    const std::string* index = entity.find("index");
    return path && index ? *path + " " + *index : std::string();
  }
  for (const std::string_view key : {"name", "targetname"}) {
    if (const std::string* name = entity.find(key)) return *name;
  }
  return {};
}

}  // namespace

std::vector<Occupant> occupants(const Document& document) {
  std::vector<Occupant> found;
  for (const Entity& entity : document.entities) {
    if (!has_place(entity)) continue;
    const EntityKeys keys(document, entity);
    if (!keys.has("origin") && !needs_origin(entity)) continue;
    found.push_back(
        {std::string(entity.classname()), name_of(entity), keys.origin_m(), keys.index(), entity.line});
  }
  return found;
}

}  // namespace hallway::map
