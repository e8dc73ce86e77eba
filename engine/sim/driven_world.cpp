// SPDX-License-Identifier: MIT
#include "sim/driven_world.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "base/error.hpp"
#include "base/text.hpp"
#include "bsp/point_location.hpp"
#include "csg/surface.hpp"
#include "map/entities.hpp"
#include "map/path.hpp"
#include "sim/robot_body.hpp"

namespace hallway::sim {
namespace {

constexpr const char* kFreeStart = "free";

Error robot_error(const Scenario& scenario, const std::string& message) {
  return {ErrorCode::kBadInput, message, Where{printable(scenario.file), 0, "table `robot`"}};
}

void add_triangles(const trace::TriangleMesh& mesh, std::vector<contact::Triangle>& triangles) {
  for (const auto& corners : mesh.triangles)
    triangles.push_back({mesh.vertices[corners[0]], mesh.vertices[corners[1]], mesh.vertices[corners[2]]});
}

contact::Obstacles make_obstacles(const world::CompiledWorld& world, const PlacedModels& models) {
  std::vector<contact::Triangle> triangles;
  const csg::Surface& surface = world.partition.surface;
  for (const csg::SurfacePolygon& polygon : surface.polygons) {
    for (const auto& t : csg::triangulate(surface, polygon))
      triangles.push_back({surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]});
  }
  for (const trace::TriangleMesh& mesh : triangles_of(models)) add_triangles(mesh, triangles);
  return contact::Obstacles(std::move(triangles));
}

/// Where a drive's wheels are. Two driven wheels have casters before and behind them.
contact::Wheels wheels_of(const drive::DriveSpec& spec) {
  const double side = 0.5 * spec.wheel_base_m, front = 0.5 * spec.axle_distance_m;
  switch (spec.kind) {
    case drive::DriveKind::kAckermann:
      return {.at = {{0.0, side}, {0.0, -side}, {2.0 * front, side}, {2.0 * front, -side}},
              .centre_of_mass = {front, 0.0}};
    case drive::DriveKind::kTracked:
    case drive::DriveKind::kOmnidirectional:
      return {.at = {{front, side}, {front, -side}, {-front, side}, {-front, -side}}};
    default:
      return {.at = {{0.0, side}, {0.0, -side}, {side, 0.0}, {-side, 0.0}}};
  }
}

contact::RobotSpec robot_of(const Scenario& scenario) {
  const DrivenSpec& driven = *scenario.robot.driven;
  if (!has_body(scenario.robot)) {
    throw robot_error(
        scenario,
        "a robot with a drive needs a body: `radius_m`, or `length_m` and `width_m`, with `bottom_m` and "
        "`top_m`, or a robot file");
  }
  try {
    contact::RobotSpec spec{.shape = shape_of(scenario.robot, driven.clearance_m),
                            .wheels = wheels_of(driven.drive)};
    spec.ground.step_m = driven.step_m;
    spec.ground.ledge_m = driven.ledge_m;
    spec.ground.slope_rad = driven.slope_rad;
    spec.ground.clearance_m = driven.clearance_m;
    spec.move.slide = driven.slides;
    spec.move.gyration = gyration_of(scenario.robot);
    spec.falls = driven.falls;
    return spec;
  } catch (const Error& error) {
    throw robot_error(scenario, error.message());
  }
}

double heading(const Pose& pose) {
  const Vec3 ahead = pose.q * Vec3::UnitX();
  return std::atan2(ahead.y(), ahead.x());
}

/// @param where  that names the start
Pose named_start(const map::Document& document, const std::string& name, const Where& where) {
  try {
    if (const auto start = map::find_robot_start(document, name)) return start->T_world_body;
  } catch (const Error& error) {
    throw Error(ErrorCode::kBadInput, error.message(), where);
  }
  throw Error(ErrorCode::kBadInput, "the map has no robot start", where);
}

std::string cause_of(contact::Start start, const std::string& place) {
  switch (start) {
    case contact::Start::kInObstacle:
      return "the robot overlaps something " + place;
    case contact::Start::kInSolid:
      return "the robot is in solid " + place;
    case contact::Start::kNoFloor:
      return "there is no floor below the robot " + place;
    default:
      return "the floor is too uneven or too steep, or there is a ledge under a wheel, " + place;
  }
}

}  // namespace

