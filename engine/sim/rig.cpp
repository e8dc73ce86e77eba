// SPDX-License-Identifier: MIT
#include "sim/rig.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <type_traits>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
#include "drive/wheels.hpp"
#include "sense/motion_integral.hpp"
#include "sim/robot_body.hpp"

namespace hallway::sim {
namespace {

std::string element_of(const std::string& sensor) {
  return "sensor `" + printable(sensor) + "`";
}

/// A frame is as large as what arrives in it.
void check_rate(const std::string& name, const sense::SensorTiming& timing, const Scenario& scenario) {
  constexpr double kMostInAFrame = 10'000.0;
  const double in_a_frame = timing.rate_hz * scenario.period_s();
  if (in_a_frame <= kMostInAFrame) return;
  throw Error(ErrorCode::kBadInput,
              "a frame would hold " + format_double(std::round(in_a_frame)) + " readings, more than " +
                  format_double(kMostInAFrame),
              Where{printable(scenario.file), 0, element_of(name)});
}

/// A scan takes the time from one to the next, an IMU measures from one reading to the next; other readings take none.
template <typename Spec>
sense::ReadingSpan span_of(const Spec& spec, std::int64_t period_ns) {
  if constexpr (std::is_same_v<Spec, sense::LidarSpec>)
    return {.duration_ns = sense::interval_ns(spec.timing, period_ns)};
  if constexpr (std::is_same_v<Spec, sense::SonarSpec>) return {.duration_ns = spec.sweep_ns};
  if constexpr (std::is_same_v<Spec, sense::ImuSensorSpec>) return {.to_next = true};
  return {};
}

/// The way of each rim of a body that rolls without slip.
class RimWays final : public sense::MotionIntegrand {
 public:
  explicit RimWays(const std::vector<sense::OdometryWheel>& wheels) : wheels_(wheels) {}

  sense::MotionSum rate(const sense::Kinematics& motion) const override {
    const Vec3 velocity = motion.T_world_body.q.conjugate() * motion.velocity;
    const double turn = motion.angular_velocity.z();
    sense::MotionSum sum = sense::MotionSum::Zero();
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
      const Vec2& at = wheels_[i].position_m;
      sum[static_cast<Eigen::Index>(i)] =
          wheels_[i].rolling.dot(Vec2(velocity.x() - turn * at.y(), velocity.y() + turn * at.x()));
    }
    return sum;
  }
  sense::MotionSum jump(const sense::Kinematics&, const sense::Kinematics&) const override {
    return sense::MotionSum::Zero();
  }

 private:
  const std::vector<sense::OdometryWheel>& wheels_;
};

/// Those of the drive; of a robot that a path moves two on its y axis.
std::vector<sense::OdometryWheel> wheels_of(const RobotSpec& robot, double wheel_base_m) {
  if (!robot.driven) return sense::two_odometry_wheels(wheel_base_m);
  const drive::DriveSpec& drive = robot.driven->drive;
  if (drive.kind == drive::DriveKind::kOmnidirectional)
    return sense::mecanum_odometry_wheels(drive.wheel_base_m, drive.axle_distance_m);
  return sense::two_odometry_wheels(drive.wheel_base_m);
}

}  // namespace

/// Makes sensors of their specifications.
class Rig::Builder {
 public:
  Builder(const Scenario& scenario, Rig& rig) : scenario_(scenario), rig_(rig) {}

  void add(const SensorSpec& spec) {
    std::visit(
        [this](const auto& sensor) {
          check_rate(sensor.name, sensor.timing, scenario_);
          const sense::ReadingClock clock(sensor.timing, scenario_.period_ns,
                                          span_of(sensor, scenario_.period_ns));
          Mounted mounted{.name = sensor.name,
                          .device = device(sensor),
                          .clock = clock,
                          .stamps = sense::SensorClock(sensor.name, sensor.timing.clock,
                                                       sense::interval_ns(sensor.timing, scenario_.period_ns),
                                                       scenario_.seed),
                          .walls = std::move(walls_),
                          .faces = std::move(faces_)};
          rig_.sensors_.push_back(std::move(mounted));
        },
        spec);
  }

