// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "solidity.hpp"
#include "unit/editor/editing.hpp"

namespace hallway {
namespace {

using editor::Id;
using test::Editing;
using test::mentions;
using test::refusal;

/// The one of two brushes that is seen stays.
TEST(Faults, TheFixOfEqualBrushesTakesTheHiddenOne) {
  Editing map;
  map.run_all({"new", "box from 8,1 to 9,2,1 material=glass name=C",
               "box from 8,1 to 9,2,1 material=wood name=D", "fix"});
  EXPECT_EQ(test::named(map, "D").brushes.size(), 1u);
  EXPECT_EQ(test::named(map, "C").brushes.size(), 0u);
}

TEST(Faults, EachMisspeltKeyHasItsOwnFix) {
  Editing map;
  map.run_all({"new", "entity hw_sensor name=s knid=points horizontal_fov=90"});
  const auto faults = map.run("validate").data.at("faults");
  std::set<std::string> fixes;
  for (const auto& fault : faults) fixes.insert(fault.at("fix").get<std::string>());
  EXPECT_EQ(fixes.size(), faults.size()) << faults.dump(1);
}

TEST(Faults, AFindingThatDoesNotExistIsRefused) {
  Editing map;
  map.run("new");
  EXPECT_TRUE(mentions(refusal(map, "validate slivr"), "did you mean \"sliver\"?"));
  EXPECT_TRUE(mentions(refusal(map, "fix nosuch"), "there is no finding"));
  EXPECT_EQ(map.run("validate blocked-opening").lines, std::vector<std::string>{"nothing is wrong"});
}

/// Brush 2 in the world, lamps 3 and 4.
struct Things : Editing {
  Things() {
    run_all({"new", "box from 0,0 to 2,3,1 material=brick", "light at 1,1,2 name=lamp",
             "light at 2,1,2 name=second"});
  }
  std::vector<Id> selection() const { return session->state().desk.selection; }
  std::vector<Id> hidden() const { return session->state().desk.hidden; }
  const std::string* key(const std::string& name, const char* which) const {
    return test::named(*this, name).head->find(which);
  }
};

using Ids = std::vector<Id>;

TEST(ThingsCommands, Select) {
  Things map;
  map.run("select lamp");
  EXPECT_EQ(map.selection(), Ids{3});
  map.run("select 2+second add");
  EXPECT_EQ(map.selection(), (Ids{2, 3, 4}));
  map.run("select lamp how=remove");
  EXPECT_EQ(map.selection(), (Ids{2, 4}));
  EXPECT_EQ(map.run("list selected").data["count"], 2);
  map.run("select none");
  EXPECT_TRUE(map.selection().empty());
  EXPECT_TRUE(mentions(refusal(map, "list selected"), "select"));
  EXPECT_TRUE(mentions(refusal(map, "select lmap"), "lamp"));
  EXPECT_TRUE(mentions(refusal(map, "select lamp twice"), "twice"));
}

TEST(ThingsCommands, ListSaysWhatAndWhereAndHowManyMore) {
  Things map;
  const auto report = map.run("list");
  EXPECT_EQ(report.data["count"], 3);
  EXPECT_EQ(report.data["things"][0]["bounds"]["max_m"], (nlohmann::ordered_json{2.0, 3.0, 1.0}));
  EXPECT_EQ(report.data["things"][1]["name"], "lamp");
  EXPECT_TRUE(mentions(report.lines[1], "1,1,2")) << report.lines[1];
  map.run("array lamp linear 150 by 0.1,0");
  const auto some = map.run("list class=light limit=20");
  EXPECT_EQ(some.data["things"].size(), 20u);
  EXPECT_EQ(some.data["count"], 151);
  EXPECT_TRUE(mentions(some.lines.back(), "131 more")) << some.lines.back();
  EXPECT_TRUE(mentions(refusal(map, "list class=lihgt"), "lihgt"));
  EXPECT_TRUE(mentions(refusal(map, "list all limit=0"), "limit"));
  Editing empty;
  empty.run("new");
  EXPECT_EQ(empty.run("list").data["count"], 0);
}

TEST(ThingsCommands, InfoHasKeysBoundsVolumeMaterials) {
  Things map;
  auto one = map.run("info 2").data["things"][0];
  EXPECT_EQ(one["volume_m3"], 6.0);
  EXPECT_EQ(one["materials"], nlohmann::ordered_json{"brick"});
  EXPECT_EQ(map.run("info lamp").data["things"][0]["keys"]["targetname"], "lamp");
  map.run("wall from 0,5 to 4,5 name=north");
  one = map.run("info north").data["things"][0];
  EXPECT_TRUE(mentions(one["made_by"].get<std::string>(), "wall ")) << one.dump();
  EXPECT_TRUE(mentions(refusal(map, "info 77"), "77"));
}

TEST(ThingsCommands, Measure) {
  Things map;
  const auto way = map.run("measure 1,1,0 to 4,5,12").data;
  EXPECT_EQ(way["distance_m"], 13.0);
  EXPECT_EQ(way["horizontal_m"], 5.0);
  EXPECT_EQ(way["way_m"], (nlohmann::ordered_json{3.0, 4.0, 12.0}));
  EXPECT_EQ(way["distance_units"], 1300.0);
  const auto size = map.run("measure what=2+lamp").data;
  EXPECT_EQ(size["volume_m3"], 6.0);
  EXPECT_EQ(size["size_m"], (nlohmann::ordered_json{2.0, 3.0, 2.0}));
  for (const char* line : {"measure", "measure 1,1", "measure 0,0 1,1 what=lamp"})
    EXPECT_TRUE(mentions(refusal(map, line), "either")) << line;
  EXPECT_TRUE(mentions(refusal(map, "measure 1 to 2,2"), "place"));
  map.run("entity info_note");
  EXPECT_TRUE(mentions(refusal(map, "measure what=class=info_note"), "origin"));
}

TEST(ThingsCommands, FindLooksInKeysValuesAndMaterials) {
  Things map;
  EXPECT_EQ(map.run("find BRICK").data["found"][0]["id"], 2);
  EXPECT_EQ(map.run("find lamp").data["found"][0]["id"], 3);
  EXPECT_EQ(map.run("find targetname").data["count"], 2);
  EXPECT_EQ(map.run("find lamp").status, 0);
  EXPECT_EQ(map.run("find nowhere").status, 1);
  EXPECT_TRUE(mentions(refusal(map, "find \"\""), "empty"));
}

TEST(ThingsCommands, NameOfAnEntityIsFollowedByWhatRefersToIt) {
  Things map;
  map.run_all({"key second target=lamp", "name lamp lantern", "path way 0,0;5,0",
               "landmarks path=way per_100m=1 sideways=1 height=1", "name way road"});
  EXPECT_EQ(*map.key("second", "target"), "lantern");
  EXPECT_EQ(*map.key("way_cloud", "path"), "road");
  EXPECT_EQ(map.run("waypoint road 5,5").data["index"], 2);
  EXPECT_EQ(map.run("info road").data["things"][0]["keys"]["name"], "road");
}

TEST(ThingsCommands, ANamedBrushIsAGroupAndKeepsItsNumber) {
  Things map;
  map.run("name 2 crate");
  const auto& group = test::named(map, "crate");
  EXPECT_TRUE(editor::group_number(group));
  ASSERT_EQ(group.brushes.size(), 1u);
  EXPECT_EQ(group.brushes[0].id, 2u);
  EXPECT_TRUE(map.session->state().entities[0]->brushes.empty());
  map.run("name crate box");
  EXPECT_EQ(test::named(map, "box").brushes[0].id, 2u);
  EXPECT_TRUE(mentions(refusal(map, "name 2 other"), "belongs to"));
  EXPECT_TRUE(mentions(refusal(map, "name box lamp"), "already"));
  EXPECT_TRUE(mentions(refusal(map, "name class=worldspawn world"), "worldspawn"));
  EXPECT_TRUE(mentions(refusal(map, "name class=light lights"), "2 things"));
  EXPECT_TRUE(mentions(refusal(map, "name lamp a=b"), "a"));
}

TEST(ThingsCommands, ARenamedWallIsWhatItsDoorIsIn) {
  Things map;
  map.run_all({"wall from 0,5 to 4,5 name=north", "door in north at 2 name=entrance", "name north wall"});
  EXPECT_TRUE(mentions(*map.key("entrance", "_hw_made"), "in=wall")) << *map.key("entrance", "_hw_made");
  EXPECT_TRUE(mentions(*map.key("wall", "_hw_made"), "name=wall"));
}

TEST(ThingsCommands, GroupAndUngroupAreOpposites) {
  Things map;
  const std::string before = map.text();
  map.run("group 2+lamp corner");
  EXPECT_EQ(test::named(map, "corner").brushes.size(), 1u);
  EXPECT_NE(map.key("lamp", "_tb_group"), nullptr);
  map.run("group corner+second all_of_it");
  EXPECT_EQ(*map.key("corner", "_tb_group"), *map.key("all_of_it", "_tb_id"));
  const auto& state = map.session->state();
  EXPECT_EQ(editor::with_members(state, editor::resolve(state, "all_of_it")).size(), 4u);
  map.run("ungroup all_of_it");
  EXPECT_EQ(map.key("corner", "_tb_group"), nullptr);
  map.run("ungroup corner");
  EXPECT_EQ(map.text(), before);
  EXPECT_TRUE(mentions(refusal(map, "ungroup lamp"), "no group"));
  EXPECT_TRUE(mentions(refusal(map, "group class=worldspawn w"), "worldspawn"));
  EXPECT_TRUE(mentions(refusal(map, "group 2 lamp"), "already"));
}

TEST(ThingsCommands, UngroupingGroupsWithinEachOtherAtOnce) {
  Things map;
  const std::string before = map.text();
  map.run_all({"group 2 inner", "group inner+lamp outer"});
  map.run("ungroup outer+inner");
  EXPECT_EQ(map.text(), before);
}

TEST(ThingsCommands, AGroupWithADensityKeepsIt) {
  Things map;
  map.run_all({"name 2 crate", "landmarks per_m2=7 on=crate", "ungroup crate"});
  EXPECT_TRUE(mentions(map.text(), "\"_points_per_m2\" \"7\""));
  EXPECT_FALSE(mentions(map.text(), "_tb_group"));
}

TEST(ThingsCommands, TakingAPartOutOfAShapeTakesItsLineAway) {
  Things map;
  map.run_all({"room from 0,0 to 5,4 name=kitchen"});
  ASSERT_NE(map.key("kitchen", "_hw_made"), nullptr);
  map.run("group class=hw_subtract cut");
  EXPECT_EQ(map.key("kitchen", "_hw_made"), nullptr);
}

TEST(ThingsCommands, HideAndShow) {
  Things map;
  map.run("group 2+lamp corner");
  const Id group = test::named(map, "corner").id;
  map.run("hide corner");
  EXPECT_EQ(map.hidden(), (Ids{3, group}));
  map.run("show lamp");
  EXPECT_EQ(map.hidden(), Ids{group});
  map.run("show 2");
  EXPECT_TRUE(map.hidden().empty());
  map.run("hide 2+second");
  EXPECT_EQ(map.hidden(), (Ids{2, 4}));
  const std::string text = map.text();
  map.run("show");
  EXPECT_TRUE(map.hidden().empty());
  EXPECT_EQ(map.text(), text);
  EXPECT_TRUE(mentions(refusal(map, "hide lmap"), "lamp"));
  EXPECT_TRUE(mentions(refusal(map, "show lmap"), "lamp"));
}

std::multiset<std::string> materials(const Editing& map) {
  std::multiset<std::string> found;
  for (const map::Face& face : map.session->state().entities[0]->brushes[0].brush->faces)
    found.insert(face.material);
  return found;
}

TEST(ThingsCommands, MaterialOfFaces) {
  Things map;
  const std::vector<std::pair<std::string, std::size_t>> sides{{"top", 1},   {"bottom", 1}, {"north", 1},
                                                               {"south", 1}, {"east", 1},   {"west", 1}};
  for (const auto& [side, count] : sides) {
    EXPECT_EQ(map.run("material 2 m_" + side + " face=" + side).data["faces"], count);
  }
  for (const auto& [side, count] : sides) EXPECT_EQ(materials(map).count("m_" + side), count) << side;
  for (const map::Face& face : map.session->state().entities[0]->brushes[0].brush->faces) {
    const auto plane = editor::plane_of(face);
    const Vec3 normal = face.material == "m_top"      ? Vec3(0, 0, 1)
                        : face.material == "m_bottom" ? Vec3(0, 0, -1)
                        : face.material == "m_north"  ? Vec3(0, 1, 0)
                        : face.material == "m_south"  ? Vec3(0, -1, 0)
                        : face.material == "m_east"   ? Vec3(1, 0, 0)
                                                      : Vec3(-1, 0, 0);
    EXPECT_LT((plane->normal - normal).norm(), 1e-9) << face.material;
  }
  map.run("material 2 stone face=sides");
  EXPECT_EQ(materials(map).count("stone"), 4u);
  map.run("material 2 slate");
  EXPECT_EQ(materials(map).count("slate"), 6u);
  EXPECT_TRUE(mentions(refusal(map, "material lamp slate"), "no faces"));
  EXPECT_TRUE(mentions(refusal(map, "material 2 slate face=tpo"), "top"));
}

TEST(ThingsCommands, AMaterialForAWholeShapeGoesIntoItsLine) {
  Things map;
  map.run_all({"wall from 0,5 to 4,5 name=north material=plaster", "material north brick"});
  ASSERT_NE(map.key("north", "_hw_made"), nullptr);
  EXPECT_TRUE(mentions(*map.key("north", "_hw_made"), "material=brick"));
  map.run("material north tile face=top");
  EXPECT_EQ(map.key("north", "_hw_made"), nullptr);
}

TEST(ThingsCommands, Grid) {
  Things map;
  EXPECT_EQ(map.run("grid 25cm").data["grid_m"], 0.25);
  map.run("light 1.1,0.9,2.01 name=third");
  EXPECT_EQ(*map.key("third", "origin"), "100 100 200");
  EXPECT_EQ(map.run("grid").data["grid_m"], 0.25);
  EXPECT_EQ(map.run("grid off").data["grid_m"], 0.0);
  EXPECT_TRUE(mentions(refusal(map, "grid 3kg"), "length"));
  EXPECT_TRUE(mentions(refusal(map, "grid 0"), "0"));
}

}  // namespace
}  // namespace hallway
