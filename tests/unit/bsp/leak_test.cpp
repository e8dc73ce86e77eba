// SPDX-License-Identifier: MIT
// Rooms with holes made on purpose. Map units are centimetres.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "bsp/compile.hpp"
#include "compiled_checks.hpp"
#include "support/brushes.hpp"

namespace hallway::bsp {
namespace {

using test::box;
using test::Counting;
using test::MapMaker;
using test::room;

constexpr double kUnit_m = 0.01;
constexpr double kRim_m = 0.64;  ///< from the world's box to where the void ends

/// A room of 8 x 6 x 3 m with walls of 20 cm, by name of wall: 0 floor, 1 ceiling, 2 -x, 3 +x, 4 -y, 5 +y.
std::vector<map::Brush> walls() {
  return room({0, 0, 0}, {800, 600, 300}, 20.0);
}

MapMaker without(std::size_t wall, const std::vector<map::Brush>& instead = {}) {
  std::vector<map::Brush> brushes = walls();
  brushes.erase(brushes.begin() + static_cast<std::ptrdiff_t>(wall));
  return MapMaker(kUnit_m).add(brushes).add(instead);
}

/// The wall +x as four boxes around a hole of y0..y1, z0..z1.
std::vector<map::Brush> wall_with_hole(double y0, double y1, double z0, double z1) {
  std::vector<map::Brush> out;
  const auto add = [&](double ya, double yb, double za, double zb) {
    if (yb > ya && zb > za) out.push_back(box({800, ya, za}, {820, yb, zb}));
  };
  add(-20, y0, 0, 300);
  add(y1, 620, 0, 300);
  add(y0, y1, 0, z0);
  add(y0, y1, z1, 300);
  return out;
}

struct Made {
  Made(const MapMaker& maker, const std::vector<Vec3>& occupants_m, SplitRule rule = SplitRule::kBalanced)
      : world(maker.world()),
        compiled(compile(world, occupants_m, {{.rule = rule}})),
        occupants(occupants_m) {
    EXPECT_TRUE(world.problems.empty());
    check_way();
  }

  const Enclosure& enclosure() const { return compiled.enclosure; }

  /// Starts at the occupant, runs through empty space, ends beyond the world.
  void check_way() const {
    ASSERT_EQ(enclosure().leak.has_value(), !enclosure().leaking.empty());
    if (!enclosure().leak) return;
    const Leak& leak = *enclosure().leak;
    ASSERT_GE(leak.way.size(), 2u);
    EXPECT_EQ(leak.way.front(), occupants[leak.occupant]);
    EXPECT_FALSE(world.bounds.contains(leak.way.back()));
    double length = 0.0;
    for (std::size_t i = 0; i + 1 < leak.way.size(); ++i) {
      const Vec3 along = leak.way[i + 1] - leak.way[i];
      length += along.norm();
      const int samples = 2 + static_cast<int>(along.norm() / 0.0005);
      for (int k = 0; k <= samples; ++k) {
        const Vec3 at = leak.way[i] + along * (static_cast<double>(k) / samples);
        for (const map::Solid& solid : world.solids) {
          if (solid.role != map::BrushRole::kAdd || !solid.contains(at, 1e-6)) continue;
          ASSERT_FALSE(test::brushes_solid(world, at, Counting::kStructure) &&
                       !test::near_a_face(world, at, 1e-6))
              << "the way runs through solid at " << at.transpose();
        }
      }
    }
    EXPECT_NEAR(length, leak.length_m, 1e-9);
  }

  void expect_leak(double shortest_m, double width_m, double height_m) const {
    EXPECT_FALSE(enclosure().sealed);
    ASSERT_TRUE(enclosure().leak.has_value());
    const Leak& leak = *enclosure().leak;
    EXPECT_LE(leak.length_m, 1.3 * shortest_m);
    EXPECT_GE(leak.length_m, 0.999 * shortest_m);
    EXPECT_NEAR(leak.narrowest.width_m / width_m, 1.0, 0.01);
    EXPECT_NEAR(leak.narrowest.height_m / height_m, 1.0, 0.01);
    EXPECT_FALSE(leak.narrowest.polygons.empty());
  }