DrivenWorld::DrivenWorld(const Scenario& scenario, const map::Document& document,
                         const world::CompiledWorld& world, const PlacedModels& models)
    : world_(world), obstacles_(make_obstacles(world, models)), robot_(robot_of(scenario)) {
  T_floor_body_.t.z() = scenario.robot.driven->clearance_m - height_of(scenario.robot).first;
  find_start(scenario, document);
  find_kidnaps(scenario, document);
}

bool DrivenWorld::is_solid(const Vec3& point) const {
  return bsp::cluster_at(world_.partition.tree, point) < 0;
}

contact::Start DrivenWorld::put(contact::Robot& robot, const Pose& T_world_body) const {
  return robot.put(T_world_body.t, heading(T_world_body), 0,
                   [this](const Vec3& point) { return is_solid(point); });
}

void DrivenWorld::put_at_start(contact::Robot& robot) const {
  put(robot, place_);
}

const contact::ReachableFloor& DrivenWorld::floor() const {
  if (!floor_)
    floor_.emplace(obstacles_, robot_, start_ * T_floor_body_.inverse(),
                   [this](const Vec3& point) { return is_solid(point); });
  return *floor_;
}

void DrivenWorld::find_start(const Scenario& scenario, const map::Document& document) {
  const RobotSpec& spec = scenario.robot;
  std::optional<contact::Robot> robot;
  try {
    robot.emplace(obstacles_, robot_);
  } catch (const Error& error) {
    throw robot_error(scenario, error.message());
  }
  if (spec.start == kFreeStart) {
    auto found = contact::find_free_start(
        obstacles_, robot_, world_.partition.tree.bounds,
        [this](const Vec3& point) { return is_solid(point); }, scenario.seed);
    if (!found) throw robot_error(scenario, "no free place was found on which the robot can move");
    place_.t = found->place.position;
    place_.q = from_yaw_pitch_roll(found->place.yaw_rad, 0.0, 0.0);
    floor_.emplace(std::move(found->floor));
    if (put(*robot, place_) != contact::Start::kStands)
      throw Error(ErrorCode::kInternal, "the robot's free start is not free");
  } else {
    Where where{printable(document.file), 0, "hw_robot_start"};
    if (!spec.path.empty()) {
      place_ = map::find_path(document, spec.path).at(0.0);
      where.element = "path `" + printable(spec.path) + "`";
    } else if (const auto start = map::find_robot_start(document, spec.start)) {
      place_ = start->T_world_body;
      where.line = start->line;
    } else {
      throw Error(
          ErrorCode::kBadInput,
          "the scenario names no path, and the map has no hw_robot_start; `start = \"free\"` finds a place",
          Where{printable(document.file), 0, {}});
    }
    if (const contact::Start how = put(*robot, place_); how != contact::Start::kStands)
      throw Error(ErrorCode::kBadInput, cause_of(how, "at its start"), where);
  }
  start_ = robot->pose() * T_floor_body_;
}

/// Tries each place to which the robot will be carried.
void DrivenWorld::find_kidnaps(const Scenario& scenario, const map::Document& document) {
  kidnaps_.resize(scenario.events.size());
  contact::Robot robot(obstacles_, robot_);
  for (std::size_t i = 0; i < scenario.events.size(); ++i) {
    const EventSpec& event = scenario.events[i];
    if (event.kind != EventKind::kKidnap) continue;
    const Where where{printable(scenario.file), event.line, "a kidnap"};
    if (event.place_m) {
      kidnaps_[i] = {from_yaw_pitch_roll(event.yaw_rad, 0.0, 0.0), *event.place_m};
    } else {
      kidnaps_[i] = named_start(document, event.to, where);
    }
    if (const contact::Start how = put(robot, kidnaps_[i]); how != contact::Start::kStands)
      throw Error(ErrorCode::kBadInput, cause_of(how, "where it is carried to"), where);
  }
}

void DrivenWorld::carry(contact::Robot& robot, std::size_t event) const {
  const Pose& place = kidnaps_.at(event);
  robot.carry(place.t, heading(place), [this](const Vec3& point) { return is_solid(point); });
}

}  // namespace hallway::sim
