// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>

#include "fixtures.hpp"

namespace hallway::host {
namespace {

using test_fixtures::frame_of;

class ExampleInC : public testing::Test {
 protected:
  ExampleInC() : plugin_(find_plugin(EXAMPLE, {})) { plugin_.activate(test_fixtures::point_sensors()); }

  std::vector<std::uint64_t> process(std::uint64_t sequence, const std::vector<hw_point3_t>& points) {
    const auto ids = plugin_.process(frame_of(builder_, sequence, points)).associations(0);
    return {ids->begin(), ids->end()};
  }

  FrameBuilder builder_;
  Plugin plugin_;
};

TEST_F(ExampleInC, TheFirstFrameIsTheMap) {
  process(0, {{1, 2, 3}, {4, 5, 6}});
  const Outputs& map = plugin_.report(false);
  ASSERT_EQ(map.landmarks().size(), 2u);
  EXPECT_EQ(map.landmarks()[1].position[0], 4);
  EXPECT_EQ(map.landmarks()[1].observations, 1u);
}

TEST_F(ExampleInC, APointIsTakenForTheNearestLandmarkWithinTheBound) {
  process(0, {{0, 0, 0}, {1, 0, 0}});
  EXPECT_EQ(process(1, {{0.9, 0, 0}, {0.1, 0, 0}, {0.5, 0, 0}}),
            (std::vector<std::uint64_t>{1, 0, HW_NO_LANDMARK}));
}

TEST_F(ExampleInC, UnmatchedPointsAreCounted) {
  process(0, {{0, 0, 0}});
  const Outputs& outputs = plugin_.process(frame_of(builder_, 1, {{0, 0, 0}, {9, 0, 0}, {8, 0, 0}}));
  ASSERT_EQ(outputs.counters().size(), 1u);
  EXPECT_EQ(outputs.counters()[0].name, "unmatched");
  EXPECT_EQ(outputs.counters()[0].value, 2);
}

TEST_F(ExampleInC, ThePoseIsLostUntilThereIsAMap) {
  EXPECT_FALSE(plugin_.process(frame_of(builder_, 0, {})).pose()->valid);
  EXPECT_TRUE(plugin_.process(frame_of(builder_, 1, {{1, 2, 3}})).pose()->valid);
}

TEST_F(ExampleInC, PointsThatAreNotFiniteAreNoLandmarks) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(process(0, {{nan, 0, 0}, {1, 0, 0}}), (std::vector<std::uint64_t>{HW_NO_LANDMARK, 0}));
}

TEST_F(ExampleInC, AResetForgetsTheMap) {
  process(0, {{0, 0, 0}});
  plugin_.reset();
  EXPECT_TRUE(plugin_.report(false).landmarks().empty());
  process(1, {{5, 0, 0}});
  EXPECT_EQ(plugin_.report(false).landmarks()[0].position[0], 5);
}

}  // namespace
}  // namespace hallway::host
