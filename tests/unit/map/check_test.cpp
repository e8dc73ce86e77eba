// SPDX-License-Identifier: MIT
#include "map/check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "map/reader.hpp"
#include "map/start_check.hpp"
#include "map_text.hpp"
#include "random_document.hpp"
#include "support/data.hpp"
#include "support/long_mode.hpp"

namespace hallway::map {
namespace {

using Pairs = std::vector<std::array<std::string, 2>>;
using test::entity_text;

const std::string kWorld = entity_text({{"classname", "worldspawn"}, {"_scale", "0.01"}});  // four lines

std::string with_brush(std::string entity, const std::string& faces = test::cube_faces()) {
  return entity.insert(entity.rfind('}'), "{\n" + faces + "}\n");
}

/// "line id" of every finding, errors with an exclamation mark.
std::string findings_of(const std::string& text) {
  std::string all;
  for (const Finding& finding : check(parse(text, "a.map"))) {
    EXPECT_FALSE(finding.message.empty());
    EXPECT_EQ(finding.where.file, "a.map");
    all += std::to_string(finding.where.line) + " " + finding.id +
           (finding.severity == Severity::kError ? "!" : "") + "\n";
  }
  return all;
}

void expect_message(const std::string& text, const std::string& cause) {
  const auto findings = check(parse(text, "a.map"));
  EXPECT_TRUE(std::any_of(findings.begin(), findings.end(), [&](const Finding& finding) {
    return finding.message.find(cause) != std::string::npos;
  })) << cause;
}

TEST(Check, ASoundMapHasNoFindings) {
  EXPECT_EQ(findings_of(kWorld), "");
  for (const char* name : {"office.map", "figure_eight.map"}) {
    for (const Finding& finding : check(load(hallway::test::source_folder() / "maps" / name)))
      ADD_FAILURE() << name << ":" << finding.where.line << ": " << finding.message;
  }
}

TEST(Check, Worldspawns) {
  EXPECT_EQ(findings_of(""), "0 no-worldspawn\n");
  EXPECT_EQ(findings_of(kWorld + kWorld), "5 two-worldspawns!\n");
}

TEST(Check, TwoRobotStarts) {
  const std::string start = entity_text({{"classname", "hw_robot_start"}, {"origin", "0 0 0"}});
  EXPECT_EQ(findings_of(kWorld + start), "");
  EXPECT_EQ(findings_of(kWorld + start + start + start), "9 two-robot-starts!\n13 two-robot-starts!\n");
}

TEST(Check, NamedRobotStarts) {
  const auto start = [](const std::string& name) {
    return entity_text({{"classname", "hw_robot_start"}, {"origin", "0 0 0"}, {"name", name}});
  };
  const std::string unnamed = entity_text({{"classname", "hw_robot_start"}, {"origin", "0 0 0"}});
  EXPECT_EQ(findings_of(kWorld + start("a") + start("b") + unnamed), "");
  EXPECT_EQ(findings_of(kWorld + start("a") + start("a")), "13 doubled-name!\n");
  EXPECT_EQ(findings_of(kWorld + start("free")), "8 bad-value!\n");
}

std::string waypoint_text(const std::string& path, int index, const std::string& origin) {
  return entity_text(
      {{"classname", "hw_waypoint"}, {"path", path}, {"index", std::to_string(index)}, {"origin", origin}});
}

std::string path_text(const std::string& name, const std::string& closed, const std::string& first) {
  return entity_text({{"classname", "hw_path"}, {"name", name}, {"closed", closed}}) +
         waypoint_text(name, 0, first) + waypoint_text(name, 1, "900 200 30") +
         waypoint_text(name, 2, "900 900 30");
}

TEST(Check, RobotStartOffEveryPath) {
  const auto start = [](const std::string& origin) {
    return entity_text({{"classname", "hw_robot_start"}, {"origin", origin}});
  };
  const std::string way = path_text("way", "0", "200 200 30");
  EXPECT_EQ(findings_of(kWorld + start("200 200 30") + way), "");
  EXPECT_EQ(findings_of(kWorld + start("200.5 200 30") + way), "") << "within a centimetre";
  const std::string off = kWorld + start("100 100 30") + way;
  EXPECT_EQ(findings_of(off), "5 start-off-path\n");
  expect_message(off,
                 "the robot start is at (1, 1, 0.3), but path `way` begins at (2, 2, 0.3), 1.4142 m away: a "
                 "robot on the path begins there");
  EXPECT_EQ(findings_of(kWorld + start("200 200 0") + way), "") << "the floor below the path";
  EXPECT_EQ(findings_of(kWorld + start("200 200 -80") + way), "5 start-off-path\n") << "another floor";
  EXPECT_EQ(findings_of(off + path_text("other", "0", "100 100 30")), "") << "one path is enough";
  expect_message(off + path_text("near", "0", "110 100 30"), "path `near` begins at (1.1, 1, 0.3)");
  // A closed path begins behind the corner at its first waypoint; a start at that waypoint is as good.
  EXPECT_EQ(findings_of(kWorld + start("200 200 30") + path_text("round", "1", "200 200 30")), "");
  EXPECT_EQ(findings_of(kWorld + start("900 200 30") + path_text("round", "1", "200 200 30")),
            "5 start-off-path\n");
  EXPECT_EQ(findings_of(kWorld + way), "") << "without a start there is nothing to compare";
}

TEST(StartOffPath, ComparesWithThePathThatIsNamed) {
  const Document document =
      parse(kWorld + entity_text({{"classname", "hw_robot_start"}, {"origin", "200 200 30"}}) +
                path_text("way", "0", "200 200 30") + path_text("other", "0", "200 500 30"),
            "a.map");
  EXPECT_FALSE(start_off_all_paths(document));
  EXPECT_FALSE(start_off_path(document, "way"));
  const auto found = start_off_path(document, "other");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->path, "other");
  EXPECT_NEAR(found->distance_m, 3.0, 1e-12);
  EXPECT_EQ(found->start.line, 5);
  EXPECT_THROW(start_off_path(document, "none"), Error);
}

TEST(Check, MissingKeys) {
  EXPECT_EQ(findings_of(kWorld + entity_text({{"classname", "hw_robot_start"}})), "5 missing-key!\n");
  EXPECT_EQ(findings_of(kWorld + entity_text({{"classname", "light"}})), "5 missing-key!\n");
  EXPECT_EQ(findings_of(kWorld + entity_text({{"classname", "hw_mesh"}})),
            "5 missing-key!\n5 missing-key!\n");
  expect_message(kWorld + entity_text({{"classname", "hw_mesh"}, {"origin", "0 0 0"}}),
                 "key `model` is missing");
}

TEST(Check, ValuesOfTheWrongKind) {
  const auto mesh = [](const std::string& key, const std::string& value) {
    return findings_of(
        kWorld +
        entity_text({{"classname", "hw_mesh"}, {"origin", "0 0 0"}, {"model", "a.glb"}, {key, value}}));
  };
  EXPECT_EQ(mesh("angles", "0 90 0"), "");
  EXPECT_EQ(mesh("angles", "0 90"), "9 bad-value!\n");
  EXPECT_EQ(mesh("scale", "2"), "");
  EXPECT_EQ(mesh("scale", "1 2 3"), "");
  for (const char* scale : {"0", "1e7", "1 2", "1 2 0", "1 2 3 4", "", "big"})
    EXPECT_EQ(mesh("scale", scale), "9 bad-value!\n") << scale;
  EXPECT_EQ(mesh("units", "0.01"), "");
  EXPECT_EQ(mesh("units", "0"), "9 bad-value!\n");
  EXPECT_EQ(findings_of(entity_text({{"classname", "worldspawn"}, {"_scale", "nan"}})), "3 bad-value!\n");
  EXPECT_EQ(findings_of(kWorld + entity_text({{"classname", "monster_ogre"}, {"origin", "1 2"}})),
            "7 bad-value!\n");
  EXPECT_EQ(findings_of(kWorld + with_brush(entity_text({{"classname", "hw_add"}, {"order", "1.5"}}))),
            "7 bad-value!\n");
}

TEST(Check, Sensors) {
  const auto sensor = [](const Pairs& more) {
    Pairs pairs{{"classname", "hw_sensor"}, {"name", "eyes"}};
    pairs.insert(pairs.end(), more.begin(), more.end());
    return kWorld + entity_text(pairs);
  };
  EXPECT_EQ(findings_of(sensor({})), "");
  EXPECT_EQ(findings_of(sensor({{"kind", "points"},
                                {"horizontal_fov_deg", "360"},
                                {"vertical_fov_deg", "0.5"},
                                {"min_range_m", "2"},
                                {"max_range_m", "2"},
                                {"noise_m", "0 0.1 1000"},
                                {"noise_per_m", "0 0.1 1"},
                                {"position_m", "-1000 0 1000"},
                                {"yaw_deg", "-360"},
                                {"pitch_deg", "360"},
                                {"roll_deg", "1"}})),
            "");
  EXPECT_EQ(findings_of(sensor({{"noise_m", "0.1"}})), "");
  const Pairs wrong{{"kind", "radar"},
                    {"horizontal_fov_deg", "0"},
                    {"vertical_fov_deg", "0"},
                    {"horizontal_fov_deg", "360.5"},
                    {"vertical_fov_deg", "-90"},
                    {"horizontal_fov_deg", "nan"},
                    {"min_range_m", "-1"},
                    {"min_range_m", "101"},
                    {"max_range_m", "1000001"},
                    {"max_range_m", "inf"},
                    {"noise_m", "-0.1"},
                    {"noise_m", "0 0 -0.1"},
                    {"noise_m", "0 0"},
                    {"noise_m", "0 0 0 0"},
                    {"noise_m", ""},
                    {"noise_m", "1001"},
                    {"position_m", "0"},
                    {"position_m", "0 0 1001"},
                    {"yaw_deg", "361"},
                    {"pitch_deg", "-361"},
                    {"roll_deg", "left"}};
  for (const auto& pair : wrong)
    EXPECT_EQ(findings_of(sensor({pair})), "8 bad-value!\n") << pair[0] << " " << pair[1];
  EXPECT_EQ(findings_of(sensor({{"max_range_m", "1"}, {"min_range_m", "2"}})), "9 bad-value!\n");
  expect_message(sensor({{"max_range_m", "1"}, {"min_range_m", "2"}}),
                 "`min_range_m` 2 is above `max_range_m` 1");
  expect_message(sensor({{"vertical_fov_deg", "0"}}), "must be above 0 and at most 360");
  EXPECT_EQ(findings_of(sensor({{"nois_m", "1"}})), "8 unknown-key!\n");
  EXPECT_EQ(findings_of(kWorld + entity_text({{"classname", "hw_sensor"}})), "5 missing-key!\n");
  for (const std::string& name : {std::string("my eyes"), std::string("a.b"), std::string(65, 'a')})
    EXPECT_EQ(findings_of(kWorld + entity_text({{"classname", "hw_sensor"}, {"name", name}})),
              "7 bad-value!\n");
  EXPECT_EQ(findings_of(sensor({}) + entity_text({{"classname", "hw_sensor"}, {"name", "eyes"}})),
            "11 doubled-name!\n");
  EXPECT_EQ(findings_of(sensor({{"noise_m", "1"}, {"noise_m", "1"}})), "9 doubled-key!\n");
}

TEST(Check, UnknownClassesAndKeysWithASuggestion) {
  const std::string start = kWorld + entity_text({{"classname", "hw_robot_strat"}, {"origin", "0 0 0"}});
  EXPECT_EQ(findings_of(start), "6 unknown-class!\n");
  expect_message(start, "did you mean \"hw_robot_start\"");
  EXPECT_EQ(findings_of(kWorld + entity_text({{"classname", "HW_Add"}})), "6 unknown-class!\n");
  EXPECT_EQ(findings_of(kWorld + entity_text({{"classname", "monster_ogre"}, {"colour", "red"}})), "");
  const std::string add =
      kWorld + with_brush(entity_text({{"classname", "hw_add"}, {"oder", "1"}, {"_tb_group", "1"}}));
  EXPECT_EQ(findings_of(add), "7 unknown-key!\n");
  expect_message(add, "did you mean \"order\"");
  EXPECT_EQ(findings_of(kWorld + entity_text({{"origin", "0 0 0"}})), "5 no-class\n");
}

TEST(Check, KeysOfTheOtherShapeOfAPathAreUnknown) {
  const std::string path = entity_text({{"classname", "hw_path"},
                                        {"name", "p"},
                                        {"shape", "lemniscate"},
                                        {"origin", "0 0 0"},
                                        {"length_m", "9"},
                                        {"closed", "1"}});
  EXPECT_EQ(findings_of(kWorld + path), "11 unknown-key!\n");
}

TEST(Check, DoubledKeys) {
  EXPECT_EQ(
      findings_of(kWorld +
                  entity_text({{"classname", "hw_robot_start"}, {"origin", "0 0 0"}, {"origin", "1 0 0"}})),
      "8 doubled-key!\n");
  EXPECT_EQ(findings_of(kWorld + entity_text({{"classname", "monster_ogre"}, {"wait", "1"}, {"wait", "1"}})),
            "8 doubled-key\n");
}

TEST(Check, DoubledNames) {
  const std::string eight = entity_text({{"classname", "hw_path"},
                                         {"name", "p"},
                                         {"shape", "lemniscate"},
                                         {"origin", "0 0 0"},
                                         {"length_m", "9"}});
  EXPECT_EQ(findings_of(kWorld + eight + eight), "14 doubled-name!\n");
  const std::string target = entity_text({{"classname", "light"}, {"origin", "0 0 0"}, {"targetname", "t"}});
  EXPECT_EQ(findings_of(kWorld + target + target), "13 doubled-targetname\n");
}

TEST(Check, PathsThatCannotBeMade) {
  const std::string path = kWorld + entity_text({{"classname", "hw_path"}, {"name", "walk"}});
  const auto waypoint = [](const std::string& name, const std::string& index, const std::string& origin) {
    return entity_text({{"classname", "hw_waypoint"}, {"path", name}, {"index", index}, {"origin", origin}});
  };
  EXPECT_EQ(findings_of(path), "5 bad-path!\n");
  EXPECT_EQ(findings_of(path + waypoint("walk", "0", "0 0 0") + waypoint("walk", "1", "900 0 0")), "");
  EXPECT_EQ(findings_of(path + waypoint("walk", "0", "0 0 0") + waypoint("walk", "0", "900 0 0")),
            "18 bad-path!\n");
  EXPECT_EQ(findings_of(path + waypoint("walk", "0", "0 0 0") + waypoint("wlak", "1", "900 0 0")),
            "17 unknown-path!\n");
  expect_message(path + waypoint("wlak", "1", "900 0 0"), "did you mean \"walk\"");
}

TEST(Check, ACloudNeedsItsPath) {
  EXPECT_EQ(findings_of(kWorld + entity_text({{"classname", "hw_landmark_cloud"},
                                              {"name", "c"},
                                              {"path", "p"},
                                              {"per_100m", "1"},
                                              {"sideways_m", "1"},
                                              {"height_m", "1"}})),
            "8 unknown-path!\n");
}

TEST(Check, BadBrushesAreReportedAlsoBesideABadKey) {
  const std::string bad =
      test::face_line("( 0 0 0 ) ( 0 0 0 ) ( 1 0 0 )") + test::face_line("( 0 0 0 ) ( 0 1 0 ) ( 1 0 0 )");
  EXPECT_EQ(findings_of(with_brush(kWorld, bad)), "4 bad-brush!\n");
  EXPECT_EQ(findings_of(with_brush(entity_text({{"classname", "worldspawn"}, {"_scale", "x"}}), bad)),
            "3 bad-value!\n4 bad-brush!\n");
}

TEST(Check, Patches) {
  EXPECT_EQ(findings_of(with_brush(kWorld, "patchDef2\n{\n}\n")), "4 unread-shape!\n");
}

TEST(Check, BrushesWhereTheyDoNothing) {
  EXPECT_EQ(
      findings_of(kWorld + with_brush(entity_text({{"classname", "hw_robot_start"}, {"origin", "0 0 0"}}))),
      "5 brushes-ignored\n");
  EXPECT_EQ(findings_of(kWorld + entity_text({{"classname", "hw_subtract"}})), "5 no-brushes\n");
}

TEST(Check, BrushesThatAddAndTakeAwayWithOneOrder) {
  const auto entity = [](const std::string& name, const std::string& order) {
    return with_brush(entity_text({{"classname", name}, {"order", order}}));
  };
  EXPECT_EQ(findings_of(kWorld + entity("hw_add", "1") + entity("hw_subtract", "1")), "20 tied-order\n");
  EXPECT_EQ(findings_of(kWorld + entity("hw_add", "1") + entity("hw_subtract", "2")), "");
  EXPECT_EQ(findings_of(kWorld + entity("hw_add", "1") + entity("hw_add", "1")), "");
}

TEST(Check, FindingsAreOrderedByLineAndHaveListedNames) {
  std::mt19937_64 random(51);
  const std::vector<std::string> classes{"hw_path", "hw_waypoint", "hw_robot_start", "hw_mesh",
                                         "light",   "worldspawn",  "hw_add",         "hw_x"};
  const std::vector<std::string> keys{"name",  "path",  "index",      "origin", "order",
                                      "shape", "scale", "targetname", "_scale", "x"};
  const std::vector<std::string> values{"p", "q", "0", "1 2 3", "lemniscate", "-1", "nan", ""};
  const auto one_of = [&](const std::vector<std::string>& texts) { return texts[random() % texts.size()]; };
  const int count = hallway::test::sized(300, 20000);
  for (int i = 0; i < count; ++i) {
    std::string text;
    for (int e = 0; e < 6; ++e) {
      Pairs pairs{{"classname", one_of(classes)}};
      for (int k = 0; k < 4; ++k) pairs.push_back({one_of(keys), one_of(values)});
      text += e % 2 ? with_brush(entity_text(pairs)) : entity_text(pairs);
    }
    const auto findings = check(parse(text, "a.map"));
    EXPECT_TRUE(std::is_sorted(findings.begin(), findings.end(), [](const Finding& a, const Finding& b) {
      return a.where.line < b.where.line;
    }));
    for (const Finding& finding : findings)
      EXPECT_TRUE(std::binary_search(finding_ids().begin(), finding_ids().end(), finding.id)) << finding.id;
  }
}

TEST(Check, NeverThrowsForWhatADocumentHolds) {
  const int count = hallway::test::sized(300, 20000);
  for (int i = 0; i < count; ++i)
    EXPECT_NO_THROW(check(test::RandomDocument(static_cast<std::uint64_t>(i)).make()));
}

}  // namespace
}  // namespace hallway::map
