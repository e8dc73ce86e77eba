// SPDX-License-Identifier: MIT
#include "sim/simulator.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "base/text.hpp"
#include "bsp/point_location.hpp"
#include "drive/wheels.hpp"
#include "map/content.hpp"
#include "map/entities.hpp"
#include "map/entity_keys.hpp"
#include "map/reader.hpp"
#include "map/robot_file.hpp"
#include "map/start_check.hpp"
#include "sense/cloud_landmarks.hpp"
#include "sense/face_landmarks.hpp"
#include "sense/mesh_landmarks.hpp"
#include "sense/occluders.hpp"
#include "sim/clouds.hpp"
#include "sim/obstacle.hpp"
#include "sim/robot_body.hpp"
#include "sim/scene_surfaces.hpp"
#include "sim/sensors.hpp"

namespace hallway::sim {
namespace {

constexpr double kNever_m = std::numeric_limits<double>::infinity();

double find_step_length(const Scenario& scenario, const map::Path& path) {
  if (scenario.robot.loop_steps) return path.length_m() / *scenario.robot.loop_steps;
  return scenario.robot.speed_m_s.value_or(0.0) * scenario.period_s();
}

map::Path line_ahead(const Pose& pose) {
  const Vec3 line[]{pose.t, pose.t + pose.q * Vec3::UnitX()};
  return map::Path(map::RoundedPolyline(line, false, 1.0));
}

/// The path of the scenario; without one, a piece of the straight line ahead of the robot start, on which it stays.
/// @param driven  of a robot with a drive
map::Path path_of(const map::Document& document, const RobotSpec& robot, const DrivenWorld* driven) {
  if (!robot.path.empty())
    return map::find_path(document, robot.path,
                          robot.smooth ? map::CornerShape::kSmooth : map::CornerShape::kArcs);
  if (driven != nullptr) return line_ahead(driven->start());
  const std::optional<map::RobotStart> start = map::find_robot_start(document, robot.start);
  if (!start) {
    throw Error(ErrorCode::kBadInput, "the scenario names no path, and the map has no hw_robot_start",
                Where{printable(document.file), 0, {}});
  }
  return line_ahead(start->T_world_body);
}

std::string file_of(const map::Document& document) {
  return printable(document.file);
}

map::Document load_world(const std::filesystem::path& file) {
  map::Document document = map::load(file);
  map::require_world(document);
  return document;
}

/// What the cache has is used; a run adds nothing to it and is content with the fast sets, since they change no result.
world::CompiledWorld compile_for_run(const map::Document& document, const std::filesystem::path& file,
                                     unsigned threads) {
  world::Settings settings;
  settings.level = pvs::Level::kFast;
  settings.threads = threads;
  settings.cache = world::cache_folder(file);
  settings.write_cache = false;
  return world::compile(document, settings);
}

/// What the map's landmarks are made from: the map with the keys that the scenario sets in its clouds.
map::Document with_clouds(const map::Document& document, const Scenario& scenario) {
  map::Document changed = document;
  set_cloud_keys(scenario.clouds, changed);
  return changed;
}

/// What sensors see: what bounds the inside of a sealed world, everything where the world is open; no sky.
bool is_seen(const world::CompiledWorld& world, std::size_t polygon) {
  const csg::SurfacePolygon& p = world.partition.surface.polygons[polygon];
  return (!world.sealed() || world.partition.inside[polygon]) &&
         !map::is_sky(world.brushes.solids[p.solid].faces[p.face].material);
}

/// Points on what sensors see.
Landmarks find_landmarks(const map::Document& document, const world::CompiledWorld& world,
                         const PlacedModels& models) {
  const auto wanted = [&](std::size_t polygon) { return is_seen(world, polygon); };
  Landmarks made;
  std::vector<Vec3>& landmarks = made.places;
  sense::add_face_landmarks(document, world.brushes, world.partition.surface, wanted, landmarks);
  const std::size_t first_cloud = landmarks.size();
  sense::add_cloud_landmarks(document, landmarks);
  made.moving = sense::MovingLandmarks(document, landmarks, first_cloud);
  const map::FacePoints points = map::face_points(document);
  constexpr double kMostPerM2 = 1e6;
  for (std::size_t i = 0; i < models.meshes.size(); ++i) {
    const map::EntityKeys keys(document,
                               document.entities[static_cast<std::size_t>(models.placements[i].entity)]);
    const double per_m2 = keys.number_or("_points_per_m2", points.per_m2, 0.0, kMostPerM2);
    sense::add_mesh_landmarks(models.meshes[i], static_cast<std::uint32_t>(i), per_m2, points.seed,
                              landmarks);
  }
  return made;
}

sense::LandmarkIndex make_index(const std::vector<Vec3>& landmarks, const world::CompiledWorld& world) {
  if (!world.visible) return sense::LandmarkIndex(landmarks);
  return sense::LandmarkIndex(landmarks, world.partition.tree, *world.visible);
}

void report_brushes(const map::Document& document, const map::World& world, std::vector<Error>& problems) {
  for (const map::Problem& problem : world.problems) {
    problems.emplace_back(
        ErrorCode::kBadInput, map::problem_text(problem),
        Where{file_of(document), problem.line, map::brush_name(problem.entity, problem.brush)});
  }
}

/// Throws if a robot start is in solid.
void check_robot_starts(const map::Document& document, const world::CompiledWorld& world) {
  for (const map::RobotStart& start : map::robot_starts(document)) {
    for (const std::size_t index : world.partition.enclosure.in_solid) {
      if (world.occupants[index].entity != start.entity) continue;
      throw Error(ErrorCode::kBadInput, "the robot start is in solid",
                  Where{file_of(document), start.line, "hw_robot_start"});
    }
  }
}

/// Encoders and odometers have the wheels of the drive.
void take_drive(Scenario& scenario) {
  if (!scenario.robot.driven) return;
  const drive::DriveSpec& drive = scenario.robot.driven->drive;
  const auto n = drive::wheel_count(drive.kind);
  for (SensorSpec& spec : scenario.sensors) {
    if (auto* encoders = std::get_if<EncoderSpec>(&spec)) encoders->wheel_radius_m = drive.wheel_radius_m;
    auto* odometer = std::get_if<sense::WheelOdometrySpec>(&spec);
    if (odometer == nullptr) continue;
    odometer->encoder.wheel_radius_m = drive.wheel_radius_m;
    odometer->wheels = n == 4 ? sense::mecanum_odometry_wheels(drive.wheel_base_m, drive.axle_distance_m)
                              : sense::two_odometry_wheels(drive.wheel_base_m);
  }
}

std::string place_text(const Vec3& place) {
  const auto rounded = [](double value) { return format_double(std::round(value * 100.0) / 100.0 + 0.0); };
  return "(" + rounded(place.x()) + ", " + rounded(place.y()) + ", " + rounded(place.z()) + ")";
}

}  // namespace

Simulator::Simulator(const Scenario& scenario, unsigned threads, trace::Backend backend)
    : scenario_(scenario),
      threads_(std::max(threads, 1u)),
      document_(load_world(scenario.map_file)),
      world_(compile_for_run(document_, scenario.map_file, threads_)),
      models_(load_models(document_, scenario.map_file.parent_path())),
      driven_world_(scenario.robot.driven
                        ? std::make_unique<const DrivenWorld>(scenario, document_, world_, models_)
                        : nullptr),
      path_(path_of(document_, scenario.robot, driven_world_.get())),
      step_length_m_(find_step_length(scenario, path_)),
      scene_(sense::make_occluders(world_.partition.surface, triangles_of(models_)), backend),
      landmarks_(find_landmarks(with_clouds(document_, scenario), world_, models_)),
      landmark_index_(make_index(landmarks_.places, world_)) {
  take_map_sensors(scenario_, document_);
  take_drive(scenario_);
  scenario_.materials.add_below(
      map::materials_of(document_, scenario.map_file.parent_path(), scenario_.settings));
  earth_ = map::earth_of(document_);
  rig_ = std::make_unique<const Rig>(scenario_, sensed_world());
  report_brushes(document_, world_.brushes, problems_);
  for (const std::string& warning : models_.warnings) problems_.emplace_back(ErrorCode::kBadInput, warning);
  check_robot_starts(document_, world_);
  // A start at which another path of the map begins belongs to that path.
  if (!scenario.robot.path.empty() && map::start_off_all_paths(document_)) {
    if (const auto off = map::start_off_path(document_, scenario.robot.path)) {
      problems_.emplace_back(ErrorCode::kBadInput, map::start_off_path_text(*off),
                             Where{file_of(document_), off->start.line, "hw_robot_start"});
    }
  }
  if (!driven_world_) {
    stop_at_obstacle();
    rig_->check_ways(*path_motion(), scenario_.period_ns * (std::int64_t{scenario_.steps} - 1));
  }
  report_silent_sensors();
  report_misplaced_sensors();
  report_undescribed_materials();
}

/// What sensors take from the world.
SensedWorld Simulator::sensed_world() const {
  const auto wanted = [this](std::size_t polygon) { return is_seen(world_, polygon); };
  return {.scene = scene_,
          .landmarks = landmark_index_,
          .moving = landmarks_.moving,
          .walls = [this](double height_m) { return walls_at(height_m); },
          .faces = [this, wanted] { return sense::make_face_plan(world_.partition.surface, wanted); },
          .surfaces = [this] { return surfaces(); },
          .earth = earth_,
          .T_world_start = start(),
          .threads = threads_};
}

sense::Surfaces Simulator::surfaces() const {
  const trace::TriangleMesh mesh = sense::make_occluders(world_.partition.surface, triangles_of(models_));
  if (scenario_.materials.empty()) return undescribed_surfaces(mesh);
  return surfaces_of(mesh, label_scene(world_, models_), scenario_.materials);
}

sense::WallPlan Simulator::walls_at(double height_m) const {
  const auto wanted = [&](std::size_t polygon) { return is_seen(world_, polygon); };
  return sense::make_wall_plan(world_.partition.surface, wanted, height_m, triangles_of(models_));
}

/// Of a sensor whose first reading arrives after the last frame.
void Simulator::report_silent_sensors() {
  const std::int64_t end_ns = scenario_.period_ns * (std::int64_t{scenario_.steps} - 1);
  for (std::size_t i = 0; i < rig_->size(); ++i) {
    if (rig_->clock(i).arrived_by(end_ns) > 0) continue;
    const std::string& name =
        std::visit([](const auto& spec) -> const std::string& { return spec.name; }, scenario_.sensors[i]);
    problems_.emplace_back(ErrorCode::kBadInput, "no reading arrives by the last frame",
                           Where{printable(scenario_.file), 0, "sensor `" + printable(name) + "`"});
  }
}

/// Of a sensor that begins within a wall, and of a sonar that hears the robot's own body.
void Simulator::report_misplaced_sensors() {
  const auto report = [this](const std::string& name, std::string problem) {
    problems_.emplace_back(ErrorCode::kBadInput, std::move(problem),
                           Where{printable(scenario_.file), 0, "sensor `" + printable(name) + "`"});
  };
  for (std::size_t i = 0; i < rig_->size(); ++i) {
    std::visit(
        [&](const auto& spec) {
          if constexpr (requires { spec.T_body_sensor.t; }) {
            const Vec3 place = start() * spec.T_body_sensor.t;
            if (bsp::cluster_at(world_.partition.tree, place) < 0)
              report(spec.name,
                     "is within a wall or outside of the map at the start, at " + place_text(place));
          }
          if (rig_->meets_own_body(i))
            report(spec.name,
                   "the robot's own body is in its beam, and its echo is the nearest; `own_body = false` "
                   "leaves it out");
        },
        scenario_.sensors[i]);
  }
}

/// Of models, where sensors use a table of materials. The map's own are `hallway map check`'s.
void Simulator::report_undescribed_materials() {
  const bool used = std::ranges::any_of(scenario_.sensors, [](const SensorSpec& sensor) {
    return std::holds_alternative<sense::LidarSpec>(sensor) ||
           std::holds_alternative<sense::SonarSpec>(sensor) ||
           std::holds_alternative<sense::InfraredSpec>(sensor);
  });
  if (!used || scenario_.materials.empty()) return;
  constexpr std::size_t kNamed = 5;
  const std::vector<std::string> names = undescribed_materials(models_, scenario_.materials);
  if (names.empty()) return;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), kNamed); ++i)
    list += (i > 0 ? ", " : "") + ("`" + printable(names[i], 80) + "`");
  if (names.size() > kNamed) list += " and " + std::to_string(names.size() - kNamed) + " more";
  problems_.emplace_back(
      ErrorCode::kBadInput,
      "the table of materials says nothing of " + list + " of models; they have the defaults",
      Where{file_of(document_), 0, {}});
}

