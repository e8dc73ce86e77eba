// SPDX-License-Identifier: MIT
// The scenarios that are named for the thesis's simulations of planes (4.3): what each is there to show does happen.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "sim/simulator.hpp"
#include "support/data.hpp"

namespace hallway::sim {
namespace {

constexpr double kSame_m = 1e-6;

/// What is seen of a wall in a step.
struct Sight {
  std::uint32_t wall = 0;
  double length_m = 0.0;
  bool full = false;     ///< from end to end
  bool partial = false;  ///< neither end
};

/// A scenario, driven.
class Drive {
 public:
  explicit Drive(const std::string& name) : simulator_(scenario(name), 1, trace::Backend::kBruteForce) {
    for (std::uint32_t i = 0; i < simulator_.scenario().steps; ++i) {
      const Frame frame = simulator_.step(i);
      std::vector<Sight>& sights = steps_.emplace_back();
      const auto& sensor = std::get<sense::PlaneSensorSpec>(simulator_.scenario().sensors.at(0));
      const Pose T_world_sensor = frame.T_world_body * sensor.T_body_sensor;
      for (const PlaneObservation& plane : frame.readings.at(0).planes())
        sights.push_back(sight_of(plane, T_world_sensor));
    }
  }

  const Simulator& simulator() const { return simulator_; }
  const std::vector<std::vector<Sight>>& steps() const { return steps_; }
  const std::vector<sense::Wall>& walls() const { return simulator_.walls(0)->walls; }

  /// The wall on which a point lies that faces in a direction.
  std::uint32_t wall_at(const Vec2& point, const Vec2& facing) const {
    for (std::uint32_t i = 0; i < walls().size(); ++i) {
      const sense::Wall& wall = walls()[i];
      const double u = (point - wall.left).dot((wall.right - wall.left).normalized());
      const bool on =
          std::abs((point - wall.left).dot(wall.normal())) < 1e-3 && u > 0.0 && u < wall.length_m();
      if (on && wall.normal().dot(facing) > 0.99) return i;
    }
    ADD_FAILURE() << "no wall at " << point.transpose();
    return 0;
  }

  /// The steps in which a wall is seen.
  std::vector<std::uint32_t> seen(std::uint32_t wall) const {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < steps_.size(); ++i) {
      const auto is_it = [&](const Sight& sight) { return sight.wall == wall; };
      if (std::any_of(steps_[i].begin(), steps_[i].end(), is_it)) found.push_back(i);
    }
    return found;
  }

  std::set<std::uint32_t> walls_seen(std::uint32_t first, std::uint32_t end) const {
    std::set<std::uint32_t> found;
    for (std::uint32_t i = first; i < end; ++i) {
      for (const Sight& sight : steps_[i]) found.insert(sight.wall);
    }
    return found;
  }

  /// The longest stretch of steps in which one part of one wall is all that is seen: {first, end}.
  std::pair<std::uint32_t, std::uint32_t> longest_single() const {
    std::pair<std::uint32_t, std::uint32_t> longest{0, 0};
    std::uint32_t begun = 0;
    for (std::uint32_t i = 0; i < steps_.size(); ++i) {
      const bool single = steps_[i].size() == 1 && steps_[i][0].partial;
      if (!single || (i > begun && steps_[i][0].wall != steps_[begun][0].wall)) begun = single ? i : i + 1;
      if (single && i + 1 - begun > longest.second - longest.first) longest = {begun, i + 1};
    }
    return longest;
  }

 private:
  static Scenario scenario(const std::string& name) {
    return load_scenario(test::source_folder() / "maps" / (name + ".toml"));
  }

  Sight sight_of(const PlaneObservation& plane, const Pose& T_world_sensor) const {
    const sense::Wall& wall = walls()[plane.true_plane];
    const auto is_at = [&](const Vec3& corner, const Vec2& end) {
      return ((T_world_sensor * corner).head<2>() - end).norm() < kSame_m;
    };
    const bool left = is_at(plane.corners[0], wall.left), right = is_at(plane.corners[1], wall.right);
    return {plane.true_plane, (plane.corners[1] - plane.corners[0]).norm(), left && right, !left && !right};
  }

