// SPDX-License-Identifier: MIT
// Three small maps, whose nodes and ways are worked out by hand from their corners and the drive.
#include "eval/topology_truth.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "unit/eval/wall_maps.hpp"

namespace hallway::eval {
namespace {

using test::Boundary;
using test::Drive;

constexpr double kInf = std::numeric_limits<double>::infinity();

/// A node as it is expected, with the ways at which the robot passes it.
struct Expected {
  TrueKind kind;
  int direction;
  double size_m;
  Vec2 from, to;
  bool is_demanded;
  std::vector<double> ways_m;
};

void expect_nodes(const TopologyTruth& truth, const std::vector<Expected>& expected) {
  ASSERT_EQ(truth.nodes.size(), expected.size());
  std::size_t passes = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    SCOPED_TRACE(i);
    const TrueNode& node = truth.nodes[i];
    EXPECT_EQ(node.kind, expected[i].kind);
    EXPECT_EQ(node.direction, expected[i].direction);
    if (expected[i].size_m == kInf) {
      EXPECT_EQ(node.size_m, kInf);
    } else {
      EXPECT_NEAR(node.size_m, expected[i].size_m, 1e-12);
    }
    EXPECT_LT((node.from - expected[i].from).norm(), 1e-12);
    EXPECT_LT((node.to - expected[i].to).norm(), 1e-12);
    EXPECT_EQ(node.is_demanded, expected[i].is_demanded);
    std::vector<double> ways;
    for (const TruePass& pass : truth.passes) {
      if (pass.node == i) ways.push_back(pass.way_m);
    }
    ASSERT_EQ(ways.size(), expected[i].ways_m.size());
    for (std::size_t k = 0; k < ways.size(); ++k) EXPECT_NEAR(ways[k], expected[i].ways_m[k], 1e-9);
    passes += ways.size();
  }
  EXPECT_EQ(truth.passes.size(), passes);
}

TopologyTruth truth_of(const Boundary& boundary, const Drive& drive) {
  return find_truth(test::plan_of(boundary), drive.way());
}

TEST(TopologyTruth, NicheIsAStepFartherAndAStepNearer) {
  // The drive begins at x = 0.6, so the niche's edges are abreast after 0.9 and 1.9 m. Its four sides are 3, 3.2, 3.2 and 3.2 m long: at 12.6 m the
  // robot is at x = 0.4, and passes them again after 1.1 and 2.1 m.
  const TopologyTruth truth = truth_of(test::niche_room(), test::niche_drive());
  expect_nodes(truth, {{TrueKind::kStep, 1, 0.3, {1.5, 0}, {1.5, 0}, true, {0.9, 13.7}},
                       {TrueKind::kStep, -1, 0.3, {2.5, 0}, {2.5, 0}, true, {1.9, 14.7}}});
  EXPECT_TRUE(truth.came_around);
}

TEST(TopologyTruth, DoorwaysLeadToARoomAndToAHallway) {
  // East from x = 1: the doorway begins after 2 m and ends after 3 m, the hallway begins after 6 m. The robot turns at x = 7.5 (6.5 m), is at the
  // hallway's end, 0.5 m from the wall, after 14.5 m, and going north from y = -7.5 (15 m) it is abreast of (8.5, 0) after
  // 22.5 m. There the first hallway goes on, whose other wall is 2 m ahead.
  const TopologyTruth truth = truth_of(test::doorway_hall(), test::doorway_drive());
  expect_nodes(truth, {{TrueKind::kRoom, 0, 1.0, {3, 0}, {4, 0}, true, {2.0}},
                       {TrueKind::kStep, 1, kInf, {3, 0}, {3, 0}, false, {2.0}},
                       {TrueKind::kStep, -1, kInf, {4, 0}, {4, 0}, false, {3.0}},
                       {TrueKind::kHallway, 0, 1.5, {7, 0}, {8.5, 0}, true, {6.0}},
                       {TrueKind::kStep, 1, kInf, {7, 0}, {7, 0}, false, {6.0}},
                       {TrueKind::kStep, -1, kInf, {7, 0}, {7, 0}, false, {6.0}},
                       {TrueKind::kDeadEnd, 0, 1.5, {7, -8}, {8.5, -8}, false, {14.5}},
                       {TrueKind::kHallway, 0, 2.0, {8.5, 0}, {8.5, 2}, true, {22.5}},
                       {TrueKind::kStep, 1, kInf, {8.5, 0}, {8.5, 0}, false, {22.5}},
                       {TrueKind::kStep, -1, kInf, {8.5, 0}, {8.5, 0}, false, {22.5}}});
  EXPECT_FALSE(truth.came_around);
}

TEST(TopologyTruth, StaggeredCorridorHasStepsAndADeadEnd) {
  // East from x = 0.5: steps after 2.5, 5.5 and 8.5 m, of which the last is too small to be demanded; the end after 10.8 m.
  const TopologyTruth truth = truth_of(test::staggered_corridor(), test::staggered_drive());
  expect_nodes(truth, {{TrueKind::kStep, -1, 0.2, {3, 0.2}, {3, 0.2}, true, {2.5}},
                       {TrueKind::kStep, 1, 0.3, {6, 0.2}, {6, 0.2}, true, {5.5}},
                       {TrueKind::kStep, -1, 0.1, {9, 0}, {9, 0}, false, {8.5}},
                       {TrueKind::kDeadEnd, 0, 1.8, {12, 0}, {12, 1.8}, false, {10.8}}});
  EXPECT_FALSE(truth.came_around);
}

TEST(TopologyTruth, OnlyWhatTheRobotDroveByIsThere) {
  Drive drive(1, 0.5, 0);
  drive.forward(4);  // past the doorway, not to the hallway
  const TopologyTruth truth = truth_of(test::doorway_hall(), drive);
  ASSERT_EQ(truth.nodes.size(), 3u);
  EXPECT_EQ(truth.nodes[0].kind, TrueKind::kRoom);
  // The other wall of the hallway has none of it.
  Drive other(15, 1.5, 180);
  other.forward(14);
  EXPECT_TRUE(truth_of(test::doorway_hall(), other).nodes.empty());
  // Nor has a way too far from the wall.
  Drive far(1, 1.2, 0);
  far.forward(15);
  EXPECT_TRUE(truth_of(test::doorway_hall(), far).nodes.empty());
}

TEST(TopologyTruth, HallwayThatIsPassedIsAHallway) {
  Drive drive(5, 0.5, 0);
  drive.forward(6);
  const TopologyTruth truth = truth_of(test::doorway_hall(), drive);
  expect_nodes(truth, {{TrueKind::kHallway, 0, 1.5, {7, 0}, {8.5, 0}, true, {2.0}},
                       {TrueKind::kStep, 1, kInf, {7, 0}, {7, 0}, false, {2.0}},
                       {TrueKind::kStep, -1, kInf, {8.5, 0}, {8.5, 0}, false, {3.5}}});
}

TEST(TopologyTruth, RoundAThinWallIsOneEnd) {
  // A wall of 3 x 0.1 m that stands free in a hall of 20 x 20 m.
  const Boundary boundary{{{-10, -10}, {10, -10}, {10, 10}, {-10, 10}}, {{0, 0.1}, {3, 0.1}, {3, 0}, {0, 0}}};
  Drive drive(0.5, 0.6, 0);
  drive.forward(3).right().forward(1.1).right().forward(2);
  expect_nodes(truth_of(boundary, drive), {{TrueKind::kWallEnd, 1, kInf, {3, 0.1}, {3, 0.1}, true, {2.5}},
                                           {TrueKind::kStep, 1, kInf, {3, 0.1}, {3, 0.1}, false, {2.5}},
                                           {TrueKind::kStep, -1, kInf, {3, 0}, {3, 0}, false, {2.5}}});
  drive.forward(1).right().forward(1.1).right().forward(2);
  EXPECT_TRUE(truth_of(boundary, drive).came_around);
}

TEST(TopologyTruth, RingOfHallwaysHasAnOpeningAtEachCornerOfItsBlock) {
  // A ring 2 m wide about a block of 4 x 4 m, from the middle of its western side: the corners are abreast 4.8 m apart, and the wall ahead
  // is 2 m away.
  const std::vector<Vec2> block{{2, 2}, {2, 6}, {6, 6}, {6, 2}};
  const Boundary ring{{{0, 0}, {8, 0}, {8, 8}, {0, 8}}, block};
  const TopologyTruth truth = truth_of(ring, test::drive_around(block, 0.4));
  std::vector<TrueNode> hallways;
  std::vector<std::vector<double>> ways;
  for (std::size_t i = 0; i < truth.nodes.size(); ++i) {
    if (!truth.nodes[i].is_demanded) continue;
    hallways.push_back(truth.nodes[i]);
    ways.emplace_back();
    for (const TruePass& pass : truth.passes) {
      if (pass.node == i) ways.back().push_back(pass.way_m);
    }
  }
  ASSERT_EQ(hallways.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(hallways[i].kind, TrueKind::kHallway);
    EXPECT_EQ(hallways[i].from, block[(i + 1) % 4]);
    EXPECT_NEAR(hallways[i].size_m, 2.0, 1e-12);
    EXPECT_NEAR(ways[i][0], 2.0 + 4.8 * static_cast<double>(i), 1e-9);
  }
  EXPECT_EQ(ways[0].size(), 1u) << "the drive ends before another wall is followed";
  EXPECT_TRUE(truth.came_around);

  // Along the outer wall there are inner corners only.
  const TopologyTruth outer = truth_of(ring, test::drive_around(ring[0], 0.4));
  EXPECT_TRUE(outer.nodes.empty());
  EXPECT_TRUE(outer.came_around);
}

TEST(TopologyTruth, RoundAndBevelledCornersAreCornersWhereTheyBegin) {
  // The ring again; the block's edges are rounded by 0.3 m in so many pieces.
  const std::vector<Vec2> block{{2, 2}, {2, 6}, {6, 6}, {6, 2}};
  for (const int pieces : {1, 3, 9}) {
    std::vector<Vec2> rounded;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec2 in = (block[i] - block[(i + 3) % 4]).normalized(),
                 out = (block[(i + 1) % 4] - block[i]).normalized();
      const Vec2 centre = block[i] - 0.3 * in + 0.3 * out;
      for (int k = 0; k <= pieces; ++k) {
        const double angle = k * std::numbers::pi / (2 * pieces);
        rounded.push_back(centre + 0.3 * (std::sin(angle) * in - std::cos(angle) * out));
      }
    }
    const Boundary ring{{{0, 0}, {8, 0}, {8, 8}, {0, 8}}, rounded};
    EXPECT_EQ(test::plan_of(ring).walls().size(), 8u);
    const TopologyTruth truth = truth_of(ring, test::drive_around(block, 0.4));
    std::size_t hallways = 0;
    for (const TrueNode& node : truth.nodes) {
      if (!node.is_demanded) continue;
      const Vec2& corner = block[(hallways + 1) % 4];
      EXPECT_EQ(node.kind, TrueKind::kHallway);
      EXPECT_NEAR((node.from - corner).norm(), 0.3, 1e-9);
      EXPECT_NEAR(node.size_m, 2.3, 1e-9);
      ++hallways;
    }
    EXPECT_EQ(hallways, 4u) << pieces;
    EXPECT_TRUE(truth.came_around);
  }
  // A doorway with round edges that is passed.
  const Boundary door{{{0, 0},
                       {2.8, 0},
                       {2.94, -0.06},
                       {3, -0.2},
                       {3, -4},
                       {4, -4},
                       {4, -0.2},
                       {4.06, -0.06},
                       {4.2, 0},
                       {9, 0},
                       {9, 2},
                       {0, 2}}};
  Drive drive(1, 0.4, 0);
  drive.forward(6);
  const TopologyTruth truth = truth_of(door, drive);
  ASSERT_EQ(truth.nodes.size(), 3u);
  EXPECT_EQ(truth.nodes[0].kind, TrueKind::kHallway);
  EXPECT_EQ(truth.nodes[0].from, Vec2(2.8, 0));
  EXPECT_EQ(truth.nodes[0].to, Vec2(4, -0.2));
}

