// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "support/process.hpp"
#include "support/temp_folder.hpp"

namespace hallway::test {
namespace {

using Json = nlohmann::ordered_json;

const std::string kCart =
    "{\n\"classname\" \"worldspawn\"\n\"_scale\" \"0.01\"\n\"_hallway_robot\" \"1\"\n}\n"
    "{\n\"classname\" \"hw_body\"\n\"radius_m\" \"0.2\"\n\"bottom_m\" \"0.05\"\n\"top_m\" \"0.4\"\n}\n"
    "{\n\"classname\" \"hw_bump_zone\"\n\"name\" \"front\"\n\"from_deg\" \"-60\"\n\"to_deg\" \"60\"\n}\n"
    "{\n\"classname\" \"hw_drive\"\n\"max_speed_m_s\" \"0.40\"\n\"step_m\" \"0.02\"\n}\n";

Json setting_of(const Json& document, const std::string& table, const std::string& key) {
  for (const Json& setting : document.at("settings")) {
    if (setting.at("table") == table && setting.at("key") == key) return setting;
  }
  return nullptr;
}

TEST(Robot, EachValueHasItsUnitAndItsOrigin) {
  const TempFolder folder;
  const auto ended = hallway({"robot", folder.write("cart.map", kCart), "--json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const Json document = Json::parse(ended.out);
  EXPECT_EQ(document.at("body").at("radius_m"), 0.2);
  EXPECT_EQ(document.at("zones").at(0).at("from_deg"), -60.0);
  const Json speed = setting_of(document, "drive", "max_speed_m_s");
  EXPECT_EQ(speed.at("value"), "0.40");
  EXPECT_EQ(speed.at("unit"), "m/s");
  EXPECT_EQ(speed.at("origin"), "robot file line 20");
  EXPECT_EQ(setting_of(document, "robot", "step_m").at("origin"), "robot file line 21");
  EXPECT_EQ(setting_of(document, "drive", "wheel_base_m").at("origin"), "default");
}

TEST(Robot, OfAScenarioEachValueHasItsOriginToo) {
  const TempFolder folder;
  folder.write("cart.map",
               kCart + "{\n\"classname\" \"hw_sensor\"\n\"name\" \"eyes\"\n\"yaw_deg\" \"9\"\n}\n");
  const std::string scenario =
      folder.write("s.toml",
                   "map = 'none.map'\nsteps = 1\n[robot]\nfile = 'cart.map'\nledge_m = 0.03\n"
                   "[robot.drive]\nlatency_s = 0.1\n[sensor.eyes]\nnoise_m = 0.1\n");
  const auto ended = hallway({"robot", scenario, "--json", "--set", "sensor.eyes.max_range_m=5", "--set",
                              "robot.drive.left_slip.mean=0.1"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const Json document = Json::parse(ended.out);
  EXPECT_EQ(document.at("body").at("origin"), "robot file line 6");
  EXPECT_EQ(document.at("zones").at(0).at("name"), "front");
  const auto origin = [&](const char* table, const char* key) {
    return setting_of(document, table, key).at("origin");
  };
  EXPECT_EQ(origin("drive", "max_speed_m_s"), "robot file line 20");
  EXPECT_EQ(origin("drive", "latency_s"), "scenario line 7");
  EXPECT_EQ(origin("drive", "left_slip_mean"), "--set");
  EXPECT_EQ(origin("drive", "wheel_base_m"), "default");
  EXPECT_EQ(origin("robot", "step_m"), "robot file line 21");
  EXPECT_EQ(origin("robot", "ledge_m"), "scenario line 5");
  EXPECT_EQ(origin("robot", "clearance_m"), "default");
  EXPECT_EQ(origin("sensor.eyes", "yaw_deg"), "robot file line 26");
  EXPECT_EQ(origin("sensor.eyes", "noise_m"), "scenario line 9");
  EXPECT_EQ(origin("sensor.eyes", "max_range_m"), "--set");
  EXPECT_EQ(setting_of(document, "sensor.eyes", "max_range_m").at("value"), "5");
  EXPECT_EQ(origin("sensor.eyes", "min_range_m"), "default");
}

TEST(Robot, OfAScenarioWithoutSensorsThoseOfItsMapAreShown) {
  const TempFolder folder;
  folder.write("m.map",
               "{\n\"classname\" \"worldspawn\"\n}\n{\n\"classname\" \"hw_sensor\"\n\"name\" "
               "\"a\"\n\"yaw_deg\" \"9\"\n}\n");
  const auto ended =
      hallway({"robot", folder.write("s.toml", "map = 'm.map'\nsteps = 1\n[robot]\n"), "--json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const Json document = Json::parse(ended.out);
  EXPECT_TRUE(document.at("body").is_null());
  EXPECT_EQ(setting_of(document, "sensor.a", "yaw_deg").at("origin"), "map line 7");
}

TEST(Robot, ASettingOfARobotFileIsWrongUse) {
  const TempFolder folder;
  EXPECT_EQ(hallway({"robot", folder.write("cart.map", kCart), "--set", "robot.radius_m=1"}).status, 2);
}

TEST(Robot, AMapOfAWorldIsRefused) {
  const TempFolder folder;
  const auto ended = hallway({"robot", folder.write("room.map", "{\n\"classname\" \"worldspawn\"\n}\n")});
  EXPECT_EQ(ended.status, 3);
  EXPECT_NE(ended.err.find("is no robot file"), std::string::npos) << ended.err;
}

TEST(Robot, AMapCheckAsksForABodyAndForNoWorld) {
  const TempFolder folder;
  EXPECT_EQ(hallway({"map", "check", folder.write("cart.map", kCart)}).status, 0);
  const std::string bare = kCart.substr(0, kCart.find("{\n\"classname\" \"hw_body\""));
  const auto ended = hallway({"map", "check", folder.write("bare.map", bare)});
  EXPECT_EQ(ended.status, 1);
  EXPECT_NE((ended.out + ended.err).find("the robot file has no body"), std::string::npos) << ended.out;
}

}  // namespace
}  // namespace hallway::test
