// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/plane_matcher.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/random.hpp"

namespace hallway::slam_plane::spatial {
namespace {

/// A rectangle of the floor.
AssociatedObservation floor_part(double x0, double y0, double x1, double y1, double z = 0.0) {
  PlaneObservation plane;
  plane.normal = Vec3::UnitZ();
  plane.outline = {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
  plane.centre = Vec3(0.5 * (x0 + x1), 0.5 * (y0 + y1), z);
  return observation_of(plane, 0);
}

/// A map that saw each of some observations a number of times, as a plane of its own.
PlaneMap map_of(const std::vector<AssociatedObservation>& observations, int times = 10) {
  PlaneMap map{Options{}};
  map.activate(map.add_submap(Pose{}));
  for (AssociatedObservation observation : observations) {
    observation.landmark = map.add_landmark();
    for (int i = 0; i < times; ++i) map.observe(Pose{}, observation, 1);
    map.landmarks[observation.landmark].last_seen = 1;
  }
  return map;
}

TEST(SpatialFaceMatcher, ASightingIsTheFaceThatExplainsMostOfIt) {
  const PlaneMap map = map_of({floor_part(0, 3.96, 4, 4), floor_part(0, 0, 4, 4)});
  std::vector<AssociatedObservation> frame{floor_part(0.5, 0.5, 3.9, 4.0)};
  PlaneMatcher(Options{}).match_map(map, Pose{}, frame);
  EXPECT_EQ(frame[0].landmark, 1u) << "a face within it is not it, though all of that face is in view";
}

TEST(SpatialFaceMatcher, NeighboursThatTouchAreTwoFaces) {
  const PlaneMap map = map_of({floor_part(0, 0, 4, 4), floor_part(0, 4, 4, 5)});
  // Of the smaller one a strip is seen, more than half of it over the border as the pose has it.
  std::vector<AssociatedObservation> frame{floor_part(0, 4.0, 4, 4.06), floor_part(0, 0, 4, 4)};
  PlaneMatcher(Options{}).match_map(map, {Quat::Identity(), Vec3(0, -0.04, 0)}, frame);
  EXPECT_EQ(frame[1].landmark, 0u);
  EXPECT_NE(frame[0].landmark, 0u);
  // Alone it may be either.
  frame.erase(frame.begin() + 1);
  frame[0].landmark = kNone;
  PlaneMatcher(Options{}).match_map(map, {Quat::Identity(), Vec3(0, -0.04, 0)}, frame);
  EXPECT_EQ(frame[0].landmark, 0u);
}

TEST(SpatialFaceMatcher, PartsThatLieApartMayBeOneFace) {
  const PlaneMap map = map_of({floor_part(0, 0, 4, 4)});
  std::vector<AssociatedObservation> frame{floor_part(0, 0, 1.5, 4), floor_part(2, 0, 4, 4)};
  PlaneMatcher(Options{}).match_map(map, Pose{}, frame);
  EXPECT_EQ(frame[0].landmark, 0u);
  EXPECT_EQ(frame[1].landmark, 0u);
}

TEST(SpatialFaceMatcher, OutlinesEndAtCertainEdges) {
  PlaneMap map{Options{}};
  map.activate(map.add_submap(Pose{}));
  const Index face = map.add_landmark();
  for (int i = 0; i < 50; ++i) {
    // Its edge is seen up to 2 cm farther or nearer.
    AssociatedObservation observation = floor_part(0, 0, 4, 4.0 + 0.02 * std::sin(i));
    observation.landmark = face;
    observation.edges[2].is_true = true;
    map.observe(Pose{}, observation, 1);
  }
  EXPECT_EQ(map.certain_edges(), 1u);
  const Box box = box_of(map.landmarks[face].outline);
  EXPECT_NEAR(box.max().y(), 4.0, 0.002);
  EXPECT_NEAR(box.min().y(), 0.0, 1e-9);
}

TEST(SpatialFaceMatcher, WhatIsNarrowerThanNoiseIsASliver) {
  const Noise noise = Options{}.noise();
  EXPECT_TRUE(is_sliver(floor_part(0, 0, 3, 0.02), noise));
  EXPECT_FALSE(is_sliver(floor_part(0, 0, 3, 0.04), noise));
}

/// Rectangles all over a large hall, turned as chance will have it.
AssociatedObservation panel(const Random& random, std::uint32_t key) {
  const Vec3 middle(random.uniform(key, 0, -40.0, 40.0), random.uniform(key, 1, -40.0, 40.0),
                    random.uniform(key, 2, 0.0, 8.0));
  const Quat turn =
      rotation_by(Vec3(random.uniform(key, 3, -3.0, 3.0), random.uniform(key, 4, -3.0, 3.0), 0.0));
  const double a = random.uniform(key, 5, 0.2, 6.0), b = random.uniform(key, 6, 0.2, 6.0);
  PlaneObservation plane;
  plane.normal = turn * Vec3::UnitZ();
  plane.centre = middle;
  for (const auto& [u, v] : {std::pair(-a, -b), std::pair(a, -b), std::pair(a, b), std::pair(-a, b)})
    plane.outline.push_back(middle + turn * Vec3(u, v, 0.0));
  return observation_of(plane, 0);
}

TEST(SpatialFaceMatcher, TheIndexOverlooksNothing) {
  const Random random(1, stream_id("plane_matcher_test"));
  std::vector<AssociatedObservation> panels;
  for (std::uint32_t i = 0; i < 150; ++i) panels.push_back(panel(random, i));
  const PlaneMap map = map_of(panels, 1);
  PlaneMatcher matcher{Options{}};
  const double bound = Options{}.map_bound_m;
  int found = 0;
  for (std::uint32_t i = 0; i < 150; ++i) {
    const Vec3 step(random.normal(i, 10), random.normal(i, 11), random.normal(i, 12));
    const Vec3 turn(random.normal(i, 13), random.normal(i, 14), random.normal(i, 15));
    const Pose T{rotation_by(0.03 * turn), 0.1 * step};
    std::vector<AssociatedObservation> frame{panels[i]};
    matcher.match_map(map, T, frame);
    Index best = kNone;
    double most = 0.0;
    for (Index f = 0; f < map.landmarks.size(); ++f) {
      const double score = matcher.score(map.landmarks[f], panels[i], T, bound);
      if (score > most) {
        most = score;
        best = f;
      }
    }
    EXPECT_EQ(frame[0].landmark, best);
    found += best == kNone ? 0 : 1;
  }
  EXPECT_GT(found, 30);
}

TEST(SpatialFaceIndex, FindsTheFacesWhoseBoxesTouchAndNoOthers) {
  const Random random(2, stream_id("face_index_test"));
  PlaneIndex index;
  std::vector<Box> boxes;
  for (std::uint32_t i = 0; i < 200; ++i) {
    // Some are put twice, some are too large for the grid, some are taken out again.
    for (const std::uint32_t key : {i + 1000, i}) {
      std::vector<Vec3> outline = panel(random, key).outline;
      if (i % 20 == 0) outline.emplace_back(300.0, 300.0, 300.0);
      index.put(i, outline);
      if (key == i) boxes.push_back(box_of(outline));
    }
    if (i % 7 == 0) {
      index.remove(i);
      boxes.back() = Box();
    }
  }
  std::vector<Index> found;
  for (std::uint32_t i = 0; i < 100; ++i) {
    Box box = box_of(panel(random, i + 5000).outline);
    if (i % 10 == 0) box.extend(Vec3(-200.0, -200.0, -200.0));
    index.find(box, found);
    std::vector<Index> expected;
    for (Index k = 0; k < boxes.size(); ++k) {
      if (!boxes[k].isEmpty() && boxes[k].intersects(box)) expected.push_back(k);
    }
    EXPECT_EQ(found, expected);
  }
}

}  // namespace
}  // namespace hallway::slam_plane::spatial
