// SPDX-License-Identifier: MIT
#include "map/earth.hpp"

#include "base/text.hpp"
#include "map/brush_solid.hpp"
#include "map/entity_keys.hpp"

namespace hallway::map {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A number that the schema gives its range and default.
double number_of(const EntityKeys& keys, const char* key) {
  const KeySpec& spec = entity_key(keys.entity().classname(), key);
  const double fallback = spec.fallback.empty() ? 0.0 : *parse_double(spec.fallback);
  return keys.number_or(key, fallback, spec.low, spec.high);
}

void read_worldspawn(const Document& document, const Entity& world, Earth& earth) {
  const EntityKeys keys(document, world);
  earth.north_rad = number_of(keys, "_north_deg") * kDegree;
  // A declination is to the east, which is to the right.
  earth.magnetic_north_rad = earth.north_rad - number_of(keys, "_declination_deg") * kDegree;
  if (!keys.has("_latitude_deg") && !keys.has("_longitude_deg")) {
    if (keys.has("_altitude_m"))
      throw keys.error("`_altitude_m` needs `_latitude_deg` and `_longitude_deg`", "_altitude_m");
    return;
  }
  for (const char* key : {"_latitude_deg", "_longitude_deg"}) {
    if (!keys.has(key)) throw keys.error("`_latitude_deg` and `_longitude_deg` need each other");
  }
  earth.origin = GeoPoint{.latitude_deg = number_of(keys, "_latitude_deg"),
                          .longitude_deg = number_of(keys, "_longitude_deg"),
                          .altitude_m = number_of(keys, "_altitude_m")};
}

void read_zone(const Document& document, const Entity& entity, Earth& earth) {
  const EntityKeys keys(document, entity);
  const double factor = number_of(keys, "factor");
  if (factor > 0.0 && factor < 1.0) throw keys.error("`factor` is below 1; 0 is for no fix at all", "factor");
  if (entity.brushes.empty()) throw keys.error("has no brush");
  for (const Brush& brush : entity.brushes)
    earth.zones.push_back({solid_of(document, brush, "a zone").planes, factor});
}

}  // namespace

Earth earth_of(const Document& document) {
  Earth earth;
  if (const Entity* world = document.worldspawn()) read_worldspawn(document, *world, earth);
  for (const Entity& entity : document.entities) {
    if (entity.classname() == "hw_magnet") {
      const EntityKeys keys(document, entity);
      keys.refuse_unknown();
      earth.magnets.push_back({.position = keys.origin_m(),
                               .reach_m = number_of(keys, "reach_m"),
                               .strength = number_of(keys, "strength")});
    } else if (entity.classname() == "hw_gnss_zone") {
      read_zone(document, entity, earth);
    }
  }
  return earth;
}

}  // namespace hallway::map
