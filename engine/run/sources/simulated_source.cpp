// SPDX-License-Identifier: MIT
#include "run/sources/simulated_source.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <variant>

#include "base/error.hpp"
#include "base/text.hpp"
#include "geom/arrays.hpp"
#include "host/samples/bump_kind.hpp"
#include "host/samples/encoder_kind.hpp"
#include "host/samples/gnss_kind.hpp"
#include "host/samples/imu_kind.hpp"
#include "host/samples/magnetic_kind.hpp"
#include "host/samples/odometry_kind.hpp"
#include "host/samples/plane_kind.hpp"
#include "host/samples/point_kind.hpp"
#include "host/samples/range_scan_kind.hpp"
#include "record/plane_observations.hpp"
#include "run/scoring/floor_plan.hpp"
#include "run/sources/abi_pose.hpp"
#include "sim/describe.hpp"
#include "sim/scene_surfaces.hpp"

namespace hallway::run {

namespace {

/// The names of what a drive changed in a command, as drive.csv has them.
std::string changes_of(const drive::Clamps& clamps) {
  const std::array changed{clamps.speed,    clamps.lateral,  clamps.angular, clamps.steering,
                           clamps.left_out, clamps.dead_band};  // in the order of kCommandChanges
  std::string names;
  for (std::size_t i = 0; i < changed.size(); ++i) {
    if (!changed.at(i)) continue;
    if (!names.empty()) names += '+';
    names += log::kCommandChanges.at(i);
  }
  return names;
}

const char* kind_of(contact::TouchKind kind) {
  static constexpr std::array kNames{"wall", "ledge", "step", "slope"};  // in the order of TouchKind
  return kNames.at(static_cast<std::size_t>(kind));
}

/// Four corners for a face: its own, the last one twice where it has three, or those of a rectangle around it.
std::array<std::array<double, 3>, 4> corners_of(const Polygon& face) {
  std::vector<Vec3> own = face.vertices;
  const auto height = [&](std::size_t i) { return own[i].z() + own[(i + 1) % own.size()].z(); };
  std::size_t lowest = 0;  // edge, with which walls begin
  for (std::size_t i = 1; i < own.size(); ++i) lowest = height(i) < height(lowest) ? i : lowest;
  std::rotate(own.begin(), own.begin() + static_cast<std::ptrdiff_t>(lowest), own.end());
  if (own.size() <= 4) return {to_array(own[0]), to_array(own[1]), to_array(own[2]), to_array(own.back())};
  const PlaneAxes axes(face.plane.normal);
  Vec2 low = axes.flat(own[0]), high = low;
  for (const Vec3& p : own) {
    low = low.cwiseMin(axes.flat(p));
    high = high.cwiseMax(axes.flat(p));
  }
  const auto corner = [&](double x, double y) { return to_array(axes.lift({x, y}, face.plane.offset)); };
  return {corner(low.x(), low.y()), corner(high.x(), low.y()), corner(high.x(), high.y()),
          corner(low.x(), high.y())};
}

log::PlaneObservation observation_of(const PlaneObservation& seen, std::uint64_t id) {
  log::PlaneObservation observation{.id = id,
                                    .normal = to_array(seen.plane.normal),
                                    .offset_m = seen.plane.offset,
                                    .centroid_m = to_array(seen.centroid),
                                    .exclusive_share = 1.0};
  for (std::size_t i = 0; i < seen.corners.size(); ++i) observation.corners_m[i] = to_array(seen.corners[i]);
  for (const Vec3& p : seen.hull) observation.hull_m.push_back(to_array(p));
  return observation;
}

std::vector<log::TruePlane> true_planes_of(const sense::WallPlan& plan) {
  std::vector<log::TruePlane> planes;
  for (const sense::Wall& wall : plan.walls) {
    const Vec2 &l = wall.left, &r = wall.right;
    planes.push_back({.corners_m = {{{l.x(), l.y(), wall.low_m},
                                     {r.x(), r.y(), wall.low_m},
                                     {r.x(), r.y(), wall.high_m},
                                     {l.x(), l.y(), wall.high_m}}}});
  }
  return planes;
}

std::vector<log::TruePlane> true_planes_of(const sense::FacePlan& plan) {
  std::vector<log::TruePlane> planes;
  for (const Polygon& face : plan.faces) {
    log::TruePlane& plane = planes.emplace_back();
    plane.corners_m = corners_of(face);
    if (face.vertices.size() <= plane.corners_m.size()) continue;
    for (const Vec3& corner : face.vertices) plane.hull_m.push_back(to_array(corner));
  }
  return planes;
}

/// Whether two lists are of the same planes, by where these are.
bool are_the_same(std::span<const log::TruePlane> a, std::span<const log::TruePlane> b) {
  return std::ranges::equal(a, b, [](const log::TruePlane& p, const log::TruePlane& q) {
    return p.corners_m == q.corners_m && p.hull_m == q.hull_m;
  });
}

/// Values of a reading's truth by their names in the log.
using TruthValues = std::map<std::string, std::vector<double>>;

void add_values(const sense::BumpTruth& bump, TruthValues& values) {
  values.emplace("pressed", std::vector<double>(bump.pressed.begin(), bump.pressed.end()));
  std::vector<double> counts, places;
  for (const auto& points : bump.points) {
    counts.push_back(static_cast<double>(points.size()));
    for (const Vec3& point : points) places.insert(places.end(), {point.x(), point.y(), point.z()});
  }
  values.emplace("points", std::move(counts));
  values.emplace("points_m", std::move(places));
}

void add_values(const sense::EncoderTruth& encoders, TruthValues& values) {
  values.emplace("travel_m", encoders.travel_m);
  values.emplace("m_per_tick", encoders.m_per_tick);
}

/// -1 where nothing is in range.
std::vector<double> finite_or_none(const std::vector<double>& ranges) {
  std::vector<double> values;
  for (const double range_m : ranges) values.push_back(std::isfinite(range_m) ? range_m : -1.0);
  return values;
}

/// Of each beam, where the scenario wants that.
void add_values(const sense::LidarTruth& lidar, TruthValues& values) {
  values.emplace("range_m", finite_or_none(lidar.range_m));
}

/// Of each ping the nearest echo: its range, -1 where there is none, and where it came from, sensor frame.
void add_values(const sense::SonarTruth& sonar, TruthValues& values) {
  values.emplace("range_m", finite_or_none(sonar.range_m));
  std::vector<double> directions;
  for (const Vec3& direction : sonar.direction)
    directions.insert(directions.end(), {direction.x(), direction.y(), direction.z()});
  values.emplace("direction", std::move(directions));
}

void add_values(const sense::InfraredTruth& infrared, TruthValues& values) {
  values.emplace("range_m", finite_or_none(infrared.range_m));
}

void add_values(const sense::GnssTruth& gnss, TruthValues& values) {
  values.emplace("position_m", std::vector(gnss.position.begin(), gnss.position.end()));
  values.emplace("correlated_m", std::vector(gnss.correlated.begin(), gnss.correlated.end()));
}

/// What is not known is left out.
void add_values(const sense::CompassTruth& compass, TruthValues& values) {
  if (!std::isnan(compass.heading_rad)) values.emplace("heading_rad", std::vector{compass.heading_rad});
  if (!std::isnan(compass.deviation_rad)) values.emplace("deviation_rad", std::vector{compass.deviation_rad});
  values.emplace("bias_rad", std::vector{compass.bias_rad});
}

void add_values(const sense::ImuTruth& imu, TruthValues& values) {
  const auto add = [&](const char* name, const Vec3& numbers) {
    std::vector<double> finite;
    for (const double number : numbers) finite.push_back(std::isfinite(number) ? number : 0.0);
    values.emplace(name, std::move(finite));
  };
  add("angular_rad_s", imu.means.angular_rad_s);
  add("force_m_s2", imu.means.force_m_s2);
  add("angular_bias_rad_s", imu.angular_bias);
  add("force_bias_m_s2", imu.force_bias);
}

/// That of odometry is the robot's pose.
void add_values(const std::monostate&, TruthValues&) {}

void fill_odometry(const sense::OdometryReading& reading, hw_odometry_t& into) {
  into.T_odom_sensor = abi_pose_of(reading.T_odom_sensor);
  std::ranges::copy(reading.linear_m_s, into.linear_m_s);
  std::ranges::copy(reading.angular_rad_s, into.angular_rad_s);
  std::ranges::copy(reading.covariance, into.covariance);
}

/// What is true of a reading and not of the whole frame.
/// @param sensor  that it is of
/// @param labels  of a lidar's returns, or none
void add_truth(const sim::Reading& reading, const sim::SensorSpec& sensor, const sim::Frame& step,
               std::vector<double> labels, SourceFrame& frame) {
  log::SampleTruth truth{.sample = static_cast<std::uint32_t>(&reading - step.readings.data())};
  if (reading.t_ns != step.t_ns) {
    truth.position_m = to_array(reading.T_world_body.t);
    truth.orientation = to_array(reading.T_world_body.q);
  }
  const auto* lidar = std::get_if<sense::LidarSpec>(&sensor);
  const bool has_values = lidar == nullptr || lidar->true_ranges;
  std::visit(
      [&](const auto& sensed) {
        if constexpr (requires { sensed.truth; })
          if (has_values) add_values(sensed.truth, truth.values);
      },
      reading.sensed);
  if (!labels.empty()) truth.values.emplace("label", std::move(labels));
  if (reading.stamp_ns != reading.t_ns || reading.stamp_begin_ns != reading.t_begin_ns)
    truth.values.emplace("t_s", std::vector{static_cast<double>(reading.t_begin_ns) * 1e-9,
                                            static_cast<double>(reading.t_ns) * 1e-9});
  if (truth.position_m || !truth.values.empty()) frame.sample_truths.push_back(std::move(truth));
}

}  // namespace

SimulatedSource::SimulatedSource(const sim::Simulator& simulator) : simulator_(simulator) {
  facts_.has_identities = true;
  const sim::Scenario& scenario = simulator.scenario();
  const Where where{.file = printable(scenario.file)};
  if (scenario.sensors.empty()) {
    throw Error(
        ErrorCode::kBadInput,
        "a run takes a sensor, a [sensor.NAME] of the scenario or, where it has none, an hw_sensor of its "
        "map; there is none",
        where);
  }
  for (const sim::SensorSpec& sensor : scenario.sensors)
    std::visit([this](const auto& spec) { add_sensor(spec); }, sensor);
  for (const sim::EventSpec& event : scenario.events)
    facts_.events.push_back({event.t_ns, std::string(event_kind_name(event.kind)), text_of(event)});
  if (simulator.driven_world() != nullptr) {
    robot_.emplace(*simulator.driven_world(), scenario, simulator.path());
    facts_.drive = sim::describe(scenario.robot.driven->drive);
    facts_.body = sim::describe_body(*simulator.driven_world());
  }
}

void SimulatedSource::move_to(std::uint32_t iteration) {
  if (iteration < robot_->frame())
    throw Error(ErrorCode::kInternal, "a frame of a closed loop was asked for again");
  while (robot_->frame() < iteration) {
    const contact::Advance& advance = robot_->advance();
    std::vector<log::ContactRow> rows;
    for (const contact::Touch& touch : advance.begun)
      rows.push_back(
          {touch.t_ns, kind_of(touch.kind), to_array(touch.point), to_array(touch.normal), touch.speed_m_s});
    for (const contact::FallEvent& fall : advance.falls)
      rows.push_back({fall.t_ns, "fall", to_array(robot_->pose_at(fall.t_ns).t), {0.0, 0.0, 1.0}, 0.0});
    std::ranges::stable_sort(rows, {}, &log::ContactRow::t_ns);
    for (log::ContactRow& row : rows) notes_.contacts.push_back(std::move(row));
  }
}

void SimulatedSource::obey(const sim::DriveAnswer& answer) {
  if (!robot_) return;
  const sim::CommandInForce now = robot_->obey(answer);
  const drive::Command& command = now.obeyed.command;
  notes_.commands.push_back({.iteration = robot_->frame(),
                             .linear_m_s = command.forward_m_s,
                             .angular_rad_s = command.angular_rad_s,
                             .lateral_m_s = command.lateral_m_s,
                             .acts_from_ns = now.obeyed.acts_from_ns,
                             .cause = now.cause,
                             .changes = changes_of(now.obeyed.clamps)});
}

std::optional<sim::DriveCounts> SimulatedSource::drive_counts() const {
  if (!robot_) return std::nullopt;
  return robot_->counts();
}

void SimulatedSource::add_sensor(const sense::PointSensorSpec& spec) {
  facts_.sensors.push_back(sense::describe(spec, static_cast<std::uint32_t>(facts_.sensors.size())));
  first_true_plane_.emplace_back();
  if (facts_.true_landmarks) return;
  facts_.true_landmarks.emplace();
  for (const Vec3& place : simulator_.landmarks()) {
    const auto id = static_cast<std::uint32_t>(facts_.true_landmarks->size());
    facts_.true_landmarks->push_back(
        {.id = id, .position_m = to_array(place), .moving = simulator_.moving_landmarks().moves(id)});
  }
}

void SimulatedSource::add_sensor(const sense::PlaneSensorSpec& spec) {
  const std::size_t index = facts_.sensors.size();
  facts_.sensors.push_back(sense::describe(spec, static_cast<std::uint32_t>(index)));
  const sense::WallPlan* walls = simulator_.walls(index);
  first_true_plane_.emplace_back(
      add_true_planes(walls != nullptr ? true_planes_of(*walls) : true_planes_of(*simulator_.faces(index))));
}

void SimulatedSource::add_sensor(const sim::EncoderSpec& spec) {
  host::SensorInfo& info =
      facts_.sensors.emplace_back(sense::describe(spec, static_cast<std::uint32_t>(facts_.sensors.size())));
  if (const sim::DrivenWorld* world = simulator_.driven_world()) {
    info.intrinsics = host::EncoderIntrinsics{
        sim::describe_wheels(simulator_.scenario().robot.driven->drive, *world, spec.nominal_m_per_tick())};
  } else {
    host::EncoderIntrinsics wheels;
    for (const sense::OdometryWheel& wheel : sense::two_odometry_wheels(spec.wheel_base_m))
      wheels.wheels.push_back({.m_per_tick = spec.nominal_m_per_tick(),
                               .position = {wheel.position_m.x(), wheel.position_m.y(), 0.0}});
    info.intrinsics = std::move(wheels);
  }
  first_true_plane_.emplace_back();
}

void SimulatedSource::add_sensor(const sense::LidarSpec& spec) {
  const std::int64_t scan_ns = sense::interval_ns(spec.timing, simulator_.scenario().period_ns);
  facts_.sensors.push_back(sense::describe(spec, static_cast<std::uint32_t>(facts_.sensors.size()),
                                           static_cast<double>(scan_ns) * 1e-9));
  first_true_plane_.emplace_back();
  if (spec.labels && facts_.labels.empty()) add_labels();
}

void SimulatedSource::add_sensor(const sense::GnssSpec& spec) {
  host::SensorInfo& info =
      facts_.sensors.emplace_back(sense::describe(spec, static_cast<std::uint32_t>(facts_.sensors.size())));
  if (const std::optional<GeoPoint>& origin = simulator_.earth().origin)
    info.intrinsics = host::GnssIntrinsics{origin->latitude_deg, origin->longitude_deg, origin->altitude_m};
  first_true_plane_.emplace_back();
}

/// Those of the scene, and behind them the robot's.
void SimulatedSource::add_labels() {
  sim::SceneLabels scene = sim::label_scene(simulator_.compiled(), simulator_.models());
  for (const sim::SurfaceLabel& label : scene.labels)
    facts_.labels.push_back({.id = facts_.labels.size(), .thing = label.thing, .material = label.material});
  facts_.labels.push_back({.id = facts_.labels.size(), .thing = "robot", .mover = "robot"});
  label_of_triangle_ = std::move(scene.of_triangle);
}

/// By element of a scan: what its return is of, -1 where there is none.
std::vector<double> SimulatedSource::labels_of(const sense::LidarTruth& truth) const {
  std::vector<double> labels;
  labels.reserve(truth.returned.size());
  for (const std::uint32_t what : truth.returned) {
    if (what == sense::LidarTruth::kNothing) {
      labels.push_back(-1.0);
    } else {
      const bool is_own = what == sense::LidarTruth::kOwnBody;
      labels.push_back(is_own ? static_cast<double>(facts_.labels.size() - 1) : label_of_triangle_[what]);
    }
  }
  return labels;
}

void SimulatedSource::add_walls() {
  if (facts_.true_planes) return;
  const Pose start = robot_ ? robot_->pose_at(0) : simulator_.pose_at(0);
  const double height_m = (start * pose_of(facts_.sensors.front().T_body_sensor)).t.z();
  add_true_planes(true_planes_of(simulator_.walls_at(height_m)));
}

std::optional<eval::FloorPlan> SimulatedSource::floor_plan() const {
  const Pose start = robot_ ? robot_->pose_at(0) : simulator_.pose_at(0);
  const Vec3 sensor = start * Vec3(0, 0, plan_height_above_body(simulator_.scenario()));
  return floor_plan_at(simulator_, sensor.z());
}

/// Adds what a sensor can see; sensors that see the same planes share them.
/// @return the number of the first one
std::uint64_t SimulatedSource::add_true_planes(std::vector<log::TruePlane> planes) {
  if (!facts_.true_planes) facts_.true_planes.emplace();
  std::vector<log::TruePlane>& all = *facts_.true_planes;
  for (const auto& first : first_true_plane_) {
    if (!first) continue;
    const auto known = std::span(all).subspan(*first);
    if (known.size() >= planes.size() && are_the_same(known.first(planes.size()), planes)) return *first;
  }
  const std::uint64_t first = all.size();
  for (log::TruePlane& plane : planes) {
    plane.id = all.size();
    all.push_back(std::move(plane));
  }
  return first;
}

void SimulatedSource::add_reading(const sense::PointSensorSpec&, const sim::Reading& reading,
                                  SourceFrame& frame, host::FrameBuilder& builder) const {
  std::vector<hw_point3_t>& points = host::add_points(builder, facts_.sensors[reading.sensor].id);
  for (const sense::PointObservation& seen : reading.observations()) {
    points.push_back({seen.point.x(), seen.point.y(), seen.point.z()});
    frame.identities.push_back(seen.landmark == sense::PointObservation::kFalse ? log::kNoLandmark
                                                                                : seen.landmark);
  }
}

void SimulatedSource::add_reading(const sense::PlaneSensorSpec&, const sim::Reading& reading,
                                  SourceFrame& frame, host::FrameBuilder& builder) const {
  const host::PlaneReading planes = host::add_planes(builder, facts_.sensors[reading.sensor].id);
  for (const PlaneObservation& seen : reading.planes()) {
    record::add_plane(planes, observation_of(seen, planes.planes.size()));
    const bool is_false = seen.true_plane == PlaneObservation::kNoPlane;
    frame.identities.push_back(is_false ? log::kNoLandmark
                                        : first_true_plane_[reading.sensor].value() + seen.true_plane);
  }
}

void SimulatedSource::add_reading(const sense::BumpSensorSpec& spec, const sim::Reading& reading,
                                  SourceFrame& frame, host::FrameBuilder& builder) const {
  std::vector<hw_bump_zone_t>& zones = host::add_bump(builder, facts_.sensors[reading.sensor].id);
  for (const sense::ZoneReading& zone : std::get<sim::BumpSensed>(reading.sensed).reading.zones) {
    const bool has_depth = zone.pressed && spec.depth;
    zones.push_back({.direction = {zone.direction.x(), zone.direction.y(), zone.direction.z()},
                     .depth_m = has_depth ? zone.depth_m : std::numeric_limits<double>::quiet_NaN(),
                     .zone = static_cast<std::uint32_t>(zones.size()),
                     .pressed = zone.pressed ? 1u : 0u});
    frame.identities.push_back(log::kNoLandmark);
  }
}

void SimulatedSource::add_reading(const sim::EncoderSpec&, const sim::Reading& reading, SourceFrame& frame,
                                  host::FrameBuilder& builder) const {
  std::vector<hw_wheel_ticks_t>& wheels = host::add_encoder(builder, facts_.sensors[reading.sensor].id);
  for (const std::int64_t ticks : std::get<sim::EncoderSensed>(reading.sensed).reading.ticks) {
    wheels.push_back({ticks});
    frame.identities.push_back(log::kNoLandmark);
  }
}

void SimulatedSource::add_reading(const sense::LidarSpec& spec, const sim::Reading& reading,
                                  SourceFrame& frame, host::FrameBuilder& builder) const {
  const auto& scan = std::get<sim::LidarSensed>(reading.sensed).reading;
  const sense::RayPattern& pattern = spec.pattern;
  const host::RangeScanReading into =
      host::add_range_scan(builder, facts_.sensors[reading.sensor].id,
                           {.width = pattern.width, .height = pattern.height, .layers = spec.returns});
  const std::vector<std::int64_t>& offsets_ns = simulator_.offsets_ns(reading.sensor);
  for (std::size_t layer = 0, k = 0; layer < spec.returns; ++layer) {
    for (std::size_t i = 0; i < pattern.rays.size(); ++i, ++k) {
      const sense::PatternRay& ray = pattern.rays[i];
      into.rays.push_back({ray.azimuth_rad, ray.elevation_rad, scan.range_m[k]});
      into.data.t_offset_ns.push_back(offsets_ns[i]);
      into.data.intensity.push_back(scan.intensity[k]);
      into.data.ring.push_back(ray.ring);
    }
  }
  frame.identities.insert(frame.identities.end(), scan.range_m.size(), log::kNoLandmark);
}

namespace {

/// A scan of what has no intensities: rays of a pattern, `layers` ranges each.
void add_ranges(const host::RangeScanReading& into, const sense::RayPattern& pattern,
                const std::vector<std::int64_t>& offsets_ns, const std::vector<double>& range_m) {
  for (std::size_t k = 0; k < range_m.size(); ++k) {
    const std::size_t i = k % pattern.rays.size();
    into.rays.push_back({pattern.rays[i].azimuth_rad, pattern.rays[i].elevation_rad, range_m[k]});
    into.data.t_offset_ns.push_back(offsets_ns[i]);
  }
}

}  // namespace

void SimulatedSource::add_reading(const sense::SonarSpec& spec, const sim::Reading& reading,
                                  SourceFrame& frame, host::FrameBuilder& builder) const {
  const auto& sweep = std::get<sim::SonarSensed>(reading.sensed).reading;
  add_ranges(
      host::add_range_scan(builder, facts_.sensors[reading.sensor].id,
                           {.width = spec.pings.width, .height = spec.pings.height, .layers = spec.echoes}),
      spec.pings, simulator_.offsets_ns(reading.sensor), sweep.range_m);
  frame.identities.insert(frame.identities.end(), sweep.range_m.size(), log::kNoLandmark);
}

void SimulatedSource::add_reading(const sense::InfraredSpec& spec, const sim::Reading& reading,
                                  SourceFrame& frame, host::FrameBuilder& builder) const {
  const auto& seen = std::get<sim::InfraredSensed>(reading.sensed).reading;
  add_ranges(host::add_range_scan(builder, facts_.sensors[reading.sensor].id,
                                  {.width = spec.rays.width, .height = spec.rays.height, .layers = 1}),
             spec.rays, simulator_.offsets_ns(reading.sensor), seen.range_m);
  frame.identities.insert(frame.identities.end(), seen.range_m.size(), log::kNoLandmark);
}

void SimulatedSource::add_reading(const sense::GnssSpec&, const sim::Reading& reading, SourceFrame&,
                                  host::FrameBuilder& builder) const {
  const sense::GnssReading& fix = std::get<sim::GnssSensed>(reading.sensed).reading;
  hw_gnss_t& into = host::add_gnss(builder, facts_.sensors[reading.sensor].id);
  into.fix = fix.fix == sense::GnssFix::kNone ? HW_GNSS_NO_FIX : HW_GNSS_POSITION;
  std::ranges::copy(fix.position, into.position_m);
  std::ranges::copy(fix.covariance, into.covariance);
}

void SimulatedSource::add_reading(const sense::CompassSpec&, const sim::Reading& reading, SourceFrame&,
                                  host::FrameBuilder& builder) const {
  const sense::CompassReading& compass = std::get<sim::CompassSensed>(reading.sensed).reading;
  hw_magnetic_t& into = host::add_magnetic(builder, facts_.sensors[reading.sensor].id);
  into.heading_rad = compass.heading_rad;
  into.variance_rad2 = compass.variance_rad2;
}

void SimulatedSource::add_reading(const sense::ImuSensorSpec&, const sim::Reading& reading, SourceFrame&,
                                  host::FrameBuilder& builder) const {
  const sense::ImuReading& imu = std::get<sim::ImuSensed>(reading.sensed).reading;
  hw_imu_t& into = host::add_imu(builder, facts_.sensors[reading.sensor].id);
  std::ranges::copy(imu.angular_rad_s, into.angular_rad_s);
  std::ranges::copy(imu.force_m_s2, into.force_m_s2);
  std::ranges::copy(imu.angular_covariance, into.angular_covariance);
  std::ranges::copy(imu.force_covariance, into.force_covariance);
}

void SimulatedSource::add_reading(const sense::WheelOdometrySpec&, const sim::Reading& reading, SourceFrame&,
                                  host::FrameBuilder& builder) const {
  fill_odometry(std::get<sim::OdometrySensed>(reading.sensed).reading,
                host::add_odometry(builder, facts_.sensors[reading.sensor].id));
}

void SimulatedSource::add_reading(const sense::MouseOdometrySpec&, const sim::Reading& reading, SourceFrame&,
                                  host::FrameBuilder& builder) const {
  fill_odometry(std::get<sim::OdometrySensed>(reading.sensed).reading,
                host::add_odometry(builder, facts_.sensors[reading.sensor].id));
}

void SimulatedSource::fill(std::uint32_t iteration, SourceFrame& frame) {
  if (robot_) move_to(iteration);
  const sim::Frame step = robot_ ? simulator_.step(iteration, *robot_) : simulator_.step(iteration);
  host::FrameBuilder& builder = frame.begin(iteration, step.t_ns);
  frame.T_world_body = step.T_world_body;
  for (const sim::Reading& reading : step.readings) {
    std::visit([&](const auto& spec) { add_reading(spec, reading, frame, builder); },
               simulator_.scenario().sensors[reading.sensor]);
    builder.set_reading(reading.sequence, reading.stamp_begin_ns, reading.stamp_ns);
    const auto* lidar = std::get_if<sim::LidarSensed>(&reading.sensed);
    add_truth(reading, simulator_.scenario().sensors[reading.sensor], step,
              lidar != nullptr ? labels_of(lidar->truth) : std::vector<double>{}, frame);
  }
}

}  // namespace hallway::run