TEST(TopologyTruth, OpeningBeforeAWallAhead) {
  // A hallway to the south in the corner of another one: the robot passes it and turns left along the wall ahead.
  const Boundary boundary{{{0, 0}, {9, 0}, {9, -6}, {10, -6}, {10, 2}, {0, 2}}};
  Drive drive(5, 0.5, 0);
  drive.forward(4.5).left().forward(1);
  expect_nodes(truth_of(boundary, drive), {{TrueKind::kHallway, 0, 1.0, {9, 0}, {10, 0}, true, {4.0}},
                                           {TrueKind::kStep, 1, kInf, {9, 0}, {9, 0}, false, {4.0}}});
}

TEST(TopologyTruth, DeepNicheIsARoomAndAnArcIsNoNode) {
  std::vector<Vec2> boundary{{0, 0}, {3, 0}, {3, -1.2}, {4, -1.2}, {4, 0}, {8, 0}};
  for (int i = 1; i <= 9; ++i) {  // a quarter of a circle of 2 m to the left
    const double angle = i * std::numbers::pi / 18;
    boundary.emplace_back(8 + 2 * std::sin(angle), 2 - 2 * std::cos(angle));
  }
  boundary.insert(boundary.end(), {{10, 8}, {0, 8}});
  Drive drive(1, 0.5, 0);
  drive.forward(7);
  for (int i = 0; i < 9; ++i) drive.turn(5).forward(0.26).turn(5);
  drive.forward(4);
  expect_nodes(truth_of({boundary}, drive), {{TrueKind::kRoom, 0, 1.0, {3, 0}, {4, 0}, true, {2.0}},
                                             {TrueKind::kStep, 1, kInf, {3, 0}, {3, 0}, false, {2.0}},
                                             {TrueKind::kStep, -1, kInf, {4, 0}, {4, 0}, false, {3.0}}});
}

