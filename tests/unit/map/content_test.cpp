// SPDX-License-Identifier: MIT
#include "map/content.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "map/reader.hpp"
#include "map/world.hpp"
#include "map_text.hpp"

namespace hallway::map {
namespace {

Brush brush_of(const std::vector<std::string>& materials) {
  Brush brush;
  for (const std::string& material : materials) brush.faces.emplace_back().material = material;
  return brush;
}

Entity entity_of(const std::string& classname) {
  Entity entity;
  entity.add("classname", classname);
  return entity;
}

/// "add", "detail", "subtract", "hint", or the reason why it is left out.
std::string content(const std::string& classname, const std::vector<std::string>& materials) {
  const BrushContent found = brush_content(entity_of(classname), brush_of(materials));
  if (!found.role) return std::string(to_string(found.left_out));
  static const std::map<BrushRole, std::string> names{{BrushRole::kAdd, "add"},
                                                      {BrushRole::kDetail, "detail"},
                                                      {BrushRole::kSubtract, "subtract"},
                                                      {BrushRole::kHint, "hint"}};
  return names.at(*found.role);
}

std::string material_content(const std::string& material) {
  return content("worldspawn", {material});
}

TEST(Content, OrdinaryMaterialsAreSolid) {
  for (const char* name : {"wall", "sky1", "SKY4", "e1u1/sky1", "black", "clipboard", "hint_of_blue",
                           "+0slip", "{fence", "", "originals/a", "skip", "hintskips"})
    EXPECT_EQ(material_content(name), "add") << name;
}

TEST(Content, MaterialsThatAreNoSolids) {
  const std::vector<std::pair<std::string, std::string>> expected{{"*water0", "liquid"},
                                                                  {"*LAVA1", "liquid"},
                                                                  {"!slime", "liquid"},
                                                                  {"textures/liquids/pool", "liquid"},
                                                                  {"clip", "clip"},
                                                                  {"CLIP", "clip"},
                                                                  {"e1u1/clip", "clip"},
                                                                  {"common/weapclip", "clip"},
                                                                  {"e1u1/clip_mon", "clip"},
                                                                  {"trigger", "trigger"},
                                                                  {"AAATRIGGER", "trigger"},
                                                                  {"common/trigger", "trigger"},
                                                                  {"origin", "origin"},
                                                                  {"common/Origin", "origin"},
                                                                  {"common/areaportal", "portal"}};
  for (const auto& [material, what] : expected) EXPECT_EQ(material_content(material), what) << material;
}

TEST(Content, HintsOnlySplit) {
  EXPECT_EQ(content("worldspawn", {"skip", "skip", "hint", "skip"}), "hint");
  EXPECT_EQ(content("func_detail", {"hintskip", "common/HINT"}), "hint");
  EXPECT_EQ(content("hw_subtract", {"hint"}), "hint");
}

TEST(Content, OneFaceDecidesAndTheFirstLineOfTheTableWins) {
  EXPECT_EQ(content("worldspawn", {"wall", "wall", "*water"}), "liquid");
  EXPECT_EQ(content("worldspawn", {"*water", "clip"}), "clip");
  EXPECT_EQ(content("worldspawn", {"clip", "origin"}), "origin");
  EXPECT_EQ(content("worldspawn", {"clip", "hint"}), "hint");
}

TEST(Content, WhatIsTakenAwayHasNoMaterial) {
  EXPECT_EQ(content("hw_subtract", {"*water", "clip", "trigger"}), "subtract");
}

TEST(Content, Classes) {
  const std::vector<std::pair<std::string, std::string>> expected{{"worldspawn", "add"},
                                                                  {"func_group", "add"},
                                                                  {"FUNC_GROUP", "add"},
                                                                  {"hw_add", "add"},
                                                                  {"hw_subtract", "subtract"},
                                                                  {"hw_detail", "detail"},
                                                                  {"func_detail", "detail"},
                                                                  {"Func_Detail_Wall", "detail"},
                                                                  {"func_detail_fence", "detail"},
                                                                  {"func_wall", "detail"},
                                                                  {"func_detail_illusionary", "passable"},
                                                                  {"func_illusionary", "passable"},
                                                                  {"func_illusionary_visblocker", "passable"},
                                                                  {"func_door", "moving"},
                                                                  {"func_door_secret", "moving"},
                                                                  {"func_wall_toggle", "moving"},
                                                                  {"func_plat", "moving"},
                                                                  {"rotate_object", "moving"},
                                                                  {"func_areaportal", "portal"},
                                                                  {"trigger_once", "trigger"},
                                                                  {"monster_ogre", "other class"},
                                                                  {"HW_ADD", "other class"},
                                                                  {"", "other class"}};
  for (const auto& [name, what] : expected) EXPECT_EQ(content(name, {"wall"}), what) << name;
}

TEST(Content, OmittedEntitiesAreLeftOut) {
  Entity entity = entity_of("func_group");
  entity.add("_omitbrushes", "1");
  const BrushContent found = brush_content(entity, brush_of({"wall"}));
  EXPECT_FALSE(found.role);
  EXPECT_EQ(found.left_out, LeftOut::kOmitted);
  entity.keys.back().value = "0";
  EXPECT_TRUE(brush_content(entity, brush_of({"wall"})).role);
}

TEST(Content, BitsOfQuake2) {
  const auto role = [](std::int64_t contents, std::int64_t flags) {
    Brush brush = brush_of({"wall", "wall"});
    brush.faces[1].surface_flags = SurfaceFlags{.contents = contents, .flags = flags, .value = 0.0};
    return brush_content(entity_of("worldspawn"), brush);
  };
  EXPECT_EQ(role(1, 0).role, BrushRole::kAdd);
  EXPECT_EQ(role(0x8000000, 0).role, BrushRole::kDetail);
  EXPECT_EQ(role(0, 0x100).role, BrushRole::kHint);
  EXPECT_EQ(role(0x20, 0).left_out, LeftOut::kLiquid);
  EXPECT_EQ(role(0x8000000 | 0x20, 0).left_out, LeftOut::kLiquid);
  EXPECT_EQ(role(0x10000, 0).left_out, LeftOut::kClip);
  EXPECT_EQ(role(0x40, 0).left_out, LeftOut::kPassable);
}

TEST(Content, FacesThatPicturesLeaveOut) {
  for (const char* name : {"skip", "SKIP", "e1u1/skip", "common/caulk", "nodraw", "hintskip", "NULL"})
    EXPECT_FALSE(is_drawn(name)) << name;
  for (const char* name : {"wall", "sky1", "black", "skipper", "*water"}) EXPECT_TRUE(is_drawn(name)) << name;
}

TEST(Content, TheWorldCountsWhatItLeavesOut) {
  const auto entity = [](const std::string& name, const std::string& material, int brushes) {
    std::string faces = test::cube_faces();
    for (std::size_t at = faces.find("wall"); at != std::string::npos; at = faces.find("wall"))
      faces.replace(at, 4, material);
    std::string text = "{\n\"classname\" \"" + name + "\"\n";
    for (int i = 0; i < brushes; ++i) text += "{\n" + faces + "}\n";
    return text + "}\n";
  };
  const std::string broken = "{\n\"classname\" \"worldspawn\"\n{\n" +
                             test::face_line("( 0 0 0 ) ( 0 0 0 ) ( 0 0 0 )", "clip") + "}\n}\n";
  const World world =
      build_world(parse(entity("worldspawn", "skip", 1) + entity("func_group", "*lava", 2) +
                            entity("trigger_once", "trigger", 1) + entity("func_group", "trigger", 2) +
                            entity("func_door", "metal", 4) + broken,
                        "a.map"));
  EXPECT_EQ(world.solids.size(), 1u);
  EXPECT_FALSE(world.solids[0].faces[0].drawn);
  EXPECT_TRUE(world.problems.empty());
  std::string counts;
  for (const LeftOutCount& count : world.left_out)
    counts += std::string(to_string(count.reason)) + " " + std::to_string(count.brushes) + ", ";
  EXPECT_EQ(counts, "liquid 2, clip 1, trigger 3, moving 4, ");
}

}  // namespace
}  // namespace hallway::map
