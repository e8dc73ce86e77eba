// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>
#include <optional>
#include <vector>

#include "geom/plane.hpp"
#include "geometry/geodesy.hpp"
#include "map/document.hpp"

namespace hallway::map {

/// What turns compasses that are near: an `hw_magnet`.
struct MagnetEntity {
  Vec3 position = Vec3::Zero();  ///< metres
  double reach_m = 1.0;
  double strength = 0.5;
};

/// Where satellites are badly seen: a brush of an `hw_gnss_zone`.
struct GnssZoneEntity {
  std::vector<Plane> planes{};  ///< of the brush, metres; normals outward
  double factor = 0.0;
};

/// What sensors of position and heading take from a map.
struct Earth {
  double north_rad = std::numbers::pi / 2.0;  ///< direction of true north in the map, from x towards y
  double magnetic_north_rad = std::numbers::pi / 2.0;
  std::optional<GeoPoint> origin{};  ///< of the map
  std::vector<MagnetEntity> magnets{};
  std::vector<GnssZoneEntity> zones{};
};

/// Reads them: of worldspawn `_north_deg`, `_declination_deg`, `_latitude_deg` with `_longitude_deg` and `_altitude_m`; and the entities. Throws Error{kBadInput} with
/// file, line and entity for a bad or missing key, for a latitude without a longitude or the other way round, and for a zone without a brush or with one that is no solid.
Earth earth_of(const Document& document);

}  // namespace hallway::map