 private:
  void demand_drive(const std::string& name) const {
    if (scenario_.robot.driven) return;
    throw Error(ErrorCode::kBadInput, "needs a [robot.drive], whose body it senses",
                Where{printable(scenario_.file), 0, element_of(name)});
  }
  std::int64_t interval(const sense::SensorTiming& timing) const {
    return sense::interval_ns(timing, scenario_.period_ns);
  }
  std::unique_ptr<WheelWays> ways_on_path(std::size_t n_wheels) const {
    return scenario_.robot.driven ? nullptr : std::make_unique<WheelWays>(std::vector<double>(n_wheels, 0.0));
  }

  Device device(const sense::PointSensorSpec& spec) {
    return Device(std::in_place_type<sense::PointSensor>, in_truth(spec), rig_.world_.landmarks,
                  rig_.world_.scene, scenario_.seed);
  }
  Device device(const sense::PlaneSensorSpec& spec) {
    const sense::PlaneSensorSpec true_spec = in_truth(spec);
    if (spec.shape == sense::PlaneShape::faces) {
      faces_ = std::make_unique<const sense::FacePlan>(rig_.world_.faces());
      return Device(std::in_place_type<sense::FaceSensor>, true_spec, *faces_, scenario_.seed);
    }
    const double height_m = (rig_.world_.T_world_start * true_spec.T_body_sensor).t.z();
    walls_ = std::make_unique<const sense::WallPlan>(rig_.world_.walls(height_m));
    return Device(std::in_place_type<sense::PlaneSensor>, true_spec, *walls_, scenario_.seed);
  }
  Device device(const sense::BumpSensorSpec& spec) {
    demand_drive(spec.name);
    return Device(std::in_place_type<sense::BumpSensor>, spec, scenario_.seed);
  }
  Device device(const EncoderSpec& spec) {
    std::vector<sense::OdometryWheel> wheels = wheels_of(scenario_.robot, spec.wheel_base_m);
    const std::size_t n = wheels.size();
    return Device(
        Encoders{sense::EncoderSensor(spec, n, scenario_.seed), std::move(wheels), ways_on_path(n)});
  }
  Device device(const sense::LidarSpec& spec) {
    return Device(std::in_place_type<sense::LidarSensor>, in_truth(spec), rig_.world_.scene, surfaces(),
                  interval(spec.timing), scenario_.seed, own_body_of(scenario_.robot));
  }
  Device device(const sense::SonarSpec& spec) {
    if (spec.sweep_ns > interval(spec.timing))
      throw Error(ErrorCode::kBadInput,
                  "a sweep of " + format_double(static_cast<double>(spec.sweep_ns) * 1e-9) +
                      " s does not end before the next begins; rate_hz is too high, or 0, which is a sweep "
                      "for every frame",
                  Where{printable(scenario_.file), 0, element_of(spec.name)});
    return Device(std::in_place_type<sense::SonarSensor>, in_truth(spec), rig_.world_.scene, surfaces(),
                  scenario_.seed, own_body_of(scenario_.robot));
  }
  Device device(const sense::InfraredSpec& spec) {
    return Device(std::in_place_type<sense::InfraredSensor>, in_truth(spec), rig_.world_.scene, surfaces(),
                  scenario_.seed);
  }
  Device device(const sense::GnssSpec& spec) {
    sense::GnssSpec true_spec = in_truth(spec);
    true_spec.north_rad = rig_.world_.earth.north_rad;
    for (const map::GnssZoneEntity& zone : rig_.world_.earth.zones)
      true_spec.zones.push_back({zone.planes, zone.factor});
    return Device(std::in_place_type<sense::GnssSensor>, std::move(true_spec), scenario_.period_ns,
                  scenario_.seed);
  }
  Device device(const sense::CompassSpec& spec) {
    sense::CompassSpec true_spec = in_truth(spec);
    true_spec.north_rad = rig_.world_.earth.magnetic_north_rad;
    for (const map::MagnetEntity& magnet : rig_.world_.earth.magnets)
      true_spec.magnets.push_back({magnet.position, magnet.reach_m, magnet.strength});
    return Device(std::in_place_type<sense::CompassSensor>, std::move(true_spec), scenario_.seed);
  }
  Device device(const sense::ImuSensorSpec& spec) {
    return Device(std::in_place_type<sense::ImuSensor>, in_truth(spec),
                  static_cast<double>(interval(spec.timing)) * 1e-9, scenario_.seed);
  }
  Device device(const sense::WheelOdometrySpec& spec) {
    const std::size_t n = spec.wheels.size();
    WheelOdometer odometer{sense::WheelOdometry(spec, scenario_.seed), ways_on_path(n), nullptr};
    using State = WheelOdometer::State;
    odometer.track = std::make_unique<sense::OdometryTrack<State>>(
        State{.ticks = std::vector<std::int64_t>(n, 0), .step = {}, .T_odom_sensor = {}});
    return Device(std::move(odometer));
  }
  Device device(const sense::MouseOdometrySpec& spec) {
    Mice mice{sense::MouseOdometry(in_truth(spec), scenario_.seed), nullptr};
    mice.track = std::make_unique<sense::OdometryTrack<sense::MouseState>>(mice.sensor.start());
    return Device(std::move(mice));
  }

