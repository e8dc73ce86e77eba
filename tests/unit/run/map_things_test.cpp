// SPDX-License-Identifier: MIT
#include "run/pictures/map_things.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "map/reader.hpp"
#include "run/pictures/pictures.hpp"
#include "support/room_maps.hpp"

namespace hallway::run {
namespace {

using test::point_entity;

/// Two rooms with a robot that looks north, a straight path of 3 m, a sensor, two lights, and a name for the rooms.
std::string furnished_map() {
  const auto waypoint = [](int index, int x) {
    return point_entity("hw_waypoint", {x, 150, 20},
                        "\"path\" \"round\"\n\"index\" \"" + std::to_string(index) + "\"\n");
  };
  std::string text = test::two_rooms();
  text.replace(text.find("\"classname\" \"hw_robot_start\"\n"), 0, "\"angle\" \"90\"\n");
  text.replace(text.find("\"classname\" \"hw_subtract\"\n"), 0, "\"_tb_group\" \"7\"\n");
  return text +
         "{\n\"classname\" \"func_group\"\n\"_tb_type\" \"_tb_group\"\n\"_tb_name\" \"kitchen\"\n\"_tb_id\" "
         "\"7\"\n"
         "\"_hw_made\" \"room from=0,0,0 to=4,3,0 height=3 name=kitchen\"\n}\n"
         "{\n\"classname\" \"hw_path\"\n\"name\" \"round\"\n}\n" +
         waypoint(0, 50) + waypoint(1, 350) +
         "{\n\"classname\" \"hw_sensor\"\n\"name\" \"eyes\"\n\"kind\" \"points\"\n\"horizontal_fov_deg\" "
         "\"90\"\n"
         "\"max_range_m\" \"12\"\n}\n" +
         point_entity("light", {100, 100, 250}) + point_entity("light", {700, 100, 250});
}

render::Picture picture_of(const std::string& text, const MapThings& things = {}) {
  const map::Document document = map::parse(text, "furnished.map");
  world::Settings settings;
  settings.level.reset();
  const world::CompiledWorld world = world::compile(document, settings);
  return compose_map_picture({.world = world, .document = &document, .things = things}, {},
                             render::Faces::kAll);
}

const render::Polyline* line_of(const render::Picture& picture, const std::string& label) {
  for (const render::Polyline& line : picture.polylines) {
    if (line.label.starts_with(label)) return &line;
  }
  return nullptr;
}

const render::Markers* markers_of(const render::Picture& picture, const std::string& label) {
  for (const render::Markers& markers : picture.markers) {
    if (markers.label == label) return &markers;
  }
  return nullptr;
}

TEST(MapThings, AreShownWhereTheyAre) {
  const render::Picture picture = picture_of(furnished_map());

  const render::Markers* start = markers_of(picture, "robot start");
  ASSERT_NE(start, nullptr);
  EXPECT_TRUE(start->positions.at(0).isApprox(Vec3(2, 1.5, 0.2)));
  ASSERT_EQ(picture.polylines.size(), 3u);
  const Vec3 heading = picture.polylines[2].points.at(1) - picture.polylines[2].points.at(0);
  EXPECT_TRUE(heading.normalized().isApprox(Vec3::UnitY(), 1e-9)) << heading.transpose();

  const render::Polyline* path = line_of(picture, "path round");
  ASSERT_NE(path, nullptr);
  EXPECT_TRUE(path->points.front().isApprox(Vec3(0.5, 1.5, 0.2)));
  EXPECT_TRUE(path->points.back().isApprox(Vec3(3.5, 1.5, 0.2)));

  const render::Polyline* sensor = line_of(picture, "sensor eyes: 90 x ");
  ASSERT_NE(sensor, nullptr);
  EXPECT_NE(sensor->label.find("to 12 m"), std::string::npos) << sensor->label;
  for (const Vec3& point : sensor->points) {
    const Vec3 seen = point - Vec3(2, 1.5, 0.2);
    EXPECT_LE(seen.norm(), 2.0 + 1e-9);
    EXPECT_GE(seen.y(), std::abs(seen.x()) - 1e-9) << "a quarter turn around north";
  }

  const render::Markers* lights = markers_of(picture, "lights");
  ASSERT_NE(lights, nullptr);
  EXPECT_EQ(lights->positions.size(), 2u);
  EXPECT_TRUE(lights->positions[1].isApprox(Vec3(7, 1, 2.5)));

  ASSERT_EQ(picture.labels.size(), 1u);
  EXPECT_EQ(picture.labels[0].text, "kitchen");
}

TEST(MapThings, EachCanBeLeftOut) {
  const auto count = [](const MapThings& things) {
    const render::Picture picture = picture_of(furnished_map(), things);
    return picture.polylines.size() + picture.markers.size() + picture.labels.size();
  };
  const std::size_t all = count({});
  EXPECT_EQ(all, 6u);
  EXPECT_EQ(count({.start = false}), all - 2);
  EXPECT_EQ(count({.paths = false}), all - 1);
  EXPECT_EQ(count({.sensors = false}), all - 1);
  EXPECT_EQ(count({.lights = false}), all - 1);
  EXPECT_EQ(count({.rooms = false}), all - 1);
}

TEST(MapThings, WrongOnesAreLeftOutOfThePicture) {
  const std::string broken =
      furnished_map() + "{\n\"classname\" \"hw_path\"\n\"name\" \"nowhere\"\n}\n" +
      "{\n\"classname\" \"hw_sensor\"\n\"name\" \"eyes\"\n}\n";  // a name that is taken
  const render::Picture picture = picture_of(broken);
  EXPECT_NE(line_of(picture, "path round"), nullptr);
  EXPECT_EQ(line_of(picture, "path nowhere"), nullptr);
  EXPECT_EQ(line_of(picture, "sensor"), nullptr);
}

}  // namespace
}  // namespace hallway::run
