// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "em/core/types.hpp"
#include "patches.hpp"

/// What holds for every search of planes, asked of one of them.
namespace hallway::em::planted {

using Search = std::function<Extraction(const std::vector<Vec3>&)>;

/// A room's corner and a slope: four planes that meet, the sensor inside.
inline std::vector<Vec3> corner_cloud() {
  std::vector<Vec3> cloud;
  const auto add = [&](const Vec3& centre, const Vec3& normal, const Vec3& axis, std::uint64_t seed) {
    const std::vector<Vec3> points = cloud_of({centre, normal, axis, 1.0, 1.0, 800, 0.01}, seed);
    cloud.insert(cloud.end(), points.begin(), points.end());
  };
  add({2.0, 0.0, -1.0}, Vec3::UnitZ(), Vec3::UnitX(), 1);
  add({3.0, 0.0, 0.0}, -Vec3::UnitX(), Vec3::UnitY(), 2);
  add({2.0, 1.0, 0.0}, -Vec3::UnitY(), Vec3::UnitX(), 3);
  add({-2.0, 0.0, 0.0}, Vec3(0.8, 0.0, 0.6), Vec3::UnitY(), 4);
  return cloud;
}

inline std::vector<Vec3> shuffled(std::vector<Vec3> cloud, std::vector<std::size_t>& from) {
  Numbers numbers(99);
  from.resize(cloud.size());
  for (std::size_t i = 0; i < from.size(); ++i) from[i] = i;
  for (std::size_t i = cloud.size(); i > 1; --i) {
    const std::size_t j = numbers.below(i);
    std::swap(cloud[i - 1], cloud[j]);
    std::swap(from[i - 1], from[j]);
  }
  return cloud;
}

inline void expect_same_planes(const Extraction& a, const Extraction& b, double scale = 1.0) {
  ASSERT_EQ(a.planes.size(), b.planes.size());
  for (std::size_t i = 0; i < a.planes.size(); ++i) {
    EXPECT_EQ(a.planes[i].normal, b.planes[i].normal);
    EXPECT_EQ(a.planes[i].offset * scale, b.planes[i].offset);
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_EQ(Vec3(a.planes[i].corners[k] * scale), b.planes[i].corners[k]);
  }
}

inline void expect_sound(const Extraction& found, const std::vector<Vec3>& cloud) {
  ASSERT_EQ(found.labels.size(), cloud.size());
  std::size_t labelled = 0;
  for (std::size_t j = 0; j < found.planes.size(); ++j) {
    const Plane& plane = found.planes[j];
    EXPECT_EQ(plane.id, j);
    EXPECT_NEAR(plane.normal.norm(), 1.0, 1e-12);
    EXPECT_LE(plane.offset, 0.0);
    EXPECT_TRUE(std::is_sorted(plane.members.begin(), plane.members.end()));
    if (j > 0) {
      EXPECT_LE(plane.members.size(), found.planes[j - 1].members.size());
    }
    for (const PointIndex i : plane.members) EXPECT_EQ(found.labels[i], j);
    labelled += plane.members.size();
    const Vec3 turn = (plane.corners[1] - plane.corners[0]).cross(plane.corners[2] - plane.corners[1]);
    EXPECT_GT(turn.dot(plane.normal), 0.0);
    for (const Vec3& corner : plane.corners) EXPECT_NEAR(plane.normal.dot(corner), plane.offset, 1e-9);
    EXPECT_GE(plane.hull.size(), 3u);
    EXPECT_LT(plane.rms, 0.02);
    EXPECT_GT(plane.exclusive_share, 0.5);
  }
  EXPECT_EQ(labelled,
            static_cast<std::size_t>(std::count_if(found.labels.begin(), found.labels.end(),
                                                   [](std::uint32_t label) { return label != kNoPlane; })));
}

inline void expect_finds_the_corner(const Search& search) {
  const std::vector<Vec3> cloud = corner_cloud();
  const Extraction found = search(cloud);
  expect_sound(found, cloud);
  ASSERT_EQ(found.planes.size(), 4u);
  EXPECT_NEAR(found.noise, 0.01, 0.001);
  for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(-1, 0, 0), Vec3(0, -1, 0), Vec3(0.8, 0.0, 0.6)}) {
    const bool there = std::any_of(found.planes.begin(), found.planes.end(), [&](const Plane& plane) {
      return plane.normal.dot(normal) > std::cos(0.01);
    });
    EXPECT_TRUE(there) << normal.transpose();
  }
}

