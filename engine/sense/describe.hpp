// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "host/sensor_info.hpp"
#include "sense/bump_sensor.hpp"
#include "sense/compass_sensor.hpp"
#include "sense/encoder_sensor.hpp"
#include "sense/gnss_sensor.hpp"
#include "sense/imu_sensor.hpp"
#include "sense/infrared_sensor.hpp"
#include "sense/lidar_sensor.hpp"
#include "sense/mouse_odometry.hpp"
#include "sense/plane_sensor.hpp"
#include "sense/point_sensor.hpp"
#include "sense/sonar_sensor.hpp"
#include "sense/wheel_odometry.hpp"

namespace hallway::sense {

/// The facts of a sensor for plugins.
/// @param id  the number that its samples carry
host::SensorInfo describe(const PointSensorSpec& spec, std::uint32_t id);
host::SensorInfo describe(const PlaneSensorSpec& spec, std::uint32_t id);

host::SensorInfo describe(const BumpSensorSpec& spec, std::uint32_t id);
host::SensorInfo describe(const EncoderSensorSpec& spec, std::uint32_t id);
/// @param scan_s  how long a scan takes
host::SensorInfo describe(const LidarSpec& spec, std::uint32_t id, double scan_s);
host::SensorInfo describe(const SonarSpec& spec, std::uint32_t id);
host::SensorInfo describe(const InfraredSpec& spec, std::uint32_t id);
host::SensorInfo describe(const GnssSpec& spec, std::uint32_t id);
host::SensorInfo describe(const CompassSpec& spec, std::uint32_t id);
host::SensorInfo describe(const ImuSensorSpec& spec, std::uint32_t id);
host::SensorInfo describe(const WheelOdometrySpec& spec, std::uint32_t id);
host::SensorInfo describe(const MouseOdometrySpec& spec, std::uint32_t id);

}  // namespace hallway::sense
