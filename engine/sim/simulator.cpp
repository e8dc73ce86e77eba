// SPDX-License-Identifier: MIT
#include "sim/simulator.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "base/text.hpp"
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
#include "sim/sensors.hpp"

namespace hallway::sim {
namespace {

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
  if (!robot.path.empty()) return map::find_path(document, robot.path);
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
  make_sensors();
  find_times_off();
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
    check_poses();
  }
  report_silent_sensors();
}

/// A frame is as large as what arrives in it.
void Simulator::check_rate(const SensorSpec& spec) const {
  constexpr double kMostInAFrame = 10'000.0;
  std::visit(
      [this](const auto& sensor) {
        const double in_a_frame = sensor.timing.rate_hz * scenario_.period_s();
        if (in_a_frame <= kMostInAFrame) return;
        throw Error(ErrorCode::kBadInput,
                    "a frame would hold " + format_double(std::round(in_a_frame)) + " readings, more than " +
                        format_double(kMostInAFrame),
                    Where{printable(scenario_.file), 0, "sensor `" + printable(sensor.name) + "`"});
      },
      spec);
}

void Simulator::make_sensors() {
  sensors_.reserve(scenario_.sensors.size());
  for (SensorSpec& spec : scenario_.sensors) {
    check_rate(spec);
    clocks_.push_back(std::visit(
        [this](const auto& sensor) { return sense::ReadingClock(sensor.timing, scenario_.period_ns); },
        spec));
    plans_.emplace_back();
    face_plans_.emplace_back();
    if (auto* encoders = std::get_if<sense::EncoderSensorSpec>(&spec); encoders != nullptr && driven_world_)
      encoders->wheel_radius_m = scenario_.robot.driven->drive.wheel_radius_m;
    make_sensor(spec);
  }
}

void Simulator::make_sensor(const SensorSpec& spec) {
  const auto demand_drive = [&](const std::string& name) {
    if (!driven_world_)
      throw Error(ErrorCode::kBadInput, "needs a [robot.drive], whose body or wheels it senses",
                  Where{printable(scenario_.file), 0, "sensor `" + printable(name) + "`"});
  };
  if (const auto* bump = std::get_if<sense::BumpSensorSpec>(&spec)) {
    demand_drive(bump->name);
    sensors_.emplace_back(std::in_place_type<sense::BumpSensor>, *bump, scenario_.seed);
  } else if (const auto* encoders = std::get_if<sense::EncoderSensorSpec>(&spec)) {
    demand_drive(encoders->name);
    sensors_.emplace_back(std::in_place_type<sense::EncoderSensor>, *encoders,
                          drive::wheel_count(scenario_.robot.driven->drive.kind), scenario_.seed);
  } else if (const auto* points = std::get_if<sense::PointSensorSpec>(&spec)) {
    sensors_.emplace_back(std::in_place_type<sense::PointSensor>, *points, landmark_index_, scene_,
                          scenario_.seed);
  } else {
    make_plane_sensor(std::get<sense::PlaneSensorSpec>(spec));
  }
}

void Simulator::make_plane_sensor(const sense::PlaneSensorSpec& spec) {
  if (spec.shape == sense::PlaneShape::faces) {
    const auto wanted = [&](std::size_t polygon) { return is_seen(world_, polygon); };
    face_plans_.back() =
        std::make_unique<const sense::FacePlan>(sense::make_face_plan(world_.partition.surface, wanted));
    sensors_.emplace_back(std::in_place_type<sense::FaceSensor>, spec, *face_plans_.back(), scenario_.seed);
    return;
  }
  const double height_m = (start() * spec.T_body_sensor).t.z();
  plans_.back() = std::make_unique<const sense::WallPlan>(walls_at(height_m));
  sensors_.emplace_back(std::in_place_type<sense::PlaneSensor>, spec, *plans_.back(), scenario_.seed);
}

sense::WallPlan Simulator::walls_at(double height_m) const {
  const auto wanted = [&](std::size_t polygon) { return is_seen(world_, polygon); };
  return sense::make_wall_plan(world_.partition.surface, wanted, height_m, triangles_of(models_));
}

/// Sensors of walls demand a level way; before the run, for it is long.
void Simulator::check_poses() const {
  const std::int64_t end_ns = scenario_.period_ns * (std::int64_t{scenario_.steps} - 1);
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    const auto* planes = std::get_if<sense::PlaneSensor>(&sensors_[i]);
    const std::uint64_t n = planes != nullptr ? clocks_[i].arrived_by(end_ns) : 0;
    for (std::uint64_t k = 0; k < n; ++k)
      planes->check_pose(pose_at_time(clocks_[i].time_of(k)), static_cast<std::uint32_t>(k));
  }
}

