// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/se3.hpp"

namespace hallway {

/// A place on Earth, WGS 84.
struct GeoPoint {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double altitude_m = 0.0;  ///< above the ellipsoid
};

/// Earth-centred coordinates of a place: x towards 0 degrees of both, z towards the north pole; metres.
Vec3 earth_centred(const GeoPoint& place);

/// The place of Earth-centred coordinates. Right to 1e-9 degrees and 1 um for altitudes from -10 to 1000 km. At the centre of the Earth it is some place there.
/// Source: Bowring 1976, iterated.
GeoPoint geodetic(const Vec3& earth_centred);

/// Where a point of a level frame (x east, y north, z up) is whose origin is at a place.
GeoPoint place_at(const GeoPoint& origin, const Vec3& east_north_up);

}  // namespace hallway