inline void expect_no_order_in_the_result(const Search& search) {
  const std::vector<Vec3> cloud = corner_cloud();
  const Extraction found = search(cloud);
  std::vector<std::size_t> from;
  const Extraction again = search(shuffled(cloud, from));
  expect_same_planes(found, again);
  for (std::size_t i = 0; i < from.size(); ++i) ASSERT_EQ(again.labels[i], found.labels[from[i]]) << i;
}

inline void expect_units_do_not_matter(const Search& search) {
  // A power of two, so that scaling rounds nothing.
  std::vector<Vec3> cloud = corner_cloud();
  const Extraction found = search(cloud);
  for (Vec3& p : cloud) p *= 1024.0;
  const Extraction scaled = search(cloud);
  EXPECT_EQ(scaled.labels, found.labels);
  expect_same_planes(found, scaled, 1024.0);
}

inline void expect_points_given_twice_to_change_counts_only(const Search& search) {
  std::vector<Vec3> cloud = corner_cloud();
  const std::size_t once = cloud.size();
  const Extraction found = search(cloud);
  for (std::size_t i = 0; i < once; ++i) cloud.push_back(Vec3(cloud[i]));
  const Extraction twice = search(cloud);
  expect_same_planes(found, twice);
  for (std::size_t i = 0; i < once; ++i) {
    EXPECT_EQ(twice.labels[i], found.labels[i]);
    EXPECT_EQ(twice.labels[once + i], found.labels[i]);
  }
}

inline void expect_points_that_are_not_finite_to_be_ignored(const Search& search) {
  std::vector<Vec3> cloud = corner_cloud();
  const Extraction found = search(cloud);
  const double inf = std::numeric_limits<double>::infinity();
  cloud.insert(cloud.begin(),
               {Vec3(std::nan(""), 0, 0), Vec3(0, inf, 0), Vec3(0, 0, -inf), Vec3(1e300, 0, 0)});
  const Extraction again = search(cloud);
  expect_same_planes(found, again);
  EXPECT_EQ(again.labels[0], kNoPlane);
  EXPECT_EQ(std::vector<std::uint32_t>(again.labels.begin() + 4, again.labels.end()), found.labels);
}

inline void expect_no_plane_where_there_is_none(const Search& search) {
  std::vector<Vec3> line, twins;
  for (int i = 0; i < 200; ++i) {
    line.emplace_back(0.1 * i, -0.3 * i, 0.7 * i);
    twins.emplace_back(0.5, 0.5, 0.5);
  }
  const std::vector<std::vector<Vec3>> clouds{{},
                                              {Vec3(1, 2, 3)},
                                              {Vec3(1, 2, 3), Vec3(2, 3, 5)},
                                              twins,
                                              line,
                                              std::vector<Vec3>(20, Vec3::Constant(std::nan("")))};
  for (const std::vector<Vec3>& cloud : clouds) {
    const Extraction found = search(cloud);
    EXPECT_TRUE(found.planes.empty()) << cloud.size();
    EXPECT_EQ(found.labels, std::vector<std::uint32_t>(cloud.size(), kNoPlane));
    EXPECT_EQ(found.noise, 0.0);
  }
}

inline void expect_far_clouds_to_be_found(const Search& search) {
  std::vector<Vec3> cloud = cloud_of(random_patch(7), 7);
  for (Vec3& p : cloud) p += Vec3(1e6, -1e6, 1e6);
  const Extraction found = search(cloud);
  ASSERT_EQ(found.planes.size(), 1u);
  EXPECT_GE(found.planes[0].members.size(), 450u);
  EXPECT_NEAR(std::abs(found.planes[0].normal.dot(random_patch(7).normal)), 1.0, 1e-3);
}

}  // namespace hallway::em::planted