  /// Made for the first sensor that sends beams.
  const sense::Surfaces& surfaces() {
    if (!rig_.surfaces_) rig_.surfaces_ = std::make_unique<const sense::Surfaces>(rig_.world_.surfaces());
    return *rig_.surfaces_;
  }

  /// With the mount that it has in truth.
  template <typename Spec>
  Spec in_truth(Spec spec) const {
    const auto error = scenario_.mount_errors.find(spec.name);
    if (error != scenario_.mount_errors.end()) spec.T_body_sensor = spec.T_body_sensor * error->second;
    return spec;
  }

  const Scenario& scenario_;
  Rig& rig_;
  std::unique_ptr<const sense::WallPlan> walls_;  ///< of the sensor that is made
  std::unique_ptr<const sense::FacePlan> faces_;
};

Rig::Rig(const Scenario& scenario, SensedWorld world)
    : world_(std::move(world)), is_driven_(scenario.robot.driven.has_value()) {
  sensors_.reserve(scenario.sensors.size());
  Builder builder(scenario, *this);
  for (const SensorSpec& spec : scenario.sensors) builder.add(spec);
  for (const EventSpec& event : scenario.events) {
    if (event.kind != EventKind::kSensorOff && event.kind != EventKind::kSensorOn) continue;
    const auto sensor = std::ranges::find(sensors_, event.sensor, &Mounted::name);
    if (sensor == sensors_.end())
      throw Error(
          ErrorCode::kBadInput, "there is no sensor `" + printable(event.sensor) + "`",
          Where{printable(scenario.file), event.line, "a " + std::string(event_kind_name(event.kind))});
    const bool off = sensor->switches.size() % 2 == 1;
    if (off != (event.kind == EventKind::kSensorOff)) sensor->switches.push_back(event.t_ns);
  }
}

bool Rig::meets_own_body(std::size_t sensor) const {
  const auto* sonar = std::get_if<sense::SonarSensor>(&sensors_[sensor].device);
  return sonar != nullptr && sonar->meets_own_body();
}

const std::vector<std::int64_t>& Rig::offsets_ns(std::size_t sensor) const {
  const Device& device = sensors_[sensor].device;
  if (const auto* lidar = std::get_if<sense::LidarSensor>(&device)) return lidar->offsets_ns();
  if (const auto* sonar = std::get_if<sense::SonarSensor>(&device)) return sonar->offsets_ns();
  if (const auto* infrared = std::get_if<sense::InfraredSensor>(&device)) return infrared->offsets_ns();
  throw Error(ErrorCode::kInternal, "a sensor without rays has no times of them");
}

bool Rig::is_off(const Mounted& mounted, std::int64_t t_ns) const {
  const auto later = std::ranges::upper_bound(mounted.switches, t_ns);
  return (later - mounted.switches.begin()) % 2 == 1;
}

/// Whether a reading needs those before it.
bool Rig::sums_up(const Mounted& mounted) {
  return std::holds_alternative<WheelOdometer>(mounted.device) ||
         std::holds_alternative<Mice>(mounted.device);
}

