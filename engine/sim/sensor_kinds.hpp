// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "sim/scenario.hpp"
#include "sim/sensor_reader.hpp"

namespace hallway::sim {

// What the keys of a sensor of one kind say. Each throws Error for a value that is wrong, as TableReader does.

sense::LidarSpec read_lidar(const std::string& name, SensorReader& sensor);
sense::SonarSpec read_sonar(const std::string& name, SensorReader& sensor);
sense::InfraredSpec read_infrared(const std::string& name, SensorReader& sensor);
/// Of those of lidars, the keys that say which beams a scan has, where no table does.
std::span<const char* const> spin_keys();

/// North, zones and magnets are the map's.
sense::GnssSpec read_gnss(const std::string& name, SensorReader& sensor);
sense::CompassSpec read_compass(const std::string& name, SensorReader& sensor);

/// The wheels are the drive's where there is one.
EncoderSpec read_encoders(const std::string& name, SensorReader& sensor);
sense::WheelOdometrySpec read_odometry(const std::string& name, SensorReader& sensor);
sense::MouseOdometrySpec read_mouse(const std::string& name, SensorReader& sensor);
/// Of an IMU, or of a gyro, which has no accelerometers.
sense::ImuSensorSpec read_inertial(const std::string& name, SensorReader& sensor, bool is_gyro);

}  // namespace hallway::sim
