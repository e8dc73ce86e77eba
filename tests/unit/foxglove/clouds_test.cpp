// SPDX-License-Identifier: MIT
#include "foxglove/clouds.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

namespace hallway::foxglove {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A scan and its lists.
struct Rays {
  std::vector<hw_ray_t> rays{};
  std::vector<std::int64_t> times{};
  std::vector<float> intensities{};
  std::vector<std::uint32_t> rings{};
  std::uint32_t layers = 1;

  hw_range_scan_t scan() const {
    hw_range_scan_t scan{};
    scan.size = sizeof scan;
    scan.stride = sizeof(hw_ray_t);
    scan.count = rays.size();
    scan.rays = rays.data();
    scan.layers = layers;
    scan.t_offset_ns = times.empty() ? nullptr : times.data();
    scan.intensity = intensities.empty() ? nullptr : intensities.data();
    scan.ring = rings.empty() ? nullptr : rings.data();
    return scan;
  }
};

/// Of the field of that name in point i.
template <typename Number>
Number number(const Cloud& cloud, const std::string& name, std::size_t i) {
  static_assert(std::endian::native == std::endian::little);
  Number value{};
  for (const CloudField& field : cloud.fields) {
    if (field.name == name)
      std::memcpy(&value, cloud.data.data() + i * cloud.stride + field.offset, sizeof value);
  }
  return value;
}

CloudField::Type type_of(const Cloud& cloud, const std::string& name) {
  for (const CloudField& field : cloud.fields)
    if (field.name == name) return field.type;
  ADD_FAILURE() << "no field " << name;
  return {};
}

const Rays kThree{.rays = {{0.1, 0.2, 5.0}, {0.2, -0.3, kInfinity}, {0.3, 0.4, kNaN}, {-2.0, 0.5, 7.0}},
                  .times = {0, 10, 20, 4'000'000'000},
                  .intensities = {0.25F, std::numeric_limits<float>::quiet_NaN(), 0.5F, 0.75F},
                  .rings = {3, 2, 1, 65'535}};

TEST(FoxgloveClouds, HaveThePointsThatRaysMetWithTheirNumbers) {
  const Cloud cloud = cloud_of(kThree.scan());
  EXPECT_EQ(cloud.stride, 22u);
  ASSERT_EQ(cloud.data.size(), 2u * 22) << "two rays have no return";
  const std::size_t rays[] = {0, 3};
  for (std::size_t i = 0; i < 2; ++i) {
    const hw_ray_t& ray = kThree.rays[rays[i]];
    const double level = ray.range_m * std::cos(ray.elevation_rad);
    EXPECT_NEAR(number<float>(cloud, "x", i), level * std::cos(ray.azimuth_rad), 1e-6);
    EXPECT_NEAR(number<float>(cloud, "y", i), level * std::sin(ray.azimuth_rad), 1e-6);
    EXPECT_NEAR(number<float>(cloud, "z", i), ray.range_m * std::sin(ray.elevation_rad), 1e-6);
    EXPECT_EQ(number<float>(cloud, "intensity", i), kThree.intensities[rays[i]]);
    EXPECT_EQ(number<std::uint16_t>(cloud, "ring", i), kThree.rings[rays[i]]);
    EXPECT_EQ(number<std::uint32_t>(cloud, "t_offset", i), kThree.times[rays[i]]);
  }
}

TEST(FoxgloveClouds, NumbersThatDoNotFitHaveWiderFields) {
  Rays wide = kThree;
  wide.rings[3] = 65'536;
  wide.times[3] = 5'000'000'000;
  const Cloud cloud = cloud_of(wide.scan());
  EXPECT_EQ(type_of(cloud, "ring"), CloudField::Type::kUint32);
  EXPECT_EQ(type_of(cloud, "t_offset"), CloudField::Type::kFloat64);
  EXPECT_EQ(number<std::uint32_t>(cloud, "ring", 1), 65'536u);
  EXPECT_EQ(number<double>(cloud, "t_offset", 1), 5e9);
  EXPECT_EQ(cloud.stride, 28u);
}

TEST(FoxgloveClouds, WhatAReadingDoesNotHaveIsNoField) {
  const Cloud cloud = cloud_of(Rays{.rays = kThree.rays}.scan());
  EXPECT_EQ(cloud.fields.size(), 3u);
  EXPECT_EQ(cloud.stride, 12u);
  EXPECT_EQ(cloud_of(Rays{}.scan()).data.size(), 0u);
  const std::vector<double> numbers{1, 2, 3, 4, 5, 6};
  const std::vector<float> intensities{7.0F, 8.0F};
  hw_points_t points{};
  points.size = sizeof points;
  points.stride = sizeof(hw_point3_t);
  points.count = 2;
  points.points = numbers.data();
  points.intensity = intensities.data();
  const Cloud known = cloud_of(points);
  EXPECT_EQ(known.fields.size(), 4u);
  EXPECT_EQ(number<float>(known, "intensity", 1), 8.0F);
  EXPECT_EQ(number<float>(known, "z", 1), 6.0F);
  points.size = offsetof(hw_points_t, t_offset_ns);
  EXPECT_EQ(cloud_of(points).fields.size(), 3u) << "of a writer before them";
}

/// Rays at equal steps.
Rays fan(double from, double step, std::size_t n) {
  Rays fan;
  for (std::size_t i = 0; i < n; ++i) {
    fan.rays.push_back({from + step * static_cast<double>(i), 0.0, 1.0 + static_cast<double>(i)});
    fan.intensities.push_back(0.5F * static_cast<float>(i));
  }
  fan.rays[1].range_m = kInfinity;
  fan.rays[2].range_m = kNaN;
  return fan;
}

TEST(FoxgloveClouds, LevelScansKeepEveryRange) {
  for (const double step : {0.01, -0.01}) {
    Rays rays = fan(-2.0, step, 300);
    const auto level = level_scan_of(rays.scan());
    ASSERT_TRUE(level) << step;
    EXPECT_EQ(level->start_rad, -2.0);
    EXPECT_NEAR(level->end_rad, -2.0 + step * 299, 1e-12);
    ASSERT_EQ(level->ranges.size(), 300u);
    for (std::size_t i = 0; i < 300; ++i) {
      if (i == 2) continue;
      EXPECT_EQ(level->ranges[i], rays.rays[i].range_m);
      EXPECT_EQ(level->intensities[i], static_cast<double>(rays.intensities[i]));
    }
    EXPECT_TRUE(std::isnan(level->ranges[2]));
  }
  Rays wound = fan(2.5, 0.01, 200);  // past half a turn
  for (hw_ray_t& ray : wound.rays) ray.azimuth_rad = std::remainder(ray.azimuth_rad, 2 * std::numbers::pi);
  const auto level = level_scan_of(wound.scan());
  ASSERT_TRUE(level);
  EXPECT_NEAR(level->end_rad, 2.5 + 1.99, 1e-9);
}

TEST(FoxgloveClouds, OtherScansAreNotLevel) {
  Rays tilted = fan(0, 0.01, 10);
  tilted.rays[4].elevation_rad = 0.001;
  EXPECT_FALSE(level_scan_of(tilted.scan()));
  Rays uneven = fan(0, 0.01, 10);
  uneven.rays[4].azimuth_rad += 1e-5;
  EXPECT_FALSE(level_scan_of(uneven.scan()));
  Rays twice = fan(0, 0.01, 10);
  twice.layers = 2;
  EXPECT_FALSE(level_scan_of(twice.scan()));
  EXPECT_FALSE(level_scan_of(Rays{}.scan()));
}

}  // namespace
}  // namespace hallway::foxglove
