// SPDX-License-Identifier: MIT
#include "icp/core/scan_surfels.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "clouds.hpp"

namespace hallway::icp {
namespace {

constexpr double kNoise_m = 0.02;
const RangeNoise kNoise{kNoise_m, 0.0};

/// Points of a scan with their places.
struct Rays {
  Points points;
  std::vector<GridPlace> places;
};

/// A scan of rings of 900 columns at steps of `ring_deg`, symmetric to the horizon; range_m gives infinity where a ray meets nothing.
Rays scan(int rings, double ring_deg, const std::function<double(const Vec3& ray)>& range_m,
          clouds::Random& random) {
  Rays rays;
  constexpr int kColumns = 900;
  for (int ring = 0; ring < rings; ++ring) {
    const double elevation = (ring - 0.5 * (rings - 1)) * ring_deg * M_PI / 180.0;
    for (int column = 0; column < kColumns; ++column) {
      const double azimuth = 2.0 * M_PI * (column + 0.5) / kColumns;
      const Vec3 ray(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                     std::sin(elevation));
      const double range = range_m(ray) + kNoise_m * random.normal();
      if (!(range < 60.0)) continue;
      rays.points.push_back(range * ray);
      rays.places.push_back({static_cast<std::uint32_t>(ring), static_cast<std::uint32_t>(column)});
    }
  }
  return rays;
}

/// To the plane normal . x = distance.
double range_to(const Vec3& normal, double distance, const Vec3& ray) {
  const double along = normal.dot(ray);
  return along > 0.0 ? distance / along : clouds::kInf;
}

/// Squared error of a surfel's plane in its own standard deviations; 3 is expected of three parameters.
double chi2_of(const Surfel& surfel, const Vec3& normal, double distance) {
  const Vec3 error = surfel.inverse - normal / distance;
  return error.dot(surfel.covariance.inverse() * error);
}

TEST(ScanSurfels, FloorsSeenAtASlantHaveTheirNormal) {
  // Rings on a floor are far apart and their noise is along the rays: a fit of points would tilt towards them.
  clouds::Random random(1);
  const Vec3 down(0.0, 0.0, -1.0);
  const Rays rays = scan(
      16, 2.0, [&](const Vec3& ray) { return range_to(down, 1.0, ray); }, random);
  const std::vector<Surfel> surfels = surfels_of(rays.points, rays.places, false, kNoise);
  ASSERT_GT(surfels.size(), 100u);
  Vec3 mean = Vec3::Zero();
  double chi2 = 0.0;
  for (const Surfel& surfel : surfels) {
    mean += surfel.covariance.inverse() * surfel.inverse;
    chi2 += chi2_of(surfel, down, 1.0);
  }
  Mat3 information = Mat3::Zero();
  for (const Surfel& surfel : surfels) information += surfel.covariance.inverse();
  EXPECT_LT((information.inverse() * mean - down).norm(), 0.005);
  // Windows of three rings share rays: each one's covariance is taken three times.
  EXPECT_NEAR(chi2 / static_cast<double>(surfels.size()), 1.0, 0.3);
}

TEST(ScanSurfels, WallsOfAnySlantErrAsTheySay) {
  for (const double turn : {0.0, 0.5, 1.0, 1.3}) {
    clouds::Random random(2);
    const Vec3 normal(std::cos(turn), std::sin(turn), 0.0);
    const Rays rays = scan(
        16, 2.0, [&](const Vec3& ray) { return range_to(normal, 3.0, ray); }, random);
    const std::vector<Surfel> surfels = surfels_of(rays.points, rays.places, false, kNoise);
    ASSERT_GT(surfels.size(), 100u);
    double chi2 = 0.0, squares = 0.0;
    for (const Surfel& surfel : surfels) {
      chi2 += chi2_of(surfel, normal, 3.0);
      squares += std::pow(normal.dot(surfel.point) - 3.0, 2) / surfel.variance;
    }
    EXPECT_NEAR(chi2 / static_cast<double>(surfels.size()), 1.0, 0.3) << turn;
    EXPECT_NEAR(squares / static_cast<double>(surfels.size()), 1.0 / 3.0, 0.15) << turn;
  }
}

TEST(ScanSurfels, NoPlaneIsLaidThroughTwoSurfaces) {
  // A wall on a floor: one ring bends where they meet, and two lines there are in one plane that is neither.
  clouds::Random random(3);
  const Vec3 down(0.0, 0.0, -1.0), ahead(1.0, 0.0, 0.0);
  const auto range = [&](const Vec3& ray) {
    return std::min(range_to(down, 1.0, ray), range_to(ahead, 6.0, ray));
  };
  const Rays rays = scan(16, 2.0, range, random);
  const std::vector<Surfel> surfels = surfels_of(rays.points, rays.places, false, kNoise);
  ASSERT_GT(surfels.size(), 50u);
  for (const Surfel& surfel : surfels) {
    // The cosine to the nearer of both, less what noise may turn it.
    const double cosine = std::max(surfel.normal.dot(down), surfel.normal.dot(ahead));
    EXPECT_GT(cosine, 0.8) << surfel.normal.transpose() << " at " << surfel.point.transpose();
  }
}

TEST(ScanSurfels, OneOrTwoRingsAreNoSurface) {
  for (const int rings : {1, 2}) {
    clouds::Random random(4);
    const Rays rays = scan(
        rings, 2.0, [](const Vec3& ray) { return range_to(Vec3::UnitX(), 3.0, ray); }, random);
    EXPECT_TRUE(surfels_of(rays.points, rays.places, false, kNoise).empty()) << rings;
  }
}

TEST(ScanSurfels, APlanarScanSeesWalls) {
  clouds::Random random(5);
  const Vec3 normal(std::cos(0.4), std::sin(0.4), 0.0);
  const Rays rays = scan(
      1, 1.0, [&](const Vec3& ray) { return range_to(normal, 4.0, ray); }, random);
  const std::vector<Surfel> surfels = surfels_of(rays.points, rays.places, true, kNoise);
  ASSERT_GT(surfels.size(), 30u);
  double squares = 0.0;
  for (const Surfel& surfel : surfels) {
    EXPECT_EQ(surfel.normal.z(), 0.0);
    squares += std::pow(normal.dot(surfel.point) - 4.0, 2) / surfel.variance;
  }
  EXPECT_NEAR(squares / static_cast<double>(surfels.size()), 1.0, 0.6);
}

TEST(ScanSurfels, WhatIsRoughIsNoPlane) {
  clouds::Random random(6);
  const auto rough = [&](const Vec3&) { return 3.0 + 0.3 * random.normal(); };
  const Rays rays = scan(16, 2.0, rough, random);
  EXPECT_TRUE(surfels_of(rays.points, rays.places, false, kNoise).empty());
}

TEST(ScanSurfels, PlacesOfAScanThatTellsNone) {
  // Rows are rings again, whatever their number, and the surfels those of the organised scan about.
  for (const auto& [rings, step] : {std::pair(16, 2.0), std::pair(64, 0.4)}) {
    clouds::Random random(7);
    const Rays rays = scan(
        rings, step,
        [](const Vec3& ray) {
          return std::min(range_to({0, 0, -1}, 1.0, ray), range_to({1, 0, 0}, 5.0, ray));
        },
        random);
    const std::vector<GridPlace> places = places_of(rays.points);
    ASSERT_EQ(places.size(), rays.points.size());
    std::size_t apart = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
      apart += places[i].row != rays.places[i].row - rays.places.front().row;
    if (rings == 16) {
      EXPECT_EQ(apart, 0u);
    }
    const std::size_t told = surfels_of(rays.points, rays.places, false, kNoise).size();
    const std::size_t found = surfels_of(rays.points, places, false, kNoise).size();
    EXPECT_GT(found, told / 3) << rings;
  }
}

TEST(ScanSurfels, OfNothingThereAreNone) {
  EXPECT_TRUE(places_of({}).empty());
  EXPECT_TRUE(surfels_of({}, {}, false, kNoise).empty());
  const Points one{{1.0, 0.0, 0.0}};
  EXPECT_TRUE(surfels_of(one, places_of(one), false, kNoise).empty());
}

}  // namespace
}  // namespace hallway::icp
