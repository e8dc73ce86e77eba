// SPDX-License-Identifier: MIT
#include "sense/moving_landmarks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "map/entities.hpp"
#include "sense/cloud_landmarks.hpp"
#include "support/errors.hpp"
#include "unit/sense/map_text.hpp"

namespace hallway::sense {
namespace {

/// A thousand points along 1000 m, with more keys.
map::Document moving_world(std::vector<std::pair<std::string, std::string>> keys) {
  keys.insert(keys.begin(), {{"classname", "hw_landmark_cloud"},
                             {"name", "c"},
                             {"path", "p"},
                             {"per_100m", "100"},
                             {"sideways_m", "15"},
                             {"height_m", "5"}});
  return test::parse_map(
      test::worldspawn({}) + test::entity({{"classname", "hw_path"}, {"name", "p"}}) +
      test::entity({{"classname", "hw_waypoint"}, {"path", "p"}, {"index", "0"}, {"origin", "0 0 0"}}) +
      test::entity({{"classname", "hw_waypoint"}, {"path", "p"}, {"index", "1"}, {"origin", "1000 0 0"}}) +
      test::entity(keys));
}

struct MovingWorld {
  std::vector<Vec3> landmarks;
  MovingLandmarks moving;

  std::vector<LandmarkPlace> at(double t_s) const {
    std::vector<LandmarkPlace> places;
    moving.places_at(t_s, places);
    return places;
  }
};

MovingWorld make_moving(const std::vector<std::pair<std::string, std::string>>& keys) {
  const map::Document document = moving_world(keys);
  MovingWorld made;
  made.landmarks = {Vec3(1, 2, 3)};  // one that is in no cloud
  add_cloud_landmarks(document, made.landmarks);
  made.moving = MovingLandmarks(document, made.landmarks, 1);
  return made;
}

TEST(MovingLandmarks, NoneMoveWhereNoKeySaysSo) {
  EXPECT_TRUE(make_moving({}).moving.empty());
  EXPECT_TRUE(make_moving({{"speed", "3"}, {"motion", "group"}}).moving.empty());
}

TEST(MovingLandmarks, TheShareMovesAndStartsWhereTheCloudHasIt) {
  const MovingWorld made = make_moving({{"moving_share", "0.2"}});
  const auto start = made.at(0.0);
  EXPECT_NEAR(static_cast<double>(start.size()), 200.0, 4.0 * std::sqrt(1000 * 0.2 * 0.8));
  EXPECT_EQ(make_moving({{"moving_share", "1"}}).at(0.0).size(), 1000u);
  std::uint32_t last = 0;
  for (const LandmarkPlace& at : start) {
    EXPECT_GT(at.landmark, last);  // the one that is in no cloud stands
    last = at.landmark;
    EXPECT_TRUE(made.moving.moves(at.landmark));
    EXPECT_EQ(at.place, made.landmarks[at.landmark]);
  }
  EXPECT_FALSE(made.moving.moves(0));
}

TEST(MovingLandmarks, AGreaterShareAddsToThoseThatMove) {
  const MovingWorld few = make_moving({{"moving_share", "0.1"}});
  const MovingWorld many = make_moving({{"moving_share", "0.4"}});
  for (const LandmarkPlace& at : few.at(0.0)) EXPECT_TRUE(many.moving.moves(at.landmark));
}

TEST(MovingLandmarks, GoSmoothlyAtTheirSpeedAndStayNearTheirPlace) {
  const MovingWorld made = make_moving({{"moving_share", "0.1"}, {"speed", "0.5"}});
  const auto start = made.at(0.0);
  constexpr double kStep_s = 0.05;
  double squares = 0.0;
  int steps = 0;
  for (auto before = start; steps < 4000; ++steps) {
    const auto now = made.at(kStep_s * (steps + 1));
    for (std::size_t i = 0; i < now.size(); ++i) {
      const double speed = (now[i].place - before[i].place).norm() / kStep_s;
      ASSERT_LE(speed, 0.5 * std::sqrt(12.0));  // every wave at its fastest
      squares += speed * speed / static_cast<double>(now.size());
      ASSERT_LE((now[i].place - start[i].place).cwiseAbs().maxCoeff(), SmoothMotion::kReach_m);
    }
    before = now;
  }
  EXPECT_NEAR(std::sqrt(squares / steps), 0.5, 0.02);
}

TEST(MovingLandmarks, EachGoesItsOwnWayOrAGroupGoesTogether) {
  const auto ways = [](const MovingWorld& made) {
    std::map<std::array<double, 3>, int> offsets;
    for (const LandmarkPlace& at : made.at(7.0)) {
      // Rounded: what is added to other places differs in its last bits.
      const Vec3 offset = ((at.place - made.landmarks[at.landmark]) * 1e6).array().round();
      ++offsets[{offset.x(), offset.y(), offset.z()}];
    }
    return offsets;
  };
  const MovingWorld alone = make_moving({{"moving_share", "0.2"}});
  EXPECT_EQ(ways(alone).size(), alone.at(0.0).size());
  const auto groups = ways(make_moving({{"moving_share", "0.4"}, {"motion", "group"}, {"groups", "3"}}));
  EXPECT_EQ(groups.size(), 3u);
  for (const auto& [offset, members] : groups) EXPECT_NEAR(members, 133, 60);
  EXPECT_EQ(ways(make_moving({{"moving_share", "0.4"}, {"motion", "group"}})).size(), 4u);
}

TEST(MovingLandmarks, BadKeysAreNamed) {
  const std::vector<std::pair<std::string, std::string>> bad{
      {"moving_share", "1.1"}, {"moving_share", "-0.1"}, {"speed", "-1"},
      {"motion", "fast"},      {"groups", "0"},          {"groups", "2.5"}};
  for (const auto& key : bad) {
    const auto error = test::error_of([&] { make_moving({key}); });
    ASSERT_TRUE(error) << key.first << " " << key.second;
    EXPECT_NE(std::string(error->what()).find(key.first), std::string::npos) << error->what();
  }
}

}  // namespace
}  // namespace hallway::sense
