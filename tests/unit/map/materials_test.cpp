// SPDX-License-Identifier: MIT
#include "map/materials.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "base/toml_reader.hpp"
#include "map/check.hpp"
#include "map/reader.hpp"
#include "support/data.hpp"
#include "support/errors.hpp"
#include "support/room_maps.hpp"
#include "support/temp_folder.hpp"

namespace hallway::map {
namespace {

MaterialTable table_of(const std::string& text, std::vector<Setting>* settings = nullptr) {
  std::vector<Setting> unused;
  const TomlTable root = parse_toml(text, "m.toml");
  return MaterialTable::read(std::get<TomlTable>(find(root, "material")->value), "m.toml",
                             settings != nullptr ? *settings : unused);
}

TEST(Materials, WithoutATableHaveTheDefaults) {
  EXPECT_EQ(MaterialTable().of("anything"), (MaterialProperties{.reflectance = 0.5, .lidar_dropout = 0.0}));
  EXPECT_TRUE(MaterialTable().empty());
}

TEST(Materials, TheVeryNameGoesBeforePatternsAndThoseInTheirOrder) {
  const MaterialTable table = table_of(
      "[material.'glass*']\nreflectance = 0.1\nlidar_dropout = 0.7\n"
      "[material.'*dark*']\nreflectance = 0.2\nlidar_dropout = 0.3\n"
      "[material.glass_dark]\nreflectance = 0.05\n");
  EXPECT_EQ(table.of("glass_dark"), (MaterialProperties{0.05, 0.7}))
      << "what the name does not say, a pattern does";
  EXPECT_EQ(table.of("glass_dark2"), (MaterialProperties{0.1, 0.7}));
  EXPECT_EQ(table.of("a_dark_wall"), (MaterialProperties{0.2, 0.3}));
  EXPECT_EQ(table.of("wall"), MaterialProperties());
}

TEST(Materials, FoldersAndCaseDoNotCount) {
  const MaterialTable table = table_of("[material.Glass]\nreflectance = 0.1\n");
  EXPECT_EQ(table.of("textures/base/GLASS").reflectance, 0.1);
  EXPECT_EQ(table.of("glass/wall").reflectance, 0.5);
}

TEST(Materials, APatternsStarIsAnyText) {
  const MaterialTable table = table_of(
      "[material.'a*b*c']\nreflectance = "
      "0.1\n[material.'*']\nreflectance = 0.2\n");
  for (const char* fits : {"abc", "axxbyyc", "abbcbc", "a/abc"})
    EXPECT_EQ(table.of(fits).reflectance, 0.1) << fits;
  for (const char* other : {"ab", "abcd", "xabc", "acb", ""})
    EXPECT_EQ(table.of(other).reflectance, 0.2) << other;
}

TEST(Materials, LikeSaysWhatTheEntryDoesNot) {
  const MaterialTable table = table_of(
      "[material.c]\nlike = 'B'\n[material.b]\nlike = "
      "'a'\nlidar_dropout = 0.25\n"
      "[material.a]\nreflectance = 0.9\nlidar_dropout = 0.5\n");
  EXPECT_EQ(table.of("a"), (MaterialProperties{0.9, 0.5}));
  EXPECT_EQ(table.of("b"), (MaterialProperties{0.9, 0.25}));
  EXPECT_EQ(table.of("c"), (MaterialProperties{0.9, 0.25}));
}

TEST(Materials, ATableBelowSaysWhatTheUpperDoesNot) {
  MaterialTable table = table_of("[material.'*']\nlidar_dropout = 0.1\n");
  table.add_below(table_of("[material.wall]\nreflectance = 0.3\nlidar_dropout = 0.4\n"));
  EXPECT_EQ(table.of("wall"), (MaterialProperties{0.3, 0.1}))
      << "even a pattern above goes before a name below";
  EXPECT_EQ(table.of("door"), (MaterialProperties{0.5, 0.1}));
}

TEST(Materials, SettingsAreNoted) {
  std::vector<Setting> settings;
  table_of("[material.wall]\nreflectance = 0.3\n", &settings);
  ASSERT_EQ(settings.size(), 1u);
  EXPECT_EQ(settings[0].key, "material.wall.reflectance");
  EXPECT_EQ(settings[0].value, "0.3");
  EXPECT_EQ(settings[0].origin, "m.toml:2");
}

struct BadTable {
  const char* name;
  std::string text;
  int line;
  std::string message;
};

class BadMaterials : public testing::TestWithParam<BadTable> {};

TEST_P(BadMaterials, AreRefused) {
  const auto error = test::error_of([&] { table_of(GetParam().text); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_EQ(error->where().file, "m.toml");
  EXPECT_EQ(error->where().line, GetParam().line) << error->what();
  EXPECT_NE(std::string(error->what()).find(GetParam().message), std::string::npos) << error->what();
}

INSTANTIATE_TEST_SUITE_P(
    All, BadMaterials,
    testing::Values(BadTable{"UnknownKey", "[material.a]\nreflectence = 0.1\n", 2,
                             "did you mean \"reflectance\"?"},
                    BadTable{"TooLarge", "[material.a]\nreflectance = 1.01\n", 2, "out of range"},
                    BadTable{"Negative", "[material.a]\nlidar_dropout = -0.1\n", 2, "out of range"},
                    BadTable{"NotANumber", "[material.a]\nreflectance = nan\n", 2, "nan is out of range"},
                    BadTable{"Infinite", "[material.a]\nreflectance = inf\n", 2, "out of range"},
                    BadTable{"Text", "[material.a]\nreflectance = 'much'\n", 2, "must be a number"},
                    BadTable{"NoTable", "[material]\na = 0.5\n", 2, "[material.NAME]"},
                    BadTable{"Twice",
                             "[material.a]\nreflectance = 0.1\n[material.A]\nreflectance = "
                             "0.2\n",
                             3, "the same material as `a` at line 1"},
                    BadTable{"Folder", "[material.'b/a']\nreflectance = 0.1\n", 1, "without a folder"},
                    BadTable{"LikeNothing",
                             "[material.glass]\nreflectance = 0.1\n[material.b]\nlike = "
                             "'glas'\n",
                             4, "there is no material `glas`"},
                    BadTable{"LikeItself", "[material.a]\nlike = 'a'\n", 2, "leads round"},
                    BadTable{"LikeInACircle",
                             "[material.a]\nlike = 'b'\n[material.b]\nlike = "
                             "'c'\n[material.c]\nlike = 'a'\n",
                             2, "leads round"}),
    [](const auto& bad) { return std::string(bad.param.name); });

class MaterialFiles : public testing::Test {
 protected:
  Document map(const std::string& name) {
    return parse("{\n\"classname\" \"worldspawn\"\n\"_materials\" \"" + name + "\"\n}\n",
                 (folder_ / "m.map").string());
  }
  MaterialTable read(const std::string& name) {
    return materials_of(map(name), std::filesystem::path(folder_ / "m.map").parent_path(), settings_);
  }

  test::TempFolder folder_;
  std::vector<Setting> settings_;
};

TEST_F(MaterialFiles, AMapNamesOneBesideIt) {
  folder_.write("metals.toml",
                "schema = \"hallway.materials/1\"\n[material.steel]\nreflectance = "
                "0.7\n");
  EXPECT_EQ(read("metals.toml").of("steel").reflectance, 0.7);
  EXPECT_EQ(settings_.size(), 1u);
  EXPECT_TRUE(materials_of(parse("{\n\"classname\" \"worldspawn\"\n}\n", "m.map"), "", settings_).empty());
}

TEST_F(MaterialFiles, OthersAreRefused) {
  EXPECT_EQ(test::error_of([&] { read("missing.toml"); })->code(), ErrorCode::kIo);
  for (const char* name : {"../metals.toml", "/etc/passwd", "a/../../b.toml"}) {
    const auto error = test::error_of([&] { read(name); });
    ASSERT_TRUE(error) << name;
    EXPECT_EQ(error->where().line, 3) << error->what();
  }
  folder_.write("old.toml", "schema = \"hallway.materials/2\"\n");
  EXPECT_NE(std::string(test::error_of([&] { read("old.toml"); })->what()).find("hallway.materials/1"),
            std::string::npos);
  folder_.write("extra.toml", "schema = \"hallway.materials/1\"\ncolour = 1\n");
  EXPECT_EQ(test::error_of([&] { read("extra.toml"); })->where().line, 2);
  folder_.write("empty.toml", "");
  EXPECT_TRUE(test::error_of([&] { read("empty.toml"); }));
}

TEST_F(MaterialFiles, TheCheckNamesWhatTheTableDoesNotHave) {
  folder_.write("metals.toml",
                "schema = \"hallway.materials/1\"\n[material.\"*steel*\"]\nreflectance = 0.7\n");
  const auto checked = [&](const std::string& table, const std::string& materials) {
    const std::string world = "{\n\"classname\" \"worldspawn\"\n\"_materials\" \"" + table + "\"\n}\n";
    return check(parse(world + materials, (folder_ / "m.map").string()));
  };
  const auto box = [](const std::string& classname, const std::string& material) {
    const std::string brush = test::box_brush({0, 0, 0}, {64, 64, 64}, material);
    return "{\n\"classname\" \"" + classname + "\"\n" + brush + "}\n";
  };
  const auto of_materials = [](const std::vector<Finding>& findings) {
    std::vector<std::string> texts;
    for (const Finding& finding : findings) {
      if (finding.id == "unknown-material" || finding.id == "bad-materials")
        texts.push_back(finding.id + ": " + finding.message);
    }
    return texts;
  };
  // Each once; none of what is no surface: clips, triggers, zones.
  const auto texts =
      of_materials(checked("metals.toml", box("hw_add", "lab/Stainless_STEEL") + box("hw_add", "oak") +
                                              box("hw_add", "oak") + box("hw_add", "clip") +
                                              box("trigger_once", "pine") + box("hw_gnss_zone", "sky_hole")));
  ASSERT_EQ(texts.size(), 1u);
  EXPECT_NE(texts[0].find("oak"), std::string::npos) << texts[0];
  ASSERT_EQ(of_materials(checked("missing.toml", box("hw_add", "oak"))).size(), 1u);
  EXPECT_TRUE(of_materials(checked("missing.toml", box("hw_add", "oak")))[0].starts_with("bad-materials"));
}

TEST_F(MaterialFiles, TheShippedOneIsRead) {
  const MaterialTable table = load_materials(test::source_folder() / "maps/materials.toml", settings_);
  EXPECT_GT(table.of("big_GLASS_pane").transparency, 0.5);
  EXPECT_LT(table.of("black_cabinet").infrared, 0.05);
  EXPECT_EQ(table.of("window3"), table.of("glass"));
  EXPECT_EQ(table.of("unheard_of"), MaterialProperties());
}

}  // namespace
}  // namespace hallway::map