void Rig::read(std::int64_t after_ns, std::int64_t until_ns, const Motion& motion,
               std::vector<Reading>& readings) const {
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    const Mounted& mounted = sensors_[i];
    const std::uint64_t first = after_ns < 0 ? 0 : mounted.clock.arrived_by(after_ns);
    const std::uint64_t end = mounted.clock.arrived_by(until_ns);
    for (std::uint64_t k = first; k < end; ++k) {
      const bool off = is_off(mounted, mounted.clock.time_of(k));
      if (off && !sums_up(mounted)) continue;
      Reading reading{.sensor = i, .sequence = k};
      if (!read_one(mounted, motion, reading) || off) continue;
      stamp(mounted, reading);
      readings.push_back(std::move(reading));
    }
  }
}

void Rig::check_ways(const Motion& motion, std::int64_t end_ns) const {
  for (const Mounted& mounted : sensors_) {
    const auto* planes = std::get_if<sense::PlaneSensor>(&mounted.device);
    const std::uint64_t n = planes != nullptr ? mounted.clock.arrived_by(end_ns) : 0;
    for (std::uint64_t k = 0; k < n; ++k)
      planes->check_pose(motion.pose_at(mounted.clock.time_of(k)), static_cast<std::uint32_t>(k));
  }
}

/// The ways of rims at the time of reading `k`.
std::vector<double> Rig::wheel_ways(const Mounted& mounted, const std::unique_ptr<WheelWays>& ways,
                                    const std::vector<sense::OdometryWheel>& wheels, const Motion& motion,
                                    std::uint64_t k) const {
  if (ways == nullptr) return motion.wheel_travel_at(mounted.clock.time_of(k));
  const RimWays integrand(wheels);
  return ways->at(k, [&](std::vector<double>& sum, std::uint64_t n) {
    const sense::MotionSum added = sense::integrate_motion(motion, mounted.clock.time_of(n - 1),
                                                           mounted.clock.time_of(n), integrand, mounted.name);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += added[static_cast<Eigen::Index>(i)];
  });
}

OdometrySensed Rig::read_wheels(const Mounted& mounted, const WheelOdometer& odometer, const Motion& motion,
                                std::uint64_t k) const {
  const sense::WheelOdometry& sensor = odometer.sensor;
  using State = WheelOdometer::State;
  const State state = odometer.track->at(k, [&](State& now, std::uint64_t n) {
    const auto ticks_at = [&](std::uint64_t reading) {
      return sensor.encoder()
          .read(wheel_ways(mounted, odometer.ways, sensor.spec().wheels, motion, reading))
          .ticks;
    };
    if (n == 1) now.ticks = ticks_at(0);
    std::vector<std::int64_t> ticks = ticks_at(n);
    now.step = sensor.step(now.ticks, ticks);
    now.T_odom_sensor = now.T_odom_sensor * sense::motion_of(now.step);
    now.ticks = std::move(ticks);
  });
  const std::int64_t before_ns = mounted.clock.time_of(k == 0 ? 0 : k - 1), t_ns = mounted.clock.time_of(k);
  return {sensor.reading(state.step, state.T_odom_sensor, static_cast<double>(t_ns - before_ns) * 1e-9), {}};
}

OdometrySensed Rig::read_mice(const Mounted& mounted, const Mice& mice, const Motion& motion,
                              std::uint64_t k) const {
  const sense::ReadingClock& clock = mounted.clock;
  const sense::MouseState state = mice.track->at(k, [&](sense::MouseState& now, std::uint64_t n) {
    mice.sensor.advance(now, motion, n, clock.time_of(n - 1), clock.time_of(n));
  });
  const double duration_s = static_cast<double>(clock.time_of(k) - clock.time_of(k == 0 ? 0 : k - 1)) * 1e-9;
  return {mice.sensor.reading(state, duration_s), {}};
}

