// SPDX-License-Identifier: MIT
#include "map/occupants.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "map/reader.hpp"
#include "map_text.hpp"
#include "support/errors.hpp"

namespace hallway::map {
namespace {

using Pairs = std::vector<std::array<std::string, 2>>;

Document document_of(const std::vector<Pairs>& entities) {
  std::string text = test::entity_text({{"classname", "worldspawn"}, {"_scale", "0.5"}, {"origin", "9 9 9"}});
  for (const Pairs& pairs : entities) text += test::entity_text(pairs);
  return parse(text, "a.map");
}

TEST(Occupants, AreInMetresAndInTheOrderOfTheFile) {
  const auto found =
      occupants(document_of({{{"classname", "light"}, {"origin", "2 4 -6"}, {"targetname", "lamp"}},
                             {{"classname", "hw_robot_start"}, {"origin", "0 0 0"}}}));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].classname, "light");
  EXPECT_EQ(found[0].name, "lamp");
  EXPECT_EQ(found[0].position_m, Vec3(1, 2, -3));
  EXPECT_EQ(found[0].entity, 1);
  EXPECT_EQ(found[0].line, 6);
  EXPECT_EQ(found[1].classname, "hw_robot_start");
  EXPECT_EQ(found[1].name, "");
}

TEST(Occupants, WaypointsAreNamedByPathAndIndex) {
  const auto found = occupants(document_of(
      {{{"classname", "hw_waypoint"}, {"path", "round"}, {"index", "7"}, {"origin", "0 0 0"}},
       {{"classname", "hw_path"}, {"name", "round"}},
       {{"classname", "hw_path"}, {"name", "eight"}, {"shape", "lemniscate"}, {"origin", "1 0 0"}}}));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].name, "round 7");
  EXPECT_EQ(found[1].name, "eight");
}

TEST(Occupants, WhatHasNoPlaceIsNone) {
  EXPECT_TRUE(occupants(document_of({{{"classname", "info_null"}, {"origin", "0 0 0"}},
                                     {{"classname", "misc_external_map"}, {"origin", "0 0 0"}},
                                     {{"classname", "hw_mesh"}, {"origin", "0 0 0"}, {"model", "a.glb"}},
                                     {{"classname", "hw_landmark_cloud"}, {"name", "c"}},
                                     {{"classname", "hw_sensor"}, {"name", "s"}},
                                     {{"classname", "hw_sensor"}, {"name", "t"}, {"origin", "0 0 0"}},
                                     {{"classname", "func_timer"}},
                                     {{"classname", "light"}}}))
                  .empty());
}

TEST(Occupants, BrushEntitiesAreNone) {
  const Document document = parse(
      "{\n\"classname\" \"func_door\"\n\"origin\" \"1 2 3\"\n{\n" + test::cube_faces() + "}\n}\n", "a.map");
  EXPECT_TRUE(occupants(document).empty());
}

TEST(Occupants, ClassesThatStandSomewhereNeedAnOrigin) {
  for (const Pairs& pairs :
       std::vector<Pairs>{{{"classname", "hw_robot_start"}},
                          {{"classname", "hw_waypoint"}, {"path", "p"}, {"index", "0"}},
                          {{"classname", "hw_path"}, {"name", "p"}, {"shape", "lemniscate"}}}) {
    const auto error = hallway::test::error_of([&] { occupants(document_of({pairs})); });
    ASSERT_TRUE(error) << pairs[0][1];
    EXPECT_EQ(error->message(), "key `origin` is missing");
    EXPECT_EQ(error->where().line, 6);
  }
}

TEST(Occupants, AnOriginThatIsNoneIsAnError) {
  for (const char* origin : {"1 2", "1 2 3 4", "1 2 x", "nan 0 0", "1e8 0 0", ""})
    EXPECT_TRUE(hallway::test::error_of([&] {
      occupants(document_of({{{"classname", "monster_ogre"}, {"origin", origin}}}));
    })) << origin;
}

}  // namespace
}  // namespace hallway::map
