// SPDX-License-Identifier: MIT
#include "map/entities.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "map/reader.hpp"
#include "map/sensors.hpp"
#include "map_text.hpp"
#include "support/errors.hpp"

namespace hallway::map {
namespace {

using hallway::test::error_of;
using Pairs = std::vector<std::array<std::string, 2>>;

const Pairs kWorld{{"classname", "worldspawn"}, {"_scale", "0.01"}};

Document document_of(const std::vector<Pairs>& entities) {
  std::string text;
  for (const Pairs& pairs : entities) text += test::entity_text(pairs);
  return parse(text, "a.map");
}

template <typename Function>
void expect_error(Function function, const std::vector<Pairs>& entities, int line, const std::string& cause) {
  const Document document = document_of(entities);
  const auto error = error_of([&] { function(document); });
  ASSERT_TRUE(error) << cause;
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_EQ(error->where().file, "a.map");
  EXPECT_EQ(error->where().line, line) << error->what();
  EXPECT_NE(error->message().find(cause), std::string::npos) << error->what();
}

TEST(RobotStart, IsInMetresAndTurnedAboutZ) {
  const auto start = find_robot_start(
      document_of({kWorld, {{"classname", "hw_robot_start"}, {"origin", "100 -200 50"}, {"angle", "90"}}}));
  ASSERT_TRUE(start);
  EXPECT_EQ(start->T_world_body.t, Vec3(1, -2, 0.5));
  EXPECT_LT((start->T_world_body.q * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-15);
  EXPECT_EQ(start->entity, 1);
  EXPECT_EQ(start->line, 5);
}

TEST(RobotStart, MayBeAbsent) {
  EXPECT_FALSE(find_robot_start(document_of({kWorld})));
}

TEST(RobotStart, TwoAreAnError) {
  const Pairs start{{"classname", "hw_robot_start"}, {"origin", "0 0 0"}};
  expect_error(robot_starts, {start, start}, 5, "the first is at line 1");
}

Pairs named_start(const std::string& name, const std::string& origin) {
  return {{"classname", "hw_robot_start"}, {"origin", origin}, {"name", name}};
}

const Pairs kUnnamedStart{{"classname", "hw_robot_start"}, {"origin", "1 0 0"}};

TEST(RobotStart, SeveralMayHaveNames) {
  const Document document =
      document_of({named_start("hall", "2 0 0"), kUnnamedStart, named_start("door", "3 0 0")});
  const auto starts = robot_starts(document);
  ASSERT_EQ(starts.size(), 3u);
  EXPECT_EQ(starts[0].name, "hall");
  EXPECT_EQ(starts[1].name, "");
  EXPECT_EQ(starts[2].name, "door");
  EXPECT_EQ(find_robot_start(document)->entity, 1) << "the unnamed one is the default";
  EXPECT_EQ(find_robot_start(document, "hall")->entity, 0);
  EXPECT_EQ(find_robot_start(document, "door")->entity, 2);
}

TEST(RobotStart, TheOnlyOneIsTheDefaultWithANameToo) {
  const Document document = document_of({named_start("hall", "2 0 0")});
  EXPECT_EQ(find_robot_start(document)->name, "hall");
  EXPECT_EQ(default_robot_start(document)->name, "hall");
}

TEST(RobotStart, OfSeveralNamedOnesOneMustBeChosen) {
  const std::vector<Pairs> both{named_start("hall", "2 0 0"), named_start("door", "3 0 0")};
  const auto find = [](const Document& document) { return find_robot_start(document); };
  expect_error(find, both, 1, "several robot starts, and none is chosen: `hall`, `door`");
  EXPECT_FALSE(default_robot_start(document_of(both)));
}

TEST(RobotStart, AnUnknownNameGivesASuggestionAndTheList) {
  const auto find = [](const Document& document) { return find_robot_start(document, "hal"); };
  expect_error(find, {named_start("hall", "2 0 0"), kUnnamedStart}, 0,
               "no robot start `hal` (did you mean \"hall\"?); it has `hall`, an unnamed one");
  expect_error(find, {kWorld}, 0, "no robot start `hal`; it has none");
}

TEST(RobotStart, TwoOfOneNameAreAnError) {
  expect_error(robot_starts, {named_start("hall", "2 0 0"), named_start("hall", "3 0 0")}, 9,
               "a second robot start named `hall`; the first is at line 1");
}

TEST(RobotStart, FreeAndEmptyAreNoNames) {
  expect_error(robot_starts, {named_start("free", "2 0 0")}, 4, "no robot start may be named `free`");
  expect_error(robot_starts, {named_start("", "2 0 0")}, 4, "key `name` is empty");
}

TEST(Sensors, AreThoseOfTheFileInItsOrder) {
  const Document document = document_of({kWorld,
                                         {{"classname", "hw_sensor"}, {"name", "z"}, {"origin", "1 2 3"}},
                                         {{"classname", "light"}, {"origin", "0 0 0"}},
                                         {{"classname", "hw_sensor"}, {"name", "a"}, {"noise_m", "0.1"}}});
  const auto found = sensors(document);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0], &document.entities[1]);
  EXPECT_EQ(found[1], &document.entities[3]);
}

TEST(Sensors, WrongOnesAreErrorsWithTheirLine) {
  const Pairs eyes{{"classname", "hw_sensor"}, {"name", "eyes"}};
  const auto with = [&](const std::string& key, const std::string& value) {
    Pairs pairs = eyes;
    pairs.push_back({key, value});
    return std::vector<Pairs>{pairs};
  };
  expect_error(sensors, {eyes, eyes}, 7, "a second sensor named `eyes`");
  expect_error(sensors, {{{"classname", "hw_sensor"}}}, 1, "key `name` is missing");
  expect_error(sensors, {{{"classname", "hw_sensor"}, {"name", "my eyes"}}}, 3, "is no sensor's name");
  expect_error(sensors, with("horizontal_fov_deg", "0"), 4, "must be above 0 and at most 360");
  expect_error(sensors, with("noise_m", "0 -1 0"), 4, "must be at least 0 and at most 1000");
  expect_error(sensors, with("max_range_m", "-1"), 4, "must be at least 0 and at most 1e+06");
  expect_error(sensors, with("min_range_m", "101"), 4, "`min_range_m` 101 is above `max_range_m` 100");
  expect_error(sensors, with("rang_m", "1"), 4, "unknown key `rang_m`");
  expect_error(sensors, with("kind", "radar"), 4, "unknown kind `radar`");
}

TEST(Sensors, SixtyFourAreTheMost) {
  std::vector<Pairs> many;
  for (std::size_t i = 0; i < kMaxSensors; ++i)
    many.push_back({{"classname", "hw_sensor"}, {"name", "s" + std::to_string(i)}});
  EXPECT_EQ(sensors(document_of(many)).size(), 64u);
  many.push_back({{"classname", "hw_sensor"}, {"name", "one-more"}});
  expect_error(sensors, many, 257, "at most 64");
}

TEST(RobotStart, NeedsAnOrigin) {
  expect_error(robot_starts, {{{"classname", "hw_robot_start"}}}, 1, "key `origin` is missing");
}

TEST(RobotStart, OriginsThatAreNone) {
  for (const char* origin : {"", "1 2", "1 2 3 4", "1 2 x", "1 2 nan", "1 2 3e7", "1,5 2 3"}) {
    expect_error(robot_starts, {{{"classname", "hw_robot_start"}, {"origin", origin}}}, 3, "key `origin`");
  }
}

TEST(RobotStart, AnUnknownKeyIsNamedWithASuggestion) {
  expect_error(robot_starts, {{{"classname", "hw_robot_start"}, {"origin", "0 0 0"}, {"angel", "90"}}}, 4,
               "did you mean \"angle\"");
}

TEST(RobotStart, KeysOfEditorsPass) {
  EXPECT_NO_THROW(find_robot_start(document_of({{{"classname", "hw_robot_start"},
                                                 {"origin", "0 0 0"},
                                                 {"_tb_group", "3"},
                                                 {"//angle", "7"},
                                                 {"spawnflags", "0"}}})));
}

TEST(RobotStart, AKeyThatStandsTwiceIsAnError) {
  expect_error(robot_starts, {{{"classname", "hw_robot_start"}, {"origin", "0 0 0"}, {"origin", "1 1 1"}}}, 4,
               "key `origin` stands twice, first at line 3");
}

Pairs cloud() {
  return {{"classname", "hw_landmark_cloud"},
          {"name", "trees"},
          {"path", "round"},
          {"per_100m", "25"},
          {"sideways_m", "15"},
          {"height_m", "5"}};
}

Pairs cloud_with(const std::string& key, const std::string& value) {
  Pairs pairs = cloud();
  for (auto& pair : pairs) {
    if (pair[0] == key) pair[1] = value;
  }
  return pairs;
}

TEST(LandmarkCloud, ReadsItsKeys) {
  Pairs pairs = cloud();
  pairs.push_back({"seed", "18446744073709551615"});
  const auto clouds = landmark_clouds(document_of({pairs}));
  ASSERT_EQ(clouds.size(), 1u);
  EXPECT_EQ(clouds[0].name, "trees");
  EXPECT_EQ(clouds[0].path, "round");
  EXPECT_EQ(clouds[0].per_100m, 25.0);
  EXPECT_EQ(clouds[0].sideways_m, 15.0);
  EXPECT_EQ(clouds[0].height_m, 5.0);
  EXPECT_EQ(clouds[0].seed, 18446744073709551615u);
}

TEST(LandmarkCloud, BadValuesAreErrors) {
  expect_error(landmark_clouds, {cloud_with("per_100m", "-1")}, 5, "must be at least 0 and at most");
  expect_error(landmark_clouds, {cloud_with("per_100m", "1e12")}, 5, "must be at least 0 and at most");
  expect_error(landmark_clouds, {cloud_with("sideways_m", "wide")}, 6, "`wide` is no finite decimal number");
  expect_error(landmark_clouds, {cloud_with("height_m", "-5")}, 7, "out of range");
  expect_error(landmark_clouds, {cloud_with("path", "")}, 4, "key `path` is empty");
}

TEST(LandmarkCloud, ABadSeedIsAnError) {
  Pairs pairs = cloud();
  pairs.push_back({"seed", "-1"});
  expect_error(landmark_clouds, {pairs}, 8, "no whole number from 0");
}

TEST(LandmarkCloud, NamesAreUnique) {
  expect_error(landmark_clouds, {cloud(), cloud()}, 11, "a second landmark cloud named `trees`");
}

TEST(FacePoints, AreNoneUnlessAskedFor) {
  EXPECT_EQ(face_points(document_of({kWorld})).per_m2, 0.0);
}

TEST(FacePoints, ReadsDensityAndSeed) {
  Pairs pairs = kWorld;
  pairs.push_back({"_points_per_m2", "1.5"});
  pairs.push_back({"_point_seed", "7"});
  const FacePoints points = face_points(document_of({pairs}));
  EXPECT_EQ(points.per_m2, 1.5);
  EXPECT_EQ(points.seed, 7u);
}

TEST(FacePoints, ANegativeDensityIsAnError) {
  Pairs pairs = kWorld;
  pairs.push_back({"_points_per_m2", "-1"});
  expect_error(face_points, {pairs}, 4, "must be at least 0 and at most");
}

}  // namespace
}  // namespace hallway::map