  Simulator simulator_;
  std::vector<std::vector<Sight>> steps_;
};

/// Longest pause in a rising list of steps: {last before it, first after it}.
std::pair<std::uint32_t, std::uint32_t> longest_pause(const std::vector<std::uint32_t>& steps) {
  std::pair<std::uint32_t, std::uint32_t> longest{0, 0};
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    if (steps[i + 1] - steps[i] > longest.second - longest.first) longest = {steps[i], steps[i + 1]};
  }
  return longest;
}

class PlaneScenario : public testing::TestWithParam<const char*> {};

TEST_P(PlaneScenario, HasAFreeWayAndAlwaysSeesAWall) {
  const Drive drive(GetParam());
  for (const Error& problem : drive.simulator().problems()) ADD_FAILURE() << problem.what();
  for (std::size_t i = 0; i < drive.steps().size(); ++i) ASSERT_FALSE(drive.steps()[i].empty()) << i;
}

INSTANTIATE_TEST_SUITE_P(Maps, PlaneScenario,
                         testing::Values("four_planes", "hallway", "hallway_return", "key_points",
                                         "loop_corridor", "motion_model", "bad_pairs", "roll_back",
                                         "pseudo_merge", "many_planes"),
                         [](const auto& name) { return std::string(name.param); });

TEST(FourPlanes, AreAllAlwaysSeenWhole) {
  const Drive drive("four_planes");
  for (const auto& sights : drive.steps()) {
    ASSERT_EQ(sights.size(), 4u);
    for (const Sight& sight : sights) ASSERT_TRUE(sight.full);
  }
}

TEST(Hallway, HasWallsThatComeAndGo) {
  const Drive drive("hallway");
  const auto end = static_cast<std::uint32_t>(drive.steps().size());
  EXPECT_GT(drive.walls_seen(0, end).size(), 20u);
  const auto first = drive.walls_seen(0, 50), last = drive.walls_seen(end - 50, end);
  for (const std::uint32_t wall : first) EXPECT_FALSE(last.contains(wall)) << wall;
}

TEST(HallwayReturn, SeesWallsAgainOnItsWayBack) {
  const Drive drive("hallway_return");
  std::size_t again = 0;
  for (std::uint32_t wall = 0; wall < drive.walls().size(); ++wall) {
    const auto [last, next] = longest_pause(drive.seen(wall));
    again += next - last > 200 ? 1u : 0u;
  }
  EXPECT_GE(again, 5u);
  // The piers' far sides are seen on the way back alone.
  EXPECT_GT(drive.seen(drive.wall_at({4.8, 1.7}, {1, 0})).front(), drive.steps().size() / 2);
}

TEST(KeyPoints, GrowUntilTheyAreWholeAndThenShrink) {
  const Drive drive("key_points");
  std::size_t grow_and_shrink = 0;
  for (std::uint32_t wall = 0; wall < drive.walls().size(); ++wall) {
    double before_m = 0.0;
    bool grew = false, whole = false, shrank = false;
    for (const auto& sights : drive.steps()) {
      for (const Sight& sight : sights) {
        if (sight.wall != wall) continue;
        grew = grew || (!whole && before_m > 0.0 && sight.length_m > before_m + kSame_m);
        whole = whole || (grew && sight.full);
        shrank = shrank || (whole && sight.length_m < before_m - kSame_m);
        before_m = sight.length_m;
      }
    }
    grow_and_shrink += shrank ? 1u : 0u;
  }
  EXPECT_GE(grow_and_shrink, 8u);
  // Between the two panels that are alike, both are seen in parts of one length.
  const std::uint32_t south = drive.wall_at({10, 9.6}, {0, 1}), north = drive.wall_at({10, 12.4}, {0, -1});
  std::size_t alike = 0;
  for (const auto& sights : drive.steps()) {
    double south_m = 0.0, north_m = -1.0;
    for (const Sight& sight : sights) {
      if (sight.wall == south && !sight.full) south_m = sight.length_m;
      if (sight.wall == north && !sight.full) north_m = sight.length_m;
    }
    alike += std::abs(south_m - north_m) < kSame_m ? 1u : 0u;
  }
  EXPECT_GE(alike, 50u);
}

TEST(LoopCorridor, ComesBackToWhatItSawFirst) {
  const Drive drive("loop_corridor");
  const auto end = static_cast<std::uint32_t>(drive.steps().size());
  const auto first = drive.walls_seen(0, 50), between = drive.walls_seen(700, 1000),
             last = drive.walls_seen(end - 400, end);
  std::size_t again = 0;
  for (const std::uint32_t wall : first) again += last.contains(wall) && !between.contains(wall) ? 1u : 0u;
  EXPECT_GE(again, 5u);
}