  map::World world;
  Compiled compiled;
  std::vector<Vec3> occupants;
};

const Vec3 kMiddle_m(4.0, 3.0, 1.5);
constexpr std::array kRules{SplitRule::kBalanced, SplitRule::kAxialFirst, SplitRule::kNaive};

TEST(Leak, AClosedRoomHasNone) {
  const Made made(MapMaker(kUnit_m).add(walls()), {kMiddle_m});
  EXPECT_TRUE(made.enclosure().sealed);
  EXPECT_TRUE(made.enclosure().leaking.empty());
  EXPECT_TRUE(made.enclosure().in_solid.empty());
}

TEST(Leak, AMissingWall) {
  const Made made(without(3), {kMiddle_m});
  // Floor and ceiling reach on to x = 8.2 m; the rim is 64 units beyond them.
  made.expect_leak(4.2 + kRim_m, 3.0, 6.0);
  EXPECT_NEAR(made.enclosure().leak->way.back().x(), 8.2 + kRim_m, 1e-6);
}

TEST(Leak, EachMissingWallIsFound) {
  for (std::size_t wall = 0; wall < 6; ++wall) {
    const Made made(without(wall), {kMiddle_m});
    EXPECT_FALSE(made.enclosure().sealed) << wall;
    EXPECT_TRUE(made.enclosure().leak.has_value()) << wall;
  }
}

TEST(Leak, AGapOfAMillimetre) {
  const Made made(without(3, wall_with_hole(300, 300.1, 0, 300)), {kMiddle_m});
  made.expect_leak(4.2 + kRim_m, 0.001, 3.0);
  EXPECT_NEAR(made.enclosure().leak->narrowest.at.y(), 3.0005, 0.001);
  EXPECT_GT(made.enclosure().leak->narrowest.at.x(), 7.99);
  EXPECT_LT(made.enclosure().leak->narrowest.at.x(), 8.21);
}

TEST(Leak, AGapUnderADoor) {
  const Made made(without(3, wall_with_hole(250, 350, 0, 0.5)), {kMiddle_m});
  made.expect_leak(std::hypot(4.0, 1.495) + 0.2 + kRim_m, 0.005, 1.0);
}

TEST(Leak, AHoleInTheCeiling) {
  std::vector<map::Brush> brushes = walls();
  brushes.erase(brushes.begin() + 1);
  brushes.push_back(box({-20, -20, 300}, {395, 620, 320}));
  brushes.push_back(box({405, -20, 300}, {820, 620, 320}));
  brushes.push_back(box({395, -20, 300}, {405, 290, 320}));
  brushes.push_back(box({395, 310, 300}, {405, 620, 320}));
  const Made made(MapMaker(kUnit_m).add(brushes), {{4.0, 3.0, 0.5}});
  made.expect_leak(2.5 + 0.2 + kRim_m, 0.10, 0.20);
}

TEST(Leak, AnOpenDoorToTheVoid) {
  const Made made(without(3, wall_with_hole(250, 350, 0, 200)), {{1.0, 3.0, 1.0}});
  made.expect_leak(7.2 + kRim_m, 1.0, 2.0);
}

/// The walls +x and +y end where they would only touch in the edge (800, 600), and `gap` units short of it on either side.
MapMaker diagonal_corner(double gap) {
  std::vector<map::Brush> brushes = walls();
  brushes.resize(5);
  brushes[3] = box({800 + gap, -20, 0}, {820, 600, 300});
  brushes.push_back(box({-20, 600 + gap, 0}, {800, 620, 300}));
  brushes[0] = box({-40, -40, -20}, {840, 640, 0});
  brushes[1] = box({-40, -40, 300}, {840, 640, 320});
  return MapMaker(kUnit_m).add(brushes);
}

TEST(Leak, WallsThatOnlyTouchInAnEdgeAreClosed) {
  for (const SplitRule rule : kRules) {
    const Made made(diagonal_corner(0.0), {kMiddle_m}, rule);
    EXPECT_TRUE(made.enclosure().sealed);
    EXPECT_TRUE(made.enclosure().leaking.empty());
  }
}

TEST(Leak, AGapAtADiagonalCorner) {
  for (const SplitRule rule : kRules) {
    for (const double gap : {0.1, 1.0, 5.0}) {
      const Made made(diagonal_corner(gap), {kMiddle_m}, rule);
      // Past the corner, and from there to the nearest rim.
      made.expect_leak(std::hypot(4.0, 3.0) + 0.4 + kRim_m - 2.0 * gap * kUnit_m,
                       std::hypot(gap, gap) * kUnit_m, 3.0);
    }
  }
}

TEST(Leak, ATenthOfAMillimetreIsACrackAndCountsAsClosed) {
  EXPECT_TRUE(Made(without(3, wall_with_hole(300, 300.01, 0, 300)), {kMiddle_m}).enclosure().sealed);
  EXPECT_TRUE(Made(diagonal_corner(0.01), {kMiddle_m}).enclosure().sealed);
  EXPECT_FALSE(Made(without(3, wall_with_hole(300, 300.03, 0, 300)), {kMiddle_m}).enclosure().sealed);
}

TEST(Leak, APinholeOfAMillimetre) {
  const Made made(without(3, wall_with_hole(300, 300.1, 150, 150.1)), {kMiddle_m});
  made.expect_leak(4.2 + kRim_m, 0.001, 0.001);
}

TEST(Leak, DetailDoesNotSeal) {
  MapMaker maker = without(3);
  maker.detail(box({800, -20, 0}, {820, 620, 300}));
  const Made made(maker, {kMiddle_m});
  made.expect_leak(4.2 + kRim_m, 3.0, 6.0);
}

TEST(Leak, ASubtractedHole) {
  MapMaker maker = MapMaker(kUnit_m).add(walls());
  maker.subtract(box({790, 290, 100}, {830, 310, 150}));
  const Made made(maker, {kMiddle_m});
  made.expect_leak(4.2 + kRim_m, 0.2, 0.5);
}

TEST(Leak, AGapIsMeasuredWholeWhereAPlaneCutsIt) {
  // The gap 0.3 mm wide lies half above and half below a plane of other brushes.
  MapMaker maker = without(3, wall_with_hole(-20, 620, 150 - 0.015, 150 + 0.015));
  maker.add(box({100, 100, 0}, {200, 200, 150})).add(box({300, 100, 0}, {400, 200, 150}));
  maker.add(box({600, 100, 150}, {700, 200, 300})).add(box({821, 0, 150}, {840, 600, 160}));
  const Made made(maker, {kMiddle_m});
  EXPECT_FALSE(made.enclosure().sealed);
}

TEST(Leak, TheOccupantNearestToTheHoleIsNamed) {
  const std::vector<Vec3> occupants{{1.0, 1.0, 1.0}, {7.5, 3.0, 1.0}, {5.0, 1.0, 1.0}};
  const Made made(without(3, wall_with_hole(250, 350, 0, 200)), occupants);
  EXPECT_EQ(made.enclosure().leaking, (std::vector<std::size_t>{0, 1, 2}));
  ASSERT_TRUE(made.enclosure().leak.has_value());
  EXPECT_EQ(made.enclosure().leak->occupant, 1u);
}

TEST(Leak, OnlyTheRoomWithTheHoleLeaks) {
  MapMaker maker = without(3, wall_with_hole(250, 350, 0, 200));
  maker.add(box({390, 0, 0}, {410, 600, 300}));  // a wall without a door
  const Made made(maker, {{1.0, 3.0, 1.0}, {6.0, 3.0, 1.0}});
  EXPECT_EQ(made.enclosure().leaking, (std::vector<std::size_t>{1}));
  EXPECT_FALSE(made.enclosure().sealed);
  EXPECT_EQ(made.enclosure().leak->occupant, 1u);
}

TEST(Leak, AHoleIntoARoomWhereNobodyIsDoesNotMatter) {
  MapMaker maker = without(3, wall_with_hole(250, 350, 0, 200));
  maker.add(box({390, 0, 0}, {410, 600, 300}));
  const Made made(maker, {{1.0, 3.0, 1.0}});
  EXPECT_TRUE(made.enclosure().sealed);
}

TEST(Leak, OccupantsInSolidAndBeyondTheWorld) {
  const Made made(MapMaker(kUnit_m).add(walls()), {kMiddle_m, {-0.1, 3.0, 1.0}, {12.0, 3.0, 1.0}});
  EXPECT_EQ(made.enclosure().in_solid, (std::vector<std::size_t>{1}));
  EXPECT_EQ(made.enclosure().leaking, (std::vector<std::size_t>{2})) << "it stands in the void";
  EXPECT_FALSE(made.enclosure().sealed);
  const Made far(MapMaker(kUnit_m).add(walls()), {kMiddle_m, {1000.0, 3.0, 1.0}});
  EXPECT_EQ(far.enclosure().leaking, (std::vector<std::size_t>{1}));
}

TEST(Leak, AnOccupantOnTheFloorStandsInTheRoom) {
  const Made made(MapMaker(kUnit_m).add(walls()), {{4.0, 3.0, 0.0}, {8.0, 3.0, 1.0}});
  EXPECT_TRUE(made.enclosure().in_solid.empty());
  EXPECT_TRUE(made.enclosure().sealed);
}

TEST(Leak, TheWayAroundTwoCorners) {
  // A baffle stands 1 m before the door; the way goes around its end.
  MapMaker maker = without(3, wall_with_hole(250, 350, 0, 300));
  maker.add(box({690, 100, 0}, {700, 600, 300}));
  const Made made(maker, {{6.0, 5.0, 1.5}});
  const double shortest = std::hypot(0.9, 4.0) + 0.1 + std::hypot(1.0, 1.5) + 0.2 + kRim_m;
  made.expect_leak(shortest, 1.0, 3.0);
}

TEST(Leak, AShortWayIsPreferredToAWideOne) {
  // A large hole far away, a small one near.
  std::vector<map::Brush> brushes = walls();
  brushes.erase(brushes.begin() + 2);  // no wall -x
  brushes[2] = box({800, -20, 0}, {820, 295, 300});
  brushes.push_back(box({800, 305, 0}, {820, 620, 300}));
  const Made made(MapMaker(kUnit_m).add(brushes), {{7.0, 3.0, 1.5}});
  made.expect_leak(1.2 + kRim_m, 0.1, 3.0);
}

TEST(Leak, ATurnedRoom) {
  const Eigen::Quaterniond turn = Eigen::Quaterniond(0.9, 0.2, 0.3, -0.1).normalized();
  for (const double gap : {0.0, 0.1}) {
    std::vector<map::Brush> brushes = walls();
    brushes.erase(brushes.begin() + 3);
    for (map::Brush& part : wall_with_hole(300, 300 + gap, 0, 300)) brushes.push_back(part);
    MapMaker maker(kUnit_m);
    for (const map::Brush& brush : brushes) maker.add(test::moved(brush, turn, {1234.5, -77.7, 300.1}));
    const Vec3 start = (turn * Vec3(400, 300, 150) + Vec3(1234.5, -77.7, 300.1)) * kUnit_m;
    const Made made(maker, {start});
    EXPECT_EQ(made.enclosure().sealed, gap == 0.0);
    if (gap == 0.0) continue;
    EXPECT_NEAR(made.enclosure().leak->narrowest.width_m, 0.001, 1e-5);
    EXPECT_NEAR(made.enclosure().leak->narrowest.height_m, 3.0, 0.03);
  }
}

}  // namespace
}  // namespace hallway::bsp