TEST(TopologyTruth, DoorFramesAreNoSteps) {
  // The doorway into the hallway that ends, with a frame of 0.05 m that is 0.02 m proud of the walls, passed and entered.
  const Boundary boundary{{{0, 0},
                           {4, 0},
                           {4, 0.02},
                           {4.05, 0.02},
                           {4.05, -0.2},
                           {4, -0.2},
                           {4, -6},
                           {5.2, -6},
                           {5.2, -0.2},
                           {5.15, -0.2},
                           {5.15, 0.02},
                           {5.2, 0.02},
                           {5.2, 0},
                           {12, 0},
                           {12, 2},
                           {0, 2}}};
  Drive past(1, 0.5, 0);
  past.forward(8);
  Drive in(1, 0.5, 0);
  in.forward(3.6).right().forward(4);
  for (const Drive& drive : {past, in}) {
    const TopologyTruth truth = truth_of(boundary, drive);
    std::vector<TrueNode> demanded;
    for (const TrueNode& node : truth.nodes) {
      if (node.is_demanded) demanded.push_back(node);
      if (node.kind == TrueKind::kStep) {
        EXPECT_EQ(node.size_m, kInf);
      }
    }
    ASSERT_EQ(demanded.size(), 1u);
    EXPECT_EQ(demanded[0].kind, TrueKind::kHallway);
    EXPECT_NEAR(demanded[0].from.x(), 4.0, 0.051);
    EXPECT_NEAR(demanded[0].to.x(), 5.15, 0.051);
  }
}

