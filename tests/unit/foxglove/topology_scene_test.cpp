// SPDX-License-Identifier: MIT
#include "foxglove/topology_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hallway::foxglove {
namespace {

log::TopologyNode node(std::uint32_t id, log::PlaceKind kind) {
  log::TopologyNode node{.id = id, .kind = kind};
  if (kind == log::PlaceKind::kDiscontinuity) {
    node.direction = 1;
    node.size_m = 0.5;
  }
  return node;
}

/// A place a metre to the left of the robot.
const std::optional<SeenPlace> kLeft{{Vec3(3, 1, 0), Vec3(3, 0, 0)}};

/// How far the arrow of a discontinuity of this direction and size goes along y.
double arrow_along_y(int direction, double size_m) {
  log::Topology topology{.nodes = {node(1, log::PlaceKind::kDiscontinuity)}};
  topology.nodes[0].direction = direction;
  topology.nodes[0].size_m = size_m;
  const Entity entity = topology_graph("world", topology, std::vector{kLeft});
  EXPECT_EQ(entity.lines.size(), 2u) << "a circle and an arrow";
  const std::vector<Vec3>& points = entity.lines.back().points;
  EXPECT_EQ(points.size(), 6u) << "a shaft and two barbs";
  EXPECT_EQ(points[1].x(), 3);
  EXPECT_NEAR(std::abs(points[0].y() - 1), 0.12, 1e-12) << "from the rim of the circle";
  return points[1].y() - points[0].y();
}

TEST(TopologyScene, ArrowsShowDirectionAndSizeOfTheStep) {
  EXPECT_NEAR(arrow_along_y(1, 0.5), 0.5, 1e-12) << "away from the robot";
  EXPECT_NEAR(arrow_along_y(-1, 0.25), -0.25, 1e-12) << "to the robot";
  EXPECT_NEAR(arrow_along_y(1, std::numeric_limits<double>::infinity()), 1.0, 1e-12);
  EXPECT_NEAR(arrow_along_y(1, 0.0), 0.1, 1e-12) << "seen at all";
}

TEST(TopologyScene, OtherPlacesAreSquaresWithACircleOrATriangle) {
  for (const auto& [kind, corners] :
       {std::pair(log::PlaceKind::kSweep, 24), std::pair(log::PlaceKind::kRoom, 3),
        std::pair(log::PlaceKind::kHallwayEnd, 24), std::pair(log::PlaceKind::kJunction, 3)}) {
    const Entity entity = topology_graph("world", {.nodes = {node(7, kind)}}, std::vector{kLeft});
    ASSERT_EQ(entity.lines.size(), 2u);
    EXPECT_EQ(entity.lines[0].points.size(), 5u) << "a square";
    EXPECT_EQ(entity.lines[1].points.size(), static_cast<std::size_t>(corners) + 1);
    EXPECT_EQ(entity.lines[1].points.front(), entity.lines[1].points.back());
    ASSERT_EQ(entity.texts.size(), 1u);
    EXPECT_EQ(entity.texts[0].text, "7");
  }
}

TEST(TopologyScene, WhatHasNoPlaceIsLeftOutWithItsEdges) {
  const log::Topology topology{.nodes = {node(1, log::PlaceKind::kRoom), node(2, log::PlaceKind::kRoom),
                                         node(3, log::PlaceKind::kRoom)},
                               .edges = {{.from = 1, .to = 2}, {.from = 1, .to = 3}}};
  const std::vector<std::optional<SeenPlace>> places{SeenPlace{Vec3(0, 0, 0)}, std::nullopt,
                                                     SeenPlace{Vec3(5, 0, 0)}};
  const Entity entity = topology_graph("map", topology, places);
  EXPECT_EQ(entity.frame, "map");
  EXPECT_EQ(entity.texts.size(), 2u);
  ASSERT_FALSE(entity.lines.empty());
  EXPECT_EQ(entity.lines[0].points, (std::vector<Vec3>{Vec3(0, 0, 0), Vec3(5, 0, 0)}));
}

TEST(TopologyScene, DrawingsHaveLinesAndTexts) {
  const log::Drawing drawing{{.closed = true, .points_m = {{0, 0}, {1, 0}, {1, 2}}},
                             {.kind = log::DrawingKind::kCircle, .radius_m = 0.5, .points_m = {{3, 4}}},
                             {.kind = log::DrawingKind::kText, .points_m = {{1, 1}}, .text = "go\x1b"}};
  const Entity entity = drawing_scene("body", drawing);
  EXPECT_EQ(entity.frame, "body");
  ASSERT_EQ(entity.lines.size(), 2u);
  EXPECT_EQ(entity.lines[0].points.size(), 4u);
  EXPECT_EQ(entity.lines[0].points.front(), entity.lines[0].points.back());
  for (const Vec3& point : entity.lines[1].points) EXPECT_NEAR((point - Vec3(3, 4, 0)).norm(), 0.5, 1e-12);
  ASSERT_EQ(entity.texts.size(), 1u);
  EXPECT_EQ(entity.texts[0].text, "go\\x1b");
}

}  // namespace
}  // namespace hallway::foxglove