/// False where the sensor gives no reading.
bool Rig::read_one(const Mounted& mounted, const Motion& motion, Reading& reading) const {
  const std::uint64_t k = reading.sequence;
  const auto sequence = static_cast<std::uint32_t>(k);
  reading.t_begin_ns = mounted.clock.time_of(k);
  reading.t_ns = mounted.clock.end_of(k);
  if (const auto* lidar = std::get_if<sense::LidarSensor>(&mounted.device)) {
    auto& [scan, truth] = reading.sensed.emplace<LidarSensed>();
    lidar->read(sequence, reading.t_begin_ns, motion, world_.threads, scan, truth);
    reading.t_begin_ns = scan.t_begin_ns;
    reading.t_ns = scan.t_end_ns;
  } else if (const auto* sonar = std::get_if<sense::SonarSensor>(&mounted.device)) {
    auto& [sweep, truth] = reading.sensed.emplace<SonarSensed>();
    sonar->read(sequence, reading.t_begin_ns, motion, world_.threads, sweep, truth);
    reading.t_ns = sweep.t_end_ns;
  } else if (const auto* infrared = std::get_if<sense::InfraredSensor>(&mounted.device)) {
    auto& [seen, truth] = reading.sensed.emplace<InfraredSensed>();
    infrared->read(sequence, reading.t_begin_ns, motion, seen, truth);
  } else if (const auto* gnss = std::get_if<sense::GnssSensor>(&mounted.device)) {
    auto& [fix, truth] = reading.sensed.emplace<GnssSensed>();
    gnss->read(sequence, reading.t_ns, motion, fix, truth);
  } else if (const auto* compass = std::get_if<sense::CompassSensor>(&mounted.device)) {
    auto& [heading, truth] = reading.sensed.emplace<CompassSensed>();
    compass->read(sequence, reading.t_ns, motion, heading, truth);
  } else if (const auto* imu = std::get_if<sense::ImuSensor>(&mounted.device)) {
    sense::ImuTruth truth = imu->truth(motion, k, reading.t_begin_ns, reading.t_ns);
    reading.sensed = ImuSensed{imu->read(truth, k, reading.t_ns - reading.t_begin_ns), truth};
  } else if (const auto* odometer = std::get_if<WheelOdometer>(&mounted.device)) {
    reading.sensed = read_wheels(mounted, *odometer, motion, k);
    reading.t_begin_ns = mounted.clock.time_of(k == 0 ? 0 : k - 1);
  } else if (const auto* mice = std::get_if<Mice>(&mounted.device)) {
    reading.sensed = read_mice(mounted, *mice, motion, k);
    reading.t_begin_ns = mounted.clock.time_of(k == 0 ? 0 : k - 1);
  }
  const Pose T_world_body = reading.T_world_body = motion.pose_at(reading.t_ns);
  if (const auto* bump = std::get_if<sense::BumpSensor>(&mounted.device)) {
    const std::vector<sense::BumpContact> contacts =
        motion.contacts_in(k == 0 ? -1 : mounted.clock.time_of(k - 1), reading.t_ns);
    reading.sensed = BumpSensed{bump->read(contacts, sequence), bump->truth(contacts)};
  } else if (const auto* encoders = std::get_if<Encoders>(&mounted.device)) {
    const std::vector<double> travel_m = wheel_ways(mounted, encoders->ways, encoders->wheels, motion, k);
    reading.sensed = EncoderSensed{encoders->sensor.read(travel_m), encoders->sensor.truth(travel_m)};
  } else if (const auto* planes = std::get_if<sense::PlaneSensor>(&mounted.device)) {
    if (is_driven_ && !planes->sees_from(T_world_body)) return false;
    planes->observe(T_world_body, sequence, reading.sensed.emplace<std::vector<PlaneObservation>>());
  } else if (const auto* faces = std::get_if<sense::FaceSensor>(&mounted.device)) {
    faces->observe(T_world_body, sequence, reading.sensed.emplace<std::vector<PlaneObservation>>());
  } else if (const auto* points = std::get_if<sense::PointSensor>(&mounted.device)) {
    std::vector<sense::LandmarkPlace> moved;
    world_.moving.places_at(static_cast<double>(reading.t_ns) / 1e9, moved);
    points->observe(T_world_body, sequence, moved, world_.threads,
                    reading.sensed.emplace<std::vector<sense::PointObservation>>());
  }
  return true;
}

void Rig::stamp(const Mounted& mounted, Reading& reading) const {
  reading.stamp_begin_ns = mounted.stamps.stamp(reading.sequence, reading.t_begin_ns);
  reading.stamp_ns = mounted.stamps.stamp(reading.sequence, reading.t_ns);
}

}  // namespace hallway::sim