TEST(MotionModel, SeesOnePartOfOneWallForAWhile) {
  const Drive drive("motion_model");
  const auto [first, end] = drive.longest_single();
  EXPECT_GE(end - first, 40u);
  ASSERT_GT(first, 0u);
  // That wall had been seen before with others, which are seen again when the robot comes back.
  const std::uint32_t single = drive.steps()[first][0].wall;
  EXPECT_LT(drive.seen(single).front() + 100, first);
  EXPECT_EQ(single, drive.wall_at({18, 0}, {-1, 0}));
  const auto way_there = drive.walls_seen(0, first);
  const auto way_back = drive.walls_seen(end + 200, static_cast<std::uint32_t>(drive.steps().size()));
  std::vector<std::uint32_t> both;
  std::set_intersection(way_there.begin(), way_there.end(), way_back.begin(), way_back.end(),
                        std::back_inserter(both));
  EXPECT_GE(both.size(), 3u);
}

TEST(BadPairs, AreSeenTogetherForAMomentOrShrinkAsTheOtherGrows) {
  const Drive drive("bad_pairs");
  const std::uint32_t leaves = drive.wall_at({3.6, -2.5}, {-1, 0}), appears = drive.wall_at({15, -3}, {0, 1});
  const std::uint32_t shrinks = drive.wall_at({4, 3}, {0, -1}), grows = drive.wall_at({20, 3}, {0, -1});
  const auto leaving = drive.seen(leaves), appearing = drive.seen(appears);
  EXPECT_LE(appearing.front(), leaving.back());
  EXPECT_LE(leaving.back() - appearing.front(), 15u);
  std::size_t alike = 0;
  double shrinking_m = 0.0, growing_m = 0.0;
  for (const auto& sights : drive.steps()) {
    double a_m = 0.0, b_m = 0.0;
    for (const Sight& sight : sights) {
      if (sight.wall == shrinks) a_m = sight.length_m;
      if (sight.wall == grows) b_m = sight.length_m;
    }
    const bool both = a_m > 0.0 && b_m > 0.0 && shrinking_m > 0.0 && growing_m > 0.0;
    alike +=
        both && a_m < shrinking_m && std::abs((shrinking_m - a_m) - (b_m - growing_m)) < kSame_m ? 1u : 0u;
    shrinking_m = a_m;
    growing_m = b_m;
  }
  EXPECT_GE(alike, 60u);
}

TEST(RollBack, SeesAWallForAMomentLongBeforeItSeesItForGood) {
  const Drive drive("roll_back");
  const auto seen = drive.seen(drive.wall_at({0, 8}, {1, 0}));
  ASSERT_FALSE(seen.empty());
  std::size_t moment = 1;
  while (moment < seen.size() && seen[moment] == seen[moment - 1] + 1) ++moment;
  EXPECT_LE(moment, 60u);
  ASSERT_LT(moment, seen.size());
  EXPECT_GT(seen[moment], seen[moment - 1] + 50);
  EXPECT_GT(seen.size(), 10 * moment);
}

TEST(PseudoMerge, SeesMoreOfAWallOnItsWayBack) {
  const Drive drive("pseudo_merge");
  const auto [first, end] = drive.longest_single();
  EXPECT_GE(end - first, 10u);
  const std::uint32_t wall = drive.wall_at({8, -2}, {0, 1});
  double before_m = 0.0, after_m = 0.0;
  for (std::uint32_t i = 0; i < drive.steps().size(); ++i) {
    for (const Sight& sight : drive.steps()[i]) {
      if (sight.wall == wall)
        (i < first ? before_m : after_m) = std::max(i < first ? before_m : after_m, sight.length_m);
    }
  }
  EXPECT_LT(before_m, 10.0);
  EXPECT_GT(after_m, before_m);
}

TEST(ManyPlanes, AreMoreThanSixty) {
  const Drive drive("many_planes");
  EXPECT_GE(drive.walls_seen(0, static_cast<std::uint32_t>(drive.steps().size())).size(), 60u);
}

}  // namespace
}  // namespace hallway::sim
