// SPDX-License-Identifier: MIT
#include "map/robot_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "base/file.hpp"
#include "base/text.hpp"
#include "map/check.hpp"
#include "map/reader.hpp"
#include "map/writer.hpp"
#include "map_text.hpp"
#include "support/brushes.hpp"
#include "support/data.hpp"
#include "support/errors.hpp"
#include "support/fixture.hpp"

namespace hallway::map {
namespace {

using hallway::test::error_of;
using test::entity_text;

const std::string kRobotWorld =
    "{\n\"classname\" \"worldspawn\"\n\"_scale\" \"0.01\"\n\"_hallway_robot\" \"1\"\n}\n";
const std::string kCylinder = entity_text(
    {{"classname", "hw_body"}, {"radius_m", "0.2"}, {"bottom_m", "0.05"}, {"top_m", "0.4"}});  // lines 6-11

std::string sector(const std::string& from, const std::string& to, const std::string& name = "front") {
  return entity_text({{"classname", "hw_bump_zone"}, {"name", name}, {"from_deg", from}, {"to_deg", to}});
}

/// A robot file of one brush, and of one zone's brush.
Document with_brushes(const std::vector<Brush>& body, const std::vector<Brush>& zone = {},
                      const std::string& scale = "0.01") {
  Document document;
  document.file = "a.map";
  Entity& world = document.entities.emplace_back();
  world.add("classname", "worldspawn");
  world.add("_scale", scale);
  world.add("_hallway_robot", "1");
  world.brushes = body;
  if (zone.empty()) return document;
  Entity& bump = document.entities.emplace_back();
  bump.add("classname", "hw_bump_zone");
  bump.add("name", "front");
  bump.brushes = zone;
  return document;
}

void expect_refused(const std::string& text, int line, const std::string& cause) {
  const Document document = parse(text, "a.map");
  const auto error = error_of([&] { read_robot(document); });
  ASSERT_TRUE(error) << cause;
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_EQ(error->where().file, "a.map");
  EXPECT_EQ(error->where().line, line) << error->what();
  EXPECT_NE(error->message().find(cause), std::string::npos) << error->what();
}

void expect_refused(const Document& document, const std::string& cause) {
  const auto error = error_of([&] { read_robot(document); });
  ASSERT_TRUE(error) << cause;
  EXPECT_NE(error->message().find(cause), std::string::npos) << error->what();
}

TEST(RobotFile, ACylinderWithASector) {
  const RobotFile robot = read_robot(parse(kRobotWorld + kCylinder + sector("-60", "60"), "a.map"));
  EXPECT_TRUE(robot.body.is_cylinder());
  EXPECT_EQ(robot.body.radius_m, 0.2);
  EXPECT_EQ(robot.body.bottom_m, 0.05);
  EXPECT_EQ(robot.body.top_m, 0.4);
  EXPECT_EQ(robot.body.line, 6);
  ASSERT_EQ(robot.zones.size(), 1u);
  EXPECT_TRUE(robot.zones[0].contains({0.2, 0, 0.1}));
  EXPECT_TRUE(robot.zones[0].contains({0.1, 0.1, 0.05}));
  EXPECT_FALSE(robot.zones[0].contains({-0.2, 0, 0.1}));
  EXPECT_FALSE(robot.zones[0].contains({0, 0.2, 0.1}));
  EXPECT_FALSE(robot.zones[0].contains({0.2, 0, 0.5}));
}

TEST(RobotFile, ASectorAcrossTheBackContainsWhatItsAnglesSay) {
  for (const auto& [from, to] :
       std::vector<std::pair<double, double>>{{120, 240}, {-240, -120}, {-360, 0}, {170, 190}}) {
    const RobotFile robot =
        read_robot(parse(kRobotWorld + kCylinder + sector(format_double(from), format_double(to)), "a.map"));
    for (int deg = -179; deg <= 180; deg += 7) {
      const double at = deg * std::numbers::pi / 180.0;
      bool expected = false;
      for (const int turn : {-720, -360, 0, 360, 720}) expected |= deg + turn >= from && deg + turn <= to;
      EXPECT_EQ(robot.zones[0].contains({0.2 * std::cos(at), 0.2 * std::sin(at), 0.1}), expected)
          << from << " to " << to << " at " << deg;
    }
  }
}

TEST(RobotFile, ABrushIsTheHullInMetres) {
  const RobotBody body = read_robot(with_brushes({hallway::test::box({-10, -20, 5}, {30, 20, 45})})).body;
  EXPECT_FALSE(body.is_cylinder());
  ASSERT_EQ(body.vertices.size(), 8u);
  EXPECT_EQ(body.sides.size(), 6u);
  EXPECT_NEAR(body.bottom_m, 0.05, 1e-12);
  EXPECT_NEAR(body.top_m, 0.45, 1e-12);
  for (const Vec3& corner : body.vertices) {
    EXPECT_TRUE(std::abs(corner.x() + 0.1) < 1e-12 || std::abs(corner.x() - 0.3) < 1e-12);
    EXPECT_NEAR(std::abs(corner.y()), 0.2, 1e-12);
  }
}

/// Neither the unit nor the order of the faces changes a body.
TEST(RobotFile, ScaleAndTheOrderOfFacesDoNotChangeTheBody) {
  const Brush brush =
      hallway::test::prism({{16, -8}, {16, 8}, {10, 14}, {-14, 14}, {-14, -14}, {10, -14}}, 3, 21);
  const RobotBody expected = read_robot(with_brushes({brush})).body;
  Brush turned = brush, larger = brush;
  for (std::size_t i = 1; i < brush.faces.size(); ++i) {
    std::rotate(turned.faces.begin(), turned.faces.begin() + 1, turned.faces.end());
    const RobotBody body = read_robot(with_brushes({turned})).body;
    ASSERT_EQ(body.vertices.size(), expected.vertices.size());
    for (std::size_t v = 0; v < body.vertices.size(); ++v)
      EXPECT_LT((body.vertices[v] - expected.vertices[v]).norm(), 1e-9);
  }
  for (Face& face : larger.faces) {
    for (Vec3& point : face.points) point *= 8.0;
  }
  const RobotBody body = read_robot(with_brushes({larger}, {}, "0.00125")).body;
  ASSERT_EQ(body.vertices.size(), expected.vertices.size());
  for (const Vec3& corner : body.vertices) {
    EXPECT_TRUE(std::any_of(expected.vertices.begin(), expected.vertices.end(),
                            [&](const Vec3& other) { return (corner - other).norm() < 1e-9; }));
  }
}

TEST(RobotFile, AZoneMayBeABrush) {
  const Brush body = hallway::test::box({-20, -20, 0}, {20, 20, 40});
  const RobotFile robot = read_robot(with_brushes({body}, {hallway::test::box({15, -10, 0}, {25, 10, 20})}));
  EXPECT_TRUE(robot.zones[0].contains({0.2, 0, 0.1}));
  EXPECT_FALSE(robot.zones[0].contains({0.2, 0.15, 0.1}));
  expect_refused(with_brushes({body}, {hallway::test::box({30, -10, 0}, {40, 10, 20})}),
                 "`front` is not at the body");
  expect_refused(with_brushes({body}, {hallway::test::box({-5, -5, 5}, {5, 5, 10})}),
                 "`front` is inside of the body");
  const Brush two = hallway::test::box({15, -10, 0}, {25, 10, 20});
  expect_refused(with_brushes({body}, {two, two}), "a bump zone has one brush");
}

TEST(RobotFile, KeysStayTextWithTheirLines) {
  const RobotFile robot = read_robot(parse(
      kRobotWorld + kCylinder +
          entity_text({{"classname", "hw_drive"},
                       {"origin", "0 0 0"},
                       {"kind", "tracked"},
                       {"turn_slip", "0.250"},
                       {"forward_noise_sigma", "0.1"},
                       {"step_m", "0.02"},
                       {"ledges", "fall"}}) +
          entity_text(
              {{"classname", "hw_sensor"}, {"name", "eyes"}, {"origin", "10 0 25"}, {"max_range_m", "8"}}),
      "a.map"));
  const auto text = [](const std::vector<RobotKey>& keys) {
    std::string all;
    for (const RobotKey& key : keys) all += std::to_string(key.line) + " " + key.key + "=" + key.value + "\n";
    return all;
  };
  EXPECT_EQ(text(robot.drive), "15 kind=tracked\n16 turn_slip=0.250\n17 forward_noise_sigma=0.1\n");
  EXPECT_EQ(text(robot.robot), "18 step_m=0.02\n19 ledges=fall\n");
  ASSERT_EQ(robot.sensors.size(), 1u);
  EXPECT_EQ(robot.sensors[0].name, "eyes");
  EXPECT_EQ(text(robot.sensors[0].keys), "25 max_range_m=8\n24 position_m=0.1 0 0.25\n");
}

TEST(RobotFile, WhatIsNoBodyIsRefused) {
  expect_refused(kRobotWorld, 1, "the robot file has no body");
  expect_refused(kRobotWorld + kCylinder + kCylinder, 12, "a second body; the first is at line 6");
  const auto cylinder = [](const std::string& radius, const std::string& bottom, const std::string& top) {
    return kRobotWorld +
           entity_text(
               {{"classname", "hw_body"}, {"radius_m", radius}, {"bottom_m", bottom}, {"top_m", top}});
  };
  expect_refused(cylinder("0", "0", "1"), 8, "must be at least 0.001 and at most 100");
  expect_refused(cylinder("nan", "0", "1"), 8, "is no finite decimal number");
  expect_refused(cylinder("1e999", "0", "1"), 8, "is no finite decimal number");
  expect_refused(cylinder("0.1", "1", "0.5"), 10, "`top_m` 0.5 must be at least 0.001 above `bottom_m` 1");
  expect_refused(kRobotWorld + entity_text({{"classname", "hw_body"}}), 6, "key `radius_m` is missing");
  expect_refused(kRobotWorld + entity_text({{"classname", "hw_body"}, {"radius", "1"}}), 8,
                 "did you mean \"radius_m\"");
  const Brush brush = hallway::test::box({-20, -20, 0}, {20, 20, 40});
  expect_refused(with_brushes({brush, brush}), "a second body");
  expect_refused(with_brushes({hallway::test::box({-20, -20, 0}, {20, 20, 0.05})}),
                 "m thick; 0.001 m is the least");
  expect_refused(with_brushes({hallway::test::box({-20, -20, 0}, {20, 20000, 40})}), "farther than 100 m");
  Brush open = brush;
  open.faces.pop_back();
  expect_refused(with_brushes({open}), "the robot's body is no convex solid");
}

TEST(RobotFile, WrongZonesAreRefused) {
  const std::string begin = kRobotWorld + kCylinder;
  expect_refused(begin + sector("10", "10"), 16, "`to_deg` 10 must be above `from_deg` 10");
  expect_refused(begin + sector("-200", "200"), 16, "by at most 360");
  expect_refused(begin + sector("0", "90") + sector("0", "90"), 20, "a second bump zone named `front`");
  expect_refused(begin + sector("0", "90", "a b"), 14, "is no zone's name");
  expect_refused(begin + entity_text({{"classname", "hw_bump_zone"}, {"name", "front"}}), 12,
                 "key `from_deg` is missing");
  expect_refused(begin + entity_text({{"classname", "hw_bump_zone"},
                                      {"name", "high"},
                                      {"from_deg", "0"},
                                      {"to_deg", "90"},
                                      {"bottom_m", "0.5"},
                                      {"top_m", "0.6"}}),
                 12, "the bump zone `high` is not at the body");
  // A body beside the z axis, and a sector that looks away from it.
  Document aside = with_brushes({hallway::test::box({10, -10, 0}, {30, 10, 20})});
  Entity& zone = aside.entities.emplace_back();
  for (const auto& [key, value] : std::vector<std::pair<std::string, std::string>>{
           {"classname", "hw_bump_zone"}, {"name", "back"}, {"from_deg", "100"}, {"to_deg", "260"}})
    zone.add(key, value);
  expect_refused(aside, "the bump zone `back` is not at the body");
}

TEST(RobotFile, WrongSensorsAndDrivesAreRefused) {
  const std::string begin = kRobotWorld + kCylinder;
  const std::string eyes = entity_text({{"classname", "hw_sensor"}, {"name", "eyes"}});
  expect_refused(begin + eyes + eyes, 18, "a second sensor named `eyes`");
  expect_refused(begin + entity_text({{"classname", "hw_sensor"},
                                      {"name", "eyes"},
                                      {"origin", "10 0 0"},
                                      {"position_m", "0.2 0 0"}}),
                 16, "the origin is the mount");
  const std::string drive = entity_text({{"classname", "hw_drive"}});
  expect_refused(begin + drive + drive, 15, "a second `hw_drive`; the first is at line 12");
  expect_refused(begin + entity_text({{"classname", "hw_drive"}, {"wheel_bas_m", "1"}}), 14,
                 "did you mean \"wheel_base_m\"");
  expect_refused(begin + entity_text({{"classname", "hw_drive"}, {"kind", "legs"}}), 14,
                 "unknown kind `legs`");
  expect_refused(begin + entity_text({{"classname", "hw_drive"}, {"latency_s", "nan"}}), 14,
                 "is no finite decimal number");
}

TEST(RobotFile, AMapIsNoRobotFileAndTheOtherWayRound) {
  const std::string world = entity_text({{"classname", "worldspawn"}});
  expect_refused(world, 0, "the map is no robot file");
  EXPECT_NO_THROW(require_world(parse(world, "a.map")));
  const Document robot = parse(kRobotWorld + kCylinder, "a.map");
  const auto error = error_of([&] { require_world(robot); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->where().line, 4);
  EXPECT_NE(error->message().find("this is a robot file and no map"), std::string::npos);
  expect_refused(
      kRobotWorld + kCylinder + entity_text({{"classname", "hw_robot_start"}, {"origin", "0 0 0"}}), 13,
      "a robot file has no `hw_robot_start`");
}

std::string ids_of(const std::string& text) {
  std::string ids;
  for (const Finding& finding : check(parse(text, "a.map")))
    ids += std::to_string(finding.where.line) + " " + finding.id + "\n";
  return ids;
}

TEST(RobotFile, ChecksKnowIt) {
  EXPECT_EQ(ids_of(kRobotWorld + kCylinder + sector("-60", "60")), "");
  EXPECT_EQ(ids_of(kRobotWorld), "1 bad-robot\n");
  EXPECT_EQ(ids_of(kRobotWorld + kCylinder + kCylinder), "12 bad-robot\n");
  EXPECT_EQ(ids_of(entity_text({{"classname", "worldspawn"}}) + kCylinder), "5 not-in-maps\n");
}

TEST(RobotFile, ASensorBesideTheBodyIsReported) {
  const auto sensor_at = [](const char* place) {
    return entity_text(
        {{"classname", "hw_sensor"}, {"name", "head"}, {"kind", "sonar"}, {"position_m", place}});
  };
  const std::string robot = kRobotWorld + kCylinder;
  EXPECT_EQ(ids_of(robot + sensor_at("0.1 0.1 2")), "") << "over the body";
  const auto findings = check(parse(robot + sensor_at("0.9 1.2 0.1"), "a.map"));
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings.front().id, "sensor-beside-body");
  EXPECT_EQ(findings.front().severity, Severity::kWarning);
  EXPECT_NE(findings.front().message.find(" m beside the robot's body"), std::string::npos);
}

/// Against the least of the distances to many points of the outline.
TEST(RobotFile, TheDistanceBesideABodyIsThatToItsOutline) {
  const RobotBody first = load_robot_file(hallway::test::source_folder() / "maps/robots/first.map")
                              .body;  // corners cut off in front
  EXPECT_EQ(distance_beside(first, {0.0, 0.0, 5.0}), 0.0);
  EXPECT_EQ(distance_beside(first, {0.159, 0.079, -1.0}), 0.0);
  EXPECT_NEAR(distance_beside(first, {0.26, 0.0, 0.1}), 0.1, 1e-12);
  EXPECT_NEAR(distance_beside(first, {-0.17, -0.18, 0.1}), 0.05, 1e-12) << "from a corner";
  EXPECT_NEAR(distance_beside(first, {0.16, 0.14, 0.1}), 0.03 * std::sqrt(2.0), 1e-12) << "from a slant";
  RobotBody cylinder;
  cylinder.radius_m = 0.5;
  EXPECT_NEAR(distance_beside(cylinder, {3.0, 4.0, 0.0}), 4.5, 1e-12);
}

TEST(RobotFile, TheExamplesAreSoundAndCanonical) {
  struct Example {
    std::string name;
    std::size_t zones, sensors;
    bool is_cylinder;
  };
  for (const auto& [name, zones, sensors, is_cylinder] :
       {Example{"first", 8, 11, false}, Example{"cart", 4, 3, true}, Example{"rug_warrior", 3, 4, true}}) {
    SCOPED_TRACE(name);
    const auto file = hallway::test::source_folder() / "maps" / "robots" / (name + ".map");
    const Document document = load(file);
    EXPECT_EQ(print(document), read_file(file));
    EXPECT_TRUE(check(document).empty());
    const RobotFile robot = load_robot_file(file);
    EXPECT_EQ(robot.zones.size(), zones);
    EXPECT_EQ(robot.sensors.size(), sensors);
    EXPECT_EQ(robot.body.is_cylinder(), is_cylinder);
  }
}

}  // namespace
}  // namespace hallway::map
