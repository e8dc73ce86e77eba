// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>
#include <string>

#include "map/check.hpp"
#include "map/entities.hpp"
#include "map/path.hpp"
#include "map/sensors.hpp"
#include "solidity.hpp"
#include "unit/editor/editing.hpp"

namespace hallway {
namespace {

using test::Editing;
using test::mentions;
using test::refusal;

map::Document document_of(const Editing& map) {
  return editor::document_of(map.session->state(), (map.folder / "map.map").string());
}

struct Places : Editing {
  Places() { run("new"); }
};

TEST(PlacesCommands, StartIsOneAndKeepsItsNumber) {
  Places map;
  const auto made = map.run("start at 1,2,0.5 heading 90").data["made"];
  EXPECT_EQ(map.run("start at 3,2 heading=-45deg").data["changed"], made);
  const auto start = map::find_robot_start(document_of(map));
  ASSERT_TRUE(start);
  EXPECT_LT((start->T_world_body.t - Vec3(3, 2, 0)).norm(), 1e-9);
  EXPECT_LT(angle_between(start->T_world_body.q, from_yaw_pitch_roll(-std::numbers::pi / 4, 0, 0)), 1e-9);
  EXPECT_TRUE(mentions(refusal(map, "start"), "at"));
  EXPECT_TRUE(mentions(refusal(map, "start 1,1 heading=5m"), "angle"));
  map.run("entity hw_robot_start at 0,0,0");
  EXPECT_TRUE(mentions(refusal(map, "start 1,1"), "2 robot starts"));
}

TEST(PlacesCommands, StartsWithNamesStandBesideTheDefault) {
  Places map;
  map.run("start at 1,2,0");
  const auto made = map.run("start at 3,2,0 name=hall").data["made"];
  EXPECT_EQ(map.run("start at 4,2,0 heading=90 name=hall").data["changed"], made);
  const auto document = document_of(map);
  EXPECT_EQ(map::robot_starts(document).size(), 2u);
  EXPECT_LT((map::find_robot_start(document)->T_world_body.t - Vec3(1, 2, 0)).norm(), 1e-9);
  EXPECT_LT((map::find_robot_start(document, "hall")->T_world_body.t - Vec3(4, 2, 0)).norm(), 1e-9);
  EXPECT_TRUE(mentions(refusal(map, "start at 1,1,0 name=free"), "free"));
}

TEST(PlacesCommands, ASensorIsMadeAndThenChanged) {
  Places map;
  const auto made =
      map.run("sensor eyes horizontal_fov=1.5rad max_range=12 noise=2cm at=20cm,0,0.5 pitch=10 yaw=-90deg")
          .data["made"];
  const auto key = [&](const char* name) {
    const std::string* value = test::named(map, "eyes").head->find(name);
    return value == nullptr ? std::string("none") : *value;
  };
  EXPECT_EQ(key("classname"), "hw_sensor");
  EXPECT_EQ(key("kind"), "points");
  EXPECT_NEAR(std::stod(key("horizontal_fov_deg")), 270.0 / std::numbers::pi, 1e-8);
  EXPECT_EQ(key("max_range_m"), "12");
  EXPECT_EQ(key("noise_m"), "0.02");
  EXPECT_EQ(key("position_m"), "0.2 0 0.5");
  EXPECT_EQ(key("yaw_deg"), "-90");
  EXPECT_EQ(key("pitch_deg"), "10");
  for (const char* absent : {"origin", "vertical_fov_deg", "min_range_m", "roll_deg"})
    EXPECT_EQ(key(absent), "none") << absent;
  EXPECT_TRUE(map::check(document_of(map)).empty());
  EXPECT_EQ(map.run("sensor eyes min_range=50cm vertical_fov=45 roll=5 pitch=0").data["changed"], made);
  EXPECT_EQ(key("min_range_m"), "0.5");
  EXPECT_EQ(key("vertical_fov_deg"), "45");
  EXPECT_EQ(key("roll_deg"), "5");
  EXPECT_EQ(key("pitch_deg"), "0");
  EXPECT_EQ(key("max_range_m"), "12") << "what is not given stays";
  EXPECT_EQ(map.run("list class=hw_sensor").data["count"], 1);
  map.run("sensor back kind=points yaw=180");
  EXPECT_EQ(map::sensors(document_of(map)).size(), 2u);
}

/// The kinds and keys are those of the table that reads maps: each kind is made by its name, with any of its keys.
TEST(PlacesCommands, ASensorMayBeOfAnyKindWithAnyOfItsKeys) {
  Places map;
  for (const map::SensorKind& kind : map::sensor_kinds()) {
    for (const std::string& name : map::sensor_key_names(kind.name)) {
      const map::KeySpec& key = map::sensor_key(kind.name, name);
      if (name == "kind" || key.fallback.empty()) continue;
      const std::string made = std::string(kind.name) + "_" + name;
      const std::string pair = name + "=\"" + std::string(key.fallback) + "\"";
      map.run("sensor " + made + " kind=" + std::string(kind.name) + " " + pair);
      const auto& keys = test::named(map, made).head;
      ASSERT_NE(keys->find(name), nullptr) << made;
      EXPECT_EQ(*keys->find(name), key.fallback) << made;
      map.run("sensor " + made + " " + name + "=");
      EXPECT_EQ(test::named(map, made).head->find(name), nullptr) << made;
      map.run("delete " + made);
    }
  }
  map.run("sensor scan kind=lidar at=0.1,0,0.3 preset=lidar16 rate_hz=5");
  map.run("sensor imu kind=imu preset=imu_mems");
  map.run("sensor ping kind=sonar beam=0,0;3,-50cm;3,0.5");
  EXPECT_EQ(*test::named(map, "ping").head->find("beam_m"), "0 0 3 -0.5 3 0.5");
  map.run("delete ping");
  EXPECT_TRUE(map::check(document_of(map)).empty());
  EXPECT_EQ(map::sensors(document_of(map)).size(), 2u);
}

TEST(PlacesCommands, ASensorThatCannotBeIsRefused) {
  Places map;
  map.run_all({"sensor eyes max_range=5", "path way 0,0;1,0"});
  const std::string before = map.text();
  for (const char* name : {"eyes", "fresh"}) {
    const auto refused = [&](const std::string& arguments, const char* cause) {
      EXPECT_TRUE(mentions(refusal(map, "sensor " + std::string(name) + " " + arguments), cause))
          << name << " " << arguments << ": "
          << refusal(map, "sensor " + std::string(name) + " " + arguments);
    };
    refused("horizontal_fov=0", "above 0");
    refused("vertical_fov=361", "at most 360");
    refused("min_range=200", "is above");
    refused("max_range=-1", "max_range");
    refused("max_range=1e7", "max_range");
    refused("noise=-1cm", "noise");
    refused("at=0,0,2000", "position_m");
    refused("yaw=400", "yaw");
    refused("kind=point", "\"points\"");
    refused("max_range=5deg", "no length");
    refused("nois=1", "\"noise\"");
    refused("rings=16", "rings");  // of lidars
    refused("kind=lidar rings=0", "rings");
    refused("kind=lidar ring=8", "\"rings\"");
    refused("kind=lidar classname=light", "classname");
    refused("yaw=10 yaw_deg=20", "yaw_deg");
  }
  EXPECT_TRUE(mentions(refusal(map, "sensor eyes"), "already"));
  EXPECT_TRUE(mentions(refusal(map, "sensor"), "name"));
  EXPECT_TRUE(mentions(refusal(map, "sensor way yaw=1"), "already"));
  EXPECT_TRUE(mentions(refusal(map, "sensor a.b yaw=1"), "characters"));
  EXPECT_EQ(map.text(), before);
  map.run("entity hw_sensor name=eyes");
  EXPECT_TRUE(mentions(refusal(map, "sensor eyes yaw=1"), "2 sensors"));
}

TEST(PlacesCommands, APathCanBeFollowed) {
  Places map;
  const auto report = map.run("path round 0,0,0.7;5,0,0.7;5,4,0.7;0,4,0.7 closed=yes corner_radius=50cm");
  EXPECT_EQ(report.data["waypoints"], 4);
  const map::Path path = map::find_path(document_of(map), "round");
  EXPECT_TRUE(path.closed());
  EXPECT_NEAR(path.length_m(), 18.0 - 4.0 + std::numbers::pi, 1e-9);
  map.run("path way \"0,0 3,0\"");
  EXPECT_FALSE(map::find_path(document_of(map), "way").closed());
  EXPECT_TRUE(map::check(document_of(map)).empty());
  EXPECT_TRUE(mentions(refusal(map, "path way 0,0;1,1"), "already"));
  EXPECT_TRUE(mentions(refusal(map, "path one 0,0"), "two places"));
  EXPECT_TRUE(mentions(refusal(map, "path bad 0,0;0.1,0;0.1,0.1"), "path: "));
  EXPECT_TRUE(mentions(refusal(map, "path bad 0,0;1,0 closed=maybe"), "maybe"));
  EXPECT_TRUE(mentions(refusal(map, "path bad 0,0;1,0 corner_radius=0"), "corner_radius"));
}

TEST(PlacesCommands, WaypointsAreNumberedAnew) {
  Places map;
  map.run_all(
      {"path way 0,0;10,0", "waypoint way at 10,10", "waypoint way at 5,-3 index=1", "waypoint way 0,-5 0"});
  const map::Document document = document_of(map);
  std::map<int, std::string> order;
  for (const map::Entity& entity : document.entities) {
    if (entity.classname() == "hw_waypoint") order[std::stoi(*entity.find("index"))] = *entity.find("origin");
  }
  const std::map<int, std::string> wanted{
      {0, "0 -500 0"}, {1, "0 0 0"}, {2, "500 -300 0"}, {3, "1000 0 0"}, {4, "1000 1000 0"}};
  EXPECT_EQ(order, wanted);
  EXPECT_EQ(map::find_path(document, "way").at(0.0).t, Vec3(0, -5, 0));
  EXPECT_TRUE(mentions(refusal(map, "waypoint way 0,0 index=7"), "5 waypoints"));
  EXPECT_TRUE(mentions(refusal(map, "waypoint wya 0,0"), "\"way\""));
  map.run("entity hw_path name=eight shape=lemniscate length_m=40 origin=\"0 0 0\"");
  EXPECT_TRUE(mentions(refusal(map, "waypoint eight 0,0"), "lemniscate"));
  // One that cannot be followed may be on its way to one that can.
  EXPECT_TRUE(mentions(map.run("waypoint way 10,10").lines.back(), "note"));
  map.run("entity hw_waypoint at 1,1 path=way index=x");
  EXPECT_TRUE(mentions(refusal(map, "waypoint way 0,0"), "index"));
}

TEST(PlacesCommands, DeletingAPathDeletesItsWaypoints) {
  Places map;
  map.run_all({"path way 0,0;10,0", "path other 0,1;10,1", "delete way"});
  EXPECT_TRUE(map::check(document_of(map)).empty());
  EXPECT_EQ(map.run("list class=hw_waypoint").data["count"], 2);
}

TEST(PlacesCommands, LandmarksAroundAPathAndOnSurfaces) {
  Places map;
  map.run_all({"path way 0,0;10,0", "landmarks path=way per_100m=100 sideways=5 height=2 seed=4",
               "box from 0,0 to 2,2,2 name=crate", "landmarks per_m2=25 seed=9",
               "landmarks per_m2=3 on=crate"});
  const map::Document document = document_of(map);
  const auto clouds = map::landmark_clouds(document);
  ASSERT_EQ(clouds.size(), 1u);
  EXPECT_EQ(clouds[0].name, "way_cloud");
  EXPECT_EQ(clouds[0].sideways_m, 5.0);
  EXPECT_EQ(clouds[0].seed, 4u);
  EXPECT_EQ(map::face_points(document).per_m2, 25.0);
  EXPECT_EQ(map::face_points(document).seed, 9u);
  EXPECT_EQ(*test::named(map, "crate").head->find("_points_per_m2"), "3");
  EXPECT_TRUE(map::check(document).empty());
  EXPECT_TRUE(mentions(refusal(map, "landmarks"), "missing"));
  EXPECT_TRUE(mentions(refusal(map, "landmarks path=way per_100m=1 sideways=1"), "height"));
  EXPECT_TRUE(mentions(refusal(map, "landmarks path=wya per_100m=1 sideways=1 height=1"), "\"way\""));
  EXPECT_TRUE(mentions(refusal(map, "landmarks path=way per_100m=1 sideways=1 height=1"), "already"));
  EXPECT_TRUE(
      mentions(refusal(map, "landmarks path=way per_100m=1 sideways=1 height=1 on=crate name=b"), "per_m2"));
  EXPECT_TRUE(mentions(refusal(map, "landmarks per_m2=1 path=way"), "belongs to a cloud"));
  EXPECT_TRUE(mentions(refusal(map, "landmarks per_m2=1 on=way"), "no surface"));
  EXPECT_TRUE(mentions(refusal(map, "landmarks per_m2=1 speed=2"), "belongs to a cloud"));
  EXPECT_TRUE(mentions(
      refusal(map, "landmarks path=way per_100m=1 sideways=1 height=1 name=c motion=sideways"), "group"));
  EXPECT_TRUE(mentions(refusal(map, "landmarks per_m2=1 on=crate seed=3"), "seed"));
  EXPECT_TRUE(mentions(refusal(map, "landmarks per_m2=-1"), "per_m2"));
  map.run("box from 5,0 to 6,1,1");
  EXPECT_TRUE(mentions(refusal(map, "landmarks per_m2=1 on=box=5,0,0,6,1,1"), "name"));
}

TEST(PlacesCommands, Light) {
  Places map;
  map.run("light at 2,3,2.5 brightness=200 colour=1,0.5,0 name=lamp");
  const auto& head = *test::named(map, "lamp").head;
  EXPECT_EQ(*head.find("origin"), "200 300 250");
  EXPECT_EQ(*head.find("light"), "200");
  EXPECT_EQ(*head.find("_color"), "1 0.5 0");
  EXPECT_TRUE(mentions(refusal(map, "light 1,1 name=lamp"), "already"));
  EXPECT_TRUE(mentions(refusal(map, "light 1,1 colour=2,0,0"), "colour"));
  EXPECT_TRUE(mentions(refusal(map, "light 1,1 brightness=-3"), "brightness"));
}

TEST(PlacesCommands, MeshNamesItsFileFromTheMapsFolder) {
  Places map;
  std::filesystem::create_directories(map.folder / "models");
  map.folder.write("models/chair.obj", "v 0 0 0\n");
  const std::string file = (map.folder / "models/chair.obj").string();
  map.run("mesh models/chair.obj at 1,2 heading=30 scale=2 name=a");
  map.run("mesh models/../models/chair.obj at 1,2 scale=1,2,3 name=b");
  map.run("mesh " + file + " at 1,2 name=c");
  for (const char* name : {"a", "b", "c"})
    EXPECT_EQ(*test::named(map, name).head->find("model"), "models/chair.obj");
  EXPECT_EQ(*test::named(map, "a").head->find("angle"), "30");
  EXPECT_EQ(*test::named(map, "a").head->find("scale"), "2");
  EXPECT_EQ(*test::named(map, "b").head->find("scale"), "1 2 3");
  EXPECT_TRUE(map::check(document_of(map)).empty());
  const test::TempFolder other;
  const std::string outside = other.write("chair.obj", "v 0 0 0\n").string();
  EXPECT_TRUE(mentions(refusal(map, "mesh " + outside + " at 0,0"), "not in the map's folder"));
  std::filesystem::create_symlink(outside, map.folder / "link.obj");
  EXPECT_TRUE(mentions(refusal(map, "mesh link.obj at 0,0"), "not in the map's folder"));
  EXPECT_TRUE(mentions(refusal(map, "mesh models/chiar.obj at 0,0"), "no file"));
  EXPECT_TRUE(mentions(refusal(map, "mesh models at 0,0"), "no file"));
  EXPECT_TRUE(mentions(refusal(map, "mesh models/chair.obj at 0,0 scale=0"), "small"));
}

}  // namespace
}  // namespace hallway
