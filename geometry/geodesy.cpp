// SPDX-License-Identifier: MIT
#include "geometry/geodesy.hpp"

#include <cmath>
#include <numbers>

namespace hallway {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kEquator_m = 6378137.0;
constexpr double kFlattening = 1.0 / 298.257223563;
constexpr double kPole_m = kEquator_m * (1.0 - kFlattening);
constexpr double kEccentricity2 = kFlattening * (2.0 - kFlattening);
constexpr double kSecondEccentricity2 = kEccentricity2 / (1.0 - kEccentricity2);
constexpr int kRounds = 5;

/// Of the curvature across the meridian.
double radius_at(double sine) {
  return kEquator_m / std::sqrt(1.0 - kEccentricity2 * sine * sine);
}

}  // namespace

Vec3 earth_centred(const GeoPoint& place) {
  const double latitude = place.latitude_deg * kDegree, longitude = place.longitude_deg * kDegree;
  const double sine = std::sin(latitude), cosine = std::cos(latitude);
  const double radius = radius_at(sine);
  const double level = (radius + place.altitude_m) * cosine;
  return {level * std::cos(longitude), level * std::sin(longitude),
          (radius * (1.0 - kEccentricity2) + place.altitude_m) * sine};
}

GeoPoint geodetic(const Vec3& earth_centred) {
  const double level = earth_centred.head<2>().norm();
  double reduced = std::atan2(earth_centred.z() * kEquator_m, level * kPole_m);
  double latitude = reduced;
  for (int round = 0; round < kRounds; ++round) {
    const double s = std::sin(reduced), c = std::cos(reduced);
    latitude = std::atan2(earth_centred.z() + kSecondEccentricity2 * kPole_m * s * s * s,
                          level - kEccentricity2 * kEquator_m * c * c * c);
    reduced = std::atan2((1.0 - kFlattening) * std::sin(latitude), std::cos(latitude));
  }
  const double sine = std::sin(latitude), cosine = std::cos(latitude);
  // Along the normal of the ellipsoid; the sum is well conditioned at the equator and at the poles.
  const double altitude =
      level * cosine + earth_centred.z() * sine - kEquator_m * kEquator_m / radius_at(sine);
  return {latitude / kDegree, std::atan2(earth_centred.y(), earth_centred.x()) / kDegree, altitude};
}

GeoPoint place_at(const GeoPoint& origin, const Vec3& east_north_up) {
  const double latitude = origin.latitude_deg * kDegree, longitude = origin.longitude_deg * kDegree;
  const Vec3 east(-std::sin(longitude), std::cos(longitude), 0.0);
  const Vec3 up(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                std::sin(latitude));
  const Vec3 north = up.cross(east);
  return geodetic(earth_centred(origin) + east_north_up.x() * east + east_north_up.y() * north +
                  east_north_up.z() * up);
}

}  // namespace hallway
