// SPDX-License-Identifier: MIT
// Worlds whose leaves, clusters and portals are known by heart. Their unit is a metre.
#include "bsp/compile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "compiled_checks.hpp"
#include "support/random_brushes.hpp"

namespace hallway::bsp {
namespace {

using test::box;
using test::MapMaker;
using test::room;

/// Somebody stands at x = 7, y = 5, z = 2.
Compiled compiled(const MapMaker& maker) {
  const map::World world = maker.world();
  EXPECT_TRUE(world.problems.empty());
  Compiled out = compile(world, {Vec3(7, 5, 2)}, {});
  test::Compared compared;
  int passed = 0;
  EXPECT_EQ(test::wrong_content(world, out, 1, 2000, compared), "");
  EXPECT_EQ(test::wrong_portal(world, out), "");
  EXPECT_EQ(test::missing_portal(world, out, 1, 500, 3.0, passed), "");
  EXPECT_EQ(test::wrong_inside_flag(world, out), "");
  return out;
}

MapMaker one_room() {
  return MapMaker(1.0).add(room({0, 0, 0}, {8, 6, 3}, 1.0));
}

MapMaker two_rooms() {
  // A wall at x = 8..9 with a door of 2 x 2.
  return MapMaker(1.0)
      .add(room({0, 0, 0}, {17, 6, 3}, 1.0))
      .add(box({8, 0, 0}, {9, 2, 3}))
      .add(box({8, 4, 0}, {9, 6, 3}))
      .add(box({8, 2, 2}, {9, 4, 3}));
}

Content content_at(const Compiled& world, const Vec3& point) {
  return world.tree.leaves[leaf_at(world.tree, point)].content;
}

/// Portals in a form that can be compared without regard to their order and the clusters' numbers.
std::vector<std::tuple<double, double, double, double>> shapes(const PortalGraph& graph) {
  std::vector<std::tuple<double, double, double, double>> out;
  for (const Portal& portal : graph.portals) {
    const Vec3 middle = test::middle_of(portal.polygon);
    double area = 0.0;
    for (std::size_t i = 2; i < portal.polygon.vertices.size(); ++i) {
      area += (portal.polygon.vertices[i - 1] - portal.polygon.vertices[0])
                  .cross(portal.polygon.vertices[i] - portal.polygon.vertices[0])
                  .norm();
    }
    out.emplace_back(middle.x(), middle.y(), middle.z(), area);
  }
  std::sort(out.begin(), out.end());
  return out;
}

TEST(Compile, AWorldOfNothing) {
  const Compiled world = compiled(MapMaker(1.0));
  EXPECT_TRUE(world.surface.polygons.empty());
  EXPECT_FALSE(world.enclosure.sealed);
  EXPECT_EQ(world.tree.leaves.size(), 1u);
  EXPECT_EQ(content_at(world, Vec3::Zero()), Content::kEmpty);
  EXPECT_EQ(world.tree.clusters, 1u);
}

TEST(Compile, AnEmptyRoomIsOneCluster) {
  const Compiled world = compiled(one_room());
  EXPECT_TRUE(world.enclosure.sealed);
  EXPECT_EQ(world.tree.clusters, 1u);
  EXPECT_TRUE(world.portals.portals.empty());
  EXPECT_EQ(content_at(world, {4, 3, 1.5}), Content::kEmpty);
  EXPECT_EQ(content_at(world, {-0.5, 3, 1.5}), Content::kSolid) << "in the wall";
  EXPECT_EQ(content_at(world, {-5, 3, 1.5}), Content::kSolid) << "the void";
  std::size_t inside = 0;
  for (std::size_t i = 0; i < world.inside.size(); ++i) inside += world.inside[i] ? 1u : 0u;
  EXPECT_EQ(inside, 6u) << "the six faces that look into the room";
  EXPECT_EQ(world.tree.nodes.size(), 6u) << "what only the void touches divides nothing";
}

TEST(Compile, APointOnAFloorIsInTheRoomAboveIt) {
  const Compiled world = compiled(one_room());
  EXPECT_EQ(content_at(world, {4, 3, 0}), Content::kEmpty);
}

TEST(Compile, TwoRoomsAndADoor) {
  const Compiled world = compiled(two_rooms());
  EXPECT_TRUE(world.enclosure.sealed);
  EXPECT_GE(world.tree.clusters, 3u);
  const std::int32_t left = cluster_at(world.tree, {4, 3, 1});
  const std::int32_t right = cluster_at(world.tree, {13, 3, 1});
  EXPECT_NE(left, right);
  double door = 0.0;  // what can be passed at x = 8
  for (const Portal& portal : world.portals.portals) {
    if (std::abs(portal.polygon.plane.normal.x()) < 0.9 ||
        std::abs(test::middle_of(portal.polygon).x() - 8.0) > 0.1)
      continue;
    for (std::size_t i = 2; i < portal.polygon.vertices.size(); ++i) {
      door += 0.5 * (portal.polygon.vertices[i - 1] - portal.polygon.vertices[0])
                        .cross(portal.polygon.vertices[i] - portal.polygon.vertices[0])
                        .norm();
    }
  }
  EXPECT_NEAR(door, 4.0, 1e-9);
}

TEST(Compile, DetailDividesNoVisibility) {
  MapMaker with = two_rooms();
  with.detail(box({3, 3, 0}, {4, 4, 3}, "pillar")).detail(box({10, 1, 0}, {16, 2, 1}, "table"));
  with.detail(box({8, 2, 0}, {9, 4, 2}, "shut"));  // fills the door
  const Compiled plain = compiled(two_rooms());
  const Compiled detailed = compiled(with);
  EXPECT_TRUE(detailed.enclosure.sealed);
  EXPECT_EQ(detailed.tree.clusters, plain.tree.clusters);
  EXPECT_EQ(shapes(detailed.portals), shapes(plain.portals));
  EXPECT_EQ(content_at(detailed, {3.5, 3.5, 1}), Content::kSolid);
  EXPECT_EQ(content_at(detailed, {8.5, 3, 1}), Content::kSolid);
  EXPECT_EQ(cluster_at(detailed.tree, {2, 3, 1}), cluster_at(detailed.tree, {5, 5, 1}))
      << "both sides of the pillar";
  EXPECT_GT(detailed.tree.leaves.size(), plain.tree.leaves.size());
}

TEST(Compile, ManyPiecesOfDetailMoveNoPortal) {
  MapMaker with = two_rooms();
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int i = 0; i < 60; ++i) {
    const double x = 16.0 * share(random), y = 5.0 * share(random);
    const Vec3 low(x, y, 2.0 * share(random));
    with.detail(test::random_polyhedron(random, low, 0.2));
  }
  const Compiled plain = compiled(two_rooms());
  const Compiled detailed = compiled(with);
  EXPECT_EQ(detailed.tree.clusters, plain.tree.clusters);
  EXPECT_EQ(shapes(detailed.portals), shapes(plain.portals));
}

TEST(Compile, AWorldOfDetailAloneIsOneCluster) {
  MapMaker maker(1.0);
  maker.detail(box({0, 0, 0}, {1, 1, 1})).detail(box({2, 0, 0}, {3, 4, 1}));
  const Compiled world = compiled(maker);
  EXPECT_FALSE(world.enclosure.sealed);
  EXPECT_EQ(world.tree.clusters, 1u);
  EXPECT_EQ(content_at(world, {0.5, 0.5, 0.5}), Content::kSolid);
}

TEST(Compile, ACellFullOfDetailIsSolid) {
  MapMaker maker = two_rooms();
  maker.detail(box({-0.5, -0.5, -0.5}, {8, 6.5, 3.5}));  // the whole left room, and some of its walls
  const Compiled world = compiled(maker);
  EXPECT_EQ(content_at(world, {4, 3, 1}), Content::kSolid);
  EXPECT_EQ(content_at(world, {13, 3, 1}), Content::kEmpty);
}

TEST(Compile, ARoomFilledWithDetailIsSolidThroughout) {
  MapMaker maker = one_room();
  maker.detail(box({-0.5, -0.5, -0.5}, {8.5, 6.5, 3.5}));  // no face of it is left inside
  const Compiled world = compiled(maker);
  EXPECT_EQ(content_at(world, {4, 3, 1}), Content::kSolid);
  EXPECT_TRUE(world.enclosure.sealed);
}

TEST(Compile, AHintSplits) {
  MapMaker maker = one_room();
  maker.hint(box({-0.5, -0.5, -0.5}, {4, 6.5, 3.5}));
  const Compiled world = compiled(maker);
  EXPECT_EQ(world.tree.clusters, 2u);
  ASSERT_EQ(world.portals.portals.size(), 1u);
  EXPECT_EQ(std::get<0>(shapes(world.portals)[0]), 4.0);
  EXPECT_DOUBLE_EQ(std::get<3>(shapes(world.portals)[0]), 2.0 * 18.0);
  EXPECT_EQ(world.surface.polygons.size(), compiled(one_room()).surface.polygons.size());
}

TEST(Compile, AHintFarBeyondTheWallsMakesNoPortalThatIsNone) {
  MapMaker maker = one_room();
  maker.hint(box({500, 500, 500}, {600, 600, 600}));
  EXPECT_EQ(compiled(maker).tree.clusters, 1u);
  MapMaker hints(1.0);
  hints.hint(box({100, -21, 4}, {101, -20, 5})).hint(box({100, -20, 3}, {103, -19, 6}));
  const Compiled alone = compiled(hints);
  EXPECT_TRUE(alone.surface.polygons.empty());
  EXPECT_TRUE(alone.tree.bounds.contains(Vec3(103, -21, 6)));
}

TEST(Compile, TheSameBytesEachTime) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const map::World world =
        map::build_world(test::document_of(test::RandomActs(test::WorldKind::kTurned, seed).make()));
    const std::vector<Vec3> occupants{world.bounds.min() - Vec3::Ones()};
    const Compiled a = compile(world, occupants, {});
    const Compiled b = compile(world, occupants, {});
    ASSERT_EQ(a.tree.nodes.size(), b.tree.nodes.size());
    for (std::size_t i = 0; i < a.tree.nodes.size(); ++i) {
      ASSERT_EQ(a.tree.normals[i], b.tree.normals[i]);
      ASSERT_EQ(a.tree.nodes[i].offset, b.tree.nodes[i].offset);
      ASSERT_EQ(a.tree.nodes[i].child, b.tree.nodes[i].child);
    }
    ASSERT_EQ(a.tree.leaf_faces, b.tree.leaf_faces);
    ASSERT_EQ(a.portals.portals.size(), b.portals.portals.size());
    for (std::size_t i = 0; i < a.portals.portals.size(); ++i) {
      ASSERT_EQ(a.portals.portals[i].polygon.vertices, b.portals.portals[i].polygon.vertices);
      ASSERT_EQ(a.portals.portals[i].cluster, b.portals.portals[i].cluster);
    }
    ASSERT_EQ(a.enclosure.leak.has_value(), b.enclosure.leak.has_value());
    if (a.enclosure.leak) {
      ASSERT_EQ(a.enclosure.leak->way, b.enclosure.leak->way);
    }
  }
}

}  // namespace
}  // namespace hallway::bsp
