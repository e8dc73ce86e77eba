// SPDX-License-Identifier: MIT
#include "planes/finder.hpp"

#include <gtest/gtest.h>

#include "planes/score.hpp"
#include "support/errors.hpp"
#include "unit/planes/cases.hpp"

namespace hallway::planes::test {
namespace {

PlaneFinder finder(const std::string& plugin, std::vector<host::ParameterSetting> parameters = {}) {
  return {{.plugin = std::string(FIXTURES) + "/" + plugin, .parameters = std::move(parameters)}, {}, {}, {}};
}

TEST(Finder, GivesWhatThePluginFound) {
  const Case three = levels(3, 5);
  PlaneFinder levels_plugin = finder("levels.so");
  const Answer answer = levels_plugin.find(three.points, 3);
  const Score score = three.score(answer.planes);
  EXPECT_EQ(score.matched[2], 3u);
  EXPECT_EQ(score.count(FaultKind::kMisaligned), 0u);
  EXPECT_GE(answer.ms, 0.0);
  ASSERT_FALSE(answer.planes.empty());
  EXPECT_EQ(answer.planes.back().plane.normal, Vec3(0, 0, -1));
  EXPECT_EQ(answer.planes.back().hull.size(), 4u);
  EXPECT_EQ(answer.planes.back().points, 100u);
}

TEST(Finder, AnswersCloudAfterCloud) {
  PlaneFinder plugin = finder("levels.so");
  EXPECT_EQ(plugin.find(levels(2).points).planes.size(), 2u);
  EXPECT_TRUE(plugin.find({}).planes.empty());
  EXPECT_EQ(plugin.find(levels(4).points).planes.size(), 4u);
}

TEST(Finder, ParametersReachThePlugin) {
  EXPECT_EQ(finder("levels.so", {{"step_m", "2", {}}}).find(levels(4).points).planes.size(), 2u);
}

TEST(Finder, TellsThePluginOfWhichPixelsThePointsAre) {
  const Case two = levels(2);
  import::PixelGrid image{.width = 2, .height = static_cast<std::uint32_t>(two.points.size())};
  for (std::uint32_t i = 0; i < two.points.size(); ++i) image.pixels.push_back(2 * i + 1);
  PlaneFinder plugin = finder("levels.so", {{"fault", "wants_image", {}}});
  EXPECT_EQ(plugin.find(two.points, 1, image).planes.size(), 2u);
  EXPECT_TRUE(plugin.find(two.points).planes.empty());
}

TEST(Finder, APluginThatPutsNoneFindsNone) {
  EXPECT_TRUE(finder("levels.so", {{"fault", "puts_none", {}}}).find(levels(4).points).planes.empty());
}

TEST(Finder, APluginThatFindsNoPlanesIsRefused) {
  const auto error = hallway::test::error_of([] { finder("minimal.so"); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_NE(error->message().find("finds no planes"), std::string::npos) << error->message();
}

TEST(Finder, APluginThatFailsIsAtFault) {
  const auto error = hallway::test::error_of([] { finder("levels.so", {{"fault", "throws", {}}}).find({}); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kPluginFault);
}

}  // namespace
}  // namespace hallway::planes::test
