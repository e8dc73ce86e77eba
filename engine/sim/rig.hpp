// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "map/earth.hpp"
#include "sense/compass_sensor.hpp"
#include "sense/encoder_sensor.hpp"
#include "sense/face_plan.hpp"
#include "sense/face_sensor.hpp"
#include "sense/gnss_sensor.hpp"
#include "sense/imu_sensor.hpp"
#include "sense/infrared_sensor.hpp"
#include "sense/landmark_index.hpp"
#include "sense/lidar_sensor.hpp"
#include "sense/mouse_odometry.hpp"
#include "sense/moving_landmarks.hpp"
#include "sense/odometry_track.hpp"
#include "sense/plane_sensor.hpp"
#include "sense/point_sensor.hpp"
#include "sense/sensor_clock.hpp"
#include "sense/sonar_sensor.hpp"
#include "sense/surfaces.hpp"
#include "sense/timing.hpp"
#include "sense/wall_plan.hpp"
#include "sense/wheel_odometry.hpp"
#include "sim/motion.hpp"
#include "sim/reading.hpp"
#include "sim/scenario.hpp"
#include "trace/scene.hpp"

namespace hallway::sim {

/// What there is for sensors to see. All of it outlives the rig.
struct SensedWorld {
  const trace::Scene& scene;
  const sense::LandmarkIndex& landmarks;
  const sense::MovingLandmarks& moving;
  std::function<sense::WallPlan(double height_m)> walls;  ///< at a height above the world's origin
  std::function<sense::FacePlan()> faces;
  std::function<sense::Surfaces()> surfaces;  ///< of the scene's triangles
  const map::Earth& earth;                    ///< north, magnets, zones of satellites
  Pose T_world_start;                         ///< where the body is at time 0
  unsigned threads;                           ///< for one reading, at least 1
};

/// The sensors of a robot, with their mounts and clocks. What one of them reads depends on the scenario's seed, its own name and settings, and the robot's
/// motion; not on the others, nor on the order of calls.
class Rig {
 public:
  /// Throws Error{kBadInput} that names the sensor for one that the scenario's robot cannot have.
  Rig(const Scenario& scenario, SensedWorld world);

  std::size_t size() const { return sensors_.size(); }
  const sense::ReadingClock& clock(std::size_t sensor) const { return sensors_[sensor].clock; }

  /// Appends the readings of all sensors that arrive after one time and until another, by sensor, then by sequence. Of a sensor that is off at the time of a
  /// reading there is none. One that sums up motion follows it all the same.
  /// @param after_ns  below 0: all until the other
  void read(std::int64_t after_ns, std::int64_t until_ns, const Motion& motion,
            std::vector<Reading>& readings) const;

  /// Throws for a way on which a sensor of walls is not level; before the run, for it is long.
  /// @param end_ns  until when
  void check_ways(const Motion& motion, std::int64_t end_ns) const;

  /// The walls that a sensor of planes sees; the index is the wall's number. Null for a sensor of another kind.
  const sense::WallPlan* walls(std::size_t sensor) const { return sensors_[sensor].walls.get(); }
  /// The faces that a sensor of faces sees; the index is the face's number. Null for a sensor of another kind.
  const sense::FacePlan* faces(std::size_t sensor) const { return sensors_[sensor].faces.get(); }
  /// Whether the robot's own body is in a beam of a sonar; false for a sensor of another kind.
  bool meets_own_body(std::size_t sensor) const;
  /// When each ray of a lidar or ping of a sonar is measured, after a reading's begin. Throws Error{kInternal} for a sensor of another kind.
  const std::vector<std::int64_t>& offsets_ns(std::size_t sensor) const;

 private:
  /// The ways of rims on a path, which has no wheels: those that a sensor's own wheels would roll.
  using WheelWays = sense::OdometryTrack<std::vector<double>>;

  struct Encoders {
    sense::EncoderSensor sensor;
    std::vector<sense::OdometryWheel> wheels;
    std::unique_ptr<WheelWays> ways;  ///< null: the drive's count
  };
  struct WheelOdometer {
    sense::WheelOdometry sensor;
    std::unique_ptr<WheelWays> ways;  ///< null: the drive's count
    struct State {
      std::vector<std::int64_t> ticks;
      sense::PlanarStep step;
      Pose T_odom_sensor;
    };
    std::unique_ptr<sense::OdometryTrack<State>> track;
  };
  struct Mice {
    sense::MouseOdometry sensor;
    std::unique_ptr<sense::OdometryTrack<sense::MouseState>> track;
  };
  using Device = std::variant<sense::PointSensor, sense::PlaneSensor, sense::FaceSensor, sense::BumpSensor,
                              Encoders, sense::LidarSensor, sense::SonarSensor, sense::InfraredSensor,
                              sense::GnssSensor, sense::CompassSensor, sense::ImuSensor, WheelOdometer, Mice>;

  struct Mounted {
    std::string name;
    Device device;
    sense::ReadingClock clock;
    sense::SensorClock stamps;
    std::unique_ptr<const sense::WallPlan> walls{};
    std::unique_ptr<const sense::FacePlan> faces{};
    std::vector<std::int64_t> switches{};  ///< when it goes off, on, off, …
  };

  class Builder;

  static bool sums_up(const Mounted& mounted);
  bool is_off(const Mounted& mounted, std::int64_t t_ns) const;
  bool read_one(const Mounted& mounted, const Motion& motion, Reading& reading) const;
  void stamp(const Mounted& mounted, Reading& reading) const;
  std::vector<double> wheel_ways(const Mounted& mounted, const std::unique_ptr<WheelWays>& ways,
                                 const std::vector<sense::OdometryWheel>& wheels, const Motion& motion,
                                 std::uint64_t k) const;
  OdometrySensed read_wheels(const Mounted& mounted, const WheelOdometer& odometer, const Motion& motion,
                             std::uint64_t k) const;
  OdometrySensed read_mice(const Mounted& mounted, const Mice& mice, const Motion& motion,
                           std::uint64_t k) const;

  SensedWorld world_;
  bool is_driven_;
  std::unique_ptr<const sense::Surfaces> surfaces_;  ///< null where no sensor sends beams
  std::vector<Mounted> sensors_;
};

}  // namespace hallway::sim
