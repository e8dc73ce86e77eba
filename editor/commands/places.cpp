// SPDX-License-Identifier: MIT
//
// The robot with its sensors and paths, landmarks, lights, models.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>
#include <system_error>

#include "base/error.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "editor/commands/making.hpp"
#include "editor/commands/topics.hpp"
#include "editor/selection.hpp"
#include "map/entities.hpp"
#include "map/entity_schema.hpp"
#include "map/path.hpp"
#include "map/sensors.hpp"

namespace hallway::editor {
namespace {

namespace fs = std::filesystem;

constexpr ArgSpec kAt = ArgSpec{"at", ArgKind::kPlace, "where it is"}.needed();
constexpr ArgSpec kHeading =
    ArgSpec{"heading", ArgKind::kAngle, "counter-clockwise from above, 0 along x", "0"}.within(-3600, 3600);
constexpr ArgSpec kOptionalName{"name", ArgKind::kName, "what it is called"};

constexpr std::array kStart{kAt, kHeading,
                            ArgSpec{"name", ArgKind::kName, "of the start [the default one has none]"}};

/// Those of the table that reads maps and scenarios.
constexpr std::string_view kSensorKindNames =
    std::ranges::find(map::kSensorKeys, "kind", &map::KeySpec::name)->choices;

constexpr std::array kSensor{
    ArgSpec{"name", ArgKind::kName, "what it is called"}.needed(),
    ArgSpec{"kind", ArgKind::kChoice, "what it sees, or feels [points]", "", kSensorKindNames},
    ArgSpec{"horizontal_fov", ArgKind::kAngle, "its whole field of view from side to side [90]"},
    ArgSpec{"vertical_fov", ArgKind::kAngle, "its whole field of view from top to bottom [60]"},
    ArgSpec{"min_range", ArgKind::kLength, "nearest distance seen [0]"},
    ArgSpec{"max_range", ArgKind::kLength, "farthest distance seen [100]"},
    ArgSpec{"noise", ArgKind::kLength, "standard deviation along each axis [0]"},
    ArgSpec{"at", ArgKind::kVector, "where on the robot: forward, left, up [0,0,0]"},
    ArgSpec{"yaw", ArgKind::kAngle, "turn on the robot about z, to the left [0]"},
    ArgSpec{"pitch", ArgKind::kAngle, "then about its y, down [0]"},
    ArgSpec{"roll", ArgKind::kAngle, "then about its x [0]"},
    ArgSpec{"beam", ArgKind::kPlaces, "corners of a sonar's beam: forward,left;... [a cone]"},
    ArgSpec{
        "keys", ArgKind::kKeys,
        "other keys of its kind, to the end of the line; `hallway sensors KIND` lists them. An empty value "
        "removes a key"}};
constexpr std::array kPath{
    ArgSpec{"name", ArgKind::kName, "what it is called"}.needed(),
    ArgSpec{"places", ArgKind::kPlaces, "its waypoints, two or more"}.needed(),
    ArgSpec{"closed", ArgKind::kChoice, "whether it leads back to the first", "no", "yes no"},
    ArgSpec{"corner_radius", ArgKind::kLength, "of the arcs that round its corners", "0.5"}.within(1e-3,
                                                                                                   1e6)};
constexpr std::array kWaypoint{
    ArgSpec{"path", ArgKind::kName, "a path's name"}.needed(),
    ArgSpec{"at", ArgKind::kPlace, "the new waypoint"}.needed(),
    ArgSpec{"index", ArgKind::kWhole, "which one it becomes, the first being 0 [the last]"}.within(0, 1e6)};
constexpr std::array kLandmarks{
    ArgSpec{"path", ArgKind::kName, "a cloud of landmarks around that path"},
    ArgSpec{"per_100m", ArgKind::kNumber, "points on 100 m of path"}.within(0, 1e6),
    ArgSpec{"sideways", ArgKind::kLength, "how far from the path"}.within(0, 1e5),
    ArgSpec{"height", ArgKind::kLength, "how far above and below"}.within(0, 1e5),
    ArgSpec{"name", ArgKind::kName, "of the cloud [the path's with `_cloud`]"},
    ArgSpec{"per_m2", ArgKind::kNumber, "points on a square metre of surface, instead of a cloud"}.within(
        0, 1e6),
    ArgSpec{"on", ArgKind::kWhat, "on which things [the whole map]"},
    ArgSpec{"seed", ArgKind::kWhole, "another seed puts them elsewhere"}.within(0, 9e15),
    ArgSpec{"moving_share", ArgKind::kNumber, "how many of a cloud's points move, 0 to 1 [0]"}.within(0, 1),
    ArgSpec{"speed", ArgKind::kNumber, "of those, in m/s, root mean square over time [1]"}.within(0, 1e3),
    ArgSpec{"motion", ArgKind::kChoice,
            "of those: each on a way of its own, or in groups that keep their shape [independent]", "",
            "independent group"},
    ArgSpec{"groups", ArgKind::kWhole, "how many groups they move in [4]"}.within(1, 1e6)};
constexpr std::array kLight{
    kAt, ArgSpec{"brightness", ArgKind::kNumber, "as in Quake", "300"}.within(0, 1e6),
    ArgSpec{"colour", ArgKind::kFactors, "red, green and blue, each 0 to 1 [white]"}.within(0, 1),
    kOptionalName};
constexpr std::array kMesh{
    ArgSpec{"file", ArgKind::kFile,
            "a model; a relative name counts from the map's folder, in which it must stand"}
        .needed(),
    kAt, kHeading,
    ArgSpec{"scale", ArgKind::kFactors, "its size, or that along each of its axes; negative ones mirror", "1"}
        .within(-1e6, 1e6),
    kOptionalName};

std::string degrees_text(double angle_rad) {
  return format_double(degrees(angle_rad) + 0.0);
}

map::Entity point_entity(const Edit& edit, const char* classname, const Vec3& at) {
  map::Entity entity;
  entity.keys = {{"classname", classname}, {"origin", vector_text(edit.units(at))}};
  return entity;
}

/// Makes the start of a name, or moves it; without a name the default one.
void start(Edit& edit, const Arguments& arguments) {
  worldspawn(edit.state);
  const std::string name = arguments.has("name") ? arguments.text("name") : std::string();
  if (name == map::kFreeStart)
    refuse("start: no robot start may be named `free`: scenarios mean any free place by it");
  const auto starts = entities_where(edit.state, [&](const EntityItem& entity) {
    return entity.classname() == "hw_robot_start" && entity.value("name") == name;
  });
  if (starts.size() > 1) {
    refuse("start: there are {} robot starts {}, and a map has one; `delete` the others than {}",
           starts.size(), name.empty() ? "without a name" : "of that name",
           describe(edit.state, starts.front()));
  }
  const std::string heading = degrees_text(arguments.number("heading"));
  if (starts.empty()) {
    map::Entity entity = point_entity(edit, "hw_robot_start", arguments.place("at"));
    entity.add("angle", heading);
    if (!name.empty()) entity.add("name", name);
    return say_made(edit, {add_entity(edit.state, std::move(entity))});
  }
  set_key(edit.state, starts[0].entity, "origin", vector_text(edit.units(arguments.place("at"))));
  set_key(edit.state, starts[0].entity, "angle", heading);
  say_changed(edit, starts);
}

// ---- Sensors --------------------------------------------------------------------------------------------------------

/// Refuses what is a key of no kind; which of them the kind has is said later.
void check_sensor_key(const std::string& key) {
  auto names = names_in(map::kSensorKeys, &map::KeySpec::name);
  if (std::ranges::find(names, key) != names.end()) return;
  for (const ArgSpec& argument : kSensor) names.emplace_back(argument.name);
  refuse("sensor: there is no argument or key `{}`{}", printable(key), suggestion(key, names));
}

/// The keys of a sensor that the arguments give.
Pairs sensor_keys(const Arguments& arguments) {
  Pairs keys;
  if (arguments.has("kind")) keys.emplace_back("kind", arguments.text("kind"));
  for (const char* angle : {"horizontal_fov", "vertical_fov", "yaw", "pitch", "roll"}) {
    if (arguments.has(angle))
      keys.emplace_back(std::string(angle) + "_deg", degrees_text(arguments.number(angle)));
  }
  for (const char* length : {"min_range", "max_range", "noise"}) {
    if (arguments.has(length))
      keys.emplace_back(std::string(length) + "_m", format_double(arguments.number(length)));
  }
  if (arguments.has("beam")) {
    std::string corners;
    for (const Vec3& corner : arguments.places("beam"))
      corners += (corners.empty() ? "" : " ") + format_double(corner.x()) + " " + format_double(corner.y());
    keys.emplace_back("beam_m", corners);
  }
  if (arguments.has("at")) keys.emplace_back("position_m", vector_text(arguments.place("at")));
  if (!arguments.has("keys")) return keys;
  for (const auto& [key, value] : arguments.keys("keys")) {
    if (key == "classname" || std::ranges::find(keys, key, &Pairs::value_type::first) != keys.end())
      refuse("sensor: the key {} is given already", printable(key));
    check_sensor_key(key);
    keys.emplace_back(key, value);
  }
  return keys;
}

/// Refuses a sensor that the simulator would not take.
void check_sensor(const Edit& edit, std::size_t sensor) {
  map::Document document;  // of that sensor alone
  document.file = edit.file;
  document.entities.push_back(*edit.state.entities[sensor]->head);
  try {
    map::sensors(document);
  } catch (const Error& error) {
    refuse("sensor: " + error.message());
  }
}

void sensor(Edit& edit, const Arguments& arguments) {
  worldspawn(edit.state);
  const std::string& name = arguments.text("name");
  const auto keys = sensor_keys(arguments);
  const auto there = entities_where(edit.state, [&](const EntityItem& entity) {
    return entity.classname() == "hw_sensor" && entity.has("name", name);
  });
  if (there.empty()) {
    check_new_name(edit.state, name);
    map::Entity entity;
    entity.keys = {{"classname", "hw_sensor"}, {"name", name}};
    if (!arguments.has("kind")) entity.add("kind", "points");
    for (const auto& [key, value] : keys) {
      if (!value.empty()) entity.add(key, value);
    }
    const Id id = add_entity(edit.state, std::move(entity));
    check_sensor(edit, edit.state.entities.size() - 1);
    return say_made(edit, {id});
  }
  if (there.size() > 1) {
    refuse("sensor: there are {} sensors named {}; `delete` the others than {}", there.size(), name,
           describe(edit.state, there.front()));
  }
  if (keys.empty()) {
    refuse("sensor: {} is there already; say what of it is to change", describe(edit.state, there.front()));
  }
  for (const auto& [key, value] : keys) set_key(edit.state, there.front().entity, key, value);
  check_sensor(edit, there.front().entity);
  say_changed(edit, there);
}

// ---- Paths ----------------------------------------------------------------------------------------------------------

/// Why a path cannot be made; empty if it can.
std::string fault_of_path(const Edit& edit, const std::string& name) {
  map::Document document;  // of what a path depends on
  document.file = edit.file;
  for (const auto& entity : edit.state.entities) {
    const std::string_view classname = entity->classname();
    if (classname == "worldspawn" || classname == "hw_path" || classname == "hw_waypoint")
      document.entities.push_back(*entity->head);
  }
  try {
    map::find_path(document, name);
  } catch (const Error& error) {
    return error.message();
  }
  return {};
}

map::Entity waypoint_entity(const Edit& edit, const std::string& path, std::size_t index, const Vec3& at) {
  map::Entity entity;
  entity.keys = {{"classname", "hw_waypoint"},
                 {"path", path},
                 {"index", std::to_string(index)},
                 {"origin", vector_text(edit.units(at))}};
  return entity;
}

void make_path(Edit& edit, const Arguments& arguments) {
  worldspawn(edit.state);
  const std::string& name = arguments.text("name");
  const auto& places = arguments.places("places");
  check_new_name(edit.state, name);
  if (places.size() < 2) refuse("path: one waypoint leads nowhere; name two places or more");
  map::Entity path;
  path.keys = {{"classname", "hw_path"},
               {"name", name},
               {"closed", arguments.text("closed") == "yes" ? "1" : "0"},
               {"corner_radius_m", format_double(arguments.number("corner_radius"))}};
  const Id id = add_entity(edit.state, std::move(path));
  for (std::size_t i = 0; i < places.size(); ++i)
    add_entity(edit.state, waypoint_entity(edit, name, i, places[i]));
  if (const std::string fault = fault_of_path(edit, name); !fault.empty()) refuse("path: " + fault);
  say_made(edit, {id});
  edit.report.data["waypoints"] = places.size();
}

/// The `hw_path` of that name, which may be one of waypoints only.
std::size_t path_named(const State& state, const std::string& name, bool of_waypoints, const char* command) {
  std::vector<std::string> names;
  for (std::size_t e = 0; e < state.entities.size(); ++e) {
    const EntityItem& entity = *state.entities[e];
    const std::string* own = entity.head->find("name");
    if (entity.classname() != "hw_path" || own == nullptr) continue;
    names.push_back(*own);
    if (*own != name) continue;
    const std::string* shape = entity.head->find("shape");
    if (of_waypoints && shape != nullptr && *shape != "waypoints")
      refuse("{}: the path {} is a {} and has no waypoints", command, name, printable(*shape));
    return e;
  }
  refuse("{}: there is no path \"{}\"{}{}", command, printable(name), suggestion(name, names),
         names.empty() ? "; `path` makes one" : "");
}

void waypoint(Edit& edit, const Arguments& arguments) {
  const std::string& path = arguments.text("path");
  path_named(edit.state, path, true, "waypoint");
  const auto others = waypoints_of(edit.state, path);
  if (!others.empty() && !others.front().first)
    refuse("waypoint: {} has no index that is a whole number",
           describe(edit.state, {others.front().second, {}}));
  const std::size_t index =
      arguments.has("index") ? static_cast<std::size_t>(arguments.whole("index")) : others.size();
  if (index > others.size()) {
    refuse("waypoint: index {} is too high; the path {} has {} waypoints, from 0 on", index, path,
           others.size());
  }
  for (std::size_t i = 0; i < others.size(); ++i) {
    const auto number = static_cast<std::int64_t>(i < index ? i : i + 1);
    if (others[i].first != number) set_key(edit.state, others[i].second, "index", std::to_string(number));
  }
  say_made(edit, {add_entity(edit.state, waypoint_entity(edit, path, index, arguments.place("at")))});
  edit.report.data["index"] = index;
  if (const std::string fault = fault_of_path(edit, path); !fault.empty()) {
    edit.report.say("note: as it is the path cannot be followed: " + fault);
    edit.report.data["notes"].push_back(fault);
  }
}

// ---- Landmarks --------------------------------------------------------------------------------------------------------

void scatter(Edit& edit, const Arguments& arguments) {
  const std::string density = format_double(arguments.number("per_m2"));
  std::vector<Thing> things{{worldspawn(edit.state), {}}};
  if (arguments.has("on")) {
    if (arguments.has("seed")) refuse("landmarks: `seed` is the whole map's; leave out `on`");
    things = resolve(edit.state, arguments.text("on"));
  }
  for (const Thing& thing : with_members(edit.state, things)) {
    const EntityItem& entity = *edit.state.entities[thing.entity];
    const map::EntitySpec* spec = map::find_entity_spec(entity.classname());
    const bool surface = spec != nullptr && spec->key("_points_per_m2") != nullptr;
    if (thing.brush) {
      refuse("landmarks: {} has no density of its own; `name` makes it a group, which can",
             describe(edit.state, thing));
    }
    const bool meant = std::ranges::find(things, thing) != things.end();
    if (!surface && meant) refuse("landmarks: " + describe(edit.state, thing) + " has no surface");
    if (surface) set_key(edit.state, thing.entity, "_points_per_m2", density);
  }
  if (arguments.has("seed"))
    set_key(edit.state, things[0].entity, "_point_seed", std::to_string(arguments.whole("seed")));
  say_changed(edit, things);
}

void add_motion(const Arguments& arguments, map::Entity& entity) {
  for (const char* key : {"moving_share", "speed"}) {
    if (arguments.has(key)) entity.add(key, format_double(arguments.number(key)));
  }
  if (arguments.has("motion")) entity.add("motion", arguments.text("motion"));
  if (arguments.has("groups")) entity.add("groups", std::to_string(arguments.whole("groups")));
}

void cloud(Edit& edit, const Arguments& arguments) {
  for (const char* needed : {"path", "per_100m", "sideways", "height"}) {
    if (!arguments.has(needed)) {
      refuse(
          "landmarks: `{}` is missing; a cloud takes path, per_100m, sideways and height, "
          "and surfaces take per_m2",
          needed);
    }
  }
  if (arguments.has("on")) refuse("landmarks: `on` goes with `per_m2`");
  const std::string& path = arguments.text("path");
  path_named(edit.state, path, false, "landmarks");
  const std::string name = arguments.has("name") ? arguments.text("name") : path + "_cloud";
  check_new_name(edit.state, name);
  map::Entity entity;
  entity.keys = {{"classname", "hw_landmark_cloud"},
                 {"name", name},
                 {"path", path},
                 {"per_100m", format_double(arguments.number("per_100m"))},
                 {"sideways_m", format_double(arguments.number("sideways"))},
                 {"height_m", format_double(arguments.number("height"))}};
  if (arguments.has("seed")) entity.add("seed", std::to_string(arguments.whole("seed")));
  add_motion(arguments, entity);
  say_made(edit, {add_entity(edit.state, std::move(entity))});
}

void landmarks(Edit& edit, const Arguments& arguments) {
  if (!arguments.has("per_m2")) return cloud(edit, arguments);
  for (const char* other :
       {"path", "per_100m", "sideways", "height", "name", "moving_share", "speed", "motion", "groups"}) {
    if (arguments.has(other)) {
      refuse("landmarks: `{}` belongs to a cloud and `per_m2` to surfaces; make one, then the other", other);
    }
  }
  scatter(edit, arguments);
}

// ---- Lights and models --------------------------------------------------------------------------------------------------

/// Adds an entity under the name that the arguments may have.
void add_named(Edit& edit, const Arguments& arguments, map::Entity entity) {
  if (const std::string name = arguments.text_or_empty("name"); !name.empty()) {
    check_new_name(edit.state, name);
    entity.add("targetname", name);
  }
  say_made(edit, {add_entity(edit.state, std::move(entity))});
}

void light(Edit& edit, const Arguments& arguments) {
  worldspawn(edit.state);
  map::Entity entity = point_entity(edit, "light", arguments.place("at"));
  entity.add("light", format_double(arguments.number("brightness")));
  if (arguments.has("colour")) entity.add("_color", vector_text(arguments.place("colour")));
  add_named(edit, arguments, std::move(entity));
}

/// A model's file as maps name it: relative to the map's folder, with slashes.
std::string model_name(const Edit& edit, const std::string& file) {
  std::error_code none;
  const fs::path map_file = fs::absolute(edit.file, none);
  const fs::path folder = fs::weakly_canonical(map_file.parent_path(), none);
  const fs::path given = fs::path(file).is_absolute() ? fs::path(file) : folder / file;
  if (!fs::is_regular_file(given, none)) {
    refuse("mesh: there is no file {}; a relative name counts from the map's folder",
           printable(given.string()));
  }
  const fs::path inside = fs::weakly_canonical(given, none).lexically_relative(folder);
  if (inside.empty() || *inside.begin() == "..") {
    refuse("mesh: {} is not in the map's folder {}; copy it there", printable(file),
           printable(folder.string()));
  }
  return inside.generic_string();
}

void mesh(Edit& edit, const Arguments& arguments) {
  worldspawn(edit.state);
  const Vec3& scale = arguments.place("scale");
  for (const double factor : scale) {
    if (std::abs(factor) < 1e-6)
      refuse("mesh: a scale of {} is too small; 1e-6 is the least", format_double(factor));
  }
  map::Entity entity = point_entity(edit, "hw_mesh", arguments.place("at"));
  entity.add("model", model_name(edit, arguments.text("file")));
  entity.add("angle", degrees_text(arguments.number("heading")));
  const bool even = scale.x() == scale.y() && scale.y() == scale.z();
  if (!even) {
    entity.add("scale", vector_text(scale));
  } else if (scale.x() != 1.0) {
    entity.add("scale", format_double(scale.x()));
  }
  add_named(edit, arguments, std::move(entity));
}

constexpr std::array kPlacesCommands{
    CommandSpec{
        .name = "start",
        .summary = "put a robot start somewhere, or move the one of that name",
        .details = "A start without a name is the default, and a map has at most one such; scenarios choose "
                   "others by name. A robot that follows a path begins where the path does; `validate` warns "
                   "where no path begins at the default start.",
        .arguments = kStart,
        .example = "start at 1,1,0.2 heading 90",
        .run = &start},
    CommandSpec{.name = "sensor",
                .summary = "put a sensor on the robot, or change the one of that name",
                .details = "Scenarios without sensors of their own take those of their map. Of a sensor that "
                           "is there already only "
                           "what is given changes. Any key of its kind may follow: `sensor scan kind=lidar "
                           "preset=lidar16 rate_hz=5`.",
                .arguments = kSensor,
                .example = "sensor eyes horizontal_fov=120 max_range=12 noise=2cm at=0.2,0,0.5 pitch=10",
                .run = &sensor},
    CommandSpec{
        .name = "path",
        .summary = "make a path through waypoints",
        .details = "A path that no robot can follow, because a corner's arc has no room, say, is refused.",
        .arguments = kPath,
        .example = "path round 0,0,0.7;5,0,0.7;5,4,0.7;0,4,0.7 closed=yes corner_radius=0.5",
        .run = &make_path},
    CommandSpec{.name = "waypoint",
                .summary = "add a waypoint to a path; those behind it are numbered anew",
                .details = "`move` moves one, `delete` takes one away.",
                .arguments = kWaypoint,
                .example = "waypoint way at 5,4 index=1",
                .before = "path way 0,0;10,0",
                .run = &waypoint},
    CommandSpec{
        .name = "landmarks",
        .summary = "scatter landmarks around a path or on surfaces",
        .details = "With `per_m2` on the surfaces of the map or of things, else as a cloud around a path.",
        .arguments = kLandmarks,
        .example = "landmarks path=way per_100m=100 sideways=5 height=2",
        .before = "path way 0,0;10,0",
        .run = &landmarks},
    CommandSpec{.name = "light",
                .summary = "put a light somewhere",
                .arguments = kLight,
                .example = "light at 2,3,2.5 brightness=300 colour=1,0.9,0.8 name=lamp",
                .run = &light},
    CommandSpec{
        .name = "mesh",
        .summary = "put a model somewhere",
        .details = "glTF, GLB, OBJ, STL, PLY and others. The map names the file relative to its own folder.",
        .arguments = kMesh,
        .example = "mesh model.obj at 2,3 heading=30",
        .run = &mesh},
};

}  // namespace

std::span<const CommandSpec> places_commands() {
  return kPlacesCommands;
}

}  // namespace hallway::editor
