// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "geometry/se3.hpp"
#include "sense/bump_sensor.hpp"
#include "sense/compass_sensor.hpp"
#include "sense/encoder_sensor.hpp"
#include "sense/gnss_sensor.hpp"
#include "sense/imu_sensor.hpp"
#include "sense/infrared_sensor.hpp"
#include "sense/lidar_sensor.hpp"
#include "sense/odometry.hpp"
#include "sense/plane_sensor.hpp"
#include "sense/point_sensor.hpp"
#include "sense/sonar_sensor.hpp"

namespace hallway::sim {

/// What a sensor gave, and what is true of it.
template <typename Given, typename True>
struct Sensed {
  Given reading{};
  True truth{};
};

using BumpSensed = Sensed<sense::BumpReading, sense::BumpTruth>;
using EncoderSensed = Sensed<sense::EncoderReading, sense::EncoderTruth>;
using LidarSensed = Sensed<sense::LidarReading, sense::LidarTruth>;
using SonarSensed = Sensed<sense::SonarReading, sense::SonarTruth>;
using InfraredSensed = Sensed<sense::InfraredReading, sense::InfraredTruth>;
using GnssSensed = Sensed<sense::GnssReading, sense::GnssTruth>;
using CompassSensed = Sensed<sense::CompassReading, sense::CompassTruth>;
using ImuSensed = Sensed<sense::ImuReading, sense::ImuTruth>;
using OdometrySensed = Sensed<sense::OdometryReading, std::monostate>;  ///< its truth is the robot's pose

/// What one sensor saw at one moment or in one span of time.
struct Reading {
  std::size_t sensor = 0;           ///< index in Scenario::sensors
  std::uint64_t sequence = 0;       ///< counts the sensor's readings
  std::int64_t t_begin_ns = 0;      ///< when it was begun; of what takes no time t_ns
  std::int64_t t_ns = 0;            ///< when it was taken, or ended
  std::int64_t stamp_begin_ns = 0;  ///< the two by the sensor's clock
  std::int64_t stamp_ns = 0;
  Pose T_world_body{};  ///< the truth at t_ns
  /// By the kind of the sensor: landmarks, walls or faces, …
  std::variant<std::vector<sense::PointObservation>, std::vector<PlaneObservation>, BumpSensed, EncoderSensed,
               LidarSensed, SonarSensed, InfraredSensed, GnssSensed, CompassSensed, ImuSensed, OdometrySensed>
      sensed{};

  const std::vector<sense::PointObservation>& observations() const {
    return std::get<std::vector<sense::PointObservation>>(sensed);
  }
  const std::vector<PlaneObservation>& planes() const {
    return std::get<std::vector<PlaneObservation>>(sensed);
  }
};

}  // namespace hallway::sim
