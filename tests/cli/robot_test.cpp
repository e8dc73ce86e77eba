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