void Simulator::stop_at_obstacle() {
  double way_m = std::min(path_.length_m(), step_length_m_ * (scenario_.steps - 1));
  if (scenario_.robot.smooth)
    way_m = std::min(way_m, smooth_pace().at(scenario_.period_s() * (scenario_.steps - 1)).way_m);
  const auto obstacle = find_obstacle(world_, scene_, path_, way_m, scenario_.robot.body);
  if (!obstacle) return;
  const std::string& path = scenario_.robot.path;
  const Where where{file_of(document_), obstacle->line,
                    path.empty() ? "hw_robot_start" : "path `" + printable(path) + "`"};
  if (obstacle->distance_m == 0.0) {
    throw Error(ErrorCode::kBadInput,
                "begins inside " + obstacle->name + ", at " + place_text(obstacle->from), where);
  }
  constexpr double kBackOff_m = 0.001;  // a sensor on the surface would be inside it by rounding
  stop_m_ = std::max(obstacle->distance_m - kBackOff_m, 0.0);
  const double rounded_m = std::max(std::round(obstacle->distance_m * 100.0) / 100.0, 0.01);
  problems_.emplace_back(ErrorCode::kBadInput,
                         "runs into " + obstacle->name + " after " + format_double(rounded_m) +
                             " m, between " + place_text(obstacle->from) + " and " +
                             place_text(obstacle->to) + "; the robot stops there",
                         where);
}

