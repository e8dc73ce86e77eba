// SPDX-License-Identifier: MIT
#include "slam_point/core/places/constellation_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "scenes.hpp"

namespace hallway::slam_point {
namespace {

constexpr double kTolerance_m = 0.2;

/// A graph of one submap that knows all `points`, each seen five times.
SubmapGraph graph_of(const std::vector<Vec3>& points) {
  SubmapGraph graph(1.0);
  const Index submap = graph.add_submap(Pose{});
  for (const Vec3& p : points) {
    const Index landmark = graph.add_landmark(p, 0);
    const Index member = graph.join(submap, landmark, p, true);
    graph.submaps[submap].members[member].count = 5;
    graph.resum(landmark);
  }
  return graph;
}

std::vector<Vec3> scattered(int count, std::uint64_t seed) {
  scenes::Random random(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i)
    points.push_back(Vec3(random.uniform(0, 30), random.uniform(0, 30), random.uniform(0, 8)));
  return points;
}

/// All points by distance from one of them: the oracle of NearestNeighbours.
std::vector<Index> by_distance(const std::vector<Vec3>& points, Index centre) {
  std::vector<Index> others;
  for (Index i = 0; i < points.size(); ++i) {
    if (i != centre) others.push_back(i);
  }
  std::stable_sort(others.begin(), others.end(), [&](Index a, Index b) {
    return (points[a] - points[centre]).squaredNorm() < (points[b] - points[centre]).squaredNorm();
  });
  return others;
}

TEST(Triangle, VerticesLieOppositeFallingSides) {
  // 3-4-5: the right angle at point 7.
  const Triangle t = make_triangle({9, 7, 8}, {Vec3(3, 0, 0), Vec3(0, 0, 0), Vec3(0, 4, 0)});
  EXPECT_EQ(t.vertices[0], 7u);
  EXPECT_EQ(t.vertices[1], 9u);
  EXPECT_EQ(t.vertices[2], 8u);
  EXPECT_DOUBLE_EQ(t.sides[0], 5.0);
  EXPECT_DOUBLE_EQ(t.sides[1], 4.0);
  EXPECT_DOUBLE_EQ(t.sides[2], 3.0);
}

TEST(NearestNeighbours, AreThoseThatSortingAllGives) {
  const std::vector<Vec3> points = scattered(50, 1);
  for (Index centre = 0; centre < points.size(); ++centre) {
    NearestNeighbours near;
    for (Index i = 0; i < points.size(); ++i) {
      if (i != centre) near.add(i, (points[i] - points[centre]).squaredNorm());
    }
    const std::vector<Index> expected = by_distance(points, centre);
    ASSERT_EQ(near.size(), NearestNeighbours::kMost);
    for (std::size_t i = 0; i < near.size(); ++i) EXPECT_EQ(near[i], expected[i]);
  }
}

TEST(ConstellationIndex, FindsTheTrianglesOfNeighboursAndNoOthers) {
  const std::vector<Vec3> points = scattered(60, 2);
  const SubmapGraph graph = graph_of(points);
  ConstellationIndex index(graph, kTolerance_m, 5);
  index.note(0);
  index.advance(1000);
  std::set<std::array<Index, 3>> all;
  std::vector<Triangle> triangles;
  for (Index centre = 0; centre < points.size(); ++centre) {
    const std::vector<Index> near = by_distance(points, centre);
    for (std::size_t i = 0; i < NearestNeighbours::kMost; ++i) {
      for (std::size_t j = i + 1; j < NearestNeighbours::kMost; ++j) {
        const Triangle t =
            make_triangle({centre, near[i], near[j]}, {points[centre], points[near[i]], points[near[j]]});
        if (t.sides[2] >= 2.0 * kTolerance_m && all.insert(t.vertices).second) triangles.push_back(t);
      }
    }
  }
  EXPECT_EQ(index.triangles(), triangles.size());
  scenes::Random random(3);
  for (const Triangle& t : triangles) {
    Sides asked = t.sides;
    for (double& side : asked) side += random.uniform(-0.9, 0.9) * kTolerance_m;
    std::multiset<std::array<Index, 3>> expected;
    for (const Triangle& other : triangles) {
      bool like = true;
      for (std::size_t i = 0; i < 3; ++i) like = like && std::abs(other.sides[i] - asked[i]) <= kTolerance_m;
      if (like) expected.insert(other.vertices);
    }
    std::multiset<std::array<Index, 3>> found;
    index.visit_like(asked, [&](const Triangle& like) {
      found.insert(like.vertices);
      return true;
    });
    EXPECT_EQ(found, expected);
    EXPECT_EQ(found.count(t.vertices), 1u);
  }
}

TEST(ConstellationIndex, VisitsUntilToldToStop) {
  const SubmapGraph graph = graph_of({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {0, -4, 0}});
  ConstellationIndex index(graph, kTolerance_m, 5);
  index.note(0);
  index.advance(1000);
  int visits = 0;
  index.visit_like({5.0, 4.0, 3.0}, [&](const Triangle&) { return ++visits < 1; });
  EXPECT_EQ(visits, 1);
}

TEST(ConstellationIndex, WhatWasSeenSeldomWaits) {
  SubmapGraph graph = graph_of(scattered(10, 4));
  for (LandmarkRecord& landmark : graph.landmarks) landmark.count = 2;
  ConstellationIndex index(graph, kTolerance_m, 5);
  index.note(0);
  index.advance(1000);
  EXPECT_EQ(index.triangles(), 0u);
  index.add_now(0, 64);
  EXPECT_GT(index.triangles(), 0u);
}

TEST(ConstellationIndex, HoldsEachTriangleOnceHoweverManyAreLikeIt) {
  // On a lattice, shaken so that no two sides are equal, nearly all triangles have the sides of many others.
  scenes::Random random(6);
  std::vector<Vec3> points;
  for (int i = 0; i < 400; ++i)
    points.push_back(Vec3(2.0 * (i % 20), 2.0 * (i / 20), 0.0) +
                     0.01 * Vec3(random.normal(), random.normal(), 0.0));
  const SubmapGraph graph = graph_of(points);
  ConstellationIndex index(graph, kTolerance_m, 5);
  for (int look = 0; look < 3; ++look) {
    index.note(0);
    index.advance(1000);
    index.add_now(0, 400);
  }
  std::set<std::set<Index>> visited;
  std::size_t visits = 0;
  for (const Sides& sides : {Sides{2.83, 2.0, 2.0}, Sides{4.0, 2.0, 2.0}}) {
    index.visit_like(sides, [&](const Triangle& triangle) {
      visited.insert({triangle.vertices.begin(), triangle.vertices.end()});
      ++visits;
      return true;
    });
  }
  EXPECT_GT(visits, 400u);
  EXPECT_EQ(visited.size(), visits);
}

TEST(ConstellationIndex, IsMadeInSlicesAsAtOnce) {
  const SubmapGraph graph = graph_of(scattered(60, 5));
  ConstellationIndex sliced(graph, kTolerance_m, 5);
  ConstellationIndex whole(graph, kTolerance_m, 5);
  sliced.note(0);
  whole.note(0);
  whole.advance(1000);
  for (int call = 0; call < 59; ++call) {
    sliced.advance(1);
    EXPECT_LE(sliced.triangles(), whole.triangles());
  }
  sliced.advance(1);
  EXPECT_EQ(sliced.triangles(), whole.triangles());
  // Again and again the same submap adds nothing.
  for (int more = 0; more < 5; ++more) {
    whole.note(0);
    whole.advance(1000);
  }
  EXPECT_EQ(sliced.triangles(), whole.triangles());
}

}  // namespace
}  // namespace hallway::slam_point
