// SPDX-License-Identifier: MIT
#include "geometry/geodesy.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hallway {
namespace {

TEST(Geodesy, KnowsTheSizeOfTheEarth) {
  EXPECT_LT((earth_centred({0, 0, 0}) - Vec3(6378137.0, 0, 0)).norm(), 1e-8);
  EXPECT_LT((earth_centred({0, 90, 10}) - Vec3(0, 6378147.0, 0)).norm(), 1e-8);
  EXPECT_LT((earth_centred({90, 0, 0}) - Vec3(0, 0, 6356752.314245)).norm(), 1e-5);
  // A kilometre of the meridian at the equator and at the pole: its radii of curvature are 6335.439 and 6399.594 km.
  EXPECT_NEAR((earth_centred({0.005, 0, 0}) - earth_centred({-0.005, 0, 0})).norm(),
              0.01 * M_PI / 180.0 * 6335439.327, 1e-3);
  EXPECT_NEAR((earth_centred({90, 0, 0}) - earth_centred({89.99, 0, 0})).norm(),
              0.01 * M_PI / 180.0 * 6399593.626, 1e-3);
}

TEST(Geodesy, GoesThereAndBackEverywhere) {
  for (double latitude = -90; latitude <= 90; latitude += 7.5) {
    for (double longitude = -179; longitude <= 180; longitude += 31) {
      for (const double altitude : {-10e3, 0.0, 100.0, 9e3, 1e6}) {
        const GeoPoint back = geodetic(earth_centred({latitude, longitude, altitude}));
        EXPECT_NEAR(back.latitude_deg, latitude, 1e-9) << altitude;
        EXPECT_NEAR(back.altitude_m, altitude, 1e-6) << latitude;
        if (std::abs(latitude) < 90) {
          EXPECT_NEAR(std::remainder(back.longitude_deg - longitude, 360.0), 0.0, 1e-9);
        }
      }
    }
  }
}

TEST(Geodesy, ALevelFrameIsEastNorthUp) {
  const GeoPoint origin{48.0, 11.0, 500.0};
  const GeoPoint east = place_at(origin, {100, 0, 0}), north = place_at(origin, {0, 100, 0}),
                 up = place_at(origin, {0, 0, 100});
  EXPECT_GT(east.longitude_deg, origin.longitude_deg);
  EXPECT_NEAR(east.latitude_deg, origin.latitude_deg, 1e-7);
  EXPECT_NEAR((north.latitude_deg - origin.latitude_deg) * M_PI / 180.0 * (6370679.0 + 500.0), 100.0, 0.01);
  EXPECT_NEAR(north.longitude_deg, origin.longitude_deg, 1e-12);
  EXPECT_NEAR(up.altitude_m, 600.0, 1e-6);
  EXPECT_NEAR(up.latitude_deg, origin.latitude_deg, 1e-11);
  // What is level at the origin is above the ellipsoid farther off: 100^2 / 2 R.
  EXPECT_NEAR(east.altitude_m - 500.0, 100.0 * 100.0 / 2.0 / 6.39e6, 1e-5);
}

}  // namespace
}  // namespace hallway
