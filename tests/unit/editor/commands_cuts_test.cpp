// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/random.hpp"
#include "bsp/point_location.hpp"
#include "bsp/segment.hpp"
#include "map/earth.hpp"
#include "solidity.hpp"
#include "support/long_mode.hpp"
#include "world/compiled_world.hpp"

namespace hallway::test {
namespace {

const Random kRandom(11, stream_id("test.editor.cuts"));

class CutCommands : public testing::Test {
 protected:
  CutCommands() { editing.run("new"); }

  world::CompiledWorld compiled() const {
    return world::compile(editor::document_of(editing.session->state(), "map.map"), {});
  }

  int order(const std::string& what) const { return std::stoi(*named(editing, what).head->find("order")); }

  Vec3 point(std::uint32_t step, std::uint64_t index, double reach) const {
    return {kRandom.uniform(step, 3 * index, -reach, reach),
            kRandom.uniform(step, 3 * index + 1, -reach, reach),
            kRandom.uniform(step, 3 * index + 2, -reach, reach)};
  }

  Editing editing;
};

/// Two rooms with a wall each leave a niche, of which nothing else says that it is none.
TEST_F(CutCommands, AnOpeningThatLeadsNowhereIsFound) {
  const auto blocked = [&] {
    const std::string text = fmt::format("{}", fmt::join(editing.run("validate").lines, "\n"));
    std::size_t count = 0;
    for (std::size_t at = text.find("leads nowhere"); at != std::string::npos;
         at = text.find("leads nowhere", at + 1))
      ++count;
    return count;
  };
  editing.run_all({"room from 0,0 to 6,4 name=kitchen", "room from 6.3,0 to 10,4 name=hall",
                   "room from 0,4.15 to 6,8 name=store", "window in kitchen side=west at 2 pane=glass",
                   "door in kitchen side=north at 2 leaf=oak open=30", "door in kitchen side=south at 2",
                   "arc centre=20,0 radius=3 from=0 to=90 name=bow", "door in bow at 2",
                   "wall from 12,1 to 15,5 name=slanted", "door in slanted at 2 width 0.9"});
  EXPECT_EQ(blocked(), 0u) << "to the outside, to a room behind one wall, in walls of any direction";
  editing.run("door in kitchen side=east at 2");
  EXPECT_EQ(blocked(), 1u);
  editing.run("door in hall side=west at 2");
  EXPECT_EQ(blocked(), 0u) << "both walls are open";
}

/// What fills an opening, what stands before a part of it, and the void around a sealed house do not block it.
TEST_F(CutCommands, AnOpeningThatLeadsOnIsNotBlocked) {
  const auto text = [&] { return fmt::format("{}", fmt::join(editing.run("validate").lines, "\n")); };
  editing.run_all({"room from 0,0 to 5,4 name=kitchen", "window in kitchen side=east at 2 pane=glass",
                   "door in kitchen side=west at 2 leaf=wood", "start 1,1,0.3"});
  ASSERT_EQ(text(), "nothing is wrong") << "a house that is sealed";
  editing.run_all(
      {"wall from 11,3 to 19,3 name=w", "door in w at 4 width=4", "box from 13.95,3.075 to 19,4,2.5"});
  EXPECT_EQ(text(), "nothing is wrong") << "a cupboard before one half of a wide door";
}

/// The pieces of a door in an arc are one opening: what separates them is no way out, and it is reported once.
TEST_F(CutCommands, ADoorInAnArcIsOneOpening) {
  editing.run_all(
      {"arc centre=6,6 radius=3 from=0 to=360 segments=24 name=bow", "door in bow at 5 width=2.5"});
  EXPECT_EQ(editing.run("validate").lines, std::vector<std::string>{"nothing is wrong"});
  editing.run("cylinder at 6,6 radius=3 height=2.7 sides=24");
  int blocked = 0;
  for (const std::string& line : editing.run("validate").lines)
    blocked += mentions(line, "leads nowhere") ? 1 : 0;
  EXPECT_EQ(blocked, 1);
}

TEST_F(CutCommands, ADoorIsWhereItIsSaidToBe) {
  editing.run_all(
      {"wall from 1,1 to 4,5 name=slanted", "door in slanted at 2 width 0.9 height 2.1 name=way"});
  const Vec3 along(0.6, 0.8, 0.0), across(-0.8, 0.6, 0.0), from(1, 1, 0);
  const map::World world = world_of(editing);
  for (const double side : {-0.074, 0.0, 0.074}) {
    const auto at = [&](double place, double height) -> Vec3 {
      return from + place * along + side * across + Vec3(0, 0, height);
    };
    EXPECT_FALSE(is_solid(world, at(1.56, 0.01)));
    EXPECT_FALSE(is_solid(world, at(2.44, 2.09)));
    EXPECT_TRUE(is_solid(world, at(1.54, 1.0)));
    EXPECT_TRUE(is_solid(world, at(2.46, 1.0)));
    EXPECT_TRUE(is_solid(world, at(2.0, 2.11)));
  }
  EXPECT_NEAR(volume(editing, "hw_subtract"), 0.9 * 2.1 * 0.15, 1e-9);
  EXPECT_EQ(order("way"), 1);
  EXPECT_EQ(*named(editing, "way").head->find("_tb_group"), *named(editing, "slanted").head->find("_tb_id"));
}

TEST_F(CutCommands, ASlantedDoorLeavesNoSkin) {
  // Rounded corners would leave a film of the wall in the opening, which nobody sees through.
  for (int i = 0; i < 20; ++i) {
    editing.run("new");
    const double angle = 0.1 + 0.31 * i;
    editing.run(fmt::format("wall from 0,0 to {:.7f},{:.7f} name=w thickness=0.17", 5 * std::cos(angle),
                            5 * std::sin(angle)));
    editing.run("door in w at 2.3 width 0.83");
    const auto world = compiled();
    const Vec3 along(std::cos(angle), std::sin(angle), 0.0), across(-along.y(), along.x(), 0.0);
    const Vec3 middle = 2.3 * along + Vec3(0, 0, 1);
    EXPECT_FALSE(bsp::blocked(world.partition.tree, middle - across, middle + across)) << angle;
    EXPECT_TRUE(bsp::blocked(world.partition.tree, middle + along - across, middle + along + across))
        << angle;
  }
}

TEST_F(CutCommands, AWindowHasASill) {
  editing.run_all({"wall from 0,0,1 to 4,0,1 name=w", "window in w at 2 width 1 height 1.2 sill 0.8"});
  const map::World world = world_of(editing);
  EXPECT_TRUE(is_solid(world, {2, 0, 1.79}));
  EXPECT_FALSE(is_solid(world, {2, 0, 1.81}));
  EXPECT_FALSE(is_solid(world, {2.49, 0, 2.99}));
  EXPECT_TRUE(is_solid(world, {2, 0, 3.01}));
}

TEST_F(CutCommands, ADoorInAnArcFollowsItsChords) {
  editing.run_all(
      {"arc centre=0,0 radius=3 from=0 to=90 segments=6 name=bay", "door in bay at 2.4 width 1.4 name=way"});
  const double step = std::numbers::pi / 12.0, chord = 6.0 * std::sin(step / 2.0);
  const map::World world = world_of(editing);
  for (int i = 1; i < 400; ++i) {
    const double place = 6.0 * chord * i / 400.0;
    if (std::abs(std::abs(place - 2.4) - 0.7) < 1e-6) continue;
    const auto segment = static_cast<int>(place / chord);
    const double in = place - segment * chord;
    if (std::abs(in) < 1e-6 || std::abs(in - chord) < 1e-6) continue;
    const Vec3 a(3.0 * std::cos(segment * step), 3.0 * std::sin(segment * step), 1.0);
    const Vec3 b(3.0 * std::cos((segment + 1) * step), 3.0 * std::sin((segment + 1) * step), 1.0);
    EXPECT_EQ(is_solid(world, a + (b - a) * (in / chord)), std::abs(place - 2.4) > 0.7) << place;
  }
  EXPECT_GE(named(editing, "way").brushes.size(), 2u);
  editing.run("door in bay at 0.4 width 0.6");
  EXPECT_TRUE(mentions(refusal(editing, "door in bay at 4.5 width 0.6"), "long"));
}

TEST_F(CutCommands, DoorsConnectTwoRooms) {
  editing.run_all({"room from 0,0 to 4,3 name=a", "room from 4.15,0 to 8,3 name=b",
                   "entity hw_robot_start at=1,1.5,0.2"});
  EXPECT_TRUE(compiled().sealed());
  const Vec3 in_a(3, 1.5, 1), in_b(5, 1.5, 1);
  EXPECT_TRUE(bsp::blocked(compiled().partition.tree, in_a, in_b));
  editing.run("door in a side=east at 1.5 name=way");
  EXPECT_EQ(order("way"), 2);
  const auto world = compiled();
  EXPECT_TRUE(world.sealed());
  EXPECT_FALSE(bsp::blocked(world.partition.tree, in_a, in_b));
  EXPECT_TRUE(bsp::blocked(world.partition.tree, {3, 2.5, 1}, {5, 2.5, 1}));
  for (int i = 0; i <= 100; ++i) EXPECT_FALSE(is_solid(world.brushes, in_a + (in_b - in_a) * (i / 100.0)));
  ASSERT_TRUE(world.visible.has_value());
  const auto cluster = [&](const Vec3& point) {
    return static_cast<std::uint32_t>(bsp::cluster_at(world.partition.tree, point));
  };
  EXPECT_TRUE(world.visible->visible(cluster({1, 1.5, 0.2}), cluster({7, 1.5, 0.2})));
  // Where the rooms share the wall, the other room's door there is the same place.
  EXPECT_TRUE(mentions(refusal(editing, "door in b side=west at 1.2"), "overlaps"));
  editing.run("door in b side=west at 2.5");
}

TEST_F(CutCommands, TheFloorGoesOnThroughADoor) {
  editing.run_all({"room from 0,0 to 4,3 name=a material=brick floor_material=wood",
                   "door in a side=east at 1 name=way", "window in a side=north at 2 name=view",
                   "door in a side=west at 1 material=metal name=gate"});
  const auto material_below = [&](const std::string& name) {
    for (const map::Face& face : named(editing, name).brushes.front().brush->faces) {
      if (editor::plane_of(face)->normal.z() < -0.5) return face.material;
    }
    return std::string();
  };
  EXPECT_EQ(material_below("way"), "wood");
  EXPECT_EQ(material_below("view"), "brick");
  EXPECT_EQ(material_below("gate"), "metal");
}

TEST_F(CutCommands, EachSideOfARoomHasItsWall) {
  editing.run_all({"room from 0,0 to 6,4 wall=0.2 name=r", "window in r side=north at 1 width 0.5",
                   "window in r side=south at 2 width 0.5", "window in r side=east at 1 width 0.5",
                   "window in r side=west at 3 width 0.5"});
  const map::World world = world_of(editing);
  for (const Vec3& hole : {Vec3(1, 4.1, 1.5), Vec3(2, -0.1, 1.5), Vec3(6.1, 1, 1.5), Vec3(-0.1, 3, 1.5)})
    EXPECT_FALSE(is_solid(world, hole)) << hole.transpose();
  for (const Vec3& wall : {Vec3(2, 4.1, 1.5), Vec3(1, -0.1, 1.5), Vec3(6.1, 3, 1.5), Vec3(-0.1, 1, 1.5)})
    EXPECT_TRUE(is_solid(world, wall)) << wall.transpose();
}

TEST_F(CutCommands, ADoorInAPlainBlockAndInATurnedOne) {
  editing.run("box from 1,1 to 1.2,5,2.5");
  editing.run("door in box=1,1,0,1.2,5,2.5 at 1");  // from the south end
  EXPECT_FALSE(is_solid(editing, {1.1, 2, 1}));
  EXPECT_TRUE(is_solid(editing, {1.1, 4, 1}));
  editing.run_all({"new", "wall from 0,0 to 4,0 name=w", "rotate w by 90 about=0,0"});
  editing.run("door in w at 1");
  EXPECT_FALSE(is_solid(editing, {0, 1, 1}));
  EXPECT_TRUE(is_solid(editing, {0, 3, 1}));
}

TEST_F(CutCommands, AWallInARoomIsAddedAfterItAndItsDoorAfterThat) {
  editing.run_all({"room from 0,0 to 6,4 name=r", "wall from 3,0 to 3,4 name=w", "door in w at 2 name=way",
                   "entity hw_robot_start at=1,2,0.2"});
  EXPECT_EQ(order("way"), 3);
  const auto world = compiled();
  EXPECT_TRUE(world.sealed());
  EXPECT_FALSE(bsp::blocked(world.partition.tree, {1, 2, 1}, {5, 2, 1}));
  EXPECT_TRUE(bsp::blocked(world.partition.tree, {1, 3, 1}, {5, 3, 1}));
}

TEST_F(CutCommands, WhatIsPutIntoAnOpeningIsThere) {
  editing.run_all({"wall from 0,0 to 6,0 name=north", "door in north at 2 name=way",
                   "window in north at 4.5 name=view",
                   "box from 3.9,-0.01,0.9 to 5.1,0.01,2.1 material=glass",
                   "box from 1.55,-0.02,0 to 1.6,0.02,2.1 material=wood name=leaf"});
  EXPECT_TRUE(is_solid(editing, {4.5, 0, 1.5})) << "the pane";
  EXPECT_TRUE(is_solid(editing, {1.57, 0, 1})) << "the leaf";
  EXPECT_FALSE(is_solid(editing, {2.2, 0, 1})) << "the rest of the door stays open";
  EXPECT_FALSE(is_solid(editing, {4.5, 0.05, 1.5}));
  editing.run("remake leaf to=2.45,0.02,2.1");
  EXPECT_TRUE(is_solid(editing, {2.2, 0, 1}));
}

TEST_F(CutCommands, AnOpeningSaysWhatItCutsAway) {
  editing.run_all({"wall from 0,0 to 6,0 name=north", "box from 1.9,-0.02,0.5 to 2.1,0.02,1 name=shelf",
                   "box from 4,-1,0.5 to 4.2,1,1 name=beam"});
  const auto said = editing.run("door in north at 2").lines;
  ASSERT_EQ(said.size(), 2u);
  EXPECT_TRUE(mentions(said[0], "cuts away all of")) << said[0];
  EXPECT_TRUE(mentions(said[0], "shelf") || mentions(said[0], "#")) << said[0];
  EXPECT_EQ(editing.run("door in north at 4").lines.size(), 1u) << "of the beam something is left";
}

TEST_F(CutCommands, PanesAndLeaves) {
  editing.run_all({"room from 0,0 to 5,4 name=kitchen wall=0.2", "entity hw_robot_start at=1,1,0.2"});
  editing.run("window in kitchen side=east at 2 pane=glass name=view");
  EXPECT_TRUE(compiled().sealed());
  EXPECT_TRUE(is_solid(editing, {5.1, 2, 1.5}));
  EXPECT_FALSE(is_solid(editing, {5.05, 2, 1.5}));
  EXPECT_FALSE(is_solid(editing, {5.15, 2, 1.5}));
  editing.run("remake view pane=");
  EXPECT_FALSE(is_solid(editing, {5.1, 2, 1.5}));
  EXPECT_FALSE(compiled().sealed());
  editing.run("remake view pane=glass width=1.6");
  EXPECT_TRUE(is_solid(editing, {5.1, 2.75, 1.5}));
  EXPECT_TRUE(compiled().sealed());
  editing.run("door in kitchen side=south at 2 width=1 leaf=wood name=way");
  EXPECT_TRUE(compiled().sealed()) << "a closed leaf seals";
  editing.run("remake way open=90");
  EXPECT_FALSE(compiled().sealed());
  // From the west jamb into the room.
  EXPECT_TRUE(is_solid(editing, {1.5, 0.8, 1}));
  EXPECT_FALSE(is_solid(editing, {2, -0.1, 1}));
  EXPECT_FALSE(is_solid(editing, {1.6, 0.8, 1}));
  editing.run("remake way open=-60");
  EXPECT_TRUE(is_solid(editing, {1.5 + 0.6 * std::cos(M_PI / 3), -0.1 - 0.6 * std::sin(M_PI / 3), 1}));
  // Both stay with their wall when that is remade or moved, and go with their opening.
  editing.run("remake kitchen height=3");
  EXPECT_TRUE(is_solid(editing, {5.1, 2.75, 1.5}));
  editing.run("move kitchen by 0,1");
  EXPECT_TRUE(is_solid(editing, {5.1, 3, 1.5}));
  editing.run("remake view pane=");
  EXPECT_FALSE(is_solid(editing, {5.1, 3, 1.5}));
  editing.run("remake view pane=glass");
  editing.run("delete view");
  EXPECT_TRUE(is_solid(editing, {5.18, 3, 1.5})) << "the wall is whole again";
  EXPECT_EQ(editing.run("find _hw_fill").lines.size(), 1u) << "the leaf alone is left";
}

TEST_F(CutCommands, APaneGoesWithItsWindow) {
  editing.run_all({"room from 0,0 to 5,6 name=kitchen wall=0.2", "entity hw_robot_start at=1,1,0.2",
                   "window in kitchen side=east at 1 width=0.6 pane=glass name=view"});
  editing.run("move view by 0,0.5");
  EXPECT_TRUE(is_solid(editing, {5.1, 1.75, 1.5}));
  EXPECT_FALSE(is_solid(editing, {5.05, 1.75, 1.5}));
  EXPECT_TRUE(compiled().sealed());
  editing.run("duplicate view by 0,1.2");
  EXPECT_TRUE(is_solid(editing, {5.1, 2.95, 1.5}));
  EXPECT_FALSE(is_solid(editing, {5.05, 2.95, 1.5}));
  EXPECT_TRUE(compiled().sealed());
  editing.run("align view to=0,4.7,0 side=front");
  EXPECT_FALSE(is_solid(editing, {5.05, 5, 1.5}));
  EXPECT_TRUE(is_solid(editing, {5.05, 1.5, 1.5})) << "the wall is whole there";
  EXPECT_TRUE(compiled().sealed());
}

TEST_F(CutCommands, PanesInAnArcFollowIt) {
  editing.run_all({"arc centre=0,0 radius=3 from=0 to=90 segments=6 name=bay",
                   "window in bay at 2.4 width=1.4 pane=glass name=view"});
  const double step = std::numbers::pi / 12.0, chord = 6.0 * std::sin(step / 2.0);
  for (int i = 1; i < 40; ++i) {
    const double place = 1.7 + 1.4 * i / 40.0;
    const auto segment = static_cast<int>(place / chord);
    const double share = (place - segment * chord) / chord;
    const Vec3 a(3.0 * std::cos(segment * step), 3.0 * std::sin(segment * step), 1.5);
    const Vec3 b(3.0 * std::cos((segment + 1) * step), 3.0 * std::sin((segment + 1) * step), 1.5);
    const Vec3 outward = Vec3(a.x() + b.x(), a.y() + b.y(), 0).normalized();
    const Vec3 at = a + share * (b - a);
    EXPECT_TRUE(is_solid(editing, at)) << place;
    EXPECT_FALSE(is_solid(editing, at + 0.03 * outward)) << place;
  }
}

TEST_F(CutCommands, PaneAndLeafRefusals) {
  editing.run("wall from 0,0 to 6,0 name=north");
  EXPECT_TRUE(mentions(refusal(editing, "door in north at 2 open=30"), "no leaf"));
  EXPECT_TRUE(mentions(refusal(editing, "door in north at 2 leaf=wood open=170"), "135"));
  EXPECT_TRUE(mentions(refusal(editing, "door in north at 2 pane=glass"), "no argument"));
}

TEST_F(CutCommands, OpeningRefusals) {
  editing.run_all({"wall from 0,0 to 6,0 name=north", "room from 0,5 to 4,8 name=kitchen",
                   "cylinder at 9,9 radius 1 height 2 name=post", "door in north at 2 name=way",
                   "entity light at=1,1,1 targetname=lamp"});
  EXPECT_TRUE(mentions(refusal(editing, "door in north at 0.4"), "6 m long"));
  EXPECT_TRUE(mentions(refusal(editing, "door in north at 5.6"), "6 m long"));
  EXPECT_TRUE(mentions(refusal(editing, "door in north at 4 height 2.8"), "2.7 m high"));
  EXPECT_TRUE(mentions(refusal(editing, "window in north at 4 sill 2 height 1"), "2.7 m high"));
  EXPECT_TRUE(mentions(refusal(editing, "window in north at 2.5 sill 2 height 0.5"), "overlaps"));
  EXPECT_EQ(refusal(editing, "window in north at 2 sill 2.1 height 0.5"), "");  // over the door
  EXPECT_TRUE(mentions(refusal(editing, "door in nort at 2"), "did you mean \"north\""));
  EXPECT_TRUE(mentions(refusal(editing, "door in kitchen at 2"), "say `side`"));
  EXPECT_TRUE(mentions(refusal(editing, "door in kitchen at 2 side=up"), "not one of"));
  EXPECT_TRUE(mentions(refusal(editing, "door in north at 4 side=east"), "no room"));
  EXPECT_TRUE(mentions(refusal(editing, "door in kitchen at 3 side=east"), "3 m long"));
  EXPECT_TRUE(mentions(refusal(editing, "door in post at 1"), "no wall"));
  EXPECT_TRUE(mentions(refusal(editing, "door in lamp at 1"), "no wall"));
  EXPECT_TRUE(mentions(refusal(editing, "door in north+post at 1"), "2 things"));
  EXPECT_TRUE(mentions(refusal(editing, "door in north at 4 name=way"), "has that name"));
  EXPECT_TRUE(mentions(refusal(editing, "door in north at 4kg"), "no length"));
  EXPECT_TRUE(mentions(refusal(editing, "door in north"), "`at`"));
  EXPECT_TRUE(mentions(refusal(editing, "door in selected at 2"), "nothing is selected"));
  EXPECT_TRUE(mentions(refusal(editing, "window in north at 4 sill=-1"), "sill"));
}

TEST_F(CutCommands, ADoorIsCalledADoor) {
  editing.run("wall from 0,0 to 6,0 name=north");
  EXPECT_EQ(editing.run("door in north at 2").lines.back(), "made #4 door");
  EXPECT_EQ(editing.run("window in north at 4 name=view").lines.back(), "made #6 window view");
}

TEST_F(CutCommands, SubtractMakesACut) {
  editing.run_all({"box from 0,0 to 4,4,3", "box from 1,1,1 to 2,4,2 name=niche", "subtract niche"});
  EXPECT_EQ(named(editing, "niche").classname(), "hw_subtract");
  EXPECT_EQ(editing.session->state().entities.size(), 2u);  // the group is gone
  EXPECT_FALSE(is_solid(editing, {1.5, 3, 1.5}));
  EXPECT_TRUE(is_solid(editing, {1.5, 3, 2.5}));
  EXPECT_TRUE(mentions(refusal(editing, "subtract niche"), "no solid"));
}

TEST_F(CutCommands, SubtractCutsWhatWasAddedAfterACut) {
  editing.run_all({"room from 0,0 to 5,4 name=r", "box from 1,1 to 3,3,1 name=block",
                   "box from 1.5,1.5 to 2,2,1 name=hole"});
  editing.run("subtract hole");
  EXPECT_FALSE(is_solid(editing, {1.7, 1.7, 0.5}));
  EXPECT_TRUE(is_solid(editing, {2.5, 2.5, 0.5}));
  editing.run("box from 1.5,1.5 to 2,2,0.1 name=again");
  editing.run("subtract again order=2");
  EXPECT_EQ(order("again"), 2);
}

TEST_F(CutCommands, SubtractOfSomeBrushesOfAGroupStaysInIt) {
  editing.run("stairs from 0,0 to 3,0 rise=1 steps=3 name=flight");
  const auto first = named(editing, "flight").brushes.front().id;
  editing.run(fmt::format("subtract {} name=gap", first));
  EXPECT_EQ(*named(editing, "gap").head->find("_tb_group"), *named(editing, "flight").head->find("_tb_id"));
  EXPECT_EQ(named(editing, "flight").brushes.size(), 2u);
  EXPECT_TRUE(mentions(refusal(editing, "remake flight steps=4"), "does not know"));
}

TEST_F(CutCommands, SubtractRefusals) {
  editing.run_all(
      {"room 0,0 4,4 name=r", "entity light at=1,1,1 targetname=lamp", "box 9,9 10,10,1 name=crate"});
  EXPECT_TRUE(mentions(refusal(editing, "subtract r"), "no solid"));
  EXPECT_TRUE(mentions(refusal(editing, "subtract lamp"), "no brushes"));
  EXPECT_TRUE(mentions(refusal(editing, "subtract crat"), "did you mean \"crate\""));
  EXPECT_TRUE(mentions(refusal(editing, "subtract crate order=x"), "whole number"));
  EXPECT_TRUE(mentions(refusal(editing, "subtract crate name=lamp"), "has that name"));
  EXPECT_TRUE(mentions(refusal(editing, "subtract"), "`what`"));
  EXPECT_TRUE(mentions(refusal(editing, "subtract selected"), "nothing is selected"));
}

TEST_F(CutCommands, AddPutsShapesTogetherAfterTheCut) {
  editing.run_all({"room from 0,0 to 5,4 name=r", "cylinder at 1,1 radius 0.2 height 2 name=pillar",
                   "duplicate pillar by 2,0", "add pillar* name=pillars"});
  EXPECT_EQ(named(editing, "pillars").classname(), "hw_add");
  EXPECT_EQ(named(editing, "pillars").brushes.size(), 2u);
  EXPECT_EQ(order("pillars"), 2);  // after the room, whose order is 1
  EXPECT_TRUE(is_solid(editing, {1, 1, 1}));
  EXPECT_TRUE(is_solid(editing, {3, 1, 1}));
  editing.run("add pillars order=5");
  EXPECT_EQ(order("pillars"), 5);
}

TEST_F(CutCommands, DetailIsSolidAndDividesNothing) {
  editing.run_all(
      {"room from 0,0 to 5,4 name=r", "start at 0.5,0.5,0.1", "box from 2,0.1 to 2.2,3.9,2.5 name=screen"});
  const auto clusters = [&] { return compiled().partition.portals.clusters; };
  const auto divided = clusters();
  editing.run("detail screen");
  EXPECT_EQ(named(editing, "screen").classname(), "hw_detail");
  EXPECT_TRUE(is_solid(editing, {2.1, 2, 1}));
  EXPECT_GT(divided, 1u);
  EXPECT_EQ(clusters(), 1u);
}

TEST_F(CutCommands, AGnssZoneIsNotSolid) {
  editing.run_all(
      {"room from 0,0 to 5,4 name=r", "start at 0.5,0.5,0.1", "box from 2,1 to 3,2,2.5 name=roof"});
  EXPECT_TRUE(is_solid(editing, {2.5, 1.5, 1}));
  editing.run("gnss_zone roof factor=5");
  EXPECT_EQ(named(editing, "roof").classname(), "hw_gnss_zone");
  EXPECT_FALSE(is_solid(editing, {2.5, 1.5, 1}));
  const map::Earth earth = map::earth_of(editor::document_of(editing.session->state(), "map.map"));
  ASSERT_EQ(earth.zones.size(), 1u);
  EXPECT_EQ(earth.zones.front().factor, 5.0);
  for (const Plane& plane : earth.zones.front().planes) EXPECT_LT(plane.distance({2.5, 1.5, 1}), 0.0);
  EXPECT_TRUE(mentions(refusal(editing, "gnss_zone roof factor=0.5"), "below 1"));
  EXPECT_TRUE(mentions(refusal(editing, "gnss_zone r"), "no solid"));
}

/// Groups of groups go with the last that was in them.
TEST_F(CutCommands, NothingEmptyStaysOfGroupsOfGroups) {
  editing.run_all({"box from 0,0 to 1,1,1 name=a", "box from 2,0 to 3,1,1 name=b", "group a+b both",
                   "duplicate both by 0,5", "detail both* name=all"});
  EXPECT_EQ(editing.session->state().entities.size(), 2u) << editing.text();  // worldspawn and the detail
  EXPECT_EQ(named(editing, "all").brushes.size(), 4u);
}

TEST_F(CutCommands, AddAndDetailRefusals) {
  editing.run_all(
      {"room 0,0 4,4 name=r", "entity light at=1,1,1 targetname=lamp", "box 9,9 10,10,1 name=crate"});
  for (const std::string command : {"add", "detail"}) {
    EXPECT_TRUE(mentions(refusal(editing, command + " r"), "no solid"));
    EXPECT_TRUE(mentions(refusal(editing, command + " lamp"), command + ": "));
    EXPECT_TRUE(mentions(refusal(editing, command + " crat"), "did you mean \"crate\""));
    EXPECT_TRUE(mentions(refusal(editing, command + " crate order=x"), "whole number"));
    EXPECT_TRUE(mentions(refusal(editing, command + " crate name=lamp"), "has that name"));
    EXPECT_TRUE(mentions(refusal(editing, command), "`what`"));
    EXPECT_TRUE(mentions(refusal(editing, command + " selected"), "nothing is selected"));
  }
}

TEST_F(CutCommands, IntersectKeepsWhatBothHold) {
  for (std::uint32_t step = 0; step < sized(10u, 200u); ++step) {
    editing.run("new");
    editing.run("cylinder at 0,0 radius 1 height 2 sides=7 name=a");
    const Vec3 low = point(step, 0, 0.8), size = point(step, 1, 0.5) + Vec3(1.0, 1.0, 1.0);
    editing.run(fmt::format("box from {},{},{} to {},{},{} name=b", low.x(), low.y(), low.z() + 1,
                            low.x() + size.x(), low.y() + size.y(), low.z() + 1 + size.z()));
    const map::World before = world_of(editing);
    ASSERT_EQ(before.solids.size(), 2u);
    if (!mentions(refusal(editing, "intersect a with b name=c"), "no volume")) {
      const map::World after = world_of(editing);
      for (std::uint64_t i = 10; i < 60; ++i) {
        const Vec3 p = point(step, i, 1.5) + Vec3(0, 0, 1);
        if (before.solids[0].contains(p, -1e-6) != before.solids[0].contains(p, 1e-6) ||
            before.solids[1].contains(p, -1e-6) != before.solids[1].contains(p, 1e-6))
          continue;
        EXPECT_EQ(is_solid(after, p), before.solids[0].contains(p) && before.solids[1].contains(p)) << step;
      }
      EXPECT_EQ(editing.session->state().entities.size(), 2u);
    }
  }
}

TEST_F(CutCommands, IntersectOfSetsIsEveryPair) {
  editing.run_all({"prism 0,0;4,0;4,1;1,1;1,3;0,3 height 1 name=angle",
                   "box from 0.5,0.5 to 3,2.5,3 name=block", "intersect angle with block name=both"});
  EXPECT_NEAR(volume(editing), 2.5 * 0.5 + 0.5 * 1.5, 1e-9);
  EXPECT_LT(largest_overlap(editing), 1e-12);
  editing.run_all({"box 9,9 10,10,1 name=far", "box 9.5,9 11,10,1 name=near"});
  EXPECT_TRUE(mentions(refusal(editing, "intersect both with far"), "no volume in common"));
  EXPECT_TRUE(mentions(refusal(editing, "intersect far with far"), "in both"));
  EXPECT_TRUE(mentions(refusal(editing, "intersect far with nearr"), "did you mean \"near\""));
  EXPECT_TRUE(mentions(refusal(editing, "intersect far with near name=both"), "has that name"));
  EXPECT_TRUE(mentions(refusal(editing, "intersect far"), "`with`"));
  editing.run_all({"subtract near"});
  EXPECT_TRUE(mentions(refusal(editing, "intersect far with near"), "no solid"));
}

TEST_F(CutCommands, HollowLeavesTheOutside) {
  for (const std::string joints : {"mitred", "slabs"}) {
    editing.run("new");
    editing.run("cylinder at 0,0 radius 1 height 2 sides=9 name=tank");
    const double full = volume(editing);
    editing.run("hollow tank thickness 5cm joints=" + joints + " material=metal");
    EXPECT_EQ(named(editing, "tank").brushes.size(), 11u);
    EXPECT_LT(largest_overlap(editing), 1e-9);
    // The inside is a cylinder too: its flat sides and its ends are 5 cm further in.
    const double apothem = std::cos(std::numbers::pi / 9.0);
    const double inside = full * std::pow((apothem - 0.05) / apothem, 2) * 1.9 / 2.0;
    EXPECT_NEAR(volume(editing), full - inside, 1e-6);
    EXPECT_FALSE(is_solid(editing, {0, 0, 1}));
    EXPECT_TRUE(is_solid(editing, {0.01, 0.02, 0.04}));
  }
  EXPECT_TRUE(mentions(refusal(editing, "remake tank sides=5"), "does not know"));
}

TEST_F(CutCommands, HollowingAPlainBrushMakesAGroup) {
  editing.run_all({"box from 0,0 to 2,2,2", "box from 3,0 to 5,2,2"});
  editing.run("hollow box=0,0,0,2,2,2 thickness 0.2 name=crate");
  EXPECT_EQ(named(editing, "crate").brushes.size(), 6u);
  EXPECT_NEAR(volume(editing, "func_group"), 8.0 - 1.6 * 1.6 * 1.6, 1e-9);
  EXPECT_NEAR(volume(editing, "worldspawn"), 8.0, 1e-9);
}

TEST_F(CutCommands, HollowRefusals) {
  editing.run_all({"box from 0,0 to 1,1,1 name=crate", "room from 3,0 to 6,4 name=r",
                   "entity light at=1,1,1 targetname=lamp", "stairs 9,0 12,0 rise=1 steps=2 name=flight"});
  EXPECT_TRUE(mentions(refusal(editing, "hollow crate thickness 0.5"), "too thin"));
  EXPECT_TRUE(mentions(refusal(editing, "hollow crate thickness 1kg"), "no length"));
  EXPECT_TRUE(mentions(refusal(editing, "hollow crate joints=glued"), "not one of"));
  EXPECT_TRUE(mentions(refusal(editing, "hollow r"), "no solid"));
  EXPECT_TRUE(mentions(refusal(editing, "hollow lamp"), "no brushes"));
  EXPECT_TRUE(mentions(refusal(editing, "hollow crat"), "did you mean \"crate\""));
  EXPECT_TRUE(mentions(refusal(editing, "hollow flight thickness=1cm name=x"), "one name"));
  EXPECT_TRUE(mentions(refusal(editing, "hollow crate thickness=1cm name=lamp"), "has that name"));
}

TEST_F(CutCommands, ClipKeepsASideOrBoth) {
  editing.run_all({"box from 0,0 to 3,1,1 name=block", "clip block axis=x at=1"});
  EXPECT_NEAR(volume(editing), 1.0, 1e-9);
  EXPECT_TRUE(is_solid(editing, {0.5, 0.5, 0.5}));
  editing.run_all({"undo", "clip block x 1 keep=front"});
  EXPECT_NEAR(volume(editing), 2.0, 1e-9);
  EXPECT_TRUE(is_solid(editing, {2.5, 0.5, 0.5}));
  editing.run_all({"undo", "clip block axis=x at=1 keep=both material=metal"});
  EXPECT_EQ(named(editing, "block").brushes.size(), 2u);
  EXPECT_NEAR(volume(editing), 3.0, 1e-9);
  EXPECT_LT(largest_overlap(editing), 1e-12);
}

TEST_F(CutCommands, ClipByThreePlacesAgreesWithThePlane) {
  for (std::uint32_t step = 0; step < sized(20u, 500u); ++step) {
    editing.run("new");
    editing.run("prism -1,-1;1,-1;1,0;0,0;0,1;-1,1 height=2 z=-1 name=s");
    std::string through;
    std::vector<Vec3> places;
    for (std::uint64_t i = 0; i < 3; ++i) {
      const Vec3 p = (point(step, i, 0.9) * 1e3).array().round() / 1e3;
      places.push_back(p);
      through += fmt::format("{}{},{},{}", i == 0 ? "" : ";", p.x(), p.y(), p.z());
    }
    const Vec3 normal = (places[1] - places[0]).cross(places[2] - places[0]).normalized();
    const map::World before = world_of(editing);
    const std::string keep = step % 3 == 0 ? "front" : step % 3 == 1 ? "back" : "both";
    const double full = volume(editing);
    editing.run("clip s through=" + through + " keep=" + keep);
    if (keep == "both") {
      EXPECT_NEAR(volume(editing), full, 1e-8);
    }
    const map::World after = world_of(editing);
    for (std::uint64_t i = 10; i < 60; ++i) {
      const Vec3 p = point(step, i, 1.2);
      const double front = normal.dot(p - places[0]);
      if (std::abs(front) < 1e-6) continue;
      const bool kept = keep == "both" || (front > 0.0) == (keep == "front");
      EXPECT_EQ(is_solid(after, p), is_solid(before, p) && kept) << step;
    }
  }
}

TEST_F(CutCommands, ClippingAShapeTakesWhatIsBeyondAltogether) {
  editing.run_all({"stairs from 0,0 to 3,0 rise=1 steps=3 name=flight", "clip flight x 1.5"});
  EXPECT_EQ(named(editing, "flight").brushes.size(), 2u);
  editing.run_all({"box 9,0 10,1,1 name=a", "box 12,0 13,1,1 name=b", "clip a+b x 11 keep=front"});
  EXPECT_TRUE(mentions(refusal(editing, "delete a"), "nothing named"));
  EXPECT_EQ(named(editing, "b").brushes.size(), 1u);
}

TEST_F(CutCommands, ClippingARoomClipsItsInside) {
  editing.run_all({"room from 0,0 to 4,3 name=r", "clip r axis=x at=2"});
  EXPECT_NEAR(volume(editing, "hw_subtract"), 2.0 * 3.0 * 2.7, 1e-9);
  EXPECT_TRUE(mentions(refusal(editing, "door in r at 1"), "no wall"));
}

TEST_F(CutCommands, ClipRefusals) {
  editing.run_all({"box from 0,0 to 3,1,1 name=block", "entity light at=1,1,1 targetname=lamp"});
  EXPECT_TRUE(mentions(refusal(editing, "clip block"), "either"));
  EXPECT_TRUE(mentions(refusal(editing, "clip block axis=x"), "either"));
  EXPECT_TRUE(mentions(refusal(editing, "clip block axis=x at=1 through=0,0;1,0;0,1"), "either"));
  EXPECT_TRUE(mentions(refusal(editing, "clip block through=0,0;1,0"), "three places"));
  EXPECT_TRUE(mentions(refusal(editing, "clip block through=0,0;1,0;2,0"), "one line"));
  EXPECT_TRUE(mentions(refusal(editing, "clip block axis=x at=5"), "takes nothing away"));
  EXPECT_TRUE(mentions(refusal(editing, "clip block axis=x at=3 keep=both"), "takes nothing away"));
  EXPECT_TRUE(mentions(refusal(editing, "clip block axis=x at=-1"), "nothing would be left"));
  EXPECT_TRUE(mentions(refusal(editing, "clip block axis=w at=1"), "not one of"));
  EXPECT_TRUE(mentions(refusal(editing, "clip blok axis=x at=1"), "did you mean \"block\""));
  EXPECT_TRUE(mentions(refusal(editing, "clip lamp axis=x at=1"), "no brushes"));
  EXPECT_TRUE(mentions(refusal(editing, "clip selected axis=x at=1"), "nothing is selected"));
}

}  // namespace
}  // namespace hallway::test
