// SPDX-License-Identifier: MIT
#include "bsp/back_to_front.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "bsp/point_location.hpp"
#include "query_worlds.hpp"
#include "support/errors.hpp"
#include "support/long_mode.hpp"

namespace hallway {
namespace {

using test::QueryWorld;

/// When each leaf is visited.
std::vector<std::size_t> turns(const bsp::Tree& tree, const Vec3& eye) {
  std::vector<std::size_t> turn(tree.leaves.size(), std::numeric_limits<std::size_t>::max());
  std::size_t next = 0;
  bsp::back_to_front(tree, eye, [&](std::uint32_t leaf) {
    EXPECT_EQ(turn[leaf], std::numeric_limits<std::size_t>::max()) << "visited twice";
    turn[leaf] = next++;
  });
  EXPECT_EQ(next, tree.leaves.size());
  return turn;
}

/// The crossing of a ray with a polygon that shows it its front: the distance, infinite if there is none.
double crossing(const csg::Surface& surface, const csg::SurfacePolygon& polygon, const Vec3& eye,
                const Vec3& direction) {
  constexpr double kMissed = std::numeric_limits<double>::infinity();
  const double closing = -polygon.plane.normal.dot(direction);
  if (closing <= 1e-6 || polygon.vertices.empty()) return kMissed;
  const double distance = polygon.plane.distance(eye) / closing;
  const Vec3 point = eye + distance * direction;
  for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
    const Vec3& a = surface.vertices[polygon.vertices[i]];
    const Vec3 edge = surface.vertices[polygon.vertices[(i + 1) % polygon.vertices.size()]] - a;
    if (polygon.plane.normal.cross(edge).dot(point - a) <= 0.0) return kMissed;
  }
  return distance > 0.0 ? distance : kMissed;
}

Vec3 direction_of(const Random& random, std::uint32_t number) {
  return Vec3(random.normal(number, 0), random.normal(number, 1), random.normal(number, 2)).normalized();
}

TEST(BackToFront, LeavesAlongARayComeFarthestFirst) {
  for (const QueryWorld& world : test::made_worlds()) {
    const bsp::Tree& tree = world.compiled.tree;
    for (const Vec3& eye :
         {Vec3(5, 6, 1), Vec3(15, 2, 3), Vec3(-50, 3, 20), Vec3(4.5, 4.5, 0), Vec3(0, 0, 0)}) {
      const auto turn = turns(tree, eye);
      const Random random(12, stream_id("rays"));
      for (std::uint32_t i = 0; i < test::sized(500u, 5000u); ++i) {
        const Vec3 direction = direction_of(random, i);
        std::size_t last = std::numeric_limits<std::size_t>::max();
        for (double distance = 1e-3; distance < 60.0; distance += 0.07) {
          const std::size_t now = turn[bsp::leaf_at(tree, eye + distance * direction)];
          ASSERT_LE(now, last) << world.name << " ray " << i << " at " << distance;
          last = now;
        }
      }
    }
  }
}

/// Painted in order, the last face that covers a ray is the nearest.
TEST(BackToFront, ThePainterEndsWithWhatIsNearest) {
  for (const QueryWorld& world : test::made_worlds()) {
    const bsp::Tree& tree = world.compiled.tree;
    const csg::Surface& surface = world.compiled.surface;
    const Vec3 eye(15, 6, 2);
    std::vector<std::uint32_t> order;
    bsp::back_to_front(tree, eye, [&](std::uint32_t leaf) { order.push_back(leaf); });
    const Random random(13, stream_id("painter"));
    std::size_t painted_rays = 0;
    for (std::uint32_t i = 0; i < test::sized(200u, 3000u); ++i) {
      const Vec3 direction = direction_of(random, i);
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
        if (world.compiled.inside[p])
          nearest = std::min(nearest, crossing(surface, surface.polygons[p], eye, direction));
      }
      double painted = std::numeric_limits<double>::infinity();
      for (const std::uint32_t index : order) {
        const bsp::Leaf& leaf = tree.leaves[index];
        for (std::uint32_t k = 0; k < leaf.face_count; ++k) {
          const auto& polygon = surface.polygons[tree.leaf_faces[leaf.first_face + k]];
          const double distance = crossing(surface, polygon, eye, direction);
          // The part of the polygon in this leaf.
          if (std::isfinite(distance) && bsp::leaf_at(tree, eye + (distance - 1e-7) * direction) == index)
            painted = distance;
        }
      }
      ASSERT_EQ(painted, nearest) << world.name << " ray " << i;
      if (std::isfinite(painted)) ++painted_rays;
    }
    EXPECT_GT(painted_rays, 50u);
  }
}

TEST(BackToFront, RefusesAnEyeThatIsNowhere) {
  bsp::Tree tree;
  tree.leaves.resize(1);
  EXPECT_TRUE(test::error_of([&] { bsp::back_to_front(tree, {0, std::nan(""), 0}, [](std::uint32_t) {}); }));
  std::size_t visited = 0;
  bsp::back_to_front(tree, {0, 0, 0}, [&](std::uint32_t leaf) { visited += leaf + 1; });
  EXPECT_EQ(visited, 1u);
}

}  // namespace
}  // namespace hallway