TEST(TopologyTruth, TurnsInPlaceAndReversesFollowNothing) {
  Drive drive(0.6, 0.4, 0);
  drive.forward(0.7).turn(90).turn(-180).turn(90).forward(-0.4).forward(0.6).forward(-0.2).forward(2.1);
  const TopologyTruth truth = truth_of(test::niche_room(), drive);
  expect_nodes(truth, {{TrueKind::kStep, 1, 0.3, {1.5, 0}, {1.5, 0}, true, {0.9}},
                       {TrueKind::kStep, -1, 0.3, {2.5, 0}, {2.5, 0}, true, {1.9}}});
  EXPECT_FALSE(truth.came_around);
}

TEST(TopologyTruth, WholeRoundComesAroundAndMeetsEachOpeningFromBothSides) {
  const Boundary hall = test::doorway_hall();
  const Drive drive = test::drive_around(hall[0], 0.4);
  for (const bool wavers : {false, true}) {
    const DrivenWay way = wavers ? drive.wavering_way() : drive.way();
    const TopologyTruth truth = find_truth(test::plan_of(hall), way);
    EXPECT_TRUE(truth.came_around);
    std::vector<const TrueNode*> demanded;
    for (const TrueNode& node : truth.nodes) {
      if (node.is_demanded) demanded.push_back(&node);
    }
    // Into the room and out again, into the hallway and out again; the thickness of the doorway's wall adds nothing.
    ASSERT_EQ(demanded.size(), 4u);
    EXPECT_EQ(demanded[0]->kind, TrueKind::kRoom);
    EXPECT_EQ(demanded[0]->from, Vec2(3, 0));
    EXPECT_EQ(demanded[1]->kind, TrueKind::kHallway);
    EXPECT_EQ(demanded[1]->from, Vec2(4, -0.2));
    EXPECT_LT((demanded[1]->to - Vec2(3, -0.2)).norm(), 1e-12);
    EXPECT_EQ(demanded[2]->from, Vec2(7, 0));
    EXPECT_EQ(demanded[3]->from, Vec2(8.5, 0));
    EXPECT_EQ(demanded[3]->kind, TrueKind::kHallway);
  }
}