Pose Simulator::pose_after(double distance_m) const {
  return path_.at(stop_m_ ? std::min(distance_m, *stop_m_) : distance_m);
}

Pose Simulator::pose_at(std::uint32_t index) const {
  if (scenario_.robot.smooth) return pose_at_time(scenario_.period_ns * std::int64_t{index});
  return pose_after(step_length_m_ * index);
}

SmoothPace Simulator::smooth_pace() const {
  const double end_m = path_.closed() ? kNever_m : path_.length_m();
  return SmoothPace(step_length_m_ / scenario_.period_s(), std::min(end_m, stop_m_.value_or(kNever_m)));
}

std::unique_ptr<const Motion> Simulator::path_motion() const {
  if (scenario_.robot.smooth) return std::make_unique<const SmoothPathMotion>(path_, smooth_pace());
  return std::make_unique<const PathMotion>(path_, step_length_m_, scenario_.period_ns,
                                            stop_m_.value_or(kNever_m));
}

Pose Simulator::pose_at_time(std::int64_t t_ns) const {
  return path_motion()->pose_at(t_ns);
}

Frame Simulator::step(std::uint32_t index) const {
  Frame frame = step(index, *path_motion());
  frame.T_world_body = pose_at(index);
  return frame;
}

Frame Simulator::step(std::uint32_t index, const Motion& motion) const {
  if (index >= scenario_.steps)
    throw Error(ErrorCode::kInternal, "a frame beyond the scenario's last step was asked for");
  Frame frame;
  frame.step = index;
  frame.t_ns = scenario_.period_ns * std::int64_t{index};
  frame.T_world_body = motion.pose_at(frame.t_ns);
  rig_->read(index == 0 ? -1 : frame.t_ns - scenario_.period_ns, frame.t_ns, motion, frame.readings);
  return frame;
}

}  // namespace hallway::sim