void Simulator::find_times_off() {
  switches_.resize(scenario_.sensors.size());
  const auto name_of = [](const SensorSpec& sensor) {
    return std::visit([](const auto& spec) { return spec.name; }, sensor);
  };
  for (const EventSpec& event : scenario_.events) {
    if (event.kind != EventKind::kSensorOff && event.kind != EventKind::kSensorOn) continue;
    const auto sensor = std::ranges::find(scenario_.sensors, event.sensor, name_of);
    if (sensor == scenario_.sensors.end())
      throw Error(
          ErrorCode::kBadInput, "there is no sensor `" + printable(event.sensor) + "`",
          Where{printable(scenario_.file), event.line, "a " + std::string(event_kind_name(event.kind))});
    auto& times = switches_[static_cast<std::size_t>(sensor - scenario_.sensors.begin())];
    const bool is_off = times.size() % 2 == 1;
    if (is_off != (event.kind == EventKind::kSensorOff)) times.push_back(event.t_ns);
  }
}

bool Simulator::is_off(std::size_t sensor, std::int64_t t_ns) const {
  const auto later = std::ranges::upper_bound(switches_[sensor], t_ns);
  return (later - switches_[sensor].begin()) % 2 == 1;
}

/// Of a sensor whose first reading arrives after the last frame.
void Simulator::report_silent_sensors() {
  const std::int64_t end_ns = scenario_.period_ns * (std::int64_t{scenario_.steps} - 1);
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    if (clocks_[i].arrived_by(end_ns) > 0) continue;
    const std::string& name =
        std::visit([](const auto& spec) -> const std::string& { return spec.name; }, scenario_.sensors[i]);
    problems_.emplace_back(ErrorCode::kBadInput, "no reading arrives by the last frame",
                           Where{printable(scenario_.file), 0, "sensor `" + printable(name) + "`"});
  }
}

void Simulator::stop_at_obstacle() {
  const double way_m = std::min(path_.length_m(), step_length_m_ * (scenario_.steps - 1));
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
  return pose_after(step_length_m_ * index);
}

PathMotion Simulator::path_motion() const {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  return {path_, step_length_m_, scenario_.period_ns, stop_m_.value_or(kNever)};
}

Pose Simulator::pose_at_time(std::int64_t t_ns) const {
  return path_motion().pose_at(t_ns);
}

Frame Simulator::step(std::uint32_t index) const {
  Frame frame = step(index, path_motion());
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
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    const std::uint64_t first = index == 0 ? 0 : clocks_[i].arrived_by(frame.t_ns - scenario_.period_ns);
    const std::uint64_t end = clocks_[i].arrived_by(frame.t_ns);
    for (std::uint64_t k = first; k < end; ++k) {
      if (is_off(i, clocks_[i].time_of(k))) continue;
      frame.readings.push_back({.sensor = i, .sequence = k, .t_ns = clocks_[i].time_of(k)});
      if (!read(i, motion, frame.readings.back())) frame.readings.pop_back();
    }
  }
  return frame;
}

/// False where the sensor gives no reading.
bool Simulator::read(std::size_t sensor, const Motion& motion, Reading& reading) const {
  const auto sequence = static_cast<std::uint32_t>(reading.sequence);
  const Pose T_world_body = reading.T_world_body = motion.pose_at(reading.t_ns);
  if (const auto* bump = std::get_if<sense::BumpSensor>(&sensors_[sensor])) {
    const std::int64_t last_ns = reading.sequence == 0 ? -1 : clocks_[sensor].time_of(reading.sequence - 1);
    const std::vector<sense::BumpContact> contacts = motion.contacts_in(last_ns, reading.t_ns);
    reading.bump = bump->read(contacts, sequence);
    reading.bump_truth = bump->truth(contacts);
    return true;
  }
  if (const auto* encoders = std::get_if<sense::EncoderSensor>(&sensors_[sensor])) {
    const std::vector<double> travel_m = motion.wheel_travel_at(reading.t_ns);
    reading.encoders = encoders->read(travel_m);
    reading.encoder_truth = encoders->truth(travel_m);
    return true;
  }
  if (const auto* planes = std::get_if<sense::PlaneSensor>(&sensors_[sensor])) {
    if (driven_world_ && !planes->sees_from(T_world_body)) return false;
    planes->observe(T_world_body, sequence, reading.planes);
  } else if (const auto* faces = std::get_if<sense::FaceSensor>(&sensors_[sensor])) {
    faces->observe(T_world_body, sequence, reading.planes);
  } else {
    std::vector<sense::LandmarkPlace> moved;
    landmarks_.moving.places_at(static_cast<double>(reading.t_ns) / 1e9, moved);
    std::get<sense::PointSensor>(sensors_[sensor])
        .observe(T_world_body, sequence, moved, threads_, reading.observations);
  }
  return true;
}

}  // namespace hallway::sim