TEST(TopologyTruth, WaveringWayHasTheSameNodes) {
  const std::vector<std::pair<Boundary, Drive>> cases{{test::niche_room(), test::niche_drive()},
                                                      {test::doorway_hall(), test::doorway_drive()},
                                                      {test::staggered_corridor(), test::staggered_drive()}};
  for (const auto& [boundary, drive] : cases) {
    const TopologyTruth straight = truth_of(boundary, drive);
    const TopologyTruth wavering = find_truth(test::plan_of(boundary), drive.wavering_way());
    ASSERT_EQ(wavering.nodes.size(), straight.nodes.size());
    for (std::size_t i = 0; i < straight.nodes.size(); ++i) {
      EXPECT_EQ(wavering.nodes[i].kind, straight.nodes[i].kind);
      EXPECT_EQ(wavering.nodes[i].from, straight.nodes[i].from);
    }
    EXPECT_EQ(wavering.came_around, straight.came_around);
  }
}

TEST(TopologyTruth, RigidMotionChangesPlacesOnly) {
  const test::PlaneMotion motion{0.7, {-31.0, 12.5}};
  const std::vector<std::pair<Boundary, Drive>> cases{{test::niche_room(), test::niche_drive()},
                                                      {test::doorway_hall(), test::doorway_drive()},
                                                      {test::staggered_corridor(), test::staggered_drive()}};
  for (const auto& [boundary, drive] : cases) {
    const TopologyTruth here = truth_of(boundary, drive);
    const TopologyTruth there = find_truth(test::plan_of(boundary, motion), drive.way(motion));
    ASSERT_EQ(there.nodes.size(), here.nodes.size());
    for (std::size_t i = 0; i < here.nodes.size(); ++i) {
      EXPECT_EQ(there.nodes[i].kind, here.nodes[i].kind);
      EXPECT_EQ(there.nodes[i].direction, here.nodes[i].direction);
      EXPECT_EQ(there.nodes[i].is_demanded, here.nodes[i].is_demanded);
      if (std::isfinite(here.nodes[i].size_m)) {
        EXPECT_NEAR(there.nodes[i].size_m, here.nodes[i].size_m, 1e-9);
      }
      EXPECT_LT((there.nodes[i].from - motion * here.nodes[i].from).norm(), 1e-9);
      EXPECT_LT((there.nodes[i].to - motion * here.nodes[i].to).norm(), 1e-9);
    }
    ASSERT_EQ(there.passes.size(), here.passes.size());
    for (std::size_t i = 0; i < here.passes.size(); ++i)
      EXPECT_NEAR(there.passes[i].way_m, here.passes[i].way_m, 1e-9);
    EXPECT_EQ(there.came_around, here.came_around);
  }
}

TEST(TopologyTruth, NothingIsTrueOfNoWay) {
  const TopologyTruth truth = find_truth(test::plan_of(test::niche_room()), {});
  EXPECT_TRUE(truth.nodes.empty());
  EXPECT_FALSE(truth.came_around);
}

}  // namespace
}  // namespace hallway::eval
